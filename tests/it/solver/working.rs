//! The working mode by itself is the working one among all.

use verne_solver::{
    Machine, Posture, Postures, Refusal, forward, forward_working, part, part_working, platform,
    platform_working, tool, tool_working,
};

use crate::machines::{Draw, scale};

/// Largest difference of a coordinate, alpha on the machine's scale.
fn distance(machine: &Machine, a: &Posture, b: &Posture) -> f64 {
    let turn = scale(machine) * (a.pose.alpha - b.pose.alpha);
    let sliders = (0..3).map(|i| a.rho[i] - b.rho[i]);
    [a.pose.x - b.pose.x, a.pose.y - b.pose.y, a.pose.z - b.pose.z, turn]
        .into_iter()
        .chain(sliders)
        .fold(0.0, |most, d| d.abs().max(most))
}

/// How many working postures there are among all; the one returned must be one of them.
fn check(
    question: &str,
    machine: &Machine,
    all: Result<Postures, Refusal>,
    one: Result<Posture, Refusal>,
) -> usize {
    let working: Vec<Posture> = all.into_iter().flatten().filter(|posture| posture.working).collect();
    match one {
        Ok(posture) => {
            assert!(posture.working, "{question}: {posture:?}");
            let nearest =
                working.iter().map(|w| distance(machine, w, &posture)).fold(f64::INFINITY, f64::min);
            // Both are exact to rounding unless a singularity is near; a different mode is far away.
            assert!(nearest < 1e-8 * scale(machine), "{question}: {posture:?} not among {working:?}");
        }
        Err(Refusal::Blocked(margin)) => {
            assert!(working.is_empty(), "{question}: refused for {margin:?}, but {working:?}");
            assert!(margin.value < 0.0, "{question}: {margin:?}");
        }
        Err(other) => panic!("{question}: {other:?}"),
    }
    working.len()
}

#[test]
fn of_sliders() {
    let (mut draw, mut found, mut none) = (Draw::seeded(21), 0, 0);
    for _ in 0..20_000 {
        let machine = draw.any_machine();
        let rho = draw.rho(&machine);
        let working =
            check(&format!("rho {rho:?}"), &machine, forward(&machine, rho), forward_working(&machine, rho));
        if working == 0 { none += 1 } else { found += 1 }
    }
    assert!(found > 2000 && none > 2000, "{found} with and {none} without a working mode");
}

#[test]
fn of_platform_positions() {
    let (mut draw, mut counts) = (Draw::seeded(22), [0; 2]);
    for _ in 0..20_000 {
        let machine = draw.any_machine();
        let p = draw.point(&machine);
        let working =
            check(&format!("p {p:?}"), &machine, platform(&machine, p), platform_working(&machine, p));
        // At most one: section III.C of the paper.
        counts[working] += 1;
    }
    assert!(counts.iter().all(|&count| count > 2000), "{counts:?}");
}

#[test]
fn of_tool_positions() {
    let (mut draw, mut found, mut none) = (Draw::seeded(23), 0, 0);
    for _ in 0..20_000 {
        let machine = draw.any_machine();
        let (u, length) = (draw.point(&machine), draw.tool_length(&machine));
        let question = format!("u {u:?} tool {length:?} {:?}", machine.data());
        let working =
            check(&question, &machine, tool(&machine, u, length), tool_working(&machine, u, length));
        if working == 0 { none += 1 } else { found += 1 }
    }
    assert!(found > 2000 && none > 2000, "{found} with and {none} without a working mode");
}

#[test]
fn of_part_poses() {
    let (mut draw, mut found, mut none) = (Draw::seeded(24), 0, 0);
    for _ in 0..20_000 {
        let machine = draw.any_machine();
        let length = draw.tool_length(&machine);
        let target = draw.part_pose(&machine, length);
        let question = format!("{target:?} tool {length:?} {:?}", machine.data());
        let all = part(&machine, &target, length);
        let working = check(&question, &machine, all, part_working(&machine, &target, length));
        if working == 0 { none += 1 } else { found += 1 }
    }
    assert!(found > 2000 && none > 2000, "{found} with and {none} without a working mode");
}
