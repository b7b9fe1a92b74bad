//! The best set-up near another one for some places: sequential linear programming in a trust region.
//!
//! Each step replaces every value by its tangent and maximises the least reserve within the limits. It is taken if the
//! values become better by a part of what the tangents promise; otherwise the region shrinks.

use super::linear_program::{HalfSpace, VARIABLES, Vector, maximum};
use super::problem::{PARAMETERS, PENALTY, Problem, Sampled, Score};
use crate::toolpath::set_up::SetUp;

/// Step of the central differences, mm.
const DIFFERENCE: f64 = 1e-3;
/// Improvement, in fractions of a range, that ends the search.
const LEAST_GAIN: f64 = 1e-10;
/// Half width of the region that ends the search, mm.
const LEAST_REGION: f64 = 1e-7;
/// Greatest half width of the region at first, mm, and the fraction of the bounds' width that it is at most.
const REGION: f64 = 200.0;
const FRACTION: f64 = 0.25;
/// Upper bound of the reserve in the linear program.
const MOST: f64 = 1e3;
/// Parts of the promised gain below which the region shrinks, and above which it grows.
const PARTS: [f64; 2] = [0.1, 0.7];

/// The best set-up that a search of at most `steps` steps finds, and its score.
pub(super) fn local_search(
    problem: &Problem<'_>,
    set: &[u32],
    start: [f64; PARAMETERS],
    steps: u32,
) -> ([f64; PARAMETERS], Score) {
    let mut now = problem.clamped(start);
    let mut sampled = problem.sample(set, &SetUp::of_parameters(now));
    let mut score = problem.score(&sampled);
    let widest = (0..PARAMETERS)
        .map(|i| (problem.bounds[i][1] - problem.bounds[i][0]) / problem.units[i])
        .fold(0.0, f64::max);
    let mut region = (FRACTION * widest).min(REGION);
    let mut rates = None;
    for _ in 0..steps {
        let tangents = rates.get_or_insert_with(|| slopes(problem, set, now));
        let Some((step, promised)) = step(problem, &sampled, tangents, now, region) else { break };
        let gain = promised - score.merit();
        if gain <= LEAST_GAIN {
            break;
        }
        let next = std::array::from_fn(|i| now[i] + step[i] * problem.units[i]);
        let next = problem.clamped(next);
        let there = problem.sample(set, &SetUp::of_parameters(next));
        let found = problem.score(&there);
        let part = (found.merit() - score.merit()) / gain;
        if part >= PARTS[0] {
            (now, sampled, score) = (next, there, found);
            rates = None;
            if part >= PARTS[1] {
                region *= 2.0;
            }
        } else {
            region *= 0.25;
            if region < LEAST_REGION {
                break;
            }
        }
    }
    (now, score)
}

/// The derivatives of all values by each parameter, in the units of the search.
fn slopes(problem: &Problem<'_>, set: &[u32], now: [f64; PARAMETERS]) -> Vec<Option<[Sampled; 2]>> {
    (0..PARAMETERS)
        .map(|i| {
            let [low, high] = problem.bounds[i];
            (low < high).then(|| {
                [-DIFFERENCE, DIFFERENCE].map(|difference| {
                    let mut there = now;
                    there[i] += difference * problem.units[i];
                    problem.sample(set, &SetUp::of_parameters(there))
                })
            })
        })
        .collect()
}

/// The step that the tangents make the best, and the merit that they promise.
fn step(
    problem: &Problem<'_>,
    sampled: &Sampled,
    slopes: &[Option<[Sampled; 2]>],
    now: [f64; PARAMETERS],
    region: f64,
) -> Option<(Vector, f64)> {
    let (mut lower, mut upper, mut objective) = (Vector::zeros(), Vector::zeros(), Vector::zeros());
    for i in 0..PARAMETERS {
        let [low, high] = problem.bounds[i].map(|end| (end - now[i]) / problem.units[i]);
        (lower[i], upper[i]) = (low.max(-region), high.min(region));
    }
    let [reserve, limit] = [VARIABLES - 2, VARIABLES - 1];
    let has_reserve = problem.score(sampled).reserve.is_finite();
    (lower[reserve], upper[reserve]) = (-MOST, if has_reserve { MOST } else { 0.0 });
    (lower[limit], upper[limit]) = (-MOST, 0.0);
    (objective[reserve], objective[limit]) = (1.0, PENALTY);
    let mut all: Vec<(HalfSpace, bool, f64)> = Vec::new();
    let mut add = |value: f64, ends: [Option<[f64; 2]>; PARAMETERS], has_reserve: bool| {
        if !value.is_finite() {
            return;
        }
        let mut normal = Vector::zeros();
        let mut change = 0.0;
        for i in 0..PARAMETERS {
            let slope = ends[i].map_or(0.0, |[low, high]| (high - low) / (2.0 * DIFFERENCE));
            // Beyond an end of the reach there is no value.
            let slope = if slope.is_finite() { slope } else { 0.0 };
            normal[i] = -slope;
            change += (slope * lower[i]).abs().max((slope * upper[i]).abs());
        }
        normal[if has_reserve { reserve } else { limit }] = 1.0;
        let limit = if has_reserve { value } else { value - problem.guard };
        all.push((HalfSpace { normal, limit }, has_reserve, change));
    };
    for (place, values) in sampled.places.iter().enumerate() {
        for (index, value) in values.iter().enumerate() {
            let ends = std::array::from_fn(|i| {
                Some(slopes[i].as_ref()?.each_ref().map(|there| there.places[place][index]))
            });
            add(*value, ends, problem.criteria.has_reserve[index]);
        }
    }
    for (cut, value) in sampled.cuts.iter().enumerate() {
        let ends = std::array::from_fn(|i| Some(slopes[i].as_ref()?.each_ref().map(|there| there.cuts[cut])));
        add(*value, ends, problem.criteria.rotary_has_reserve);
    }
    // The optimum is at most the least value with its greatest change: half spaces beyond it exclude nothing.
    let most = |with_reserve: bool| {
        let same = all.iter().filter(|(_, has_reserve, _)| *has_reserve == with_reserve);
        same.map(|(space, _, change)| space.limit + change).fold(MOST, f64::min)
    };
    let most = [most(false).min(0.0), most(true)];
    let spaces: Vec<HalfSpace> = all
        .iter()
        .filter(|(space, has_reserve, change)| space.limit - change <= most[usize::from(*has_reserve)])
        .map(|(space, ..)| *space)
        .collect();
    let best = maximum(&objective, [&lower, &upper], &spaces)?;
    Some((best, objective.dot(&best)))
}
