//! The report on a tool path.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use verne_solver::Margin;

use crate::wire::answer::MachineId;
use crate::wire::canonical_toolpath::CanonicalToolpath;
use crate::wire::constraint::{ConstraintName, ElementName, Unit};
use crate::wire::dwell_mark::DwellMark;
use crate::wire::fixed_array::{Pair, Triple};
use crate::wire::limit::{Limit, Unchecked};
use crate::wire::program::WarningObject;
use crate::wire::result_id::ResultId;
use crate::wire::toolpath_failure::FailureObject;
use crate::wire::toolpath_time::TimeObject;

/// Most characters of a line's text.
const TEXT_CHARACTERS: usize = 200;

/// The report on the joint motion of a program.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct ToolpathReport {
    /// BLAKE3 hash of the request, the machine, the program, and the version and the target of the binary. Equal
    /// requests have equal ids.
    #[schema(value_type = String)]
    pub id: ResultId,
    /// The machine.
    pub machine: MachineId,
    /// The id of the program.
    #[schema(value_type = String)]
    pub program: ResultId,
    /// The request with its default values, without the fields that have no effect.
    pub request: CanonicalToolpath,
    /// Whether the machine can run the program.
    pub verdict: Verdict,
    /// Stretches of the program that the machine cannot follow, in order; the first thousand of them.
    pub failures: Vec<FailureObject>,
    /// Number of all these stretches.
    pub failure_count: u64,
    /// Number of rows of the joint motion.
    pub rows: u64,
    /// Lengths of the tip's path.
    pub length: PathLengths,
    /// How long the program takes.
    pub time: TimeObject,
    /// The least margin of each constraint over the whole program.
    pub margins: Vec<MarginObject>,
    /// Least and greatest position of each joint; null if no point has a solution.
    pub ranges: Option<JointRanges>,
    /// The angles through which the table turns in total.
    pub turning: TurningObject,
    /// Least angle between the tool's axis and the table's own axis, degrees; null if no point has a solution.
    pub pole_distance: Option<f64>,
    /// Greatest deviation of the joint motion from the feed moves that the service found.
    pub deviation: DeviationObject,
    /// How often the joint motion changes between the two orientations of the table for the same tool axis.
    pub preimage_changes: u64,
    /// How often the tool leaves the part within a cut, so that the table can turn by whole turns.
    pub retracts: u64,
    /// Places where the tool stands on the part while the table turns, in order; the first thousand of them.
    pub dwell_marks: Vec<DwellMark>,
    /// Number of all these places.
    pub dwell_mark_count: u64,
    /// Rapids in which the joints move straight, because the table changes its orientation or on request; the first
    /// thousand of them.
    pub departures: Vec<DepartureObject>,
    /// Number of all these rapids.
    pub departure_count: u64,
    /// Warnings for the author of the program: at most a hundred of the reader, and those of the plan.
    pub warnings: Vec<WarningObject>,
    /// The number of lines with warnings, also of those that the list leaves out.
    pub warning_count: u64,
    /// Conditions that the service did not check.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Paths of the results.
    pub links: ToolpathLinks,
}

/// Whether the machine can run a program: `ok`, or `fails`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Verdict {
    /// The machine can run it.
    Ok,
    /// The machine cannot follow some lines.
    Fails,
}

/// Lengths of the tip's path, mm.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
pub(crate) struct PathLengths {
    /// Length of the feed moves.
    pub feed: f64,
    /// Length of the rapids.
    pub rapid: f64,
}

/// The least margin of a constraint.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = ToolpathMargin)]
pub(crate) struct MarginObject {
    /// The constraint.
    pub constraint: ConstraintName,
    /// The part of the machine, such as `slider2.max`.
    #[schema(value_type = String, example = "slider2.max")]
    pub element: ElementName,
    /// The margin: positive inside, negative outside.
    pub margin: f64,
    /// Unit of `margin`.
    pub unit: Unit,
    /// The line where it is least.
    pub line: u32,
}

/// Least and greatest position of each joint: `[min, max]`, mm for the sliders and degrees for the table.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
pub(crate) struct JointRanges {
    /// Slider 1.
    #[schema(inline)]
    pub rho1: Pair,
    /// Slider 2.
    #[schema(inline)]
    pub rho2: Pair,
    /// Slider 3.
    #[schema(inline)]
    pub rho3: Pair,
    /// Tilting angle.
    #[schema(inline)]
    pub theta1: Pair,
    /// Rotary angle.
    #[schema(inline)]
    pub theta2: Pair,
}

/// The angles through which the table turns in total, degrees.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
pub(crate) struct TurningObject {
    /// The tilting axis.
    pub theta1: f64,
    /// The rotary axis.
    pub theta2: f64,
}

/// Deviation from the program.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
pub(crate) struct DeviationObject {
    /// Deviation of the tool's end, mm.
    pub tip: f64,
    /// Deviation of the tool's axis, degrees.
    pub axis: f64,
}

/// A rapid in which the joints move straight.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = RapidDeparture)]
pub(crate) struct DepartureObject {
    /// The line.
    pub line: u32,
    /// Greatest distance of the tool's end from the straight line, mm; null if the platform passes a singularity.
    pub distance: Option<f64>,
    /// Unit vector in the part frame from the line to the tool's end at this distance; null without a distance.
    #[schema(inline)]
    pub direction: Option<Triple>,
}

/// Paths of a tool path.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct ToolpathLinks {
    /// This report.
    #[serde(rename = "self")]
    pub itself: String,
    /// The rows.
    pub rows: String,
    /// The joint program; null if the machine cannot run the program.
    pub program: Option<String>,
    /// The tool's path as a GLB.
    pub path: String,
}

impl ToolpathReport {
    /// Adds the texts of the first lines of failures, as far as they are known. Texts are in the order of their lines.
    pub(crate) fn add_texts(&mut self, texts: &[(u32, String)]) {
        for failure in &mut self.failures {
            let found = texts.binary_search_by_key(&failure.lines[0], |(line, _)| *line).ok();
            failure.text = found.map(|index| texts[index].1.chars().take(TEXT_CHARACTERS).collect());
        }
    }
}

impl MarginObject {
    /// The margin at a line.
    pub(crate) fn new(margin: Margin, line: u32) -> Self {
        let Limit { constraint, value, unit, element } = margin.into();
        Self { constraint, element, margin: value, unit, line }
    }
}
