//! The result of the work on one part of the plane.

use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasherDefault, Hasher};

use super::super::domain::Domain;
use super::site::Site;
use crate::pose::Point;

/// The bits of a point's coordinates. Points with equal bits are the same.
pub(super) type Key = [u64; 2];

/// Hashes a [`Key`]. Nothing depends on the order of the table.
#[derive(Default)]
pub(super) struct Mixer(u64);

impl Hasher for Mixer {
    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 32)
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(u64::from(byte));
        }
    }

    fn write_u64(&mut self, word: u64) {
        let mixed = (self.0.rotate_left(23) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = mixed ^ (mixed >> 29);
    }

    fn write_u32(&mut self, word: u32) {
        self.write_u64(u64::from(word));
    }

    fn write_usize(&mut self, word: usize) {
        self.write_u64(word as u64);
    }
}

pub(super) type Set<K> = HashSet<K, BuildHasherDefault<Mixer>>;
pub(super) type Table<K, V> = HashMap<K, V, BuildHasherDefault<Mixer>>;

/// A vertex of the plane and its column's ends in the image.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Vertex {
    pub(in super::super) at: [f64; 2],
    /// Lower and upper.
    pub(in super::super) ends: [Point; 2],
    /// Whether the two ends are the same point.
    pub(in super::super) pinched: bool,
}

/// A triangle of the plane, counter-clockwise, and the sliders, or the table, that bind the lower and
/// the upper sheet on it.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Triangle {
    pub(in super::super) corners: [u32; 3],
    pub(in super::super) sliders: [u8; 2],
}

/// A side of the domain, which lies to its left, and the limit that ends the domain there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) struct Rim {
    pub(in super::super) ends: [u32; 2],
    pub(in super::super) limit: u8,
}

/// Vertices, triangles and sides of a part of the domain.
#[derive(Default)]
pub(super) struct Patch {
    pub(super) vertices: Vec<Vertex>,
    pub(super) triangles: Vec<Triangle>,
    /// Sides on limits. A side that occurs in both directions is inside the domain.
    pub(super) rims: Vec<Rim>,
    numbers: Table<Key, u32>,
    /// Midpoints of edges that occurred once, kept for the triangle on the other side.
    middles: Table<Key, Site>,
}

impl Patch {
    pub(super) fn middle(&mut self, domain: &Domain<'_>, a: &Site, b: &Site) -> Site {
        let ([ax, ay], [bx, by]) = (a.at(), b.at());
        let at = [0.5 * (ax + bx), 0.5 * (ay + by)];
        if let Some(site) = self.middles.remove(&key(at)) {
            return site;
        }
        let site = Site::new(domain, at);
        self.middles.insert(key(at), site.clone());
        site
    }

    /// Triangles of a surface over it: two sheets, and two for each side's wall.
    pub(super) fn surface_triangles(&self) -> usize {
        2 * (self.triangles.len() + self.rims.len())
    }

    /// Discards data that only the work itself needed.
    pub(super) fn forget(&mut self) {
        self.numbers = Table::default();
        self.middles = Table::default();
    }

    /// The number of the vertex at a site.
    pub(super) fn vertex(&mut self, domain: &Domain<'_>, site: &Site) -> u32 {
        let next = u32::try_from(self.vertices.len()).unwrap_or(u32::MAX);
        let number = *self.numbers.entry(key(site.at())).or_insert(next);
        if number == next {
            self.vertices.push(Vertex {
                at: site.at(),
                ends: site.ends(domain),
                pinched: !domain.flat() && site.pinched(),
            });
        }
        number
    }
}

pub(super) fn key(at: [f64; 2]) -> Key {
    // +0 makes the two zeros one.
    at.map(|coordinate| (coordinate + 0.0).to_bits())
}
