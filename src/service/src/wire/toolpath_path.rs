//! Parameters of `GET /toolpath/{id}/path`.

use serde::Deserialize;
use utoipa::IntoParams;

use crate::wire::error::OperationError;
use crate::wire::field_errors::FieldErrors;

/// Parameters of GET /toolpath/{id}/path. The colour of a point is its worst margin as a fraction of the range of its
/// constraint: of the stroke, of the half-angle of the cone, of the table's range.
#[derive(Clone, Copy, Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct PathQuery {
    /// The fraction that is yellow, as smaller ones are.
    #[serde(default)]
    #[param(minimum = -1, maximum = 1, default = 0.0)]
    pub least: f64,
    /// The fraction that is dark blue, as greater ones are.
    #[serde(default = "default_greatest")]
    #[param(minimum = -1, maximum = 1, default = 0.25)]
    pub greatest: f64,
}

fn default_greatest() -> f64 {
    0.25
}

impl PathQuery {
    /// Checks the numbers.
    pub(crate) fn check(self) -> Result<Self, OperationError> {
        let mut faults = FieldErrors::default();
        for (name, value) in [("/query/least", self.least), ("/query/greatest", self.greatest)] {
            if !(-1.0..=1.0).contains(&value) {
                faults.add(name, "must be a number from -1 to 1");
            }
        }
        if self.least >= self.greatest {
            faults.add("/query/greatest", "must be greater than least");
        }
        faults.into_result()?;
        Ok(self)
    }
}
