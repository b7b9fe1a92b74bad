//! Inclinations of a point against solution and margins.

use verne_solver::workspace::dexterity::{Interval, orientations};
use verne_solver::{Machine, Margins, PartPose, part_working, table_angles};

use crate::machines::{Random, changed, others, random};

/// The margins' own answer, and the worst margin.
fn reached(machine: &Machine, [x, y, z]: [f64; 3], phi: [f64; 2], length: f64) -> bool {
    let pose = PartPose { x, y, z, phi1: phi[0], phi2: phi[1] };
    part_working(machine, &pose, length).is_ok_and(|posture| {
        let table = table_angles(machine, posture.pose.alpha, phi[0], phi[1]);
        Margins::of(machine, &posture, Some(table)).feasible()
    })
}

fn within(intervals: &[Interval], phi1: f64) -> bool {
    intervals.iter().any(|interval| (interval.ends[0]..=interval.ends[1]).contains(&phi1))
}

fn machines() -> Vec<Machine> {
    let mut numbers = Random(0x2545_f491);
    let mut machines: Vec<Machine> = others().into_iter().map(|(_, machine)| machine).collect();
    machines.push(Machine::verne());
    machines.push(changed(|data| data.limits.tilt = [-0.4, 0.9]));
    machines.push(changed(|data| data.limits.stroke = [[0.0, 90.0], [20.0, 100.0], [10.0, 120.0]]));
    machines.extend(std::iter::repeat_with(|| random(&mut numbers)).take(25).flatten());
    machines
}

/// Less than this beside an end the point is reached on the one side and not on the other.
const SHARP: f64 = 2e-9;

/// An end is where the margins say it is, and what they say ends it.
fn ends_hold(machine: &Machine, point: [f64; 3], [phi2, length]: [f64; 2], interval: &Interval) {
    let [from, to] = interval.ends;
    for (end, sign, binding) in [(from, -1.0, interval.bindings[0]), (to, 1.0, interval.bindings[1])] {
        let beside = |step: f64| end + sign * step;
        let Some(binding) = binding else { continue };
        assert!(!reached(machine, point, [beside(SHARP), phi2], length), "{point:?} {interval:?}");
        if to - from > 4.0 * SHARP {
            assert!(reached(machine, point, [beside(-SHARP), phi2], length), "{point:?} {interval:?}");
        }
        let [x, y, z] = point;
        let pose = PartPose { x, y, z, phi1: beside(1e-7), phi2 };
        if let Ok(posture) = part_working(machine, &pose, length) {
            let table = table_angles(machine, posture.pose.alpha, pose.phi1, phi2);
            let worst = Margins::of(machine, &posture, Some(table)).worst(machine);
            assert_eq!(worst.constraint, binding.constraint, "{point:?} {interval:?}");
        }
    }
}

/// Every inclination of a dense scan is in an interval exactly if the margins say so.
#[test]
fn a_dense_scan_finds_the_same() {
    const SCAN: u32 = 720;
    let mut numbers = Random(0x6c07_8965);
    let (mut several, mut some) = (0, 0);
    for machine in machines() {
        for length in [0.0, 150.0] {
            for _ in 0..25 {
                let phi2 = numbers.between(-3.0, 3.0);
                let point = [
                    numbers.between(-400.0, 400.0),
                    numbers.between(-700.0, 700.0),
                    numbers.between(-500.0, 900.0),
                ];
                let range = [-3.1, 3.1];
                let found = orientations(&machine, point, phi2, length, range).unwrap();
                assert!(found.windows(2).all(|pair| pair[0].ends[1] < pair[1].ends[0]));
                several += usize::from(found.len() > 1);
                some += usize::from(!found.is_empty());
                for interval in &found {
                    ends_hold(&machine, point, [phi2, length], interval);
                }
                for n in 0..=SCAN {
                    let phi1 = range[0] + (range[1] - range[0]) * f64::from(n) / f64::from(SCAN);
                    let near = found.iter().flat_map(|i| i.ends).any(|end| (end - phi1).abs() < 1e-8);
                    let reached = reached(&machine, point, [phi1, phi2], length);
                    assert!(
                        near || within(&found, phi1) == reached,
                        "{point:?} {phi1} {phi2} {length}: {reached} {found:?} {:?}",
                        machine.data()
                    );
                }
            }
        }
    }
    assert!(some > 300 && several > 20, "{several} of {some}");
}
