//! Hash tables with points or vertex numbers as keys. Nothing depends on the order of their entries.

use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasherDefault, Hasher};

/// Hashes a few words by rotation and multiplication.
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

pub(super) type FastSet<K> = HashSet<K, BuildHasherDefault<Mixer>>;
pub(super) type FastMap<K, V> = HashMap<K, V, BuildHasherDefault<Mixer>>;

/// The bits of a point's coordinates. Points with equal bits are the same.
pub(super) type PointKey = [u64; 2];

pub(super) fn point_key(at: [f64; 2]) -> PointKey {
    // +0 makes the two zeros one.
    at.map(|coordinate| (coordinate + 0.0).to_bits())
}
