//! The stretches of a program inside the cap around the pole.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::azimuth::{Azimuths, continued, of_arrival, to_nearest};
use super::cap::Cap;
use super::motion::{Motion, MotionKind, Motions, Standstill, ToolPosition, Turning};
use super::path::Path;

/// Measure, relative to the machine's longest dimension, of a stretch that is a point.
const LEAST_MEASURE: f64 = 1e-8;

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
    pub(super) measure: f64,
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

struct Open {
    start: Place,
    from: Option<f64>,
    all: f64,
    rapid: f64,
}

/// Finds the stretches inside the cap of a program that begins at a standstill, with phi2 there if it is known.
pub(super) fn stretches(
    motions: &dyn Motions,
    cap: &Cap,
    (mut standstill, phi2): (Standstill, Option<f64>),
) -> Vec<Stretch> {
    let mut survey =
        Survey { stretches: Vec::new(), phi2, open: None, scale: cap.scale, azimuths: Azimuths::default() };
    for index in 0..motions.count() {
        let motion = motions.motion(index);
        match standstill.advance(&motion) {
            Some(start) => {
                if survey.open.is_some() || !survey.stays_outside(&start, &motion, cap) {
                    survey.pass(index, motion.kind, &Path::new(start, &motion), cap);
                }
            }
            None => survey.arrive(index, &motion, cap),
        }
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
    scale: f64,
    azimuths: Azimuths,
}

impl Survey {
    fn arrive(&mut self, index: usize, motion: &Motion, cap: &Cap) {
        self.close(Place { motion: index, s: 0.0 }, None);
        if cap.has(motion.end.axis) && !matches!(motion.turning, Turning::Held { .. }) {
            self.open =
                Some(Open { start: Place { motion: index, s: 1.0 }, from: None, all: 0.0, rapid: 0.0 });
        } else {
            self.phi2 = Some(continued(self.phi2, of_arrival(motion)));
        }
    }

    /// Follows phi2 along a motion that clearly stays outside the cap, as most do; otherwise nothing happens.
    fn stays_outside(&mut self, start: &ToolPosition, motion: &Motion, cap: &Cap) -> bool {
        let axes = [start.axis, motion.end.axis];
        let chord = (0..3).map(|i| (axes[1][i] - axes[0][i]).powi(2)).sum::<f64>().sqrt();
        // The arc of a great circle is at most π/2 times its chord.
        if motion.turning != Turning::GreatCircle || !cap.is_clear(axes, FRAC_PI_2 * chord) {
            return false;
        }
        let [Some(start), Some(end)] = self.azimuths.between(axes) else { return false };
        self.follow(start, end);
        true
    }

    fn follow(&mut self, start: f64, end: f64) {
        let begun = continued(self.phi2, start);
        self.phi2 = Some(begun + to_nearest(end - start, TAU));
    }

    fn pass(&mut self, index: usize, kind: MotionKind, path: &Path, cap: &Cap) {
        if let Some([start, end]) = path.held() {
            self.close(Place { motion: index.saturating_sub(1), s: 1.0 }, Some(start));
            self.phi2 = Some(continued(self.phi2, start) + (end - start));
            return;
        }
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
                let [start, end] = self.azimuths.of(path, [from, to]);
                self.close(Place { motion: index, s: from }, Some(start));
                self.follow(start, end);
            }
        });
    }

    /// Ends the open stretch, where the path leaves the cap at this azimuth, or ends inside it.
    fn close(&mut self, end: Place, azimuth: Option<f64>) {
        let Some(open) = self.open.take() else { return };
        let exit = azimuth.map(|azimuth| continued(open.from, azimuth));
        let free = open.from.or(exit).or(self.phi2).unwrap_or(0.0);
        let phi2 = [open.from.unwrap_or(free), exit.unwrap_or(free)];
        let has_rapid = open.rapid > 0.0;
        let measure = if has_rapid { open.rapid } else { open.all };
        let measure = if measure < LEAST_MEASURE * self.scale { 0.0 } else { measure };
        let is_bounded = open.from.is_some() && exit.is_some();
        self.stretches.push(Stretch { start: open.start, end, phi2, measure, has_rapid, is_bounded });
        self.phi2 = Some(phi2[1]);
    }
}
