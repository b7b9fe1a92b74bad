//! The pecks of deep holes, the same for every format.

use crate::moves::MoveKind;

/// The distance in mm between a peck and the bottom of the peck before, at most half a step.
const PECK_CLEARANCE: f64 = 0.5;
/// The most pecks of a hole.
const MOST_PECKS: u32 = 1000;
/// The deviation in mm of a height that was rounded.
pub(crate) const ROUNDING: f64 = 1e-9;

/// Where the tool goes between two pecks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PeckKind {
    /// Out of the hole, to remove chips.
    Deep,
    /// Back a little, to break chips.
    ChipBreak,
}

/// The strokes from the height `from` to the height `bottom` in mm, each with its end, or a sentence that says why
/// there are too many.
pub(crate) fn pecks(
    kind: PeckKind,
    from: f64,
    bottom: f64,
    step: f64,
) -> Result<Vec<(MoveKind, f64)>, String> {
    let back = PECK_CLEARANCE.min(0.5 * step);
    let mut strokes = Vec::new();
    for count in 1..=MOST_PECKS {
        let depth = from - step * f64::from(count);
        if depth <= bottom + ROUNDING {
            strokes.push((MoveKind::Feed, bottom));
            return Ok(strokes);
        }
        strokes.push((MoveKind::Feed, depth));
        if kind == PeckKind::Deep {
            strokes.push((MoveKind::Rapid, from));
        }
        strokes.push((MoveKind::Rapid, depth + back));
    }
    Err(format!("a hole has at most {MOST_PECKS} pecks; the step is too small"))
}
