//! Collects the invalid fields of a request, so that one response lists them all.

use verne_solver::{MAX_INPUT, MAX_LENGTH_RATIO, Machine};

use crate::wire::error::{FieldError, OperationError};

/// Largest accepted angle, degrees.
pub(crate) const LARGEST_ANGLE: f64 = 36_000.0;

/// Finest and coarsest grid, mm.
const CELLS: [f64; 2] = [1.0, 1000.0];

/// The invalid fields of a request.
#[derive(Debug, Default)]
pub(crate) struct FieldErrors(Vec<FieldError>);

impl FieldErrors {
    /// Adds an error.
    pub(crate) fn add(&mut self, pointer: impl Into<String>, detail: impl Into<String>) {
        self.0.push(FieldError::new(pointer, detail));
    }

    /// The number of errors.
    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Checks a length in mm of any sign.
    pub(crate) fn length(&mut self, pointer: &str, value: f64) {
        if !is_length(value) {
            self.add(pointer, format!("must be a finite number within ±{MAX_INPUT:e} mm"));
        }
    }

    /// Checks an optional angle in degrees.
    pub(crate) fn angle(&mut self, pointer: &str, value: Option<f64>) {
        if value.is_some_and(|value| !is_angle(value)) {
            self.add(pointer, format!("must be a finite number within ±{LARGEST_ANGLE} degrees"));
        }
    }

    /// Checks the lengths of one field.
    pub(crate) fn lengths(&mut self, pointer: &str, values: &[f64]) {
        for (i, &value) in values.iter().enumerate() {
            if !is_length(value) {
                self.length(&format!("{pointer}/{i}"), value);
            }
        }
    }

    /// Checks the coordinates of a point, or the positions of the sliders: lengths in proportion to the machine.
    pub(crate) fn point(&mut self, pointer: &str, values: &[f64], machine: &Machine) {
        self.lengths(pointer, values);
        for (i, &value) in values.iter().enumerate().filter(|(_, value)| is_length(**value)) {
            self.proportion(&format!("{pointer}/{i}"), value, machine);
        }
    }

    /// Checks the length of the tool, from P to the tool end.
    pub(crate) fn tool_length(&mut self, value: f64) {
        if !is_tool_length(value) {
            self.add("/tool_length", format!("must be a number from 0 to {MAX_INPUT:e} mm"));
        }
    }

    /// Checks the distance between neighbouring points of a grid.
    pub(crate) fn cell(&mut self, value: f64) {
        let [finest, coarsest] = CELLS;
        if !(finest..=coarsest).contains(&value) {
            self.add("/cell", format!("must be a number from {finest} to {coarsest} mm"));
        }
    }

    /// Checks that a length is in proportion to the machine.
    pub(crate) fn proportion(&mut self, pointer: &str, value: f64, machine: &Machine) {
        if let Some(detail) = out_of_proportion(value, machine) {
            self.add(pointer, detail);
        }
    }

    /// Checks an optional clearance over the table, and the tool's radius. `lacking` describes what the request lacks
    /// to determine theta1.
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

    /// Fails if there is an error, with the first `most` of all errors.
    pub(crate) fn into_first(mut self, most: usize) -> Result<(), OperationError> {
        self.0.truncate(most);
        self.into_result()
    }

    /// Fails if there is an error.
    pub(crate) fn into_result(self) -> Result<(), OperationError> {
        if self.0.is_empty() { Ok(()) } else { Err(OperationError::Fields(self.0)) }
    }
}

/// The error of a length that is out of proportion to the machine.
pub(crate) fn out_of_proportion(value: f64, machine: &Machine) -> Option<String> {
    (value.abs() > MAX_LENGTH_RATIO * machine.longest()).then(|| too_far(machine))
}

/// The message with the range of lengths for a machine.
pub(crate) fn too_far(machine: &Machine) -> String {
    format!(
        "must be within ±{} mm for this machine: {MAX_LENGTH_RATIO:e} times its longest dimension. Beyond that double \
         precision loses solutions",
        MAX_LENGTH_RATIO * machine.longest()
    )
}

/// Whether a number is a valid length.
pub(crate) fn is_length(value: f64) -> bool {
    value.abs() <= MAX_INPUT
}

/// Whether a number is a valid angle.
pub(crate) fn is_angle(degrees: f64) -> bool {
    degrees.abs() <= LARGEST_ANGLE
}

/// Whether a number is a valid length or radius of a tool.
pub(crate) fn is_tool_length(value: f64) -> bool {
    (0.0..=MAX_INPUT).contains(&value)
}
