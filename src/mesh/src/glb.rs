//! GLB, the binary glTF 2.0, for viewers: in metres and with Y up, as glTF requires.
//!
//! Each tag that occurs becomes a primitive whose material has the tag's name and colour, so other programs can
//! select it. Its `extras` contain the `tag`, an index into the `palette` of the mesh's `extras`. The vertices are
//! split along the creases and between the tags. They are interleaved, 24 bytes each: position and normal.
//!
//! A path becomes lines: a primitive of coloured segments, and one of plain segments.

mod document;
mod layout;
mod options;
mod path;
mod placement;

use std::io::{self, BufWriter, Write};

use gltf_json::Root;

use self::layout::{Layout, PrimitiveLayout, STRIDE};
pub use self::options::Options;
pub use self::path::write_path;
use self::placement::Placement;
pub use self::placement::Up;
use crate::groups::Groups;
use crate::shading::{ShadedVertex, Shading};
use crate::{Bounds, Mesh};

/// Writes the mesh as a GLB. An empty mesh becomes a scene without nodes, because glTF has no empty buffers.
///
/// An edge is shown sharp if the angle between its triangles is at least `crease`, or if their tags differ.
///
/// # Units
///
/// The mesh is in millimetres; the file is in metres with Y up. `crease` is in radians.
///
/// # Errors
///
/// - The error of `out`.
/// - [`io::ErrorKind::FileTooLarge`]: the file would be longer than 4 GiB.
///
/// # References
///
/// [glTF 2.0](https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html), section 4: the GLB container.
///
/// # Examples
///
/// ```
#[doc = include_str!("doctest/tetrahedron.md")]
/// use verne_mesh::glb::{self, Options, Up};
///
/// let options = Options {
///     name: "tetrahedron".to_owned(),
///     up: Up::NegativeZ,
///     extras: serde_json::Value::Null,
/// };
/// let mut file = Vec::new();
/// glb::write(&mesh, 0.7, &options, &mut file)?;
/// assert!(file.starts_with(b"glTF"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write(mesh: &Mesh, crease: f64, options: &Options, out: impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    match mesh.bounds() {
        Some(bounds) => write_scene(mesh, bounds, crease, options, &mut out)?,
        None => write_head(&document::empty(options)?, None, &mut out)?,
    }
    out.flush()
}

fn write_scene(
    mesh: &Mesh,
    bounds: Bounds,
    crease: f64,
    options: &Options,
    out: &mut impl Write,
) -> io::Result<()> {
    let placement = Placement::new(options.up, bounds);
    let groups = Groups::of(mesh);
    let shading = Shading::of(mesh, crease, &groups);
    let layout = Layout::new(mesh, &groups, &shading, &placement);
    write_head(&document::of(mesh, options, &placement, &layout)?, Some(layout.chunk()), out)?;
    for vertex in &shading.vertices {
        out.write_all(&record(vertex, mesh, &placement))?;
    }
    for primitive in &layout.primitives {
        write_indices(primitive, &shading, layout.short_indices(), out)?;
    }
    out.write_all(&[0; 3][..layout.padding()])
}

/// One vertex as the accessors of the document describe it.
fn record(vertex: &ShadedVertex, mesh: &Mesh, placement: &Placement) -> [u8; STRIDE] {
    let position = placement.position(mesh.positions()[vertex.vertex as usize]);
    let normal = placement.direction(vertex.normal);
    let mut bytes = [0; STRIDE];
    for (slot, number) in bytes.chunks_exact_mut(4).zip(position.iter().chain(&normal)) {
        slot.copy_from_slice(&number.to_le_bytes());
    }
    bytes
}

fn write_indices(
    primitive: &PrimitiveLayout,
    shading: &Shading,
    short: bool,
    out: &mut impl Write,
) -> io::Result<()> {
    let corners = &shading.corners[primitive.indices.clone()];
    // The first corner of a tag refers to its first vertex.
    for index in corners.iter().map(|corner| corner - corners[0]) {
        match u16::try_from(index) {
            Ok(index) if short => out.write_all(&index.to_le_bytes())?,
            _ => out.write_all(&index.to_le_bytes())?,
        }
    }
    Ok(())
}

/// The file's header, the JSON chunk, and the header of the binary chunk if there is one; `binary` is its length, a
/// multiple of four.
fn write_head(document: &Root, binary: Option<u64>, out: &mut impl Write) -> io::Result<()> {
    let mut json = document.to_vec()?;
    json.resize(json.len().next_multiple_of(4), b' ');
    let total = 12 + 8 + json.len() as u64 + binary.map_or(0, |length| 8 + length);
    out.write_all(b"glTF")?;
    out.write_all(&2_u32.to_le_bytes())?;
    out.write_all(&length_field(total)?)?;
    out.write_all(&length_field(json.len() as u64)?)?;
    out.write_all(b"JSON")?;
    out.write_all(&json)?;
    if let Some(length) = binary {
        out.write_all(&length_field(length)?)?;
        out.write_all(b"BIN\0")?;
    }
    Ok(())
}

fn length_field(length: u64) -> io::Result<[u8; 4]> {
    u32::try_from(length)
        .map(u32::to_le_bytes)
        .map_err(|_| io::Error::new(io::ErrorKind::FileTooLarge, "a GLB cannot be longer than 4 GiB"))
}
