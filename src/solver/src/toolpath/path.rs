//! The exact path of one motion: position and axis of the tool for a parameter from 0 to 1.

mod tip_path;

use std::f64::consts::PI;

use nalgebra::Vector3;

use self::tip_path::TipPath;
use super::motion::{Motion, ToolPosition, Turning};
use crate::axis::tool_axis;
use crate::fast_math::{angle_of_vector, sin_cos};
use crate::pose::Point;

/// Angle of the axis or of an arc between two places that are examined, rad.
const ANGLE: f64 = 0.1;
/// Fraction of the machine's longest dimension between two places that are examined.
const LENGTH: f64 = 1.0 / 16.0;

/// The rotation of a frame that is not turned.
const PART_FRAME: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The path of a motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path {
    start: ToolPosition,
    end: ToolPosition,
    tip: TipPath,
    axis: AxisPath,
    length: f64,
    /// phi2 at both ends, if theta2 follows it also at the pole.
    held: Option<[f64; 2]>,
}

#[derive(Clone, Copy, Debug)]
enum AxisPath {
    Fixed,
    /// The great circle from the start towards a perpendicular unit vector.
    GreatCircle {
        towards: Vector3<f64>,
        angle: f64,
    },
    Angles {
        start: [f64; 2],
        end: [f64; 2],
        frame: [[f64; 3]; 3],
    },
}

impl Path {
    /// The path of a motion that begins at `start`.
    pub(super) fn new(start: ToolPosition, motion: &Motion) -> Self {
        let end = motion.end;
        let ends = [start.tip, end.tip];
        let tip = TipPath::new(motion.curve, ends);
        let axis = match motion.turning {
            Turning::GreatCircle => great_circle(start.axis, end.axis),
            Turning::Angles { start, end, .. } | Turning::Held { start, end } if start == end => {
                AxisPath::Fixed
            }
            Turning::Angles { start, end, frame } => AxisPath::Angles { start, end, frame },
            Turning::Held { start, end } => AxisPath::Angles { start, end, frame: PART_FRAME },
        };
        let held = match motion.turning {
            Turning::Held { start, end } => Some([start[1], end[1]]),
            Turning::GreatCircle | Turning::Angles { .. } => None,
        };
        Self { start, end, length: tip.length(ends), tip, axis, held }
    }

    /// The path of the same motion from another place of the tool's end.
    pub(super) fn begun_at(&self, tip: Point, motion: &Motion) -> Self {
        Self::new(ToolPosition { tip, ..self.start }, motion)
    }

    /// phi2 at both ends, if theta2 follows it also at the pole.
    pub(super) fn held(&self) -> Option<[f64; 2]> {
        self.held
    }

    /// The tool's position at a parameter. At 0 and 1 it is that of the motion's ends, to the last bit.
    pub(super) fn at(&self, s: f64) -> ToolPosition {
        if s <= 0.0 {
            return self.start;
        }
        if s >= 1.0 {
            return self.end;
        }
        ToolPosition { tip: self.tip(s).into(), axis: self.axis(s).into() }
    }

    /// The tool's end at a parameter; at 0 and 1 it is that of the motion's ends, to the last bit.
    pub(super) fn tip_at(&self, s: f64) -> Point {
        if s <= 0.0 {
            self.start.tip
        } else if s >= 1.0 {
            self.end.tip
        } else {
            self.tip(s).into()
        }
    }

    fn tip(&self, s: f64) -> Vector3<f64> {
        self.tip.at(self.tip_ends(), s)
    }

    fn tip_ends(&self) -> [Point; 2] {
        [self.start.tip, self.end.tip]
    }

    fn axis(&self, s: f64) -> Vector3<f64> {
        match &self.axis {
            AxisPath::Fixed => self.start.axis.into(),
            AxisPath::GreatCircle { towards, angle } => {
                let (sin, cos) = sin_cos(angle * s);
                Vector3::from(self.start.axis) * cos + towards * sin
            }
            AxisPath::Angles { start, end, frame } => {
                let [phi1, phi2] = [0, 1].map(|i| start[i] + (end[i] - start[i]) * s);
                rotated(frame, tool_axis(phi1, phi2)).into()
            }
        }
    }

    /// The tool's end and axis at a parameter, and their derivatives by it.
    pub(super) fn with_rates(&self, s: f64) -> ([Vector3<f64>; 2], [Vector3<f64>; 2]) {
        let (tip, tip_rate) = self.tip.with_rate(self.tip_ends(), s);
        let (axis, axis_rate) = match &self.axis {
            AxisPath::Fixed => (self.axis(s), Vector3::zeros()),
            AxisPath::GreatCircle { towards, angle } => {
                let (sin, cos) = sin_cos(angle * s);
                let start = Vector3::from(self.start.axis);
                (start * cos + towards * sin, (towards * cos - start * sin) * *angle)
            }
            AxisPath::Angles { start, end, frame } => {
                let rate = [0, 1].map(|i| end[i] - start[i]);
                let [phi1, phi2] = [0, 1].map(|i| start[i] + rate[i] * s);
                let ((s1, c1), (s2, c2)) = (sin_cos(phi1), sin_cos(phi2));
                let along = [c1 * s2, -c1 * c2, -s1].map(|c| c * rate[0]);
                let across = [s1 * c2, s1 * s2, 0.0].map(|c| c * rate[1]);
                (self.axis(s), rotated(frame, std::array::from_fn(|i| along[i] + across[i])).into())
            }
        };
        ([tip, axis], [tip_rate, axis_rate])
    }

    /// Greatest second derivatives by the parameter: of the position, mm, and of the axis, rad.
    pub(super) fn second_derivatives(&self) -> [f64; 2] {
        [self.tip.second_derivative(), self.turn() * self.turn()]
    }

    /// Length of the path of the tool's end, mm; of a helix that misses its end the length is that of the arc and the
    /// rest.
    pub(super) fn length(&self) -> f64 {
        self.length
    }

    /// Upper bound of the angle that the axis moves through, rad.
    pub(super) fn turn(&self) -> f64 {
        match self.axis {
            AxisPath::Fixed => 0.0,
            AxisPath::GreatCircle { angle, .. } => angle,
            AxisPath::Angles { start, end, .. } => (end[0] - start[0]).abs() + (end[1] - start[1]).abs(),
        }
    }

    /// Upper bound of the angle that the axis moves through between two parameters, rad. It is small where linear phi1
    /// and phi2 turn the axis about itself.
    pub(super) fn turn_between(&self, ends: [f64; 2]) -> f64 {
        let width = ends[1] - ends[0];
        match self.axis {
            AxisPath::Fixed => 0.0,
            AxisPath::GreatCircle { angle, .. } => angle * width,
            AxisPath::Angles { start, end, .. } => {
                let [inclination, azimuth] = [0, 1].map(|i| end[i] - start[i]);
                let phi1 = ends.map(|s| start[0] + inclination * s);
                // |sin phi1| has a peak between two ends with different numbers.
                let [first, last] = phi1.map(|phi1| (phi1 / PI - 0.5).floor());
                let sine =
                    if last - first == 0.0 { phi1[0].sin().abs().max(phi1[1].sin().abs()) } else { 1.0 };
                inclination.hypot(sine * azimuth) * width
            }
        }
    }

    /// Angle that the axis moves through, rad: the hypotenuse of the changes of phi1 and phi2 where these are linear.
    pub(super) fn angle(&self) -> f64 {
        match self.axis {
            AxisPath::Fixed => 0.0,
            AxisPath::GreatCircle { angle, .. } => angle,
            AxisPath::Angles { start, end, .. } => (end[0] - start[0]).hypot(end[1] - start[1]),
        }
    }

    /// Angle of the arc, rad; zero for a line.
    pub(super) fn sweep(&self) -> f64 {
        self.tip.sweep()
    }

    /// Whether the axis moves along a great circle or not at all.
    pub(super) fn is_great_circle(&self) -> bool {
        !matches!(self.axis, AxisPath::Angles { .. })
    }

    /// An upper bound of the tool's end's z.
    pub(super) fn highest(&self) -> f64 {
        self.tip.highest(self.tip_ends())
    }

    /// The axis at both ends.
    pub(super) fn end_axes(&self) -> [[f64; 3]; 2] {
        [self.start.axis, self.end.axis]
    }

    /// The parameter between 0 and 1 at which a great circle is nearest to the pole; `None` if that is an end.
    pub(super) fn nearest_to_pole(&self) -> Option<f64> {
        let AxisPath::GreatCircle { towards, angle } = &self.axis else { return None };
        let s = angle_of_vector(self.start.axis[2], towards.z) / angle;
        (s > 0.0 && s < 1.0).then_some(s)
    }

    /// Whether neither the tool's end nor its axis moves.
    pub(super) fn is_point(&self) -> bool {
        self.turn() == 0.0 && self.length() == 0.0
    }
}

/// The great circle between two unit vectors. Opposite vectors have none; programs with such motions are faulty, and
/// any circle will do here.
fn great_circle(start: [f64; 3], end: [f64; 3]) -> AxisPath {
    if start == end {
        return AxisPath::Fixed;
    }
    let (a, b) = (Vector3::from(start), Vector3::from(end));
    let (cross, dot) = (a.cross(&b), a.dot(&b));
    let sine = cross.norm();
    if sine == 0.0 {
        return AxisPath::Fixed;
    }
    AxisPath::GreatCircle { towards: (b - a * dot) / sine, angle: angle_of_vector(dot, sine) }
}

fn rotated(frame: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    frame.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// Number of places that are examined on a part of a path.
pub(super) fn places(longest: f64, path: &Path, part: f64) -> u32 {
    dense_places(longest, path, part, 1.0)
}

/// The same with `density` times as many on long parts.
pub(super) fn dense_places(longest: f64, path: &Path, part: f64, density: f64) -> u32 {
    count_of(density * way(longest, path, part))
}

/// A part of a path as a multiple of the way between two places that are examined.
pub(super) fn way(longest: f64, path: &Path, part: f64) -> f64 {
    (path.length() / (LENGTH * longest)).max((path.turn() + path.sweep()) / ANGLE) * part
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to the range of the type"
)]
pub(super) fn count_of(number: f64) -> u32 {
    number.ceil().clamp(1.0, 1e6) as u32
}
