//! The reasons why vertices, triangles and tags are not a mesh.

use std::fmt;

/// The reason why vertices, triangles and tags are not a [`Mesh`](crate::Mesh).
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MeshError {
    /// More vertices or corners than 32-bit indices can count.
    TooLarge,
    /// The number of tags differs from the number of triangles.
    TagCount {
        /// The number of triangles.
        triangles: usize,
        /// The number of tags.
        tags: usize,
    },
    /// A coordinate is infinite or not a number.
    NotFinite {
        /// The vertex it belongs to.
        vertex: usize,
    },
    /// A triangle names a vertex that does not exist.
    NoSuchVertex {
        /// The triangle.
        triangle: usize,
        /// The number of the vertex.
        vertex: u32,
    },
    /// A triangle's tag has no swatch.
    NoSuchTag {
        /// The triangle.
        triangle: usize,
        /// Its tag.
        tag: u8,
    },
    /// No triangle uses the vertex. It would count in the bounds and in Euler's formula.
    Unused {
        /// The vertex.
        vertex: usize,
    },
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLarge => write!(f, "more vertices or triangles than 32-bit indices can count"),
            Self::TagCount { triangles, tags } => write!(f, "{tags} tags for {triangles} triangles"),
            Self::NotFinite { vertex } => write!(f, "vertex {vertex} is not finite"),
            Self::NoSuchVertex { triangle, vertex } => {
                write!(f, "triangle {triangle} names vertex {vertex}, which does not exist")
            }
            Self::NoSuchTag { triangle, tag } => {
                write!(f, "triangle {triangle} has tag {tag}, which is not in the palette")
            }
            Self::Unused { vertex } => write!(f, "vertex {vertex} belongs to no triangle"),
        }
    }
}

impl std::error::Error for MeshError {}
