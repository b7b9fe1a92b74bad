//! Linear programs in a few variables with many constraints: the dual simplex method.
//!
//! It begins at the corner of the bounds where the objective is greatest, and adds the constraint that is broken most
//! until none is. The objective falls with each step, so the last corner is the optimum.

use nalgebra::{SMatrix, SVector};

/// Number of variables.
pub(super) const VARIABLES: usize = 7;
/// Greatest number of steps.
const STEPS: usize = 400;
/// Excess over a constraint that counts as rounding.
const ROUNDING: f64 = 1e-12;

pub(super) type Vector = SVector<f64, VARIABLES>;

/// normal · x <= limit.
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfSpace {
    pub(super) normal: Vector,
    pub(super) limit: f64,
}

/// The greatest value of `objective` · x, which has no negative component, within bounds and half spaces. `None` if
/// there is no such x, or if the method does not end.
pub(super) fn maximum(
    objective: &Vector,
    [lower, upper]: [&Vector; 2],
    half_spaces: &[HalfSpace],
) -> Option<Vector> {
    let mut all: Vec<HalfSpace> = (0..VARIABLES)
        .flat_map(|i| {
            let mut normal = Vector::zeros();
            normal[i] = 1.0;
            [HalfSpace { normal, limit: upper[i] }, HalfSpace { normal: -normal, limit: -lower[i] }]
        })
        .collect();
    all.extend(half_spaces);
    let mut basis: [usize; VARIABLES] = std::array::from_fn(|i| 2 * i);
    let mut x = *upper;
    let mut multipliers = *objective;
    for _ in 0..STEPS {
        let excess = |space: &HalfSpace| space.normal.dot(&x) - space.limit;
        let broken = all.iter().map(excess).enumerate().fold((0, f64::NEG_INFINITY), |worst, (i, excess)| {
            if excess > worst.1 { (i, excess) } else { worst }
        });
        if broken.1 <= ROUNDING {
            return Some(x);
        }
        let columns = SMatrix::<f64, VARIABLES, VARIABLES>::from_columns(&basis.map(|i| all[i].normal));
        let inverse = columns.try_inverse()?;
        let direction = inverse * all[broken.0].normal;
        let (leaving, step) = ratio(&multipliers, &direction)?;
        multipliers -= direction * step;
        multipliers[leaving] = step;
        basis[leaving] = broken.0;
        let columns = SMatrix::<f64, VARIABLES, VARIABLES>::from_columns(&basis.map(|i| all[i].normal));
        let limits = Vector::from(basis.map(|i| all[i].limit));
        x = columns.transpose().lu().solve(&limits)?;
    }
    None
}

/// The constraint that leaves the basis: that whose multiplier vanishes first; of several, that which leaves fastest.
fn ratio(multipliers: &Vector, direction: &Vector) -> Option<(usize, f64)> {
    let mut found: Option<(usize, f64)> = None;
    for i in 0..VARIABLES {
        if direction[i] <= 1e-11 {
            continue;
        }
        let ratio = multipliers[i].max(0.0) / direction[i];
        let is_better = found.is_none_or(|(best, least)| {
            ratio < least || (ratio <= least * (1.0 + 1e-12) && direction[i] > direction[best])
        });
        if is_better {
            found = Some((i, ratio));
        }
    }
    found
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use super::{HalfSpace, Vector, maximum};

    /// A deterministic sequence of numbers between -1 and 1.
    fn numbers() -> impl FnMut() -> f64 {
        let mut state = 12_345_u64;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(1_u32 << 30) - 1.0
        }
    }

    #[test]
    fn the_optimum_keeps_all_constraints_and_no_random_place_is_better() {
        let mut number = numbers();
        for _ in 0..50 {
            let half_spaces: Vec<HalfSpace> = (0..300)
                .map(|_| HalfSpace {
                    normal: Vector::from_fn(|i, _| if i == 5 { 1.0 } else { number() }),
                    limit: 0.3 + number().abs(),
                })
                .collect();
            let (lower, upper) = (Vector::repeat(-1.0), Vector::repeat(1.0));
            let mut objective = Vector::zeros();
            (objective[5], objective[6]) = (1.0, 10.0);
            let best = maximum(&objective, [&lower, &upper], &half_spaces).unwrap();
            let keeps = |x: &Vector, room: f64| {
                half_spaces.iter().all(|space| space.normal.dot(x) <= space.limit + room)
                    && x.iter().all(|x| x.abs() <= 1.0 + room)
            };
            assert!(keeps(&best, 1e-9));
            for _ in 0..300 {
                // Near the optimum, where a better place would be.
                let other = best + Vector::from_fn(|_, _| 0.05 * number());
                assert!(!keeps(&other, 0.0) || objective.dot(&other) <= objective.dot(&best) + 1e-9);
            }
        }
    }

    #[test]
    fn contradictions_have_no_optimum() {
        let mut normal = Vector::zeros();
        normal[0] = 1.0;
        let spaces = [HalfSpace { normal, limit: -0.5 }, HalfSpace { normal: -normal, limit: 0.4 }];
        let (lower, upper) = (Vector::repeat(-1.0), Vector::repeat(1.0));
        assert!(maximum(&Vector::repeat(1.0), [&lower, &upper], &spaces).is_none());
    }
}
