//! JSON in millimetres, for scripts without a mesh library.

use std::io::{self, BufWriter, Write};

use serde::{Serialize, Serializer};
use serde_json::Value;

use crate::{Mesh, Swatch};

/// Writes the mesh as one JSON object: `unit`, flat `positions` (three numbers a vertex) and `indices` (three a
/// triangle), `tags` (one a vertex), `triangle_tags`, the `palette` that the tags index, and the caller's `extras`
/// unless null. Positions read back exactly.
///
/// # Units
///
/// Millimetres.
///
/// # Errors
///
/// The error of `out`.
///
/// # Examples
///
/// ```
#[doc = include_str!("doctest/tetrahedron.md")]
/// let mut file = Vec::new();
/// verne_mesh::json::write(&mesh, &serde_json::Value::Null, &mut file)?;
/// let read: serde_json::Value = serde_json::from_slice(&file)?;
/// assert_eq!(read["unit"], "mm");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write(mesh: &Mesh, extras: &Value, out: impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    let object = Object {
        unit: "mm",
        positions: mesh.positions(),
        indices: mesh.triangles(),
        tags: &mesh.vertex_tags(),
        triangle_tags: mesh.tags(),
        palette: mesh.palette(),
        extras,
    };
    serde_json::to_writer(&mut out, &object)?;
    out.flush()
}

#[derive(Serialize)]
struct Object<'a> {
    unit: &'a str,
    #[serde(serialize_with = "flat")]
    positions: &'a [[f64; 3]],
    #[serde(serialize_with = "flat")]
    indices: &'a [[u32; 3]],
    tags: &'a [u8],
    triangle_tags: &'a [u8],
    palette: &'a [Swatch],
    #[serde(skip_serializing_if = "Value::is_null")]
    extras: &'a Value,
}

fn flat<T: Serialize, S: Serializer>(rows: &[[T; 3]], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(rows.as_flattened())
}
