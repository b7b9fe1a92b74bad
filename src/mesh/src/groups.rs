//! The triangles in the order of their tags.

use std::ops::Range;

use crate::Mesh;

/// The triangles of a mesh, ordered by tag. Files whose readers accept no scalar at a face keep the tags in this way.
pub(crate) struct Groups {
    order: Vec<u32>,
    groups: Vec<Group>,
}

/// The triangles of one tag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Group {
    pub(crate) tag: u8,
    /// Their range in the order.
    pub(crate) triangles: Range<usize>,
}

impl Groups {
    /// Triangles of one tag keep the order of the mesh. A tag that no triangle has makes no group.
    pub(crate) fn of(mesh: &Mesh) -> Self {
        let mut order: Vec<u32> = (0..).take(mesh.triangles().len()).collect();
        let tag = |triangle: u32| mesh.tags()[triangle as usize];
        order.sort_by_key(|&triangle| tag(triangle));
        let mut end = 0;
        let groups = order.chunk_by(|&a, &b| tag(a) == tag(b)).map(|group| {
            let start = end;
            end += group.len();
            Group { tag: tag(group[0]), triangles: start..end }
        });
        let groups = groups.collect();
        Self { order, groups }
    }

    /// The triangles' numbers in the mesh.
    pub(crate) fn order(&self) -> &[u32] {
        &self.order
    }

    /// In the order of their tags.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Group> {
        self.groups.iter()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use super::{Group, Groups};
    use crate::{Mesh, Swatch};

    #[test]
    fn groups_are_contiguous_and_keep_the_order_of_the_mesh() {
        let palette = ["a", "b", "c"].map(|name| Swatch { name: name.to_owned(), rgb: [0; 3] });
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let mesh = Mesh::new(positions, vec![[0, 1, 2]; 5], vec![2, 0, 2, 2, 0], palette.to_vec()).unwrap();
        let groups = Groups::of(&mesh);
        assert_eq!(groups.order(), [1, 4, 0, 2, 3]);
        let wanted = [Group { tag: 0, triangles: 0..2 }, Group { tag: 2, triangles: 2..5 }];
        assert!(groups.iter().eq(&wanted));
    }
}
