//! The built-in reference machine.

use super::Machine;
use super::data::{Limits, MachineData, Table};
use crate::mechanism::Geometry;

impl Machine {
    /// The reference machine, `verne`. Its dimensions are round numbers chosen so that every solution count printed in
    /// the paper comes out. They are not Fatronik's.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Figs 5 and 6, whose counts it
    /// reproduces.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::{KinematicsError, Machine, forward, platform};
    ///
    /// let machine = Machine::verne();
    /// assert_eq!(platform(&machine, [-240.0, -86.0, 1000.0])?.len(), 16);
    /// assert_eq!(forward(&machine, [674.0, 685.0, 250.0])?.len(), 4);
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn verne() -> Self {
        Self::from_valid(MachineData {
            name: "verne".into(),
            description: "Reference machine: round dimensions that reproduce the solution counts printed in \
                          arXiv:0707.3507. Not Fatronik's dimensions, which the paper does not give."
                .into(),
            geometry: Geometry {
                D1: 100.0,
                d1: 600.0,
                D2: -100.0,
                d2: -600.0,
                R1: 275.0,
                r1: 75.0,
                R2: 150.0,
                r4: 500.0,
                L1: 1050.0,
                L2: 1050.0,
                L3: 1050.0,
                parallelogram_half_width: 80.0,
                parallelogram_direction: 0.0,
                rod_radius: 25.0,
            },
            table: Table { da: 1500.0, dt: 200.0 },
            limits: Limits {
                stroke: [[0.0, 750.0]; 3],
                slider_cone: 42_f64.to_radians(),
                platform_cone: 32_f64.to_radians(),
                serial_margin: 0.1,
                parallel_margin: 0.05,
                tilt: [-90_f64, 90.0].map(f64::to_radians),
                rotary: Some([-360_f64, 360.0].map(f64::to_radians)),
                table_clearance: None,
                slider_axes: None,
                platform_axes: None,
            },
            drives: None,
        })
    }
}
