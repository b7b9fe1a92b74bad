//! The search for set-ups: many starts with few places, then the best of them with all places.

use rayon::prelude::*;

use super::local_search::local_search;
use super::problem::{PARAMETERS, Problem, Score};
use super::starts::{even_set_ups, representative};
use crate::toolpath::PlanError;
use crate::toolpath::set_up::SetUp;
use crate::workspace::{Observer, Subprogress};

/// Number of set-ups that are examined, by the number of free parameters.
const SAMPLES: [u32; PARAMETERS + 1] = [1, 64, 512, 2048, 3072, 4096];
/// Number of searches with few places, on each preimage.
const STARTS: usize = 16;
/// Number of candidates that are refined with all places.
const REFINED: usize = 4;
/// Greatest number of steps of a search with few places, and with all.
const STEPS: [u32; 2] = [30, 60];
/// Greatest number of times that places are added, and how many at once.
const ROUNDS: usize = 16;
const ADDED: usize = 48;
/// Difference of values that is rounding.
const ROUNDING: f64 = 1e-10;
/// Least distance of two starts, as a fraction of the bounds' width, and of two candidates, mm.
const APART: f64 = 0.05;
const DISTINCT: f64 = 0.1;

/// A set-up that the search found.
#[derive(Clone, Copy, Debug)]
pub(in crate::toolpath) struct Candidate {
    /// The set-up.
    pub(in crate::toolpath) set_up: SetUp,
    /// Its worst values.
    pub(super) score: Score,
    /// Whether its places are on the other preimage.
    pub(in crate::toolpath) other: bool,
}

/// The search with the tracks of a survey.
pub(super) struct Search<'a> {
    problems: [Problem<'a>; 2],
    progress: &'a Subprogress<'a>,
}

impl<'a> Search<'a> {
    /// `problems` are that of the planned preimage and that of the other.
    pub(super) fn new(problems: [Problem<'a>; 2], progress: &'a Subprogress<'a>) -> Self {
        Self { problems, progress }
    }

    fn check_cancelled(&self) -> Result<(), PlanError> {
        if self.progress.cancelled() { Err(PlanError::Cancelled) } else { Ok(()) }
    }

    /// The best set-ups, best first, and the number of starts.
    pub(super) fn run(&self, given: SetUp) -> Result<(Vec<Candidate>, u32), PlanError> {
        let set = representative(self.problems[0].places);
        let starts = self.starts(&set, given)?;
        self.progress.progress(0.3);
        let searched: Vec<Option<([f64; PARAMETERS], Score, usize)>> = starts
            .par_iter()
            .map(|(start, side)| {
                if self.progress.cancelled() {
                    return None;
                }
                let (found, score) = local_search(&self.problems[*side], &set, *start, STEPS[0]);
                Some((found, score, *side))
            })
            .collect();
        self.check_cancelled()?;
        self.progress.progress(0.6);
        let count = u32::try_from(starts.len()).unwrap_or(u32::MAX);
        let mut found: Vec<_> = searched.into_iter().flatten().collect();
        found.sort_by(|a, b| b.1.merit().total_cmp(&a.1.merit()));
        let mut distinct: Vec<([f64; PARAMETERS], Score, usize)> = Vec::new();
        for candidate in found {
            let is_new = distinct.iter().all(|known| {
                known.2 != candidate.2 || self.distance(&known.0, &candidate.0, |_, unit| unit) > DISTINCT
            });
            if is_new && distinct.len() < REFINED {
                distinct.push(candidate);
            }
        }
        let mut all = Vec::new();
        for (start, _, side) in distinct {
            self.check_cancelled()?;
            let (parameters, score) = refined(&self.problems[side], set.clone(), start);
            all.push(Candidate { set_up: SetUp::of_parameters(parameters), score, other: side == 1 });
        }
        all.sort_by(|a, b| b.score.merit().total_cmp(&a.score.merit()));
        self.progress.progress(1.0);
        Ok((all, count))
    }

    /// The greatest difference of a parameter between two set-ups, in units that depend on its bounds' width and unit.
    fn distance(&self, a: &[f64; PARAMETERS], b: &[f64; PARAMETERS], unit: impl Fn(f64, f64) -> f64) -> f64 {
        let problem = &self.problems[0];
        let of = |i: usize| {
            let width = problem.bounds[i][1] - problem.bounds[i][0];
            if width > 0.0 { (a[i] - b[i]).abs() / unit(width, problem.units[i]) } else { 0.0 }
        };
        (0..PARAMETERS).map(of).fold(0.0, f64::max)
    }

    /// The best of evenly distributed set-ups, and the given one, each with its preimage.
    fn starts(&self, set: &[u32], given: SetUp) -> Result<Vec<([f64; PARAMETERS], usize)>, PlanError> {
        let bounds = &self.problems[0].bounds;
        let free = bounds.iter().filter(|[low, high]| low < high).count();
        let even = even_set_ups(&self.problems[0], SAMPLES[free]);
        let given = self.problems[0].clamped(given.parameters());
        let mut starts = Vec::new();
        for (side, problem) in self.problems.iter().enumerate() {
            let mut scored: Vec<(f64, usize)> = even
                .par_iter()
                .enumerate()
                .map(|(number, parameters)| {
                    if self.progress.cancelled() {
                        return (f64::NEG_INFINITY, number);
                    }
                    let sampled = problem.sample(set, &SetUp::of_parameters(*parameters));
                    (problem.score(&sampled).merit(), number)
                })
                .collect();
            self.check_cancelled()?;
            scored.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            let first = starts.len();
            starts.push((given, side));
            for (_, number) in scored {
                let is_apart = starts[first..].iter().all(|(known, _): &([f64; PARAMETERS], usize)| {
                    self.distance(known, &even[number], |width, _| width) > APART
                });
                if is_apart && starts.len() - first <= STARTS {
                    starts.push((even[number], side));
                }
            }
        }
        Ok(starts)
    }
}

/// The best set-up near another one for all places: the search with a set of places, to which it adds those that the
/// set-up breaks.
pub(super) fn refined(
    problem: &Problem<'_>,
    mut set: Vec<u32>,
    start: [f64; PARAMETERS],
) -> ([f64; PARAMETERS], Score) {
    let (mut now, mut found) = (start, Score { limit: f64::NEG_INFINITY, reserve: f64::NEG_INFINITY });
    for _ in 0..ROUNDS {
        let (next, score) = local_search(problem, &set, now, STEPS[1]);
        (now, found) = (next, score);
        let mut worse: Vec<(f64, u32)> = problem
            .worst_places(&SetUp::of_parameters(now))
            .into_iter()
            .map(|(place, has_reserve, value)| {
                let known = if has_reserve { score.reserve } else { score.limit };
                (value - known, place)
            })
            .filter(|(excess, place)| *excess < -ROUNDING && set.binary_search(place).is_err())
            .collect();
        if worse.is_empty() {
            break;
        }
        worse.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        worse.dedup_by_key(|(_, place)| *place);
        set.extend(worse.into_iter().take(ADDED).map(|(_, place)| place));
        set.sort_unstable();
        set.dedup();
    }
    (now, found)
}
