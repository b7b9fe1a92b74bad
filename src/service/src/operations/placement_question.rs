//! A checked question about the placement of a program.

use verne_solver::toolpath::PlacementRequest;
use verne_solver::{Constraint, MAX_INPUT};

use crate::operations::toolpath_question::{CheckedToolpath, ToolpathQuestion};
use crate::wire::constraint::{ConstraintName, Unit};
use crate::wire::degrees::from_degrees;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::field_errors::{FieldErrors, LARGEST_ANGLE, is_angle, is_length, is_tool_length};
use crate::wire::fixed_array::FixedArray;
use crate::wire::json::write_json;
use crate::wire::placement::{CanonicalPlacement, FreeParameters, PlacementFields, Reserve};
use crate::wire::result_id::ResultId;
use crate::wire::toolpath::ToolLengths;

/// Begins the hash of every placement. It changes when the bytes of the answer to the same question change.
const HASH_PREFIX: &[u8] = b"verne placement 1";

/// About the bytes of a request.
const REQUEST_BYTES: usize = 1024;

/// About how many plans a placement takes, and the seconds of its search beside them.
const PLANS: f64 = 8.0;
const SEARCH_COST: f64 = 1.0;

/// The frame of `setup` by its other name.
const FIRST_OFFSET: &str = "G54";

/// A question about a placement that has an answer.
#[derive(Clone, Debug)]
pub(crate) struct PlacementQuestion {
    /// The tool path in the given set-up.
    pub toolpath: ToolpathQuestion,
    /// The free parameters.
    pub free: FreeParameters,
    /// The distances to keep.
    pub reserve: Reserve,
    /// The id of the answer.
    pub id: ResultId,
}

/// The checked fields of a placement.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CheckedPlacement {
    free: FreeParameters,
    reserve: Reserve,
}

impl CheckedPlacement {
    /// Checks the fields beside those of the tool path.
    ///
    /// # Errors
    ///
    /// All fields that cannot be used.
    pub(crate) fn new(fields: &PlacementFields, toolpath: &CheckedToolpath) -> Result<Self, OperationError> {
        let missing = [("free", fields.free.is_none()), ("reserve", fields.reserve.is_none())];
        let missing = missing.into_iter().filter(|(_, is_missing)| *is_missing);
        let missing: Vec<_> =
            missing.map(|(name, _)| FieldError::missing(format!("/{name}"), name)).collect();
        let (Some(free), Some(reserve)) = (fields.free, fields.reserve) else {
            return Err(OperationError::Fields(missing));
        };
        let mut faults = FieldErrors::default();
        check_free(&free, toolpath, &mut faults);
        check_reserve(&reserve, toolpath, &mut faults);
        faults.into_result()?;
        Ok(Self { free: canonical(free), reserve })
    }

    /// The question about a tool path.
    pub(crate) fn question(self, toolpath: ToolpathQuestion) -> PlacementQuestion {
        PlacementQuestion::of(toolpath, self.free, self.reserve)
    }
}

impl PlacementQuestion {
    /// The question of a checked request.
    pub(crate) fn of(toolpath: ToolpathQuestion, free: FreeParameters, reserve: Reserve) -> Self {
        let request = CanonicalPlacement { toolpath: toolpath.request.clone(), free, reserve };
        // Writing these fields to memory cannot fail.
        let text = write_json(&request, REQUEST_BYTES).unwrap_or_default();
        let machine = &toolpath.machine;
        let id = ResultId::of_text(HASH_PREFIX, &machine.id, &machine.data().description, &text);
        Self { toolpath, free, reserve, id }
    }

    /// The request with its default values.
    pub(crate) fn request(&self) -> CanonicalPlacement {
        CanonicalPlacement { toolpath: self.toolpath.request.clone(), free: self.free, reserve: self.reserve }
    }

    /// Estimated work, seconds of one core.
    pub(crate) fn cost(&self) -> f64 {
        SEARCH_COST + PLANS * self.toolpath.cost
    }

    /// The request to the solver, from the parameters of the given set-up.
    pub(crate) fn placement_request(&self, given: [f64; 5]) -> PlacementRequest {
        let ranges = self.free.ranges();
        let bounds = std::array::from_fn(|i| match ranges[i] {
            Some(range) if FreeParameters::NAMES[i] == "setup.c" => range.map(from_degrees),
            Some(range) => range,
            None => [given[i]; 2],
        });
        let in_radians = |(constraint, reserve)| match ConstraintName(constraint).unit() {
            Unit::Degree => (constraint, from_degrees(reserve)),
            Unit::Millimetre | Unit::One => (constraint, reserve),
        };
        PlacementRequest { bounds, reserve: self.reserve.list().map(in_radians).collect() }
    }
}

fn canonical(free: FreeParameters) -> FreeParameters {
    let positive = |range: Option<FixedArray<f64, 2>>| {
        range.map(|FixedArray(ends)| FixedArray(ends.map(|end| end + 0.0)))
    };
    let FreeParameters { x, y, z, c, tool_length } = free;
    let [x, y, z, c, tool_length] = [x, y, z, c, tool_length].map(positive);
    FreeParameters { x, y, z, c, tool_length }
}

fn check_free(free: &FreeParameters, toolpath: &CheckedToolpath, faults: &mut FieldErrors) {
    let ranges = free.ranges();
    if ranges.iter().all(Option::is_none) {
        faults.add("/free", format!("must name at least one of {}", FreeParameters::NAMES.join(", ")));
    }
    let request = &toolpath.request;
    for (name, range) in FreeParameters::NAMES.into_iter().zip(ranges) {
        let Some([low, high]) = range else { continue };
        let pointer = format!("/free/{name}");
        let (accepts, allowed): (fn(f64) -> bool, _) = match name {
            "setup.c" => (is_angle, format!("numbers within ±{LARGEST_ANGLE} degrees")),
            "tool_length" => (is_tool_length, format!("numbers from 0 to {MAX_INPUT:e} mm")),
            _ => (is_length, format!("numbers within ±{MAX_INPUT:e} mm")),
        };
        if !accepts(low) || !accepts(high) {
            faults.add(&pointer, format!("must be two {allowed}"));
        } else if low > high {
            faults.add(&pointer, "must be the least value and then the greatest");
        } else if name == "tool_length" && !matches!(request.tool_length, Some(ToolLengths::One(_))) {
            faults.add(&pointer, "needs a tool_length that is one number for every tool");
        } else if name != "tool_length" && request.offsets.contains_key(FIRST_OFFSET) {
            faults.add(&pointer, "has no effect where offsets states G54: give this frame as setup");
        } else if name != "setup.c" {
            for end in [low, high] {
                faults.proportion(&pointer, end, &toolpath.machine);
            }
        }
    }
}

fn check_reserve(reserve: &Reserve, toolpath: &CheckedToolpath, faults: &mut FieldErrors) {
    if reserve.list().next().is_none() {
        faults.add("/reserve", "must list at least one constraint, such as {\"stroke\": 20}");
    }
    for (constraint, value) in reserve.list() {
        let pointer = format!("/reserve/{}", ConstraintName(constraint));
        if !(value > 0.0 && value <= MAX_INPUT) {
            faults.add(pointer, format!("must be a positive number, at most {MAX_INPUT:e}"));
        } else if constraint == Constraint::Rotary && toolpath.machine.data().limits.rotary.is_none() {
            faults.add(pointer, "is no limit of this machine: its table turns without end");
        } else if constraint == Constraint::TableClearance && toolpath.request.table_clearance.is_none() {
            faults.add(pointer, "needs table_clearance: the machine has no limit for the table");
        }
    }
}
