//! Parameters of `POST /machines/calibration` with measurements in columns, in query strings and on the command line.

use std::collections::BTreeMap;

use clap::Args;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::wire::bounded_list::BoundedList;
use crate::wire::calibration::{
    CalibrationRequest, DEFAULT_NEXT, LossName, MeasurementKind, PriorObject, default_next,
};
use crate::wire::fixed_array::{Pair, TripleList};
use crate::wire::json_text::JsonText;
use crate::wire::machine_ref::{MachineRef, REFERENCE, reference_name};
use crate::wire::parameter::{ParameterList, ParameterName};
use crate::wire::row_format::RowFormat;
use crate::wire::strict_object::StrictObject;

/// Parameters of POST /machines/calibration with measurements in columns.
#[derive(Debug, Deserialize, IntoParams, Args)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct CalibrationQuery {
    /// Format of the body, if Content-Type states none. A JSON body takes no parameters.
    #[arg(skip)]
    #[param(inline, nullable = false)]
    pub format: Option<RowFormat>,
    /// Name of the machine with which the search begins, or in a query a machine object as JSON. On the command line it
    /// may also be the path of a machine file.
    #[serde(default = "reference_name")]
    #[arg(long, default_value = REFERENCE)]
    #[param(default = "verne")]
    pub machine: String,
    /// What was measured.
    #[serde(default)]
    #[arg(long, default_value = "tips")]
    pub kind: MeasurementKind,
    /// Distance from P to the tool end with which the search begins, mm.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Centre of the ball in the base frame, x,y,z, mm. Without it, it follows from the measurements. Only kind
    /// `ballbar` has it.
    #[arg(long, allow_hyphen_values = true)]
    #[param(inline, style = Form, explode = false, nullable = false)]
    pub centre: Option<TripleList>,
    /// Parameters that keep their values, such as `tool_length,R2`.
    #[arg(long, value_name = "NAMES")]
    #[param(inline, style = Form, explode = false, nullable = false)]
    pub fixed: Option<ParameterList>,
    /// What is known of parameters from another source as JSON, such as `{"L1":{"value":1050.1,"sigma":0.02}}`. Needs
    /// `sigma`.
    #[arg(long, value_name = "JSON")]
    #[param(value_type = Option<String>, nullable = false)]
    pub priors: Option<JsonText<BTreeMap<ParameterName, StrictObject<PriorObject>>>>,
    /// `[least, greatest]` value of parameters as JSON, mm or degrees, such as `{"R1":[274,276]}`.
    #[arg(long, value_name = "JSON")]
    #[param(value_type = Option<String>, nullable = false)]
    pub bounds: Option<JsonText<BTreeMap<ParameterName, Pair>>>,
    /// Standard deviation of each measured number, mm. Without it, it follows from the residuals.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 1e-9, maximum = 1e6, nullable = false)]
    pub sigma: Option<f64>,
    /// What a residual costs.
    #[serde(default)]
    #[arg(long, default_value = "squares")]
    pub loss: LossName,
    /// Number of poses to propose for the next measurements.
    #[serde(default = "default_next")]
    #[arg(long, default_value_t = DEFAULT_NEXT)]
    #[param(minimum = 0, maximum = 50, default = 5)]
    pub next: u32,
}

impl CalibrationQuery {
    /// The request without measurements, for a machine.
    pub(crate) fn into_request(self, machine: MachineRef) -> CalibrationRequest {
        CalibrationRequest {
            machine,
            kind: self.kind,
            tool_length: self.tool_length,
            rho: BoundedList::default(),
            table: None,
            points: None,
            pairs: None,
            centre: self.centre.map(|centre| centre.first),
            lengths: None,
            fixed: self.fixed.unwrap_or_default().0,
            priors: self.priors.map(|priors| priors.0).unwrap_or_default(),
            bounds: self.bounds.map(|bounds| bounds.0).unwrap_or_default(),
            sigma: self.sigma,
            loss: self.loss,
            next: self.next,
        }
    }
}
