//! `POST /machines/calibration`: the answer.

use serde::{Serialize, Serializer};
use utoipa::PartialSchema;
use utoipa::ToSchema;
use utoipa::openapi::schema::{AdditionalProperties, ObjectBuilder, Type};
use utoipa::openapi::{RefOr, Schema};

use crate::wire::answer::MachineId;
use crate::wire::batch::Row;
use crate::wire::constraint::Unit;
use crate::wire::fixed_array::Triple;
use crate::wire::machine::MachineObject;

/// The parameters of a machine as measurements determine them.
///
/// The model takes the rods of each leg as equal, guideways as straight and vertical, and joints as points. Standard
/// deviations hold if the errors of the measurements are normal and independent, and the model is right.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct CalibrationAnswer {
    /// The machine as a whole, ready for requests. Its sliders are at what the control indicates plus
    /// `slider_offsets`; so are the ends of its strokes. Without measured values it is the machine of the request.
    pub machine: MachineObject,
    /// Hash of the machine, as answers to requests with it state it.
    #[schema(value_type = String)]
    pub hash: std::sync::Arc<str>,
    /// The machine with which the search began.
    pub start: MachineId,
    /// What to add to the sliders' positions that the control indicates, for `rho` of requests with `machine`, mm. To
    /// correct the control instead, shift the zeros of its sliders by as much.
    #[schema(inline)]
    pub slider_offsets: Triple,
    /// Distance from P to the tool end, mm.
    pub tool_length: f64,
    /// The parameters that were determined.
    pub parameters: Vec<ParameterEstimate>,
    /// Number of parameters and coordinates of the measuring device that were determined together.
    pub unknowns: usize,
    /// Number of independent combinations of them that the measurements determine.
    pub rank: usize,
    /// Singular values of the derivatives of all measured numbers by all unknowns, in descending order; angles count by
    /// the machine's longest dimension. 0 where the measurements determine nothing.
    pub singular_values: Vec<f64>,
    /// Combinations that the measurements do not determine: if each of the named unknowns changes by its number (mm or
    /// degrees), times any common factor, no measurement changes. `frame.x` to `frame.c` are shifts and rotations of
    /// the measuring device's frame in the base frame, `centre.x` to `centre.z` the ball's centre.
    pub unidentifiable: Vec<CombinationObject>,
    /// Place of the measuring device's frame. Only kind `tracker` has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub frame: Option<FrameObject>,
    /// Centre of the ball in the base frame, mm. Only kind `ballbar` has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(inline, nullable = false)]
    pub centre: Option<Triple>,
    /// Standard deviation of a measured number, mm: that of the request, or that of the residuals. null if there are no
    /// more measured numbers than `rank`, or no measured values.
    pub sigma: Option<f64>,
    /// Root of the mean square of all numbers of `residuals`, mm. null without measured values.
    pub rms: Option<f64>,
    /// Model less measured value of each measurement, mm: x, y, z, or one number. Empty without measured values.
    #[schema(value_type = Vec<Vec<f64>>)]
    pub residuals: Vec<Row>,
    /// Measurements that their errors do not explain, the worst first. With normal errors, one or more of all
    /// measurements are among them with a chance of at most 1 %.
    pub outliers: Vec<OutlierObject>,
    /// Poses to measure next, in this order: `[rho1, rho2, rho3]` that the control indicates; with kind `part`
    /// `[rho1, rho2, rho3, theta1, theta2]`. Each increases the determinant of the information matrix more than any
    /// other of 512 feasible poses. With kind `distances` they are to be measured from the first pose.
    #[schema(value_type = Vec<Vec<f64>>)]
    pub next: Vec<Row>,
}

/// A parameter as measurements determine it.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct ParameterEstimate {
    /// The name.
    pub name: &'static str,
    /// Unit of its numbers: `mm` or `deg`.
    pub unit: Unit,
    /// Value at the start.
    pub start: f64,
    /// Value. What nothing determines stays as near to the start as it can.
    pub value: f64,
    /// Standard deviation of the value. null if neither the measurements nor a prior determine it, if nothing tells the
    /// accuracy of the measurements, or at a bound.
    pub sigma: Option<f64>,
    /// Whether the measurements determine the parameter by themselves.
    pub identifiable: bool,
    /// Whether a bound keeps it from a value that fits better.
    pub at_bound: bool,
}

/// A combination of unknowns: names with numbers.
#[derive(Debug)]
pub(crate) struct CombinationObject(pub Vec<(&'static str, f64)>);

impl Serialize for CombinationObject {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, amount)| (name, amount)))
    }
}

impl PartialSchema for CombinationObject {
    fn schema() -> RefOr<Schema> {
        ObjectBuilder::new()
            .schema_type(Type::Object)
            .additional_properties(Some(AdditionalProperties::RefOr(f64::schema())))
            .description(Some("Unknowns by name, each with its number."))
            .into()
    }
}

impl ToSchema for CombinationObject {
    fn name() -> std::borrow::Cow<'static, str> {
        "UnknownCombination".into()
    }
}

/// Place of a measuring device's frame: its origin in the base frame, mm, and its rotations about x, then y, then z,
/// degrees.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = DeviceFrame)]
pub(crate) struct FrameObject {
    /// x of the origin.
    pub x: f64,
    /// y of the origin.
    pub y: f64,
    /// z of the origin.
    pub z: f64,
    /// Rotation about x.
    pub a: f64,
    /// Rotation about y.
    pub b: f64,
    /// Rotation about z.
    pub c: f64,
}

/// A measurement that its error does not explain.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = MeasurementOutlier)]
pub(crate) struct OutlierObject {
    /// The measurement, from 0.
    pub measurement: usize,
    /// Length of its residual, mm.
    pub residual: f64,
    /// Greatest ratio of a number of the residual to its standard deviation.
    pub ratio: f64,
}
