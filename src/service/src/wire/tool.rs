//! The tool of a request, and the table clearance that it has to keep.

use verne_solver::{Clearance, Machine};

use crate::wire::field_errors::FieldErrors;

/// The fields `tool_length`, `tool_radius` and `table_clearance` of a request.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tool {
    /// Distance from P to the tool end, mm.
    pub length: f64,
    /// Radius of the tool's end circle, mm.
    pub radius: f64,
    /// Least height over the table, mm. The default is the machine's own.
    pub table_clearance: Option<f64>,
}

impl Tool {
    /// Adds a fault for each field that cannot be used. `without_theta1` is the reason why theta1 is unknown, if it is:
    /// a table clearance needs it.
    pub(crate) fn check(self, without_theta1: Option<&str>, faults: &mut FieldErrors) {
        faults.tool_length(self.length);
        faults.clearance(self.table_clearance, self.radius, without_theta1);
    }

    /// The clearance that the solver checks, if the request or the machine has one.
    pub(crate) fn clearance(self, machine: &Machine) -> Option<Clearance> {
        Clearance::of(machine, self.table_clearance, self.length, self.radius)
    }
}

/// Implements `tool` for requests that have the three fields.
macro_rules! has_tool {
    ($request:ident $(<$row:ident>)?) => {
        impl $(<$row>)? $request $(<$row>)? {
            /// The tool and the table clearance.
            pub(crate) fn tool(&self) -> $crate::wire::tool::Tool {
                $crate::wire::tool::Tool {
                    length: self.tool_length,
                    radius: self.tool_radius,
                    table_clearance: self.table_clearance,
                }
            }
        }
    };
}
pub(crate) use has_tool;
