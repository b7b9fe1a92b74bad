//! The set-up with the greatest reserve.

use std::f64::consts::PI;

use verne_solver::toolpath::{
    AdjustableProgram, Placement, PlacementRequest, PlanError, PlanOptions, SetUp, place, plan,
};
use verne_solver::workspace::{Observer, Unobserved};
use verne_solver::{Constraint, Machine};

use super::random::Random;
use super::random_programs;
use super::support::{Clamped, arrive, feed, rapid};

/// t of the plan in a set-up; `None` if a limit without a reserve is broken.
fn planned(
    machine: &Machine,
    program: &Clamped,
    set_up: &SetUp,
    reserve: &[(Constraint, f64)],
) -> Option<f64> {
    let motions = program.motions(set_up);
    let report = plan(machine, &*motions, &PlanOptions::default(), |_| true, |_| {}).unwrap();
    let of =
        |constraint| reserve.iter().find(|(listed, _)| *listed == constraint).map(|(_, reserve)| *reserve);
    let broken = |margin: &verne_solver::Margin| of(margin.constraint).is_none() && margin.value < 0.0;
    if report.failures.iter().any(|failure| failure.joints.is_none())
        || report.least.iter().any(|least| broken(&least.margin))
    {
        return None;
    }
    report
        .least
        .iter()
        .filter_map(|least| Some(least.margin.value / of(least.margin.constraint)?))
        .reduce(f64::min)
}

/// The best place of a grid that is refined around its best nodes.
fn by_brute_force(
    machine: &Machine,
    program: &Clamped,
    given: SetUp,
    free: &[(usize, [f64; 2])],
    reserve: &[(Constraint, f64)],
) -> f64 {
    // Few nodes along each of many parameters.
    let nodes: u32 = if free.len() > 2 { 5 } else { 9 };
    let around = if free.len() > 2 { 1.2 } else { 1.5 };
    let mut regions = vec![free.iter().map(|(_, range)| *range).collect::<Vec<_>>()];
    let mut best = f64::NEG_INFINITY;
    for _ in 0..18 {
        let mut found: Vec<(f64, Vec<f64>, Vec<f64>)> = Vec::new();
        for region in &regions {
            let steps: Vec<f64> =
                region.iter().map(|[low, high]| (high - low) / f64::from(nodes - 1)).collect();
            for node in 0..nodes.pow(u32::try_from(free.len()).unwrap()) {
                let mut parameters = given.parameters();
                let (mut rest, mut at) = (node, Vec::new());
                for (i, (parameter, _)) in free.iter().enumerate() {
                    at.push(region[i][0] + steps[i] * f64::from(rest % nodes));
                    parameters[*parameter] = at[i];
                    rest /= nodes;
                }
                if let Some(t) = planned(machine, program, &SetUp::of_parameters(parameters), reserve) {
                    found.push((t, at, steps.clone()));
                }
            }
        }
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        best = best.max(found[0].0);
        let around = |(_, at, steps): &(f64, Vec<f64>, Vec<f64>)| {
            let ends = at.iter().zip(steps).zip(free).map(|((at, step), (_, [low, high]))| {
                [(at - around * step).max(*low), (at + around * step).min(*high)]
            });
            ends.collect::<Vec<_>>()
        };
        regions = found.iter().take(2).map(around).collect();
    }
    best
}

fn placed(
    machine: &Machine,
    program: &Clamped,
    given: SetUp,
    free: &[(usize, [f64; 2])],
    reserve: &[(Constraint, f64)],
) -> Placement {
    let mut bounds = given.parameters().map(|fixed| [fixed; 2]);
    for (parameter, range) in free {
        bounds[*parameter] = *range;
    }
    let request = PlacementRequest { bounds, reserve: reserve.to_vec() };
    place(machine, program, given, &request, &PlanOptions::default(), &Unobserved).unwrap()
}

/// A tilted contour with a rapid, about the origin of its own frame.
pub(crate) fn contour() -> Clamped {
    let axis = |x: f64, y: f64| [0.004 * x, 0.004 * y - 0.05, 1.0];
    let corners = [[-60.0, -40.0, 0.0], [60.0, -40.0, 10.0], [60.0, 50.0, 0.0], [-60.0, 50.0, -10.0]];
    let mut program = vec![arrive(corners[0], axis(-60.0, -40.0))];
    for [x, y, z] in corners.into_iter().cycle().skip(1).take(4) {
        program.push(feed([x, y, z], axis(x, y)));
    }
    program.push(rapid([0.0, 0.0, 60.0], axis(0.0, 0.0)));
    program.push(feed([0.0, 0.0, -20.0], axis(0.0, 0.0)));
    Clamped(program)
}

const GIVEN: SetUp = SetUp { origin: [20.0, -30.0, 280.0], turn: 0.0, tool_length: 100.0 };

/// Free parameters with their bounds, and reserves.
type Case<'a> = (&'a [(usize, [f64; 2])], &'a [(Constraint, f64)]);

#[test]
fn small_programs_have_the_reserve_that_a_refined_grid_finds() {
    let machine = Machine::verne();
    let degrees = f64::to_radians;
    let cases: [Case<'_>; 5] = [
        (&[(2, [0.0, 800.0])], &[(Constraint::Stroke, 20.0)]),
        (
            &[(0, [-200.0, 200.0]), (2, [0.0, 800.0])],
            &[(Constraint::Stroke, 20.0), (Constraint::SliderJoint, degrees(2.0))],
        ),
        (
            &[(0, [-200.0, 200.0]), (1, [-300.0, 300.0])],
            &[(Constraint::SliderJoint, degrees(2.0)), (Constraint::PlatformJoint, degrees(1.0))],
        ),
        (
            &[(3, [-PI, PI]), (1, [-200.0, 200.0])],
            &[(Constraint::Tilt, degrees(5.0)), (Constraint::PlatformJoint, degrees(1.0))],
        ),
        (
            &[(4, [0.0, 400.0]), (0, [-300.0, 300.0])],
            &[(Constraint::Stroke, 10.0), (Constraint::ParallelSingularity, 0.05)],
        ),
    ];
    for (free, reserve) in cases {
        let best = placed(&machine, &contour(), GIVEN, free, reserve);
        let t = best.t.unwrap();
        let exact = planned(&machine, &contour(), &best.set_up, reserve).unwrap();
        assert_eq!(t, exact, "the plan of the answer says the same");
        let grid = by_brute_force(&machine, &contour(), GIVEN, free, reserve);
        assert!(t >= grid - 1e-3 * grid.abs(), "{free:?}: {t} {grid}");
        assert!(!best.active.is_empty());
        assert!(Some(t) >= best.given.0);
    }
}

/// Two cuts with the tool inclined.
fn corner() -> Clamped {
    Clamped(vec![
        arrive([-60.0, -40.0, 0.0], [-0.1, -0.1, 1.0]),
        feed([60.0, -40.0, 10.0], [0.2, -0.1, 1.0]),
        feed([60.0, 50.0, 0.0], [0.2, 0.15, 1.0]),
    ])
}

#[test]
fn three_and_four_free_parameters_have_the_reserve_that_a_refined_grid_finds() {
    let machine = Machine::verne();
    let degrees = f64::to_radians;
    let (x, y, z, turn, length) =
        ((0, [-200.0, 200.0]), (1, [-200.0, 200.0]), (2, [0.0, 600.0]), (3, [-1.5, 1.5]), (4, [50.0, 250.0]));
    let cases: [Case<'_>; 4] = [
        (&[x, y, z], &[(Constraint::Stroke, 20.0), (Constraint::SliderJoint, degrees(2.0))]),
        (&[x, z, turn], &[(Constraint::Stroke, 20.0), (Constraint::PlatformJoint, degrees(2.0))]),
        (&[y, z, length], &[(Constraint::SliderJoint, degrees(2.0)), (Constraint::Tilt, degrees(4.0))]),
        (&[x, y, z, turn], &[(Constraint::Stroke, 20.0), (Constraint::SliderJoint, degrees(1.0))]),
    ];
    for (free, reserve) in cases {
        let t = placed(&machine, &corner(), GIVEN, free, reserve).t.unwrap();
        let grid = by_brute_force(&machine, &corner(), GIVEN, free, reserve);
        println!("{free:?}: {t} {grid}");
        assert!(t >= grid - 1e-3 * grid.abs(), "{free:?}: {t} {grid}");
        assert!(grid >= t - 0.02 * t.abs(), "the grid is no test: {free:?}: {t} {grid}");
    }
}

#[test]
fn the_answer_is_never_worse_than_the_given_set_up_and_is_the_same_on_one_thread() {
    let mut random = Random::new(1904);
    for _ in 0..6 {
        let machine = random_programs::machine(&mut random);
        let program = Clamped(random_programs::program(&machine, &mut random));
        let given = SetUp { tool_length: 100.0, ..SetUp::default() };
        let free = [(0, [-60.0, 80.0]), (2, [-100.0, 50.0]), (3, [-0.4, 0.4])];
        let reserve = [(Constraint::Stroke, 10.0), (Constraint::PlatformJoint, 0.02)];
        let best = placed(&machine, &program, given, &free, &reserve);
        let before = planned(&machine, &program, &given, &reserve);
        assert!(best.t >= before && best.given.0.is_some(), "{:?} {before:?}", best.t);
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let again = one.install(|| placed(&machine, &program, given, &free, &reserve));
        assert_eq!(best, again);
    }
}

#[test]
fn fixed_parameters_give_the_plan_of_the_given_set_up() {
    let reserve = [(Constraint::Stroke, 20.0)];
    let best = placed(&Machine::verne(), &contour(), GIVEN, &[], &reserve);
    assert_eq!((best.set_up, best.t), (GIVEN, planned(&Machine::verne(), &contour(), &GIVEN, &reserve)));
    assert_eq!(best.given, (best.t, true));
    let least = best.active.iter().map(|active| active.margin.value / 20.0).fold(f64::INFINITY, f64::min);
    assert!((least - best.t.unwrap()).abs() < 1e-3, "{least} {:?}", best.active);
}

#[test]
fn a_program_out_of_reach_is_moved_to_where_the_machine_reaches_it() {
    let given = SetUp { origin: [900.0, 700.0, 1500.0], ..GIVEN };
    let free = [(0, [-900.0, 900.0]), (1, [-700.0, 700.0]), (2, [0.0, 1500.0])];
    let best = placed(&Machine::verne(), &contour(), given, &free, &[(Constraint::Stroke, 20.0)]);
    assert_eq!(best.given, (None, false));
    assert!(best.report.is_feasible() && best.t.unwrap() > 15.0, "{:?}", best.t);
}

/// Stops at once.
struct Stopping;

impl Observer for Stopping {
    fn progress(&self, _: f64) {}

    fn cancelled(&self) -> bool {
        true
    }
}

#[test]
fn a_placement_can_be_stopped() {
    let request = PlacementRequest {
        bounds: GIVEN.parameters().map(|given| [given - 1.0, given + 1.0]),
        reserve: vec![(Constraint::Stroke, 20.0)],
    };
    let options = PlanOptions::default();
    let stopped = place(&Machine::verne(), &contour(), GIVEN, &request, &options, &Stopping);
    assert_eq!(stopped.err(), Some(PlanError::Cancelled));
}
