//! The plain numbers that describe a machine.

use super::drives::Drives;
use crate::mechanism::Geometry;

/// The tilting table's offsets, in mm (Eq (7)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Table {
    /// z of the tilting axis in the base frame.
    pub da: f64,
    /// Offset from the tilting axis to the table's origin.
    pub dt: f64,
}

/// Limits of joints and of singularities. Angles in radians, lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Range of each slider, `[min, max]`.
    pub stroke: [[f64; 2]; 3],
    /// Half-angle of the cone that each rod may use at its slider.
    pub slider_cone: f64,
    /// Half-angle of the cone that each rod may use at the platform.
    pub platform_cone: f64,
    /// Least cosine between a rod and its guideway.
    pub serial_margin: f64,
    /// Least parallel conditioning `det_P`, in the sign it has at home.
    pub parallel_margin: f64,
    /// Range of the tilting angle theta1.
    pub tilt: [f64; 2],
    /// Range of the rotary angle theta2. `None`: the table turns without a limit.
    pub rotary: Option<[f64; 2]>,
    /// Least height of the tool's end and of the platform's joints over the plane Z = 0 of the part frame, mm.
    /// `None`: the table is no limit unless the request gives a height. See [`crate::Clearance`].
    pub table_clearance: Option<f64>,
    /// Axes of the slider cones in the base frame, for rod 11, rod 12, leg II, leg III; any length but zero. `None`
    /// means the rods' own directions at home.
    pub slider_axes: Option<[[f64; 3]; 4]>,
    /// Axes of the platform cones in the platform frame, in the same order and direction (from slider to platform).
    /// `None` means the rods' own directions at home.
    pub platform_axes: Option<[[f64; 3]; 4]>,
}

/// Plain numbers that may or may not describe a valid machine. [`Machine::new`](crate::Machine::new) checks them.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineData {
    /// Short name, as used in requests.
    pub name: String,
    /// The origin of the numbers.
    pub description: String,
    /// The parallel module.
    pub geometry: Geometry,
    /// The tilting table.
    pub table: Table,
    /// The limits.
    pub limits: Limits,
    /// The drives. `None`: unknown; a program's feeds alone determine its time.
    pub drives: Option<Drives>,
}
