//! Forward kinematics: from slider positions to the poses of the platform.
//!
//! `cargo run --release -p verne-solver --example forward [RHO1 RHO2 RHO3]`
//!
//! RHO1, RHO2, RHO3 are the sliders' z in mm. Without arguments it takes the sliders of the paper's Fig. 6.
//! It prints a line for each assembly mode:
//!
//! - `x y z`: the platform's reference point P in the base frame, mm; z points down.
//! - `alpha`: the platform's inclination about the x axis, degrees.
//! - `mode`: for legs I, II, III whether the slider is above (+) or below (-) its platform joint, and `crossed` if the
//!   rods of leg I cross.
//! - `working` marks the mode that the machine uses; `worst` is its constraint nearest to violation, with its margin
//!   (negative: violated).
//! - `residual`: the largest error of a rod's length when the pose is put back into Eqs (3)-(6), mm.

use std::error::Error;

use verne_solver::{Machine, Margins, Posture, Side, forward};

fn main() -> Result<(), Box<dyn Error>> {
    let machine = Machine::verne();
    let given: Vec<f64> = std::env::args().skip(1).map(|number| number.parse()).collect::<Result<_, _>>()?;
    let rho = match given[..] {
        [] => [674.0, 685.0, 250.0],
        [rho1, rho2, rho3] => [rho1, rho2, rho3],
        _ => return Err("expected three numbers".into()),
    };
    println!("sliders at {rho:?} mm, machine \"{}\" (invented dimensions)", machine.name());
    match forward(&machine, rho) {
        Ok(postures) => postures.iter().for_each(|posture| print(&machine, posture)),
        Err(refusal) => println!("no pose: {refusal:?}"),
    }
    Ok(())
}

fn print(machine: &Machine, posture: &Posture) {
    let pose = &posture.pose;
    let legs: String =
        posture.mode.legs.iter().map(|side| if *side == Side::Above { '+' } else { '-' }).collect();
    let crossed = if posture.mode.crossed { " crossed" } else { "" };
    println!(
        "x {:9.3}  y {:9.3}  z {:9.3}  alpha {:8.3}°  mode {legs}{crossed}  residual {:.0e}",
        pose.x,
        pose.y,
        pose.z,
        pose.alpha.to_degrees(),
        posture.residual
    );
    if posture.working {
        let margins = Margins::of(machine, posture, None);
        let worst = margins.worst(machine);
        let feasible = if margins.feasible() { "feasible" } else { "infeasible" };
        println!(
            "    working, {feasible}, worst {:?} {:?} {:.3}",
            worst.constraint, worst.element, worst.value
        );
    }
}
