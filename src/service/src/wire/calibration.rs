//! `POST /machines/calibration`: the request.

use std::collections::BTreeMap;

use arrayvec::ArrayVec;
use clap::ValueEnum;
use serde::Deserialize;
use utoipa::ToSchema;
use verne_solver::calibration::Loss;

use crate::wire::bounded_list::BoundedList;
use crate::wire::fixed_array::{Pair, Triple};
use crate::wire::machine_ref::MachineRef;
use crate::wire::parameter::ParameterName;
use crate::wire::strict_object::StrictObject;

/// Poses to propose unless the request says how many.
pub(crate) const DEFAULT_NEXT: u32 = 5;
/// Most poses to propose.
pub(crate) const MOST_NEXT: u32 = 50;

/// Measurements from which the parameters of a machine are determined.
///
/// Without measured values (`points`, `lengths`, or the third number of `pairs`) the answer says what the poses would
/// identify.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CalibrationRequest {
    /// The machine with which the search begins: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Kind of the measurements.
    #[serde(default)]
    pub kind: MeasurementKind,
    /// Distance from P to the tool end with which the search begins, mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Positions of the sliders that the control indicated, for each pose, mm.
    #[schema(inline, value_type = Vec<Triple>, min_items = 1, max_items = 20_000)]
    pub rho: BoundedList<Triple>,
    /// `[theta1, theta2]` that the control indicated, for each pose, degrees. Only kind `part` has it.
    #[serde(default)]
    #[schema(inline, value_type = Option<Vec<Pair>>, nullable = false)]
    pub table: Option<BoundedList<Pair>>,
    /// The tool end at each pose, mm. Only kinds `tips`, `tracker` and `part` have it.
    #[serde(default)]
    #[schema(inline, value_type = Option<Vec<Triple>>, nullable = false)]
    pub points: Option<BoundedList<Triple>>,
    /// `[i, j, distance]`: the distance between the tool ends at the poses i and j, counted from 0, mm; or `[i, j]`
    /// without a measured value. Only kind `distances` has it.
    #[serde(default)]
    #[schema(value_type = Option<Vec<Vec<f64>>>, nullable = false)]
    pub pairs: Option<BoundedList<PairRow>>,
    /// Centre of the ball in the base frame, mm. null or missing: it follows from the measurements. Only kind
    /// `ballbar` has it.
    #[serde(default)]
    #[schema(inline)]
    pub centre: Option<Triple>,
    /// Distance of the tool end from the centre of the ball at each pose, mm. Only kind `ballbar` has it.
    #[serde(default)]
    #[schema(value_type = Option<Vec<f64>>, nullable = false)]
    pub lengths: Option<BoundedList<f64>>,
    /// Parameters that keep their values.
    #[serde(default)]
    pub fixed: Vec<ParameterName>,
    /// Values of parameters from another source, by their names. Needs `sigma`.
    #[serde(default)]
    #[schema(value_type = BTreeMap<String, PriorObject>)]
    pub priors: BTreeMap<ParameterName, StrictObject<PriorObject>>,
    /// `[least, greatest]` value of parameters, by their names, mm or degrees. The value at the start must be between
    /// them.
    #[serde(default)]
    #[schema(inline, value_type = BTreeMap<String, Pair>)]
    pub bounds: BTreeMap<ParameterName, Pair>,
    /// Standard deviation of each measured number, mm. Without it, it follows from the residuals.
    #[serde(default)]
    #[schema(minimum = 1e-9, maximum = 1e6)]
    pub sigma: Option<f64>,
    /// Cost of a residual.
    #[serde(default)]
    pub loss: LossName,
    /// Number of poses to propose for the next measurements.
    #[serde(default = "default_next")]
    #[schema(minimum = 0, maximum = 50, default = 5)]
    pub next: u32,
}

/// The default of `next`.
pub(crate) fn default_next() -> u32 {
    DEFAULT_NEXT
}

/// `[i, j]` or `[i, j, distance]`.
pub(crate) type PairRow = ArrayVec<f64, 3>;

/// Kind of measurements: `tips`, the tool end in the base frame; `tracker`, the tool end in the measuring device's own
/// frame, whose place follows from the measurements; `part`, the tool end in the part frame; `distances` between tool
/// ends; `ballbar`, distances of the tool end from a ball.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub(crate) enum MeasurementKind {
    /// Tool ends in the base frame.
    #[default]
    Tips,
    /// Tool ends in a frame of the measuring device.
    Tracker,
    /// Tool ends in the part frame.
    Part,
    /// Distances between tool ends.
    Distances,
    /// Distances from a ball.
    Ballbar,
}

impl MeasurementKind {
    /// The name.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Tips => "tips",
            Self::Tracker => "tracker",
            Self::Part => "part",
            Self::Distances => "distances",
            Self::Ballbar => "ballbar",
        }
    }

    /// Whether the place of the tool end was measured.
    pub(crate) const fn has_points(self) -> bool {
        matches!(self, Self::Tips | Self::Tracker | Self::Part)
    }
}

/// Cost of a residual: `squares`, its square; `huber`, its square if it is small and linearly beyond, so that gross
/// errors hardly count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub(crate) enum LossName {
    /// The square.
    #[default]
    Squares,
    /// Huber's loss.
    Huber,
}

impl From<LossName> for Loss {
    fn from(name: LossName) -> Self {
        match name {
            LossName::Squares => Self::Squares,
            LossName::Huber => Self::Huber,
        }
    }
}

/// A value of a parameter from another source.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = ParameterPrior)]
pub(crate) struct PriorObject {
    /// The value, mm or degrees. The default is that of the start.
    #[serde(default)]
    #[schema(nullable = false)]
    pub value: Option<f64>,
    /// Its standard deviation, mm or degrees.
    #[schema(minimum = 1e-9, maximum = 1e6)]
    pub sigma: f64,
}
