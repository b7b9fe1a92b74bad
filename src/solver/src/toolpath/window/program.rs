//! A program with a free parameter.

use crate::toolpath::motion::Motions;
use crate::toolpath::set_up::{AdjustableProgram, SetUp};

/// A program with one free parameter.
pub trait ParametricProgram: Sync {
    /// The motions with this value of the parameter. Their number is the same for all values.
    fn motions(&self, value: f64) -> Box<dyn Motions + '_>;

    /// The program with its set-ups for the values 0 and 1; the set-up is linear in the value. `None`: no [`SetUp`] has
    /// the parameter. A long program then takes many plans.
    fn adjustable(&self) -> Option<(&dyn AdjustableProgram, [SetUp; 2])>;
}
