//! The position of the platform for each of its angles, with bounds of all numbers.

use super::enclosure::Enclosure;
use super::orientation::EnclosedOrientation;
use crate::machine::Machine;
use crate::pose::Point;

/// P = (x, y0 + yc cos a + ys sin a, z0 + zc cos a + zs sin a), as in the inverse problem.
#[derive(Clone, Copy, Debug)]
pub(super) struct EnclosedLocus {
    pub(super) x: Enclosure,
    pub(super) y: [Enclosure; 3],
    pub(super) z: [Enclosure; 3],
}

impl EnclosedLocus {
    /// A platform that stays at one point.
    pub(super) fn fixed(point: Point) -> Self {
        Self::tool(point, 0.0)
    }

    /// The tool centre point is given in the base frame: Eq (27) solved for P.
    pub(super) fn tool(point: Point, tool_length: f64) -> Self {
        let ([x, y, z], length) = (point.map(Enclosure::of), Enclosure::of(tool_length));
        Self { x, y: [y, Enclosure::ZERO, length], z: [z, -length, Enclosure::ZERO] }
    }

    /// The tool's pose is given in the part frame: Eq (26) solved for P with theta2 = -phi2 (9) and
    /// theta1 = a - phi1 (14).
    pub(super) fn part(
        machine: &Machine,
        point: Point,
        &EnclosedOrientation { phi1: [c1, s1], phi2: [c2, s2] }: &EnclosedOrientation,
        tool_length: f64,
    ) -> Self {
        let ([x, y, z], table) = (point.map(Enclosure::of), machine.table());
        let a = s1.times(tool_length) - (y * c2 - x * s2);
        let b = Enclosure::of(table.dt) - z - c1.times(tool_length);
        let (along, across) = (a * c1 + b * s1, a * s1 - b * c1);
        Self {
            x: x * c2 + y * s2,
            y: [Enclosure::ZERO, along, across],
            z: [Enclosure::of(table.da), -across, along],
        }
    }

    /// y and z at an angle's cosine and sine.
    pub(super) fn at(&self, [c, s]: [Enclosure; 2]) -> [Enclosure; 2] {
        [self.y, self.z].map(|[constant, cos, sin]| constant + cos * c + sin * s)
    }

    /// The derivatives of y and z.
    pub(super) fn slopes(&self, [c, s]: [Enclosure; 2]) -> [Enclosure; 2] {
        [self.y, self.z].map(|[_, cos, sin]| sin * c - cos * s)
    }
}
