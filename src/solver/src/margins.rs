//! Signed margins of a posture against every constraint: positive inside, zero on the limit.

use crate::limit::Margin;
use crate::machine::Machine;
use crate::pose::TableAngles;
use crate::posture::Posture;

/// All margins of one posture. Arrays of four are rod 11, rod 12, the rods of leg II, the rods of
/// leg III (a parallelogram's two rods are parallel).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// `[rho - min, max - rho]` of each slider, mm.
    pub stroke: [[f64; 2]; 3],
    /// Signed root of what each leg's length leaves for its drop along z, mm.
    pub leg_length: [f64; 3],
    /// Cosine between rod and guideway less the limit.
    pub serial_singularity: [f64; 4],
    /// `det_P` in the sign of home less the limit.
    pub parallel_singularity: f64,
    /// Cone half-angle less the rod's angle from its axis at the slider, rad.
    pub slider_joint: [f64; 4],
    /// Cone half-angle less the rod's angle from its axis at the platform, rad.
    pub platform_joint: [f64; 4],
    /// R1 cos alpha - r1, mm.
    pub rod_crossing: f64,
    /// Least distance between the axes of two rods less twice the rod radius, mm.
    pub rod_interference: f64,
    /// The two rods that are nearest to each other.
    pub nearest_rods: [u8; 2],
    /// `[theta1 - min, max - theta1]`, where the table takes part, rad.
    pub tilt: Option<[f64; 2]>,
    /// `[theta2 - min, max - theta2]`, where the table takes part, rad.
    pub rotary: Option<[f64; 2]>,
}

impl Margins {
    /// The margins of a posture, with the table's where it takes part.
    pub fn of(machine: &Machine, posture: &Posture, table: Option<TableAngles>) -> Self {
        let _ = (machine, posture, table);
        unimplemented!()
    }

    /// Whether every margin is at least zero.
    pub fn feasible(&self) -> bool {
        unimplemented!()
    }

    /// The worst margin: the least one as a fraction of its constraint's own range (stroke, rod
    /// length, cone half-angle, value at home, ...), so that lengths and angles compare.
    pub fn worst(&self, machine: &Machine) -> Margin {
        let _ = machine;
        unimplemented!()
    }
}
