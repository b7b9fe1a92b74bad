//! Drives of a machine: which are refused, and what they change in a plan.

use verne_solver::Machine;
use verne_solver::machine::{Drive, Drives};
use verne_solver::toolpath::PlanOptions;

use super::support::{arrive, feed, planned, rapid};

fn drives() -> Drives {
    let drive = |velocity| Drive { velocity, acceleration: Some(10.0 * velocity) };
    Drives { slider: drive(400.0), tilt: drive(1.0), rotary: drive(2.0) }
}

fn with(drives: Drives) -> Result<Machine, Vec<String>> {
    let mut data = Machine::verne().data().clone();
    data.drives = Some(drives);
    Machine::new(data).map_err(|faults| faults.into_iter().map(|fault| fault.field).collect())
}

#[test]
fn drives_that_cannot_move_are_refused_by_name() {
    assert!(with(drives()).is_ok());
    let drive_named = |drives: &mut Drives, name: &str, change: &dyn Fn(&mut Drive)| match name {
        "slider" => change(&mut drives.slider),
        "tilt" => change(&mut drives.tilt),
        _ => change(&mut drives.rotary),
    };
    for name in ["slider", "tilt", "rotary"] {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let mut slow = drives();
            drive_named(&mut slow, name, &|drive| drive.velocity = bad);
            assert_eq!(with(slow).unwrap_err(), [format!("drives/{name}/velocity")]);
            let mut heavy = drives();
            drive_named(&mut heavy, name, &|drive| drive.acceleration = Some(bad));
            assert_eq!(with(heavy).unwrap_err(), [format!("drives/{name}/acceleration")]);
        }
        let mut sudden = drives();
        drive_named(&mut sudden, name, &|drive| drive.acceleration = None);
        assert!(with(sudden).is_ok());
    }
}

/// From the axis (0, -s, c) to (0, s, c) the table tilts by twice the angle, or turns by half a turn.
#[test]
fn the_faster_axis_of_the_table_turns() {
    let program = [
        arrive([0.0, 0.0, 300.0], [0.0, -0.4, 1.0]),
        rapid([0.0, 0.0, 320.0], [0.0, 0.4, 1.0]),
        feed([0.0, 0.0, 300.0], [0.0, 0.4, 1.0]),
    ];
    let turned = |tilt: f64, rotary: f64| {
        let drive = |velocity| Drive { velocity, acceleration: None };
        let slider = drive(400.0);
        let machine = with(Drives { slider, tilt: drive(tilt), rotary: drive(rotary) }).unwrap();
        let (report, _) = planned(&machine, &program, &PlanOptions::default());
        assert!(report.is_feasible());
        report.turning[1]
    };
    assert!(turned(1.0, 1.0) < 1e-9);
    assert!(turned(1.0, 3.0) < 1e-9, "half a turn takes longer than 0.76 rad");
    assert!((turned(1.0, 9.0) - std::f64::consts::PI).abs() < 1e-9);
    assert!(turned(9.0, 1.0) < 1e-9);
}
