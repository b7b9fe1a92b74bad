//! Windings of the table's angles.

use std::f64::consts::{PI, TAU};

use verne_solver::{
    Machine, Margins, SplitAngle, TableAngles, forward_working, rotary_windings, table_windings,
};

use crate::random::Random;

/// A machine with these ranges of tilt and rotary angle.
fn machine(tilt: [f64; 2], rotary: [f64; 2]) -> Machine {
    let mut data = Machine::verne().data().clone();
    (data.limits.tilt, data.limits.rotary) = (tilt, Some(rotary));
    Machine::new(data).unwrap()
}

/// All windings of an angle within a range, found one after the other.
fn admissible([low, high]: [f64; 2], angle: f64) -> Vec<f64> {
    (-20..=20).map(|n| angle + TAU * f64::from(n)).filter(|value| (low..=high).contains(value)).collect()
}

#[test]
fn the_nearest_winding_within_the_range_is_chosen() {
    let mut draw = Random::new(191);
    for _ in 0..20_000 {
        let ranges = [0; 2].map(|_| {
            let low = draw.between(-30.0, 20.0);
            [low, low + draw.magnitude(0.1, 40.0)]
        });
        let machine = machine(ranges[0], ranges[1]);
        let asked = [0; 2].map(|_| SplitAngle { remainder: draw.between(-PI, PI), turns: 0.0 });
        let near = [0; 2].map(|_| draw.between(-40.0, 40.0));
        let found = table_windings(&machine, asked, near.map(Some));
        for i in 0..2 {
            let values = admissible(ranges[i], asked[i].remainder);
            let off = |value: f64| (value - near[i]).abs();
            let Some(best) = values.iter().copied().min_by(|a, b| off(*a).total_cmp(&off(*b))) else {
                assert_eq!(found[i].turns, 0.0, "{ranges:?} {asked:?}");
                continue;
            };
            assert!((found[i].value - best).abs() < 1e-12, "{ranges:?} {asked:?} {near:?} {found:?}");
            assert!((found[i].value - asked[i].remainder - TAU * found[i].turns).abs() < 1e-12, "{found:?}");
        }
    }
}

#[test]
fn a_winding_outside_the_range_stays_as_requested() {
    let machine = machine([-1.5, 1.5], [-TAU, TAU]);
    for (angle, turns, expected) in
        [(0.5, 0.0, 0.5), (-0.5, 1.0, TAU - 0.5), (0.5, 1.0, 0.5), (3.0, -1.0, 3.0 - TAU)]
    {
        let asked = [SplitAngle { remainder: 0.0, turns: 0.0 }, SplitAngle { remainder: angle, turns }];
        let [_, theta2] = table_windings(&machine, asked, [None; 2]);
        assert_eq!(theta2.value, expected, "{angle} {turns}");
    }
}

/// A machine whose table turns without a limit.
#[test]
fn without_a_limit_every_winding_is_admissible() {
    let mut data = Machine::verne().data().clone();
    data.limits.rotary = None;
    let machine = Machine::new(data).unwrap();
    assert_eq!(rotary_windings(&machine, 0.3), None);
    let asked = |turns: f64| [0.0, turns].map(|turns| SplitAngle { remainder: 0.5, turns });
    for turns in [-90.0, 0.0, 7.0] {
        let [_, theta2] = table_windings(&machine, asked(turns), [None; 2]);
        assert_eq!((theta2.turns, theta2.value), (turns, 0.5 + TAU * turns));
        let [_, theta2] = table_windings(&machine, asked(0.0), [None, Some(TAU * turns)]);
        assert_eq!(theta2.turns, turns);
    }
    let posture = forward_working(&machine, [500.0; 3]).unwrap();
    let margins = Margins::of(&machine, &posture, Some(TableAngles { theta1: 0.0, theta2: 1e3 }));
    assert!(margins.rotary.is_none() && margins.tilt.is_some() && margins.feasible());
}
