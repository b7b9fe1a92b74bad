//! Placement: the set-up in which a program keeps the greatest distance from the limits.
//!
//! The search begins from many set-ups with few places of the program, adds the places that a set-up would break, and
//! ends with plans: the answer's reserve is that of its plan, between the rows, too.

mod active;
mod criteria;
mod interior;
mod linear_program;
mod local_search;
mod problem;
mod search;
mod starts;
mod verdict;

pub use active::ActiveMargin;
pub(super) use criteria::Criteria;
pub(super) use interior::interior_set_ups;
pub(super) use problem::{Problem, cut_ranges};
pub(super) use starts::{even_numbers, representative};

use super::planned_places::PlannedPlaces;
use super::report::Report;
use super::set_up::{AdjustableProgram, SetUp};
use super::{PlanError, PlanOptions, plan};
use crate::limit::Constraint;
use crate::machine::Machine;
use crate::workspace::{Observer, Subprogress};
use problem::PARAMETERS;
use search::{Search, refined};
use verdict::Verdict;

/// Density of the places with which the search begins.
const DENSITY: f64 = 4.0;
/// Number of candidates that are planned.
const PLANNED: usize = 3;
/// Number of times that the best plan's own rows improve it.
const IMPROVEMENTS: usize = 5;
/// Gain of the reserve that ends the improvements.
const LEAST_GAIN: f64 = 1e-7;
/// Fractions of the work that the plan of the given set-up, the search, and each later plan take.
const SHARES: [f64; 3] = [0.1, 0.4, 0.0625];

/// What is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacementRequest {
    /// Bounds of each of [`SetUp::parameters`]; equal ones fix it. Millimetres and radians.
    pub bounds: [[f64; 2]; SetUp::PARAMETERS],
    /// The distance to keep from the limits of some constraints, positive, in the unit of the margin: mm, rad, or none.
    pub reserve: Vec<(Constraint, f64)>,
}

/// A set-up and what its plan says.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// The set-up.
    pub set_up: SetUp,
    /// The least ratio of a margin to its reserve in the plan. `None`: the machine does not reach all of the program,
    /// or the plan has no margin with a reserve.
    pub t: Option<f64>,
    /// The report of the plan.
    pub report: Report,
    /// The margins that limit t, and those without a reserve that are at their limits.
    pub active: Vec<ActiveMargin>,
    /// t of the given set-up, and whether the machine can run the program in it.
    pub given: (Option<f64>, bool),
    /// Number of set-ups from which the search began.
    pub starts: u32,
}

/// A plan, with its rows as places.
struct Planned {
    set_up: SetUp,
    report: Report,
    places: PlannedPlaces,
    verdict: Verdict,
}

/// The environment of a placement.
struct Placer<'a> {
    machine: &'a Machine,
    program: &'a dyn AdjustableProgram,
    request: &'a PlacementRequest,
    options: &'a PlanOptions,
    criteria: Criteria,
    observer: &'a dyn Observer,
}

/// Finds the set-up within bounds that maximises t, where every margin with a reserve is at least t times its reserve,
/// and every other margin at least zero.
///
/// The answer is the best that many starts find, not a proved optimum; it is planned with all its rows and checked
/// between them. It is never worse than the given set-up if that is within the bounds. It is the same on any number of
/// threads.
///
/// # Units
///
/// Millimetres and radians.
///
/// # Errors
///
/// [`PlanError`]
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): section IV.A for the margins; the
/// placement is not in the paper.
///
/// # Examples
///
/// ```
/// use verne_solver::toolpath::{
///     AdjustableProgram, Curve, Motion, MotionKind, Motions, PlacementRequest, PlanError, PlanOptions, SetUp,
///     ToolPosition, Turning, place,
/// };
/// use verne_solver::workspace::Unobserved;
/// use verne_solver::{Constraint, Machine};
///
/// /// A line of 200 mm in the program's own frame, which turns no part.
/// struct Line;
///
/// impl AdjustableProgram for Line {
///     fn motions(&self, set_up: &SetUp) -> Box<dyn Motions + '_> {
///         let [x, y, z] = set_up.origin;
///         let to = |kind, along| Motion {
///             kind,
///             end: ToolPosition { tip: [x + along, y, z], axis: [0.0, 0.0, 1.0] },
///             curve: Curve::Line,
///             turning: Turning::GreatCircle,
///             tool_length: set_up.tool_length,
///         };
///         Box::new(vec![to(MotionKind::Arrive, -100.0), to(MotionKind::Feed, 100.0)])
///     }
///
///     fn is_adjusted(&self, _: usize) -> bool {
///         true
///     }
///
///     fn stated(&self, set_up: &SetUp) -> SetUp {
///         *set_up
///     }
/// }
///
/// let given = SetUp { origin: [0.0, 0.0, 300.0], turn: 0.0, tool_length: 100.0 };
/// let mut request = PlacementRequest {
///     bounds: given.parameters().map(|fixed| [fixed; 2]),
///     reserve: vec![(Constraint::Stroke, 20.0)],
/// };
/// request.bounds[2] = [0.0, 800.0];
/// let options = PlanOptions::default();
/// let best = place(&Machine::verne(), &Line, given, &request, &options, &Unobserved)?;
/// assert!(best.report.is_feasible() && best.t > best.given.0);
/// # Ok::<(), PlanError>(())
/// ```
pub fn place(
    machine: &Machine,
    program: &dyn AdjustableProgram,
    given: SetUp,
    request: &PlacementRequest,
    options: &PlanOptions,
    observer: &dyn Observer,
) -> Result<Placement, PlanError> {
    let criteria = Criteria::new(machine, &request.reserve);
    let placer = Placer { machine, program, request, options, criteria, observer };
    let planned = placer.plan(given, [0.0, SHARES[0]])?;
    let begun = (planned.verdict.t, planned.report.is_feasible());
    let survey = PlannedPlaces::of_program(machine, program, given, options, DENSITY);
    let progress = Subprogress::new(observer, SHARES[0], SHARES[0] + SHARES[1]);
    let search = Search::new([false, true].map(|other| placer.problem(&survey, other, 0.0)), &progress);
    let (candidates, starts) = search.run(given)?;
    let candidates = candidates.into_iter().map(|candidate| candidate.set_up);
    let mut best = placer.is_within(&given).then_some(planned);
    let mut done = SHARES[0] + SHARES[1];
    let mut part = || {
        done += SHARES[2];
        [done - SHARES[2], done.min(1.0)]
    };
    for candidate in candidates.take(PLANNED) {
        let planned = placer.plan(candidate, part())?;
        if best.as_ref().is_none_or(|best| planned.verdict.is_better_than(&best.verdict)) {
            best = Some(planned);
        }
    }
    let Some(mut best) = best else { return Err(PlanError::Cancelled) };
    let mut guard = 0.0;
    for _ in 0..IMPROVEMENTS {
        let (set_up, missing) = placer.improved(&best, guard);
        let planned = placer.plan(set_up, part())?;
        let gain = planned.verdict.gain_over(&best.verdict);
        // A limit that holds at the rows may be broken between them.
        guard = if planned.verdict.is_feasible() { guard } else { guard.max(2.0 * planned.verdict.missing) };
        let is_better = planned.verdict.is_better_than(&best.verdict);
        if is_better {
            best = planned;
        }
        if !(gain > LEAST_GAIN || (!is_better && guard > missing)) {
            break;
        }
    }
    let active = active::active(&placer.problem(&best.places, false, 0.0), &best.report, best.verdict.t);
    observer.progress(1.0);
    let Planned { set_up, report, verdict, .. } = best;
    Ok(Placement { set_up, t: verdict.t, report, active, given: begun, starts })
}

impl Placer<'_> {
    fn is_within(&self, set_up: &SetUp) -> bool {
        let parameters = set_up.parameters();
        (0..PARAMETERS)
            .all(|i| (self.request.bounds[i][0]..=self.request.bounds[i][1]).contains(&parameters[i]))
    }

    /// Plans the program in a set-up. `[from, to]` is the part of the progress.
    fn plan(&self, set_up: SetUp, [from, to]: [f64; 2]) -> Result<Planned, PlanError> {
        let set_up = self.program.stated(&set_up);
        let motions = self.program.motions(&set_up);
        let mut places = PlannedPlaces::new(self.machine, &*motions, set_up, self.options);
        let mut tool = (usize::MAX, 0.0);
        let part = Subprogress::new(self.observer, from, to);
        let mut calls = 0_u32;
        let progress = |fraction| {
            calls = calls.wrapping_add(1);
            if calls % 64 != 1 {
                return true;
            }
            part.progress(fraction);
            !part.cancelled()
        };
        let report = plan(self.machine, &*motions, self.options, progress, |row| {
            if tool.0 != row.motion {
                tool = (row.motion, motions.motion(row.motion).tool_length);
            }
            places.push(row, tool.1, self.program);
        })?;
        let verdict = Verdict::of(self.machine, &report, &self.criteria);
        Ok(Planned { set_up, report, places, verdict })
    }

    /// A placement with the tracks of some places.
    fn problem<'p>(&'p self, places: &'p PlannedPlaces, other: bool, guard: f64) -> Problem<'p> {
        // Half a turn moves what is at this distance from the origin by the machine's longest dimension.
        let angle = 2.0 / self.machine.longest();
        Problem {
            machine: self.machine,
            places,
            criteria: &self.criteria,
            bounds: self.request.bounds,
            units: [1.0, 1.0, 1.0, angle, 1.0],
            other,
            guard,
            cuts: cut_ranges(places),
        }
    }

    /// The best set-up near that of a plan, by the tracks of its rows; and the guard with which it was found.
    fn improved(&self, planned: &Planned, guard: f64) -> (SetUp, f64) {
        let problem = self.problem(&planned.places, false, guard);
        let set = starts::representative(&planned.places);
        let (parameters, _) = refined(&problem, set, planned.set_up.parameters());
        (SetUp::of_parameters(parameters), guard)
    }
}
