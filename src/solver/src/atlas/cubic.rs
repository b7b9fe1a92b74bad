//! The cubic between two nodes of an arc, with the tangents of the curve at both.

use super::arc_node::ArcNode;

/// c(t) for t from 0 to 1: a Hermite cubic, in power form.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cubic {
    coefficients: [[f64; 2]; 4],
    chord: [f64; 2],
    start: [f64; 2],
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

impl Cubic {
    /// The cubic whose speed at both ends is the chord's length. A node without a direction has that of the chord.
    pub(super) fn between(a: &ArcNode, b: &ArcNode) -> Self {
        let chord = [b.at[0] - a.at[0], b.at[1] - a.at[1]];
        let length = chord[0].hypot(chord[1]);
        let velocity = |node: &ArcNode| {
            let Some(d) = node.direction else { return chord };
            let along = d[0] * chord[0] + d[1] * chord[1];
            d.map(|component| component * length.copysign(along))
        };
        let [from, to] = [velocity(a), velocity(b)];
        let coefficients = [
            [0.0; 2],
            from,
            std::array::from_fn(|i| 3.0 * chord[i] - 2.0 * from[i] - to[i]),
            std::array::from_fn(|i| from[i] + to[i] - 2.0 * chord[i]),
        ];
        Self { coefficients, chord, start: a.at }
    }

    /// c(t) less the start.
    fn offset(&self, t: f64) -> [f64; 2] {
        let [_, b, c, d] = self.coefficients;
        std::array::from_fn(|i| t * (b[i] + t * (c[i] + t * d[i])))
    }

    fn velocity(&self, t: f64) -> [f64; 2] {
        let [_, b, c, d] = self.coefficients;
        std::array::from_fn(|i| b[i] + t * (2.0 * c[i] + t * 3.0 * d[i]))
    }

    /// The area between the cubic and its chord, both from `from` to `to`; positive if the cubic is to the right.
    pub(super) fn area(&self, [from, to]: [f64; 2]) -> f64 {
        /// Nodes and weights of Gauss's rule with three nodes, which is exact here.
        const RULE: [[f64; 2]; 3] =
            [[-0.774_596_669_241_483_4, 5.0 / 9.0], [0.0, 8.0 / 9.0], [0.774_596_669_241_483_4, 5.0 / 9.0]];
        let (half, middle, start) = (0.5 * (to - from), 0.5 * (to + from), self.offset(from));
        let sum: f64 = RULE
            .iter()
            .map(|[node, weight]| {
                let t = middle + half * node;
                let offset = self.offset(t);
                weight * cross([offset[0] - start[0], offset[1] - start[1]], self.velocity(t))
            })
            .sum();
        0.5 * half * sum
    }

    /// The distance between a point of the curve near the middle and the cubic, across the chord.
    pub(super) fn deviation(&self, point: [f64; 2]) -> f64 {
        let length = self.chord[0].hypot(self.chord[1]);
        if length == 0.0 {
            return 0.0;
        }
        let offset = [point[0] - self.start[0], point[1] - self.start[1]];
        let t = ((offset[0] * self.chord[0] + offset[1] * self.chord[1]) / (length * length)).clamp(0.0, 1.0);
        let own = self.offset(t);
        cross([offset[0] - own[0], offset[1] - own[1]], self.chord).abs() / length
    }
}
