//! The topology of a surface, computed independently of the surface's own code.

use std::collections::HashMap;

use verne_solver::workspace::Surface;

/// The topology of a surface; all faults zero for a closed oriented manifold.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Topology {
    /// Edges without exactly one triangle in each direction.
    pub(crate) bad_edges: usize,
    /// Vertices whose triangles are not one ring.
    pub(crate) bad_vertices: usize,
    /// Vertices that no triangle uses.
    pub(crate) idle_vertices: usize,
    pub(crate) components: usize,
    /// Vertices less edges plus triangles.
    pub(crate) euler: i64,
    /// Components by genus: the first number counts spheres.
    pub(crate) genus: Vec<usize>,
}

impl Topology {
    pub(crate) fn is_manifold(&self) -> bool {
        self.bad_edges + self.bad_vertices + self.idle_vertices == 0
    }

    pub(crate) fn of(surface: &Surface) -> Self {
        let mut found = Self::default();
        let mut edges: HashMap<[u32; 2], [u32; 2]> = HashMap::new();
        let mut component: Vec<u32> = (0..).take(surface.positions.len()).collect();
        let mut links: Vec<Vec<[u32; 2]>> = vec![Vec::new(); surface.positions.len()];
        for &[a, b, c] in &surface.triangles {
            for [a, b, c] in [[a, b, c], [b, c, a], [c, a, b]] {
                edges.entry([a.min(b), a.max(b)]).or_default()[usize::from(a > b)] += 1;
                links[a as usize].push([b, c]);
                let (a, b) = (root(&component, a), root(&component, b));
                component[a as usize] = b;
            }
        }
        found.bad_edges = edges.values().filter(|sides| **sides != [1, 1]).count();
        found.idle_vertices = links.iter().filter(|link| link.is_empty()).count();
        found.bad_vertices = links.iter().filter(|link| !link.is_empty() && !is_ring(link)).count();
        let mut euler: HashMap<u32, i64> = HashMap::new();
        for vertex in (0..).take(component.len()) {
            *euler.entry(root(&component, vertex)).or_default() += 1;
        }
        for [a, _] in edges.keys() {
            *euler.entry(root(&component, *a)).or_default() -= 1;
        }
        for [a, ..] in &surface.triangles {
            *euler.entry(root(&component, *a)).or_default() += 1;
        }
        found.components = euler.len();
        found.euler = euler.values().sum();
        for euler in euler.values() {
            let genus = usize::try_from((2 - euler) / 2).unwrap_or(0);
            found.genus.resize(found.genus.len().max(genus + 1), 0);
            found.genus[genus] += 1;
        }
        found
    }
}

fn root(component: &[u32], mut vertex: u32) -> u32 {
    while component[vertex as usize] != vertex {
        vertex = component[vertex as usize];
    }
    vertex
}

/// Whether the sides opposite to a vertex are one closed ring.
fn is_ring(link: &[[u32; 2]]) -> bool {
    let next: HashMap<u32, u32> = link.iter().map(|&[from, to]| (from, to)).collect();
    let (start, mut here, mut steps) = (link[0][0], link[0][0], 0);
    while let Some(&to) = next.get(&here) {
        (here, steps) = (to, steps + 1);
        if here == start || steps > link.len() {
            break;
        }
    }
    here == start && steps == link.len()
}
