//! The ends of a window between values with different verdicts.

use super::sample::{Sample, WINDOW_PRECISION};
use crate::toolpath::PlanError;

/// Ratio of a distance from the expected end to the one before.
const GROWTH: f64 = 8.0;
/// Parameters of the root finder: the part of the interval by which an estimate is moved to its middle, and the number
/// of steps beyond those of bisection.
const TRUNCATION: f64 = 0.2;
const SLACK: i32 = 1;

/// Narrows an interval between different verdicts to a width, and counts the examined values: the ITP method, which
/// takes at most one step more than bisection, and a few where the margin is smooth.
pub(super) fn refined(
    [mut a, mut b]: [Sample; 2],
    width: f64,
    examine: impl Fn(f64) -> Result<Sample, PlanError>,
) -> Result<([Sample; 2], usize), PlanError> {
    let start = b.value - a.value;
    let mut count = 0;
    // The half-width that bisection would have with as many steps left.
    let mut reach = 0.5 * width;
    while 2.0 * reach < start {
        reach *= 2.0;
    }
    reach *= 2.0_f64.powi(SLACK);
    while b.value - a.value > width {
        let half = 0.5 * (b.value - a.value);
        let middle = a.value + half;
        let weights = [b.fraction.abs(), a.fraction.abs()];
        let estimate = (a.value * weights[0] + b.value * weights[1]) / (weights[0] + weights[1]);
        let estimate = if estimate.is_finite() { estimate } else { middle };
        let step = (TRUNCATION / start) * (2.0 * half).powi(2);
        let step = step.max(0.25 * width);
        let towards = middle - estimate;
        let moved = if step < towards.abs() { estimate + step.copysign(towards) } else { middle };
        let radius = (reach - half).max(0.0);
        let value = moved.clamp(middle - radius, middle + radius);
        if value <= a.value || value >= b.value {
            break;
        }
        let sample = examine(value)?;
        count += 1;
        if sample.is_feasible == a.is_feasible {
            a = sample;
        } else {
            b = sample;
        }
        reach *= 0.5;
    }
    Ok(([a, b], count))
}

/// Values near the end that the places of the path give, between two values whose plans have different verdicts: two
/// with different verdicts that are close together, if the places are right.
pub(super) fn bracket_near(
    places: &[Sample],
    [low, high]: [&Sample; 2],
    examine: impl Fn(f64) -> Result<Sample, PlanError>,
) -> Result<Vec<Sample>, PlanError> {
    let change = places.windows(2).find(|pair| pair[0].is_feasible != pair[1].is_feasible);
    let Some([a, b]) = change else { return Ok(Vec::new()) };
    let weights = [b.fraction.abs(), a.fraction.abs()];
    let expected = (a.value * weights[0] + b.value * weights[1]) / (weights[0] + weights[1]);
    if !expected.is_finite() {
        return Ok(Vec::new());
    }
    let mut found = Vec::new();
    let mut distance = 0.5 * WINDOW_PRECISION;
    let [mut is_low, mut is_high] = [false; 2];
    while !(is_low && is_high) {
        let [below, above] = [expected - distance, expected + distance];
        if below <= low.value || above >= high.value {
            break;
        }
        if !is_low {
            let sample = examine(below)?;
            is_low = sample.is_feasible == low.is_feasible;
            is_high |= !is_low;
            found.push(sample);
        }
        if !is_high {
            let sample = examine(above)?;
            is_high = sample.is_feasible == high.is_feasible;
            is_low |= !is_high;
            found.push(sample);
        }
        distance *= GROWTH;
    }
    Ok(found)
}
