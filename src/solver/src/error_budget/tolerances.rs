//! The tolerances of a machine's parameters.

use std::fmt;

use crate::parameter::{PARAMETERS, Parameter};
use crate::request_range::MAX_INPUT;

/// A tolerance for each parameter: a finite number that is not negative. It is a half-width for the worst case, and a
/// standard deviation for the rms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances([f64; PARAMETERS]);

/// A tolerance that is negative, not finite or beyond [`MAX_INPUT`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ToleranceError {
    /// The parameter.
    pub parameter: Parameter,
}

impl fmt::Display for ToleranceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the tolerance of {} must be a number from 0 to {MAX_INPUT:e}", self.parameter.name())
    }
}

impl std::error::Error for ToleranceError {}

impl Tolerances {
    /// The tolerances of some parameters; those of the others are zero. Of several for one parameter the last counts.
    ///
    /// # Units
    ///
    /// Millimetres and radians, by [`Parameter::unit`].
    ///
    /// # Errors
    ///
    /// [`ToleranceError`]: a tolerance is negative, not finite or beyond [`MAX_INPUT`](crate::MAX_INPUT).
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::error_budget::{ToleranceError, Tolerances};
    /// use verne_solver::parameter::Parameter;
    ///
    /// let tolerances = Tolerances::new([(Parameter::L1, 0.02)])?;
    /// assert_eq!([Parameter::L1, Parameter::L2].map(|p| tolerances.of(p)), [0.02, 0.0]);
    /// let parameter = Parameter::R1;
    /// assert_eq!(Tolerances::new([(parameter, -0.1)]), Err(ToleranceError { parameter }));
    /// # Ok::<(), ToleranceError>(())
    /// ```
    pub fn new(each: impl IntoIterator<Item = (Parameter, f64)>) -> Result<Self, ToleranceError> {
        let mut tolerances = [0.0; PARAMETERS];
        for (parameter, tolerance) in each {
            if !(0.0..=MAX_INPUT).contains(&tolerance) {
                return Err(ToleranceError { parameter });
            }
            // Without -0.
            tolerances[parameter.index()] = tolerance + 0.0;
        }
        Ok(Self(tolerances))
    }

    /// The tolerance of a parameter.
    ///
    /// # Units
    ///
    /// Millimetres and radians, by [`Parameter::unit`].
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::error_budget::{ToleranceError, Tolerances};
    /// use verne_solver::parameter::Parameter;
    ///
    /// assert_eq!(Tolerances::new([(Parameter::da, 0.1)])?.of(Parameter::da), 0.1);
    /// # Ok::<(), ToleranceError>(())
    /// ```
    pub fn of(&self, parameter: Parameter) -> f64 {
        self.0[parameter.index()]
    }

    /// The same tolerances, but zero for a parameter.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::error_budget::{ToleranceError, Tolerances};
    /// use verne_solver::parameter::Parameter;
    ///
    /// let tolerances = Tolerances::new([(Parameter::da, 0.1), (Parameter::dt, 0.1)])?;
    /// assert_eq!(Tolerances::new([(Parameter::dt, 0.1)]), Ok(tolerances.without(Parameter::da)));
    /// # Ok::<(), ToleranceError>(())
    /// ```
    #[must_use]
    pub fn without(mut self, parameter: Parameter) -> Self {
        self.0[parameter.index()] = 0.0;
        self
    }

    /// The tolerances in the order of [`Parameter::ALL`].
    pub(super) fn values(&self) -> &[f64; PARAMETERS] {
        &self.0
    }
}
