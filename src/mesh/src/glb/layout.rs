//! What lies where in the binary chunk: the vertices, then the indices.

/// Bytes of one vertex: three floats of position, three of the normal, four of colour, the tag, and three
/// that bring the next vertex to a multiple of four.
pub(super) const STRIDE: usize = 32;

/// The binary chunk's measures.
pub(super) struct Layout {
    /// How many split vertices.
    pub(super) vertices: usize,
    /// How many indices, three a triangle.
    pub(super) indices: usize,
}

impl Layout {
    pub(super) fn new(vertices: usize, indices: usize) -> Self {
        Self { vertices, indices }
    }

    /// True if 16 bits hold every index; 65535 itself is reserved by glTF.
    pub(super) fn short_indices(&self) -> bool {
        u16::try_from(self.vertices).is_ok()
    }

    pub(super) fn vertex_bytes(&self) -> u64 {
        self.vertices as u64 * STRIDE as u64
    }

    pub(super) fn index_bytes(&self) -> u64 {
        self.indices as u64 * if self.short_indices() { 2 } else { 4 }
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

#[cfg(test)]
mod tests {
    use super::Layout;

    #[test]
    fn indices_grow_where_sixteen_bits_end() {
        assert_eq!(Layout::new(65_535, 3).index_bytes(), 6);
        assert_eq!(Layout::new(65_536, 3).index_bytes(), 12);
    }

    #[test]
    fn the_chunk_ends_on_a_multiple_of_four() {
        for triangles in 1..5 {
            let layout = Layout::new(3, 3 * triangles);
            assert_eq!(layout.bytes() + layout.padding() as u64, layout.chunk());
            assert_eq!(layout.chunk() % 4, 0);
        }
    }
}
