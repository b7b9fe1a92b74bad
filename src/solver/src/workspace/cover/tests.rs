//! The bounds over a box compared with values at its points.

use super::Rectangle;
use super::classification::{Class, all_limits, classify, parallelograms_apart};
use crate::machine::Machine;
use crate::random::{self, Random};
use crate::workspace::domain::{Domain, Limit, LimitSet};
use crate::workspace::request::{Kind, Request};

#[path = "../../../tests/support/lengths.rs"]
mod lengths;
#[path = "../../../tests/support/machines.rs"]
mod machines;

use machines::spread;

/// Any machine, also with thin rods and with any tilting range.
fn any_machine(numbers: &mut Random) -> Option<Machine> {
    let mut data = spread(numbers)?.data().clone();
    data.geometry.rod_radius = numbers.between(0.0, 90.0);
    let low = numbers.between(-0.5, 0.4);
    data.limits.tilt = [low, low + numbers.between(0.05, 6.0)];
    Machine::new(data).ok()
}

/// Every limit's values at points of a box lie within its bounds, and rise or fall as the bounds say.
#[test]
fn the_bounds_over_a_box_contain_the_values_at_its_points() {
    let mut numbers = Random::new(0x2545_f491_4f6c_dd1d);
    let (mut inside, mut simple, mut outside) = (0, 0, 0);
    for _ in 0..3_000 {
        let Some(machine) = any_machine(&mut numbers) else { continue };
        let kind = [Kind::Platform, Kind::Part][usize::from(numbers.between(0.0, 1.0) < 0.5)];
        let request = Request {
            tool_length: 50.0,
            phi1: numbers.between(-3.0, 3.0),
            table_clearance: (numbers.between(0.0, 1.0) < 0.5).then(|| numbers.between(-500.0, 500.0)),
            tool_radius: 5.0,
            ..Request::new(kind, 1.0)
        };
        let height = (numbers.between(0.0, 1.0) < 0.3).then(|| numbers.between(-500.0, 2_000.0));
        let domain = Domain::new(&machine, &request, height);
        let Some([low, high]) = parallelograms_apart(&domain) else { continue };
        for _ in 0..150 {
            let size = numbers.between(-9.0, -1.0).exp() * (high[0] - low[0]).max(high[1] - low[1]);
            let at = [0, 1].map(|axis| numbers.between(low[axis], high[axis]));
            let mut rectangle = [[0, 1].map(|i| at[i] - size), [0, 1].map(|i| at[i] + size)];
            for i in 0..2 {
                (rectangle[0][i], rectangle[1][i]) =
                    (rectangle[0][i].max(low[i]), rectangle[1][i].min(high[i]));
            }
            if at[1] < 0.0 {
                rectangle[1][1] = rectangle[1][1].min(0.0);
            } else {
                rectangle[0][1] = rectangle[0][1].max(0.0);
            }
            match classify(&domain, rectangle, all_limits(&domain)) {
                Class::Inside => {
                    inside += 1;
                    points(&mut numbers, rectangle, |at| {
                        let values = domain.values(&domain.column(at));
                        assert!(
                            values.iter().all(|value| *value >= -1e-9),
                            "{rectangle:?} {values:?} {machine:?}"
                        );
                    });
                }
                Class::Outside => {
                    outside += 1;
                    points(&mut numbers, rectangle, |at| {
                        let values = domain.values(&domain.column(at));
                        assert!(
                            values.iter().any(|value| *value < 1e-9),
                            "{rectangle:?} {values:?} {machine:?}"
                        );
                    });
                }
                Class::Crossed { limits, simple: true, .. } => {
                    simple += 1;
                    line_is_one_interval(&mut numbers, &domain, rectangle, limits);
                }
                Class::Crossed { .. } => {}
            }
        }
    }
    assert!(inside > 10_000 && simple > 1_500 && outside > 100_000, "{inside} {simple} {outside}");
}

fn points(numbers: &mut Random, [low, high]: Rectangle, mut look: impl FnMut([f64; 2])) {
    for _ in 0..12 {
        look([0, 1].map(|axis| numbers.between(low[axis], high[axis])));
    }
    for x in [low[0], high[0]] {
        look([x, low[1]]);
        look([x, high[1]]);
    }
}

/// The points of a line x = const that keep every limit are contiguous, and every limit that the cover proves is
/// kept.
fn line_is_one_interval(numbers: &mut Random, domain: &Domain<'_>, [low, high]: Rectangle, limits: LimitSet) {
    let x = numbers.between(low[0], high[0]);
    let mut changes = 0;
    let mut before = false;
    for step in 0..=40 {
        let y = low[1] + (high[1] - low[1]) * f64::from(step) / 40.0;
        let values = domain.values(&domain.column([x, y]));
        let member = values.iter().all(|value| *value >= 0.0);
        let every =
            |limits: LimitSet, least: f64| Limit::of_set(limits).all(|(limit, _)| values[limit] >= least);
        let legs = Limit::set(|limit| matches!(limit, Limit::LegSerial(_)));
        if every(Limit::LEG_ONE | legs, 0.0) {
            assert!(every(!limits & !Limit::LEG_ONE, -1e-9), "{:?} {values:?} {limits:b} {domain:?}", [x, y]);
        }
        changes += usize::from(member && !before);
        before = member;
    }
    assert!(changes <= 1, "{x:?} {low:?} {high:?} {limits:b} {domain:?}");
}
