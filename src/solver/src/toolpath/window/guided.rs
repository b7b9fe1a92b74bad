//! Windows of long programs: the margins at the places of the path say where plans are needed.

use super::place_margins::PlaceMargins;
use super::refine::bracket_near;
use super::sample::{Found, Sample};
use super::scan::{ScanSettings, scan};
use super::search::{SCANNED, Search};
use crate::toolpath::PlanError;
use crate::toolpath::set_up::{AdjustableProgram, SetUp};
use crate::workspace::Subprogress;

/// Scan with places.
const PLACES: ScanSettings = ScanSettings { intervals: 64, least: 1.0 / 65_536.0, most: 4_000 };
/// Scan with plans where the places and the plans of a long program disagree.
const DISPUTED: ScanSettings = ScanSettings { intervals: 8, least: 1.0 / 256.0, most: 200 };
/// Number of values inside a window that the places find at which the whole program is planned.
const CHECKED: u32 = 3;
/// Fraction of a margin's range by which the places clearly say that the machine cannot run the program.
const CLEAR: f64 = 1e-3;
/// Fraction of the work after which the places are scanned.
const PLACES_SCANNED: f64 = 0.3;

impl Search<'_> {
    /// Plans of a long program: where the places of its path say that there are windows, and where they nearly are.
    pub(super) fn guided(
        &self,
        range: [f64; 2],
        adjustable: (&dyn AdjustableProgram, [SetUp; 2]),
    ) -> Result<Found, PlanError> {
        let middle = 0.5 * (range[0] + range[1]);
        let places = PlaceMargins::of(self.machine, adjustable, middle, self.options);
        let by_places = |value: f64| {
            if self.observer.cancelled() {
                return Err(PlanError::Cancelled);
            }
            Ok(places.sample(self.machine, value))
        };
        let part = Subprogress::new(self.observer, 0.0, PLACES_SCANNED);
        let by_places = scan(range, &PLACES, &part, by_places)?;
        let mut found = Found { samples: Vec::new(), resolution: by_places.resolution };
        let runs: Vec<_> = by_places.samples.chunk_by(|a, b| a.is_feasible == b.is_feasible).collect();
        for (number, run) in runs.iter().enumerate() {
            let (samples, is_disputed) = self.checked(run)?;
            if is_disputed {
                let ends = [run[0].value, run[run.len() - 1].value];
                let scanned = self.scanned(ends, &DISPUTED, &part)?;
                found.resolution = found.resolution.max(scanned.resolution);
                found.samples.extend(scanned.samples);
            } else {
                found.samples.extend(samples);
            }
            #[allow(clippy::cast_precision_loss, reason = "progress")]
            self.observer.progress(
                PLACES_SCANNED + (SCANNED - PLACES_SCANNED) * (number + 1) as f64 / runs.len() as f64,
            );
        }
        self.close(range, &mut found, &by_places.samples)?;
        Ok(found)
    }

    /// Plans with some values of a run of places' samples with one verdict, and whether the plans clearly disagree.
    fn checked(&self, run: &[Sample]) -> Result<(Vec<Sample>, bool), PlanError> {
        let [Some(first), Some(last)] = [run.first(), run.last()] else { return Ok((Vec::new(), false)) };
        if first.is_feasible {
            let width = last.value - first.value;
            let inner = |i: u32| first.value + width * f64::from(i) / f64::from(CHECKED + 1);
            let mut values = vec![first.value];
            values.extend((1..=CHECKED).map(inner).chain([last.value]));
            values.dedup();
            let samples = self.plan_all(&values)?;
            let mut inside = samples.iter().skip(1).take(CHECKED as usize);
            let is_disputed = width > 0.0 && inside.any(|sample| !sample.is_feasible);
            return Ok((samples, is_disputed));
        }
        let best = run.iter().max_by(|a, b| a.fraction.total_cmp(&b.fraction)).unwrap_or(first);
        let samples = self.plan_all(&[best.value])?;
        let is_disputed =
            run.len() > 1 && best.fraction < -CLEAR && samples.iter().any(|sample| sample.is_feasible);
        Ok((samples, is_disputed))
    }

    /// Narrows the ends of windows from the places' verdicts to a bracket of plans.
    fn close(&self, range: [f64; 2], found: &mut Found, places: &[Sample]) -> Result<(), PlanError> {
        for value in range {
            if found.samples.iter().all(|sample| sample.value != value) {
                found.samples.push(self.plan(value)?);
            }
        }
        found.samples.sort_by(|a, b| a.value.total_cmp(&b.value));
        found.samples.dedup_by(|a, b| a.value == b.value);
        let mut more = Vec::new();
        for pair in found.samples.windows(2).filter(|pair| pair[0].is_feasible != pair[1].is_feasible) {
            let ends = [pair[0].value, pair[1].value];
            let between = |sample: &&Sample| (ends[0]..=ends[1]).contains(&sample.value);
            let near: Vec<_> = places.iter().filter(between).copied().collect();
            more.extend(bracket_near(&near, [&pair[0], &pair[1]], |value| self.plan(value))?);
        }
        found.samples.extend(more);
        found.samples.sort_by(|a, b| a.value.total_cmp(&b.value));
        found.samples.dedup_by(|a, b| a.value == b.value);
        Ok(())
    }
}
