//! The margin of the table's plane, compared with the frames themselves.

use std::f64::consts::{FRAC_PI_2, TAU};

use verne_solver::{
    Clearance, Constraint, Element, Machine, Margins, PlatformPose, TableAngles, forward_working,
};

use crate::machines::{changed, random};
use crate::random::Random;

/// Z over the table of a point of the base frame: the inverses of trans(z, da) rot(x, theta1) trans(z, dt) rot(x,
/// pi), one after the other.
pub(crate) fn height(machine: &Machine, [_, y, z]: [f64; 3], theta1: f64) -> f64 {
    let table = machine.data().table;
    let (s, c) = theta1.sin_cos();
    let z = z - table.da;
    let turned_back = c * z - s * y;
    -(turned_back - table.dt)
}

/// A point of the platform frame in the base frame.
fn in_base(pose: &PlatformPose, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let (s, c) = pose.alpha.sin_cos();
    [pose.x + x, pose.y + c * y - s * z, pose.z + s * y + c * z]
}

/// The lowest of tool end and joints, with the tool's circle sampled.
fn lowest(machine: &Machine, pose: &PlatformPose, theta1: f64, tool: &Clearance) -> (f64, Element) {
    const SAMPLES: u32 = 7_200;
    let g = machine.data().geometry;
    let half = g.parallelogram_half_width;
    let joints = [
        (11, [g.D1, g.R1, 0.0]),
        (12, [g.D1, -g.R1, 0.0]),
        (21, [g.D2 + half, -g.R2, 0.0]),
        (22, [g.D2 - half, -g.R2, 0.0]),
        (31, [g.D2 + half, g.R2, 0.0]),
        (32, [g.D2 - half, g.R2, 0.0]),
    ];
    let circle = (0..SAMPLES).map(|n| {
        let angle = TAU * f64::from(n) / f64::from(SAMPLES);
        [tool.tool_radius * angle.cos(), tool.tool_radius * angle.sin(), tool.tool_length]
    });
    let tool = circle.map(|point| (Element::Tool, point));
    let joints = joints.map(|(rod, point)| (Element::Joint(rod), point));
    tool.chain(joints)
        .map(|(element, point)| (height(machine, in_base(pose, point), theta1), element))
        .fold((f64::INFINITY, Element::Platform), |least, next| if next.0 < least.0 { next } else { least })
}

/// The margin is the height of the lowest point, whatever the table's tilt.
#[test]
fn the_margin_is_the_height_of_the_lowest_point() {
    let mut numbers = Random::new(0x0bad_cafe);
    let mut machines: Vec<Machine> =
        std::iter::repeat_with(|| random(&mut numbers)).take(100).flatten().collect();
    machines.push(changed(|data| data.geometry.R2 = 330.0));
    let (mut found, mut beyond) = (0, 0);
    let mut elements = std::collections::HashSet::new();
    for machine in machines {
        for _ in 0..40 {
            let rho = [0; 3].map(|_| numbers.between(0.0, 750.0));
            let Ok(posture) = forward_working(&machine, rho) else { continue };
            let tool = Clearance {
                least: numbers.between(0.0, 100.0),
                tool_length: numbers.between(0.0, 400.0),
                tool_radius: numbers.between(-200.0, 200.0).max(0.0),
            };
            let table =
                TableAngles { theta1: numbers.between(-3.2, 3.2), theta2: numbers.between(-6.0, 6.0) };
            let margins = Margins::above_table(&machine, &posture, Some(table), Some(&tool));
            let margin = margins.table_clearance.unwrap();
            let (least, element) = lowest(&machine, &posture.pose, table.theta1, &tool);
            // The sampled circle misses its lowest point by less than this.
            let allowed = 1e-9 + tool.tool_radius * 1e-6;
            assert!((margin.value - (least - tool.least)).abs() <= allowed, "{margin:?} {least} {tool:?}");
            assert_eq!(margin.constraint, Constraint::TableClearance);
            assert_eq!(margin.element, element, "{tool:?} {table:?} {:?}", machine.data());
            elements.insert(element);
            (found, beyond) = (found + 1, beyond + u32::from(table.theta1.abs() > FRAC_PI_2));
        }
    }
    assert!(found > 1_000 && beyond > 300, "{beyond} of {found}");
    let all = [Element::Tool, Element::Joint(11), Element::Joint(12), Element::Joint(21), Element::Joint(31)];
    assert!(all.iter().all(|element| elements.contains(element)), "{elements:?}");
}
