//! phi2 along a program, continued from motion to motion.
//!
//! Outside a cap around the pole the axis determines phi2 up to half turns: (phi1, phi2) and (-phi1, phi2 + π) are the
//! same axis. One of these values is continued through the whole program; the others are it plus π h for an integer h,
//! with phi1 in the sign of (-1)^h. So h counts preimages and windings together.
//!
//! Inside the cap phi2 is free, and phi1 is the axis' component on the meridian. Between the meridians where a path
//! enters and leaves the cap, phi2 changes linearly with the path: over the rapids of the stretch if it has any, else
//! over all of it. A program may also state phi2 there; it then is the program's everywhere.

use std::f64::consts::{FRAC_1_PI, PI, TAU};

use super::azimuth::{Azimuths, azimuth_direction, azimuth_of, continued, of_arrival, to_nearest};
use super::cap::Cap;
use super::motion::{Motion, MotionKind, Standstill, Turning};
use super::path::Path;
use super::stretches::Stretch;
use crate::fast_math::{is_odd, sin_cos};

/// A part of one motion's path on which phi2 follows one rule.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) from: f64,
    pub(super) to: f64,
    rule: Rule,
}

#[derive(Clone, Copy, Debug)]
enum Rule {
    /// phi2 follows the axis' azimuth, from this value; the azimuth at both ends.
    Follow { azimuth: [f64; 2], phi2: f64 },
    /// phi2 is linear in the path; `share` is the fraction of the stretch's measure at both ends.
    Linear { stretch: usize, share: [f64; 2] },
    /// phi2 is linear between these values. `is_odd`: they are the program's phi2 and an odd number of half turns.
    Words { phi2: [f64; 2], is_odd: bool },
    /// phi2 stays, whatever the axis.
    Held { phi2: f64 },
}

impl Span {
    /// The stretch that the span belongs to, if it is inside the cap.
    pub(super) fn stretch(&self) -> Option<usize> {
        match self.rule {
            Rule::Linear { stretch, .. } => Some(stretch),
            Rule::Follow { .. } | Rule::Words { .. } | Rule::Held { .. } => None,
        }
    }

    /// A span over parameters from 0 to 1 on which phi2 stays.
    pub(super) fn held(phi2: f64) -> Self {
        Self { from: 0.0, to: 1.0, rule: Rule::Held { phi2 } }
    }

    /// A span over parameters from 0 to 1 on which phi2 turns from one end of the stretch to the other.
    pub(super) fn turning(&self) -> Self {
        let rule = match self.rule {
            Rule::Linear { stretch, .. } => Rule::Linear { stretch, share: [0.0, 1.0] },
            Rule::Follow { .. } | Rule::Words { .. } | Rule::Held { .. } => self.rule,
        };
        Self { from: 0.0, to: 1.0, rule }
    }

    /// Whether h must be odd or even for phi2 to be the program's; `None` if it may be either.
    pub(super) fn is_odd(&self) -> Option<bool> {
        match self.rule {
            Rule::Words { is_odd, .. } => Some(is_odd),
            Rule::Follow { .. } | Rule::Linear { .. } | Rule::Held { .. } => None,
        }
    }

    /// phi2 at a parameter with its sine and cosine, for h half turns at the beginning and at the end of a stretch.
    pub(super) fn meridian(
        &self,
        stretches: &[Stretch],
        s: f64,
        axis: [f64; 3],
        h: [i32; 2],
    ) -> (f64, [f64; 2]) {
        let phi2 = match self.rule {
            Rule::Follow { azimuth: [start, end], phi2 } => {
                let nearer = if s - self.from < self.to - s { start } else { end };
                let along = azimuth_direction(axis);
                let now = if s == self.to { end } else { along.map_or(nearer, azimuth_of) };
                let phi2 = phi2 + to_nearest(now - start, TAU) + PI * f64::from(h[1]);
                if let Some(along) = along {
                    let is_opposite = is_odd((phi2 - now) * FRAC_1_PI);
                    return (phi2, if is_opposite { along.map(|c| -c) } else { along });
                }
                phi2
            }
            Rule::Words { phi2: [from, to], .. } => from + (to - from) * s + PI * f64::from(h[1]),
            Rule::Held { phi2 } => phi2,
            Rule::Linear { stretch, share } => {
                let [from, to] = stretches[stretch].phi2;
                let [from, to] = [from + PI * f64::from(h[0]), to + PI * f64::from(h[1])];
                let width = self.to - self.from;
                let part = if width > 0.0 { (s - self.from) / width } else { 1.0 };
                from + (to - from) * (share[0] + (share[1] - share[0]) * part)
            }
        };
        let (sine, cosine) = sin_cos(phi2);
        (phi2, [sine, cosine])
    }
}

/// Follows phi2 through a program whose stretches inside the cap are known.
pub(super) struct Meridian<'a> {
    cap: Cap,
    stretches: &'a [Stretch],
    /// Index of the next stretch, or of the present one.
    next: usize,
    /// Measure of the present stretch that lies behind.
    done: f64,
    is_inside: bool,
    phi2: Option<f64>,
    /// The end of the last motion.
    standstill: Standstill,
    azimuths: Azimuths,
    /// The path of the last motion; `None`: the program has no path to its end.
    pub(super) path: Option<Path>,
    /// The parts of the path, or the end of the motion.
    pub(super) spans: Vec<Span>,
}

impl<'a> Meridian<'a> {
    /// Begins at a standstill, with phi2 there if it is known.
    pub(super) fn new(
        cap: Cap,
        stretches: &'a [Stretch],
        (standstill, phi2): (Standstill, Option<f64>),
    ) -> Self {
        Self {
            cap,
            stretches,
            next: 0,
            done: 0.0,
            is_inside: false,
            phi2,
            standstill,
            azimuths: Azimuths::default(),
            path: None,
            spans: Vec::new(),
        }
    }

    /// Moves to the end of a motion.
    pub(super) fn advance(&mut self, motion: &Motion) {
        self.path = self.standstill.advance(motion).map(|start| {
            let path = Path::new(start, motion);
            self.pass(motion.kind, &path);
            path
        });
        if self.path.is_none() {
            self.arrive(motion);
        }
    }

    /// Arrives at a position from anywhere: a single span at parameter 1.
    fn arrive(&mut self, motion: &Motion) {
        self.leave();
        self.spans.clear();
        let rule = if matches!(motion.turning, Turning::Held { .. }) {
            let phi2 = of_arrival(motion);
            self.words([phi2; 2])
        } else if self.cap.has(motion.end.axis) {
            self.is_inside = true;
            Rule::Linear { stretch: self.next, share: [0.0, 0.0] }
        } else {
            let azimuth = of_arrival(motion);
            let phi2 = continued(self.phi2, azimuth);
            self.phi2 = Some(phi2);
            Rule::Follow { azimuth: [azimuth; 2], phi2 }
        };
        self.spans.push(Span { from: 1.0, to: 1.0, rule });
    }

    /// Follows phi2 of the program, between two values.
    fn words(&mut self, [start, end]: [f64; 2]) -> Rule {
        let begun = continued(self.phi2, start);
        let phi2 = [begun, begun + (end - start)];
        self.phi2 = Some(phi2[1]);
        let half_turns = ((begun - start) / PI).round();
        Rule::Words { phi2, is_odd: half_turns.rem_euclid(2.0) == 1.0 }
    }

    /// Finds the parts of a path.
    fn pass(&mut self, kind: MotionKind, path: &Path) {
        if let Some(phi2) = path.held() {
            self.leave();
            self.spans.clear();
            let rule = self.words(phi2);
            self.spans.push(Span { from: 0.0, to: 1.0, rule });
            return;
        }
        let (cap, mut spans, mut azimuths) = (self.cap, std::mem::take(&mut self.spans), self.azimuths);
        spans.clear();
        cap.split(path, |[from, to], inside| {
            let rule = if inside {
                self.is_inside = true;
                let stretch = self.stretches[self.next];
                let before = self.done;
                if kind == MotionKind::Rapid || !stretch.has_rapid {
                    self.done += cap.measure(path) * (to - from);
                }
                let share = [before, self.done]
                    .map(|done| if stretch.is_point() { 1.0 } else { (done / stretch.measure).min(1.0) });
                Rule::Linear { stretch: self.next, share }
            } else {
                self.leave();
                let [start, end] = azimuths.of(path, [from, to]);
                let phi2 = continued(self.phi2, start);
                self.phi2 = Some(phi2 + to_nearest(end - start, TAU));
                Rule::Follow { azimuth: [start, end], phi2 }
            };
            spans.push(Span { from, to, rule });
        });
        (self.spans, self.azimuths) = (spans, azimuths);
    }

    fn leave(&mut self) {
        if self.is_inside {
            self.phi2 = Some(self.stretches[self.next].phi2[1]);
            (self.is_inside, self.done) = (false, 0.0);
            self.next += 1;
        }
    }
}
