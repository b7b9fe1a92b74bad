//! How many rows of a batch have which outcome, and why the first of those without an answer have none.

use std::borrow::Cow;

use verne_rows::Chunk;

use crate::operations::batch_rows::RowOutcome;
use crate::wire::limit::Limit;

/// Most rows without an answer whose reasons are kept.
const MOST_KEPT: usize = 10;

/// The outcomes of all rows so far.
#[derive(Debug)]
pub(crate) struct RowTally {
    /// The outcomes and their numbers of rows.
    counts: Vec<(&'static str, u64)>,
    /// Rows so far.
    rows: u64,
    /// Rows without an answer.
    unanswered: u64,
    first: Vec<Unanswered>,
}

/// A row without an answer.
#[derive(Debug)]
pub(crate) struct Unanswered {
    /// The place of the row.
    pub place: RowPlace,
    /// Why it has none.
    pub reason: Reason<'static>,
}

/// The place of a row.
#[derive(Clone, Copy, Debug)]
pub(crate) enum RowPlace {
    /// The line of the text, from 1.
    Line(u64),
    /// The row, from 1, where there are no lines.
    Row(u64),
}

/// Why a row has no answer.
#[derive(Debug)]
pub(crate) enum Reason<'a> {
    /// The limit that is broken, or the constraint that prevents a solution.
    Limit(Limit),
    /// The row cannot be used: the reason.
    Detail(Cow<'a, str>),
}

impl RowTally {
    /// No rows yet; `outcomes` are the names of what they may have.
    pub(crate) fn new(outcomes: &[&'static str]) -> Self {
        let counts = outcomes.iter().map(|name| (*name, 0)).collect();
        Self { counts, rows: 0, unanswered: 0, first: Vec::new() }
    }

    /// Adds the rows of a chunk: of each the index of its outcome, and the reason if it has no answer.
    pub(crate) fn add<'a>(
        &mut self,
        chunk: &Chunk,
        outcomes: impl IntoIterator<Item = (usize, Option<Reason<'a>>)>,
    ) {
        for (i, (outcome, reason)) in outcomes.into_iter().enumerate() {
            self.add_row(outcome);
            if let Some(reason) = reason {
                self.unanswered += 1;
                self.keep(chunk, i, || Some(reason));
            }
        }
    }

    fn add_row(&mut self, outcome: usize) {
        self.rows += 1;
        if let Some((_, count)) = self.counts.get_mut(outcome) {
            *count += 1;
        }
    }

    /// Keeps the reason of the row that was added last, if it is one of the first.
    fn keep<'a>(&mut self, chunk: &Chunk, i: usize, reason: impl FnOnce() -> Option<Reason<'a>>) {
        if self.first.len() < MOST_KEPT
            && let Some(reason) = reason()
        {
            let place = chunk.line(i).map_or(RowPlace::Row(self.rows), RowPlace::Line);
            self.first.push(Unanswered { place, reason: reason.into_owned() });
        }
    }

    /// Adds the rows of a chunk of poses or joints.
    pub(crate) fn add_outcomes(&mut self, chunk: &Chunk, outcomes: &[RowOutcome]) {
        for (i, outcome) in outcomes.iter().enumerate() {
            self.add_row(outcome.status() as usize);
            if !matches!(outcome, RowOutcome::Ok(_)) {
                self.unanswered += 1;
                self.keep(chunk, i, || Reason::of(outcome));
            }
        }
    }

    /// The outcomes and their numbers of rows.
    pub(crate) fn counts(&self) -> &[(&'static str, u64)] {
        &self.counts
    }

    /// The number of rows.
    pub(crate) fn rows(&self) -> u64 {
        self.rows
    }

    /// The number of rows without an answer.
    pub(crate) fn unanswered(&self) -> u64 {
        self.unanswered
    }

    /// The first rows without an answer.
    pub(crate) fn first(&self) -> &[Unanswered] {
        &self.first
    }
}

impl<'a> Reason<'a> {
    /// Why a row is not `ok`.
    pub(crate) fn of(outcome: &'a RowOutcome) -> Option<Self> {
        match outcome {
            RowOutcome::Ok(_) => None,
            RowOutcome::Unreachable(margin) | RowOutcome::Infeasible(margin) => {
                Some(Self::Limit(Limit::from(*margin)))
            }
            RowOutcome::Invalid(detail) => Some(Self::Detail(detail.into())),
        }
    }

    fn into_owned(self) -> Reason<'static> {
        match self {
            Self::Limit(limit) => Reason::Limit(limit),
            Self::Detail(detail) => Reason::Detail(detail.into_owned().into()),
        }
    }
}
