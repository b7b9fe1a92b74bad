//! The inclinations phi1 at a part point for which the table's plane is kept.
//!
//! At the height Z of the point, the limit is kept if the lowest of tool end and platform joints is not more than Z -
//! `least` below the tool centre point. That depth is the greatest of `tool_radius` |sin phi1| and R |sin phi1| -
//! `tool_length` cos phi1, with R the greater of R1 and R2. These are sinusoids, each of which exceeds a value on one
//! arc of phi1.

use std::f64::consts::{FRAC_PI_2, PI};

use super::inclination::{InclinationInterval, turns};
use crate::clearance::Clearance;
use crate::limit::{Constraint, Element};
use crate::machine::Machine;
use crate::workspace::domain::Binding;

/// Half-width of arcs of phi1 below which they are not excluded, rad: intervals as close to each other are one.
const NARROW: f64 = 5e-10;

/// The table's plane as a limit of a machine with a tool.
#[derive(Clone, Copy)]
pub(super) struct Floor<'a> {
    pub(super) machine: &'a Machine,
    pub(super) clearance: Clearance,
}

/// One sinusoid: its amplitude, the phi1 of its maximum, and the element whose depth it is.
struct Depth {
    amplitude: f64,
    top: f64,
    element: Element,
}

impl Floor<'_> {
    /// Z of a point at a radius about the tilting axis and an angle psi, mm.
    pub(super) fn height(&self, radius: f64, psi: f64) -> f64 {
        self.machine.table().dt + radius * psi.cos()
    }

    /// Removes the inclinations that are too deep at a height Z from the intervals.
    pub(super) fn cut(&self, z: f64, mut found: Vec<InclinationInterval>) -> Vec<InclinationInterval> {
        let room = z - self.clearance.least;
        for depth in self.depths() {
            let half = depth.half(room);
            if half <= NARROW {
                continue;
            }
            let binding = Binding { constraint: Constraint::TableClearance, element: depth.element };
            found =
                found.into_iter().flat_map(|interval| without(&interval, depth.top, half, binding)).collect();
        }
        found
    }

    /// The least Z at which one of the inclinations of a range keeps the limit, mm.
    pub(super) fn lowest(&self, range: [f64; 2]) -> f64 {
        let g = self.machine.geometry();
        let Clearance { tool_length, tool_radius, .. } = self.clearance;
        // The greater of the depths of tool and joints is least at the ends of the range, upright, or where both are
        // equal.
        let equal = (tool_length / (g.R1.max(g.R2) - tool_radius)).atan();
        let minima = [0.0, PI, equal, -equal, equal + PI, PI - equal];
        self.needed(range, &minima).fold(f64::INFINITY, f64::min)
    }

    /// The least Z at which all inclinations of a range keep the limit, mm.
    fn highest(&self, range: [f64; 2]) -> f64 {
        let tops = self.depths().map(|depth| depth.top);
        self.needed(range, &tops).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The least Z for the ends of a range and for those of the inclinations that lie in it.
    fn needed(&self, [from, to]: [f64; 2], inclinations: &[f64]) -> impl Iterator<Item = f64> {
        let inside =
            inclinations.iter().flat_map(move |at| turns(from - at, to - at).map(move |turn| at + turn));
        let needed = |phi1| self.clearance.least + self.clearance.depth(self.machine, phi1).0;
        [from, to].into_iter().chain(inside).map(needed)
    }

    /// Adds the portions of an interval of psi, at a radius, on which all inclinations of a range keep the limit.
    pub(super) fn overlap(
        &self,
        radius: f64,
        range: [f64; 2],
        [from, to]: [f64; 2],
        found: &mut Vec<[f64; 2]>,
    ) {
        let cosine = (self.highest(range) - self.machine.table().dt) / radius;
        if cosine <= -1.0 {
            found.push([from, to]);
        } else if cosine < 1.0 {
            let half = cosine.acos();
            found.extend(
                turns(from - half, to + half).map(|turn| [from.max(turn - half), to.min(turn + half)]),
            );
        }
    }

    fn depths(&self) -> [Depth; 4] {
        let g = self.machine.geometry();
        let Clearance { tool_length, tool_radius, .. } = self.clearance;
        let (reach, rods) = if g.R1 >= g.R2 { (g.R1, [11, 12]) } else { (g.R2, [31, 21]) };
        let (amplitude, top) = (reach.hypot(tool_length), FRAC_PI_2 + tool_length.atan2(reach));
        let tool = |top| Depth { amplitude: tool_radius, top, element: Element::Tool };
        let joint = |top, rod| Depth { amplitude, top, element: Element::Joint(rod) };
        [tool(FRAC_PI_2), tool(-FRAC_PI_2), joint(top, rods[0]), joint(-top, rods[1])]
    }
}

impl Depth {
    /// Half of the arc on which the sinusoid exceeds a value, rad.
    fn half(&self, room: f64) -> f64 {
        if room >= self.amplitude {
            0.0
        } else if room <= -self.amplitude {
            PI
        } else {
            (room / self.amplitude).acos()
        }
    }
}

/// Removes an arc from an interval.
fn without(
    interval: &InclinationInterval,
    top: f64,
    half: f64,
    binding: Binding,
) -> Vec<InclinationInterval> {
    let mut left = Vec::new();
    if half >= PI {
        return left;
    }
    let mut rest = *interval;
    let [from, to] = interval.ends;
    for turn in turns(from - top - half, to - top + half) {
        let (begins, ends) = (top + turn - half, top + turn + half);
        if begins >= rest.ends[0] {
            let (ends, bindings) = ([rest.ends[0], begins.min(to)], [rest.bindings[0], Some(binding)]);
            left.push(InclinationInterval { ends, bindings });
        }
        rest = InclinationInterval { ends: [ends, to], bindings: [Some(binding), interval.bindings[1]] };
        if ends > to {
            return left;
        }
    }
    left.push(rest);
    left
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn an_excluded_arc_leaves_the_intervals_beside_it_on_every_turn() {
        let binding = Binding { constraint: Constraint::TableClearance, element: Element::Tool };
        let whole = InclinationInterval { ends: [-PI, 2.0 * TAU], bindings: [None; 2] };
        let left: Vec<[f64; 2]> = without(&whole, 0.0, 1.0, binding).iter().map(|rest| rest.ends).collect();
        assert_eq!(
            left,
            [[-PI, -1.0], [1.0, TAU - 1.0], [TAU + 1.0, 2.0 * TAU - 1.0]],
            "the last arc reaches beyond the end"
        );
        let interval = InclinationInterval { ends: [-0.5, 2.0], bindings: [None; 2] };
        let left = without(&interval, 0.0, 1.0, binding);
        assert_eq!(left, [InclinationInterval { ends: [1.0, 2.0], bindings: [Some(binding), None] }]);
        assert!(without(&interval, 0.75, 1.3, binding).is_empty());
        let gap = without(&interval, PI, 2.9, binding);
        assert_eq!(gap.len(), 1);
        let [from, to] = gap[0].ends;
        assert!((from + (PI - 2.9)).abs() < 1e-12 && (to - (PI - 2.9)).abs() < 1e-12);
    }
}
