//! Why a list of triangles is no mesh.

use std::fmt;

/// What makes vertices, triangles and tags unfit to be a [`Mesh`](crate::Mesh).
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MeshFault {
    /// More vertices or corners than 32-bit indices can count.
    TooLarge,
    /// As many tags as triangles are wanted.
    TagCount {
        /// How many triangles there are.
        triangles: usize,
        /// How many tags there are.
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
        /// What it names.
        vertex: u32,
    },
    /// A triangle's tag has no swatch.
    NoSuchTag {
        /// The triangle.
        triangle: usize,
        /// Its tag.
        tag: u8,
    },
    /// No triangle uses the vertex: it would count in the bounds and in Euler's formula.
    Unused {
        /// The vertex.
        vertex: usize,
    },
}

impl fmt::Display for MeshFault {
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

impl std::error::Error for MeshFault {}
