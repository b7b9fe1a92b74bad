//! The requests of `/fk` and `/ik`.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use verne_solver::certificate::Scope;

use crate::wire::fixed_array::Triple;
use crate::wire::machine_ref::MachineRef;
use crate::wire::strict_object::{optional_strict_object, strict_object};
use crate::wire::tool::has_tool;

/// A request for the poses at given joints.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FkRequest {
    /// The machine: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// The sliders, and the table if the answer should have poses in the part frame.
    #[serde(deserialize_with = "strict_object")]
    pub joints: Joints,
    /// Distance from P to the tool end, mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Needs theta1. The default is the limit of the machine; if the machine has none, the service
    /// does not check the table.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, which is perpendicular to the tool's axis, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Solutions to return.
    #[serde(default)]
    pub solutions: SolutionFilter,
    /// Whether each solution has its `jacobian`. Needs theta1 and theta2.
    #[serde(default)]
    #[schema(default = false)]
    pub jacobian: bool,
    /// Length by which the Jacobian's lengths are divided before its singular values are computed, mm. Only with
    /// `jacobian`. The default is R1 of the machine.
    #[serde(default)]
    #[schema(minimum = 1e-3, maximum = 1e7)]
    pub characteristic_length: Option<f64>,
    /// Whether to prove the solutions: each has its `certificate`, and the answer its `completeness`.
    #[serde(default)]
    #[schema(default = false)]
    pub certified: bool,
    /// Sort the solutions by distance from these joints or this pose.
    #[serde(default, deserialize_with = "optional_strict_object")]
    pub near: Option<Near>,
}

/// A request for the joints of a pose.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct IkRequest {
    /// The machine: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Frame of `pose`.
    #[serde(default)]
    pub frame: Frame,
    /// The pose.
    #[serde(deserialize_with = "strict_object")]
    pub pose: TargetPose,
    /// Distance from P to the tool end, mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Only frame `part` has it. The default is the limit of the machine; if the machine has none, the
    /// service does not check the table.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, which is perpendicular to the tool's axis, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Solutions to return.
    #[serde(default)]
    pub solutions: SolutionFilter,
    /// Whether each solution has its `jacobian`. Only frame `part` has it.
    #[serde(default)]
    #[schema(default = false)]
    pub jacobian: bool,
    /// Length by which the Jacobian's lengths are divided before its singular values are computed, mm. Only with
    /// `jacobian`. The default is R1 of the machine.
    #[serde(default)]
    #[schema(minimum = 1e-3, maximum = 1e7)]
    pub characteristic_length: Option<f64>,
    /// Whether to prove the solutions: each has its `certificate`, and the answer its `completeness`.
    #[serde(default)]
    #[schema(default = false)]
    pub certified: bool,
    /// Sort the solutions by distance from these joints or this pose.
    #[serde(default, deserialize_with = "optional_strict_object")]
    pub near: Option<Near>,
}

has_tool!(FkRequest);
has_tool!(IkRequest);

/// Positions of the joints: sliders in mm, table in degrees.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Joints {
    /// The three sliders.
    #[schema(inline, example = json!([674, 685, 250]))]
    pub rho: Triple,
    /// Tilting angle of the table. Needs theta2.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(minimum = -36000, maximum = 36000)]
    pub theta1: Option<f64>,
    /// Rotary angle of the table. Needs theta1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(minimum = -36000, maximum = 36000)]
    pub theta2: Option<f64>,
}

/// A pose in the frame of the request. In frame `part` it has `phi1` and `phi2`, or `axis`.
#[derive(Clone, Copy, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TargetPose {
    /// x, mm.
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub x: f64,
    /// y, mm.
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub y: f64,
    /// z, mm. It points down in the base frame and up from the table in the part frame.
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub z: f64,
    /// Inclination of the tool, degrees. Only frame `part` has it. The default is 0, unless the request has `axis`.
    #[schema(minimum = -36000, maximum = 36000)]
    pub phi1: Option<f64>,
    /// Azimuth of the tool, degrees. Only frame `part` has it. The default is 0, unless the request has `axis`. If the
    /// tool is parallel to the table's own axis, phi2 is free unless the request sets it (see `free` in the answer); it
    /// may then stand beside `axis`.
    #[schema(minimum = -36000, maximum = 36000)]
    pub phi2: Option<f64>,
    /// Tool axis in the part frame, from the tool end to the holder, of any length. Only frame `part` has it. It
    /// replaces phi1 and phi2. The service treats an axis within 1e-6 rad of the table's own axis as the table's own;
    /// phi2 is then free.
    #[schema(inline)]
    pub axis: Option<Triple>,
}

/// Frame of a pose: `platform`, the platform's point P in the base frame; `tool`, the tool end in the base frame (alpha
/// follows from the position); `part` (default), the tool end and the tool's orientation in the part frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Frame {
    /// The platform's point P in the base frame.
    Platform,
    /// The tool end in the base frame; alpha follows from the position.
    Tool,
    /// The tool end and the tool's orientation in the part frame.
    #[default]
    Part,
}

impl Frame {
    /// The reason why theta1 is unknown, if it is.
    pub(crate) fn without_tilt(self) -> Option<&'static str> {
        (self != Self::Part).then_some("is allowed only in frame part")
    }
}

/// Solutions to return: `working` (default), the solutions in the working mode, feasible or not (nearly always one;
/// several if the table is far from the platform); `feasible`, the working solutions that break no limit; `all`, every
/// solution of the equations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[schema(as = Wanted)]
pub(crate) enum SolutionFilter {
    /// Solutions in the working mode, feasible or not.
    #[default]
    Working,
    /// Working solutions that break no limit.
    Feasible,
    /// Every solution of the equations.
    All,
}

impl SolutionFilter {
    /// The solutions for which the solver is asked.
    pub(crate) fn scope(self) -> Scope {
        match self {
            Self::All => Scope::All,
            Self::Working | Self::Feasible => Scope::Working,
        }
    }
}

/// Reference for the order of the solutions: joints, or a pose of the platform in the base frame.
#[derive(Clone, Copy, Debug, Deserialize, ToSchema)]
#[serde(try_from = "NearFields")]
#[schema(rename_all = "snake_case")]
#[serde(untagged)]
pub(crate) enum Near {
    /// Distance of the joints. theta1 and theta2 count if both sides have them. The theta1 and theta2 in an answer of
    /// /ik are on the windings (by whole turns) within their ranges that are nearest to these.
    Joints(Joints),
    /// Distance of the platform. alpha counts if the request has it.
    Pose(NearPose),
}

/// A pose of the platform in the base frame.
#[derive(Clone, Copy, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct NearPose {
    /// x, mm.
    pub x: f64,
    /// y, mm.
    pub y: f64,
    /// z, mm.
    pub z: f64,
    /// alpha, degrees.
    pub alpha: Option<f64>,
}

/// The fields of both kinds of `near`: the errors of an untagged enum would not name the field.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct NearFields {
    rho: Option<Triple>,
    theta1: Option<f64>,
    theta2: Option<f64>,
    x: Option<f64>,
    y: Option<f64>,
    z: Option<f64>,
    alpha: Option<f64>,
}

impl TryFrom<NearFields> for Near {
    type Error = &'static str;

    fn try_from(fields: NearFields) -> Result<Self, Self::Error> {
        match fields {
            NearFields { rho: Some(rho), theta1, theta2, x: None, y: None, z: None, alpha: None } => {
                Ok(Self::Joints(Joints { rho, theta1, theta2 }))
            }
            NearFields {
                rho: None,
                theta1: None,
                theta2: None,
                x: Some(x),
                y: Some(y),
                z: Some(z),
                alpha,
            } => Ok(Self::Pose(NearPose { x, y, z, alpha })),
            _ => Err("must be joints {rho, theta1?, theta2?} or a platform pose {x, y, z, alpha?}"),
        }
    }
}
