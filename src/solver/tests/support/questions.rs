//! Random questions to random machines: far from singularities, in the symmetry plane, out of reach, and near to where
//! two solutions merge.

#![allow(dead_code, reason = "each test takes the questions that it wants")]
#![allow(clippy::unwrap_used, reason = "angles are within a turn")]

use verne_solver::certificate::{
    Certification, EnclosedOrientation, Scope, certify_forward, certify_part, certify_platform, certify_tool,
};
use verne_solver::{
    KinematicsError, Machine, PartPose, Posture, Postures, forward, forward_working, part,
    part_every_working, platform, platform_working, tool, tool_every_working,
};

use super::lengths::scale;
use super::machines::{near_the_edge, spread};
use super::random::Random;

/// A question to the solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Question {
    /// Slider positions.
    Forward([f64; 3]),
    /// P in the base frame.
    Platform([f64; 3]),
    /// The tool centre point in the base frame, and the tool's length.
    Tool([f64; 3], f64),
    /// The tool's pose in the part frame, and the tool's length.
    Part(PartPose, f64),
}

impl Question {
    /// The solutions in a scope.
    pub(crate) fn answer(&self, machine: &Machine, scope: Scope) -> Result<Postures, KinematicsError> {
        let one = |posture: Posture| [posture].into_iter().collect();
        match (*self, scope) {
            (Self::Forward(rho), Scope::All) => forward(machine, rho),
            (Self::Forward(rho), Scope::Working) => forward_working(machine, rho).map(one),
            (Self::Platform(p), Scope::All) => platform(machine, p),
            (Self::Platform(p), Scope::Working) => platform_working(machine, p).map(one),
            (Self::Tool(u, length), Scope::All) => tool(machine, u, length),
            (Self::Tool(u, length), Scope::Working) => tool_every_working(machine, u, length),
            (Self::Part(target, length), Scope::All) => part(machine, &target, length),
            (Self::Part(target, length), Scope::Working) => part_every_working(machine, &target, length),
        }
    }

    /// What is proved of these solutions. phi1 and phi2 are within a turn of zero.
    pub(crate) fn certify(&self, machine: &Machine, postures: &[Posture], scope: Scope) -> Certification {
        match *self {
            Self::Forward(rho) => certify_forward(machine, rho, postures, scope),
            Self::Platform(p) => certify_platform(machine, p, postures, scope),
            Self::Tool(u, length) => certify_tool(machine, u, length, postures, scope),
            Self::Part(PartPose { x, y, z, phi1, phi2 }, length) => {
                let orientation = EnclosedOrientation::within([phi1; 2], [phi2; 2]).unwrap();
                certify_part(machine, [x, y, z], &orientation, length, postures, scope)
            }
        }
    }

    fn count(&self, machine: &Machine) -> Option<usize> {
        match self.answer(machine, Scope::All) {
            Ok(found) => Some(found.len()),
            Err(KinematicsError::Unreachable(_)) => Some(0),
            Err(_) => None,
        }
    }

    fn numbers(&self) -> [f64; 5] {
        match *self {
            Self::Forward([a, b, c]) | Self::Platform([a, b, c]) | Self::Tool([a, b, c], _) => {
                [a, b, c, 0.0, 0.0]
            }
            Self::Part(PartPose { x, y, z, phi1, phi2 }, _) => [x, y, z, phi1, phi2],
        }
    }

    fn with(&self, [a, b, c, d, e]: [f64; 5]) -> Self {
        match *self {
            Self::Forward(_) => Self::Forward([a, b, c]),
            Self::Platform(_) => Self::Platform([a, b, c]),
            Self::Tool(_, length) => Self::Tool([a, b, c], length),
            Self::Part(_, length) => Self::Part(PartPose { x: a, y: b, z: c, phi1: d, phi2: e }, length),
        }
    }

    /// The question at a fraction of the way to another of its kind.
    fn towards(&self, other: &Self, fraction: f64) -> Self {
        let (from, to) = (self.numbers(), other.numbers());
        self.with(std::array::from_fn(|i| from[i] + fraction * (to[i] - from[i])))
    }
}

impl Random {
    /// A machine: the built-in ones, random ones, and machines with R1 = r1 or e1 = e2, or nearly so.
    pub(crate) fn machine_of_any_kind(&mut self) -> Machine {
        match self.bits() % 8 {
            0 => Machine::verne(),
            1 => Machine::linear_delta(),
            2 | 3 => std::iter::repeat_with(|| spread(self)).flatten().next().unwrap_or_else(Machine::verne),
            4 => {
                std::iter::repeat_with(|| near_the_edge(self)).flatten().next().unwrap_or_else(Machine::verne)
            }
            _ => self.machine(),
        }
    }

    /// A question that the machine can answer, perhaps.
    pub(crate) fn question(&mut self, machine: &Machine) -> Question {
        let question = self.plain_question(machine);
        match self.bits() % 5 {
            0 => self.near_merging(machine, &question).unwrap_or(question),
            _ => question,
        }
    }

    fn plain_question(&mut self, machine: &Machine) -> Question {
        let unit = scale(machine);
        let tool_length = if self.one_in(4) { 0.0 } else { unit * self.between(0.0, 0.4) };
        let y = if self.one_in(5) { 0.0 } else { unit * self.between(-0.5, 0.5) };
        let p = [unit * self.between(-0.5, 0.5), y, unit * self.between(0.3, 1.5)];
        match self.bits() % 4 {
            0 => Question::Platform(p),
            1 => Question::Tool(p, tool_length),
            2 => self.part_question(machine, tool_length),
            _ => self.forward_question(machine, p),
        }
    }

    fn part_question(&mut self, machine: &Machine, tool_length: f64) -> Question {
        let (unit, table) = (scale(machine), machine.data().table);
        let height = table.da - table.dt - unit * self.between(0.3, 1.5) - tool_length;
        let level = self.one_in(5);
        let phi1 = if level { 0.0 } else { self.between(-1.2, 1.2) };
        let y = if level { 0.0 } else { unit * self.between(-0.4, 0.4) };
        let phi2 = if level { 0.0 } else { self.between(-3.0, 3.0) };
        Question::Part(PartPose { x: unit * self.between(-0.4, 0.4), y, z: height, phi1, phi2 }, tool_length)
    }

    /// The sliders of a posture, or any.
    fn forward_question(&mut self, machine: &Machine, p: [f64; 3]) -> Question {
        let unit = scale(machine);
        let of_posture = platform(machine, p).ok().filter(|_| !self.one_in(6));
        let mut rho = match of_posture {
            Some(postures) => postures[usize::try_from(self.bits() % postures.len() as u64).unwrap_or(0)].rho,
            None => [0; 3].map(|_| unit * self.between(-1.0, 1.0)),
        };
        if self.one_in(8) {
            rho[2] = rho[1];
        }
        if self.one_in(20) {
            let far = unit * self.magnitude(1.0, 1e3);
            rho = rho.map(|rho| rho + far);
        }
        Question::Forward(rho)
    }

    /// A question near one at which the number of solutions changes, at a distance from 1e-2 to 1e-15 of the machine.
    fn near_merging(&mut self, machine: &Machine, question: &Question) -> Option<Question> {
        let unit = scale(machine);
        let change = [unit, unit, unit, 1.0, 1.0].map(|size| size * self.between(-0.5, 0.5));
        let other = question.with(std::array::from_fn(|i| question.numbers()[i] + change[i]));
        let count = question.count(machine)?;
        if other.count(machine)? == count {
            return None;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let is_alike = question.towards(&other, middle).count(machine)? == count;
            (low, high) = if is_alike { (middle, high) } else { (low, middle) };
        }
        let distance = self.magnitude(1e-15, 1e-2) * self.pick(&[-1.0, 1.0]);
        Some(question.towards(&other, 0.5 * (low + high) + distance))
    }
}
