//! Writes a workspace's mesh in a format.

use serde_json::Value;
use verne_mesh::{glb, json, ply, stl};

use super::workspace::Workspace;
use crate::error::Error;
use crate::wire::format::MeshFormat;
use crate::wire::workspace::FrameName;

/// The bend from which an edge is shown sharp, rad.
const CREASE: f64 = std::f64::consts::PI / 6.0;

/// About the bytes of a triangle in a file.
const TRIANGLE_BYTES: usize = 64;

/// The mesh as a file.
pub(crate) fn write_mesh(workspace: &Workspace, format: MeshFormat) -> Result<Vec<u8>, Error> {
    let (mesh, about) = (&workspace.mesh, workspace.about());
    let mut file = Vec::with_capacity(TRIANGLE_BYTES * mesh.triangles().len());
    let written = match format {
        MeshFormat::Glb => glb::write(mesh, &options(workspace, about), &mut file),
        MeshFormat::Stl => stl::write(mesh, &title(workspace), &mut file),
        MeshFormat::Ply => ply::write(mesh, &comments(&about), &mut file),
        MeshFormat::Json => json::write(mesh, &about, &mut file),
    };
    written.map_err(|_| Error::Internal)?;
    Ok(file)
}

fn options(workspace: &Workspace, extras: Value) -> glb::Options {
    let kind = workspace.question.request.kind;
    let up = match kind.frame() {
        FrameName::Base => glb::Up::NegativeZ,
        FrameName::Part => glb::Up::PositiveZ,
    };
    let name = format!("{} workspace of {}", kind.name(), workspace.question.published.id.name);
    glb::Options { name, up, crease: CREASE, extras }
}

/// A header of STL has little room.
fn title(workspace: &Workspace) -> String {
    let question = &workspace.question;
    format!("{} {}, {:.16}", question.published.id.name, question.request.kind.name(), question.id)
}

/// One line for each thing that is said, except for the constraints, which the format says itself.
fn comments(about: &Value) -> String {
    let lines = about
        .as_object()
        .into_iter()
        .flatten()
        .filter(|(name, _)| !["unit", "constraints"].contains(&name.as_str()));
    lines
        .map(|(name, value)| {
            format!("{name} {}\n", value.as_str().map_or_else(|| value.to_string(), str::to_owned))
        })
        .collect()
}
