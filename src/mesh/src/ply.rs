//! Binary PLY in millimetres and double precision, for further processing in other programs.
//!
//! meshio and PyMesh cannot read faces with a scalar next to their list of vertices. meshio reads no third element,
//! and takes `uchar` for a signed number. So the faces are ordered by tag, comments give the range of each tag's
//! faces, and types have the names with their widths.

use std::fmt::Write as _;
use std::io::{self, BufWriter, Write};

use crate::Mesh;
use crate::groups::Groups;

/// Writes the mesh as a little-endian PLY: vertices with colour and tag, then faces in the order of their tags.
///
/// Each line of `comments` becomes a comment. Each swatch becomes a comment `tag NUMBER RED GREEN BLUE NAME`, and each
/// tag that faces have a comment `faces FIRST COUNT tag NUMBER`, where faces count from 0. Text that is too long for a
/// comment continues in further comments, each of which begins with `+`.
///
/// # Units
///
/// Millimetres, in double precision.
///
/// # Errors
///
/// The error of `out`.
///
/// # References
///
/// G. Turk, *The PLY Polygon File Format*, Stanford University 1994.
///
/// # Examples
///
/// ```
#[doc = include_str!("doctest/tetrahedron.md")]
/// let mut file = Vec::new();
/// verne_mesh::ply::write(&mesh, "a tetrahedron", &mut file)?;
/// let text = String::from_utf8_lossy(&file);
/// assert!(text.contains("comment a tetrahedron") && text.contains("comment tag 1 80 80 80 slope"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write(mesh: &Mesh, comments: &str, out: impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    let groups = Groups::of(mesh);
    out.write_all(header(mesh, &groups, comments).as_bytes())?;
    for (&position, tag) in mesh.positions().iter().zip(mesh.vertex_tags()) {
        out.write_all(&vertex(position, mesh.palette()[usize::from(tag)].rgb, tag))?;
    }
    for &triangle in groups.order() {
        out.write_all(&face(mesh.triangles()[triangle as usize]))?;
    }
    out.flush()
}

fn header(mesh: &Mesh, groups: &Groups, comments: &str) -> String {
    let mut header = "ply\nformat binary_little_endian 1.0\ncomment unit mm\n".to_owned();
    let swatches = mesh.palette().iter().enumerate().map(|(tag, swatch)| {
        let [red, green, blue] = swatch.rgb;
        format!("tag {tag} {red} {green} {blue} {}", swatch.name)
    });
    let faces = groups
        .iter()
        .map(|group| format!("faces {} {} tag {}", group.triangles.start, group.triangles.len(), group.tag));
    for line in comments.lines().map(str::to_owned).chain(swatches).chain(faces) {
        comment(&mut header, &line);
    }
    // Writing into a string cannot fail.
    let _ = writeln!(header, "element vertex {}", mesh.positions().len());
    for axis in ["x", "y", "z"] {
        let _ = writeln!(header, "property double {axis}");
    }
    for channel in ["red", "green", "blue", "tag"] {
        let _ = writeln!(header, "property uint8 {channel}");
    }
    let _ = writeln!(header, "element face {}", mesh.triangles().len());
    header.push_str("property list uint8 uint32 vertex_indices\nend_header\n");
    header
}

/// Greatest number of characters of a comment. MeshLab refuses lines of 512 characters, VTK reads nothing after one
/// of 4,096, and Open3D aborts at 1,024.
const COMMENT: usize = 400;

fn comment(header: &mut String, text: &str) {
    // A line break within the text would end the comment, and readers expect ASCII.
    let ascii: Vec<char> =
        text.chars().map(|c| if c == ' ' || c.is_ascii_graphic() { c } else { '?' }).collect();
    header.push_str("comment ");
    for (line, characters) in ascii.chunks(COMMENT).enumerate() {
        header.push_str(if line == 0 { "" } else { "\ncomment +" });
        header.extend(characters);
    }
    header.push('\n');
}

fn vertex(position: [f64; 3], [red, green, blue]: [u8; 3], tag: u8) -> [u8; 28] {
    let mut bytes = [0; 28];
    for (slot, coordinate) in bytes.chunks_exact_mut(8).zip(position) {
        slot.copy_from_slice(&coordinate.to_le_bytes());
    }
    bytes[24..].copy_from_slice(&[red, green, blue, tag]);
    bytes
}

fn face(triangle: [u32; 3]) -> [u8; 13] {
    let mut bytes = [0; 13];
    bytes[0] = 3;
    for (slot, index) in bytes[1..].chunks_exact_mut(4).zip(triangle) {
        slot.copy_from_slice(&index.to_le_bytes());
    }
    bytes
}
