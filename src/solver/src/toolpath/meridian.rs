//! phi2 along a program, continued from motion to motion.
//!
//! Outside a cap around the pole the axis determines phi2 up to half turns: (phi1, phi2) and (-phi1, phi2 + π) are the
//! same axis. One of these values is continued through the whole program; the others are it plus π h for an integer h,
//! with phi1 in the sign of (-1)^h. So h counts preimages and windings together.
//!
//! Inside the cap phi2 is free, and phi1 is the axis' component on the meridian. Between the meridians where a path
//! enters and leaves the cap, phi2 changes linearly with the path: over the rapids of the stretch if it has any, else
//! over all of it.

use std::f64::consts::{PI, TAU};

use super::motion::{Motion, MotionKind, Motions, ToolPosition};
use super::path::Path;

/// Width of the strip beside an azimuth of half a turn whose sign is rounding, rad.
const SEAM: f64 = 1e-9;
/// Sine of the inclination below which an axis has no azimuth.
const LEAST_SINE: f64 = 1e-9;
/// Greatest angle that linear phi1 and phi2 move through in a step, rad.
const STEP: f64 = 0.25;
/// Halvings that locate where a path enters a cap.
const HALVINGS: u32 = 60;
/// Steps of the search for the least inclination.
const GOLDEN_STEPS: u32 = 50;
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// A place on the path of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) motion: usize,
    pub(super) s: f64,
}

/// A stretch of the path inside the cap around the pole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) start: Place,
    pub(super) end: Place,
    /// phi2 where the path enters and leaves, rad.
    pub(super) phi2: [f64; 2],
    /// What phi2 is spread over: length of the path and angle of the axis.
    measure: f64,
    /// Whether the measure counts rapids only.
    pub(super) has_rapid: bool,
    /// Whether the path enters and leaves the cap by a motion, so that phi2 is determined at both ends.
    pub(super) is_bounded: bool,
}

impl Stretch {
    /// Whether phi2 can only turn while the tool's end stands still.
    pub(super) fn is_point(&self) -> bool {
        self.measure <= 0.0
    }
}

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
}

impl Span {
    /// The stretch that the span belongs to, if it is inside the cap.
    pub(super) fn stretch(&self) -> Option<usize> {
        match self.rule {
            Rule::Linear { stretch, .. } => Some(stretch),
            Rule::Follow { .. } => None,
        }
    }

    /// A span over parameters from 0 to 1 on which phi2 turns from one end of the stretch to the other.
    pub(super) fn turning(&self) -> Self {
        let rule = match self.rule {
            Rule::Linear { stretch, .. } => Rule::Linear { stretch, share: [0.0, 1.0] },
            Rule::Follow { .. } => self.rule,
        };
        Self { from: 0.0, to: 1.0, rule }
    }

    /// phi2 at a parameter, for h half turns at the beginning and at the end of a stretch.
    pub(super) fn phi2(&self, stretches: &[Stretch], s: f64, axis: [f64; 3], h: [i32; 2]) -> f64 {
        match self.rule {
            Rule::Follow { azimuth: [start, end], phi2 } => {
                let is_first_half = s - self.from < self.to - s;
                let now = match azimuth(axis) {
                    Some(azimuth) => azimuth,
                    None if is_first_half => start,
                    None => end,
                };
                phi2 + to_nearest(now - start, TAU) + PI * f64::from(h[1])
            }
            Rule::Linear { stretch, share } => {
                let [from, to] = stretches[stretch].phi2;
                let [from, to] = [from + PI * f64::from(h[0]), to + PI * f64::from(h[1])];
                let width = self.to - self.from;
                let part = if width > 0.0 { (s - self.from) / width } else { 1.0 };
                from + (to - from) * (share[0] + (share[1] - share[0]) * part)
            }
        }
    }
}

/// phi1 of an axis on the meridian phi2, rad: of its component there, if phi2 is not its own.
pub(super) fn inclination([i, j, k]: [f64; 3], phi2: f64) -> f64 {
    let (sin, cos) = phi2.sin_cos();
    (i * sin - j * cos).atan2(k)
}

/// phi2 of an axis with phi1 >= 0, rad, in (-π, π] but for rounding; `None` at the pole.
fn azimuth([i, j, _]: [f64; 3]) -> Option<f64> {
    (i * i + j * j > LEAST_SINE * LEAST_SINE).then(|| direction_azimuth(i, j))
}

fn direction_azimuth(i: f64, j: f64) -> f64 {
    let azimuth = i.atan2(0.0 - j);
    if azimuth <= SEAM - PI { azimuth + TAU } else { azimuth }
}

/// The azimuths at both ends of a part of a path outside the cap. At the pole itself it is that of the way from it.
fn azimuths(path: &Path, ends: [f64; 2]) -> [f64; 2] {
    let at = |s: f64, sign: f64| {
        azimuth(path.at(s).axis).unwrap_or_else(|| {
            let [_, rate] = path.rates(s);
            direction_azimuth(sign * rate.x, sign * rate.y)
        })
    };
    [at(ends[0], 1.0), at(ends[1], -1.0)]
}

/// The difference modulo `period` that is nearest to zero; of two, the positive one.
fn to_nearest(difference: f64, period: f64) -> f64 {
    difference - period * (difference / period - 0.5 - SEAM).ceil()
}

/// The size of the cap, and what phi2 is spread over.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cap {
    sine: f64,
    /// Length that counts as much as a radian, mm.
    scale: f64,
}

impl Cap {
    /// A cap of this half-angle, rad.
    pub(super) fn new(angle: f64, scale: f64) -> Self {
        Self { sine: angle.sin(), scale }
    }

    fn has(&self, axis: [f64; 3]) -> bool {
        axis[2] > 0.0 && axis[0] * axis[0] + axis[1] * axis[1] <= self.sine * self.sine
    }

    fn measure(&self, path: &Path) -> f64 {
        path.length() + self.scale * path.turn()
    }

    /// Calls `found` with the parts of a path: both ends of each, and whether it is inside the cap.
    fn split(&self, path: &Path, found: impl FnMut([f64; 2], bool)) {
        let steps = if path.is_great_circle() { 1 } else { (path.turn() / STEP).ceil().max(1.0) as u32 };
        let mut parts = Parts { begun: 0.0, is_inside: self.has(path.at(0.0).axis), found };
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
                // A part follows the azimuth through less than half a turn.
                parts.end(high, false);
            }
        }
        let is_inside = parts.is_inside;
        parts.end(1.0, is_inside);
    }

    /// A parameter inside the cap between two outside, if the path passes through it.
    fn least(&self, path: &Path, low: f64, high: f64) -> Option<f64> {
        let sine = |s: f64| {
            let [i, j, k] = path.at(s).axis;
            if k > 0.0 { (i * i + j * j).sqrt() } else { 1.0 }
        };
        if sine(low).min(sine(high)) > self.sine + path.turn() * (high - low) {
            return None;
        }
        let (mut a, mut b) = (low, high);
        for _ in 0..GOLDEN_STEPS {
            let (c, d) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
            if sine(c) < sine(d) {
                b = d
            } else {
                a = c
            }
            if sine(c).min(sine(d)) <= self.sine {
                return Some(if sine(c) < sine(d) { c } else { d });
            }
        }
        None
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
struct Parts<F> {
    begun: f64,
    is_inside: bool,
    found: F,
}

impl<F: FnMut([f64; 2], bool)> Parts<F> {
    /// Ends the present part; the next one is inside the cap or not.
    fn end(&mut self, s: f64, is_next_inside: bool) {
        (self.found)([self.begun, s], self.is_inside);
        (self.begun, self.is_inside) = (s, is_next_inside);
    }
}

struct Open {
    start: Place,
    from: Option<f64>,
    all: f64,
    rapid: f64,
}

/// Finds the stretches of a program inside the cap. `fallback` is phi2 where nothing determines it.
pub(super) fn stretches<M: Motions + ?Sized>(motions: &M, cap: &Cap, fallback: f64) -> Vec<Stretch> {
    let mut survey = Survey { stretches: Vec::new(), phi2: None, open: None, fallback };
    let mut start: Option<ToolPosition> = None;
    for index in 0..motions.count() {
        let motion = motions.motion(index);
        match start {
            Some(start) if motion.kind != MotionKind::Arrive => {
                survey.pass(index, motion.kind, &Path::new(start, &motion), cap);
            }
            _ => survey.arrive(index, &motion, cap),
        }
        start = Some(motion.end);
    }
    let end = Place { motion: motions.count().saturating_sub(1), s: 1.0 };
    survey.close(end, None);
    survey.stretches
}

struct Survey {
    stretches: Vec<Stretch>,
    /// phi2 so far, where it is determined.
    phi2: Option<f64>,
    open: Option<Open>,
    fallback: f64,
}

impl Survey {
    fn arrive(&mut self, index: usize, motion: &Motion, cap: &Cap) {
        self.close(Place { motion: index, s: 0.0 }, None);
        if cap.has(motion.end.axis) {
            self.open =
                Some(Open { start: Place { motion: index, s: 1.0 }, from: None, all: 0.0, rapid: 0.0 });
        } else {
            self.phi2 = Some(continued(self.phi2, of_arrival(motion)));
        }
    }

    fn pass(&mut self, index: usize, kind: MotionKind, path: &Path, cap: &Cap) {
        cap.split(path, |[from, to], inside| {
            if inside {
                let phi2 = self.phi2;
                let open = self.open.get_or_insert(Open {
                    start: Place { motion: index, s: from },
                    from: phi2,
                    all: 0.0,
                    rapid: 0.0,
                });
                let measure = cap.measure(path) * (to - from);
                open.all += measure;
                if kind == MotionKind::Rapid {
                    open.rapid += measure;
                }
            } else {
                let [start, end] = azimuths(path, [from, to]);
                self.close(Place { motion: index, s: from }, Some(start));
                let begun = continued(self.phi2, start);
                self.phi2 = Some(begun + to_nearest(end - start, TAU));
            }
        });
    }

    /// Ends the open stretch, where the path leaves the cap at this azimuth, or ends inside it.
    fn close(&mut self, end: Place, azimuth: Option<f64>) {
        let Some(open) = self.open.take() else { return };
        let exit = azimuth.map(|azimuth| continued(open.from, azimuth));
        let free = open.from.or(exit).or(self.phi2).unwrap_or(self.fallback);
        let phi2 = [open.from.unwrap_or(free), exit.unwrap_or(free)];
        let has_rapid = open.rapid > 0.0;
        let measure = if has_rapid { open.rapid } else { open.all };
        let is_bounded = open.from.is_some() && exit.is_some();
        self.stretches.push(Stretch { start: open.start, end, phi2, measure, has_rapid, is_bounded });
        self.phi2 = Some(phi2[1]);
    }
}

fn of_arrival(motion: &Motion) -> f64 {
    azimuth(motion.end.axis).unwrap_or(0.0)
}

/// The value nearest to `before` with this azimuth, modulo half turns.
fn continued(before: Option<f64>, azimuth: f64) -> f64 {
    before.map_or(azimuth, |before| before + to_nearest(azimuth - before, PI))
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
    pub(super) spans: Vec<Span>,
}

impl<'a> Meridian<'a> {
    pub(super) fn new(cap: Cap, stretches: &'a [Stretch]) -> Self {
        Self { cap, stretches, next: 0, done: 0.0, is_inside: false, phi2: None, spans: Vec::new() }
    }

    /// Arrives at a position from anywhere: a single span at parameter 1.
    pub(super) fn arrive(&mut self, motion: &Motion) {
        self.leave();
        self.spans.clear();
        let rule = if self.cap.has(motion.end.axis) {
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

    /// Moves along a path; `spans` then contains its parts.
    pub(super) fn pass(&mut self, kind: MotionKind, path: &Path) {
        let (cap, mut spans) = (self.cap, std::mem::take(&mut self.spans));
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
                let [start, end] = azimuths(path, [from, to]);
                let phi2 = continued(self.phi2, start);
                self.phi2 = Some(phi2 + to_nearest(end - start, TAU));
                Rule::Follow { azimuth: [start, end], phi2 }
            };
            spans.push(Span { from, to, rule });
        });
        self.spans = spans;
    }

    fn leave(&mut self) {
        if self.is_inside {
            self.phi2 = Some(self.stretches[self.next].phi2[1]);
            (self.is_inside, self.done) = (false, 0.0);
            self.next += 1;
        }
    }
}
