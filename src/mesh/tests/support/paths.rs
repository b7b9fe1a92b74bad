//! A path with both kinds of segments and a gap.

#![allow(clippy::unwrap_used, reason = "a point that is not finite ends the test")]

use verne_mesh::{ColourScale, Path, PathBuilder, Stroke, Swatch};

/// A rapid to a square, around it with a value that falls to zero, and after a gap a rapid elsewhere. At most `most` of
/// its eight points, and the last one.
pub(crate) fn square(most: u64) -> Path {
    let points = [
        ([0.0, 0.0, 500.0], 0.5, Stroke::None),
        ([0.0, 0.0, 300.0], 0.4, Stroke::Plain),
        ([100.0, 0.0, 300.0], 0.3, Stroke::Coloured),
        ([100.0, 100.0, 300.0], 0.0, Stroke::Coloured),
        ([0.0, 100.0, 300.0], 0.2, Stroke::Coloured),
        ([0.0, 0.0, 300.0], 0.3, Stroke::Coloured),
        ([-50.0, 0.0, 500.0], 0.5, Stroke::None),
        ([-50.0, 50.0, 500.0], 0.6, Stroke::Plain),
    ];
    let mut builder = PathBuilder::new(points.len() as u64, most);
    for (point, value, stroke) in points {
        builder.push(point, value, stroke).unwrap();
    }
    let plain = Swatch { name: "rapid".to_owned(), rgb: [128; 3] };
    builder.finish("feed".to_owned(), plain, ColourScale { least: 0.0, greatest: 0.5 })
}
