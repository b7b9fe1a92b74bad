//! What a calibration keeps to.

use super::loss::Loss;
use crate::parameter::Parameter;

/// What a calibration keeps to.
///
/// # Units
///
/// Millimetres and radians.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CalibrationOptions {
    /// Parameters that keep their values at the start.
    pub fixed: Vec<Parameter>,
    /// What is known of parameters beside the measurements. It counts only if `sigma` is known.
    pub priors: Vec<Prior>,
    /// Least and greatest values of parameters. The value at the start must be between them.
    pub bounds: Vec<(Parameter, [f64; 2])>,
    /// The standard deviation of each measured number. `None`: it follows from the residuals.
    pub sigma: Option<f64>,
    /// What a residual costs.
    pub loss: Loss,
    /// The number of poses to propose.
    pub next: usize,
}

/// A value of a parameter from another source, with its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// The parameter.
    pub parameter: Parameter,
    /// Its value.
    pub value: f64,
    /// The standard deviation of the value.
    pub sigma: f64,
}
