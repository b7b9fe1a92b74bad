//! Volumes and areas.

use verne_solver::Machine;
use verne_solver::workspace::{Kind, Measure, Request, Unobserved, Volume, measure};

use crate::column_lattice;
use crate::machines::{changed, others};
use crate::requests::request;

fn measured(machine: &Machine, request: &Request) -> Measure {
    measure(machine, request, &Unobserved).unwrap()
}

fn volume(measure: &Measure) -> (f64, f64) {
    match measure.volume {
        Volume::Value { value, error } => (value, error),
        Volume::Folded => panic!("folded"),
    }
}

/// Figures of a lattice of 2400² columns, to the digits that it resolves.
#[test]
fn volumes_of_the_reference_machine_are_those_of_a_fine_lattice() {
    let machine = Machine::verne();
    let cases = [
        (Kind::Platform, 0.0, 0.0, 2.336_92e8),
        (Kind::Tool, 50.0, 0.0, 2.443_25e8),
        (Kind::Tool, 150.0, 0.0, 2.655_91e8),
        (Kind::Tool, 300.0, 0.0, 2.974_90e8),
        (Kind::Part, 50.0, 0.0, 3.004_44e8),
        (Kind::Part, 50.0, 30.0, 3.004_44e8),
        (Kind::Part, 300.0, -30.0, 3.004_44e8),
        (Kind::Part, 50.0, 60.0, 2.994_85e8),
    ];
    for (kind, length, phi1, expected) in cases {
        let answer = measured(&machine, &request(kind, length, phi1, 1.0));
        let (value, error) = volume(&answer);
        assert!((value - expected).abs() <= 2e-6 * expected, "{kind:?} {length} {phi1}: {value}");
        assert!(error <= 1e-6 * value && answer.area_error <= 1e-6 * answer.area);
    }
    let part = measured(&machine, &request(Kind::Part, 50.0, 0.0, 1.0));
    assert!((part.area - 657_677.0).abs() < 10.0, "{}", part.area);
    assert!((part.inclination.unwrap().to_degrees() - 34.6).abs() < 0.05);
    assert!((part.jacobian.unwrap()[0] - 0.895).abs() < 1e-3);
}

#[test]
fn volumes_of_other_machines_are_those_of_a_lattice() {
    for (name, machine) in others() {
        let answer = measured(&machine, &request(Kind::Platform, 0.0, 0.0, 1.0));
        let (value, _) = volume(&answer);
        let surface =
            verne_solver::workspace::surface(&machine, &request(Kind::Platform, 0.0, 0.0, 1.0), &Unobserved)
                .unwrap();
        let [low, high] = surface.bounds().unwrap();
        let rectangle = [[low[0] - 3.0, low[1] - 3.0], [high[0] + 3.0, high[1] + 3.0]];
        let [area, brute] = column_lattice::area_and_volume(&machine, rectangle, 700);
        // Such a lattice is off by about its cells' area times the root of the cells cut.
        assert!((answer.area - area).abs() < 2e-4 * area, "{name}: {} against {area}", answer.area);
        assert!((value - brute).abs() < 2e-4 * brute, "{name}: {value} against {brute}");
    }
}

/// If the Jacobian determinant changes its sign, there is no volume.
#[test]
fn a_determinant_of_both_signs_is_reported_as_folded() {
    let answer = measured(&Machine::verne(), &request(Kind::Tool, -650.0, 0.0, 1.0));
    assert!(answer.folded(), "{answer:?}");
    let [least, greatest] = answer.jacobian.unwrap();
    assert!(least < 0.0 && greatest > 0.0);
}

/// Two separate parts of the platform's domain have the same image, and the determinant has one sign on both.
#[test]
fn a_workspace_that_is_covered_twice_is_reported_as_folded() {
    let covered = |size: f64, cone: f64| {
        changed(|data| {
            let g = &mut data.geometry;
            (g.D1, g.d1, g.D2, g.d2) = (0.0, 500.0 * size, 0.0, -500.0 * size);
            (g.R2, g.r4, g.L1, g.L2, g.L3) =
                (50.0 * size, 50.0 * size, 1050.0 * size, 707.2 * size, 707.2 * size);
            (g.R1, g.r1, g.parallelogram_half_width, g.rod_radius) =
                (275.0 * size, 75.0 * size, 20.0 * size, 0.0);
            (data.table.da, data.table.dt) = (-760.0 * size, 200.0 * size);
            let limits = &mut data.limits;
            limits.stroke =
                [[-2000.0, 2000.0], [0.0, 400.0], [0.0, 400.0]].map(|ends| ends.map(|end| end * size));
            (limits.slider_cone, limits.platform_cone) = (cone.to_radians(), std::f64::consts::PI);
            (limits.serial_margin, limits.parallel_margin) = (0.42, 0.0);
            let (side, aslant) = ([-1.0, 0.0, 0.0], [0.7, 0.0, 0.7]);
            limits.slider_axes = Some([side, side, aslant, aslant]);
        })
    };
    for size in [0.3, 1.0, 7.0] {
        let part = request(Kind::Part, 0.0, 0.0, 1.0);
        let answer = measured(&covered(size, 61.6), &part);
        let [least, greatest] = answer.jacobian.unwrap();
        assert!(answer.folded() && least * greatest > 0.0, "{answer:?}");
        // The platform's own positions are never covered twice.
        assert!(!measured(&covered(size, 61.6), &request(Kind::Platform, 0.0, 0.0, 1.0)).folded());
    }
}

#[test]
fn an_empty_workspace_has_no_volume() {
    let closed = changed(|data| data.limits.slider_cone = 1e-6);
    let narrow = changed(|data| data.limits.rotary = Some([-0.1, 0.1]));
    let turned = Request { phi2: 1.0, ..request(Kind::Part, 50.0, 0.0, 1.0) };
    for (machine, request) in [(narrow, turned), (closed, request(Kind::Platform, 0.0, 0.0, 1.0))] {
        let answer = measured(&machine, &request);
        let (value, _) = volume(&answer);
        assert!(value < 0.01 && answer.area < 1e-3, "{answer:?}");
    }
}
