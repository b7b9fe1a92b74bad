//! The vertex of a zonotope that is farthest from its centre.

use nalgebra::Vector3;

use crate::parameter::PARAMETERS;

/// Sine of an angle below which two segments count as parallel, and a segment as normal to a direction.
const PARALLEL: f64 = 1e-12;

/// The sign of each segment at a vertex: 1 or -1, or 0 for a segment without length.
pub(super) type Signs = [f64; PARAMETERS];

/// Finds signs s that maximise |Σ `s_i` `g_i`|: the [module's documentation](super) has the derivation.
pub(super) fn farthest_vertex(segments: &[Vector3<f64>; PARAMETERS]) -> Signs {
    let lengths = segments.map(|segment| segment.norm());
    // One segment alone, or several parallel ones.
    let longest = (0..PARAMETERS).max_by(|a, b| lengths[*a].total_cmp(&lengths[*b])).unwrap_or_default();
    let mut best = Candidate::new(segments, |k| sign(segments[k].dot(&segments[longest])));
    for i in 0..PARAMETERS {
        for j in i + 1..PARAMETERS {
            let normal = segments[i].cross(&segments[j]);
            if normal.norm() > PARALLEL * lengths[i] * lengths[j] {
                let flag = Flag::new(segments, &lengths, normal, segments[i]);
                for (across, along) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                    best = best.farther(Candidate::new(segments, |k| flag.sign(k, across, along)));
                }
            }
        }
    }
    best.signs
}

/// The signs of a vertex and its distance from the centre, squared.
struct Candidate {
    signs: Signs,
    square: f64,
}

impl Candidate {
    fn new(segments: &[Vector3<f64>; PARAMETERS], sign: impl Fn(usize) -> f64) -> Self {
        let signs: Signs = std::array::from_fn(sign);
        let vertex: Vector3<f64> = segments.iter().zip(signs).map(|(segment, sign)| segment * sign).sum();
        Self { signs, square: vertex.norm_squared() }
    }

    fn farther(self, other: Self) -> Self {
        if other.square > self.square { other } else { self }
    }
}

/// A facet's normal, an edge's normal within the facet, and the edge's direction: the sign of each segment along them.
struct Flag([[f64; 3]; PARAMETERS]);

impl Flag {
    fn new(
        segments: &[Vector3<f64>; PARAMETERS],
        lengths: &[f64; PARAMETERS],
        normal: Vector3<f64>,
        edge: Vector3<f64>,
    ) -> Self {
        let directions = [normal, normal.cross(&edge), edge].map(|direction| direction.normalize());
        Self(std::array::from_fn(|k| {
            directions.map(|direction| {
                let along = segments[k].dot(&direction);
                if along.abs() > PARALLEL * lengths[k] { sign(along) } else { 0.0 }
            })
        }))
    }

    /// The sign of a segment at the vertex on the given sides.
    fn sign(&self, k: usize, across: f64, along: f64) -> f64 {
        let [normal, edge_normal, edge] = self.0[k];
        if normal != 0.0 {
            normal
        } else if edge_normal != 0.0 {
            across * edge_normal
        } else {
            along * edge
        }
    }
}

fn sign(number: f64) -> f64 {
    if number == 0.0 { 0.0 } else { number.signum() }
}

#[cfg(test)]
mod tests;
