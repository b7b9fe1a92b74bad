//! A machine of the VERNE architecture: its plain data, and the checked machine made from it.

pub(crate) mod data;
mod drives;
mod error;
mod home;
mod linear_delta;
mod reference;
mod validate;

pub use crate::mechanism::Geometry;
pub use data::{Limits, MachineData, Table};
pub use drives::{Drive, Drives};
pub use error::MachineError;

use crate::margins::normalization::Normalization;
use crate::mechanism::Mechanism;
use home::Home;

/// A valid machine. Every value of this type has positive lengths, ordered ranges, R1 ≥ r1, and a home posture in the
/// working mode away from singularity.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    data: MachineData,
    /// The parallel module.
    pub(crate) mechanism: Mechanism,
    pub(crate) home: Home,
    /// Factors that make margins comparable.
    pub(crate) normalization: Normalization,
}

impl Machine {
    /// Checks the numbers and derives from them what the formulas need.
    ///
    /// # Units
    ///
    /// Lengths are millimetres, angles radians.
    ///
    /// # Errors
    ///
    /// Every invalid field, each with the path of its field, such as `limits/stroke/0`. A machine needs finite numbers,
    /// positive lengths, ordered ranges, positive velocities and accelerations, R1 not less than r1, and a home posture
    /// in the working mode away from parallel singularity.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(7), Fig. 3.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    ///
    /// let mut data = Machine::verne().data().clone();
    /// data.geometry.L1 = -1.0;
    /// let errors = Machine::new(data).unwrap_err();
    /// assert!(errors.iter().any(|error| error.field == "geometry/L1"));
    /// ```
    pub fn new(data: MachineData) -> Result<Self, Vec<MachineError>> {
        let errors = validate::errors(&data);
        if !errors.is_empty() {
            return Err(errors);
        }
        let machine = Self::from_valid(data);
        if machine.home.det.abs() < validate::LEAST_HOME_DET {
            return Err(vec![MachineError::new("geometry", "the home pose is a parallel singularity")]);
        }
        Ok(machine)
    }

    /// The data from which the machine was made.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    ///
    /// let data = Machine::verne().data().clone();
    /// assert_eq!(Machine::new(data), Ok(Machine::verne()));
    /// ```
    pub fn data(&self) -> &MachineData {
        &self.data
    }

    /// The machine's name, as requests use it.
    ///
    /// # Examples
    ///
    /// ```
    /// assert_eq!(verne_solver::Machine::verne().name(), "verne");
    /// ```
    pub fn name(&self) -> &str {
        &self.data.name
    }

    /// The longest dimension that occurs in the equations. A length in a request may be up to
    /// [`MAX_LENGTH_RATIO`](crate::MAX_LENGTH_RATIO) times as long.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    /// assert_eq!(verne_solver::Machine::verne().longest(), 1050.0, "a rod");
    /// ```
    pub fn longest(&self) -> f64 {
        self.mechanism.longest
    }

    /// A machine from data that are known to be valid.
    fn from_valid(data: MachineData) -> Self {
        let mechanism = Mechanism::new(data.geometry);
        let home = Home::new(&mechanism, &data.limits);
        let normalization = Normalization::new(&data.geometry, &data.limits, home.det, home.rod_distance);
        Self { data, mechanism, home, normalization }
    }

    pub(crate) fn geometry(&self) -> &Geometry {
        &self.mechanism.geometry
    }

    pub(crate) fn limits(&self) -> &Limits {
        &self.data.limits
    }

    pub(crate) fn table(&self) -> &Table {
        &self.data.table
    }
}
