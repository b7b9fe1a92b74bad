//! The margins that limit a placement.

use rayon::prelude::*;

use super::criteria::Criteria;
use super::problem::{Problem, number};
use crate::limit::{Constraint, Element, Margin};
use crate::toolpath::report::Report;

/// Greatest number of margins in the answer.
const MOST: usize = 24;
/// Excess over the least value of a margin that counts as active: in fractions of a range, and of the least value.
const NEAR: f64 = 1e-6;
const NEAR_FRACTION: f64 = 1e-4;
/// Places that one task examines.
const PLACES_PER_TASK: usize = 4096;

/// A margin at the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveMargin {
    /// Index of the motion.
    pub motion: usize,
    /// The margin.
    pub margin: Margin,
    /// The reserve of its constraint; `None`: the margin is to be at least zero.
    pub reserve: Option<f64>,
}

/// The active margins of a plan at its rows, worst first: those that limit t, and those without a reserve that are zero
/// or less. Of each motion and element the worst.
pub(super) fn active(problem: &Problem<'_>, report: &Report, t: Option<f64>) -> Vec<ActiveMargin> {
    let (criteria, places) = (problem.criteria, problem.places);
    let all: Vec<u32> = (0..places.places.len()).map(number).collect();
    let least = t.map_or(f64::NEG_INFINITY, |t| t * criteria.unit);
    let near = if least.is_finite() { NEAR.max(NEAR_FRACTION * least.abs()) } else { NEAR };
    let parts: Vec<Vec<(f64, ActiveMargin)>> = all
        .par_chunks(PLACES_PER_TASK)
        .map(|part| {
            let mut found = Vec::new();
            places.margins(problem.machine, part, (&places.set_up, false), |i, margins| {
                let Ok(margins) = margins else { return };
                let place = &places.places[part[i] as usize];
                let values = criteria.values(problem.machine, Ok(margins));
                for (index, value) in values.into_iter().enumerate() {
                    let limit = if criteria.has_reserve[index] { least } else { 0.0 };
                    if value <= limit + near
                        && let Some(margin) = Criteria::margin(index, margins)
                    {
                        let reserve = criteria.reserve(margin.constraint);
                        found.push((value - limit, ActiveMargin { motion: place.motion, margin, reserve }));
                    }
                }
            });
            found
        })
        .collect();
    let mut found: Vec<(f64, ActiveMargin)> = parts.into_iter().flatten().collect();
    found.extend(rotary(criteria, report, least));
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.motion.cmp(&b.1.motion)));
    let mut active: Vec<ActiveMargin> = Vec::new();
    for (_, margin) in found {
        let is_known = active.iter().any(|known| {
            known.motion == margin.motion
                && (known.margin.constraint, known.margin.element)
                    == (margin.margin.constraint, margin.margin.element)
        });
        if !is_known && active.len() < MOST {
            active.push(margin);
        }
    }
    active
}

/// The least margin of the rotary axis, if it is active.
fn rotary(criteria: &Criteria, report: &Report, least: f64) -> Option<(f64, ActiveMargin)> {
    let of_plan = report.least.iter().find(|least| least.margin.constraint == Constraint::Rotary)?;
    let margin = of_plan.margin;
    let limit = if criteria.rotary_has_reserve { least } else { 0.0 };
    let value = margin.value * criteria.rotary;
    let is_range = matches!(margin.element, Element::Range { .. });
    (is_range && value <= limit + NEAR).then(|| {
        let reserve = criteria.reserve(Constraint::Rotary);
        (value - limit, ActiveMargin { motion: of_plan.motion, margin, reserve })
    })
}
