//! The intervals between refined ends.

use rayon::prelude::*;

use super::refine::refined;
use super::sample::{Found, WINDOW_PRECISION};
use super::search::Search;
use crate::toolpath::PlanError;
use crate::toolpath::report::LeastMargin;

/// The values with which the machine can run a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// The intervals, in order.
    pub intervals: Vec<WindowInterval>,
    /// If there is no interval: the examined value with the greatest worst margin, and this margin.
    pub nearest: Option<(f64, Option<LeastMargin>)>,
    /// Width of the intervals and gaps that the search may have missed.
    pub resolution: f64,
    /// Number of plans of the whole program.
    pub plans: usize,
}

/// An interval of values. The machine can run the program with both of its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindowInterval {
    /// The least and the greatest value.
    pub range: [f64; 2],
    /// The worst margin at most [`WINDOW_PRECISION`] outside of each end. `None`: the range that was asked for ends
    /// here.
    pub ends: [Option<LeastMargin>; 2],
    /// Greatest distance of two values inside, one after the other, at which the whole program was planned.
    pub step: f64,
}

/// Refines the ends between values with different verdicts.
pub(super) fn intervals(search: &Search<'_>, range: [f64; 2], found: Found) -> Result<Window, PlanError> {
    let Found { samples, resolution } = found;
    let brackets: Vec<_> =
        samples.windows(2).filter(|pair| pair[0].is_feasible != pair[1].is_feasible).collect();
    let refined: Vec<_> = brackets
        .par_iter()
        .map(|pair| refined([pair[0], pair[1]], WINDOW_PRECISION, |value| search.plan(value)))
        .collect::<Result<_, _>>()?;
    let plans = samples.len() + refined.iter().map(|(_, plans)| plans).sum::<usize>();
    let mut ends = refined.into_iter().map(|(ends, _)| ends);
    let mut intervals: Vec<WindowInterval> = Vec::new();
    // The open interval: its beginning, what is outside, the last value inside, and the greatest step.
    let mut open: Option<(f64, Option<LeastMargin>, f64, f64)> = None;
    for (number, sample) in samples.iter().enumerate() {
        let is_changed = number > 0 && samples[number - 1].is_feasible != sample.is_feasible;
        let [below, above] = if is_changed { ends.next().unwrap_or([*sample; 2]) } else { [*sample; 2] };
        if let Some((first, outside, last, step)) = open.take() {
            let step = step.max(below.value - last);
            if sample.is_feasible {
                open = Some((first, outside, sample.value, step));
            } else {
                intervals.push(WindowInterval {
                    range: [first, below.value],
                    ends: [outside, above.worst],
                    step,
                });
            }
        } else if sample.is_feasible {
            let outside = below.worst.filter(|_| is_changed);
            open = Some((above.value, outside, sample.value, sample.value - above.value));
        }
    }
    if let Some((first, outside, last, step)) = open {
        intervals.push(WindowInterval {
            range: [first, range[1]],
            ends: [outside, None],
            step: step.max(range[1] - last),
        });
    }
    let best = samples.iter().max_by(|a, b| a.fraction.total_cmp(&b.fraction));
    let nearest = best.filter(|_| intervals.is_empty()).map(|best| (best.value, best.worst));
    search.observer.progress(1.0);
    Ok(Window { intervals, nearest, resolution, plans })
}
