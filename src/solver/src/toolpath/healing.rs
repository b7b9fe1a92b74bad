//! The smallest change of the set-up or of the tool that lets the machine follow a failing stretch.

use super::motion::{Curve, Motion, MotionKind, Motions};
use super::report::Failure;
use super::{OnLimit, PlanOptions, plan};
use crate::limit::Constraint;
use crate::machine::Machine;

/// Greatest number of motions of a stretch that is examined.
pub const MOST_HEALED_MOTIONS: usize = 2_000;
/// Greatest number of rows of such a stretch.
pub const MOST_HEALED_ROWS: u64 = 20_000;
/// Greatest change that is examined, mm.
pub const GREATEST_CHANGE: f64 = 512.0;
/// Least change that is examined, and the width to which a change is refined, mm.
pub const CHANGE_RESOLUTION: f64 = 1.0 / 64.0;
/// Ratio of a change to the next smaller one.
const GROWTH: f64 = 2.0;
/// Every parameter.
const PARAMETERS: [Parameter; 4] = [Parameter::X, Parameter::Y, Parameter::Z, Parameter::ToolLength];

/// What is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// The set-up's translation along X of the part frame.
    X,
    /// Along Y.
    Y,
    /// Along Z.
    Z,
    /// The length of the tool. The path of the tool's end stays.
    ToolLength,
}

/// A change of one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// The parameter.
    pub parameter: Parameter,
    /// What is added to it, mm.
    pub delta: f64,
}

/// Finds the smallest change of one parameter with which the machine can follow the motions of a failure, between the
/// rows, too.
///
/// The changes ±1/64, ±1/32, ±1/16, … ±512 mm are tried, and those of the first size that help are refined by
/// bisection to 1/64 mm. So a smaller change may help too, if it lies between two that do not. If the motions fail
/// only together with the rest of their cut, the change heals the whole cut. `None`: no change helps, `go_on` has
/// returned `false`, the stretch has more than [`MOST_HEALED_MOTIONS`] motions or [`MOST_HEALED_ROWS`] rows, or it
/// fails only together with the rest of the program. The rotary axis turns with the tool's axis alone, so nothing
/// heals a failure at its limit.
///
/// # Units
///
/// Millimetres.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::toolpath::{
///     Curve, Motion, MotionKind, Parameter, PlanOptions, ToolPosition, Turning, healing_change, plan,
/// };
///
/// let to = |kind, x| Motion {
///     kind,
///     end: ToolPosition { tip: [x, 0.0, 800.0], axis: [0.0, 0.0, 1.0] },
///     curve: Curve::Line,
///     turning: Turning::GreatCircle,
///     tool_length: 100.0,
/// };
/// // So high that the sliders would leave their strokes.
/// let program = [to(MotionKind::Arrive, -20.0), to(MotionKind::Feed, 20.0)];
/// let (machine, options) = (Machine::verne(), PlanOptions::default());
/// let report = plan(&machine, &program[..], &options, |_| true, |_| {})?;
/// let change = healing_change(&machine, &program[..], &options, &report.failures[0], || true);
/// assert!(change.is_some_and(|change| change.parameter == Parameter::Z && change.delta < 0.0));
/// # Ok::<(), verne_solver::toolpath::PlanError>(())
/// ```
pub fn healing_change<M: Motions + ?Sized>(
    machine: &Machine,
    motions: &M,
    options: &PlanOptions,
    failure: &Failure,
    go_on: impl Fn() -> bool,
) -> Option<Change> {
    let [first, last] = failure.motions;
    if is_at_rotary_limit(failure)
        || last >= motions.count()
        || last.checked_sub(first)? >= MOST_HEALED_MOTIONS
    {
        return None;
    }
    let most_rows = options.most_rows.min(MOST_HEALED_ROWS);
    let options = PlanOptions { on_limit: OnLimit::Fail, most_rows, ..options.clone() };
    let planned = |[first, last]: [usize; 2], change| {
        let changed = Changed { motions, begin: first.saturating_sub(1), end: last, change };
        let options = PlanOptions { start: options.start.filter(|_| first == 0), ..options };
        plan(machine, &changed, &options, |_| go_on(), |_| {})
    };
    let follows = |range, change| planned(range, change).is_ok_and(|report| report.is_feasible());
    let at = |parameter, delta| Change { parameter, delta };
    let none = at(Parameter::X, 0.0);
    let mut range = failure.motions;
    if follows(range, none) {
        // On a preimage or winding that does not serve the rest of the cut.
        range = cut_around(motions, range)?;
        let report = planned(range, none).ok()?;
        if report.is_feasible() || report.failures.iter().any(is_at_rotary_limit) {
            return None;
        }
    }
    // Most changes do not even heal the worst motion.
    let heals = |change: Change| follows([failure.motion; 2], change) && follows(range, change);
    let mut size = CHANGE_RESOLUTION;
    while size <= GREATEST_CHANGE && go_on() {
        let all = PARAMETERS.into_iter().flat_map(|parameter| [at(parameter, size), at(parameter, -size)]);
        let healing = all.filter(|change| heals(*change));
        let least = healing.map(|change| refined(change, &heals));
        if let Some(least) = least.min_by(|a, b| a.delta.abs().total_cmp(&b.delta.abs())) {
            return Some(least);
        }
        size *= GROWTH;
    }
    None
}

fn is_at_rotary_limit(failure: &Failure) -> bool {
    failure.margin.constraint == Constraint::Rotary
}

/// The whole cut around some of its motions; `None` if it is too long.
fn cut_around<M: Motions + ?Sized>(motions: &M, [first, last]: [usize; 2]) -> Option<[usize; 2]> {
    let is_feed = |index: &usize| motions.motion(*index).kind == MotionKind::Feed;
    let before = (0..first).rev().take(MOST_HEALED_MOTIONS).take_while(is_feed).count();
    let after = (last + 1..motions.count()).take(MOST_HEALED_MOTIONS).take_while(is_feed).count();
    let range = [first - before, last + after];
    (range[1] - range[0] < MOST_HEALED_MOTIONS).then_some(range)
}

/// The least change between half of one that heals and it.
fn refined(change: Change, heals: &impl Fn(Change) -> bool) -> Change {
    let with = |delta: f64| Change { delta, ..change };
    let (mut fails, mut found) = (change.delta / GROWTH, change.delta);
    while (found - fails).abs() > CHANGE_RESOLUTION {
        let middle = 0.5 * (fails + found);
        if heals(with(middle)) { found = middle } else { fails = middle }
    }
    with(found)
}

/// A stretch of a program with a change.
struct Changed<'a, M: ?Sized> {
    motions: &'a M,
    begin: usize,
    end: usize,
    change: Change,
}

impl<M: Motions + ?Sized> Motions for Changed<'_, M> {
    fn count(&self) -> usize {
        self.end + 1 - self.begin
    }

    fn motion(&self, index: usize) -> Motion {
        let mut motion = self.motions.motion(self.begin + index);
        if index == 0 {
            motion.kind = MotionKind::Arrive;
        }
        let Change { parameter, delta } = self.change;
        let axis = match parameter {
            Parameter::X => 0,
            Parameter::Y => 1,
            Parameter::Z => 2,
            Parameter::ToolLength => {
                motion.tool_length += delta;
                return motion;
            }
        };
        motion.end.tip[axis] += delta;
        if let Curve::Arc { centre, .. } = &mut motion.curve {
            centre[axis] += delta;
        }
        motion
    }
}
