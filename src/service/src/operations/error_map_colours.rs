//! The surface of a workspace in bands of an error.

use verne_mesh::{ColourScale, Mesh, Swatch};

use crate::operations::error_map_subtasks::ErrorSurface;
use crate::wire::degrees::to_degrees;
use crate::wire::error::OperationError;
use crate::wire::error_map::ErrorName;

/// Number of bands.
const BANDS: u8 = 10;

/// Difference of errors, relative to the greatest, below which the surface has one band.
const EQUAL: f64 = 1e-9;

/// Digits of the ends of a band.
const DIGITS: i32 = 4;

/// Ranges of equal width from the least to the greatest error of a surface.
struct Bands {
    least: f64,
    greatest: f64,
    count: u8,
}

/// The surface with a tag for each triangle: the band of the greatest error at its corners. The bands are as wide as
/// each other; their names state their ends. Corners at which errors have no bound count as the last band.
pub(crate) fn banded_mesh(surface: &ErrorSurface, error: ErrorName) -> Result<Mesh, OperationError> {
    let value = |of: f64| if error.is_angle() { to_degrees(of) } else { of };
    let values: Vec<Option<f64>> =
        surface.errors().map(|errors| errors.map(|errors| value(errors.of(error.kind())))).collect();
    let bands = Bands::of(&values);
    let tag = |corners: &[u32; 3]| {
        let bands = corners.iter().filter_map(|corner| Some(bands.band(*values.get(*corner as usize)?)));
        bands.max().unwrap_or_default()
    };
    let tags: Vec<u8> = surface.triangles.iter().map(tag).collect();
    let palette = if tags.is_empty() { Vec::new() } else { bands.palette(error) };
    Mesh::new(surface.positions.clone(), surface.triangles.clone(), tags, palette)
        .map_err(|_| OperationError::Internal)
}

impl Bands {
    fn of(values: &[Option<f64>]) -> Self {
        let known = || values.iter().flatten().copied();
        let (least, greatest) = (known().fold(f64::INFINITY, f64::min), known().fold(0.0, f64::max));
        let least = least.min(greatest);
        let is_one = greatest - least <= EQUAL * greatest;
        Self { least, greatest, count: if is_one { 1 } else { BANDS } }
    }

    fn width(&self) -> f64 {
        (self.greatest - self.least) / f64::from(self.count)
    }

    fn band(&self, value: Option<f64>) -> u8 {
        let is_above =
            |band: &u8| value.is_none_or(|value| value > self.least + self.width() * f64::from(*band));
        // A value on the border of two bands is in the lower one.
        (1..self.count).rev().find(is_above).unwrap_or(0)
    }

    /// Dark blue for the smallest errors, yellow for the largest.
    fn palette(&self, error: ErrorName) -> Vec<Swatch> {
        let last = f64::from(self.count - 1);
        let scale = ColourScale { least: 0.0, greatest: last };
        let unit = if error.is_angle() { "deg" } else { "mm" };
        let digits = digits(self.greatest);
        let end = |band: u8| format!("{:.digits$}", self.least + self.width() * f64::from(band));
        (0..self.count)
            .map(|band| Swatch {
                name: format!("{} {} to {} {unit}", error.name(), end(band), end(band + 1)),
                rgb: scale.colour(last - f64::from(band)).map(byte),
            })
            .collect()
    }
}

/// Digits after the point with which a number has [`DIGITS`] significant ones.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "of a logarithm, and not negative"
)]
fn digits(number: f64) -> usize {
    if number > 0.0 { (DIGITS - 1 - number.log10().floor() as i32).max(0) as usize } else { 0 }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
fn byte(channel: f64) -> u8 {
    (255.0 * channel.clamp(0.0, 1.0)).round() as u8
}

#[cfg(test)]
mod tests {
    use super::{BANDS, Bands, digits};
    use crate::wire::error_map::ErrorName;

    #[test]
    fn bands_cover_the_values_and_state_their_ends() {
        let bands = Bands::of(&[Some(0.02), None, Some(0.01), Some(0.015)]);
        let found = [0.01, 0.0109, 0.0111, 0.0199, 0.02].map(|value| bands.band(Some(value)));
        assert_eq!(found, [0, 0, 1, 9, 9]);
        assert_eq!(bands.band(None), 9);
        let palette = bands.palette(ErrorName::TipWorst);
        assert_eq!(palette.len(), usize::from(BANDS));
        assert_eq!(palette[0].name, "tip_worst 0.01000 to 0.01100 mm");
        assert_eq!(palette[9].name, "tip_worst 0.01900 to 0.02000 mm");
        assert_eq!((palette[0].rgb, palette[9].rgb), ([0, 34, 78], [254, 232, 56]));
    }

    #[test]
    fn equal_errors_are_one_band() {
        let bands = Bands::of(&[Some(0.25), Some(0.25)]);
        assert_eq!((bands.count, bands.band(Some(0.25)), bands.band(None)), (1, 0, 0));
        assert_eq!(bands.palette(ErrorName::AxisRms).len(), 1);
        assert_eq!(Bands::of(&[None]).count, 1);
        assert_eq!([digits(0.0123), digits(123.0), digits(1e6), digits(0.0)], [5, 1, 0, 0]);
    }
}
