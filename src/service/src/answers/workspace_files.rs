//! Writes a workspace's mesh in a format.

use std::fmt::Write;

use serde_json::{Value, json};
use verne_mesh::{Mesh, glb, ply, stl};

use super::workspace_question::WorkspaceQuestion;
use crate::error::Error;
use crate::wire::format::MeshFormat;
use crate::wire::workspace::FrameName;

/// The bend from which an edge is shown sharp, rad.
const CREASE: f64 = std::f64::consts::PI / 6.0;

/// About the bytes of a triangle in a file.
const TRIANGLE_BYTES: usize = 64;

/// The mesh as a file.
pub(crate) fn write_mesh(
    question: &WorkspaceQuestion,
    mesh: &Mesh,
    format: MeshFormat,
) -> Result<Vec<u8>, Error> {
    let about = about(question, mesh);
    let mut file = Vec::with_capacity(TRIANGLE_BYTES * mesh.triangles().len());
    let written = match format {
        MeshFormat::Glb => glb::write(mesh, &options(question, about), &mut file),
        MeshFormat::Stl => stl::write(mesh, &title(question), &mut file),
        MeshFormat::Ply => ply::write(mesh, &comments(&about), &mut file),
        MeshFormat::Json => verne_mesh::json::write(mesh, &about, &mut file),
    };
    written.map_err(|_| Error::Internal)?;
    Ok(file)
}

/// What files say about themselves.
fn about(question: &WorkspaceQuestion, mesh: &Mesh) -> Value {
    let WorkspaceQuestion { published, request, id } = question;
    json!({
        "unit": "mm",
        "frame": request.kind.frame(),
        "kind": request.kind,
        "request": request,
        "machine": {
            "name": published.id.name,
            "hash": published.id.hash,
            "description": published.machine.data().description,
        },
        "id": id,
        "solver": concat!("verne ", env!("CARGO_PKG_VERSION")),
        "constraints": mesh.palette(),
    })
}

fn options(question: &WorkspaceQuestion, extras: Value) -> glb::Options {
    let kind = question.request.kind;
    let up = match kind.frame() {
        FrameName::Base => glb::Up::NegativeZ,
        FrameName::Part => glb::Up::PositiveZ,
    };
    let name = format!("{} workspace of {}", kind.name(), question.published.id.name);
    glb::Options { name, up, crease: CREASE, extras }
}

/// A header of STL has little room.
fn title(question: &WorkspaceQuestion) -> String {
    format!("{} {}, {:.16}", question.published.id.name, question.request.kind.name(), question.id)
}

/// One line for each thing that is said, except for the constraints, which the format says itself.
fn comments(about: &Value) -> String {
    let lines = about
        .as_object()
        .into_iter()
        .flatten()
        .filter(|(name, _)| !["unit", "constraints"].contains(&name.as_str()));
    lines.fold(String::new(), |mut comments, (name, value)| {
        let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        // Writing to a string cannot fail.
        let _ = writeln!(comments, "{name} {text}");
        comments
    })
}
