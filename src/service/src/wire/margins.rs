//! Signed margins and the conditioning of a solution, as JSON.

use serde::Serialize;
use utoipa::ToSchema;
use verne_solver::{Machine, Margins, jacobian};

use crate::wire::degrees::to_degrees;
use crate::wire::fixed_array::{FixedArray, Pair, PairPerSlider, PerRod, Triple};
use crate::wire::limit::Limit;

/// Margins of every constraint: positive inside, zero on the limit, negative outside. Arrays of six are the rods
/// 11, 12, 21, 22, 31, 32.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Margins)]
pub(crate) struct MarginsObject {
    /// `[rho - min, max - rho]` of each slider, mm.
    #[schema(inline)]
    stroke: PairPerSlider,
    /// Vertical extent that the length of each leg leaves, mm: the signed square root of the squared length minus the
    /// squared horizontal distance.
    #[schema(inline)]
    leg_length: Triple,
    /// Cosine of the angle between rod and guideway, minus `serial_margin`.
    #[schema(inline)]
    serial_singularity: PerRod,
    /// Parallel conditioning, with the sign that it has at home, minus `parallel_margin`.
    parallel_singularity: f64,
    /// `slider_cone` minus the angle between the rod and the axis of the cone, degrees.
    #[schema(inline)]
    slider_joint: PerRod,
    /// `platform_cone` minus the angle between the rod and the axis of the cone, degrees.
    #[schema(inline)]
    platform_joint: PerRod,
    /// R1 cos alpha - r1, mm. A machine with R1 = r1 has it only where the platform turns: elsewhere the rods of leg I
    /// are parallel.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    rod_crossing: Option<f64>,
    /// Least distance between the axes of two rods, minus twice `rod_radius`, mm.
    rod_interference: f64,
    /// `[theta1 - min, max - theta1]`, degrees. Only solutions with known table angles have it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(inline, nullable = false)]
    tilt: Option<Pair>,
    /// `[theta2 - min, max - theta2]`, degrees. Only solutions with known table angles have it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(inline, nullable = false)]
    rotary: Option<Pair>,
    /// Least height of the tool's end circle and the platform's joints over the table, minus `table_clearance`, mm.
    /// Only solutions with a clearance and a known theta1 have it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    table_clearance: Option<Limit>,
    /// The worst margin: the least as a fraction of the range of its constraint.
    worst: Limit,
}

impl MarginsObject {
    /// The margins in the wire's units.
    pub(crate) fn new(machine: &Machine, margins: &Margins) -> Self {
        let range = |margins: [f64; 2]| FixedArray(margins.map(to_degrees));
        Self {
            stroke: FixedArray(margins.stroke.map(FixedArray)),
            leg_length: FixedArray(margins.leg_length),
            serial_singularity: per_rod(margins.serial_singularity),
            parallel_singularity: margins.parallel_singularity,
            slider_joint: per_rod(margins.slider_joint.map(to_degrees)),
            platform_joint: per_rod(margins.platform_joint.map(to_degrees)),
            rod_crossing: margins.rod_crossing,
            rod_interference: margins.rod_interference,
            tilt: margins.tilt.map(range),
            rotary: margins.rotary.map(range),
            table_clearance: margins.table_clearance.map(Limit::from),
            worst: margins.worst(machine).into(),
        }
    }
}

/// Distance of a solution from singularities.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Conditioning)]
pub(crate) struct ConditioningObject {
    /// Determinant of the dimensionless parallel matrix; zero at a parallel singularity.
    det: f64,
    /// Condition number of this matrix in the 2-norm; null if the matrix is singular.
    condition_number: Option<f64>,
    /// Cosine of the angle between each rod and its guideway, for the rods 11, 12, 21, 22, 31, 32; zero at a serial
    /// singularity.
    #[schema(inline)]
    serial: PerRod,
}

impl From<jacobian::Conditioning> for ConditioningObject {
    fn from(found: jacobian::Conditioning) -> Self {
        Self { det: found.det, condition_number: found.condition_number, serial: per_rod(found.serial) }
    }
}

/// The two rods of a parallelogram are parallel: what holds for one holds for the other.
fn per_rod([r11, r12, leg2, leg3]: [f64; 4]) -> PerRod {
    FixedArray([r11, r12, leg2, leg2, leg3, leg3])
}
