//! The map from the platform's position to the workspace.

use super::column::Column;
use super::request::{Kind, Request};
use crate::machine::{Machine, Table};
use crate::pose::Point;

/// |cos theta1| below which a plane Z = const of the part frame counts as parallel to a column.
const PARALLEL: f64 = 1e-12;
/// Distance at which a parallel plane is taken to meet a column, mm: beyond every stroke.
const FAR: f64 = 1e15;

/// The map of each kind. It is linear in z along a column, and so is its Jacobian determinant.
#[derive(Clone, Copy, Debug)]
pub(super) enum Image {
    /// P itself.
    Platform,
    /// Eq (27).
    Tool { length: f64 },
    /// Eq (26), theta1 = alpha - phi1 and theta2 = -phi2.
    Part { length: f64, table: Table, phi1: [f64; 2], phi2: [f64; 2] },
}

impl Image {
    pub(super) fn new(machine: &Machine, request: &Request) -> Self {
        let turn = |angle: f64| [angle.cos(), angle.sin()];
        let length = request.tool_length;
        match request.kind {
            Kind::Platform => Self::Platform,
            Kind::Tool => Self::Tool { length },
            Kind::Part => Self::Part {
                length,
                table: *machine.table(),
                phi1: turn(request.phi1),
                phi2: turn(request.phi2),
            },
        }
    }

    /// Whether the map turns columns, so that their images are not parallel.
    pub(super) fn turns_columns(&self) -> bool {
        matches!(self, Self::Part { .. })
    }

    #[inline]
    pub(super) fn point(&self, column: &Column, z: f64) -> Point {
        match self {
            Self::Platform => [column.x, column.y, z],
            Self::Tool { length } => [column.x, column.y - length * column.s, z + length * column.c],
            Self::Part { length, table, phi1, phi2: [c2, s2] } => {
                let [c1, s1] = tilt(column, *phi1);
                let height = z - table.da;
                let v1 = length * phi1[1] - column.y * c1 - height * s1;
                [
                    column.x * c2 - v1 * s2,
                    column.x * s2 + v1 * c2,
                    column.y * s1 + table.dt - height * c1 - length * phi1[0],
                ]
            }
        }
    }

    /// The z at which the column meets the plane Z = `height` of the image's own frame.
    pub(super) fn z_at(&self, column: &Column, height: f64) -> f64 {
        match self {
            Self::Platform => height,
            Self::Tool { length } => height - length * column.c,
            Self::Part { length, table, phi1, .. } => {
                let [c1, s1] = tilt(column, *phi1);
                let over = table.dt - height - length * phi1[0] + column.y * s1;
                if c1.abs() > PARALLEL { table.da + over / c1 } else { FAR.copysign(over * c1) }
            }
        }
    }

    /// Whether a column's points with less z are higher over the table.
    #[inline]
    pub(super) fn upright(&self, column: &Column) -> bool {
        match self {
            Self::Platform | Self::Tool { .. } => true,
            Self::Part { phi1, .. } => tilt(column, *phi1)[0] >= 0.0,
        }
    }

    /// The Jacobian determinant as j0 + j1 z, given d(alpha)/dy.
    #[inline]
    pub(super) fn determinant(&self, column: &Column, ay: f64) -> [f64; 2] {
        match self {
            Self::Platform => [1.0, 0.0],
            Self::Tool { length } => [1.0 - length * column.c * ay, 0.0],
            Self::Part { table, .. } => [1.0 - ay * table.da, ay],
        }
    }

    /// The differential of the map: d(point) for a displacement (dx, dy, dz) with the rotation da of the platform.
    #[inline]
    pub(super) fn differential(&self, column: &Column, z: f64, [dx, dy, dz]: Point, da: f64) -> Point {
        match self {
            Self::Platform => [dx, dy, dz],
            Self::Tool { length } => [dx, dy - length * column.c * da, dz - length * column.s * da],
            Self::Part { table, phi1, phi2: [c2, s2], .. } => {
                let [c1, s1] = tilt(column, *phi1);
                let height = z - table.da;
                let v1 = -dy * c1 + column.y * s1 * da - dz * s1 - height * c1 * da;
                let up = dy * s1 + column.y * c1 * da - dz * c1 + height * s1 * da;
                [dx * c2 - v1 * s2, dx * s2 + v1 * c2, up]
            }
        }
    }
}

/// cos theta1 and sin theta1, theta1 = alpha - phi1.
#[inline]
fn tilt(column: &Column, [cp, sp]: [f64; 2]) -> [f64; 2] {
    [column.c * cp + column.s * sp, column.s * cp - column.c * sp]
}
