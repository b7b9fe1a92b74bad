//! The Jacobian of a solution: in requests, in answers, and as columns of batches.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use verne_solver::jacobian::{GreatestSpeed, Singularity};

use crate::wire::field_errors::FieldErrors;
use crate::wire::fixed_array::{FixedArray, Triple};

/// Least and greatest characteristic length, mm.
const LENGTHS: [f64; 2] = [1e-3, 1e7];

/// One number for each joint.
pub(crate) type PerJoint = FixedArray<f64, 5>;
/// Five rows of five numbers.
pub(crate) type MatrixObject = FixedArray<PerJoint, 5>;

/// The joints.
const JOINTS: [JointName; 5] =
    [JointName::Rho1, JointName::Rho2, JointName::Rho3, JointName::Theta1, JointName::Theta2];

/// The Jacobian: from the rates of the joints to those of the tool in the part frame.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Jacobian)]
pub(crate) struct JacobianObject {
    /// The matrix, row by row; null at a parallel singularity.
    #[schema(inline)]
    pub matrix: Option<MatrixObject>,
    /// The rates that the rows give: velocity of the tool end along x, y and z of the part frame, phi1', and
    /// sin(phi1) phi2'.
    #[schema(value_type = Vec<Rate>)]
    pub rows: &'static [Rate],
    /// The rates that the columns belong to: rho1', rho2', rho3', theta1', theta2'.
    #[schema(value_type = Vec<Rate>)]
    pub columns: &'static [Rate],
    /// Length by which lengths are divided before the singular values are computed, mm: that of the request, or R1.
    pub characteristic_length: f64,
    /// Singular values of the dimensionless matrix, the greatest first; null at a parallel singularity.
    #[schema(inline)]
    pub singular_values: Option<PerJoint>,
    /// Greatest singular value over the least; null at a singularity.
    pub condition_number: Option<f64>,
    /// The reasons why `condition_number` is null. Empty for a regular posture.
    pub singularities: Vec<SingularityName>,
    /// Determinant of the dimensionless parallel matrix, as `conditioning.det`.
    pub det_p: f64,
    /// Greatest speeds of the tool end along x, y and z of the part frame, in both senses, while the other two
    /// components and the tool's axis stand still; null at a singularity other than the pole. Only a machine with
    /// drives has them.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<GreatestSpeedsObject>)]
    #[expect(clippy::option_option, reason = "absent without drives, null at a singularity")]
    pub greatest_speeds: Option<Option<GreatestSpeedsObject>>,
    /// Error of the tool end for a small error of each joint; null at a parallel singularity.
    pub error_amplification: Option<ErrorAmplification>,
}

/// A rate, with its unit.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
pub(crate) struct Rate {
    /// `x`, `y`, `z`, `phi1`, `sin_phi1_phi2`: sin(phi1) times the rate of phi2; or the joint `rho1` to `theta2`.
    pub name: &'static str,
    /// `mm/s` or `rad/s`.
    pub unit: &'static str,
}

/// The rates of the rows.
pub(crate) const ROWS: [Rate; 5] =
    [linear("x"), linear("y"), linear("z"), angular("phi1"), angular("sin_phi1_phi2")];
/// The rates of the columns.
pub(crate) const COLUMNS: [Rate; 5] =
    [linear("rho1"), linear("rho2"), linear("rho3"), angular("theta1"), angular("theta2")];

const fn linear(name: &'static str) -> Rate {
    Rate { name, unit: "mm/s" }
}

const fn angular(name: &'static str) -> Rate {
    Rate { name, unit: "rad/s" }
}

/// A singularity: `parallel_singularity`, the platform can move while the joints stand still; `pole`, phi1 is zero, and
/// theta2 turns the tool's axis about itself; `inverse_singularity`, the joints can move while the tool end and the
/// axis stand still, because a rod is perpendicular to its guideway or two inverse solutions coincide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Singularity)]
pub(crate) enum SingularityName {
    /// The platform can move while the joints stand still.
    ParallelSingularity,
    /// phi1 is zero.
    Pole,
    /// The joints can move while the tool end and the axis stand still, away from the pole.
    InverseSingularity,
}

impl From<Singularity> for SingularityName {
    fn from(singularity: Singularity) -> Self {
        match singularity {
            Singularity::Parallel => Self::ParallelSingularity,
            Singularity::Pole => Self::Pole,
            Singularity::Inverse => Self::InverseSingularity,
        }
    }
}

/// Greatest speeds of the tool end along the axes of the part frame.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[schema(as = GreatestSpeeds)]
pub(crate) struct GreatestSpeedsObject {
    /// Along x.
    x: GreatestSpeedObject,
    /// Along y.
    y: GreatestSpeedObject,
    /// Along z.
    z: GreatestSpeedObject,
}

/// The greatest speed in one direction.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[schema(as = GreatestSpeed)]
pub(crate) struct GreatestSpeedObject {
    /// Speed, mm/s.
    speed: f64,
    /// The joint whose drive limits it.
    joint: JointName,
}

/// A joint.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum JointName {
    /// The first slider.
    Rho1,
    /// The second slider.
    Rho2,
    /// The third slider.
    Rho3,
    /// The tilting axis.
    Theta1,
    /// The rotary axis.
    Theta2,
}

impl From<[GreatestSpeed; 3]> for GreatestSpeedsObject {
    fn from(speeds: [GreatestSpeed; 3]) -> Self {
        let [x, y, z] = speeds.map(|GreatestSpeed { speed, joint }| GreatestSpeedObject {
            speed,
            joint: JOINTS.get(joint).copied().unwrap_or(JointName::Theta2),
        });
        Self { x, y, z }
    }
}

/// How far the tool end moves, µm, if one joint is off: a slider by 1 µm, an axis of the table by 1 arcsecond.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
pub(crate) struct ErrorAmplification {
    /// rho1 is off by 1 µm.
    pub rho1: f64,
    /// rho2 is off by 1 µm.
    pub rho2: f64,
    /// rho3 is off by 1 µm.
    pub rho3: f64,
    /// theta1 is off by 1″.
    pub theta1: f64,
    /// theta2 is off by 1″.
    pub theta2: f64,
}

/// Columns of the Jacobian in a batch: `condition`, `det_p`, the condition number and, with drives, the greatest
/// speeds; `matrix`, the matrix, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub(crate) enum JacobianColumns {
    /// `det_p`, the condition number and, with drives, the greatest speeds.
    Condition,
    /// The matrix, too.
    Matrix,
}

/// The Jacobians of a batch, as columns with one entry for each row. An entry is null for a row without a solution and
/// at a singularity.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct JacobianLists {
    /// Length by which lengths are divided before the condition number is computed, mm: that of the request, or R1.
    pub characteristic_length: f64,
    /// Determinant of the dimensionless parallel matrix.
    pub det_p: Vec<Option<f64>>,
    /// Condition number of the dimensionless Jacobian.
    pub condition_number: Vec<Option<f64>>,
    /// `[x, y, z]`: greatest speeds of the tool end along the axes of the part frame, mm/s, while the other components
    /// and the tool's axis stand still. Only a machine with drives has them.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Vec<Option<Vec<f64>>>>, nullable = false)]
    pub greatest_speeds: Option<Vec<Option<Triple>>>,
    /// The matrix, row by row, with the units of `solutions[].jacobian` of /ik. Only with `"jacobian": "matrix"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Vec<Option<Vec<Vec<f64>>>>>, nullable = false)]
    pub matrix: Option<Vec<Option<MatrixObject>>>,
}

/// Checks the fields `jacobian` and `characteristic_length`. `lacking` describes what the request lacks to determine
/// the table's angles, if it lacks that.
pub(crate) fn check_jacobian(
    is_requested: bool,
    characteristic_length: Option<f64>,
    lacking: Option<&str>,
    faults: &mut FieldErrors,
) {
    if let Some(lacking) = lacking.filter(|_| is_requested) {
        faults.add("/jacobian", format!("{lacking}: its rows are velocities in the part frame"));
    }
    let [least, most] = LENGTHS;
    match characteristic_length {
        Some(_) if !is_requested => faults.add("/characteristic_length", "is allowed only with jacobian"),
        Some(length) if !(least..=most).contains(&length) => {
            faults.add("/characteristic_length", format!("must be a number from {least} to {most:e} mm"));
        }
        _ => {}
    }
}
