//! Answers of `/fk` and `/ik`.

use std::sync::Arc;

use serde::Serialize;
use utoipa::ToSchema;
use verne_solver::{PartPose, PlatformPose, Point, Posture, Side, axis};

use crate::wire::certificate::{CertificateObject, CompletenessObject};
use crate::wire::degrees::to_degrees;
use crate::wire::fixed_array::{FixedArray, Triple};
use crate::wire::jacobian::JacobianObject;
use crate::wire::limit::{Limit, Unchecked};
use crate::wire::margins::{ConditioningObject, MarginsObject};
use crate::wire::request::Joints;
use crate::wire::windings::Windings;

/// The machine of an answer.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct MachineId {
    /// Name of the machine.
    #[schema(value_type = String, example = "verne")]
    pub name: Arc<str>,
    /// BLAKE3 hash of its geometry, table and limits; it does not cover name and description.
    #[schema(value_type = String)]
    pub hash: Arc<str>,
}

/// The requested solutions in order, or the reason why there is none.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct Answer {
    /// The machine.
    pub machine: MachineId,
    /// Working solutions first, then in order of alpha, then of rho; with `near`, in order of distance from it.
    pub solutions: Vec<Solution>,
    /// Whether it is proved that there are no other solutions. Only with `certified` in the request.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub completeness: Option<CompletenessObject>,
    /// Conditions that the service did not check.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Coordinates that the pose does not determine. `phi2`: the tool is parallel to the table's own axis. The
    /// solutions are then one member of a family: the one at theta2 = `near.theta2`, or 0.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub free: Vec<Free>,
    /// The reason why there is no solution. Only an answer without solutions has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub reason: Option<Reason>,
    /// The constraint that prevents a solution, with its margin. Only an answer without solutions has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub constraint: Option<Limit>,
}

/// A coordinate that a pose does not determine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Free {
    /// Azimuth of the tool.
    Phi2,
}

/// Reason why a request has no solution: `unreachable`, the equations have no solution of the requested kind;
/// `infeasible`, every working solution breaks a limit and the request allows only feasible ones; `self_motion`, the
/// platform can move while all sliders are locked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Reason {
    /// The equations have no solution of the requested kind.
    Unreachable,
    /// Every working solution breaks a limit, and the request allows only feasible ones.
    Infeasible,
    /// The platform can move while all sliders are locked.
    SelfMotion,
}

/// One solution. The service checks each solution in the loop-closure equations.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct Solution {
    /// The joints. Only answers of /ik have them; only answers in frame `part` have theta1 and theta2.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub joints: Option<Joints>,
    /// The platform in the base frame.
    pub platform: PlatformObject,
    /// The tool end in the base frame.
    pub tool: PointObject,
    /// The tool in the part frame. Only solutions with known table angles have it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub part: Option<PartObject>,
    /// How many values theta2 + 360 n, n a whole number, are within the machine's rotary range; 0 if none is, null if
    /// the range has no limit. Only answers of /ik in frame `part` have it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<u32>)]
    pub windings: Option<Windings>,
    /// The solution's label.
    pub mode: ModeObject,
    /// Whether the solution is in the working mode: the slider end of every rod is above its platform end, and leg I is
    /// not crossed.
    pub working: bool,
    /// Whether two solutions coincide here within double precision. The posture is then singular.
    pub merged: bool,
    /// Whether every margin is at least zero.
    pub feasible: bool,
    /// Margins of all limits.
    pub margins: MarginsObject,
    /// Distance from singularities.
    pub conditioning: ConditioningObject,
    /// Jacobian of the tool in the part frame, whatever the frame of the request. Only with `jacobian` in the request.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub jacobian: Option<JacobianObject>,
    /// Largest error of a rod length when the solution is inserted into Eqs (3)-(6), mm.
    pub residual: f64,
    /// The proof of the solution. Only with `certified` in the request.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub certificate: Option<CertificateObject>,
}

/// Pose of the platform in the base frame.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = PlatformPose)]
pub(crate) struct PlatformObject {
    /// x, mm.
    x: f64,
    /// y, mm.
    y: f64,
    /// z, mm. It points down.
    z: f64,
    /// Rotation about x, degrees.
    pub alpha: f64,
}

/// A point, mm.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Point)]
pub(crate) struct PointObject {
    x: f64,
    y: f64,
    z: f64,
}

/// Pose of the tool in the part frame.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = PartPose)]
pub(crate) struct PartObject {
    /// x, mm.
    x: f64,
    /// y, mm.
    y: f64,
    /// z, mm. It points up from the table.
    z: f64,
    /// Inclination, degrees.
    phi1: f64,
    /// Azimuth, degrees.
    phi2: f64,
    /// Unit vector from the tool end to the holder.
    #[schema(inline)]
    axis: Triple,
}

/// Label of a solution.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Mode)]
pub(crate) struct ModeObject {
    /// Whether the slider of leg I is above or below the platform.
    leg1: SideName,
    /// Whether the slider of leg II is above or below the platform.
    leg2: SideName,
    /// Whether the slider of leg III is above or below the platform.
    leg3: SideName,
    /// Whether R1 cos alpha < r1.
    crossed: bool,
    /// Number of the solution among those with equal labels: 0, 1, ... in the order working, alpha, rho.
    index: usize,
}

/// Higher end of a leg.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum SideName {
    /// The slider.
    Above,
    /// The platform.
    Below,
}

impl From<PlatformPose> for PlatformObject {
    fn from(pose: PlatformPose) -> Self {
        Self { x: pose.x, y: pose.y, z: pose.z, alpha: to_degrees(pose.alpha) }
    }
}

impl From<Point> for PointObject {
    fn from([x, y, z]: Point) -> Self {
        Self { x, y, z }
    }
}

impl From<PartPose> for PartObject {
    fn from(pose: PartPose) -> Self {
        let axis = FixedArray(axis::tool_axis(pose.phi1, pose.phi2).map(|cosine| cosine + 0.0));
        let (phi1, phi2) = (to_degrees(pose.phi1), to_degrees(pose.phi2));
        Self { x: pose.x, y: pose.y, z: pose.z, phi1, phi2, axis }
    }
}

impl ModeObject {
    /// The label of a posture, with the index that the order gives it.
    pub(crate) fn new(posture: &Posture, index: usize) -> Self {
        let [leg1, leg2, leg3] = posture.mode.legs.map(|side| match side {
            Side::Above => SideName::Above,
            Side::Below => SideName::Below,
        });
        Self { leg1, leg2, leg3, crossed: posture.mode.crossed, index }
    }
}
