//! Windows of a parameter against bisection on the verdict of plans.

use std::f64::consts::{PI, TAU};
use std::sync::atomic::{AtomicU32, Ordering};

use verne_solver::toolpath::{Motion, MotionKind, PlanError, PlanOptions, WINDOW_PRECISION, Window, window};
use verne_solver::workspace::{Observer, Unobserved};
use verne_solver::{Constraint, Machine};

use crate::parametric::{Parameter, Program};
use crate::random::Random;
use crate::support::{any_machine, arrive, feed, rapid};

fn found(machine: &Machine, program: &Program, range: [f64; 2]) -> Window {
    window(machine, program, range, &PlanOptions::default(), &Unobserved).unwrap()
}

/// Checks every end of a window by bisection between a value well inside and one well outside, and the verdicts at many
/// values in the whole range.
fn check(machine: &Machine, program: &Program, range: [f64; 2], found: &Window) {
    let options = PlanOptions::default();
    let is_feasible = |value| program.is_feasible(machine, &options, value);
    for interval in &found.intervals {
        let inside = 0.5 * (interval.range[0] + interval.range[1]);
        for (i, (end, limit)) in interval.range.into_iter().zip(interval.ends).enumerate() {
            assert!(is_feasible(end), "{end} of {found:?}");
            if limit.is_none() {
                assert_eq!(end, range[i]);
                continue;
            }
            let out = [-1.0, 1.0][i];
            assert!(!is_feasible(end + out * WINDOW_PRECISION), "beyond {end} of {found:?}");
            let (mut good, mut bad) = (inside, end + out * 10.0 * found.resolution);
            if is_feasible(bad) {
                continue;
            }
            while (good - bad).abs() > 0.1 * WINDOW_PRECISION {
                let middle = 0.5 * (good + bad);
                if is_feasible(middle) { good = middle } else { bad = middle }
            }
            assert!((good - end).abs() <= WINDOW_PRECISION, "{good} and {end} of {found:?}");
        }
    }
    for i in 0..=97 {
        let value = range[0] + (range[1] - range[0]) * f64::from(i) / 97.0;
        let is_inside =
            found.intervals.iter().any(|interval| (interval.range[0]..=interval.range[1]).contains(&value));
        let is_near =
            found.intervals.iter().flat_map(|interval| interval.range).any(|end| (end - value).abs() < 1e-3);
        assert!(is_near || is_inside == is_feasible(value), "{value}: {found:?}");
    }
}

fn line() -> Vec<Motion> {
    vec![arrive([-100.0, 0.0, 300.0], [0.0, 0.0, 1.0]), feed([100.0, 30.0, 300.0], [0.2, 0.1, 1.0])]
}

/// Turns of a helix with the tool inclined outwards.
fn helix(turns: f64) -> Vec<Motion> {
    let count = 40.0 * turns;
    let at = |i: f64| {
        let (sine, cosine) = (TAU * turns * i / count).sin_cos();
        ([60.0 * cosine, 60.0 * sine, 250.0 + 2.0 * i], [0.3 * cosine, 0.3 * sine, 1.0])
    };
    let (tip, axis) = at(0.0);
    let mut motions = vec![arrive(tip, axis)];
    let mut i = 1.0;
    while i <= count {
        let (tip, axis) = at(i);
        motions.push(feed(tip, axis));
        i += 1.0;
    }
    motions
}

#[test]
fn ends_agree_with_bisection_on_the_verdict() {
    let machine = Machine::verne();
    let cases = [
        (line(), Parameter::Length, [0.0, 900.0]),
        (line(), Parameter::X, [-600.0, 600.0]),
        (helix(1.5), Parameter::Length, [0.0, 900.0]),
        (helix(1.5), Parameter::Z, [-600.0, 900.0]),
    ];
    for (motions, parameter, range) in cases {
        let program = Program::new(motions, parameter);
        let found = found(&machine, &program, range);
        assert_eq!(found.intervals.len(), 1, "{parameter:?}: {found:?}");
        assert!(found.intervals[0].ends.iter().any(Option::is_some), "{parameter:?}: {found:?}");
        check(&machine, &program, range, &found);
    }
}

#[test]
fn ends_agree_with_bisection_on_random_machines() {
    let mut random = Random::new(51);
    let mut ended = 0;
    for number in 0..12 {
        let machine = any_machine(&mut random);
        let parameter = [Parameter::Length, Parameter::X, Parameter::Turn][number % 3];
        let range = match parameter {
            Parameter::Length => [0.0, 800.0],
            Parameter::Turn => [-PI, PI],
            _ => [-500.0, 500.0],
        };
        let mut motions = if number % 2 == 0 { line() } else { helix(0.5) };
        for motion in &mut motions {
            motion.end.tip[0] += 150.0;
        }
        let program = Program::new(motions, parameter);
        let found = found(&machine, &program, range);
        ended += found.intervals.iter().flat_map(|interval| interval.ends).flatten().count();
        check(&machine, &program, range, &found);
    }
    assert!(ended > 6, "{ended}");
}

#[test]
fn a_window_may_be_empty_or_the_whole_range() {
    let machine = Machine::verne();
    let program = Program::new(line(), Parameter::Length);
    let whole = found(&machine, &program, [50.0, 60.0]);
    assert_eq!(whole.intervals.len(), 1);
    assert_eq!((whole.intervals[0].range, whole.intervals[0].ends), ([50.0, 60.0], [None; 2]));
    assert!(whole.nearest.is_none() && whole.intervals[0].step < 1.0);
    let none = found(&machine, &program, [2000.0, 2500.0]);
    assert_eq!(none.intervals, []);
    let (value, worst) = none.nearest.unwrap();
    assert_eq!(value, 2000.0, "the shortest tool comes nearest");
    assert!(worst.unwrap().margin.value < 0.0);
}

#[test]
fn a_window_may_have_several_intervals() {
    // An upright tool leaves theta2 as it is, and the machine reaches farther along y than along x.
    let machine = Machine::verne();
    let motions =
        vec![arrive([450.0, -20.0, 300.0], [0.0, 0.0, 1.0]), feed([450.0, 20.0, 300.0], [0.0, 0.0, 1.0])];
    let program = Program::new(motions, Parameter::Turn);
    let range = [-PI, PI];
    let found = found(&machine, &program, range);
    assert_eq!(found.intervals.len(), 2, "{found:?}");
    check(&machine, &program, range, &found);
}

#[test]
fn windings_decide_where_a_long_cut_runs() {
    // Two and a half turns: the range of ±360° has one winding for some set-ups and none for more turns.
    let machine = Machine::verne();
    let program = Program::new(helix(1.8), Parameter::Turn);
    let range = [0.0, TAU];
    let turning = found(&machine, &program, range);
    check(&machine, &program, range, &turning);
    let never = Program::new(helix(3.0), Parameter::Length);
    let none = found(&machine, &never, [50.0, 150.0]);
    assert_eq!(none.intervals, []);
    assert_eq!(none.nearest.unwrap().1.unwrap().margin.constraint, Constraint::Rotary);
}

/// A grid of points on a dome, which rapids join.
fn dome(rows: u32, columns: u32) -> Vec<Motion> {
    let at = |i: u32, j: u32| {
        let (a, b) = (f64::from(i) / f64::from(rows) - 0.5, f64::from(j) / f64::from(columns) - 0.5);
        let tip = [120.0 * a, 120.0 * b, 320.0 - 200.0 * (a * a + b * b)];
        (tip, [0.9 * a + 0.3, 0.9 * b + 0.3, 1.0])
    };
    let mut motions = Vec::new();
    for i in 0..=rows {
        for j in 0..=columns {
            let (tip, axis) = at(i, if i % 2 == 0 { j } else { columns - j });
            motions.push(match (i, j) {
                (0, 0) => arrive(tip, axis),
                (_, 0) => rapid(tip, axis),
                _ => feed(tip, axis),
            });
        }
    }
    motions
}

#[test]
fn long_programs_have_the_same_ends() {
    let machine = Machine::verne();
    let motions = dome(60, 80);
    assert!(motions.len() > 4_000 && motions[1].kind == MotionKind::Feed);
    for (parameter, range) in [(Parameter::Length, [0.0, 900.0]), (Parameter::X, [-700.0, 700.0])] {
        let program = Program::new(motions.clone(), parameter);
        let found = found(&machine, &program, range);
        assert!(found.plans < 40, "{} plans", found.plans);
        let options = PlanOptions::default();
        let [interval] = &found.intervals[..] else { panic!("{found:?}") };
        for (i, end) in interval.range.into_iter().enumerate() {
            assert!(program.is_feasible(&machine, &options, end));
            if interval.ends[i].is_some() {
                let outside = end + [-1.0, 1.0][i] * WINDOW_PRECISION;
                assert!(!program.is_feasible(&machine, &options, outside), "{parameter:?} {found:?}");
            }
        }
    }
}

#[test]
fn one_thread_and_many_find_the_same() {
    let machine = Machine::verne();
    let program = Program::new(helix(1.5), Parameter::Length);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| found(&machine, &program, [0.0, 900.0]))
    };
    assert_eq!(with(1), with(4));
}

#[test]
fn a_cancelled_search_ends() {
    struct Cancelling(AtomicU32);

    impl Observer for Cancelling {
        fn progress(&self, _: f64) {}

        fn cancelled(&self) -> bool {
            self.0.fetch_add(1, Ordering::Relaxed) > 2
        }
    }

    let program = Program::new(helix(1.5), Parameter::Length);
    let observer = Cancelling(AtomicU32::new(0));
    let found = window(&Machine::verne(), &program, [0.0, 900.0], &PlanOptions::default(), &observer);
    assert_eq!(found, Err(PlanError::Cancelled));
}
