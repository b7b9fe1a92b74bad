//! Writes the mesh of a result as a file: GLB, STL, PLY or JSON. The crate `verne-mesh` has the formats.

use std::fmt::Write;

use serde_json::{Value, json};
use verne_mesh::{Mesh, glb, ply, stl};

use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::error_map_question::ErrorMapQuestion;
use crate::operations::machine_registry::IdentifiedMachine;
use crate::operations::origins_question::OriginsQuestion;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::wire::dexterity::SetName;
use crate::wire::error::OperationError;
use crate::wire::error_map::ErrorName;
use crate::wire::format::MeshFormat;
use crate::wire::limit::Unchecked;
use crate::wire::result_id::ResultId;
use crate::wire::workspace::FrameName;

/// The angle between two triangles from which a viewer shows their edge as sharp, rad.
const CREASE: f64 = std::f64::consts::PI / 6.0;

/// About the bytes of a triangle in a file.
const TRIANGLE_BYTES: usize = 64;

/// What every file states about its mesh: kind, frame, request and machine.
pub(crate) struct MeshDescription<'a> {
    kind: &'static str,
    name: String,
    frame: FrameName,
    request: Value,
    not_checked: &'static [Unchecked],
    machine: &'a IdentifiedMachine,
    id: ResultId,
}

impl<'a> MeshDescription<'a> {
    /// The mesh of a workspace.
    pub(crate) fn of_workspace(question: &'a WorkspaceQuestion) -> Self {
        let kind = question.request.kind;
        Self {
            kind: kind.name(),
            name: workspace_name(kind.name(), &question.machine),
            frame: kind.frame(),
            request: json!(question.request),
            not_checked: question.request.not_checked(),
            machine: &question.machine,
            id: question.id,
        }
    }

    /// The mesh of one set of a dexterity map.
    pub(crate) fn of_set(question: &'a DexterityQuestion, set: SetName) -> Self {
        Self {
            kind: set.name(),
            name: workspace_name(set.name(), &question.machine),
            frame: FrameName::Part,
            request: json!(question.request),
            not_checked: Unchecked::beside(question.request.table_clearance.is_some()),
            machine: &question.machine,
            id: question.id,
        }
    }

    /// The surface of a workspace in bands of an error.
    pub(crate) fn of_errors(question: &'a ErrorMapQuestion, error: ErrorName) -> Self {
        let workspace = &question.request.workspace;
        Self {
            kind: error.name(),
            name: format!("{} over a workspace of {}", error.name(), question.machine.id.name),
            frame: workspace.kind.frame(),
            request: json!(question.request),
            not_checked: workspace.not_checked(),
            machine: &question.machine,
            id: question.id,
        }
    }

    /// The mesh of a region of origins.
    pub(crate) fn of_origins(question: &'a OriginsQuestion) -> Self {
        let toolpath = &question.toolpath;
        Self {
            kind: "origins",
            name: format!("origins of a program on {}", toolpath.machine.id.name),
            frame: FrameName::Part,
            request: json!(question.request()),
            not_checked: Unchecked::beside(toolpath.request.table_clearance.is_some()),
            machine: &toolpath.machine,
            id: question.id,
        }
    }

    /// The description as JSON. `unit` is the unit of the coordinates; machine and request are in mm in every format.
    fn about(&self, mesh: &Mesh, unit: &str) -> Value {
        let machine = &self.machine.id;
        json!({
            "unit": unit,
            "machine_unit": "mm",
            "frame": self.frame,
            "kind": self.kind,
            "request": self.request,
            "not_checked": self.not_checked,
            "machine": {
                "name": machine.name,
                "hash": machine.hash,
                "description": self.machine.data().description,
            },
            "id": self.id,
            "solver": concat!("verne ", env!("CARGO_PKG_VERSION")),
            "constraints": mesh.palette(),
        })
    }

    fn options(&self, extras: Value) -> glb::Options {
        let up = match self.frame {
            FrameName::Base => glb::Up::NegativeZ,
            FrameName::Part => glb::Up::PositiveZ,
        };
        glb::Options { name: self.name.clone(), up, extras }
    }

    /// A short title: the header of an STL file has 80 bytes.
    fn title(&self) -> String {
        format!("{} {}, {:.16}", self.machine.id.name, self.kind, self.id)
    }
}

fn workspace_name(kind: &str, machine: &IdentifiedMachine) -> String {
    format!("{kind} workspace of {}", machine.id.name)
}

/// The name of the blob with a mesh file, from the blob with the mesh.
pub(crate) fn mesh_file_name(mesh: &str, format: MeshFormat) -> String {
    format!("{mesh}.{}", format.name())
}

/// Writes a mesh as a file.
pub(crate) fn write_mesh(
    description: &MeshDescription<'_>,
    mesh: &Mesh,
    format: MeshFormat,
) -> Result<Vec<u8>, OperationError> {
    // glTF has no other unit than the metre.
    let unit = if format == MeshFormat::Glb { "m" } else { "mm" };
    let about = description.about(mesh, unit);
    let mut file = Vec::with_capacity(TRIANGLE_BYTES * mesh.triangles().len());
    let written = match format {
        MeshFormat::Glb => glb::write(mesh, CREASE, &description.options(about), &mut file),
        MeshFormat::Stl => stl::write(mesh, &description.title(), &mut file),
        MeshFormat::Ply => ply::write(mesh, &comments(&about), &mut file),
        MeshFormat::Json => verne_mesh::json::write(mesh, &about, &mut file),
    };
    written.map_err(|_| OperationError::Internal)?;
    Ok(file)
}

/// One line for each property, except for those that the format states itself.
fn comments(about: &Value) -> String {
    let lines = about
        .as_object()
        .into_iter()
        .flatten()
        .filter(|(name, _)| !["unit", "machine_unit", "constraints"].contains(&name.as_str()));
    lines.fold(String::new(), |mut comments, (name, value)| {
        let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        // Writing to a string cannot fail.
        let _ = writeln!(comments, "{name} {text}");
        comments
    })
}
