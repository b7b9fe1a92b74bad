//! The layout of the binary chunk: the vertices, then the indices; in both the data of one tag are contiguous.

use std::ops::Range;

use super::placement::Placement;
use crate::Mesh;
use crate::groups::Groups;
use crate::shading::Shading;

/// Bytes of one vertex: three floats of position, three of the normal.
pub(super) const STRIDE: usize = 24;

/// The binary chunk's measures.
pub(super) struct Layout {
    /// One for each tag that occurs.
    pub(super) primitives: Vec<PrimitiveLayout>,
}

/// The data of one tag.
pub(super) struct PrimitiveLayout {
    pub(super) tag: u8,
    /// The range of its split vertices.
    pub(super) vertices: Range<usize>,
    /// The range of its indices, three a triangle. They count from the primitive's first vertex.
    pub(super) indices: Range<usize>,
    /// The least and greatest coordinates of the written vertices, m.
    pub(super) bounds: [[f32; 3]; 2],
}

impl Layout {
    pub(super) fn new(mesh: &Mesh, groups: &Groups, shading: &Shading, placement: &Placement) -> Self {
        let primitives = groups.iter().map(|group| {
            let vertices = shading.vertices.partition_point(|vertex| vertex.tag < group.tag)
                ..shading.vertices.partition_point(|vertex| vertex.tag <= group.tag);
            let positions = shading.vertices[vertices.clone()]
                .iter()
                .map(|vertex| placement.position(mesh.positions()[vertex.vertex as usize]));
            PrimitiveLayout {
                tag: group.tag,
                bounds: bounds(positions),
                vertices,
                indices: 3 * group.triangles.start..3 * group.triangles.end,
            }
        });
        Self { primitives: primitives.collect() }
    }

    /// True if 16 bits hold every index; 65535 itself is reserved by glTF.
    pub(super) fn short_indices(&self) -> bool {
        self.primitives.iter().all(|primitive| u16::try_from(primitive.vertices.len()).is_ok())
    }

    /// Bytes of an index.
    pub(super) fn index_size(&self) -> u64 {
        if self.short_indices() { 2 } else { 4 }
    }

    pub(super) fn vertex_bytes(&self) -> u64 {
        self.primitives.last().map_or(0, |primitive| primitive.vertices.end) as u64 * STRIDE as u64
    }

    pub(super) fn index_bytes(&self) -> u64 {
        self.primitives.last().map_or(0, |primitive| primitive.indices.end) as u64 * self.index_size()
    }

    pub(super) fn bytes(&self) -> u64 {
        self.vertex_bytes() + self.index_bytes()
    }

    /// The chunk's length, a multiple of four.
    pub(super) fn chunk(&self) -> u64 {
        self.bytes().next_multiple_of(4)
    }

    /// The zeros between the last index and the chunk's end: two after an odd number of short triangles.
    pub(super) fn padding(&self) -> usize {
        if self.bytes() == self.chunk() { 0 } else { 2 }
    }
}

pub(super) fn bounds(positions: impl Iterator<Item = [f32; 3]>) -> [[f32; 3]; 2] {
    positions.fold([[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]], |[min, max], position| {
        [
            std::array::from_fn(|axis| min[axis].min(position[axis])),
            std::array::from_fn(|axis| max[axis].max(position[axis])),
        ]
    })
}

#[cfg(test)]
mod tests {
    use super::{Layout, PrimitiveLayout};

    fn layout(vertices: usize, indices: usize) -> Layout {
        let primitive =
            |tag, vertices, indices| PrimitiveLayout { tag, vertices, indices, bounds: [[0.0; 3]; 2] };
        Layout { primitives: vec![primitive(0, 0..3, 0..3), primitive(1, 3..3 + vertices, 3..3 + indices)] }
    }

    #[test]
    fn indices_have_32_bits_if_a_primitive_needs_them() {
        assert_eq!(layout(65_535, 3).index_bytes(), 12);
        assert_eq!(layout(65_536, 3).index_bytes(), 24);
    }

    #[test]
    fn the_length_of_the_chunk_is_a_multiple_of_four() {
        for triangles in 1..5 {
            let layout = layout(3, 3 * triangles);
            assert_eq!(layout.bytes() + layout.padding() as u64, layout.chunk());
            assert_eq!(layout.chunk() % 4, 0);
        }
    }
}
