//! Finds the values of a parameter with which the machine can run a program.

use std::sync::Arc;

use verne_program::Program;
use verne_solver::toolpath::{
    AdjustableProgram, LeastMargin, Motions, ParametricProgram, SetUp, WINDOW_PRECISION, WindowInterval,
    window,
};
use verne_solver::workspace::Observer;

use crate::operations::program_motions::ProgramMotions;
use crate::operations::program_motions::adjustable::AdjustableMotions;
use crate::operations::solver_errors::plan_error;
use crate::operations::window_question::WindowQuestion;
use crate::wire::degrees::from_degrees;
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::limit::{Limit, Unchecked};
use crate::wire::toolpath::Setup;
use crate::wire::toolpath_report::MarginObject;
use crate::wire::window::{
    NearestObject, WindowAnswer, WindowEndObject, WindowIntervalObject, WindowLinks, WindowParameter,
};

/// About the bytes of an answer.
const ANSWER_BYTES: usize = 4096;

/// The answer as it is sent.
pub(crate) fn compute_window(
    question: &WindowQuestion,
    program: &Arc<Program>,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let toolpath = &question.toolpath;
    let given = toolpath.motions(program).map_err(OperationError::ProgramFaults)?;
    let program = WindowProgram::new(question, given);
    let options = toolpath.plan_options();
    let found =
        window(&toolpath.machine, &program, question.range, &options, observer).map_err(plan_error)?;
    let lines = program.motions.given();
    let margin = |LeastMargin { margin, motion }: LeastMargin| MarginObject::new(margin, lines.line(motion));
    let answer = WindowAnswer {
        id: question.id,
        machine: toolpath.machine.id.clone(),
        program: toolpath.request.program,
        request: question.request(),
        unit: question.parameter.unit(),
        intervals: found.intervals.iter().map(|found| interval(lines, found)).collect(),
        nearest: found.nearest.map(|(value, worst)| NearestObject { value, margin: worst.map(margin) }),
        precision: WINDOW_PRECISION,
        resolution: found.resolution,
        plans: u64::try_from(found.plans).unwrap_or(u64::MAX),
        not_checked: Unchecked::beside(toolpath.request.table_clearance.is_some()),
        links: WindowLinks { itself: question.id.toolpath() },
    };
    write_json(&answer, ANSWER_BYTES)
}

fn interval(lines: &ProgramMotions, found: &WindowInterval) -> WindowIntervalObject {
    let end = |worst: Option<LeastMargin>| match worst {
        None => WindowEndObject::Bound,
        Some(LeastMargin { margin, motion }) => {
            let Limit { constraint, element, .. } = margin.into();
            WindowEndObject::Limit { constraint, element, line: lines.line(motion) }
        }
    };
    let [from, to] = found.range;
    WindowIntervalObject { from, to, ends: found.ends.map(end), step: found.step }
}

/// A program with one free parameter of its request.
struct WindowProgram {
    motions: AdjustableMotions,
    parameter: WindowParameter,
    setup: Setup,
    /// The stated length of every tool, mm; 0 if the program has several.
    tool_length: f64,
}

impl WindowProgram {
    fn new(question: &WindowQuestion, given: ProgramMotions) -> Self {
        let request = &question.toolpath.request;
        let tool_length = question.toolpath.one_tool_length();
        Self {
            motions: AdjustableMotions::new(given, request.setup, tool_length),
            parameter: question.parameter,
            setup: request.setup,
            tool_length: tool_length.unwrap_or_default(),
        }
    }
}

impl ParametricProgram for WindowProgram {
    fn motions(&self, value: f64) -> Box<dyn Motions + '_> {
        let length = if self.parameter == WindowParameter::ToolLength { value } else { self.tool_length };
        Box::new(self.motions.with_setup(&self.parameter.setup_with(&self.setup, value), length))
    }

    fn adjustable(&self) -> Option<(&dyn AdjustableProgram, [SetUp; 2])> {
        let with = |value: f64| {
            let mut parameters = self.motions.set_up().parameters();
            let (index, value) = match self.parameter {
                WindowParameter::X => (0, value),
                WindowParameter::Y => (1, value),
                WindowParameter::Z => (2, value),
                WindowParameter::C => (3, from_degrees(value)),
                WindowParameter::ToolLength => (4, value),
                WindowParameter::A | WindowParameter::B => return None,
            };
            parameters[index] = value;
            Some(SetUp::of_parameters(parameters))
        };
        Some((&self.motions, [with(0.0)?, with(1.0)?]))
    }
}
