//! Random programs on random machines.

use verne_solver::toolpath::{Curve, Motion, MotionKind, ToolPosition, Turning};
use verne_solver::{Machine, PartPose, part_working};

use super::random::Random;
use super::support::unit;

/// A machine away from the built-in one, of any size.
pub(crate) fn machine(random: &mut Random) -> Machine {
    loop {
        let mut data = Machine::verne().data().clone();
        let scale = random.between(0.5, 2.0);
        let g = &mut data.geometry;
        for length in [
            &mut g.D1, &mut g.d1, &mut g.D2, &mut g.d2, &mut g.R1, &mut g.r1, &mut g.R2, &mut g.r4,
            &mut g.L1, &mut g.L2, &mut g.L3,
        ] {
            *length *= scale * random.between(0.85, 1.15);
        }
        data.table.da *= scale;
        data.table.dt *= scale;
        data.limits.stroke = data.limits.stroke.map(|range| range.map(|end| end * scale));
        if let Ok(machine) = Machine::new(data) {
            return machine;
        }
    }
}

fn is_reached(machine: &Machine, at: &ToolPosition) -> bool {
    let ([x, y, z], [i, j, k]) = (at.tip, at.axis);
    let pose = PartPose { x, y, z, phi1: i.hypot(j).atan2(k), phi2: i.atan2(-j) };
    part_working(machine, &pose, 100.0).is_ok()
}

/// Lines, arcs and rapids that the machine can reach, away from the pole.
pub(crate) fn program(machine: &Machine, random: &mut Random) -> Vec<Motion> {
    let scale = machine.longest() / 1050.0;
    let mut program: Vec<Motion> = Vec::new();
    while program.len() < 7 {
        let before = program.last().map(|motion| motion.end);
        let near = before.map_or([0.0, 0.0, 300.0 * scale], |before| before.tip);
        let tip = near.map(|c| c + scale * random.between(-80.0, 80.0));
        let axis = unit([random.between(-0.3, 0.3), -random.between(0.1, 0.4), 1.0]);
        let end = ToolPosition { tip, axis };
        if !is_reached(machine, &end) {
            continue;
        }
        let kind = match program.len() {
            0 => MotionKind::Arrive,
            3 => MotionKind::Rapid,
            _ => MotionKind::Feed,
        };
        let curve = match before {
            Some(before) if program.len() == 5 => half_circle(before.tip, tip),
            _ => Curve::Line,
        };
        program.push(Motion { kind, end, curve, turning: Turning::GreatCircle, tool_length: 100.0 });
    }
    program
}

/// A half circle about the middle of the chord, whose axis is perpendicular to it.
fn half_circle(from: [f64; 3], to: [f64; 3]) -> Curve {
    let centre = [0, 1, 2].map(|i| f64::midpoint(from[i], to[i]));
    let chord: [f64; 3] = std::array::from_fn(|i| to[i] - from[i]);
    let normal = unit([chord[1], -chord[0], 0.0]);
    Curve::Arc { centre, normal, sweep: std::f64::consts::PI }
}
