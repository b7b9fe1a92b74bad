//! Solids whose measures are known, for tests of the crate.

#![allow(dead_code, reason = "each test takes the solids that it wants")]
#![allow(clippy::unwrap_used, reason = "a solid that is no mesh ends the test")]

use std::collections::BTreeMap;

use verne_mesh::{Mesh, Swatch};

/// Two swatches: walls and ends.
pub(crate) fn palette() -> Vec<Swatch> {
    let swatch = |name: &str, rgb| Swatch { name: name.to_owned(), rgb };
    vec![swatch("wall", [70, 130, 180]), swatch("end", [220, 90, 40])]
}

/// Vertices, triangles and tags under construction.
#[derive(Default)]
pub(crate) struct SolidBuilder {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    tags: Vec<u8>,
}

impl SolidBuilder {
    /// A box between two corners, its ends at least and greatest z; inside out if `hollow`.
    pub(crate) fn block(mut self, low: [f64; 3], high: [f64; 3], hollow: bool) -> Self {
        let base = u32::try_from(self.positions.len()).unwrap();
        for index in 0..8 {
            let pick = |axis: usize| if index >> axis & 1 == 1 { high[axis] } else { low[axis] };
            self.positions.push([pick(0), pick(1), pick(2)]);
        }
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        for (face, [a, b, c, d]) in quads.into_iter().enumerate() {
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                let triangle = if hollow { [p, r, q] } else { [p, q, r] };
                self.triangles.push(triangle.map(|vertex| base + vertex));
                self.tags.push(u8::from(face < 2));
            }
        }
        self
    }

    /// A ball: an octahedron, each face cut into n² triangles and blown up; 8n² triangles, the tag by the
    /// sign of z.
    pub(crate) fn ball(mut self, centre: [f64; 3], radius: f64, n: i32) -> Self {
        let mut number = BTreeMap::new();
        for octant in 0..8 {
            let sign = [0, 1, 2].map(|axis| if octant >> axis & 1 == 1 { -1 } else { 1 });
            let mut at = |i: i32, j: i32| {
                let lattice = [i * sign[0], j * sign[1], (n - i - j) * sign[2]];
                *number.entry(lattice).or_insert_with(|| {
                    let [x, y, z] = lattice.map(f64::from);
                    let scale = radius / (x * x + y * y + z * z).sqrt();
                    let position = [centre[0] + x * scale, centre[1] + y * scale, centre[2] + z * scale];
                    self.positions.push(position);
                    u32::try_from(self.positions.len()).unwrap() - 1
                })
            };
            for i in 0..n {
                for j in 0..n - i {
                    let mut cells = vec![[at(i, j), at(i + 1, j), at(i, j + 1)]];
                    if i + j + 2 <= n {
                        cells.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                    }
                    let mirrored = sign.iter().product::<i32>() < 0;
                    for [p, q, r] in cells {
                        self.triangles.push(if mirrored { [p, r, q] } else { [p, q, r] });
                        self.tags.push(u8::from(sign[2] < 0));
                    }
                }
            }
        }
        self
    }

    /// A ring about the z axis, a tube of n sides and 3n sections.
    pub(crate) fn ring(mut self, radius: f64, tube: f64, n: u32) -> Self {
        let base = u32::try_from(self.positions.len()).unwrap();
        let turn = |part: u32, of: u32| (std::f64::consts::TAU * f64::from(part) / f64::from(of)).sin_cos();
        for section in 0..3 * n {
            for side in 0..n {
                let ((s, c), (height, reach)) = (turn(section, 3 * n), turn(side, n));
                let r = radius + tube * reach;
                self.positions.push([r * c, r * s, tube * height]);
                let vertex = |section: u32, side: u32| base + section % (3 * n) * n + side % n;
                let (a, b) = (vertex(section, side), vertex(section + 1, side));
                let (c, d) = (vertex(section + 1, side + 1), vertex(section, side + 1));
                self.triangles.extend([[a, b, c], [a, c, d]]);
                self.tags.extend([0, 0]);
            }
        }
        self
    }

    /// The mesh.
    pub(crate) fn mesh(self) -> Mesh {
        Mesh::new(self.positions, self.triangles, self.tags, palette()).unwrap()
    }

    /// The mesh without its first triangle.
    pub(crate) fn torn(mut self) -> Mesh {
        self.triangles.remove(0);
        self.tags.remove(0);
        self.mesh()
    }

    /// The mesh with its first triangle turned over.
    pub(crate) fn twisted(mut self) -> Mesh {
        self.triangles[0].swap(1, 2);
        self.mesh()
    }
}

/// A box of 30 × 20 × 10 mm, somewhere off the origin.
pub(crate) fn block() -> Mesh {
    SolidBuilder::default().block([-10.0, 5.0, 900.0], [20.0, 25.0, 910.0], false).mesh()
}

/// A coarse ball of radius 12.5 mm.
pub(crate) fn ball() -> Mesh {
    SolidBuilder::default().ball([100.0, -50.0, 1000.0], 12.5, 2).mesh()
}

/// No triangles.
pub(crate) fn empty() -> Mesh {
    SolidBuilder::default().mesh()
}
