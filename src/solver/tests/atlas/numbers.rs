//! Numbers of solutions in regions, and the working mode's domain.

use verne_solver::Machine;
use verne_solver::atlas::{AtlasRequest, Space, Window, atlas};
use verne_solver::workspace::Unobserved;

use crate::comparison::{Comparison, compare_numbers, compare_working};
use crate::machines::{others, spread};
use crate::random::Random;

const SPACES: [Space; 2] = [Space::Platform, Space::Joints];
/// Points in each window.
const POINTS: usize = 3_000;

/// Both comparisons of a machine agree in the default window and in a wide one, and few points are too near to a
/// curve to be compared.
fn check(name: &str, machine: &Machine) {
    let wide = [-2.5 * machine.longest(), 2.5 * machine.longest()];
    for (space, window) in SPACES.map(|space| (space, None)).into_iter().chain([(Space::Joints, Some(wide))])
    {
        let window = window.map(|range| Window { u: range, v: range });
        let request = AtlasRequest::new(machine, space, window);
        let found =
            atlas(machine, &request, &Unobserved).unwrap_or_else(|e| panic!("{name}, {space:?}: {e}"));
        let comparisons = [
            compare_numbers(machine, &request, &found, POINTS),
            compare_working(machine, &request, &found, POINTS),
        ];
        for Comparison { compared, wrong, .. } in comparisons {
            assert!(wrong.is_empty(), "{name}, {space:?}: {} points such as {:?}", wrong.len(), wrong[0]);
            assert!(compared > POINTS * 3 / 4, "{name}, {space:?}: {compared}");
        }
    }
}

#[test]
fn regions_have_the_solvers_numbers_on_the_reference_machine() {
    check("verne", &Machine::verne());
}

#[test]
fn regions_have_the_solvers_numbers_on_machines_unlike_it() {
    for (name, machine) in others() {
        check(name, &machine);
    }
}

#[test]
fn regions_have_the_solvers_numbers_on_random_machines() {
    let mut draw = Random::new(21);
    for i in 0..20 {
        let machine =
            if i % 2 == 0 { draw.machine() } else { spread(&mut draw).unwrap_or_else(Machine::verne) };
        check(&format!("machine {i}, {:?}", machine.data().geometry), &machine);
    }
}
