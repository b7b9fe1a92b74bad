//! Areas of regions against a lattice of points, and against the whole window.

use verne_solver::Machine;
use verne_solver::atlas::{AtlasRequest, Space, Window, atlas};
use verne_solver::workspace::Unobserved;

use crate::comparison::{lattice_areas, region_areas};
use crate::machines::others;

const SPACES: [Space; 2] = [Space::Platform, Space::Joints];

#[test]
fn regions_are_the_window() {
    let machines = others().into_iter().map(|(_, machine)| machine).chain([Machine::linear_delta()]);
    for machine in machines {
        for space in SPACES {
            let window = Window { u: [-400.0, 250.0], v: [-100.0, 630.0] };
            for window in [None, Some(window)] {
                let request = AtlasRequest::new(&machine, space, window);
                let found = atlas(&machine, &request, &Unobserved).unwrap();
                let Window { u, v } = request.window;
                let whole = (u[1] - u[0]) * (v[1] - v[0]);
                let sum: f64 = found.regions.iter().map(|region| region.face.area).sum();
                assert!((sum - whole).abs() < 1e-9 * whole, "{sum} of {whole}");
            }
        }
    }
}

#[test]
fn areas_are_those_of_a_lattice() {
    const POINTS: u32 = 600;
    let wide = Window { u: [-2_500.0, 2_500.0], v: [-2_500.0, 2_500.0] };
    for (machine, space, window) in [
        (Machine::verne(), Space::Platform, None),
        (Machine::verne(), Space::Joints, None),
        (Machine::verne(), Space::Joints, Some(wide)),
        (Machine::linear_delta(), Space::Platform, None),
    ] {
        let request = AtlasRequest::new(&machine, space, window);
        let found = atlas(&machine, &request, &Unobserved).unwrap();
        let (expected, areas) = (lattice_areas(&machine, &request, POINTS), region_areas(&found));
        let Window { u, v } = request.window;
        let whole = (u[1] - u[0]) * (v[1] - v[0]);
        for number in 0..expected.len() {
            // A lattice of n² points is off by about n^-1.5.
            let off = (areas[number] - expected[number]).abs() / whole;
            assert!(off < 3e-4, "{space:?}, {number} solutions: {off}");
        }
    }
}

#[test]
fn area_errors_hold_against_a_finer_tolerance() {
    let machine = Machine::verne();
    for space in SPACES {
        let request = AtlasRequest::new(&machine, space, None);
        let fine = AtlasRequest { tolerance: 0.05 * request.tolerance, ..request };
        let coarse = AtlasRequest { tolerance: 10.0 * request.tolerance, ..request };
        let [fine, coarse] = [fine, coarse].map(|request| atlas(&machine, &request, &Unobserved).unwrap());
        let (expected, areas) = (region_areas(&fine), region_areas(&coarse));
        for number in 0..expected.len() {
            let regions = coarse.regions.iter().chain(&fine.regions);
            let error: f64 = regions
                .filter(|region| region.solutions == number)
                .map(|region| region.face.area_error)
                .sum();
            let off = (areas[number] - expected[number]).abs();
            assert!(off <= error, "{space:?}, {number} solutions: off by {off}, claimed {error}");
        }
    }
}
