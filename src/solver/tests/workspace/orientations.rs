//! Inclinations of a point compared with solution and margins.

use verne_solver::workspace::Binding;
use verne_solver::workspace::dexterity::{DexterityRequest, InclinationInterval, orientations};
use verne_solver::{Clearance, Constraint, Machine, Margins, PartPose, part_working, table_angles};

use crate::machines::{changed, others, random};
use crate::random::Random;

/// The margins of the working mode at an inclination.
fn margins(machine: &Machine, [x, y, z]: [f64; 3], phi1: f64, asked: &DexterityRequest) -> Option<Margins> {
    let DexterityRequest { tool_length, table_clearance, tool_radius, phi2, .. } = *asked;
    let posture = part_working(machine, &PartPose { x, y, z, phi1, phi2 }, tool_length).ok()?;
    let table = table_angles(machine, posture.pose.alpha, phi1, phi2);
    let clearance = Clearance::of(machine, table_clearance, tool_length, tool_radius);
    Some(Margins::above_table(machine, &posture, Some(table), clearance.as_ref()))
}

/// The decision by the margins.
fn reached(machine: &Machine, point: [f64; 3], phi1: f64, asked: &DexterityRequest) -> bool {
    margins(machine, point, phi1, asked).is_some_and(|margins| margins.feasible())
}

fn within(intervals: &[InclinationInterval], phi1: f64) -> bool {
    intervals.iter().any(|interval| (interval.ends[0]..=interval.ends[1]).contains(&phi1))
}

fn machines() -> Vec<Machine> {
    let mut numbers = Random::new(0x2545_f491);
    let mut machines: Vec<Machine> = others().into_iter().map(|(_, machine)| machine).collect();
    machines.push(Machine::verne());
    machines.push(changed(|data| data.limits.tilt = [-0.4, 0.9]));
    machines.push(changed(|data| data.limits.stroke = [[0.0, 90.0], [20.0, 100.0], [10.0, 120.0]]));
    machines.extend(std::iter::repeat_with(|| random(&mut numbers)).take(25).flatten());
    machines
}

/// Distance from an end at which the point is reached on the one side and not on the other.
const SHARP: f64 = 2e-9;

/// An end is where a margin is zero, and names that margin's constraint.
fn ends_hold(machine: &Machine, point: [f64; 3], asked: &DexterityRequest, interval: &InclinationInterval) {
    let [from, to] = interval.ends;
    for (end, sign, binding) in [(from, -1.0, interval.bindings[0]), (to, 1.0, interval.bindings[1])] {
        let beside = |step: f64| end + sign * step;
        let Some(binding) = binding else { continue };
        assert!(!reached(machine, point, beside(SHARP), asked), "{point:?} {interval:?}");
        if to - from > 4.0 * SHARP {
            assert!(reached(machine, point, beside(-SHARP), asked), "{point:?} {interval:?}");
        }
        if let Some(margins) = margins(machine, point, beside(1e-7), asked) {
            let worst = margins.worst(machine);
            assert_eq!(worst.constraint, binding.constraint, "{point:?} {interval:?}");
            if worst.constraint == Constraint::TableClearance {
                assert_eq!(worst.element, binding.element, "{point:?} {interval:?}");
            }
        }
    }
}

/// An inclination of a dense scan is in an interval exactly if every margin is kept.
#[test]
fn intervals_agree_with_a_dense_scan_of_phi1() {
    const SCAN: u32 = 720;
    let mut numbers = Random::new(0x6c07_8965);
    let (mut several, mut some, mut by_table) = (0, 0, 0);
    for machine in machines() {
        for (tool_length, table_clearance) in
            [(0.0, None), (150.0, None), (150.0, Some(20.0)), (40.0, Some(0.0))]
        {
            for _ in 0..25 {
                let (phi2, phi1) = (numbers.between(-3.0, 3.0), [-3.1, 3.1]);
                let tool_radius = numbers.between(-300.0, 300.0).max(0.0);
                let asked =
                    DexterityRequest { tool_length, table_clearance, tool_radius, phi2, phi1, cell: 1.0 };
                let point = [
                    numbers.between(-400.0, 400.0),
                    numbers.between(-700.0, 700.0),
                    numbers.between(-500.0, 900.0),
                ];
                let found = orientations(&machine, point, &asked).unwrap();
                assert!(found.windows(2).all(|pair| pair[0].ends[1] < pair[1].ends[0]));
                several += usize::from(found.len() > 1);
                some += usize::from(!found.is_empty());
                for interval in &found {
                    ends_hold(&machine, point, &asked, interval);
                    let table = |binding: Binding| binding.constraint == Constraint::TableClearance;
                    by_table += usize::from(interval.bindings.into_iter().flatten().any(table));
                }
                for n in 0..=SCAN {
                    let phi1 = phi1[0] + (phi1[1] - phi1[0]) * f64::from(n) / f64::from(SCAN);
                    let near = found.iter().flat_map(|i| i.ends).any(|end| (end - phi1).abs() < 1e-8);
                    let reached = reached(&machine, point, phi1, &asked);
                    assert!(
                        near || within(&found, phi1) == reached,
                        "{point:?} {phi1} {asked:?}: {reached} {found:?} {:?}",
                        machine.data()
                    );
                }
            }
        }
    }
    assert!(some > 300 && several > 20 && by_table > 50, "{several} and {by_table} of {some}");
}
