//! Parameters of /fk and /ik, in query strings and on the command line.

use clap::Args;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::wire::error::{FieldError, OperationError};
use crate::wire::fixed_array::{JointList, PoseList, TripleList};
use crate::wire::machine_ref::{MachineRef, REFERENCE, reference_name};
use crate::wire::request::{FkRequest, Frame, IkRequest, Joints, Near, NearPose, SolutionFilter, TargetPose};

/// Parameters of GET /fk.
#[derive(Debug, Deserialize, IntoParams, Args)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct FkQuery {
    /// Name of the machine. On the command line it may also be the path of a machine file.
    #[serde(default = "reference_name")]
    #[arg(long, default_value = REFERENCE)]
    #[param(default = "verne")]
    pub machine: String,
    /// Positions of the three sliders, mm.
    #[arg(long, allow_hyphen_values = true)]
    #[param(inline, style = Form, explode = false)]
    pub rho: TripleList,
    /// Tilting angle of the table, degrees. Needs theta2.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = -36000, maximum = 36000, nullable = false)]
    pub theta1: Option<f64>,
    /// Rotary angle of the table, degrees. Needs theta1.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = -36000, maximum = 36000, nullable = false)]
    pub theta2: Option<f64>,
    /// Distance from P to the tool end, mm.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Needs theta1. The default is the limit of the machine; if the machine has none, the service
    /// does not check the table.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, which is perpendicular to the tool's axis, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Solutions to return.
    #[serde(default)]
    #[arg(long, default_value = "working")]
    pub solutions: SolutionFilter,
    /// Whether each solution has its `jacobian`. Needs theta1 and theta2.
    #[serde(default)]
    #[arg(long)]
    #[param(default = false)]
    pub jacobian: bool,
    /// Length by which the Jacobian's lengths are divided before its singular values are computed, mm. Only with
    /// `jacobian`. The default is R1 of the machine.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 1e-3, maximum = 1e7, nullable = false)]
    pub characteristic_length: Option<f64>,
    /// Whether to prove the solutions: each has its `certificate`, and the answer its `completeness`.
    #[serde(default)]
    #[arg(long)]
    #[param(default = false)]
    pub certified: bool,
    /// Sort the solutions by distance from these joints: rho1,rho2,rho3 or rho1,rho2,rho3,theta1,theta2.
    #[arg(long, allow_hyphen_values = true)]
    #[param(inline, style = Form, explode = false, nullable = false)]
    pub near_joints: Option<JointList>,
    /// Sort the solutions by distance from this platform pose: x,y,z or x,y,z,alpha.
    #[arg(long, allow_hyphen_values = true)]
    #[param(inline, style = Form, explode = false, nullable = false)]
    pub near_pose: Option<PoseList>,
}

/// Parameters of GET /ik.
#[derive(Debug, Deserialize, IntoParams, Args)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct IkQuery {
    /// Name of the machine. On the command line it may also be the path of a machine file.
    #[serde(default = "reference_name")]
    #[arg(long, default_value = REFERENCE)]
    #[param(default = "verne")]
    pub machine: String,
    /// Frame of x, y, z and the orientation.
    #[serde(default)]
    #[arg(long, default_value = "part")]
    pub frame: Frame,
    /// x, mm.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = -1e7, maximum = 1e7)]
    pub x: f64,
    /// y, mm.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = -1e7, maximum = 1e7)]
    pub y: f64,
    /// z, mm. It points down in the base frame and up from the table in the part frame.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = -1e7, maximum = 1e7)]
    pub z: f64,
    /// Inclination of the tool, degrees. Only frame `part` has it. The default is 0, unless the request has `axis`.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = -36000, maximum = 36000, nullable = false)]
    pub phi1: Option<f64>,
    /// Azimuth of the tool, degrees. Only frame `part` has it. The default is 0, unless the request has `axis`. If the
    /// tool is parallel to the table's own axis, phi2 is free unless the request sets it (see `free` in the answer); it
    /// may then stand beside `axis`.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = -36000, maximum = 36000, nullable = false)]
    pub phi2: Option<f64>,
    /// Tool axis i,j,k in the part frame, from the tool end to the holder. Only frame `part` has it. It replaces phi1
    /// and phi2.
    #[arg(long, allow_hyphen_values = true)]
    #[param(inline, style = Form, explode = false, nullable = false)]
    pub axis: Option<TripleList>,
    /// Distance from P to the tool end, mm.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Only frame `part` has it. The default is the limit of the machine; if the machine has none, the
    /// service does not check the table.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, which is perpendicular to the tool's axis, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Solutions to return.
    #[serde(default)]
    #[arg(long, default_value = "working")]
    pub solutions: SolutionFilter,
    /// Whether each solution has its `jacobian`. Only frame `part` has it.
    #[serde(default)]
    #[arg(long)]
    #[param(default = false)]
    pub jacobian: bool,
    /// Length by which the Jacobian's lengths are divided before its singular values are computed, mm. Only with
    /// `jacobian`. The default is R1 of the machine.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 1e-3, maximum = 1e7, nullable = false)]
    pub characteristic_length: Option<f64>,
    /// Whether to prove the solutions: each has its `certificate`, and the answer its `completeness`.
    #[serde(default)]
    #[arg(long)]
    #[param(default = false)]
    pub certified: bool,
    /// Sort the solutions by distance from these joints: rho1,rho2,rho3 or rho1,rho2,rho3,theta1,theta2. theta1 and
    /// theta2 of the solutions are on the windings within their ranges that are nearest to these.
    #[arg(long, allow_hyphen_values = true)]
    #[param(inline, style = Form, explode = false, nullable = false)]
    pub near_joints: Option<JointList>,
    /// Sort the solutions by distance from this platform pose: x,y,z or x,y,z,alpha.
    #[arg(long, allow_hyphen_values = true)]
    #[param(inline, style = Form, explode = false, nullable = false)]
    pub near_pose: Option<PoseList>,
}

impl FkQuery {
    /// The request as the body of POST.
    pub(crate) fn into_request(self) -> Result<FkRequest, OperationError> {
        Ok(FkRequest {
            near: near(self.near_joints, self.near_pose)?,
            machine: MachineRef::Name(self.machine),
            joints: Joints { rho: self.rho.first, theta1: self.theta1, theta2: self.theta2 },
            tool_length: self.tool_length,
            table_clearance: self.table_clearance,
            tool_radius: self.tool_radius,
            solutions: self.solutions,
            jacobian: self.jacobian,
            characteristic_length: self.characteristic_length,
            certified: self.certified,
        })
    }
}

impl IkQuery {
    /// The request as the body of POST.
    pub(crate) fn into_request(self) -> Result<IkRequest, OperationError> {
        let axis = self.axis.map(|axis| axis.first);
        Ok(IkRequest {
            near: near(self.near_joints, self.near_pose)?,
            machine: MachineRef::Name(self.machine),
            frame: self.frame,
            pose: TargetPose { x: self.x, y: self.y, z: self.z, phi1: self.phi1, phi2: self.phi2, axis },
            tool_length: self.tool_length,
            table_clearance: self.table_clearance,
            tool_radius: self.tool_radius,
            solutions: self.solutions,
            jacobian: self.jacobian,
            characteristic_length: self.characteristic_length,
            certified: self.certified,
        })
    }
}

fn near(joints: Option<JointList>, pose: Option<PoseList>) -> Result<Option<Near>, OperationError> {
    match (joints, pose) {
        (None, None) => Ok(None),
        (Some(joints), None) => {
            let (rho, theta1, theta2) = (joints.first, joints.optional(0), joints.optional(1));
            Ok(Some(Near::Joints(Joints { rho, theta1, theta2 })))
        }
        (None, Some(pose)) => {
            let ([x, y, z], alpha) = (pose.first.0, pose.optional(0));
            Ok(Some(Near::Pose(NearPose { x, y, z, alpha })))
        }
        (Some(_), Some(_)) => Err(OperationError::Fields(vec![FieldError::new(
            "/near",
            "takes near_joints or near_pose, not both",
        )])),
    }
}

/// Turns the pointers into the body of a request into pointers to the parameters of its query.
pub(crate) fn point_into_query(error: OperationError) -> OperationError {
    let OperationError::Fields(faults) = error else { return error };
    let moved = faults.into_iter().map(|fault| {
        let name = match fault.pointer.strip_prefix("/near") {
            Some(inside) if ["/x", "/y", "/z", "/alpha"].contains(&inside) => "/near_pose",
            Some("") => "/near_pose",
            Some(_) => "/near_joints",
            None => fault.pointer.trim_start_matches("/pose").trim_start_matches("/joints"),
        };
        FieldError::new(format!("/query{name}"), fault.detail)
    });
    OperationError::Fields(moved.collect())
}
