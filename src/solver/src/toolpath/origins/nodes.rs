//! Some layers of the grid of origins, independent of the others.

use std::ops::Range;

use rayon::prelude::*;

use super::OriginSurvey;
use super::membership::Membership;
use crate::machine::Machine;
use crate::workspace::dexterity::{Crossing, EDGES};
use crate::workspace::observer::{ProgressCounter, check_cancelled};
use crate::workspace::{Observer, WorkspaceError};

/// Halvings of an edge. Its crossing is off by at most 1/512 of it; the vertices of the surface are moved anyway.
const HALVINGS: u32 = 8;

/// The nodes of some layers of the grid, and the crossings of the edges that begin at them with the region's surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OriginSlab {
    /// The layers along x.
    pub layers: Range<u32>,
    /// Whether each node belongs to the region.
    pub inside: Vec<bool>,
    /// The crossings, ascending by edge.
    pub crossings: Vec<Crossing>,
}

/// Computes some layers of the grid. A layer's result does not depend on which other layers belong to the slab. Layers
/// beyond the grid are left out.
///
/// # Units
///
/// Millimetres.
///
/// # Errors
///
/// [`WorkspaceError::Cancelled`]: the observer asked to stop.
pub fn origin_slab(
    machine: &Machine,
    survey: &OriginSurvey,
    layers: Range<u32>,
    observer: &dyn Observer,
) -> Result<OriginSlab, WorkspaceError> {
    let grid = &survey.grid;
    let layers = layers.start.min(grid.counts[0])..layers.end.min(grid.counts[0]);
    // The edges of the last layer end at the next.
    let examined = layers.start..(layers.end + 1).min(grid.counts[0]);
    let membership = survey.membership(machine);
    let progress = ProgressCounter::new(observer, 2 * examined.len());
    let mut slab = OriginSlab { layers: layers.clone(), ..OriginSlab::default() };
    let mut before: Option<Vec<Vec<bool>>> = None;
    for layer in examined {
        check_cancelled(observer)?;
        let rows = nodes(&membership, survey, layer, observer)?;
        progress.finished(1);
        if layers.contains(&layer) {
            slab.inside.extend(rows.iter().flatten());
        }
        if let Some(first) = before {
            slab.crossings.extend(crossings(&membership, survey, layer - 1, [&first, &rows], observer)?);
        }
        progress.finished(1);
        before = Some(rows);
    }
    Ok(slab)
}

fn nodes(
    membership: &Membership<'_>,
    survey: &OriginSurvey,
    layer: u32,
    observer: &dyn Observer,
) -> Result<Vec<Vec<bool>>, WorkspaceError> {
    let grid = &survey.grid;
    (0..grid.counts[1])
        .into_par_iter()
        .map(|j| {
            let mut hint = 0;
            (0..grid.counts[2])
                .map(|k| {
                    check_cancelled(observer)?;
                    let number = [layer, j, k];
                    Ok(!grid.outermost(number) && membership.contains(grid.node(number), &mut hint))
                })
                .collect()
        })
        .collect()
}

/// The crossings of the edges that begin in a layer, given its rows and the next layer's.
fn crossings(
    membership: &Membership<'_>,
    survey: &OriginSurvey,
    layer: u32,
    rows: [&[Vec<bool>]; 2],
    observer: &dyn Observer,
) -> Result<Vec<Crossing>, WorkspaceError> {
    let grid = &survey.grid;
    let [_, across, up] = grid.counts;
    let found: Vec<Vec<Crossing>> = (0..across)
        .into_par_iter()
        .map(|j| {
            let (mut found, mut hint) = (Vec::new(), 0);
            for k in 0..up {
                check_cancelled(observer)?;
                let starts_inside = rows[0][j as usize][k as usize];
                for (direction, steps) in (0_u64..).zip(EDGES) {
                    let [di, dj, dk] = steps;
                    let row = rows[di as usize].get((j + dj) as usize);
                    let Some(&end) = row.and_then(|row| row.get((k + dk) as usize)) else { continue };
                    if starts_inside == end {
                        continue;
                    }
                    let start = grid.node([layer, j, k]);
                    let along = |fraction: f64| {
                        [0, 1, 2].map(|axis| start[axis] + grid.step * fraction * f64::from(steps[axis]))
                    };
                    let (mut low, mut high) = (0.0, 1.0);
                    for _ in 0..HALVINGS {
                        let middle = 0.5 * (low + high);
                        if membership.contains(along(middle), &mut hint) == starts_inside {
                            low = middle;
                        } else {
                            high = middle;
                        }
                    }
                    let node =
                        (u64::from(layer) * u64::from(across) + u64::from(j)) * u64::from(up) + u64::from(k);
                    found.push(Crossing { edge: 7 * node + direction, at: along(0.5 * (low + high)) });
                }
            }
            Ok(found)
        })
        .collect::<Result<_, WorkspaceError>>()?;
    Ok(found.into_iter().flatten().collect())
}
