//! Each kind of margin against a plain computation from the rods in space.

use nalgebra::Vector3;
use verne_solver::{Machine, Margins, TableAngles};

use crate::lengths::scale;
use crate::oracle::constructed_postures::{hung, postures, upright};
use crate::oracle::{Found, Legs};
use crate::random::Random;

/// The rods that the arrays of four stand for.
const RODS: [u8; 4] = [11, 12, 21, 31];

/// The angle between two directions, exact near 0 and π.
fn angle(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}

/// The rods' directions at home, x = y = alpha = 0, all sliders above.
fn at_home(legs: &Legs) -> [Vector3<f64>; 4] {
    let home = home(legs);
    RODS.map(|rod| legs.rod(rod, &home.q, &home.rho))
}

fn home(legs: &Legs) -> Found {
    hung(legs, upright(legs, 0.0, 0.0, 0.0, 1.0).unwrap(), [1.0, 1.0]).unwrap()
}

/// A machine with cone axes of its own for one or both ends of the rods.
fn with_axes(machine: &Machine, draw: &mut Random) -> Machine {
    let mut data = machine.data().clone();
    let mut axes = || [0; 4].map(|_| [0; 3].map(|_| draw.between(-1.0, 1.0) * 5.0));
    (data.limits.slider_axes, data.limits.platform_axes) = (Some(axes()), Some(axes()));
    Machine::new(data).expect("directions of any length")
}

fn close(name: &str, found: &Found, got: &[f64], expected: &[f64], tolerance: f64) {
    for (g, e) in got.iter().zip(expected) {
        assert!((g - e).abs() < tolerance, "{name}: {got:?}, expected {expected:?}: {found:?}");
    }
}

#[test]
fn the_stroke_margin_is_the_distance_to_the_nearer_end() {
    for (machine, found) in postures(131, 300) {
        let got = Margins::of(&machine, &found.posture(&Legs::of(&machine)), None).stroke;
        let limits = machine.data().limits.stroke;
        for i in 0..3 {
            let expected = [found.rho[i] - limits[i][0], limits[i][1] - found.rho[i]];
            close("stroke", &found, &got[i], &expected, 1e-15 * scale(&machine));
        }
    }
}

#[test]
fn the_leg_length_margin_is_the_height_of_the_slider_over_its_joint() {
    for (machine, found) in postures(132, 1000) {
        let (legs, unit) = (Legs::of(&machine), scale(&machine));
        let got = Margins::of(&machine, &found.posture(&legs), None).leg_length;
        let heights = [
            found.q[2] - found.rho[0],
            legs.rod(21, &found.q, &found.rho).z,
            legs.rod(31, &found.q, &found.rho).z,
        ];
        for i in 0..3 {
            let height = heights[i].abs();
            // A root: an error of the square grows as the height shrinks.
            let tolerance = (1e-12 * unit * unit / height).min(1e-5 * unit);
            close("leg length", &found, &got[i..=i], &[height], tolerance);
        }
    }
}

#[test]
fn the_serial_singularity_margin_is_the_cosine_minus_the_limit() {
    for (machine, found) in postures(133, 1000) {
        let legs = Legs::of(&machine);
        let got = Margins::of(&machine, &found.posture(&legs), None).serial_singularity;
        let expected = RODS.map(|rod| {
            let d = legs.rod(rod, &found.q, &found.rho);
            d.z / d.norm() - machine.data().limits.serial_margin
        });
        close("serial", &found, &got, &expected, 1e-12);
    }
}

#[test]
fn the_parallel_singularity_margin_is_positive_at_home() {
    for (machine, found) in postures(134, 1000) {
        let legs = Legs::of(&machine);
        let home = home(&legs);
        let sign = legs.rates(&home.q, &home.rho).determinant().signum();
        let rates = legs.rates(&found.q, &found.rho);
        let expected = sign * rates.determinant() - machine.data().limits.parallel_margin;
        let got = Margins::of(&machine, &found.posture(&legs), None).parallel_singularity;
        close("parallel", &found, &[got], &[expected], 1e-12 * rates.norm().powi(4));
        let got = Margins::of(&machine, &home.posture(&legs), None).parallel_singularity;
        assert!(got > -machine.data().limits.parallel_margin, "{got} at home");
    }
}

#[test]
fn the_slider_joint_margin_uses_the_base_frame() {
    let mut draw = Random::new(1);
    for (machine, found) in postures(135, 1000) {
        let legs = Legs::of(&machine);
        let rods = RODS.map(|rod| legs.rod(rod, &found.q, &found.rho));
        let cone = machine.data().limits.slider_cone;
        let home = at_home(&legs);
        let expected = [0, 1, 2, 3].map(|i| cone - angle(&rods[i], &home[i]));
        let got = Margins::of(&machine, &found.posture(&legs), None).slider_joint;
        close("slider joint", &found, &got, &expected, 1e-10);

        let machine = with_axes(&machine, &mut draw);
        let axes = machine.data().limits.slider_axes.unwrap();
        let expected = [0, 1, 2, 3].map(|i| cone - angle(&rods[i], &Vector3::from(axes[i])));
        let got = Margins::of(&machine, &found.posture(&legs), None).slider_joint;
        close("slider joint, own axes", &found, &got, &expected, 1e-10);
    }
}

#[test]
fn the_platform_joint_margin_uses_the_platform_frame() {
    let mut draw = Random::new(2);
    for (machine, found) in postures(136, 1000) {
        let legs = Legs::of(&machine);
        let back = nalgebra::Rotation3::from_axis_angle(&Vector3::x_axis(), -found.q[3]);
        let rods = RODS.map(|rod| back * legs.rod(rod, &found.q, &found.rho));
        let cone = machine.data().limits.platform_cone;
        let home = at_home(&legs);
        let expected = [0, 1, 2, 3].map(|i| cone - angle(&rods[i], &home[i]));
        let got = Margins::of(&machine, &found.posture(&legs), None).platform_joint;
        close("platform joint", &found, &got, &expected, 1e-10);

        let machine = with_axes(&machine, &mut draw);
        let axes = machine.data().limits.platform_axes.unwrap();
        let expected = [0, 1, 2, 3].map(|i| cone - angle(&rods[i], &Vector3::from(axes[i])));
        let got = Margins::of(&machine, &found.posture(&legs), None).platform_joint;
        close("platform joint, own axes", &found, &got, &expected, 1e-10);
    }
}

#[test]
fn joint_margins_are_the_whole_cone_at_home() {
    let machine = Machine::verne();
    let legs = Legs::of(&machine);
    let margins = Margins::of(&machine, &home(&legs).posture(&legs), None);
    close("slider joint", &home(&legs), &margins.slider_joint, &[42_f64.to_radians(); 4], 1e-10);
    close("platform joint", &home(&legs), &margins.platform_joint, &[32_f64.to_radians(); 4], 1e-10);
}

#[test]
fn the_rod_crossing_margin_changes_sign_where_rods_cross() {
    for (machine, found) in postures(137, 300) {
        let legs = Legs::of(&machine);
        let margins = Margins::of(&machine, &found.posture(&legs), None);
        let expected = legs.g.R1 * found.q[3].cos() - legs.g.r1;
        close("rod crossing", &found, &[margins.rod_crossing.unwrap()], &[expected], 1e-14 * scale(&machine));
        if found.signs_certain {
            assert_eq!(margins.rod_crossing.unwrap() < 0.0, found.mode.crossed, "{found:?}");
        }
    }
}

#[test]
fn tilt_and_rotary_margins_exist_only_with_table_angles() {
    let machine = Machine::verne();
    let legs = Legs::of(&machine);
    let posture = home(&legs).posture(&legs);
    let without = Margins::of(&machine, &posture, None);
    assert_eq!((without.tilt, without.rotary), (None, None));
    let table = TableAngles { theta1: 1.0, theta2: -2.0 };
    let with = Margins::of(&machine, &posture, Some(table));
    let quarter = 90_f64.to_radians();
    close("tilt", &home(&legs), &with.tilt.unwrap(), &[1.0 + quarter, quarter - 1.0], 1e-15);
    close("rotary", &home(&legs), &with.rotary.unwrap(), &[4.0 * quarter - 2.0, 4.0 * quarter + 2.0], 1e-14);
    assert_eq!(with.leg_length, without.leg_length);
}

#[test]
fn a_posture_is_feasible_if_every_margin_is_at_least_zero() {
    let (mut yes, mut no) = (0, 0);
    for (machine, found) in postures(138, 3000) {
        let mut data = machine.data().clone();
        // Limits wide enough that a good part of the postures keeps them all.
        data.limits.stroke = found.rho.map(|rho| [rho - 1e-3 * scale(&machine), rho + scale(&machine)]);
        (data.limits.slider_cone, data.limits.platform_cone) = (2.0, 2.0);
        (data.limits.parallel_margin, data.limits.serial_margin) = (0.0, 0.0);
        let machine = Machine::new(data).expect("wider limits");
        let m = Margins::of(&machine, &found.posture(&Legs::of(&machine)), None);
        let all = m.stroke.iter().flatten().chain(&m.leg_length).chain(&m.serial_singularity);
        let all = all.chain([&m.parallel_singularity, &m.rod_interference]).chain(&m.rod_crossing);
        let mut all = all.chain(&m.slider_joint).chain(&m.platform_joint);
        let expected = all.all(|&margin| margin >= 0.0);
        assert_eq!(m.feasible(), expected, "{m:?}");
        assert_eq!(m.worst(&machine).value >= 0.0, expected, "{m:?}");
        if expected { yes += 1 } else { no += 1 }
    }
    assert!(yes > 100 && no > 100, "{yes} feasible, {no} not");
}
