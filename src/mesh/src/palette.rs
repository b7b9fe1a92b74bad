//! Names and colours of tags.

use serde::{Deserialize, Serialize};

use crate::vector::single;

/// One tag's name and colour. A mesh's tags index its list of swatches.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Swatch {
    /// The meaning of the tag.
    pub name: String,
    /// The colour in sRGB, eight bits a channel.
    pub rgb: [u8; 3],
}

impl Swatch {
    /// The colour as linear intensity, 0 to 1, as glTF defines a material's colour.
    pub(crate) fn linear(&self) -> [f32; 3] {
        single(self.rgb.map(|channel| linear(f64::from(channel) / 255.0)))
    }
}

/// The linear intensity of an sRGB channel; both are from 0 to 1.
pub(crate) fn linear(channel: f64) -> f64 {
    if channel <= 0.04045 { channel / 12.92 } else { ((channel + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::Swatch;

    #[test]
    fn srgb_grey_188_is_linear_grey_128() {
        let swatch = Swatch { name: "grey".to_owned(), rgb: [0, 188, 255] };
        let bytes = swatch.linear().map(|intensity| (intensity * 255.0).round());
        assert_eq!(bytes, [0.0, 128.0, 255.0]);
    }
}
