//! Parameters of /workspace, in query strings and on the command line.

use clap::Args;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::wire::alphas::Alphas;
use crate::wire::dexterity::SetName;
use crate::wire::error_map::ErrorName;
use crate::wire::format::{MeshFormat, SliceFormat};
use crate::wire::machine_ref::{MachineRef, REFERENCE, reference_name};
use crate::wire::sweep::Sweep;
use crate::wire::workspace::{KindName, WorkspaceRequest, default_tolerance};

/// Parameters of GET /workspace.
#[derive(Debug, Deserialize, IntoParams, Args)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct WorkspaceQuery {
    /// Name of the machine. On the command line it may also be the path of a machine file.
    #[serde(default = "reference_name")]
    #[arg(long, default_value = REFERENCE)]
    #[param(default = "verne")]
    pub machine: String,
    /// Point and frame of the positions.
    #[serde(default)]
    #[arg(long, default_value = "platform")]
    pub kind: KindName,
    /// Distance from P to the tool end, mm. Kind `platform` ignores it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Only kind `part` has it. The default is the limit of the machine; if the machine has none, the
    /// service does not check the table.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, which is perpendicular to the tool's axis, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Inclination of the tool in the part frame, degrees. Only kind `part` uses it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = -36000, maximum = 36000, default = 0.0)]
    pub phi1: f64,
    /// Azimuth of the tool in the part frame, degrees. Only kind `part` uses it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = -36000, maximum = 36000, default = 0.0)]
    pub phi2: f64,
    /// Greatest distance between the mesh and the true surface, in both directions, mm.
    #[serde(default = "default_tolerance")]
    #[arg(long, default_value_t = 1.0, allow_hyphen_values = true)]
    #[param(minimum = 0.01, maximum = 1000, default = 1.0)]
    pub tolerance: f64,
    /// Return the mesh in this format instead of the summary. It overrides Accept.
    #[arg(skip)]
    #[param(inline, nullable = false)]
    pub format: Option<MeshFormat>,
}

impl WorkspaceQuery {
    /// The request as the body of POST /workspace.
    pub(crate) fn into_request(self) -> WorkspaceRequest {
        WorkspaceRequest {
            machine: MachineRef::Name(self.machine),
            kind: self.kind,
            tool_length: Sweep::One(self.tool_length),
            table_clearance: self.table_clearance,
            tool_radius: self.tool_radius,
            phi1: Sweep::One(self.phi1),
            phi2: Sweep::One(self.phi2),
            tolerance: self.tolerance,
        }
    }
}

/// Parameters of POST /workspace and GET /workspace/{id}/mesh.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct MeshQuery {
    /// Return the mesh in this format. It overrides Accept.
    #[param(inline, nullable = false)]
    pub format: Option<MeshFormat>,
}

/// Parameters of GET /workspace/{id}/slice.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct SliceQuery {
    /// Height of the cut in the frame of the workspace, mm.
    #[param(minimum = -1e7, maximum = 1e7)]
    pub z: f64,
    /// Lines of constant alpha within the cut: `true` for a line every five degrees, or angles in degrees, separated by
    /// commas.
    #[serde(default)]
    #[param(inline, explode = false)]
    pub alpha: Alphas,
    /// Return the slice in this format. It overrides Accept.
    #[param(inline, nullable = false)]
    pub format: Option<SliceFormat>,
}

/// Parameters of GET /workspace/{id}/mesh.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct StoredMeshQuery {
    /// Return the mesh in this format. It overrides Accept.
    #[param(inline, nullable = false)]
    pub format: Option<MeshFormat>,
    /// Point set of a dexterity map. The default is `reachable`.
    #[param(inline, nullable = false)]
    pub set: Option<SetName>,
    /// Error of an error map that the colours show. The default is `tip_worst`.
    #[param(inline, nullable = false)]
    pub error: Option<ErrorName>,
}
