//! Sliders in a line with legs II and III alike: rho2 = rho3, or rho1 half-way between rho2 and
//! rho3. There the elimination is 0/0 at the very angles that solve it, and near there two roots of
//! the eliminated equation are closer than its coefficients can tell.

use verne_solver::{Machine, MachineData, Posture, forward, forward_working};

use crate::lengths::scale;
use crate::oracle::{self, Comparison};
use crate::random::Random;

/// Distances from exact symmetry, mm on a metre.
const OFFSETS: [f64; 13] = [0.0, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];

fn with_legs_alike(machine: &Machine) -> Machine {
    let mut data: MachineData = machine.data().clone();
    data.geometry.L3 = data.geometry.L2;
    Machine::new(data).unwrap_or_else(|_| Machine::verne())
}

fn check(machine: &Machine, rho: [f64; 3], comparison: &mut Comparison) -> Vec<Posture> {
    let all = forward(machine, rho);
    let answer = oracle::forward(machine, rho);
    comparison.of(&format!("rho {rho:?}"), machine, &answer, &all);
    comparison.of_working(&format!("rho {rho:?}"), machine, &answer, &forward_working(machine, rho));
    all.unwrap_or_default().into_iter().collect()
}

#[test]
fn all_modes_are_found_at_rho2_near_rho3() {
    let (machine, mut draw, mut comparison) = (Machine::verne(), Random::new(51), Comparison::default());
    for _ in 0..40 {
        let [rho1, rho2] = [draw.between(0.0, 750.0), draw.between(0.0, 750.0)];
        for offset in OFFSETS.into_iter().flat_map(|offset| [offset, -offset]) {
            let rho = [rho1, rho2, rho2 + offset];
            let all = check(&machine, rho, &mut comparison);
            let working: Vec<_> = all.iter().filter(|posture| posture.working).collect();
            if let [one] = working[..] {
                let alone = forward_working(&machine, rho).unwrap();
                assert!((alone.pose.x - one.pose.x).abs() < 1e-9 && alone.working, "rho {rho:?}: {alone:?}");
                let plane = (rho[2] - rho[1]).abs();
                assert!(one.pose.y.abs() <= 3.0 * plane + 1e-12, "rho {rho:?}: {one:?}");
            } else {
                assert!((rho1 - rho2).abs() > 250.0, "rho {rho:?}: {working:#?}");
            }
        }
    }
    comparison.conclude(5, 3 * comparison.tally.compared);
}

#[test]
fn all_modes_are_found_at_level_sliders() {
    let (machine, mut comparison) = (Machine::verne(), Comparison::default());
    for level in [0.0, 300.0, 712.25] {
        for offset in OFFSETS {
            for rho in [
                [level, level + offset, level],
                [level, level, level + offset],
                [level + offset, level, level],
                [level, level + offset, level - offset],
                [level, level + offset, level + offset],
            ] {
                let all = check(&machine, rho, &mut comparison);
                assert_eq!(all.iter().filter(|posture| posture.working).count(), 1, "rho {rho:?}: {all:#?}");
                assert!(forward_working(&machine, rho).is_ok(), "rho {rho:?}");
            }
        }
    }
    comparison.conclude(0, 4 * comparison.tally.compared);
}

#[test]
fn all_modes_are_found_at_rho1_half_way_between_rho2_and_rho3() {
    let (machine, mut draw, mut comparison) = (Machine::verne(), Random::new(52), Comparison::default());
    let random =
        (0..60).map(|_| [draw.between(-200.0, 900.0), draw.between(-900.0, 900.0)]).collect::<Vec<_>>();
    for [middle, apart] in
        [[500.0, 100.0], [500.0, -100.0], [500.0, 400.0], [0.0, 700.0]].into_iter().chain(random)
    {
        for offset in OFFSETS.into_iter().flat_map(|offset| [offset, -offset]) {
            check(&machine, [middle + offset / 2.0, middle - apart, middle + apart], &mut comparison);
        }
    }
    comparison.conclude(15, 2 * comparison.tally.compared);
}

#[test]
fn the_exact_middle_has_two_modes_with_parallel_rods() {
    // S = N = 0 leaves D(alpha) = 0 or y = z - rho1 = 0: at the working angle both roots of leg I.
    let machine = Machine::verne();
    let all = forward(&machine, [500.0, 400.0, 600.0]).unwrap();
    let working = all.iter().find(|posture| posture.working).expect("a reachable joint vector");
    let twin = all.iter().filter(|posture| (posture.pose.alpha - working.pose.alpha).abs() < 1e-12).count();
    assert_eq!(twin, 2, "{all:#?}");
}

#[test]
fn all_modes_of_random_machines_are_found_near_either_symmetry() {
    let (mut draw, mut comparison) = (Random::new(53), Comparison::default());
    for _ in 0..3000 {
        let machine = with_legs_alike(&draw.machine());
        let [rho1, rho2, rho3] = draw.rho(&machine);
        let offset = draw.pick(&OFFSETS) * scale(&machine) / 1000.0;
        let half_way = f64::midpoint(rho2, rho3) + offset;
        let rho = if draw.one_in(2) { [rho1, rho2, rho2 + offset] } else { [half_way, rho2, rho3] };
        check(&machine, rho, &mut comparison);
    }
    comparison.conclude(30, 2 * comparison.tally.compared);
}

#[test]
fn all_modes_are_found_at_any_distance_from_either_symmetry() {
    let (machine, mut draw, mut comparison) = (Machine::verne(), Random::new(54), Comparison::default());
    for _ in 0..4000 {
        let [rho1, rho2, rho3] = [0; 3].map(|_| draw.between(0.0, 750.0));
        let offset = draw.magnitude(1e-6, 10.0) * draw.pick(&[1.0, -1.0]);
        let half_way = f64::midpoint(rho2, rho3) + offset;
        let rho = if draw.one_in(2) { [rho1, rho2, rho2 + offset] } else { [half_way, rho2, rho3] };
        check(&machine, rho, &mut comparison);
    }
    comparison.conclude(10, 3 * comparison.tally.compared);
}

#[test]
fn forward_solutions_are_continuous_across_the_plane() {
    // The working posture moves through the plane without a jump: y is odd in rho3 - rho2.
    let machine = Machine::verne();
    for offset in OFFSETS.into_iter().skip(1) {
        let [plus, minus] =
            [offset, -offset].map(|d| forward_working(&machine, [310.0, 290.0, 290.0 + d]).unwrap().pose);
        let exact = forward_working(&machine, [310.0, 290.0, 290.0]).unwrap().pose;
        assert!(exact.y.abs() < 1e-12, "{exact:?}");
        assert!((plus.y + minus.y).abs() < 1e-9 + 0.01 * offset, "{offset:e}: {plus:?} {minus:?}");
        assert!(plus.y * minus.y <= 0.0 && (plus.x - exact.x).abs() < 1e-9 + offset, "{offset:e}: {plus:?}");
    }
}
