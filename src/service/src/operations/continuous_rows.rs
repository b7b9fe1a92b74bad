//! The rows of a continuous batch: each continues from the row before.
//!
//! Blocks of rows bound the memory. In a block the candidates of all rows are solved in parallel, the choice goes from
//! row to row, and the margins of the chosen solutions are computed in parallel. So the answer does not depend on the
//! number of threads. The choice is greedy: it does not look ahead, as the planner of tool paths does.

use rayon::prelude::*;
use verne_solver::{PostureColumns, Registers, worst_margin_rows};

use crate::operations::batch_rows::{BatchRow, MIN_CHUNK, RowFormat, RowOutcome, outcome_of_solution};
use crate::operations::continuation::{Chosen, Setting, Standing};
use crate::operations::jacobians::RowJacobian;
use crate::operations::part_row::{Candidates, PartRow};
use crate::operations::table_angles::TablePosition;
use crate::wire::batch::Row;

/// Rows that are solved before the choice goes through them.
const BLOCK: usize = 4096;

/// The joints of a row.
pub(crate) struct AnsweredPose {
    pub(crate) joints: Option<Row>,
    pub(crate) outcome: RowOutcome,
    /// `None` for a row without a solution, and in a batch that is not continuous.
    pub(crate) jump: Option<bool>,
    pub(crate) jacobian: Option<Box<RowJacobian>>,
}

impl AnsweredPose {
    pub(crate) fn without_solution(outcome: RowOutcome) -> Self {
        Self { joints: None, outcome, jump: None, jacobian: None }
    }
}

/// A row and its candidates; those of the pole are solved when theta2 is known.
type SolvedRow = Result<(PartRow, Candidates), String>;

/// Answers all rows in order. `standing` is where the machine stands before the first one, and then where it stands
/// after the last one.
pub(crate) fn answer_continuous<R: BatchRow>(
    setting: Setting<'_>,
    format: RowFormat,
    rows: &[R],
    standing: &mut Option<Standing>,
) -> Vec<AnsweredPose> {
    let mut walk = Walk { setting, standing };
    let mut answered = Vec::with_capacity(rows.len());
    for block in rows.chunks(BLOCK) {
        let solved = block.par_iter().with_min_len(MIN_CHUNK);
        let solved = solved.map(|row| setting.solved(format, row)).collect();
        let chosen = walk.through(solved).into_par_iter().chunks(MIN_CHUNK);
        answered.par_extend(chosen.flat_map_iter(|rows| setting.all_answered(rows)));
    }
    answered
}

impl Setting<'_> {
    fn solved(&self, format: RowFormat, row: &impl BatchRow) -> SolvedRow {
        let row = PartRow::of_numbers(&row.numbers(format)?)?;
        let candidates = if row.is_pole() { Ok(Vec::new()) } else { self.candidates(&row, 0.0) };
        Ok((row, candidates))
    }

    fn candidates(&self, row: &PartRow, theta2: f64) -> Candidates {
        row.candidates(self.machine, self.tool_length, theta2)
    }

    /// The answers of rows with their solutions.
    fn all_answered(&self, rows: Vec<Result<Chosen, RowOutcome>>) -> Vec<AnsweredPose> {
        let mut postures = PostureColumns::new();
        for chosen in rows.iter().flatten() {
            postures.push(&chosen.posture, Some(chosen.table.angles()));
        }
        let mut outcomes = Vec::with_capacity(postures.len());
        worst_margin_rows(
            self.machine,
            &postures,
            self.clearance,
            Registers::Widest,
            |_, worst, feasible| {
                outcomes.push(RowOutcome::of_worst(worst, feasible));
            },
        );
        let mut outcomes = outcomes.into_iter();
        let answered = rows.into_iter().map(|row| match row {
            Ok(chosen) => Some(self.pose(&chosen, outcomes.next()?)),
            Err(outcome) => Some(AnsweredPose::without_solution(outcome)),
        });
        answered.flatten().collect()
    }

    /// The answer of a row with its solution.
    pub(crate) fn answered(&self, row: Result<Chosen, RowOutcome>) -> AnsweredPose {
        let chosen = match row {
            Ok(chosen) => chosen,
            Err(outcome) => return AnsweredPose::without_solution(outcome),
        };
        let angles = chosen.table.angles();
        let outcome = outcome_of_solution(self.machine, &chosen.posture, Some(angles), self.clearance);
        self.pose(&chosen, outcome)
    }

    fn pose(&self, chosen: &Chosen, outcome: RowOutcome) -> AnsweredPose {
        let table = TablePosition::from(chosen.table);
        let joints = Some(chosen.posture.rho.into_iter().chain(table.degrees).collect());
        let jacobian = self.jacobian(&chosen.posture, table.angles);
        AnsweredPose { joints, outcome, jump: Some(chosen.jump), jacobian }
    }
}

/// The way from row to row.
struct Walk<'a> {
    setting: Setting<'a>,
    standing: &'a mut Option<Standing>,
}

impl Walk<'_> {
    /// Chooses a solution for each row of a block.
    fn through(&mut self, mut rows: Vec<SolvedRow>) -> Vec<Result<Chosen, RowOutcome>> {
        let mut chosen = Vec::with_capacity(rows.len());
        while chosen.len() < rows.len() {
            let rest = &mut rows[chosen.len()..];
            let poles = rest.iter().take_while(|row| is_pole(row)).count();
            let run = &mut rest[..poles.max(1)];
            if poles > 0 {
                self.solve_poles(run);
            }
            chosen.extend(run.iter_mut().map(|row| self.choose(row)));
        }
        chosen
    }

    /// Solves consecutive rows at the pole, where theta2 stays as it is.
    fn solve_poles(&self, run: &mut [SolvedRow]) {
        let theta2 = self.standing.as_ref().map_or(0.0, |standing| standing.table.theta2);
        run.par_iter_mut().with_min_len(MIN_CHUNK).for_each(|row| {
            if let Ok((row, candidates)) = row {
                *candidates = self.setting.candidates(row, theta2);
            }
        });
    }

    fn choose(&mut self, row: &SolvedRow) -> Result<Chosen, RowOutcome> {
        let (row, candidates) = row.as_ref().map_err(|detail| RowOutcome::Invalid(detail.clone()))?;
        let chosen = self.setting.choose(self.standing.as_ref(), row, candidates)?;
        *self.standing = Some(Standing::after(row, &chosen, candidates));
        Ok(chosen)
    }
}

fn is_pole(row: &SolvedRow) -> bool {
    row.as_ref().is_ok_and(|(row, _)| row.is_pole())
}
