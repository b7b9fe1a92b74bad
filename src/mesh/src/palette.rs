//! What a tag means to a reader and how it is painted.

use serde::{Deserialize, Serialize};

/// One tag's name and colour. A mesh's tags index its list of swatches.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Swatch {
    /// What the tag stands for.
    pub name: String,
    /// The colour as screens show it: sRGB, eight bits a channel.
    pub rgb: [u8; 3],
}

impl Swatch {
    /// The colour as a light's intensity, which is what glTF means by a vertex colour.
    pub(crate) fn linear(&self) -> [u8; 3] {
        self.rgb.map(|channel| {
            let encoded = f64::from(channel) / 255.0;
            let intensity =
                if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) };
            quantised(intensity)
        })
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the argument lies in 0..=1")]
fn quantised(intensity: f64) -> u8 {
    (intensity * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::Swatch;

    #[test]
    fn ends_are_kept_and_middle_grey_is_darkened() {
        let swatch = Swatch { name: "grey".to_owned(), rgb: [0, 188, 255] };
        assert_eq!(swatch.linear(), [0, 128, 255]);
    }
}
