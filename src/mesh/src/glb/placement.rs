//! The map from the object's frame to glTF's.

use crate::Bounds;
use crate::vector::single;

/// The direction that is up in the object's frame. Both rotations into glTF's frame are about x, without reflection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Up {
    /// z points up: (x, y, z) becomes (x, z, -y).
    PositiveZ,
    /// z points down: (x, y, z) becomes (x, -z, y).
    NegativeZ,
}

impl Up {
    fn rotate(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            Self::PositiveZ => [x, z, -y],
            Self::NegativeZ => [x, -z, y],
        }
    }
}

/// The frame of a GLB's vertices: metres, Y up, about the object's middle.
///
/// Single precision is finest near zero. So the node is at the middle of the object, and the vertices are relative to
/// it.
pub(super) struct Placement {
    up: Up,
    /// The node's translation, m. On a grid, so that every reader adds back what was subtracted here.
    pub(super) translation: [f32; 3],
}

impl Placement {
    pub(super) fn new(up: Up, bounds: Bounds) -> Self {
        let middle = up.rotate(bounds.centre());
        let translation = single(middle.map(|mm| (mm * METRES * GRID).round() / GRID));
        Self { up, translation }
    }

    /// A vertex, in metres from the node.
    pub(super) fn position(&self, point: [f64; 3]) -> [f32; 3] {
        let rotated = self.up.rotate(point);
        let [x, y, z] = self.translation.map(f64::from);
        single([rotated[0] * METRES - x, rotated[1] * METRES - y, rotated[2] * METRES - z])
    }

    /// A unit vector.
    pub(super) fn direction(&self, unit: [f64; 3]) -> [f32; 3] {
        single(self.up.rotate(unit))
    }
}

const METRES: f64 = 1e-3;

/// Steps per metre of the node's translation. Sixty-fourths are exact in single precision and in the few decimals
/// with which a single is written; thousandths are neither.
const GRID: f64 = 64.0;

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use super::{Placement, Up};
    use crate::Bounds;

    #[test]
    fn both_rotations_keep_handedness_and_put_up_at_y() {
        for (up, z) in [(Up::PositiveZ, 1.0), (Up::NegativeZ, -1.0)] {
            let [i, j, k] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| up.rotate(axis));
            assert_eq!(crate::vector::cross(i, j), k);
            assert_eq!(up.rotate([0.0, 0.0, z]), [0.0, 1.0, 0.0]);
        }
    }

    #[test]
    fn translation_plus_vertex_is_the_position() {
        let placement = Placement::new(
            Up::NegativeZ,
            Bounds { min: [-407.0, -540.5, 870.6], max: [392.0, 540.5, 1627.0] },
        );
        let vertex = placement.position([100.1, -200.2, 1500.3]);
        let written = serde_json::to_string(&placement.translation).unwrap();
        let read: [f64; 3] = serde_json::from_str(&written).unwrap();
        assert_eq!(read, placement.translation.map(f64::from), "{written}");
        for (axis, wanted) in [0.1001, -1.5003, -0.2002].into_iter().enumerate() {
            let found = f64::from(vertex[axis]) + read[axis];
            assert!((found - wanted).abs() < 2e-8, "{found} is not {wanted}");
        }
    }
}
