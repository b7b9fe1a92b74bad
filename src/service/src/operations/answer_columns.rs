//! The answers of the rows of a batch by column.

use verne_rows::{Column, WriteError};

use crate::operations::batch_rows::RowOutcome;
use crate::operations::continuous_rows::AnsweredPose;
use crate::operations::jacobians::RowJacobian;
use crate::wire::batch::Row;

/// Most numbers of a row of the answer.
const MOST_NUMBERS: usize = 6;

/// The numbers and the outcomes of rows: the first `width` numbers of each row.
#[derive(Debug)]
pub(crate) struct AnswerColumns {
    width: usize,
    numbers: [Vec<f64>; MOST_NUMBERS],
    /// Whether a row has numbers.
    has_numbers: Vec<bool>,
    outcomes: Vec<RowOutcome>,
    jacobians: Vec<Option<Box<RowJacobian>>>,
}

impl AnswerColumns {
    /// No rows, with memory for this many.
    pub(crate) fn with_capacity(width: usize, rows: usize) -> Self {
        let column = |i| Vec::with_capacity(if i < width { rows } else { 0 });
        Self {
            width: width.min(MOST_NUMBERS),
            numbers: std::array::from_fn(column),
            has_numbers: Vec::with_capacity(rows),
            outcomes: Vec::with_capacity(rows),
            jacobians: Vec::with_capacity(rows),
        }
    }

    /// Adds a row.
    pub(crate) fn push(
        &mut self,
        numbers: Option<&[f64]>,
        outcome: RowOutcome,
        jacobian: Option<Box<RowJacobian>>,
    ) {
        let row = numbers.unwrap_or_default();
        for (i, column) in self.numbers[..self.width].iter_mut().enumerate() {
            column.push(row.get(i).copied().unwrap_or(0.0));
        }
        self.has_numbers.push(numbers.is_some());
        self.outcomes.push(outcome);
        self.jacobians.push(jacobian);
    }

    /// Adds an answered pose.
    pub(crate) fn push_pose(&mut self, pose: AnsweredPose) {
        self.push(pose.joints.as_deref(), pose.outcome, pose.jacobian);
    }

    /// The Jacobians of the rows.
    pub(crate) fn jacobians(&self) -> impl Iterator<Item = Option<&RowJacobian>> + Clone {
        self.jacobians.iter().map(Option::as_deref)
    }

    /// Adds the rows of another part of the batch.
    pub(crate) fn append(&mut self, mut part: Self) {
        for (column, numbers) in self.numbers.iter_mut().zip(&part.numbers) {
            column.extend_from_slice(numbers);
        }
        self.has_numbers.extend_from_slice(&part.has_numbers);
        self.outcomes.append(&mut part.outcomes);
        self.jacobians.append(&mut part.jacobians);
    }

    /// The numbers as columns with these names, at most as many as a row has; and the outcomes.
    pub(crate) fn into_columns(
        self,
        names: &[&'static str],
    ) -> Result<(Vec<Column>, Vec<RowOutcome>), WriteError> {
        let named = names.iter().zip(self.numbers).take(self.width);
        let columns = named.map(|(name, numbers)| Column::numbers_where(name, numbers, &self.has_numbers));
        Ok((columns.collect::<Result<_, _>>()?, self.outcomes))
    }

    /// The numbers row by row, and the outcomes.
    pub(crate) fn into_rows(self) -> (Vec<Option<Row>>, Vec<RowOutcome>) {
        let numbers = &self.numbers[..self.width];
        let row = |(i, has_numbers): (usize, &bool)| {
            has_numbers.then(|| numbers.iter().map(|column| column[i]).collect())
        };
        (self.has_numbers.iter().enumerate().map(row).collect(), self.outcomes)
    }
}
