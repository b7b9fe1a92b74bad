//! Set-ups in which a program is far from all limits.

use super::criteria::Criteria;
use super::problem::{PARAMETERS, Problem, cut_ranges};
use super::search::{Candidate, Search};
use crate::machine::Machine;
use crate::toolpath::PlanError;
use crate::toolpath::planned_places::PlannedPlaces;
use crate::workspace::{Observer, Subprogress};

/// The set-ups within bounds, best first, in which the least margin of all places, as a fraction of its range, is
/// greatest and positive. The range of the rotary axis takes no part.
pub(in crate::toolpath) fn interior_set_ups(
    machine: &Machine,
    places: &PlannedPlaces,
    bounds: [[f64; 2]; PARAMETERS],
    observer: &dyn Observer,
) -> Result<Vec<Candidate>, PlanError> {
    let criteria = Criteria::fractions(machine);
    let problem = |other| Problem {
        machine,
        places,
        criteria: &criteria,
        bounds,
        units: [1.0; PARAMETERS],
        other,
        guard: 0.0,
        cuts: if criteria.rotary_has_reserve { cut_ranges(places) } else { Vec::new() },
    };
    let progress = Subprogress::new(observer, 0.0, 1.0);
    let (found, _) = Search::new([problem(false), problem(true)], &progress).run(places.set_up)?;
    Ok(found.into_iter().filter(|candidate| candidate.score.merit() > 0.0).collect())
}
