//! Lengths out of proportion to the machine: refused where double precision would lose solutions.

use verne_solver::machine::{Geometry, Table};
use verne_solver::{KinematicsError, MAX_LENGTH_RATIO, Machine, PartPose, forward, part, platform, tool};

/// The reference machine at a hundredth of its size.
fn small() -> Machine {
    let mut data = Machine::verne().data().clone();
    data.geometry = Geometry {
        D1: 1.0,
        d1: 6.0,
        D2: -1.0,
        d2: -6.0,
        R1: 2.75,
        r1: 0.75,
        R2: 1.5,
        r4: 5.0,
        L1: 10.5,
        L2: 10.5,
        L3: 10.5,
        parallelogram_half_width: 0.8,
        parallelogram_direction: 0.0,
        rod_radius: 0.25,
    };
    data.table = Table { da: 15.0, dt: 2.0 };
    Machine::new(data).unwrap()
}

#[test]
fn lengths_beyond_double_precision_are_refused_in_every_frame() {
    let machine = small();
    let most = MAX_LENGTH_RATIO * machine.longest();
    for length in [1.001 * most, -1.001 * most] {
        for place in 0..3 {
            let mut p = [0.5, 1.0, 12.0];
            p[place] = length;
            assert_eq!(platform(&machine, p), Err(KinematicsError::OutOfProportion));
            assert_eq!(forward(&machine, p), Err(KinematicsError::OutOfProportion));
            assert_eq!(tool(&machine, p, 1.0), Err(KinematicsError::OutOfProportion));
            let target = PartPose { x: p[0], y: p[1], z: p[2], phi1: 0.1, phi2: 0.0 };
            assert_eq!(part(&machine, &target, 1.0), Err(KinematicsError::OutOfProportion));
        }
        assert_eq!(tool(&machine, [0.5, 1.0, 12.0], length), Err(KinematicsError::OutOfProportion));
    }
}

#[test]
fn a_shift_along_the_sliders_changes_no_count() {
    let machine = small();
    let most = MAX_LENGTH_RATIO * machine.longest();
    for (x, y) in [(-2.4, -0.86), (0.5, 1.0), (0.0, 0.0), (3.0, -2.0)] {
        let count = platform(&machine, [x, y, 10.0]).unwrap().len();
        for z in [0.5 * most, 0.999 * most, -0.999 * most] {
            assert_eq!(platform(&machine, [x, y, z]).unwrap().len(), count, "{x} {y} {z}");
        }
    }
}

#[test]
fn a_table_too_far_from_the_legs_is_refused() {
    let mut data = small().data().clone();
    data.table.da = 1.001 * MAX_LENGTH_RATIO * small().longest();
    let faults = Machine::new(data).unwrap_err();
    assert_eq!(faults.iter().map(|fault| fault.field.as_str()).collect::<Vec<_>>(), ["table/da"]);
}
