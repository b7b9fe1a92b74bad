//! Colours of values.

/// The scale Cividis of Nuñez, Anderton and Renslow, [doi:10.1371/journal.pone.0199239]: it looks nearly the same to
/// people with and without colour vision deficiency, and its lightness grows evenly. Ten equidistant colours, sRGB.
///
/// [doi:10.1371/journal.pone.0199239]: https://doi.org/10.1371/journal.pone.0199239
const CIVIDIS: [[u8; 3]; 10] = [
    [0x00, 0x22, 0x4e],
    [0x12, 0x35, 0x70],
    [0x3b, 0x49, 0x6c],
    [0x57, 0x5d, 0x6d],
    [0x70, 0x71, 0x73],
    [0x8a, 0x86, 0x78],
    [0xa5, 0x9c, 0x74],
    [0xc3, 0xb3, 0x69],
    [0xe1, 0xcc, 0x55],
    [0xfe, 0xe8, 0x38],
];

/// Colours of values, distinguishable with any colour vision: yellow at the least value, dark blue at the greatest one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColourScale {
    /// This value and smaller ones are yellow.
    pub least: f64,
    /// This value and greater ones are dark blue.
    pub greatest: f64,
}

impl ColourScale {
    /// The colour of a value in sRGB, each channel from 0 to 1.
    ///
    /// ```
    /// use verne_mesh::ColourScale;
    ///
    /// let scale = ColourScale { least: 0.0, greatest: 0.5 };
    /// assert_eq!(scale.colour(-1.0), scale.colour(0.0));
    /// assert_eq!(scale.colour(0.5).map(|channel| (255.0 * channel).round()), [0.0, 34.0, 78.0]);
    /// ```
    pub fn colour(self, value: f64) -> [f64; 3] {
        let fraction = (self.greatest - value) / (self.greatest - self.least);
        // A scale without extent has two colours.
        let fraction =
            if fraction.is_finite() { fraction.clamp(0.0, 1.0) } else { f64::from(value <= self.least) };
        let place = 9.0 * fraction;
        let index = (0..8_u8).find(|index| place < f64::from(index + 1)).unwrap_or(8);
        let within = place - f64::from(index);
        let ends = [CIVIDIS[usize::from(index)], CIVIDIS[usize::from(index) + 1]];
        std::array::from_fn(|channel| {
            let [low, high] = ends.map(|rgb| f64::from(rgb[channel]));
            (low + within * (high - low)) / 255.0
        })
    }
}
