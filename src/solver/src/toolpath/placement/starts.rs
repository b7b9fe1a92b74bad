//! Places that represent a program, and set-ups from which searches begin.

use super::problem::{PARAMETERS, Problem, number};
use crate::toolpath::planned_places::{PlannedPlace, PlannedPlaces};

/// Number of directions in the space of positions and axes, in each of which the farthest place is taken.
const DIRECTIONS: u32 = 96;
/// Number of places that are taken at equal distances along the program.
const ALONG: usize = 64;
/// Numbers whose multiples fill a cube of dimension d evenly: powers of the inverse of the root of x^(d + 1) = x + 1.
const DIMENSIONS: usize = 6;

/// The places with which the search begins, ascending.
pub(in crate::toolpath) fn representative(places: &PlannedPlaces) -> Vec<u32> {
    let all = &places.places;
    if all.len() <= 2 * ALONG {
        return (0..all.len()).map(number).collect();
    }
    let mut found: Vec<u32> = (0..ALONG).map(|i| number(i * (all.len() - 1) / (ALONG - 1))).collect();
    let [low, high] = extent(all);
    let scale: [f64; DIMENSIONS] = std::array::from_fn(|i| {
        let width = high[i] - low[i];
        if width > 0.0 { 1.0 / width } else { 0.0 }
    });
    let directions: Vec<[f64; DIMENSIONS]> = (0..DIRECTIONS)
        .map(|i| {
            let even = even_numbers::<DIMENSIONS>(i);
            std::array::from_fn(|axis| (2.0 * even[axis] - 1.0) * scale[axis])
        })
        .collect();
    let mut farthest = vec![(f64::NEG_INFINITY, 0_u32); directions.len()];
    for (index, place) in all.iter().enumerate() {
        let at = coordinates(place);
        for (farthest, direction) in farthest.iter_mut().zip(&directions) {
            let along = (0..DIMENSIONS).map(|axis| at[axis] * direction[axis]).sum();
            if along > farthest.0 {
                *farthest = (along, number(index));
            }
        }
    }
    found.extend(farthest.into_iter().map(|(_, place)| place));
    found.sort_unstable();
    found.dedup();
    found
}

/// Position and axis.
fn coordinates(place: &PlannedPlace) -> [f64; DIMENSIONS] {
    let [x, y, z] = place.tip;
    let ((s1, c1), (s2, c2)) = (place.phi1.sin_cos(), place.phi2.sin_cos());
    [x, y, z, s1 * s2, -s1 * c2, c1]
}

fn extent(all: &[PlannedPlace]) -> [[f64; DIMENSIONS]; 2] {
    let none = [[f64::INFINITY; DIMENSIONS], [f64::NEG_INFINITY; DIMENSIONS]];
    all.iter().fold(none, |[low, high], place| {
        let at = coordinates(place);
        [std::array::from_fn(|i| low[i].min(at[i])), std::array::from_fn(|i| high[i].max(at[i]))]
    })
}

/// Set-ups that fill the bounds evenly.
pub(super) fn even_set_ups(problem: &Problem<'_>, count: u32) -> Vec<[f64; PARAMETERS]> {
    (0..count)
        .map(|i| {
            let even = even_numbers::<PARAMETERS>(i);
            std::array::from_fn(|axis| {
                let [low, high] = problem.bounds[axis];
                low + (high - low) * even[axis]
            })
        })
        .collect()
}

/// The i-th of a sequence of points that fill the unit cube evenly.
pub(in crate::toolpath) fn even_numbers<const N: usize>(i: u32) -> [f64; N] {
    let mut root = 1.5_f64;
    let dimension = u32::try_from(N).unwrap_or(1);
    for _ in 0..64 {
        root = (1.0 + root).powf(1.0 / f64::from(dimension + 1));
    }
    let mut step = 1.0;
    std::array::from_fn(|_| {
        step /= root;
        (0.5 + step * f64::from(i + 1)).fract()
    })
}
