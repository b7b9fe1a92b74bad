//! Workspaces of linear deltas against the closed forms of their circles. Where only the inclination of the rods to their
//! guideways binds, the domain is the intersection of three discs, about (-e1, 0), (-e2, p0) and (-e2, -p0).

use verne_solver::Machine;
use verne_solver::workspace::{Kind, Measure, Request, Unobserved, Volume, measure, surface};

use crate::column_lattice;
use crate::machines::changed;
use crate::requests::request;

/// A delta whose only limits are the rods' inclinations and leg I's stroke.
fn delta(rods: [f64; 3], serial_margin: f64) -> Machine {
    changed(|data| {
        data.geometry = Machine::linear_delta().data().geometry;
        let g = &mut data.geometry;
        [g.L1, g.L2, g.L3] = rods;
        g.rod_radius = 0.0;
        let limits = &mut data.limits;
        (limits.slider_cone, limits.platform_cone) = (std::f64::consts::PI, std::f64::consts::PI);
        (limits.serial_margin, limits.parallel_margin) = (serial_margin, 0.0);
        limits.stroke = [[0.0, 400.0], [-5000.0, 5000.0], [-5000.0, 5000.0]];
        limits.tilt = [-3.0, 3.0];
    })
}

/// Centres and radii of the discs.
fn discs(machine: &Machine) -> [([f64; 2], f64); 3] {
    let (g, margin) = (machine.data().geometry, machine.data().limits.serial_margin);
    let reach = |rod: f64| rod * (1.0 - margin * margin).sqrt();
    let [e1, e2, p0] = [g.D1 - g.d1, g.D2 - g.d2, g.R2 - g.r4];
    [([-e1, 0.0], reach(g.L1)), ([-e2, p0], reach(g.L2)), ([-e2, -p0], reach(g.L3))]
}

/// The area of an intersection of discs that has their arcs as its boundary, by Green's theorem: each arc is the part of a
/// circle within all other discs.
fn area_of_intersection(discs: &[([f64; 2], f64); 3]) -> f64 {
    let tau = std::f64::consts::TAU;
    let mut area = 0.0;
    for (i, &(centre, radius)) in discs.iter().enumerate() {
        let mut ends = vec![0.0, tau];
        for (j, &(other, reach)) in discs.iter().enumerate() {
            let [dx, dy] = [other[0] - centre[0], other[1] - centre[1]];
            let distance = dx.hypot(dy);
            let cosine = (radius * radius + distance * distance - reach * reach) / (2.0 * radius * distance);
            if i != j && cosine.abs() < 1.0 {
                let (middle, half) = (dy.atan2(dx), cosine.acos());
                ends.extend([(middle - half).rem_euclid(tau), (middle + half).rem_euclid(tau)]);
            }
        }
        ends.sort_by(f64::total_cmp);
        for arc in ends.windows(2) {
            let [from, to] = [arc[0], arc[1]];
            let middle = 0.5 * (from + to);
            let at = [centre[0] + radius * middle.cos(), centre[1] + radius * middle.sin()];
            let inside = |(j, (other, reach)): (usize, &([f64; 2], f64))| {
                j == i || (at[0] - other[0]).hypot(at[1] - other[1]) <= *reach
            };
            if discs.iter().enumerate().all(inside) {
                let turn = |t: f64| radius * (centre[0] * t.sin() - centre[1] * t.cos());
                area += 0.5 * (radius * radius * (to - from) + turn(to) - turn(from));
            }
        }
    }
    area
}

fn volume(measure: &Measure) -> [f64; 2] {
    match measure.volume {
        Volume::Value { value, error } => [value, error],
        Volume::Folded => panic!("folded"),
    }
}

#[test]
fn area_and_volume_are_those_of_the_circles() {
    for (rods, margin) in [([700.0; 3], 0.3), ([700.0, 760.0, 660.0], 0.45), ([640.0, 700.0, 700.0], 0.6)] {
        let machine = delta(rods, margin);
        let area = area_of_intersection(&discs(&machine));
        for kind in [Kind::Platform, Kind::Tool, Kind::Part] {
            let answer = measure(&machine, &request(kind, 60.0, 0.0, 1.0), &Unobserved).unwrap();
            assert!((answer.area - area).abs() <= 1e-9 * area, "{kind:?}: {} {area}", answer.area);
            let [value, error] = volume(&answer);
            // Columns are as high as leg I's stroke.
            assert!((value - 400.0 * area).abs() <= 1e-9 * value, "{kind:?}: {value} {}", 400.0 * area);
            assert!((value - 400.0 * area).abs() <= error.max(1e-12 * value), "{value} {error}");
            assert_eq!(answer.jacobian, Some([1.0, 1.0]));
            assert_eq!(answer.inclination, Some(0.0));
        }
    }
}

/// Thick rods bind: those of a parallelogram in its own direction, and those of different legs.
#[test]
fn areas_and_volumes_with_thick_rods_are_those_of_a_lattice() {
    let mut lost = 0.0;
    for (radius, half_width, direction) in [(36.0, 40.0, -30_f64), (25.0, 60.0, 20.0), (30.0, 70.0, -75.0)] {
        let machine = changed(|data| {
            *data = Machine::linear_delta().data().clone();
            let g = &mut data.geometry;
            (g.rod_radius, g.parallelogram_half_width) = (radius, half_width);
            g.parallelogram_direction = direction.to_radians();
            (g.D1, g.d1, g.D2, g.d2) = (200.0, 540.0, -100.0, -270.0);
            (g.R2, g.r4) = (173.0, 468.0);
        });
        let answer = measure(&machine, &request(Kind::Platform, 0.0, 0.0, 1.0), &Unobserved).unwrap();
        let rectangle = [[-400.0, -400.0], [400.0, 400.0]];
        let [area, brute] = column_lattice::area_and_volume(&machine, rectangle, 700);
        let thin = changed(|data| {
            *data = machine.data().clone();
            data.geometry.rod_radius = 0.0;
        });
        let without = measure(&thin, &request(Kind::Platform, 0.0, 0.0, 1.0), &Unobserved).unwrap().area;
        lost += without - area;
        assert!((answer.area - area).abs() < 5e-4 * area, "{} against {area}", answer.area);
        let [value, _] = volume(&answer);
        assert!((value - brute).abs() < 5e-4 * brute, "{value} against {brute}");
    }
    assert!(lost > 800.0, "the rods take {lost} mm²");
}

#[test]
fn the_built_in_delta_has_a_closed_surface_of_the_volume() {
    let machine = Machine::linear_delta();
    for kind in [Kind::Platform, Kind::Part] {
        let request: Request = request(kind, 50.0, 0.0, 2.0);
        let [value, error] = volume(&measure(&machine, &request, &Unobserved).unwrap());
        assert!(value > 1e7 && error < 1e-6 * value, "{value} {error}");
        let surface = surface(&machine, &request, &Unobserved).unwrap();
        let bounds = surface.bounds().unwrap();
        assert!(bounds[1].iter().zip(&bounds[0]).all(|(high, low)| high > low));
    }
}
