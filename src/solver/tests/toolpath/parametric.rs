//! Programs with one free parameter of their set-up.

use verne_solver::Machine;
use verne_solver::toolpath::{
    AdjustableProgram, Motion, Motions, ParametricProgram, PlanOptions, SetUp, plan,
};

/// A parameter of a program's set-up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Parameter {
    Length,
    X,
    Z,
    Turn,
}

/// A program in its own frame.
pub(crate) struct Program {
    motions: Vec<Motion>,
    given: SetUp,
    parameter: Parameter,
}

impl Program {
    pub(crate) fn new(motions: Vec<Motion>, parameter: Parameter) -> Self {
        let given = SetUp { origin: [0.0, 0.0, 0.0], turn: 0.0, tool_length: 100.0 };
        Self { motions, given, parameter }
    }

    fn set_up(&self, value: f64) -> SetUp {
        let mut set_up = self.given;
        match self.parameter {
            Parameter::Length => set_up.tool_length = value,
            Parameter::X => set_up.origin[0] = value,
            Parameter::Z => set_up.origin[2] = value,
            Parameter::Turn => set_up.turn = value,
        }
        set_up
    }

    pub(crate) fn is_feasible(&self, machine: &Machine, options: &PlanOptions, value: f64) -> bool {
        let motions = AdjustableProgram::motions(self, &self.set_up(value));
        plan(machine, &*motions, options, |_| true, |_| {}).unwrap().is_feasible()
    }
}

impl AdjustableProgram for Program {
    fn motions(&self, set_up: &SetUp) -> Box<dyn Motions + '_> {
        let (sine, cosine) = set_up.turn.sin_cos();
        let turned = |[x, y, z]: [f64; 3]| [cosine * x - sine * y, sine * x + cosine * y, z];
        let moved = self.motions.iter().map(|motion| {
            let mut motion = *motion;
            let tip = turned(motion.end.tip);
            motion.end.tip = [0, 1, 2].map(|i| tip[i] + set_up.origin[i]);
            motion.end.axis = turned(motion.end.axis);
            motion.tool_length = set_up.tool_length;
            motion
        });
        Box::new(moved.collect::<Vec<_>>())
    }

    fn is_adjusted(&self, _: usize) -> bool {
        true
    }

    fn stated(&self, set_up: &SetUp) -> SetUp {
        *set_up
    }
}

impl ParametricProgram for Program {
    fn motions(&self, value: f64) -> Box<dyn Motions + '_> {
        AdjustableProgram::motions(self, &self.set_up(value))
    }

    fn adjustable(&self) -> Option<(&dyn AdjustableProgram, [SetUp; 2])> {
        Some((self, [self.set_up(0.0), self.set_up(1.0)]))
    }
}
