//! Where the machine stands before a program.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::wire::fixed_array::{FixedArray, Triple};

/// Where the machine stands before a program: within the strokes and the ranges of the table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = ToolpathStart)]
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
    /// The same without -0.
    pub(crate) fn canonical(self) -> Self {
        let Self { rho: FixedArray(rho), theta1, theta2 } = self;
        Self { rho: FixedArray(rho.map(|rho| rho + 0.0)), theta1: theta1 + 0.0, theta2: theta2 + 0.0 }
    }
}
