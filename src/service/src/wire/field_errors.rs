//! Collects every bad field of a request, so that one answer names them all.

use verne_solver::{MAX_INPUT, MAX_LENGTH_RATIO, Machine};

use crate::wire::error::{FieldError, OperationError};

/// Largest angle accepted, degrees.
pub(crate) const LARGEST_ANGLE: f64 = 36_000.0;

/// The bad fields found so far.
#[derive(Debug, Default)]
pub(crate) struct FieldErrors(Vec<FieldError>);

impl FieldErrors {
    /// Adds a fault.
    pub(crate) fn add(&mut self, pointer: impl Into<String>, detail: impl Into<String>) {
        self.0.push(FieldError::new(pointer, detail));
    }

    /// A length in mm, of any sign.
    pub(crate) fn length(&mut self, pointer: &str, value: f64) {
        if !is_length(value) {
            self.add(pointer, format!("must be a finite number within ±{MAX_INPUT:e} mm"));
        }
    }

    /// An angle in degrees, where there is one.
    pub(crate) fn angle(&mut self, pointer: &str, value: Option<f64>) {
        if value.is_some_and(|value| !is_angle(value)) {
            self.add(pointer, format!("must be a finite number within ±{LARGEST_ANGLE} degrees"));
        }
    }

    /// Several lengths of one field.
    pub(crate) fn lengths(&mut self, pointer: &str, values: &[f64]) {
        for (i, &value) in values.iter().enumerate() {
            if !is_length(value) {
                self.length(&format!("{pointer}/{i}"), value);
            }
        }
    }

    /// The length of the tool, from P to its tip.
    pub(crate) fn tool_length(&mut self, value: f64) {
        if !is_tool_length(value) {
            self.add("/tool_length", format!("must be a number from 0 to {MAX_INPUT:e} mm"));
        }
    }

    /// A length that has to be in proportion to the machine.
    pub(crate) fn proportion(&mut self, pointer: &str, value: f64, machine: &Machine) {
        if let Some(fault) = out_of_proportion(value, machine) {
            self.add(pointer, fault);
        }
    }

    /// The clearance over the table, if one is asked for, and the tool's radius. `theta1` is what a question must
    /// have for a clearance, if it does not have it.
    pub(crate) fn clearance(&mut self, least: Option<f64>, tool_radius: f64, lacking: Option<&str>) {
        let allowed = format!("must be a number from 0 to {MAX_INPUT:e} mm");
        if !is_tool_length(tool_radius) {
            self.add("/tool_radius", allowed.clone());
        }
        match (least, lacking) {
            (Some(least), _) if !is_tool_length(least) => self.add("/table_clearance", allowed),
            (Some(_), Some(lacking)) => {
                let detail = format!("{lacking}: the height over the table depends on theta1");
                self.add("/table_clearance", detail);
            }
            _ => {}
        }
    }

    /// Ends the collection: an error if anything was found.
    pub(crate) fn into_result(self) -> Result<(), OperationError> {
        if self.0.is_empty() { Ok(()) } else { Err(OperationError::Fields(self.0)) }
    }
}

/// What is wrong with a length that is too long for the machine.
pub(crate) fn out_of_proportion(value: f64, machine: &Machine) -> Option<String> {
    (value.abs() > MAX_LENGTH_RATIO * machine.longest()).then(|| too_far(machine))
}

/// What lengths have to be for a machine.
pub(crate) fn too_far(machine: &Machine) -> String {
    format!(
        "must be within ±{} mm for this machine: {MAX_LENGTH_RATIO:e} times its longest dimension. Beyond that double \
         precision loses solutions",
        MAX_LENGTH_RATIO * machine.longest()
    )
}

/// Whether a number can be a length in a question.
pub(crate) fn is_length(value: f64) -> bool {
    value.abs() <= MAX_INPUT
}

/// Whether a number can be an angle in a question.
pub(crate) fn is_angle(degrees: f64) -> bool {
    degrees.abs() <= LARGEST_ANGLE
}

/// Whether a number can be the length of a tool.
pub(crate) fn is_tool_length(value: f64) -> bool {
    (0.0..=MAX_INPUT).contains(&value)
}
