//! The parameters of drilling cycles, which hold until others replace them.

use crate::event::Dwell;
use crate::gcode::vocabulary::CycleKind;

/// A cycle. Heights are coordinates in mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cycle {
    pub(crate) kind: CycleKind,
    /// The height of the tool before the cycle.
    pub(crate) initial: f64,
    /// R: where the feed begins.
    pub(crate) start: Option<f64>,
    /// Z: where the hole ends.
    pub(crate) bottom: Option<f64>,
    /// Q: the depth of one peck.
    pub(crate) step: Option<f64>,
    /// P.
    pub(crate) dwell: Option<Dwell>,
}

impl Cycle {
    pub(crate) fn new(kind: CycleKind, initial: f64) -> Self {
        Self { kind, initial, start: None, bottom: None, step: None, dwell: None }
    }
}
