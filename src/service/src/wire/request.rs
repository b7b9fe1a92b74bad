//! The questions `/fk` and `/ik`, as JSON.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::machine_ref::MachineRef;
use super::numbers::Triple;
use super::object::{object, optional_object};

/// Where are platform, tool and part for these joints?
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FkRequest {
    /// The machine: a published name, or the whole object.
    #[serde(default)]
    pub machine: MachineRef,
    /// The sliders, and the table where a part pose is wanted.
    #[serde(deserialize_with = "object")]
    pub joints: Joints,
    /// Distance from P to the tool's tip, mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end and of the platform's six joints over the table, the plane Z = 0 of the part
    /// frame, mm; needs theta1. Left out: the machine's own limit; without one the table is not checked.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, a circle perpendicular to its axis, mm; counts for `table_clearance` alone.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Which solutions to answer.
    #[serde(default)]
    pub solutions: Wanted,
    /// Sorts the solutions by distance from here.
    #[serde(default, deserialize_with = "optional_object")]
    pub near: Option<Near>,
}

/// Which joints bring the machine to this pose?
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct IkRequest {
    /// The machine: a published name, or the whole object.
    #[serde(default)]
    pub machine: MachineRef,
    /// What `pose` describes.
    #[serde(default)]
    pub frame: Frame,
    /// The pose.
    #[serde(deserialize_with = "object")]
    pub pose: TargetPose,
    /// Distance from P to the tool's tip, mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end and of the platform's six joints over the table, the plane Z = 0 of the part
    /// frame, mm; only in frame `part`. Left out: the machine's own limit; without one the table is not checked.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, a circle perpendicular to its axis, mm; counts for `table_clearance` alone.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Which solutions to answer.
    #[serde(default)]
    pub solutions: Wanted,
    /// Sorts the solutions by distance from here.
    #[serde(default, deserialize_with = "optional_object")]
    pub near: Option<Near>,
}

/// Positions of the joints: sliders in mm, table in degrees.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Joints {
    /// The three sliders.
    #[schema(inline, example = json!([674, 685, 250]))]
    pub rho: Triple,
    /// Tilting angle of the table; together with theta2.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(minimum = -36000, maximum = 36000)]
    pub theta1: Option<f64>,
    /// Rotary angle of the table; together with theta1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(minimum = -36000, maximum = 36000)]
    pub theta2: Option<f64>,
}

/// A pose in the frame of the question. In `part` it takes `phi1` and `phi2`, or `axis`.
#[derive(Clone, Copy, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TargetPose {
    /// mm.
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub x: f64,
    /// mm.
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub y: f64,
    /// mm; down in the base frame, up from the table in the part frame.
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub z: f64,
    /// Inclination of the tool, degrees; only in `part`, there 0 unless `phi1` or `axis` is given.
    #[schema(minimum = -36000, maximum = 36000)]
    pub phi1: Option<f64>,
    /// Azimuth of the tool, degrees; only in `part`, there 0 unless `phi2` or `axis` is given. Where the tool stands
    /// along the table's own axis it is left open unless given, also beside `axis`: see `free` in the answer.
    #[schema(minimum = -36000, maximum = 36000)]
    pub phi2: Option<f64>,
    /// Tool axis in the table frame, from tip to holder, of any length; only in `part`, instead of phi1 and phi2. An
    /// axis within 1e-6 rad of the table's own is the table's own: phi2 is then free.
    #[schema(inline)]
    pub axis: Option<Triple>,
}

/// What a pose describes: `platform`, the platform's point P in the base frame; `tool`, the tool's tip in the base
/// frame (alpha follows); `part` (default), the tool's tip and orientation in the table frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Frame {
    /// The platform's point P in the base frame.
    Platform,
    /// The tool's tip in the base frame; alpha follows.
    Tool,
    /// The tool's tip and orientation in the table frame.
    #[default]
    Part,
}

impl Frame {
    /// Why there is no theta1, where there is none.
    pub(crate) fn without_tilt(self) -> Option<&'static str> {
        (self != Self::Part).then_some("belongs to frame part")
    }
}

/// Which solutions to answer: `working` (default), those in the machine's own mode, feasible or not: nearly always one,
/// several where the table is far from the platform; `feasible`, those of them that break no limit; `all`, every
/// solution of the equations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Wanted {
    /// The machine's own mode, feasible or not.
    #[default]
    Working,
    /// Only what breaks no limit.
    Feasible,
    /// Every solution of the equations.
    All,
}

/// A place to sort by: joints, or a pose of the platform in the base frame.
#[derive(Clone, Copy, Debug, Deserialize, ToSchema)]
#[serde(try_from = "NearFields")]
#[schema(rename_all = "snake_case")]
#[serde(untagged)]
pub(crate) enum Near {
    /// Distance of the joints; theta1 and theta2 count where both sides have them. /ik answers theta1 and theta2 on the
    /// windings (by whole turns) within their ranges that are nearest to these.
    Joints(Joints),
    /// Distance of the platform; alpha counts where it is given.
    Pose(NearPose),
}

/// A pose of the platform in the base frame.
#[derive(Clone, Copy, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct NearPose {
    /// mm.
    pub x: f64,
    /// mm.
    pub y: f64,
    /// mm.
    pub z: f64,
    /// Degrees.
    pub alpha: Option<f64>,
}

/// Both kinds of `near` at once: an untagged enum would lose what is wrong with the one meant.
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
