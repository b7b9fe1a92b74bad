//! Times of motions of a single slider, whose speed is known in closed form.

use verne_solver::toolpath::{Feed, Governor, Pace, Row, RowKind, ToolPosition, Way};
use verne_solver::{Constraint, Element, Margin, TableAngles};

use super::timing::{CYCLE, at, drives, timed};

/// Rows on which only one slider moves, in motions of one row each.
fn along_slider(places: &[f64]) -> Vec<Row> {
    let up = ToolPosition { tip: [0.0; 3], axis: [0.0, 0.0, 1.0] };
    let margin = Margin { constraint: Constraint::Stroke, element: Element::Leg(1), value: 1.0 };
    let table = TableAngles { theta1: 0.0, theta2: 0.0 };
    let row = |motion: usize, place: f64, length: Option<f64>| Row {
        motion,
        kind: RowKind::Feed,
        position: up,
        rho: [place, 0.0, 0.0],
        table,
        margin,
        way: length.map(|length| Way { fraction: 1.0, length, angle: 0.0 }),
        ends_track: true,
    };
    let first = places[..1].iter().map(|place| row(0, *place, None));
    let moves = places.windows(2).enumerate().map(|(i, p)| row(i + 1, p[1], Some((p[1] - p[0]).abs())));
    first.chain(moves).collect()
}

#[test]
fn a_straight_motion_is_a_trapezoid() {
    let (velocity, acceleration) = (500.0, 3000.0);
    for length in [1e-3, 0.5, 10.0, 80.0, 90.0, 1000.0] {
        for pieces in [1, 2, 7] {
            let places: Vec<f64> = (0..=pieces).map(|i| length * f64::from(i) / f64::from(pieces)).collect();
            let (_, times) = timed(&along_slider(&places), Some(drives()), at(Feed::Drives));
            let braking = velocity * velocity / acceleration;
            let exact = if length > braking {
                length / velocity + velocity / acceleration
            } else {
                2.0 * (length / acceleration).sqrt()
            };
            assert!((times.time / exact - 1.0).abs() < 1e-9, "{length} {pieces}: {} {exact}", times.time);
            assert!((times.by_joint[0] / exact - 1.0).abs() < 1e-9, "{times:?}");
        }
    }
}

#[test]
fn a_reversal_stops_but_for_the_step_of_a_cycle() {
    let there = timed(&along_slider(&[0.0, 100.0]), Some(drives()), at(Feed::Tip(100.0))).1.time;
    let back = timed(&along_slider(&[0.0, 100.0, 0.0]), Some(drives()), at(Feed::Tip(100.0))).1.time;
    assert!(back < 2.0 * there && back > 2.0 * there - 2.0 * CYCLE, "{back} {there}");
    let rows = along_slider(&[0.0, 100.0, 200.0]);
    let through = timed(&rows, Some(drives()), at(Feed::Tip(100.0))).1.time;
    let stopped = |motion| Pace { feed: Feed::Tip(100.0), from_rest: motion == 2 };
    let stopping = timed(&rows, Some(drives()), stopped).1.time;
    let ramps = 100.0 / 3000.0;
    assert!((through - 2.0 - ramps).abs() < 1e-9, "{through}");
    assert!((stopping - 2.0 - 2.0 * ramps).abs() < 1e-9, "{stopping}");
}

/// More rows than wait at once: the speed is as if all of them had been known.
#[test]
fn many_rows_do_not_stop_the_machine() {
    let places: Vec<f64> = (0..20_000).map(|i| f64::from(i) * 0.05).collect();
    let (rows, times) = timed(&along_slider(&places), Some(drives()), at(Feed::Tip(200.0)));
    let exact = 0.05 * 19_999.0 / 200.0 + 200.0 / 3000.0;
    assert!((times.time / exact - 1.0).abs() < 1e-9, "{} {exact}", times.time);
    assert!(rows[500..19_500].iter().all(|row| row.governor == Some(Governor::Feed)));
    // The stopping distance has more rows than wait.
    let places: Vec<f64> = (0..30_000).map(|i| f64::from(i) * 0.001).collect();
    let (_, times) = timed(&along_slider(&places), Some(drives()), at(Feed::Drives));
    let exact = 2.0 * (0.001 * 29_999.0 / 3000.0_f64).sqrt();
    assert!(times.time >= exact && times.time < 3.0 * exact, "{} {exact}", times.time);
}
