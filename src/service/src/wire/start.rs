//! The joints at which the machine stands before the first row of a batch or the first move of a program.

use serde::Deserialize;
use utoipa::ToSchema;

use crate::wire::field_errors::FieldErrors;
use crate::wire::fixed_array::Triple;

/// Joints at which the machine stands. They have the shape of `joints` in an answer of /ik.
#[derive(Clone, Copy, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Start {
    /// The three sliders, mm. /ik/batch needs them; they do not change the plan of a tool path.
    #[schema(inline, nullable = false)]
    pub rho: Option<Triple>,
    /// Tilting angle of the table, degrees.
    #[schema(minimum = -36000, maximum = 36000)]
    pub theta1: f64,
    /// Rotary angle of the table, degrees.
    #[schema(minimum = -36000, maximum = 36000)]
    pub theta2: f64,
}

impl Start {
    /// Checks the numbers.
    pub(crate) fn check(&self, faults: &mut FieldErrors) {
        faults.lengths("/start/rho", self.rho.as_ref().map_or(&[][..], |rho| &rho.0[..]));
        faults.angle("/start/theta1", Some(self.theta1));
        faults.angle("/start/theta2", Some(self.theta2));
    }
}
