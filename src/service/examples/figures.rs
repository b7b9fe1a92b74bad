//! The reference machine's workspace in figures, beside those of a sweep of 2,400² columns:
//! `cargo run --release -p verne-service --example figures`.

use std::error::Error;
use std::time::Instant;

use verne_solver::workspace::{Kind, Measure, Request, Unobserved, Volume, WorkspaceError, measure, surface};
use verne_solver::{Machine, MachineData};

/// What the sweep found, to about 1e-5.
const SWEPT: [(&str, f64); 9] = [
    ("area of A, mm²", 657_677.0),
    ("V_platform, mm³", 2.33692e8),
    ("V_tool, tool 50, mm³", 2.44325e8),
    ("V_tool, tool 150, mm³", 2.65591e8),
    ("V_tool, tool 300, mm³", 2.97490e8),
    ("V_part, phi1 = 0, mm³", 3.00444e8),
    ("V_part, phi1 = 30°, mm³", 3.00444e8),
    ("V_part, phi1 = -30°, mm³", 3.00444e8),
    ("V_part, phi1 = 60°, mm³", 2.99485e8),
];

fn main() -> Result<(), Box<dyn Error>> {
    let started = Instant::now();
    let verne = Machine::verne();
    let platform = of(&verne, Kind::Platform, 0.0, 0.0)?;
    println!("{:<38}{:>18} {:>11} {:>13} {:>9}", "", "found", "± at most", "swept", "ratio - 1");
    let mut rows = vec![(platform.area, platform.area_error), volume(&platform)];
    for length in [50.0, 150.0, 300.0] {
        rows.push(volume(&of(&verne, Kind::Tool, length, 0.0)?));
    }
    for phi1 in [0.0, 30.0, -30.0, 60.0] {
        rows.push(volume(&of(&verne, Kind::Part, 50.0, phi1)?));
    }
    for ((name, swept), row) in SWEPT.into_iter().zip(rows) {
        print(name, row, swept);
    }
    // Of this domain an edge runs along the grid's columns: these were swept at random places in 900² cells.
    let thick = changed(|data| data.geometry.rod_radius = 60.0)?;
    let thick = of(&thick, Kind::Platform, 0.0, 0.0)?;
    print("V_platform, rod_radius 60, mm³", volume(&thick), 2.104_444e8);
    print("area of A, rod_radius 60, mm²", (thick.area, thick.area_error), 558_150.0);
    let short = changed(|data| data.limits.stroke = [[100.0, 400.0]; 3])?;
    print("V_platform, strokes [100, 400], mm³", volume(&of(&short, Kind::Platform, 0.0, 0.0)?), 2.10792e7);
    outline(&verne, &platform)?;
    println!("in {:.2?}", started.elapsed());
    Ok(())
}

fn outline(machine: &Machine, platform: &Measure) -> Result<(), WorkspaceError> {
    let fine = Request { tolerance: 0.01, ..request(Kind::Platform, 0.0, 0.0) };
    if let Some([min, max]) = surface(machine, &fine, &Unobserved)?.bounds() {
        println!("P from {min:.1?} to {max:.1?} mm   (swept: [-407, -540.5, 870.6] to [392, 540.5, 1627.0])");
    }
    let most = platform.inclination.unwrap_or_default().to_degrees();
    println!("largest |alpha| {most:.2}°   (swept: 34.6°)");
    let [least, _] = of(machine, Kind::Part, 50.0, 0.0)?.jacobian.unwrap_or_default();
    println!("least part-frame Jacobian {least:.4}   (swept: 0.895)");
    Ok(())
}

fn request(kind: Kind, tool_length: f64, phi1: f64) -> Request {
    let phi1 = phi1.to_radians();
    Request { kind, tool_length, phi1, phi2: 0.0, table_clearance: None, tool_radius: 0.0, tolerance: 1.0 }
}

fn of(machine: &Machine, kind: Kind, tool_length: f64, phi1: f64) -> Result<Measure, WorkspaceError> {
    measure(machine, &request(kind, tool_length, phi1), &Unobserved)
}

/// The volume and its error; a folded workspace has none.
fn volume(measure: &Measure) -> (f64, f64) {
    match measure.volume {
        Volume::Value { value, error } => (value, error),
        Volume::Folded => (f64::NAN, f64::NAN),
    }
}

/// The reference machine with something changed.
fn changed(change: impl FnOnce(&mut MachineData)) -> Result<Machine, String> {
    let mut data = Machine::verne().data().clone();
    change(&mut data);
    Machine::new(data).map_err(|faults| format!("{faults:?}"))
}

fn print(name: &str, (found, error): (f64, f64), swept: f64) {
    println!("{name:<38}{found:>18.2} {error:>11.1e} {swept:>13.6e} {:>9.0e}", found / swept - 1.0);
}
