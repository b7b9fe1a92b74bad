//! Interleaved timing: every candidate runs once in every round, so that noise affects all alike.

use std::hint::black_box;
use std::time::Instant;

/// One candidate and its times.
pub(crate) struct Candidate<'a> {
    pub(crate) name: &'static str,
    /// The greatest ratio to the baseline that meets the target.
    pub(crate) target: Option<f64>,
    calls: usize,
    run: Box<dyn FnMut() + 'a>,
    /// Nanoseconds per call, by round.
    pub(crate) times: Vec<f64>,
}

impl<'a> Candidate<'a> {
    /// A function over all inputs in turn. One round is one pass: with hundreds of inputs and
    /// the other candidates between two passes, branches are predicted as on fresh input.
    pub(crate) fn new<T, R>(name: &'static str, inputs: &'a [T], answer: impl Fn(&T) -> R + 'a) -> Self {
        let run = move || {
            for input in inputs {
                // By reference: a large answer is not copied once more.
                black_box(&answer(black_box(input)));
            }
        };
        Self { name, target: None, calls: inputs.len(), run: Box::new(run), times: Vec::new() }
    }

    /// A function of all inputs at once.
    pub(crate) fn whole<T>(name: &'static str, inputs: &'a [T], answer: impl Fn(&[T]) + 'a) -> Self {
        let run = move || answer(black_box(inputs));
        Self { name, target: None, calls: inputs.len(), run: Box::new(run), times: Vec::new() }
    }

    /// The same with the most that its ratio should be.
    pub(crate) fn at_most(self, target: f64) -> Self {
        Self { target: Some(target), ..self }
    }

    fn time(&mut self) -> f64 {
        let start = Instant::now();
        (self.run)();
        start.elapsed().as_secs_f64() * 1e9 / self.calls as f64
    }

    /// Median time of a call, ns.
    pub(crate) fn median(&self) -> f64 {
        median(self.times.iter().copied())
    }

    /// Median over the rounds of the ratio to another candidate's time in the same round.
    pub(crate) fn ratio_to(&self, other: &Self) -> f64 {
        median(self.times.iter().zip(&other.times).map(|(mine, others)| mine / others))
    }
}

/// Times all candidates in this number of rounds, after one to warm up. Each round begins with another candidate, so
/// that none always follows the same one.
pub(crate) fn measure(candidates: &mut [Candidate<'_>], rounds: usize) {
    for candidate in &mut *candidates {
        candidate.time();
    }
    for round in 0..rounds {
        let count = candidates.len();
        for i in 0..count {
            let candidate = &mut candidates[(i + round) % count];
            let time = candidate.time();
            candidate.times.push(time);
        }
    }
}

/// The median; the upper one of two.
pub(crate) fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut numbers: Vec<f64> = numbers.collect();
    let middle = numbers.len() / 2;
    *numbers.select_nth_unstable_by(middle, f64::total_cmp).1
}
