//! Examined values of the parameter, closer where the verdict may change between them.

use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;

use super::sample::{Found, Sample};
use crate::toolpath::PlanError;
use crate::workspace::Observer;

/// Factor by which the worst margin may change faster than between the values around.
const SAFETY: f64 = 2.0;
/// Number of rounds after which the progress is a half.
const ROUNDS: f64 = 4.0;

/// How closely a range is examined.
pub(super) struct ScanSettings {
    /// Number of equal intervals at the beginning.
    pub(super) intervals: u32,
    /// Width of an interval that is not divided, as a fraction of the range.
    pub(super) least: f64,
    /// Greatest number of values.
    pub(super) most: usize,
}

/// Examines values of a range.
pub(super) fn scan(
    [from, to]: [f64; 2],
    settings: &ScanSettings,
    observer: &dyn Observer,
    examine: impl Fn(f64) -> Result<Sample, PlanError> + Sync,
) -> Result<Found, PlanError> {
    let all = |values: &[f64], round: f64| {
        let done = AtomicU32::new(0);
        let examined = values.par_iter().map(|value| {
            let sample = examine(*value)?;
            let done = f64::from(done.fetch_add(1, Ordering::Relaxed) + 1);
            #[allow(clippy::cast_precision_loss, reason = "progress")]
            let rounds = round + done / values.len() as f64;
            observer.progress(rounds / (rounds + ROUNDS));
            Ok(sample)
        });
        examined.collect::<Result<Vec<Sample>, PlanError>>()
    };
    let count = settings.intervals;
    let begin: Vec<_> = (0..=count)
        .map(|i| if i == count { to } else { from + (to - from) * f64::from(i) / f64::from(count) })
        .collect();
    let mut samples = all(&begin, 0.0)?;
    let least = settings.least * (to - from);
    let mut round = 1.0;
    loop {
        let open = open_intervals(&samples);
        let widths = open.iter().map(|[a, b]| b - a);
        let middles = open.iter().filter(|[a, b]| b - a > least).map(|[a, b]| 0.5 * (a + b));
        // An interval of neighbouring numbers has no middle.
        let middles: Vec<_> =
            middles.filter(|middle| samples.iter().all(|sample| sample.value != *middle)).collect();
        if middles.is_empty() || samples.len() + middles.len() > settings.most {
            let resolution = widths.fold(least, f64::max);
            return Ok(Found { samples, resolution });
        }
        samples.extend(all(&middles, round)?);
        samples.sort_by(|a, b| a.value.total_cmp(&b.value));
        round += 1.0;
    }
}

/// The intervals between neighbouring values in which the verdict may change, and change back.
fn open_intervals(samples: &[Sample]) -> Vec<[f64; 2]> {
    let slopes: Vec<_> = samples
        .windows(2)
        .map(|pair| (pair[1].fraction - pair[0].fraction).abs() / (pair[1].value - pair[0].value))
        .collect();
    let pairs = samples.windows(2).enumerate();
    let open = pairs.filter(|(i, pair)| {
        let around = &slopes[i.saturating_sub(1)..(i + 2).min(slopes.len())];
        let slope = SAFETY * around.iter().copied().fold(0.0, f64::max);
        let [a, b] = [&pair[0], &pair[1]];
        a.is_feasible != b.is_feasible || a.fraction.abs() + b.fraction.abs() < slope * (b.value - a.value)
    });
    open.map(|(_, pair)| [pair[0].value, pair[1].value]).collect()
}
