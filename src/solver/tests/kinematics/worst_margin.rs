//! The worst margin names the one constraint that a posture breaks.

use verne_solver::machine::{Geometry, Limits};
use verne_solver::{Constraint, Element, Machine, Margin, Margins, Posture, TableAngles};

use crate::oracle::Legs;
use crate::oracle::constructed_postures::{hung, leaning, upright};

/// The reference machine with every limit out of the way but what `change` sets.
fn machine(change: impl FnOnce(&mut Limits, &mut Geometry)) -> Machine {
    let mut data = Machine::verne().data().clone();
    let wide = 179_f64.to_radians();
    data.geometry.rod_radius = 0.0;
    data.limits = Limits {
        stroke: [[-1e4, 1e4]; 3],
        slider_cone: wide,
        platform_cone: wide,
        serial_margin: 0.0,
        parallel_margin: 0.0,
        ..data.limits
    };
    change(&mut data.limits, &mut data.geometry);
    Machine::new(data).expect("a valid machine")
}

/// A working posture well inside the reference machine's workspace.
fn posture(z: f64) -> Posture {
    let legs = Legs::of(&Machine::verne());
    let leg1 = leaning(&legs, -0.3, 250.0, z, -1.0).expect("leg I reaches");
    let found = hung(&legs, leg1, [1.0, 1.0]).expect("legs II and III reach");
    assert!(found.working, "{found:?}");
    found.posture(&legs)
}

fn worst(machine: &Machine, table: Option<TableAngles>) -> (Constraint, Element) {
    let margins = Margins::of(machine, &posture(1250.0), table);
    let worst: Margin = margins.worst(machine);
    assert!(worst.value < 0.0 && !margins.feasible(), "{worst:?}");
    (worst.constraint, worst.element)
}

#[test]
fn no_margin_is_negative_inside_the_limits() {
    for machine in [machine(|_, _| ()), Machine::verne()] {
        let margins = Margins::of(&machine, &posture(1250.0), Some(TableAngles::default()));
        let worst = margins.worst(&machine);
        assert!(margins.feasible() && worst.value > 0.0, "{worst:?} {margins:?}");
    }
}

#[test]
fn a_stroke_margin_names_the_slider_and_its_end() {
    let rho = posture(1250.0).rho;
    for (i, slider) in [(0, 1), (1, 2), (2, 3)] {
        let low = machine(|limits, _| limits.stroke[i] = [rho[i] + 0.5, 1e4]);
        assert_eq!(worst(&low, None), (Constraint::Stroke, Element::Stroke { slider, high: false }));
        let high = machine(|limits, _| limits.stroke[i] = [-1e4, rho[i] - 0.5]);
        assert_eq!(worst(&high, None), (Constraint::Stroke, Element::Stroke { slider, high: true }));
        let margins = Margins::of(&high, &posture(1250.0), None);
        assert!((margins.worst(&high).value + 0.5).abs() < 1e-12);
    }
}

#[test]
fn the_end_of_a_stroke_is_feasible() {
    let rho = posture(1250.0).rho;
    let machine = machine(|limits, _| limits.stroke[1] = [rho[1], 1e4]);
    let margins = Margins::of(&machine, &posture(1250.0), None);
    assert!(margins.feasible());
    assert_eq!(margins.stroke[1][0], 0.0);
    let worst = margins.worst(&machine);
    assert_eq!((worst.constraint, worst.value), (Constraint::Stroke, 0.0));
}

#[test]
fn a_serial_singularity_names_the_rod() {
    let legs = Legs::of(&Machine::verne());
    let p = posture(1250.0);
    let q = nalgebra::Vector4::new(p.pose.x, p.pose.y, p.pose.z, p.pose.alpha);
    let rods = [11, 12, 21, 31];
    let cosines = rods.map(|rod| legs.rod(rod, &q, &p.rho).z / legs.length(rod));
    let least = (0..4).min_by(|&a, &b| cosines[a].total_cmp(&cosines[b])).unwrap();
    let machine = machine(|limits, _| limits.serial_margin = cosines[least] + 1e-3);
    assert_eq!(worst(&machine, None), (Constraint::SerialSingularity, Element::Rod(rods[least])));
}

#[test]
fn a_parallel_singularity_names_the_platform() {
    // Near the edge of the workspace: in the middle det_P exceeds every limit there may be.
    let machine = machine(|limits, _| limits.parallel_margin = 0.99);
    let legs = Legs::of(&machine);
    let edge = hung(&legs, upright(&legs, 0.0, -400.0, 1250.0, 1.0).unwrap(), [1.0, 1.0]).unwrap();
    let margins = Margins::of(&machine, &edge.posture(&legs), None);
    let worst = margins.worst(&machine);
    assert!(worst.value < 0.0 && !margins.feasible(), "{worst:?}");
    assert_eq!((worst.constraint, worst.element), (Constraint::ParallelSingularity, Element::Platform));
}

#[test]
fn a_joint_margin_names_the_rod() {
    let narrow = machine(|limits, _| limits.slider_cone = 1e-3);
    let (constraint, element) = worst(&narrow, None);
    assert_eq!(constraint, Constraint::SliderJoint);
    assert!(matches!(element, Element::Rod(11 | 12 | 21 | 22 | 31 | 32)), "{element:?}");
    let narrow = machine(|limits, _| limits.platform_cone = 1e-3);
    let (constraint, element) = worst(&narrow, None);
    assert_eq!(constraint, Constraint::PlatformJoint);
    assert!(matches!(element, Element::Rod(11 | 12 | 21 | 22 | 31 | 32)), "{element:?}");
}

#[test]
fn rod_interference_names_the_pair() {
    let thick = machine(|_, geometry| geometry.rod_radius = 150.0);
    let margins = Margins::of(&thick, &posture(1250.0), None);
    let [a, b] = margins.nearest_rods;
    assert_eq!(worst(&thick, None), (Constraint::RodInterference, Element::Rods(a, b)));
}

#[test]
fn a_table_margin_names_its_range() {
    let machine = machine(|_, _| ());
    let at = |theta1: f64, theta2: f64| Some(TableAngles { theta1, theta2 });
    assert_eq!(worst(&machine, at(1.6, 0.0)), (Constraint::Tilt, Element::Range { high: true }));
    assert_eq!(worst(&machine, at(-1.6, 0.0)), (Constraint::Tilt, Element::Range { high: false }));
    assert_eq!(worst(&machine, at(0.0, 6.3)), (Constraint::Rotary, Element::Range { high: true }));
    assert_eq!(worst(&machine, at(0.0, -6.3)), (Constraint::Rotary, Element::Range { high: false }));
}
