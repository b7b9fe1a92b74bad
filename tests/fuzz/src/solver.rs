//! Arbitrary numbers in every function of one posture or point: all answers are finite, and all postures satisfy the
//! equations.

use std::f64::consts::PI;

use verne_solver::workspace::dexterity::DexterityRequest;
use verne_solver::workspace::{Kind, Request, Unobserved, contains, dexterity};
use verne_solver::{
    KinematicsError, MAX_INPUT, Machine, Margins, PartPose, Posture, TableAngles, axis, forward,
    forward_working, jacobian, part, part_pose, part_working, platform, platform_working, table_angles, tool,
    tool_point, tool_working,
};

use crate::draw::Draw;
use crate::lengths::scale;
use crate::machines::machine;

/// Functions of one posture or point.
pub(crate) fn solver(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let Some(machine) = machine(&mut draw) else { return };
    let unit = scale(&machine);
    let [x, y, z] = [0; 3].map(|_| draw.number(unit));
    let length = draw.number(0.2 * unit);
    let [phi1, phi2] = [0; 2].map(|_| draw.number(2.0));
    let (short, long) = ([x, y, z], [x, y, z, length, phi1, phi2]);
    let target = PartPose { x, y, z, phi1, phi2 };
    let many = |answer: Result<verne_solver::Postures, KinematicsError>| {
        answer.map(|found| found.into_iter().collect())
    };
    let one = |answer: Result<Posture, KinematicsError>| answer.map(|found| vec![found]);
    match draw.below(10) {
        0 => check(&machine, &short, &many(forward(&machine, short))),
        1 => check(&machine, &short, &one(forward_working(&machine, short))),
        2 => check(&machine, &short, &many(platform(&machine, short))),
        3 => check(&machine, &short, &one(platform_working(&machine, short))),
        4 => check(&machine, &long[..4], &many(tool(&machine, short, length))),
        5 => check(&machine, &long[..4], &one(tool_working(&machine, short, length))),
        6 => check(&machine, &long, &many(part(&machine, &target, length))),
        7 => check(&machine, &long, &one(part_working(&machine, &target, length))),
        8 => membership(&machine, &mut draw, short, &long),
        _ => orientation(&machine, &mut draw, short, &long),
    }
}

fn is_in_domain(numbers: &[f64]) -> bool {
    numbers.iter().all(|n| n.abs() <= MAX_INPUT)
}

/// Checks what the solver's documentation promises.
fn check(machine: &Machine, question: &[f64], answer: &Result<Vec<Posture>, KinematicsError>) {
    let inside = is_in_domain(question);
    let sound = match answer {
        Ok(postures) => inside && !postures.is_empty(),
        Err(KinematicsError::OutOfDomain) => !inside,
        Err(KinematicsError::Unreachable(margin)) => {
            inside && margin.value <= 0.0 && margin.value.is_finite()
        }
        Err(KinematicsError::SelfMotion | KinematicsError::OutOfProportion) => inside,
    };
    assert!(sound, "{answer:?}");
    for posture in answer.iter().flatten() {
        satisfies(machine, posture, question);
        margins(machine, posture, question);
        conditioning(machine, posture);
    }
}

/// Eqs (3)-(6), written out independently of the solver.
fn residual(machine: &Machine, posture: &Posture) -> f64 {
    let g = &machine.data().geometry;
    let (p, [rho1, rho2, rho3]) = (posture.pose, posture.rho);
    let (s, c) = p.alpha.sin_cos();
    let rod = |x: f64, y: f64, z: f64, length: f64| {
        ((x * x + y * y + (z - length) * (z + length)) / (2.0 * length)).abs()
    };
    let (first, second) = (p.x + g.D1 - g.d1, p.x + g.D2 - g.d2);
    let (u, v) = (g.R1 * c - g.r1, g.R1 * s);
    let (arm, rise) = (g.R2 * c - g.r4, g.R2 * s);
    [
        rod(first, p.y + u, p.z + v - rho1, g.L1),
        rod(first, p.y - u, p.z - v - rho1, g.L1),
        rod(second, p.y - arm, p.z - rise - rho2, g.L2),
        rod(second, p.y + arm, p.z + rise - rho3, g.L3),
    ]
    .into_iter()
    .fold(0.0, f64::max)
}

fn satisfies(machine: &Machine, posture: &Posture, question: &[f64]) {
    let p = &posture.pose;
    let all = [p.x, p.y, p.z, p.alpha, posture.rho[0], posture.rho[1], posture.rho[2], posture.residual];
    assert!(all.iter().all(|n| n.is_finite()), "{posture:?}");
    assert!(p.alpha > -PI && p.alpha <= PI, "{posture:?}");
    // Far from the origin, or on a long tool, the numbers themselves have no more digits.
    let largest = all.iter().chain(question).fold(0.0_f64, |most, n| most.max(n.abs()));
    let allowed = 9e-13 * scale(machine) + 4.0 * f64::EPSILON * largest;
    let truly = residual(machine, posture);
    assert!(truly <= allowed && (posture.residual - truly).abs() <= allowed, "{truly} {posture:?}");
}

fn margins(machine: &Machine, posture: &Posture, question: &[f64]) {
    let [phi1, phi2] = if let [.., phi1, phi2] = *question
        && question.len() > 4
    {
        [phi1, phi2]
    } else {
        [0.0; 2]
    };
    let table = table_angles(machine, posture.pose.alpha, phi1, phi2);
    for table in [None, Some(table)] {
        let margins = Margins::of(machine, posture, table);
        let (worst, feasible) = (margins.worst(machine), margins.feasible());
        assert!(worst.value.is_finite(), "{worst:?}");
        // Margins of the order of the least doubles lose their sign when they are weighed.
        assert!((worst.value >= 0.0) == feasible || worst.value.abs() < 1e-300, "{worst:?} {margins:?}");
        finite(margins.stroke.as_flattened());
        finite(&margins.leg_length);
        finite(&margins.serial_singularity);
        finite(&margins.slider_joint);
        finite(&margins.platform_joint);
        finite(&[margins.parallel_singularity, margins.rod_interference]);
        finite(margins.rod_crossing.as_slice());
        margins.tilt.iter().chain(&margins.rotary).for_each(|ends| finite(ends));
    }
    let TableAngles { theta1, theta2 } = table;
    finite(&[theta1, theta2]);
    let tool = if question.len() > 3 { question[3] } else { 0.0 };
    finite(&tool_point(&posture.pose, tool));
    let part = part_pose(machine, &posture.pose, table, tool);
    finite(&[part.x, part.y, part.z, part.phi1, part.phi2]);
}

fn conditioning(machine: &Machine, posture: &Posture) {
    finite(jacobian::parallel_matrix(machine, posture).as_flattened());
    let conditioning = jacobian::conditioning(machine, posture);
    finite(&[conditioning.det]);
    finite(&conditioning.serial);
    assert!(
        conditioning.condition_number.is_none_or(|number| number >= 1.0 && number.is_finite()),
        "{conditioning:?}"
    );
    if let Some(rates) = jacobian::velocities(machine, posture) {
        finite(rates.as_flattened());
    }
}

fn finite(numbers: &[f64]) {
    assert!(numbers.iter().all(|n| n.is_finite()), "{numbers:?}");
}

fn membership(machine: &Machine, draw: &mut Draw<'_>, point: [f64; 3], numbers: &[f64; 6]) {
    let kind = draw.pick(&[Kind::Platform, Kind::Tool, Kind::Part]);
    let [_, _, _, tool_length, phi1, phi2] = *numbers;
    let (table_clearance, tool_radius) = clearance(machine, draw);
    let request = Request { kind, tool_length, phi1, phi2, table_clearance, tool_radius, tolerance: 1.0 };
    let points = [point, [0; 3].map(|_| draw.number(scale(machine))), [0.0; 3]];
    match contains(machine, &request, &points, &Unobserved) {
        Ok(members) => {
            assert_eq!(members.len(), points.len());
            for member in members {
                let inside = member.margin.is_some_and(|margin| margin.value >= 0.0);
                assert!(member.margin.is_none_or(|margin| margin.value.is_finite()), "{member:?}");
                assert!(!member.inside || inside, "{member:?}");
            }
        }
        Err(error) => {
            let all = [tool_length, phi1, phi2, table_clearance.unwrap_or_default(), tool_radius];
            assert!(!is_in_domain(&all), "{error}");
        }
    }
}

/// An optional table clearance, and a tool radius.
pub(crate) fn clearance(machine: &Machine, draw: &mut Draw<'_>) -> (Option<f64>, f64) {
    let unit = 0.2 * scale(machine);
    (draw.one_in(2).then(|| draw.number(unit)), draw.number(unit))
}

fn orientation(machine: &Machine, draw: &mut Draw<'_>, point: [f64; 3], numbers: &[f64; 6]) {
    let [_, _, _, tool_length, from, phi2] = *numbers;
    let range = [from, from + draw.between(0.0, 6.2)];
    let (table_clearance, tool_radius) = clearance(machine, draw);
    let asked = DexterityRequest { tool_length, table_clearance, tool_radius, phi2, phi1: range, cell: 1.0 };
    if let Ok(intervals) = dexterity::orientations(machine, point, &asked) {
        let mut last = range[0];
        for interval in intervals {
            let [from, to] = interval.ends;
            assert!(last <= from && from <= to && to <= range[1], "{interval:?} of {range:?}");
            last = to;
        }
    }
    let direction = [numbers[0], numbers[1], numbers[2]];
    match axis::preimages(direction) {
        Some(axis::Preimages::Two(both)) => finite(both.as_flattened()),
        Some(axis::Preimages::Free { phi1 }) => assert!(phi1 == 0.0 || phi1 == PI),
        None => assert!(direction.iter().any(|n| !n.is_finite()) || direction.iter().all(|n| *n == 0.0)),
    }
}
