//! Binary PLY, in millimetres and double precision: for what follows in other programs.

use std::fmt::Write as _;
use std::io::{self, BufWriter, Write};

use crate::Mesh;

/// Writes the mesh as a little-endian PLY: vertices with colour and tag, faces with their tag. Each line of
/// the comments becomes a comment, and so does each swatch.
pub fn write(mesh: &Mesh, comments: &str, out: impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    out.write_all(header(mesh, comments).as_bytes())?;
    for (&position, tag) in mesh.positions().iter().zip(mesh.vertex_tags()) {
        out.write_all(&vertex(position, mesh.palette()[usize::from(tag)].rgb, tag))?;
    }
    for (&triangle, &tag) in mesh.triangles().iter().zip(mesh.tags()) {
        out.write_all(&face(triangle, tag))?;
    }
    out.flush()
}

fn header(mesh: &Mesh, comments: &str) -> String {
    let mut header = "ply\nformat binary_little_endian 1.0\ncomment unit mm\n".to_owned();
    let swatches = mesh.palette().iter().enumerate().map(|(tag, swatch)| {
        let [red, green, blue] = swatch.rgb;
        format!("tag {tag} {red} {green} {blue} {}", swatch.name)
    });
    for line in comments.lines().map(str::to_owned).chain(swatches) {
        header.push_str("comment ");
        // A line's end within the text would end the comment, and readers expect ASCII.
        header.extend(line.chars().map(|c| if c == ' ' || c.is_ascii_graphic() { c } else { '?' }));
        header.push('\n');
    }
    // Writing into a string cannot fail.
    let _ = writeln!(header, "element vertex {}", mesh.positions().len());
    for axis in ["x", "y", "z"] {
        let _ = writeln!(header, "property double {axis}");
    }
    for channel in ["red", "green", "blue", "tag"] {
        let _ = writeln!(header, "property uchar {channel}");
    }
    let _ = writeln!(header, "element face {}", mesh.triangles().len());
    header.push_str("property list uchar uint vertex_indices\nproperty uchar tag\nend_header\n");
    header
}

fn vertex(position: [f64; 3], [red, green, blue]: [u8; 3], tag: u8) -> [u8; 28] {
    let mut bytes = [0; 28];
    for (slot, coordinate) in bytes.chunks_exact_mut(8).zip(position) {
        slot.copy_from_slice(&coordinate.to_le_bytes());
    }
    bytes[24..].copy_from_slice(&[red, green, blue, tag]);
    bytes
}

fn face(triangle: [u32; 3], tag: u8) -> [u8; 14] {
    let mut bytes = [0; 14];
    bytes[0] = 3;
    for (slot, index) in bytes[1..13].chunks_exact_mut(4).zip(triangle) {
        slot.copy_from_slice(&index.to_le_bytes());
    }
    bytes[13] = tag;
    bytes
}
