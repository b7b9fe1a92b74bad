//! Forward of inverse and inverse of forward return the input, in every frame.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector4;
use verne_solver::{
    Machine, PartPose, Posture, TableAngles, forward, part, part_pose, platform, table_angles, tool,
    tool_point,
};

use crate::lengths::scale;
use crate::oracle::{Legs, listed};
use crate::random::Random;

/// The posture is among the answers, as exactly as its distance from singularities lets double
/// precision tell.
fn assert_among(question: &str, machine: &Machine, wanted: &Posture, answers: &[Posture]) {
    let legs = Legs::of(machine);
    let q = Vector4::new(wanted.pose.x, wanted.pose.y, wanted.pose.z, wanted.pose.alpha);
    let forward = 1.0 / legs.rates(&q, &wanted.rho).singular_values()[3];
    let inverse = [11, 12, 21, 31].map(|rod| legs.length(rod) / legs.rod(rod, &q, &wanted.rho).z.abs());
    let amplification = inverse.into_iter().fold(forward, f64::max) * scale(machine) / legs.g.R1;
    if amplification > 1e6 {
        return; // merged with another, as far as the round trip can tell
    }
    let allowed = scale(machine) * 1e-12 * amplification.max(1.0);
    let nearest =
        answers.iter().map(|answer| distance(machine, wanted, answer)).fold(f64::INFINITY, f64::min);
    assert!(
        nearest < allowed,
        "{question}: {nearest:e} mm off, {allowed:e} allowed: {wanted:?} in\n{}{:?}",
        listed(answers),
        machine.data().geometry
    );
}

fn turned(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

fn distance(machine: &Machine, a: &Posture, b: &Posture) -> f64 {
    let lever = machine.data().geometry.R1 * turned(a.pose.alpha - b.pose.alpha);
    let sliders = (0..3).map(|i| a.rho[i] - b.rho[i]);
    [a.pose.x - b.pose.x, a.pose.y - b.pose.y, a.pose.z - b.pose.z, lever]
        .into_iter()
        .chain(sliders)
        .fold(0.0, |most, d| d.abs().max(most))
}

#[test]
fn forward_finds_every_posture_of_a_platform_position() {
    let (mut draw, mut postures) = (Random::new(31), 0);
    for _ in 0..2000 {
        let machine = draw.any_machine();
        let p = draw.point(&machine);
        for posture in platform(&machine, p).into_iter().flatten() {
            assert_eq!([posture.pose.x, posture.pose.y, posture.pose.z], p);
            let modes = forward(&machine, posture.rho).unwrap_or_default();
            assert_among(&format!("p {p:?}"), &machine, &posture, &modes);
            postures += 1;
        }
    }
    assert!(postures > 8000, "{postures}");
}

#[test]
fn inverse_problems_find_every_assembly_mode() {
    let (mut draw, mut postures) = (Random::new(32), 0);
    for _ in 0..3000 {
        let machine = draw.any_machine();
        let rho = draw.rho(&machine);
        for mode in forward(&machine, rho).into_iter().flatten() {
            let question = format!("rho {rho:?}");
            assert_eq!(mode.rho, rho);
            let pose = &mode.pose;
            let answers = platform(&machine, [pose.x, pose.y, pose.z]).unwrap_or_default();
            assert_among(&question, &machine, &mode, &answers);

            let length = draw.tool_length(&machine);
            let answers = tool(&machine, tool_point(pose, length), length).unwrap_or_default();
            assert_among(&format!("{question} tool {length:?}"), &machine, &mode, &answers);

            let [theta1, theta2] = [draw.between(-PI, PI), draw.between(-PI, PI)];
            let target = part_pose(&machine, pose, TableAngles { theta1, theta2 }, length);
            let answers = part(&machine, &target, length).unwrap_or_default();
            assert_among(&format!("{question} {target:?} tool {length:?}"), &machine, &mode, &answers);
            postures += 1;
        }
    }
    assert!(postures > 4000, "{postures}");
}

#[test]
fn every_posture_of_a_tool_position_has_its_tool_end_there() {
    let (mut draw, mut postures) = (Random::new(33), 0);
    for _ in 0..3000 {
        let machine = draw.any_machine();
        let (u, length) = (draw.point(&machine), draw.tool_length(&machine));
        for posture in tool(&machine, u, length).into_iter().flatten() {
            let tip = tool_point(&posture.pose, length);
            let off = (0..3).map(|i| (tip[i] - u[i]).abs()).fold(0.0, f64::max);
            assert!(
                off < 1e-12 * scale(&machine),
                "u {u:?} tool {length:?}: {posture:?} holds it at {tip:?}"
            );
            postures += 1;
        }
    }
    assert!(postures > 8000, "{postures}");
}

#[test]
fn every_posture_of_a_part_pose_has_its_tool_end_there() {
    let (mut draw, mut postures) = (Random::new(34), 0);
    for _ in 0..3000 {
        let machine = draw.any_machine();
        let length = draw.tool_length(&machine);
        let target = draw.part_pose(&machine, length);
        for posture in part(&machine, &target, length).into_iter().flatten() {
            let table = table_angles(&machine, posture.pose.alpha, target.phi1, target.phi2);
            let held = part_pose(&machine, &posture.pose, table, length);
            assert_same_tool(&machine, &held, &target);
            postures += 1;
        }
    }
    assert!(postures > 8000, "{postures}");
}

fn assert_same_tool(machine: &Machine, held: &PartPose, target: &PartPose) {
    let lengths = [held.x - target.x, held.y - target.y, held.z - target.z];
    let angles = [turned(held.phi1 - target.phi1), turned(held.phi2 - target.phi2)];
    // The table stands up to two machine lengths away, and its angles carry it around.
    let near =
        lengths.iter().all(|d| d.abs() < 4e-12 * scale(machine)) && angles.iter().all(|d| d.abs() < 4e-12);
    assert!(near, "{held:?} is not {target:?}");
}
