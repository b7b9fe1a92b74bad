//! Linear deltas, machines with equal offsets, and machines near them.

use verne_solver::Machine;
use verne_solver::atlas::{AtlasError, AtlasRequest, Space, SpecialMachine, Window, atlas};
use verne_solver::workspace::Unobserved;

use crate::comparison::{Comparison, compare_numbers, compare_working};
use crate::machines::{changed, near_the_edge};
use crate::random::Random;

const SPACES: [Space; 2] = [Space::Platform, Space::Joints];
const POINTS: usize = 500;

/// A machine with R1/r1 - 1 and (e1 - e2)/L1 as they are given.
fn machine(from_delta: Option<f64>, from_equal: Option<f64>) -> Machine {
    changed(|data| {
        let g = &mut data.geometry;
        if let Some(difference) = from_delta {
            g.R1 = g.r1 * (1.0 + difference);
        }
        if let Some(difference) = from_equal {
            (g.D1, g.d1, g.D2, g.d2) = (0.0, 512.0, 0.0, 512.0 + difference * 1024.0);
        }
    })
}

/// Whether the answer agrees with the solver in the default window and, if it is special itself, in a wide one; or the
/// error.
fn check(machine: &Machine, space: Space, is_special: bool) -> Result<(), AtlasError> {
    check_window(machine, &AtlasRequest::new(machine, space, None))?;
    if is_special {
        let range = [-1.6 * machine.longest(), 1.6 * machine.longest()];
        let window = Window { u: range, v: range };
        check_window(machine, &AtlasRequest::new(machine, space, Some(window)))?;
    }
    Ok(())
}

fn check_window(machine: &Machine, request: &AtlasRequest) -> Result<(), AtlasError> {
    let (request, space) = (*request, request.space);
    let found = atlas(machine, &request, &Unobserved)?;
    let comparisons = [
        compare_numbers(machine, &request, &found, POINTS),
        compare_working(machine, &request, &found, POINTS),
    ];
    for Comparison { compared, wrong, .. } in comparisons {
        assert!(wrong.is_empty(), "{space:?}: {} points such as {:?}", wrong.len(), wrong[0]);
        assert!(compared > POINTS * 3 / 4, "{space:?}: {compared}");
    }
    Ok(())
}

#[test]
fn linear_deltas_have_an_atlas() {
    for machine in [Machine::linear_delta(), machine(Some(0.0), None)] {
        for space in SPACES {
            assert_eq!(check(&machine, space, true), Ok(()), "{space:?}");
        }
    }
}

#[test]
fn machines_with_equal_offsets_have_an_atlas() {
    for machine in [machine(None, Some(0.0)), machine(Some(0.0), Some(0.0))] {
        for space in SPACES {
            assert_eq!(check(&machine, space, true), Ok(()), "{space:?}");
        }
    }
}

#[test]
fn machines_near_the_special_ones_are_right_or_refused_by_name() {
    for difference in [1e-9, 1e-6, 1e-3] {
        for (machine, near) in [
            (machine(Some(difference), None), SpecialMachine::LinearDelta),
            (machine(None, Some(difference)), SpecialMachine::EqualOffsets),
        ] {
            assert_eq!(check(&machine, Space::Platform, false), Ok(()), "{near:?}, {difference}");
            match check(&machine, Space::Joints, false) {
                Ok(()) => {}
                Err(AtlasError::TooFine { near: named } | AtlasError::Disagreement { near: named }) => {
                    assert_eq!(named, Some(near), "{difference}");
                }
                Err(other) => panic!("{near:?}, {difference}: {other}"),
            }
        }
    }
}

#[test]
fn random_machines_near_the_special_ones_are_right_or_refused_by_name() {
    let mut draw = Random::new(0xED6E);
    for _ in 0..8 {
        let Some(machine) = near_the_edge(&mut draw) else { continue };
        for space in SPACES {
            match check(&machine, space, false) {
                Ok(()) => {}
                Err(error) => {
                    let g = machine.data().geometry;
                    let named = [SpecialMachine::LinearDelta, SpecialMachine::EqualOffsets].map(Some);
                    let (AtlasError::TooFine { near } | AtlasError::Disagreement { near }) = error else {
                        panic!("{g:?}, {space:?}: {error}")
                    };
                    assert!(named.contains(&near), "{g:?}, {space:?}: {error}");
                }
            }
        }
    }
}
