//! The cap around the pole in which phi2 is free.

use super::azimuth::LEAST_SINE;
use super::golden_section;
use super::path::{Path, count_of};
use crate::fast_math::angle_of_vector;

/// Greatest angle that linear phi1 and phi2 move through in a step, rad.
const STEP: f64 = 0.25;
/// Greatest number of times that a part outside the cap is halved, so that the azimuth turns by less than half a turn.
const MOST_HALVINGS: u32 = 24;
/// Halvings that locate where a path enters a cap.
const HALVINGS: u32 = 60;
/// Steps of the search for the least inclination.
const GOLDEN_STEPS: u32 = 50;

/// The size of the cap, and what phi2 is spread over.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cap {
    sine: f64,
    /// Length that counts as much as a radian, mm.
    pub(super) scale: f64,
}

impl Cap {
    /// A cap of this half-angle, rad. An axis that is so near to the pole that it has no azimuth is in every cap.
    pub(super) fn new(angle: f64, scale: f64) -> Self {
        Self { sine: angle.sin().max(LEAST_SINE), scale }
    }

    pub(super) fn has(&self, axis: [f64; 3]) -> bool {
        axis[2] > 0.0 && axis[0] * axis[0] + axis[1] * axis[1] <= self.sine * self.sine
    }

    /// Whether an axis that turns by at most `turn` between two axes certainly stays outside.
    pub(super) fn is_clear(&self, ends: [[f64; 3]; 2], turn: f64) -> bool {
        let [a, b] = ends.map(|[i, j, _]| i * i + j * j);
        let reach = self.sine + turn;
        a.min(b) > reach * reach
    }

    pub(super) fn measure(&self, path: &Path) -> f64 {
        path.length() + self.scale * path.turn()
    }

    /// Calls `found` with the parts of a path: both ends of each, and whether it is inside the cap. On a part outside
    /// the azimuth turns by less than half a turn, unless the path meets the pole itself.
    pub(super) fn split(&self, path: &Path, mut found: impl FnMut([f64; 2], bool)) {
        if path.is_great_circle() && self.is_clear(path.end_axes(), path.turn()) {
            found([0.0, 1.0], false);
            return;
        }
        let steps = if path.is_great_circle() { 1 } else { count_of(path.turn() / STEP) };
        let mut parts = Parts { path, begun: 0.0, is_inside: self.has(path.at(0.0).axis), found };
        for step in 0..steps {
            let [low, high] = [step, step + 1].map(|step| f64::from(step) / f64::from(steps));
            match [parts.is_inside, self.has(path.at(high).axis)] {
                [false, false] => {
                    if let Some(inside) = self.least(path, low, high) {
                        parts.end(self.crossing(path, low, inside), true);
                        parts.end(self.crossing(path, high, inside), false);
                    }
                }
                [true, false] => parts.end(self.crossing(path, high, low), false),
                [false, true] => parts.end(self.crossing(path, low, high), true),
                [true, true] => {}
            }
            if !parts.is_inside && high < 1.0 {
                parts.end(high, false);
            }
        }
        let is_inside = parts.is_inside;
        parts.end(1.0, is_inside);
    }

    /// A parameter inside the cap between two outside, if the path passes through it.
    fn least(&self, path: &Path, low: f64, high: f64) -> Option<f64> {
        let nearest = if path.is_great_circle() {
            path.nearest_to_pole()
        } else if self.is_clear([low, high].map(|s| path.at(s).axis), path.turn_between([low, high])) {
            None
        } else {
            let square = |s: f64| {
                let [i, j, k] = path.at(s).axis;
                if k > 0.0 { i * i + j * j } else { 1.0 }
            };
            Some(golden_section::least([low, high], GOLDEN_STEPS, square))
        };
        nearest.filter(|&s| self.has(path.at(s).axis))
    }

    /// Where a path crosses the cap's edge between a parameter outside and one inside; a parameter inside.
    fn crossing(&self, path: &Path, mut outside: f64, mut inside: f64) -> f64 {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (outside + inside);
            if self.has(path.at(middle).axis) { inside = middle } else { outside = middle }
        }
        inside
    }
}

/// The parts of a path as they are found.
struct Parts<'a, F> {
    path: &'a Path,
    begun: f64,
    is_inside: bool,
    found: F,
}

impl<F: FnMut([f64; 2], bool)> Parts<'_, F> {
    /// Ends the present part; the next one is inside the cap or not.
    fn end(&mut self, s: f64, is_next_inside: bool) {
        if self.is_inside {
            (self.found)([self.begun, s], true);
        } else {
            self.outside([self.begun, s], MOST_HALVINGS);
        }
        (self.begun, self.is_inside) = (s, is_next_inside);
    }

    /// Halves a part outside the cap until the azimuth turns by less than half a turn on each half.
    fn outside(&mut self, [from, to]: [f64; 2], halvings: u32) {
        if halvings == 0 || self.is_below_half_turn([from, to]) {
            (self.found)([from, to], false);
            return;
        }
        let middle = 0.5 * (from + to);
        self.outside([from, middle], halvings - 1);
        self.outside([middle, to], halvings - 1);
    }

    /// Whether the azimuth certainly turns by less than half a turn. The shortest way between opposite azimuths leads
    /// over the pole.
    fn is_below_half_turn(&self, ends: [f64; 2]) -> bool {
        if self.path.is_great_circle() {
            return true;
        }
        let [a, b] = ends.map(|s| {
            let [i, j, k] = self.path.at(s).axis;
            angle_of_vector(k.abs(), i.hypot(j))
        });
        self.path.turn_between(ends) < a + b
    }
}
