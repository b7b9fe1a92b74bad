//! The exact path of the tool's end in one motion: a line, or an arc or a helix.

use nalgebra::Vector3;

use crate::fast_math::sin_cos;
use crate::pose::Point;
use crate::toolpath::motion::Curve;

/// The path between two points. The points themselves are arguments of its functions.
#[derive(Clone, Copy, Debug)]
pub(super) enum TipPath {
    Line,
    Arc {
        centre: Vector3<f64>,
        /// Radius vector at the start, and perpendicular to it; the part along the normal stays.
        radius: [Vector3<f64>; 2],
        along: Vector3<f64>,
        sweep: f64,
        /// What the end misses the arc by.
        rest: Vector3<f64>,
    },
}

impl TipPath {
    pub(super) fn new(curve: Curve, [start, end]: [Point; 2]) -> Self {
        match curve {
            Curve::Line => Self::Line,
            Curve::Arc { centre, normal, sweep } => {
                let (centre, normal) = (Vector3::from(centre), Vector3::from(normal));
                let from = Vector3::from(start) - centre;
                let along = normal * normal.dot(&from);
                let radial = from - along;
                let radius = [radial, normal.cross(&radial)];
                let (sin, cos) = sin_cos(sweep);
                let rest = Vector3::from(end) - (centre + along + radius[0] * cos + radius[1] * sin);
                Self::Arc { centre, radius, along, sweep, rest }
            }
        }
    }

    /// Length, mm; of a helix that misses its end the length is that of the arc and the rest.
    pub(super) fn length(&self, [start, end]: [Point; 2]) -> f64 {
        match self {
            Self::Line => (Vector3::from(end) - Vector3::from(start)).norm(),
            Self::Arc { radius, sweep, rest, .. } => (radius[0].norm() * sweep).hypot(rest.norm()),
        }
    }

    /// The point at a parameter.
    pub(super) fn at(&self, [start, end]: [Point; 2], s: f64) -> Vector3<f64> {
        match self {
            Self::Line => {
                let (a, b) = (Vector3::from(start), Vector3::from(end));
                a + (b - a) * s
            }
            Self::Arc { centre, radius, along, sweep, rest } => {
                let (sin, cos) = sin_cos(sweep * s);
                centre + along + radius[0] * cos + radius[1] * sin + rest * s
            }
        }
    }

    /// The point at a parameter, and its derivative by it.
    pub(super) fn with_rate(&self, ends: [Point; 2], s: f64) -> (Vector3<f64>, Vector3<f64>) {
        match self {
            Self::Line => (self.at(ends, s), Vector3::from(ends[1]) - Vector3::from(ends[0])),
            Self::Arc { centre, radius, along, sweep, rest } => {
                let (sin, cos) = sin_cos(sweep * s);
                let tip = centre + along + radius[0] * cos + radius[1] * sin + rest * s;
                (tip, (radius[1] * cos - radius[0] * sin) * *sweep + rest)
            }
        }
    }

    /// Greatest second derivative by the parameter, mm.
    pub(super) fn second_derivative(&self) -> f64 {
        match self {
            Self::Line => 0.0,
            Self::Arc { radius, sweep, .. } => radius[0].norm() * sweep * sweep,
        }
    }

    /// Angle of the arc, rad; zero for a line.
    pub(super) fn sweep(&self) -> f64 {
        match self {
            Self::Line => 0.0,
            Self::Arc { sweep, .. } => *sweep,
        }
    }

    /// An upper bound of z.
    pub(super) fn highest(&self, [start, end]: [Point; 2]) -> f64 {
        let ends = start[2].max(end[2]);
        match self {
            Self::Line => ends,
            Self::Arc { centre, radius, along, rest, .. } => {
                ends.max(centre.z + along.z + radius[0].z.hypot(radius[1].z) + rest.z.max(0.0))
            }
        }
    }
}
