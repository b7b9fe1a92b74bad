//! A compact binary form of a mesh that reads back exactly. It is for internal storage, not for exchange.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::{Mesh, MeshError, Swatch};

/// Identifies the format and its layout.
const LAYOUT: [u8; 8] = *b"verneM01";

/// The reason why bytes cannot be decoded.
#[derive(Debug)]
pub enum UnpackError {
    /// The bytes are not a packed mesh of this layout, or are damaged.
    Bytes(postcard::Error),
    /// The bytes decode to data that is not a mesh.
    Mesh(MeshError),
}

impl std::fmt::Display for UnpackError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Bytes(error) => write!(f, "not a packed mesh: {error}"),
            Self::Mesh(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for UnpackError {}

#[derive(Serialize, Deserialize)]
struct Packed<'a> {
    layout: [u8; 8],
    positions: Cow<'a, [[f64; 3]]>,
    triangles: Cow<'a, [[u32; 3]]>,
    #[serde(borrow)]
    tags: Cow<'a, [u8]>,
    palette: Cow<'a, [Swatch]>,
}

/// Encodes the mesh in about 30 bytes a triangle.
///
/// # Errors
///
/// The encoder's error. The encoder writes to memory only.
///
/// # References
///
/// [postcard](https://postcard.jamesmunns.com): the wire format.
///
/// # Examples
///
/// ```
#[doc = include_str!("doctest/tetrahedron.md")]
/// use verne_mesh::packed::{pack, unpack};
///
/// assert_eq!(unpack(&pack(&mesh)?)?, mesh);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn pack(mesh: &Mesh) -> Result<Vec<u8>, postcard::Error> {
    postcard::to_stdvec(&Packed {
        layout: LAYOUT,
        positions: mesh.positions().into(),
        triangles: mesh.triangles().into(),
        tags: mesh.tags().into(),
        palette: mesh.palette().into(),
    })
}

/// Decodes the mesh that [`pack`] encoded. Numbers are the same to the last bit.
///
/// # Errors
///
/// - [`UnpackError::Bytes`]: `bytes` are not a packed mesh of this layout, or are damaged.
/// - [`UnpackError::Mesh`]: they decode to data that is not a mesh.
///
/// # References
///
/// [postcard](https://postcard.jamesmunns.com): the wire format.
///
/// # Examples
///
/// ```
/// use verne_mesh::packed::{UnpackError, unpack};
///
/// assert!(matches!(unpack(b"{}"), Err(UnpackError::Bytes(_))));
/// ```
pub fn unpack(bytes: &[u8]) -> Result<Mesh, UnpackError> {
    let packed: Packed<'_> = postcard::from_bytes(bytes).map_err(UnpackError::Bytes)?;
    if packed.layout != LAYOUT {
        return Err(UnpackError::Bytes(postcard::Error::DeserializeBadEncoding));
    }
    let Packed { positions, triangles, tags, palette, .. } = packed;
    Mesh::new(positions.into_owned(), triangles.into_owned(), tags.into_owned(), palette.into_owned())
        .map_err(UnpackError::Mesh)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "what a test cannot prepare has failed it")]
mod tests {
    use super::{pack, unpack};
    use crate::{Mesh, Swatch};

    fn triangle() -> Mesh {
        let positions = vec![[0.1, -0.0, 1e300], [1.0, 5e-324, 0.0], [0.0, 1.0, std::f64::consts::PI]];
        let palette = ["first", "zweite ü"].map(|name| Swatch { name: name.to_owned(), rgb: [1, 2, 255] });
        Mesh::new(positions, vec![[0, 1, 2], [2, 1, 0]], vec![1, 0], palette.to_vec()).unwrap()
    }

    #[test]
    fn a_packed_mesh_unpacks_to_itself() {
        for mesh in [triangle(), Mesh::new(vec![], vec![], vec![], vec![]).unwrap()] {
            assert_eq!(unpack(&pack(&mesh).unwrap()).unwrap(), mesh);
        }
    }

    #[test]
    fn damaged_bytes_are_refused() {
        let bytes = pack(&triangle()).unwrap();
        for end in 0..bytes.len() {
            assert!(unpack(&bytes[..end]).is_err(), "{end}");
        }
        let mut foreign = bytes.clone();
        foreign[0] ^= 1;
        assert!(unpack(&foreign).is_err());
        assert!(unpack(b"{}").is_err());
    }
}
