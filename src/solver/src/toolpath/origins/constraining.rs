//! The places of a program that limit the region of origins.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::cut_windings::Windings;
use super::membership::Membership;
use crate::machine::Machine;
use crate::pose::Point;
use crate::toolpath::placement::{Criteria, Problem, even_numbers, representative};
use crate::toolpath::planned_places::PlannedPlaces;
use crate::toolpath::set_up::SetUp;
use crate::workspace::observer::check_cancelled;
use crate::workspace::{Observer, WorkspaceError};

/// Greatest number of places all of which are examined everywhere.
const ALL: usize = 1_000;
/// Number of directions from an interior origin in which the boundary is examined with all places.
const DIRECTIONS: u32 = 128;
/// Greatest number of times that places are added, and how many for each direction.
const ROUNDS: usize = 8;
const ADDED: usize = 4;
/// Steps of the search for the boundary: doublings from this length, mm, and halvings.
const FIRST: f64 = 4.0;
const DOUBLINGS: u32 = 12;
const HALVINGS: u32 = 24;

/// The places that limit the region around interior origins, ascending. Each origin has its preimage.
///
/// On the boundary that some places give, in many directions, all places are examined; those that exclude it are added,
/// until there are none.
pub(super) fn constraining_places(
    machine: &Machine,
    places: &PlannedPlaces,
    windings: &[Windings],
    interior: &[(Point, bool)],
    observer: &dyn Observer,
) -> Result<Vec<u32>, WorkspaceError> {
    let count = u32::try_from(places.places.len()).unwrap_or(u32::MAX);
    if places.places.len() <= ALL {
        return Ok((0..count).collect());
    }
    let criteria = Criteria::new(machine, &[]);
    let mut set = representative(places);
    for _ in 0..ROUNDS {
        let before = set.len();
        for (origin, other) in interior {
            check_cancelled(observer)?;
            let boundary = boundary(machine, places, &set, windings, *origin);
            let problem = Problem {
                machine,
                places,
                criteria: &criteria,
                bounds: [[0.0; 2]; SetUp::PARAMETERS],
                units: [1.0; SetUp::PARAMETERS],
                other: *other,
                guard: 0.0,
                cuts: Vec::new(),
            };
            for at in boundary {
                check_cancelled(observer)?;
                let set_up = SetUp { origin: at, ..places.set_up };
                let mut worse: Vec<(f64, u32)> = problem
                    .worst_places(&set_up)
                    .into_iter()
                    .filter(|(.., value)| *value < 0.0)
                    .map(|(place, _, value)| (value, place))
                    .collect();
                worse.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                set.extend(worse.into_iter().take(ADDED).map(|(_, place)| place));
            }
        }
        set.sort_unstable();
        set.dedup();
        if set.len() == before {
            break;
        }
    }
    Ok(set)
}

/// The last origins inside in directions that fill the sphere evenly.
fn boundary(
    machine: &Machine,
    places: &PlannedPlaces,
    set: &[u32],
    windings: &[Windings],
    origin: Point,
) -> Vec<Point> {
    let membership = Membership::new(machine, places, set, windings);
    (0..DIRECTIONS)
        .into_par_iter()
        .map(|number| {
            let [height, azimuth] = even_numbers::<2>(number);
            let (z, (s, c)) = (2.0 * height - 1.0, (TAU * azimuth).sin_cos());
            let across = (1.0 - z * z).max(0.0).sqrt();
            let direction = [across * c, across * s, z];
            let at = |distance: f64| std::array::from_fn(|i| origin[i] + distance * direction[i]);
            let mut hint = 0;
            let (mut inside, mut outside) = (0.0, FIRST);
            for _ in 0..DOUBLINGS {
                if !membership.contains(at(outside), &mut hint) {
                    break;
                }
                (inside, outside) = (outside, 2.0 * outside);
            }
            for _ in 0..HALVINGS {
                let middle = 0.5 * (inside + outside);
                if membership.contains(at(middle), &mut hint) { inside = middle } else { outside = middle }
            }
            at(inside)
        })
        .collect()
}
