//! Tools and parts that several postures of the working mode reach: a table far above the platform, a long tool.

use std::f64::consts::PI;

use verne_solver::machine::{Geometry, Table};
use verne_solver::workspace::{Kind, Request, Unobserved, contains};
use verne_solver::{
    KinematicsError, Machine, Margins, PartPose, Posture, Postures, TableAngles, part, part_every_working,
    part_pose, part_working, platform_working, table_angles, tool, tool_every_working, tool_working,
};

use crate::lengths::scale;
use crate::random::Random;

/// A machine whose table is above the platform, of any size and slightly varied. Its cones exclude
/// the middle of the platform's domain.
fn machine(draw: &mut Random) -> Machine {
    let mut data = Machine::verne().data().clone();
    let size = draw.magnitude(0.01, 10.0);
    let mut length = |length: f64| length * size * draw.between(0.995, 1.005);
    data.geometry = Geometry {
        D1: 0.0,
        d1: length(500.0),
        D2: 0.0,
        d2: length(-500.0),
        R1: length(275.0),
        r1: length(75.0),
        R2: length(50.0),
        r4: length(50.0),
        L1: length(1050.0),
        L2: length(707.2),
        L3: length(707.2),
        parallelogram_half_width: length(20.0),
        parallelogram_direction: 0.0,
        rod_radius: 0.0,
    };
    data.table = Table { da: length(-760.0), dt: length(200.0) };
    let limits = &mut data.limits;
    let strokes = [[-2000.0, 2000.0], [-100.0, 500.0], [-100.0, 500.0]];
    limits.stroke = strokes.map(|stroke| stroke.map(&mut length));
    (limits.slider_cone, limits.platform_cone) = (65_f64.to_radians(), PI);
    (limits.serial_margin, limits.parallel_margin) = (0.2, 0.0);
    let (side, aslant) = ([-1.0, 0.0, 0.0], [0.7, 0.0, 0.7]);
    limits.slider_axes = Some([side, side, aslant, aslant]);
    Machine::new(data).expect("legs that reach at home")
}

fn sorted(mut postures: Vec<Posture>) -> Vec<Posture> {
    postures.sort_by(|a, b| a.pose.alpha.total_cmp(&b.pose.alpha));
    postures
}

/// Every working posture among all, each to the last bit.
fn check(
    question: &str,
    all: Result<Postures, KinematicsError>,
    every: Result<Postures, KinematicsError>,
    one: Result<Posture, KinematicsError>,
) -> Vec<Posture> {
    let among_all = all.into_iter().flatten().filter(|posture| posture.working).collect();
    let working: Vec<Posture> = every.into_iter().flatten().collect();
    assert_eq!(one.ok().as_ref(), working.first(), "{question}");
    assert_eq!(sorted(working.clone()), sorted(among_all), "{question}");
    working
}

/// The pose that the tool has at a platform position of the working mode.
fn target(draw: &mut Random, machine: &Machine, tool_length: f64) -> Option<PartPose> {
    let size = machine.data().geometry.d1;
    let p = [-0.8, -0.5, 0.0].map(|least| size * draw.between(least, 0.5 - least.abs() + 1.0));
    let pose = platform_working(machine, p).ok()?.pose;
    let table = TableAngles { theta1: pose.alpha, theta2: 0.0 };
    Some(PartPose { phi1: 0.0, phi2: 0.0, ..part_pose(machine, &pose, table, tool_length) })
}

#[test]
fn a_point_is_inside_if_any_working_posture_is_feasible() {
    let (mut draw, mut several, mut not_the_first) = (Random::new(181), 0, 0);
    for _ in 0..20_000 {
        let machine = machine(&mut draw);
        let tool_length = draw.tool_length(&machine);
        let Some(target) = target(&mut draw, &machine, tool_length) else { continue };
        let PartPose { x, y, z, phi1, phi2 } = target;
        let working = check(
            &format!("{target:?} {tool_length}"),
            part(&machine, &target, tool_length),
            part_every_working(&machine, &target, tool_length),
            part_working(&machine, &target, tool_length),
        );
        let feasible = working.iter().map(|posture| {
            let table = table_angles(&machine, posture.pose.alpha, phi1, phi2);
            Margins::of(&machine, posture, Some(table)).feasible()
        });
        let feasible: Vec<bool> = feasible.collect();
        let request = Request {
            kind: Kind::Part,
            tool_length,
            table_clearance: None,
            tool_radius: 0.0,
            phi1,
            phi2,
            tolerance: 1.0,
        };
        let member = contains(&machine, &request, &[[x, y, z]], &Unobserved).unwrap()[0];
        assert_eq!(member.inside, feasible.contains(&true), "{target:?} {feasible:?} {member:?}");
        assert!(member.margin.is_none_or(|margin| (margin.value >= 0.0) == member.inside), "{member:?}");
        several += usize::from(working.len() > 1);
        not_the_first += usize::from(feasible.first() == Some(&false) && member.inside);
    }
    assert!(several > 50 && not_the_first > 5, "{several} {not_the_first}");
}

#[test]
fn every_working_posture_of_a_long_tool_is_found() {
    let mut draw = Random::new(182);
    for _ in 0..5000 {
        let machine = draw.any_machine();
        let (u, length) = (draw.point(&machine), -scale(&machine) * draw.magnitude(0.1, 5.0));
        let (all, every) = (tool(&machine, u, length), tool_every_working(&machine, u, length));
        check(&format!("{u:?} {length}"), all, every, tool_working(&machine, u, length));
    }
}
