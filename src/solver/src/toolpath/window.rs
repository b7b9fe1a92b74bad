//! Window: the values of one parameter of a program, such as the tool's length, with which the machine can run it.
//!
//! The verdict about a value is always that of a plan of the whole program. Plans of a long program take seconds, so
//! the margins at the places of its exact path, which take milliseconds, say first where windows may be.

mod guided;
mod intervals;
mod place_margins;
mod program;
mod refine;
mod sample;
mod scan;
mod search;

pub use intervals::{Window, WindowInterval};
pub use program::ParametricProgram;
pub use sample::WINDOW_PRECISION;

use super::{PlanError, PlanOptions};
use crate::machine::Machine;
use crate::workspace::{Observer, Subprogress};
use intervals::intervals;
use scan::ScanSettings;
use search::{SCANNED, Search};

/// Number of motions above which the places of the path say where windows may be.
const LONG: usize = 4_000;
/// Scan with plans. An interval of values is divided until it cannot contain both verdicts, or is this fraction of the
/// range.
const PLANS: ScanSettings = ScanSettings { intervals: 32, least: 1.0 / 4096.0, most: 2_000 };

/// Finds the intervals within a range of a parameter in which the machine can run the whole program: every limit holds
/// on the exact path and on the rows of the plan, as for [`plan`](super::plan).
///
/// The ends are verified by plans of the whole program: with the end the machine can run it, and with a value at most
/// [`WINDOW_PRECISION`] outside it cannot. Between examined values the worst margin is assumed to change at most twice
/// as fast as between the values around; where it then might change its sign, the values are examined closer and
/// closer, down to `resolution`. So narrower intervals and gaps may be missed, and wider ones only where a margin
/// changes faster than that. The answer is the same on any number of threads.
///
/// # Units
///
/// Those of the program's parameter.
///
/// # Errors
///
/// [`PlanError`]
///
/// # References
///
/// Oliveira, Takahashi 2021, [doi:10.1145/3423597](https://doi.org/10.1145/3423597): the root finder of the ends.
/// Piyavskii 1972, [doi:10.1016/0041-5553(72)90115-2](https://doi.org/10.1016/0041-5553(72)90115-2): bounds from
/// slopes.
///
/// # Examples
///
/// ```
/// use verne_solver::toolpath::{
///     AdjustableProgram, Curve, Motion, MotionKind, Motions, ParametricProgram, PlanError, PlanOptions, SetUp,
///     ToolPosition, Turning, window,
/// };
/// use verne_solver::workspace::Unobserved;
/// use verne_solver::{Constraint, Machine};
///
/// /// A line of 200 mm with a tool of any length.
/// struct Line;
///
/// impl ParametricProgram for Line {
///     fn motions(&self, tool_length: f64) -> Box<dyn Motions + '_> {
///         let to = |kind, x| Motion {
///             kind,
///             end: ToolPosition { tip: [x, 0.0, 300.0], axis: [0.0, 0.0, 1.0] },
///             curve: Curve::Line,
///             turning: Turning::GreatCircle,
///             tool_length,
///         };
///         Box::new(vec![to(MotionKind::Arrive, -100.0), to(MotionKind::Feed, 100.0)])
///     }
///
///     fn adjustable(&self) -> Option<(&dyn AdjustableProgram, [SetUp; 2])> {
///         None
///     }
/// }
///
/// let (machine, options) = (Machine::verne(), PlanOptions::default());
/// let found = window(&machine, &Line, [0.0, 1000.0], &options, &Unobserved)?;
/// let [interval] = &found.intervals[..] else { panic!("one interval") };
/// let [None, Some(end)] = interval.ends else { panic!("the strokes end the window") };
/// assert_eq!(end.margin.constraint, Constraint::Stroke);
/// # Ok::<(), PlanError>(())
/// ```
pub fn window(
    machine: &Machine,
    program: &dyn ParametricProgram,
    range: [f64; 2],
    options: &PlanOptions,
    observer: &dyn Observer,
) -> Result<Window, PlanError> {
    let search = Search { machine, program, options, observer };
    let adjustable = program.adjustable().filter(|_| program.motions(range[0]).count() > LONG);
    let found = match adjustable {
        Some(adjustable) => search.guided(range, adjustable)?,
        None => search.scanned(range, &PLANS, &Subprogress::new(observer, 0.0, SCANNED))?,
    };
    intervals(&search, range, found)
}
