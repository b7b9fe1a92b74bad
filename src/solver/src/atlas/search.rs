//! The search for a curve over boxes: what it covers, and its boxes.

use super::chart::Chart;
use super::place::Configuration;
use super::target::System;
use crate::interval::Interval;

/// Most boxes, and most parts of edges, that are examined.
pub(super) const MOST: usize = 400_000;

/// The side of leg II or III in a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LegSide {
    Above,
    Below,
    /// Either: the leg may be level.
    Either,
    /// Exactly level, as a target wants it.
    Level,
}

/// A range of t and θ (see [`Chart`]), with a side of legs II and III.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) ranges: [Interval; 2],
    pub(super) sides: [LegSide; 2],
}

/// What a search has found on edges, and how many parts of them it has examined.
#[derive(Default)]
pub(super) struct Found {
    pub(super) points: Vec<Configuration>,
    pub(super) examined: usize,
}

/// What a search covers.
pub(super) struct Search<'a> {
    pub(super) system: System<'a>,
    pub(super) chart: Chart,
    /// The part of the plane.
    pub(super) window: [Interval; 2],
    /// Boxes with a smaller image are not halved.
    pub(super) tolerance: f64,
    /// Whether only the sides above count, for legs II and III.
    pub(super) above_only: [bool; 2],
}

impl LegSide {
    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Above => 1.0,
            Self::Below => -1.0,
            Self::Either | Self::Level => 0.0,
        }
    }
}

impl Cell {
    pub(super) fn halved(&self, axis: usize) -> [Self; 2] {
        let middle = self.ranges[axis].middle();
        let [mut below, mut above] = [*self, *self];
        below.ranges[axis].high = middle;
        above.ranges[axis].low = middle;
        [below, above]
    }
}
