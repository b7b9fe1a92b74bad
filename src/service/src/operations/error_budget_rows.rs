//! The error budgets of poses: the working solution of each row, and the budget of its posture.

use std::sync::Arc;

use rayon::prelude::*;
use verne_solver::error_budget::{ErrorBudget, Tolerances};
use verne_solver::parameter::{ActualMachine, Parameter, ToolFrame};
use verne_solver::workspace::Observer;
use verne_solver::{
    Clearance, KinematicsError, Point, Posture, Postures, part_every_working, platform_working,
    tool_every_working,
};

use crate::operations::batch_rows::{
    BatchRow, ROW_WITH_AXIS, RowOutcome, outcome_of_refusal, outcome_of_solution,
};
use crate::operations::continuation::Setting;
use crate::operations::inverse_rows::row_format;
use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::operations::part_row::PartRow;
use crate::operations::table_angles::{TablePosition, ToolOrientation};
use crate::wire::batch::Row;
use crate::wire::error::OperationError;
use crate::wire::error_budget::{ErrorBudgetRequest, ParameterObject};
use crate::wire::field_errors::FieldErrors;
use crate::wire::parameter::{to_wire, unit_of};
use crate::wire::parameter_tolerances::ParameterTolerances;
use crate::wire::request::Frame;
use crate::wire::tool::Tool;

/// What all rows share.
pub(crate) struct BudgetBatch {
    pub(crate) machine: Arc<IdentifiedMachine>,
    pub(crate) frame: Frame,
    pub(crate) clearance: Option<Clearance>,
    tool_length: f64,
    tolerances: Tolerances,
    stated: ParameterTolerances,
}

/// The answer to a row.
pub(crate) struct BudgetRow {
    pub(crate) joints: Option<Row>,
    /// `None` without a solution, and at a parallel singularity.
    pub(crate) budget: Option<Box<ErrorBudget>>,
    pub(crate) outcome: RowOutcome,
}

/// The solution of a row.
struct Solved {
    posture: Posture,
    table: Option<TablePosition>,
}

impl BudgetBatch {
    /// Checks what all rows share.
    pub(crate) fn new<R>(
        request: &ErrorBudgetRequest<R>,
        machines: &MachineRegistry,
    ) -> Result<Self, OperationError> {
        let (frame, stated) = (request.frame, request.parameter_tolerances);
        let tool = Tool { length: request.tool_length, radius: 0.0, table_clearance: None };
        let mut faults = FieldErrors::default();
        tool.check(None, &mut faults);
        stated.check("/parameter_tolerances", &mut faults);
        let resolved = machines.resolve(&request.machine);
        if let Ok(machine) = &resolved {
            faults.proportion("/tool_length", request.tool_length, machine);
        }
        faults.into_result()?;
        let machine = resolved?;
        let clearance = tool.clearance(&machine).filter(|_| frame == Frame::Part);
        // P is no part of the tool.
        let (tool_length, tolerances) = match (frame, stated.to_solver()?) {
            (Frame::Platform, tolerances) => (0.0, tolerances.without(Parameter::ToolLength)),
            (_, tolerances) => (tool.length, tolerances),
        };
        Ok(Self { machine, frame, clearance, tool_length, tolerances, stated })
    }

    /// The parameters with a tolerance.
    pub(crate) fn parameters(&self) -> Vec<ParameterObject> {
        let nominal = ActualMachine::new(&self.machine, self.tool_length);
        let each = self.stated.each().into_iter();
        each.map(|(parameter, tolerance)| ParameterObject {
            name: parameter.name(),
            unit: unit_of(parameter.unit()),
            nominal: to_wire(parameter.unit(), nominal.value(parameter)),
            tolerance,
        })
        .collect()
    }

    /// The parameters with a tolerance, in the order of [`parameters`](Self::parameters).
    pub(crate) fn each_parameter(&self) -> Vec<Parameter> {
        self.stated.each().into_iter().map(|(parameter, _)| parameter).collect()
    }

    /// Answers some rows. Call it on the compute pool.
    pub(crate) fn answer<R: BatchRow>(
        &self,
        rows: &[R],
        observer: &dyn Observer,
    ) -> Result<Vec<BudgetRow>, OperationError> {
        let answer = |row: &R| {
            if observer.cancelled() { Err(OperationError::Cancelled) } else { Ok(self.row(row)) }
        };
        rows.par_iter().map(answer).collect()
    }

    fn row(&self, row: &impl BatchRow) -> BudgetRow {
        let solved = row.numbers(row_format(self.frame)).map_err(RowOutcome::Invalid);
        let solved = match solved.and_then(|row| self.solved(&row)) {
            Ok(solved) => solved,
            Err(outcome) => return BudgetRow { joints: None, budget: None, outcome },
        };
        let Solved { posture, table } = solved;
        let frame = table.map_or(ToolFrame::Machine, |table| ToolFrame::Part(table.angles));
        let budget = ErrorBudget::of(&self.machine, &posture, self.tool_length, frame, &self.tolerances);
        let joints = posture.rho.into_iter().chain(table.into_iter().flat_map(|table| table.degrees));
        BudgetRow {
            joints: Some(joints.collect()),
            budget: budget.map(Box::new),
            outcome: self.outcome(&posture, table),
        }
    }

    fn outcome(&self, posture: &Posture, table: Option<TablePosition>) -> RowOutcome {
        let angles = table.map(|table| table.angles);
        outcome_of_solution(&self.machine, posture, angles, self.clearance.as_ref())
    }

    /// The working solution of a row: the first feasible one, or the first.
    fn solved(&self, row: &Row) -> Result<Solved, RowOutcome> {
        let point = [row[0], row[1], row[2]];
        if self.frame != Frame::Part {
            let solved = self.in_base_frame(point);
            return self.chosen(solved, |posture| Solved { posture, table: None });
        }
        if row.len() == ROW_WITH_AXIS {
            return self.with_axis(row);
        }
        let orientation = ToolOrientation::of_degrees([row[3], row[4]]);
        let solved = part_every_working(&self.machine, &orientation.at(point), self.tool_length);
        self.chosen(solved, |posture| {
            let wound = orientation.wound(&self.machine, posture.pose.alpha, [None; 2]);
            Solved { posture, table: Some(wound.into()) }
        })
    }

    fn in_base_frame(&self, point: Point) -> Result<Postures, KinematicsError> {
        if self.frame == Frame::Platform {
            return platform_working(&self.machine, point).map(|posture| std::iter::once(posture).collect());
        }
        tool_every_working(&self.machine, point, self.tool_length)
    }

    fn chosen(
        &self,
        solved: Result<Postures, KinematicsError>,
        complete: impl Fn(Posture) -> Solved,
    ) -> Result<Solved, RowOutcome> {
        let solved = solved.map_err(|refusal| outcome_of_refusal(&self.machine, refusal))?;
        let mut all = solved.into_iter().map(complete).peekable();
        // The solver refuses a row that has no solution.
        let no_solution = || RowOutcome::Invalid("has no solution".to_owned());
        let first = all.next().ok_or_else(no_solution)?;
        let is_feasible =
            |solved: &Solved| matches!(self.outcome(&solved.posture, solved.table), RowOutcome::Ok(_));
        // Nearly always there is one.
        if all.peek().is_none() || is_feasible(&first) {
            return Ok(first);
        }
        Ok(all.find(is_feasible).unwrap_or(first))
    }

    /// The solution of a row with a tool axis, as in a batch of /ik.
    fn with_axis(&self, row: &Row) -> Result<Solved, RowOutcome> {
        let setting = Setting {
            machine: &self.machine,
            tool_length: self.tool_length,
            clearance: self.clearance.as_ref(),
            jacobians: None,
        };
        let row = PartRow::of_numbers(row).map_err(RowOutcome::Invalid)?;
        let candidates = row.candidates(&self.machine, self.tool_length, 0.0);
        let chosen = setting.choose(None, &row, &candidates)?;
        Ok(Solved { posture: chosen.posture, table: Some(chosen.table.into()) })
    }
}
