//! Binary STL in millimetres, for slicers and CAD. It has neither shared vertices nor tags.

use std::io::{self, BufWriter, Write};

use crate::vector::single;
use crate::{Mesh, facet};

const HEADER: usize = 80;

/// Writes the mesh as a binary STL. The header has room for about sixty bytes of the title.
///
/// # Units
///
/// Millimetres, in single precision; the format itself has no unit.
///
/// # Errors
///
/// The error of `out`.
///
/// # References
///
/// [Library of Congress, STL binary](https://www.loc.gov/preservation/digital/formats/fdd/fdd000505.shtml).
///
/// # Examples
///
/// ```
#[doc = include_str!("doctest/tetrahedron.md")]
/// let mut file = Vec::new();
/// verne_mesh::stl::write(&mesh, "tetrahedron", &mut file)?;
/// assert_eq!(file.len(), 80 + 4 + 50 * mesh.triangles().len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write(mesh: &Mesh, title: &str, out: impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    out.write_all(&header(title))?;
    let count = u32::try_from(mesh.triangles().len()).map_err(io::Error::other)?;
    out.write_all(&count.to_le_bytes())?;
    for triangle in mesh.triangles() {
        let corners = mesh.corners(triangle);
        // By convention the normal of a triangle without a normal is zero.
        let normal = facet::normal(corners).unwrap_or_default();
        out.write_all(&record([normal, corners[0], corners[1], corners[2]]))?;
    }
    out.flush()
}

/// Makes the header. It does not begin with "solid", by which readers recognise a text file.
fn header(title: &str) -> [u8; HEADER] {
    let text = format!("binary STL, mm; {title}");
    let ascii = text.chars().map(|c| if c.is_ascii_graphic() { c } else { ' ' });
    let mut header = [b' '; HEADER];
    for (slot, character) in header.iter_mut().zip(ascii) {
        // Only ASCII is left.
        *slot = u8::try_from(character).unwrap_or(b' ');
    }
    header
}

/// A record: twelve numbers and two attribute bytes. Their meaning is not standardised, so they are zero.
fn record(vectors: [[f64; 3]; 4]) -> [u8; 50] {
    let mut bytes = [0; 50];
    for (slot, &number) in bytes.chunks_exact_mut(4).zip(vectors.map(single).as_flattened()) {
        slot.copy_from_slice(&number.to_le_bytes());
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::header;

    #[test]
    fn the_header_is_ascii_and_does_not_begin_with_solid() {
        let short = header("solid, \u{e9}t\u{e9}\n");
        assert_eq!(short.trim_ascii_end(), b"binary STL, mm; solid,  t");
        let long = header(&"x".repeat(200));
        assert!(long.ends_with(b"xxx"));
    }
}
