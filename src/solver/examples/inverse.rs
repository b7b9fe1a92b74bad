//! Inverse kinematics: from the tool's pose in the part frame to the five joints.
//!
//! `cargo run --release -p verne-solver --example inverse [X Y Z PHI1 PHI2]`
//!
//! X, Y, Z is the tool centre point in the part frame, mm; Z points up from the table. PHI1 and PHI2 are the
//! tool's inclination and azimuth, degrees. The tool is 150 mm long. It prints:
//!
//! - `axis`: the unit vector from the tool's tip to its holder in the part frame.
//! - How many solutions there are: up to 24, of which nearly always one is in the working mode.
//! - For the working mode the joints: sliders `rho` in mm, table angles `theta` in degrees.
//! - `worst`: the constraint nearest to violation, with its margin in mm, rad or without unit (negative: violated).
//! - `check`: the distance between the given point and the one that Eq (26) computes from the joints, mm.

use std::error::Error;

use verne_solver::axis::tool_axis;
use verne_solver::{Machine, Margins, PartPose, part, part_pose, part_working, table_angles};

const TOOL_LENGTH: f64 = 150.0;

fn main() -> Result<(), Box<dyn Error>> {
    let machine = Machine::verne();
    let given: Vec<f64> = std::env::args().skip(1).map(|number| number.parse()).collect::<Result<_, _>>()?;
    let [x, y, z, phi1, phi2] = match given[..] {
        [] => [100.0, 50.0, 300.0, 20.0, 30.0],
        [x, y, z, phi1, phi2] => [x, y, z, phi1, phi2],
        _ => return Err("expected five numbers".into()),
    };
    let target = PartPose { x, y, z, phi1: f64::to_radians(phi1), phi2: f64::to_radians(phi2) };
    println!("target {:?} mm, axis {:.4?}", [x, y, z], tool_axis(target.phi1, target.phi2));
    match part(&machine, &target, TOOL_LENGTH) {
        Ok(all) => println!(
            "{} solutions, {} in the working mode",
            all.len(),
            all.iter().filter(|posture| posture.working).count()
        ),
        Err(refusal) => println!("no solution: {refusal:?}"),
    }
    if let Ok(posture) = part_working(&machine, &target, TOOL_LENGTH) {
        let table = table_angles(&machine, posture.pose.alpha, target.phi1, target.phi2);
        println!("rho {:.3?} mm", posture.rho);
        println!("theta {:.3?}°", [table.theta1, table.theta2].map(f64::to_degrees));
        let worst = Margins::of(&machine, &posture, Some(table)).worst(&machine);
        println!("worst {:?} {:?} {:.4}", worst.constraint, worst.element, worst.value);
        let back = part_pose(&machine, &posture.pose, table, TOOL_LENGTH);
        println!("check {:.1e} mm", (back.x - x).hypot(back.y - y).hypot(back.z - z));
    }
    Ok(())
}
