//! The built-in linear delta.

use super::Machine;
use super::data::{Limits, MachineData, Table};
use crate::mechanism::Geometry;

impl Machine {
    /// An example of a linear delta, `linear-delta`: R1 = r1, so the platform does not turn. Its dimensions are
    /// invented round numbers: guideways on a circle of radius 400 mm, joints of the platform on one of 60 mm, rods of
    /// 700 mm, each pair 80 mm apart along the circle's tangent.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::{KinematicsError, Machine, platform_working};
    ///
    /// let posture = platform_working(&Machine::linear_delta(), [120.0, -80.0, 800.0])?;
    /// assert_eq!(posture.pose.alpha, 0.0);
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn linear_delta() -> Self {
        let half_root = 0.75_f64.sqrt();
        Self::from_valid(MachineData {
            name: "linear-delta".into(),
            description:
                "Example of a linear delta with three columns on a circle: invented round dimensions, no \
                          product's."
                    .into(),
            geometry: Geometry {
                D1: 60.0,
                d1: 400.0,
                D2: -30.0,
                d2: -200.0,
                R1: 40.0,
                r1: 40.0,
                R2: 60.0 * half_root,
                r4: 400.0 * half_root,
                L1: 700.0,
                L2: 700.0,
                L3: 700.0,
                parallelogram_half_width: 40.0,
                parallelogram_direction: -30_f64.to_radians(),
                rod_radius: 6.0,
            },
            table: Table { da: 1200.0, dt: 100.0 },
            limits: Limits {
                stroke: [[0.0, 600.0]; 3],
                slider_cone: 45_f64.to_radians(),
                platform_cone: 45_f64.to_radians(),
                serial_margin: 0.3,
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
