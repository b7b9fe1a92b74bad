//! The joints at which the machine stands before the first row of a batch or the first move of a program.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::wire::field_errors::FieldErrors;
use crate::wire::fixed_array::{FixedArray, Triple};

/// Joints at which the machine stands. They have the shape of `joints` in an answer of /ik.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Start {
    /// The three sliders, mm.
    #[schema(inline)]
    pub rho: Triple,
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
        faults.lengths("/start/rho", &self.rho.0);
        faults.angle("/start/theta1", Some(self.theta1));
        faults.angle("/start/theta2", Some(self.theta2));
    }

    /// The same without -0.
    pub(crate) fn canonical(self) -> Self {
        let Self { rho: FixedArray(rho), theta1, theta2 } = self;
        Self { rho: FixedArray(rho.map(|rho| rho + 0.0)), theta1: theta1 + 0.0, theta2: theta2 + 0.0 }
    }
}
