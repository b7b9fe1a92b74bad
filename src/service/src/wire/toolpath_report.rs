//! The report on a tool path.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use verne_solver::toolpath::{Change, Parameter};
use verne_solver::{Margin, PartPose};

use crate::wire::answer::MachineId;
use crate::wire::canonical_toolpath::CanonicalToolpath;
use crate::wire::constraint::{ConstraintName, ElementName, Unit};
use crate::wire::degrees::to_degrees;
use crate::wire::fixed_array::{Pair, Triple};
use crate::wire::limit::{Limit, Unchecked};
use crate::wire::program::WarningObject;
use crate::wire::result_id::ResultId;
use crate::wire::toolpath_time::TimeObject;

/// Most characters of a line's text.
const TEXT_CHARACTERS: usize = 200;

/// The report on the joint motion of a program.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct ToolpathReport {
    /// BLAKE3 hash of the request, the machine, the program and the version of the service. Equal requests have equal
    /// ids.
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

/// Consecutive moves that the machine cannot follow for the same reason.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = ToolpathFailure)]
pub(crate) struct FailureObject {
    /// The first and the last line.
    #[schema(value_type = Vec<u32>, min_items = 2, max_items = 2)]
    pub lines: [u32; 2],
    /// The first 200 characters of the first line. Rows (CSV, NDJSON, points) have no text.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub text: Option<String>,
    /// The constraint that the moves break.
    pub constraint: ConstraintName,
    /// The part of the machine, such as `slider2.max`.
    #[schema(value_type = String, example = "slider2.max")]
    pub element: ElementName,
    /// The worst margin: negative, as much as is missing.
    pub margin: f64,
    /// Unit of `margin`.
    pub unit: Unit,
    /// The place with the worst margin.
    pub at: FailurePlace,
    /// The smallest change of one number of the request that lets the machine follow these moves. The service looks for
    /// it up to 512 mm for the first three stretches of at most 2000 moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub change: Option<ChangeObject>,
}

/// A change of one number of the request.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[schema(as = ToolpathChange)]
pub(crate) struct ChangeObject {
    /// The number.
    pub parameter: ParameterName,
    /// The change, mm: add it to the parameter.
    pub delta: f64,
}

/// A number of the request: `setup.x`, `setup.y`, `setup.z` (of the frame that the moves are in), or `tool_length` (of
/// the tool of the moves).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[schema(as = ToolpathParameter)]
pub(crate) enum ParameterName {
    /// x of the frame.
    #[serde(rename = "setup.x")]
    X,
    /// y of the frame.
    #[serde(rename = "setup.y")]
    Y,
    /// z of the frame.
    #[serde(rename = "setup.z")]
    Z,
    /// The length of the tool.
    #[serde(rename = "tool_length")]
    ToolLength,
}

impl From<Change> for ChangeObject {
    fn from(Change { parameter, delta }: Change) -> Self {
        let parameter = match parameter {
            Parameter::X => ParameterName::X,
            Parameter::Y => ParameterName::Y,
            Parameter::Z => ParameterName::Z,
            Parameter::ToolLength => ParameterName::ToolLength,
        };
        Self { parameter, delta }
    }
}

/// A place of a program. /ik reproduces the failure for this pose in frame `part` with this tool. A failure of `rotary`
/// is one of the winding: theta2 is -phi2 there, while /ik takes a winding within the range.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct FailurePlace {
    /// The line.
    pub line: u32,
    /// x of the tool's end in the part frame, mm.
    pub x: f64,
    /// y, mm.
    pub y: f64,
    /// z, mm.
    pub z: f64,
    /// Inclination of the tool, degrees.
    pub phi1: f64,
    /// Azimuth of the tool, degrees, on the winding of the plan.
    pub phi2: f64,
    /// Distance from P to the tool end, mm. With `tip: "centre"` the end is the centre of the ball.
    pub tool_length: f64,
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

impl FailurePlace {
    /// The place with a pose and a tool.
    pub(crate) fn new(line: u32, pose: PartPose, tool_length: f64) -> Self {
        let PartPose { x, y, z, phi1, phi2 } = pose;
        let [phi1, phi2] = [phi1, phi2].map(to_degrees);
        Self { line, x: x + 0.0, y: y + 0.0, z: z + 0.0, phi1, phi2, tool_length }
    }
}

impl MarginObject {
    /// The margin at a line.
    pub(crate) fn new(margin: Margin, line: u32) -> Self {
        let Limit { constraint, value, unit, element } = margin.into();
        Self { constraint, element, margin: value, unit, line }
    }
}
