//! The functions that return the working mode alone, against those that return all modes.

use verne_solver::{
    KinematicsError, Posture, Postures, forward, forward_working, part, part_working, platform,
    platform_working, tool, tool_working,
};

use crate::random::Random;

/// How many working postures there are among all; the one returned must be one of them, to the last
/// bit.
fn check(
    question: &str,
    all: Result<Postures, KinematicsError>,
    one: Result<Posture, KinematicsError>,
) -> usize {
    let working: Vec<Posture> = all.into_iter().flatten().filter(|posture| posture.working).collect();
    match one {
        Ok(posture) => {
            assert!(posture.working, "{question}: {posture:?}");
            assert!(working.contains(&posture), "{question}: {posture:?} not among {working:?}");
        }
        Err(KinematicsError::Unreachable(margin)) => {
            assert!(working.is_empty(), "{question}: refused for {margin:?}, but {working:?}");
            assert!(margin.value < 0.0, "{question}: {margin:?}");
        }
        Err(other) => panic!("{question}: {other:?}"),
    }
    working.len()
}

#[test]
fn forward_working_returns_the_working_assembly_mode() {
    let (mut draw, mut found, mut none) = (Random::new(21), 0, 0);
    for _ in 0..20_000 {
        let machine = draw.any_machine();
        let rho = draw.rho(&machine);
        let working = check(&format!("rho {rho:?}"), forward(&machine, rho), forward_working(&machine, rho));
        if working == 0 { none += 1 } else { found += 1 }
    }
    assert!(found > 2000 && none > 2000, "{found} with and {none} without a working mode");
}

#[test]
fn platform_working_returns_the_working_posture() {
    let (mut draw, mut counts) = (Random::new(22), [0; 2]);
    for _ in 0..20_000 {
        let machine = draw.any_machine();
        let p = draw.point(&machine);
        let working = check(&format!("p {p:?}"), platform(&machine, p), platform_working(&machine, p));
        // At most one: section III.C of the paper.
        counts[working] += 1;
    }
    assert!(counts.iter().all(|&count| count > 2000), "{counts:?}");
}

#[test]
fn tool_working_returns_a_working_posture() {
    let (mut draw, mut found, mut none) = (Random::new(23), 0, 0);
    for _ in 0..20_000 {
        let machine = draw.any_machine();
        let (u, length) = (draw.point(&machine), draw.tool_length(&machine));
        let question = format!("u {u:?} tool {length:?} {:?}", machine.data());
        let working = check(&question, tool(&machine, u, length), tool_working(&machine, u, length));
        if working == 0 { none += 1 } else { found += 1 }
    }
    assert!(found > 2000 && none > 2000, "{found} with and {none} without a working mode");
}

#[test]
fn part_working_returns_a_working_posture() {
    let (mut draw, mut found, mut none) = (Random::new(24), 0, 0);
    for _ in 0..20_000 {
        let machine = draw.any_machine();
        let length = draw.tool_length(&machine);
        let target = draw.part_pose(&machine, length);
        let question = format!("{target:?} tool {length:?} {:?}", machine.data());
        let all = part(&machine, &target, length);
        let working = check(&question, all, part_working(&machine, &target, length));
        if working == 0 { none += 1 } else { found += 1 }
    }
    assert!(found > 2000 && none > 2000, "{found} with and {none} without a working mode");
}
