//! Tool paths: from the motions of a program to joint motion.
//!
//! [`plan`] chooses preimage, winding and working solution for a whole program, divides the motions into rows between
//! which a controller may move the joints linearly, and reports where the machine's limits are broken. [`Timer`] finds
//! the times of the rows.

mod azimuth;
mod bound;
mod cap;
mod choice;
mod differential;
mod golden_section;
mod healing;
mod joint_segment;
mod linearise;
mod meridian;
mod motion;
mod nearby_pose;
mod node;
mod origins;
mod path;
mod placement;
mod planned_places;
mod report;
mod rows;
mod set_up;
mod start;
mod stretches;
mod timing;
mod window;

use std::fmt;

pub use healing::{
    CHANGE_RESOLUTION, Change, GREATEST_CHANGE, MOST_HEALED_MOTIONS, MOST_HEALED_ROWS, Parameter,
    healing_change,
};
pub use joint_segment::Deviation;
pub use motion::{Curve, Motion, MotionKind, Motions, ToolPosition, Turning};
pub use origins::{
    ORIGIN_SAMPLES, OriginExtent, OriginRegion, OriginRequest, OriginSlab, OriginSurvey, merge_origins,
    origin_slab, slice_origins,
};
pub use placement::{ActiveMargin, Placement, PlacementRequest, place};
pub use planned_places::{PlannedPlace, PlannedPlaces};
pub use report::{Departure, Failure, LeastMargin, MOST_DEPARTURES, MOST_FAILURES, Report};
pub use rows::{Row, RowKind, Way};
pub use set_up::{AdjustableProgram, SetUp};
pub use start::Start;
pub use timing::{Feed, Governor, Pace, TimedRow, Timer, Times};
pub use window::{ParametricProgram, WINDOW_PRECISION, Window, WindowInterval, window};

use crate::machine::Machine;
use cap::Cap;
use choice::Chooser;
use meridian::Meridian;
use motion::Standstill;
use node::Setting;
use path::Path;
use rows::{Retraction, RowSettings, Rower};
use start::Started;
use stretches::stretches;

/// Share of the progress that the choice of states is counted as.
const CHOICE_SHARE: f64 = 0.4;

/// What happens where no winding serves a whole cut.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum OnLimit {
    /// The report states the limit.
    #[default]
    Fail,
    /// The tool leaves the part, the rotary axis turns by whole turns, and the tool returns.
    Retract {
        /// Way along the tool's axis, and least height over the program's highest point, mm.
        clearance: f64,
        /// Height of the tool's end at which the rotary axis turns, mm; `None`: `clearance` over the highest point. It
        /// turns at the highest point if that is higher.
        height: Option<f64>,
    },
}

/// What a plan keeps to. Lengths are millimetres, angles radians.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanOptions {
    /// Greatest deviation of feed motions.
    pub tolerance: Deviation,
    /// Greatest deviation of the tool's end in rapids.
    pub rapid_tolerance: f64,
    /// Half-angle of the cap around the pole in which theta2 is free; part of the axis tolerance. Less than 1e-9 counts
    /// as 1e-9.
    pub pole: f64,
    /// Radius of the tool's end, for the height over the table.
    pub tool_radius: f64,
    /// Least height over the table; `None`: the machine's.
    pub table_clearance: Option<f64>,
    /// Where the machine stands before the program: it moves to the first position as in a rapid, after a row at the
    /// start. `None`: it stands at the first position.
    pub start: Option<Start>,
    /// Whether the joints move straight in all rapids.
    pub joint_rapids: bool,
    /// What happens where no winding serves a whole cut.
    pub on_limit: OnLimit,
    /// Greatest number of rows.
    pub most_rows: u64,
}

impl Default for PlanOptions {
    fn default() -> Self {
        let axis = 0.05_f64.to_radians();
        Self {
            tolerance: Deviation { tip: 0.01, axis },
            rapid_tolerance: 1.0,
            pole: 0.5 * axis,
            tool_radius: 0.0,
            table_clearance: None,
            start: None,
            joint_rapids: false,
            on_limit: OnLimit::Fail,
            most_rows: 20_000_000,
        }
    }
}

/// Why there is no plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlanError {
    /// The observer stopped the computation.
    Cancelled,
    /// The plan has more rows than allowed.
    TooManyRows,
}

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cancelled => "the computation was cancelled",
            Self::TooManyRows => "the plan has more rows than allowed; increase the tolerance",
        })
    }
}

impl std::error::Error for PlanError {}

/// Plans a program: calls `emit` with each row, in order, and reports.
///
/// `progress` receives the fraction of the work that is done and stops the computation by `false`. It is called for
/// every motion.
///
/// # Units
///
/// Millimetres and radians.
///
/// # Errors
///
/// [`PlanError`]. A program that breaks limits is no error: see [`Report::failures`].
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (8), (9), (14), (26) relate
/// the program's tool positions to the joints; the planning is not in the paper.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::toolpath::{
///     Curve, Motion, MotionKind, PlanError, PlanOptions, ToolPosition, Turning, plan,
/// };
///
/// let to = |kind, x| Motion {
///     kind,
///     end: ToolPosition { tip: [x, 0.0, 300.0], axis: [0.0, 0.0, 1.0] },
///     curve: Curve::Line,
///     turning: Turning::GreatCircle,
///     tool_length: 100.0,
/// };
/// let program = [to(MotionKind::Arrive, -150.0), to(MotionKind::Feed, 150.0)];
/// let mut rows = Vec::new();
/// let report = plan(&Machine::verne(), &program[..], &PlanOptions::default(), |_| true, |row| rows.push(*row))?;
/// assert!(report.is_feasible());
/// assert!(rows.len() > 30, "a single segment would bend the line by 17 mm");
/// assert!(report.deviation.tip <= 0.01);
/// # Ok::<(), PlanError>(())
/// ```
pub fn plan<M: Motions + ?Sized>(
    machine: &Machine,
    motions: &M,
    options: &PlanOptions,
    mut progress: impl FnMut(f64) -> bool,
    mut emit: impl FnMut(&Row),
) -> Result<Report, PlanError> {
    planned(machine, &motions, options, &mut progress, &mut emit)
}

fn planned(
    machine: &Machine,
    motions: &dyn Motions,
    options: &PlanOptions,
    progress: &mut dyn FnMut(f64) -> bool,
    emit: &mut dyn FnMut(&Row),
) -> Result<Report, PlanError> {
    let cap = Cap::new(options.pole, machine.longest());
    let retraction = retraction(motions, options.on_limit);
    let motions = &Started::new(motions, options.start);
    let standstill = motions.standstill(machine);
    let stretches = stretches(motions, &cap, standstill);
    let setting = Setting {
        machine,
        stretches: &stretches,
        table_clearance: options.table_clearance,
        tool_radius: options.tool_radius,
    };
    let part = |index: usize| fraction(index, motions.count());
    let weights = machine.data().drives.map_or([1.0; 2], |drives| drives.turning_weights());
    let may_retract = options.on_limit != OnLimit::Fail;
    let chooser = Chooser::new(setting, weights, options.start, may_retract, options.joint_rapids);
    let choice = chooser.choose(motions, Meridian::new(cap, &stretches, standstill), |index| {
        progress(CHOICE_SHARE * part(index))
    });
    let choice = choice.ok_or(PlanError::Cancelled)?;
    let settings = RowSettings {
        feed: options.tolerance,
        rapid: Deviation { tip: options.rapid_tolerance, axis: f64::INFINITY },
        joint_rapids: options.joint_rapids,
        start: options.start,
        retraction,
    };
    let mut is_full = false;
    let report = Rower::new(setting, &settings, &choice, emit).run(
        motions,
        Meridian::new(cap, &stretches, standstill),
        |index, rows| {
            is_full = rows > options.most_rows;
            !is_full && progress(CHOICE_SHARE + (1.0 - CHOICE_SHARE) * part(index))
        },
    );
    report.ok_or(if is_full { PlanError::TooManyRows } else { PlanError::Cancelled })
}

fn retraction(motions: &dyn Motions, on_limit: OnLimit) -> Option<Retraction> {
    let OnLimit::Retract { clearance, height } = on_limit else { return None };
    let top = highest(motions);
    let height = height.unwrap_or(top + clearance).max(top);
    Some(Retraction { clearance, height })
}

/// Height of the program's highest point.
fn highest(motions: &dyn Motions) -> f64 {
    let mut standstill = Standstill::default();
    let mut highest = f64::NEG_INFINITY;
    for index in 0..motions.count() {
        let motion = motions.motion(index);
        let path = standstill.advance(&motion).map(|start| Path::new(start, &motion));
        highest = highest.max(path.map_or(motion.end.tip[2], |path| path.highest()));
    }
    highest
}

#[allow(clippy::cast_precision_loss, reason = "progress")]
fn fraction(index: usize, count: usize) -> f64 {
    index as f64 / count.max(1) as f64
}
