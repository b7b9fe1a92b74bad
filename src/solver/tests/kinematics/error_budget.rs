//! Error budgets against the forward solution of machines with random parameters.

use std::f64::consts::TAU;

use verne_solver::error_budget::{ErrorBudget, Tolerances};
use verne_solver::parameter::{ActualMachine, PARAMETERS, Parameter, ParameterUnit, Tool, ToolFrame};
use verne_solver::{KinematicsError, Machine, Posture, TableAngles, forward_working};

use crate::machines::random;
use crate::random::Random;

/// Tolerances of hundredths of a millimetre and of some arcseconds, times a factor.
fn tolerances(draw: &mut Random, factor: f64) -> Tolerances {
    let each = Parameter::ALL.map(|parameter| {
        let unit = if parameter.unit() == ParameterUnit::Millimetre { 0.02 } else { 2e-5 };
        (parameter, factor * unit * draw.between(0.0, 2.0))
    });
    Tolerances::new(each).unwrap()
}

/// A machine in a posture, a tool, and the frame in which it is seen.
struct Case {
    machine: Machine,
    posture: Posture,
    tool_length: f64,
    frame: ToolFrame,
}

impl Case {
    fn new(machine: Machine, rho: [f64; 3], draw: &mut Random) -> Result<Self, KinematicsError> {
        let posture = forward_working(&machine, rho)?;
        let table = TableAngles { theta1: draw.between(-1.0, 1.0), theta2: draw.between(-3.0, 3.0) };
        let frame = if draw.one_in(2) { ToolFrame::Machine } else { ToolFrame::Part(table) };
        Ok(Self { machine, posture, tool_length: draw.between(0.0, 200.0), frame })
    }

    fn budget(&self, tolerances: &Tolerances) -> ErrorBudget {
        ErrorBudget::of(&self.machine, &self.posture, self.tool_length, self.frame, tolerances).unwrap()
    }

    /// The tool by the forward solution of the machine with changed parameters.
    fn tool(&self, changes: &[f64; PARAMETERS]) -> Option<Tool> {
        let changes = Parameter::ALL.into_iter().zip(*changes);
        let actual = ActualMachine::new(&self.machine, self.tool_length).with(changes);
        let machine = actual.machine().ok()?;
        let offsets = [Parameter::o1, Parameter::o2, Parameter::o3].map(|offset| actual.value(offset));
        let rho = [0, 1, 2].map(|i| self.posture.rho[i] + offsets[i]);
        Some(actual.tool(&forward_working(&machine, rho).ok()?.pose, self.frame))
    }

    /// The displacement of the tool's end and the change of its axis, by the same.
    fn change(&self, changes: &[f64; PARAMETERS]) -> Option<[[f64; 3]; 2]> {
        let (nominal, actual) = (self.tool(&[0.0; PARAMETERS])?, self.tool(changes)?);
        let difference = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| b[i] - a[i]);
        Some([difference(nominal.tip, actual.tip), difference(nominal.axis, actual.axis)])
    }
}

/// Cases of the built-in machine and of machines of other proportions.
fn cases(seed: u64, wanted: usize) -> Vec<Case> {
    let mut draw = Random::new(seed);
    let mut cases = Vec::new();
    while cases.len() < wanted {
        let machine = if draw.one_in(2) { Some(Machine::verne()) } else { random(&mut draw) };
        let rho = [0, 1, 2].map(|_| draw.between(100.0, 600.0));
        let Some(case) = machine.and_then(|machine| Case::new(machine, rho, &mut draw).ok()) else {
            continue;
        };
        // Near a singularity the first order does not suffice.
        let det = verne_solver::jacobian::conditioning(&case.machine, &case.posture).det;
        if det.abs() > 0.05 {
            cases.push(case);
        }
    }
    cases
}

fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}

/// A normal deviate (Box and Muller).
fn normal(draw: &mut Random) -> f64 {
    (-2.0 * (1.0 - draw.fraction()).ln()).sqrt() * (TAU * draw.fraction()).cos()
}

#[test]
fn rms_and_standard_deviations_equal_those_of_random_machines() {
    const SAMPLES: u32 = 4_000;
    let mut draw = Random::new(2130);
    for case in cases(2131, 12) {
        let tolerances = tolerances(&mut draw, 1.0);
        let budget = case.budget(&tolerances);
        // Sums of the squares of each coordinate, of the tool's end and of its axis.
        let mut squares = [[0.0; 3]; 2];
        for _ in 0..SAMPLES {
            let changes = Parameter::ALL.map(|parameter| tolerances.of(parameter) * normal(&mut draw));
            let found = case.change(&changes).unwrap();
            for (sums, found) in squares.iter_mut().zip(found) {
                for (sum, part) in sums.iter_mut().zip(found) {
                    *sum += part * part;
                }
            }
        }
        // Of a root of a mean of n squares the standard deviation is 1/√(2n), relative: five of them.
        let within = 5.0 / (2.0 * f64::from(SAMPLES)).sqrt();
        for (figure, squares) in [&budget.tip, &budget.axis].into_iter().zip(squares) {
            let found = squares.map(|sum| (sum / f64::from(SAMPLES)).sqrt());
            assert!((length(found) / figure.rms - 1.0).abs() < within, "{found:?} {figure:?}");
            for (found, expected) in found.into_iter().zip(figure.standard_deviations) {
                assert!(
                    (found - expected).abs() <= within * expected + 1e-6 * figure.rms,
                    "{found} {expected}"
                );
            }
        }
    }
}

#[test]
fn no_random_machine_within_its_tolerances_is_worse_than_the_worst_case() {
    let mut draw = Random::new(2132);
    for case in cases(2133, 60) {
        let tolerances = tolerances(&mut draw, 1.0);
        let budget = case.budget(&tolerances);
        let (mut tip, mut axis) = (0.0_f64, 0.0_f64);
        for _ in 0..300 {
            // Vertices are worse than what is between them.
            let changes = Parameter::ALL.map(|parameter| tolerances.of(parameter) * draw.pick(&[-1.0, 1.0]));
            let [end, direction] = case.change(&changes).unwrap();
            (tip, axis) = (tip.max(length(end)), axis.max(length(direction)));
        }
        // The second order is about the square of a relative change of 1e-4.
        assert!(tip <= budget.tip.worst * (1.0 + 1e-3), "{tip} {}", budget.tip.worst);
        assert!(axis <= budget.axis.worst * (1.0 + 1e-3), "{axis} {}", budget.axis.worst);
        assert!(tip > 0.4 * budget.tip.worst, "the worst case is no loose bound: {tip} {}", budget.tip.worst);
    }
}

#[test]
fn the_worst_changes_have_the_worst_error_in_the_exact_model() {
    let mut draw = Random::new(2134);
    for case in cases(2135, 100) {
        let seed = draw.bits();
        // The first order is off by the second: a tenth of the tolerances, a tenth of the relative difference.
        let differences = [1.0, 0.1, 0.01].map(|factor| {
            let budget = case.budget(&tolerances(&mut Random::new(seed), factor));
            let tip = budget.exact(&budget.tip.worst_changes).unwrap().tip;
            let axis = budget.exact(&budget.axis.worst_changes).unwrap().axis;
            let [end, _] = case.change(&budget.tip.worst_changes).unwrap();
            assert!(length(end) <= tip * (1.0 + 1e-6), "{end:?} {tip}: the forward solution of that machine");
            [tip / budget.tip.worst - 1.0, axis / budget.axis.worst - 1.0]
        });
        for figure in 0..2 {
            for (i, most) in [2e-3, 2e-4, 2e-5].into_iter().enumerate() {
                assert!(differences[i][figure].abs() < most, "{differences:?}");
            }
        }
    }
}

#[test]
fn figures_obey_their_relations() {
    let mut draw = Random::new(2136);
    for case in cases(2137, 100) {
        let budget = case.budget(&tolerances(&mut draw, 1.0));
        for figure in [&budget.tip, &budget.axis] {
            let sum: f64 = figure.contributions.iter().sum();
            let root = figure.contributions.iter().map(|part| part * part).sum::<f64>().sqrt();
            assert!((root - figure.rms).abs() < 1e-12 * root);
            assert!((length(figure.standard_deviations) - figure.rms).abs() < 1e-12 * figure.rms);
            assert!(figure.rms <= figure.worst * (1.0 + 1e-12) && figure.worst <= sum * (1.0 + 1e-12));
        }
    }
}

#[test]
fn one_tolerance_makes_one_contribution() {
    let mut draw = Random::new(2138);
    for case in cases(2139, 20) {
        let parameter = draw.pick(&Parameter::ALL);
        let budget = case.budget(&Tolerances::new([(parameter, 1e-3)]).unwrap());
        for figure in [&budget.tip, &budget.axis] {
            let alone = figure.contributions[parameter.index()];
            assert!(
                (figure.rms - alone).abs() <= 1e-12 * alone && (figure.worst - alone).abs() <= 1e-12 * alone
            );
            let others = (0..PARAMETERS).filter(|i| *i != parameter.index());
            assert!(others.into_iter().all(|i| figure.contributions[i] == 0.0));
        }
    }
    let none = Tolerances::new([]).unwrap();
    let case = cases(2140, 1).remove(0);
    let budget = case.budget(&none);
    assert_eq!([budget.tip.rms, budget.tip.worst, budget.axis.worst], [0.0; 3]);
    let still = budget.exact(&budget.tip.worst_changes).unwrap();
    assert!(still.tip < 1e-9 && still.axis < 1e-12, "{still:?}");
}
