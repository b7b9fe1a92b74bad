//! What happens to the solutions on curves and at special points.

use verne_solver::atlas::{Atlas, AtlasRequest, Curve, CurveKind, PointKind, Space, Window, atlas};
use verne_solver::jacobian::conditioning;
use verne_solver::workspace::Unobserved;
use verne_solver::{Machine, Postures, forward, platform};

use crate::comparison::solutions;
use crate::machines::others;

/// The distance from a curve at which solutions are examined, relative to the longest dimension. They are as near to
/// merging as about its root.
const BESIDE: f64 = 1e-8;
/// Greatest value of what is zero on the curve.
const NEARLY_ZERO: f64 = 5e-3;

/// The atlas of a wide window.
fn computed(machine: &Machine, space: Space) -> Atlas {
    let range = [-2.5 * machine.longest(), 2.5 * machine.longest()];
    let request = AtlasRequest::new(machine, space, Some(Window { u: range, v: range }));
    atlas(machine, &request, &Unobserved).unwrap()
}

/// Whether no special point but the one at a place is near it.
fn is_apart(found: &Atlas, machine: &Machine, [u, v]: [f64; 2]) -> bool {
    let distances = found.points.iter().map(|point| (point.at[0] - u).hypot(point.at[1] - v));
    distances.filter(|distance| *distance > 0.0).all(|distance| distance > 0.02 * machine.longest())
}

fn postures(machine: &Machine, space: Space, [u, v]: [f64; 2]) -> Postures {
    let found = match space {
        Space::Platform => platform(machine, [u, v, 0.0]),
        Space::Joints => forward(machine, [0.0, u, v]),
    };
    found.unwrap_or_default()
}

/// The least value, over the solutions on both sides of a corner of a curve, of what is zero on the curve.
fn least(machine: &Machine, space: Space, curve: &Curve, corner: usize) -> f64 {
    let [before, at, after] = [0, 1, 2].map(|i| curve.points[corner - 1 + i]);
    let along = [after[0] - before[0], after[1] - before[1]];
    let length = along[0].hypot(along[1]) / (BESIDE * machine.longest());
    let mut least = f64::INFINITY;
    for sense in [1.0, -1.0] {
        let beside = [at[0] - sense * along[1] / length, at[1] + sense * along[0] / length];
        let found = postures(machine, space, beside);
        for (i, posture) in found.iter().enumerate() {
            let state = conditioning(machine, posture);
            let value = match curve.kind {
                CurveKind::Parallel | CurveKind::Constraint => state.det.abs(),
                CurveKind::LegTwo => state.serial[2].abs(),
                CurveKind::LegThree => state.serial[3].abs(),
                CurveKind::LegOne => {
                    let others = found[..i].iter().filter(|other| other.pose.alpha != posture.pose.alpha);
                    let apart = others.map(|other| (other.pose.alpha - posture.pose.alpha).abs());
                    apart.fold(f64::INFINITY, f64::min)
                }
            };
            least = least.min(value);
        }
    }
    least
}

#[test]
fn solutions_merge_on_curves() {
    for (name, machine) in others().into_iter().chain([("delta", Machine::linear_delta())]) {
        for space in [Space::Platform, Space::Joints] {
            let found = computed(&machine, space);
            for curve in &found.curves {
                for corner in (1..curve.points.len() - 1).step_by(5) {
                    let at = curve.points[corner];
                    if found.points.iter().any(|point| point.at == at) || !is_apart(&found, &machine, at) {
                        continue;
                    }
                    let value = least(&machine, space, curve, corner);
                    assert!(value < NEARLY_ZERO, "{name}, {space:?}, {:?} at {at:?}: {value}", curve.kind);
                }
            }
        }
    }
}

/// The numbers of solutions around a point, one after another.
fn around(machine: &Machine, space: Space, [u, v]: [f64; 2], radius: f64) -> Vec<usize> {
    (0..3_600_u32)
        .map(|i| (f64::from(i) + 0.5).to_radians() / 10.0)
        .filter_map(|angle| solutions(machine, space, [u + radius * angle.cos(), v + radius * angle.sin()]))
        .collect()
}

#[test]
fn a_cusp_ends_a_narrow_tongue_of_two_more_solutions() {
    let mut cusps = 0;
    for (name, machine) in others() {
        let found = computed(&machine, Space::Joints);
        for point in &found.points {
            if point.kind != PointKind::Cusp || !is_apart(&found, &machine, point.at) {
                continue;
            }
            let numbers = around(&machine, Space::Joints, point.at, 2e-4 * machine.longest());
            let (fewer, more) = (numbers.iter().min().unwrap(), numbers.iter().max().unwrap());
            let tongue = numbers.iter().filter(|number| *number == more).count();
            assert!(more - fewer == 2 && tongue < numbers.len() / 4, "{name}, {point:?}: {tongue}");
            cusps += 1;
        }
    }
    assert!(cusps > 10, "{cusps}");
}

#[test]
fn numbers_change_four_times_around_a_crossing() {
    let mut crossings = 0;
    for space in [Space::Platform, Space::Joints] {
        let found = computed(&Machine::verne(), space);
        for point in &found.points {
            if point.kind != PointKind::Crossing || !is_apart(&found, &Machine::verne(), point.at) {
                continue;
            }
            let numbers = around(&Machine::verne(), space, point.at, 1e-4);
            let next = numbers.iter().cycle().skip(1);
            let changes = numbers.iter().zip(next).filter(|(a, b)| a != b).count();
            assert_eq!(changes, 4, "{space:?}, {point:?}");
            crossings += 1;
        }
    }
    assert!(crossings > 3, "{crossings}");
}
