//! Numbers and coordinates of solutions against the brute-force oracle, on thousands of random requests.

use verne_solver::{Machine, forward, part, platform, tool};

use crate::oracle::{self, Comparison, Path};
use crate::random::Random;

/// Few comparisons are lenient, and the questions reach from none to the most solutions there are.
fn conclude(comparison: &Comparison, most: usize) {
    let tally = &comparison.tally;
    comparison.conclude(tally.compared / 200, 2 * tally.compared);
    assert!(tally.most >= most && tally.empty > 0, "{tally:?}");
}

#[test]
fn assembly_modes_of_the_reference_machine_agree_with_the_oracle() {
    let (machine, mut draw, mut comparison) = (Machine::verne(), Random::new(11), Comparison::default());
    for _ in 0..3000 {
        let rho = draw.rho(&machine);
        let question = format!("rho {rho:?}");
        comparison.of(&question, &machine, &oracle::forward(&machine, rho), &forward(&machine, rho));
    }
    conclude(&comparison, 6);
}

#[test]
fn assembly_modes_within_the_strokes_agree_with_the_oracle() {
    let (machine, mut draw, mut comparison) = (Machine::verne(), Random::new(12), Comparison::default());
    for _ in 0..2000 {
        let rho = [0, 1, 2].map(|i| {
            let [low, high] = machine.data().limits.stroke[i];
            draw.between(low, high)
        });
        let question = format!("rho {rho:?}");
        comparison.of(&question, &machine, &oracle::forward(&machine, rho), &forward(&machine, rho));
    }
    comparison.conclude(10, 4 * 2000);
    assert_eq!(comparison.tally.empty, 0);
}

#[test]
fn assembly_modes_of_random_machines_agree_with_the_oracle() {
    let (mut draw, mut comparison) = (Random::new(13), Comparison::default());
    for _ in 0..5000 {
        let machine = draw.machine();
        let rho = draw.rho(&machine);
        let question = format!("rho {rho:?}");
        comparison.of(&question, &machine, &oracle::forward(&machine, rho), &forward(&machine, rho));
    }
    conclude(&comparison, 8);
}

#[test]
fn postures_at_platform_positions_agree_with_the_oracle() {
    let (mut draw, mut comparison) = (Random::new(14), Comparison::default());
    for _ in 0..5000 {
        let machine = draw.any_machine();
        let p = draw.point(&machine);
        let answer = oracle::inverse(&machine, &Path::platform(p));
        comparison.of(&format!("p {p:?}"), &machine, &answer, &platform(&machine, p));
    }
    conclude(&comparison, 16);
}

#[test]
fn postures_at_tool_positions_agree_with_the_oracle() {
    let (mut draw, mut comparison) = (Random::new(15), Comparison::default());
    for _ in 0..5000 {
        let machine = draw.any_machine();
        let (u, tool_length) = (draw.point(&machine), draw.tool_length(&machine));
        let answer = oracle::inverse(&machine, &Path::tool(u, tool_length));
        let question = format!("u {u:?} tool {tool_length:?}");
        comparison.of(&question, &machine, &answer, &tool(&machine, u, tool_length));
    }
    conclude(&comparison, 16);
}

#[test]
fn postures_at_part_poses_agree_with_the_oracle() {
    let (mut draw, mut comparison) = (Random::new(16), Comparison::default());
    for _ in 0..5000 {
        let machine = draw.any_machine();
        let tool_length = draw.tool_length(&machine);
        let target = draw.part_pose(&machine, tool_length);
        let answer = oracle::inverse(&machine, &Path::part(&machine, &target, tool_length));
        let question = format!("{target:?} tool {tool_length:?}");
        comparison.of(&question, &machine, &answer, &part(&machine, &target, tool_length));
    }
    conclude(&comparison, 24);
}
