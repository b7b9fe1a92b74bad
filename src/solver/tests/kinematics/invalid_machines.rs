//! Invalid machines are refused with the name of each invalid field.

use verne_solver::{Machine, MachineData};

type Change = fn(&mut MachineData);
type Number = fn(&mut MachineData) -> &mut f64;

/// The faults' fields of the reference machine with a change.
fn fields(change: impl FnOnce(&mut MachineData)) -> Vec<String> {
    let mut data = Machine::verne().data().clone();
    change(&mut data);
    let faults = Machine::new(data).map(|_| ()).expect_err("no machine");
    assert!(faults.iter().all(|fault| !fault.detail.is_empty()));
    faults.into_iter().map(|fault| fault.field).collect()
}

#[test]
fn infinite_and_nan_numbers_are_refused() {
    let fields_and_places: [(&str, Number); 24] = [
        ("geometry/D1", |d| &mut d.geometry.D1),
        ("geometry/d1", |d| &mut d.geometry.d1),
        ("geometry/D2", |d| &mut d.geometry.D2),
        ("geometry/d2", |d| &mut d.geometry.d2),
        ("geometry/R1", |d| &mut d.geometry.R1),
        ("geometry/r1", |d| &mut d.geometry.r1),
        ("geometry/R2", |d| &mut d.geometry.R2),
        ("geometry/r4", |d| &mut d.geometry.r4),
        ("geometry/L1", |d| &mut d.geometry.L1),
        ("geometry/L2", |d| &mut d.geometry.L2),
        ("geometry/L3", |d| &mut d.geometry.L3),
        ("geometry/parallelogram_half_width", |d| &mut d.geometry.parallelogram_half_width),
        ("geometry/rod_radius", |d| &mut d.geometry.rod_radius),
        ("table/da", |d| &mut d.table.da),
        ("table/dt", |d| &mut d.table.dt),
        ("limits/stroke/0", |d| &mut d.limits.stroke[0][0]),
        ("limits/stroke/1", |d| &mut d.limits.stroke[1][1]),
        ("limits/stroke/2", |d| &mut d.limits.stroke[2][0]),
        ("limits/slider_cone", |d| &mut d.limits.slider_cone),
        ("limits/platform_cone", |d| &mut d.limits.platform_cone),
        ("limits/serial_margin", |d| &mut d.limits.serial_margin),
        ("limits/parallel_margin", |d| &mut d.limits.parallel_margin),
        ("limits/tilt", |d| &mut d.limits.tilt[0]),
        ("limits/rotary", |d| &mut d.limits.rotary.as_mut().unwrap()[1]),
    ];
    for (field, place) in fields_and_places {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300] {
            assert_eq!(fields(|data| *place(data) = bad), [field], "{bad}");
        }
    }
}

#[test]
fn lengths_and_limits_out_of_order_are_refused() {
    let changes: [(&str, Change); 16] = [
        ("geometry/L1", |d| d.geometry.L1 = 0.0),
        ("geometry/L2", |d| d.geometry.L2 = -1050.0),
        ("geometry/r1", |d| d.geometry.r1 = 0.0),
        ("geometry/R2", |d| d.geometry.R2 = -1.0),
        ("geometry/rod_radius", |d| d.geometry.rod_radius = -1.0),
        ("geometry/parallelogram_half_width", |d| d.geometry.parallelogram_half_width = 0.0),
        ("limits/stroke/1", |d| d.limits.stroke[1] = [750.0, 0.0]),
        ("limits/stroke/2", |d| d.limits.stroke[2] = [10.0, 10.0]),
        ("limits/slider_cone", |d| d.limits.slider_cone = 0.0),
        ("limits/platform_cone", |d| d.limits.platform_cone = 3.2),
        ("limits/serial_margin", |d| d.limits.serial_margin = -0.1),
        ("limits/serial_margin", |d| d.limits.serial_margin = 1.0),
        ("limits/parallel_margin", |d| d.limits.parallel_margin = -0.1),
        ("limits/tilt", |d| d.limits.tilt = [1.0, -1.0]),
        ("limits/rotary", |d| d.limits.rotary = Some([2.0, 2.0])),
        ("name", |d| d.name.clear()),
    ];
    for (field, change) in changes {
        assert_eq!(fields(change), [field]);
    }
}

#[test]
fn zero_cone_axes_are_refused() {
    let axes = |bad: [f64; 3]| Some([[0.0, 0.0, 1.0], bad, [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]);
    for bad in [[0.0; 3], [f64::NAN, 0.0, 1.0], [f64::INFINITY, 0.0, 0.0]] {
        assert_eq!(fields(|d| d.limits.slider_axes = axes(bad)), ["limits/slider_axes/1"]);
        assert_eq!(fields(|d| d.limits.platform_axes = axes(bad)), ["limits/platform_axes/1"]);
    }
}

#[test]
fn equal_and_nearly_equal_offsets_are_accepted() {
    // d2 = 700 makes the offsets equal.
    for apart in [0.0, 1e-12, 1e-9, 0.1, -1e-9] {
        let mut data = Machine::verne().data().clone();
        (data.geometry.D2, data.geometry.d2) = (200.0, 700.0 + apart);
        assert!(Machine::new(data).is_ok(), "{apart}");
    }
}

#[test]
fn parallel_rods_of_leg_one_are_accepted_and_converging_ones_are_not() {
    for r1 in [275.0, 274.999_999_999_999_9, 274.999_999_9, 274.73] {
        let mut data = Machine::verne().data().clone();
        data.geometry.r1 = r1;
        assert!(Machine::new(data).is_ok(), "{r1}");
    }
    for r1 in [275.000_000_000_001, 300.0] {
        assert_eq!(fields(|d| d.geometry.r1 = r1), ["geometry/R1"]);
    }
}

/// With equal offsets that are zero, or legs of one height at home, the platform could move along x.
#[test]
fn equal_offsets_with_a_singular_home_pose_are_refused() {
    let offsets_are_zero = fields(|d| {
        let g = &mut d.geometry;
        (g.D1, g.d1, g.D2, g.d2) = (600.0, 600.0, 200.0, 200.0);
    });
    assert_eq!(offsets_are_zero, ["geometry"]);
    let heights_are_equal = fields(|d| {
        let g = &mut d.geometry;
        (g.D2, g.d2, g.R2, g.r4) = (200.0, 700.0, 300.0, 500.0);
    });
    assert_eq!(heights_are_equal, ["geometry"]);
}

#[test]
fn a_cone_axis_can_have_any_length() {
    for size in [1e-320, 1e-200, 1e-9, 1e9, 1e200, f64::MAX] {
        let mut data = Machine::verne().data().clone();
        data.limits.slider_axes = Some([[0.0, 0.0, size]; 4]);
        data.limits.platform_axes = Some([[0.0, 0.0, size]; 4]);
        assert!(Machine::new(data).is_ok(), "{size:e}");
    }
}

#[test]
fn legs_too_short_for_a_home_pose_are_refused() {
    // sqrt(500² + 200²) and sqrt(500² + 350²) are needed.
    assert_eq!(fields(|d| d.geometry.L1 = 538.0), ["geometry/L1"]);
    assert_eq!(fields(|d| d.geometry.L2 = 610.0), ["geometry/L2"]);
    assert_eq!(fields(|d| d.geometry.L3 = 610.0), ["geometry/L3"]);
    let mut data = Machine::verne().data().clone();
    (data.geometry.L1, data.geometry.L2, data.geometry.L3) = (539.0, 611.0, 611.0);
    assert!(Machine::new(data).is_ok());
}

#[test]
fn every_invalid_field_is_listed() {
    let fields = fields(|d| {
        d.geometry.L1 = -1.0;
        d.limits.slider_cone = f64::NAN;
        d.table.da = f64::INFINITY;
    });
    assert_eq!(fields, ["geometry/L1", "table/da", "limits/slider_cone"]);
}
