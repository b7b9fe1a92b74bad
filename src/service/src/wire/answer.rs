//! Answers of `/fk` and `/ik`.

use std::sync::Arc;

use serde::Serialize;
use utoipa::ToSchema;
use verne_solver::{PartPose, PlatformPose, Point, Posture, Side, axis};

use super::degrees::to_degrees;
use super::limit::{Limit, Unchecked};
use super::margins::{ConditioningObject, MarginsObject};
use super::numbers::{Exactly, Triple};
use super::request::Joints;

/// The machine that an answer is for.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct MachineId {
    /// Its name.
    #[schema(value_type = String, example = "verne")]
    pub name: Arc<str>,
    /// BLAKE3 of its geometry, table and limits; name and description do not count.
    #[schema(value_type = String)]
    pub hash: Arc<str>,
}

/// All that was asked for, sorted; or why there is nothing.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct Answer {
    /// The machine.
    pub machine: MachineId,
    /// Working first, then by alpha, then by rho; or by distance from `near`.
    pub solutions: Vec<Solution>,
    /// What was not checked.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// What the pose leaves open. `phi2`: the tool stands along the table's own axis, and these solutions are one
    /// member of a family, the one at theta2 = `near.theta2`, or 0.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub free: Vec<Free>,
    /// Why there is no solution; only without solutions.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub reason: Option<Reason>,
    /// The constraint that prevents a solution, and by how much; only without solutions.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub constraint: Option<Limit>,
}

/// A coordinate that a pose leaves open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Free {
    /// Azimuth of the tool.
    Phi2,
}

/// Why a question has no solution: `unreachable`, the equations have none of the kind asked for; `infeasible`, every
/// working one breaks a limit and only feasible ones were asked for; `self_motion`, the sliders do not hold the
/// platform.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Reason {
    /// The equations have no solution of the kind asked for.
    Unreachable,
    /// Every working solution breaks a limit, and only feasible ones were asked for.
    Infeasible,
    /// The sliders do not hold the platform: it moves with all of them locked.
    SelfMotion,
}

/// One solution, put back into the equations.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct Solution {
    /// The joints; in answers of /ik. theta1 and theta2 only in frame `part`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub joints: Option<Joints>,
    /// The platform in the base frame.
    pub platform: PlatformObject,
    /// The tool's tip in the base frame.
    pub tool: PointObject,
    /// The tool in the table frame; where the table's angles are known.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub part: Option<PartObject>,
    /// The solution's label.
    pub mode: ModeObject,
    /// Whether this is the mode the machine works in: every slider end above its platform end, rods uncrossed.
    pub working: bool,
    /// Whether two solutions have merged here, as closely as double precision can tell: a singularity.
    pub merged: bool,
    /// Whether every margin is at least zero.
    pub feasible: bool,
    /// How far every limit is.
    pub margins: MarginsObject,
    /// How far singularities are.
    pub conditioning: ConditioningObject,
    /// Largest error of a rod's length when the solution is put back into Eqs (3)-(6), mm.
    pub residual: f64,
}

/// Pose of the platform in the base frame.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = PlatformPose)]
pub(crate) struct PlatformObject {
    /// mm.
    x: f64,
    /// mm.
    y: f64,
    /// mm; down.
    z: f64,
    /// Rotation about x, degrees.
    alpha: f64,
}

/// A point, mm.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Point)]
pub(crate) struct PointObject {
    x: f64,
    y: f64,
    z: f64,
}

/// Pose of the tool in the table frame.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = PartPose)]
pub(crate) struct PartObject {
    /// mm.
    x: f64,
    /// mm.
    y: f64,
    /// mm; up from the table.
    z: f64,
    /// Inclination, degrees.
    phi1: f64,
    /// Azimuth, degrees.
    phi2: f64,
    /// Unit vector from tip to holder.
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
    /// Tells solutions with equal labels apart: 0, 1, ... in the order working, alpha, rho.
    index: usize,
}

/// Which end of a leg is higher.
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
        let axis = Exactly(axis::tool_axis(pose.phi1, pose.phi2).map(|cosine| cosine + 0.0));
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
