//! The Jacobian of the whole machine: from the rates of all joints to those of the tool in the part frame.

use nalgebra::{Matrix3, Matrix5, Vector3};

use super::{SINGULAR, velocities};
use crate::machine::{Drives, Machine};
use crate::pose::{PlatformPose, TableAngles};
use crate::posture::Posture;
use crate::tool_motion::ToolMotion;
use crate::turns::Turns;

/// A way in which a posture is singular.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Singularity {
    /// The platform can move while the joints stand still: it has no Jacobian.
    Parallel,
    /// phi1 = 0: theta2 turns without moving the tool's axis.
    Pole,
    /// The joints can move while the tool stands still, also away from the pole: a rod is perpendicular to its
    /// guideway, or two inverse solutions coincide.
    Inverse,
}

/// The greatest speed of the tool's end in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GreatestSpeed {
    /// Speed, mm/s.
    pub speed: f64,
    /// Index of the joint whose drive limits it: rho1, rho2, rho3, theta1, theta2.
    pub joint: usize,
}

/// The Jacobian of a posture with a tool.
///
/// # Units
///
/// Rows: velocity of the tool's end along x, y and z of the part frame, mm/s; phi1' and sin(phi1) phi2', rad/s.
/// Columns: rho1', rho2', rho3', mm/s; theta1', theta2', rad/s.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), (9), (14), (26),
/// differentiated.
/// Gosselin, Angeles 1990, [doi:10.1109/70.56660](https://doi.org/10.1109/70.56660): singularities of types 1 and 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolJacobian {
    matrix: [[f64; 5]; 5],
    /// alpha' with each slider, rad/mm.
    inclination_rates: [f64; 3],
    /// Sine of phi1.
    inclination: f64,
}

impl ToolJacobian {
    /// Computes the Jacobian of a posture, for a tool of length `tool_length` from P. The answer is `None` at a
    /// parallel singularity.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), (9), (14), (26).
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::jacobian::ToolJacobian;
    /// use verne_solver::{KinematicsError, Machine, TableAngles, forward_working};
    ///
    /// let machine = Machine::verne();
    /// let posture = forward_working(&machine, [674.0, 685.0, 250.0])?;
    /// let level = TableAngles { theta1: 0.0, theta2: 0.0 };
    /// let jacobian = ToolJacobian::of(&machine, &posture, level, 50.0).expect("not singular");
    /// let [_, _, z, ..] = jacobian.matrix();
    /// assert!((z[0] + z[1] + z[2] + 1.0).abs() < 1e-9, "sliders that move down together move the tool down");
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn of(machine: &Machine, posture: &Posture, table: TableAngles, tool_length: f64) -> Option<Self> {
        let rates = velocities(machine, posture)?;
        let turns = Turns::of(posture.pose.alpha, table);
        let [inclination, _] = turns.inclination();
        let tool = ToolMotion::at(machine, &posture.pose, turns, tool_length);
        let slider = |i: usize| {
            let [x, y, z, alpha] = rates.map(|row| row[i]);
            (PlatformPose { x, y, z, alpha }, [0.0; 2])
        };
        let still = PlatformPose::default();
        let columns = [slider(0), slider(1), slider(2), (still, [1.0, 0.0]), (still, [0.0, 1.0])];
        let columns = columns.map(|(pose, table)| {
            let [tip, _] = tool.rates(&pose, table);
            // phi1 = alpha - theta1, phi2 = -theta2.
            [tip.x, tip.y, tip.z, pose.alpha - table[0], -inclination * table[1]]
        });
        let matrix = std::array::from_fn(|row| columns.map(|column| column[row]));
        let is_finite = columns.iter().flatten().all(|number| number.is_finite());
        is_finite.then_some(Self { matrix, inclination_rates: rates[3], inclination })
    }

    /// The matrix, row by row.
    pub fn matrix(&self) -> [[f64; 5]; 5] {
        self.matrix
    }

    /// Computes the singular values, the greatest first.
    ///
    /// # Units
    ///
    /// None: lengths are divided by `characteristic_length`, mm.
    ///
    /// # References
    ///
    /// Angeles, Fundamentals of Robotic Mechanical Systems,
    /// [doi:10.1007/978-3-319-01851-5](https://doi.org/10.1007/978-3-319-01851-5): the characteristic length.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::jacobian::ToolJacobian;
    /// use verne_solver::{KinematicsError, Machine, TableAngles, forward_working};
    ///
    /// let machine = Machine::verne();
    /// let posture = forward_working(&machine, [674.0, 685.0, 250.0])?;
    /// let pole = TableAngles { theta1: posture.pose.alpha, theta2: 0.0 };
    /// let jacobian = ToolJacobian::of(&machine, &posture, pole, 50.0).expect("no parallel singularity");
    /// let values = jacobian.singular_values(300.0);
    /// assert!(values[0] >= values[3] && values[3] > 0.01);
    /// assert!(values[4] < 1e-15, "theta2 moves the axis about itself");
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn singular_values(&self, characteristic_length: f64) -> [f64; 5] {
        let unit = |i: usize| if i < 3 { 1.0 } else { characteristic_length };
        let scaled = Matrix5::from_fn(|row, column| self.matrix[row][column] * unit(row) / unit(column));
        let mut values: [f64; 5] = scaled.singular_values().into();
        values.sort_by(|a, b| b.total_cmp(a));
        values
    }

    /// Computes the condition number: the greatest singular value over the least; `None` at a singularity.
    ///
    /// # Units
    ///
    /// None: lengths are divided by `characteristic_length`, mm.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::jacobian::ToolJacobian;
    /// use verne_solver::{KinematicsError, Machine, TableAngles, forward_working};
    ///
    /// let machine = Machine::verne();
    /// let posture = forward_working(&machine, [674.0, 685.0, 250.0])?;
    /// let at = |theta1| ToolJacobian::of(&machine, &posture, TableAngles { theta1, theta2: 0.0 }, 50.0);
    /// let number = |theta1| at(theta1).and_then(|jacobian| jacobian.condition_number(300.0));
    /// assert!(number(-1.0).is_some_and(|number| number > 1.0));
    /// assert_eq!(number(posture.pose.alpha), None, "the pole");
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn condition_number(&self, characteristic_length: f64) -> Option<f64> {
        if !self.singularities().is_empty() {
            return None;
        }
        let [most, .., least] = self.singular_values(characteristic_length);
        Some(most / least).filter(|number| number.is_finite())
    }

    /// Lists the ways in which the matrix is singular to double precision.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::jacobian::{Singularity, ToolJacobian};
    /// use verne_solver::{KinematicsError, Machine, TableAngles, forward_working};
    ///
    /// let machine = Machine::verne();
    /// let posture = forward_working(&machine, [674.0, 685.0, 250.0])?;
    /// let pole = TableAngles { theta1: posture.pose.alpha, theta2: 0.0 };
    /// let jacobian = ToolJacobian::of(&machine, &posture, pole, 50.0).expect("no parallel singularity");
    /// assert_eq!(jacobian.singularities(), [Singularity::Pole]);
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn singularities(&self) -> Vec<Singularity> {
        let values = self.translation().singular_values();
        let is_inverse = values.min() <= SINGULAR * values.max();
        let is_pole = self.inclination.abs() <= SINGULAR;
        let each = [(is_pole, Singularity::Pole), (is_inverse, Singularity::Inverse)];
        each.into_iter().filter_map(|(is_present, kind)| is_present.then_some(kind)).collect()
    }

    /// Computes the greatest speed of the tool's end along x, y and z of the part frame, in both senses, while the
    /// other two components and the tool's axis stand still: the least over the joints of the drive's velocity over the
    /// rate of the joint. theta2 stands still, also at the pole. The answer is `None` at an inverse singularity.
    ///
    /// # Units
    ///
    /// mm/s.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::jacobian::ToolJacobian;
    /// use verne_solver::machine::{Drive, Drives};
    /// use verne_solver::{KinematicsError, Machine, TableAngles, platform_working};
    ///
    /// let machine = Machine::verne();
    /// let posture = platform_working(&machine, [0.0, 0.0, 1200.0])?;
    /// let level = TableAngles { theta1: 0.0, theta2: 0.0 };
    /// let jacobian = ToolJacobian::of(&machine, &posture, level, 50.0).expect("no parallel singularity");
    /// let drive = |velocity| Drive { velocity, acceleration: None };
    /// let drives = Drives { slider: drive(500.0), tilt: drive(1.0), rotary: drive(1.0) };
    /// let [_, _, z] = jacobian.greatest_speeds(&drives).expect("no inverse singularity");
    /// assert!((z.speed - 500.0).abs() < 1e-6, "the three sliders move together");
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn greatest_speeds(&self, drives: &Drives) -> Option<[GreatestSpeed; 3]> {
        if self.singularities().contains(&Singularity::Inverse) {
            return None;
        }
        let inverse = self.translation().try_inverse()?;
        let velocities = drives.of_joints().map(|drive| drive.velocity);
        let along = |axis: usize| {
            let sliders: Vector3<f64> = inverse.column(axis).into();
            let tilt = sliders.dot(&Vector3::from(self.inclination_rates));
            let rates = [sliders.x, sliders.y, sliders.z, tilt];
            let speeds = rates.iter().zip(velocities).enumerate();
            let speeds =
                speeds.map(|(joint, (rate, most))| GreatestSpeed { speed: most / rate.abs(), joint });
            let speeds = speeds.filter(|found| found.speed.is_finite());
            speeds.min_by(|a, b| a.speed.total_cmp(&b.speed))
        };
        Some([along(0)?, along(1)?, along(2)?])
    }

    /// Computes how far the tool's end moves, to the first order, when one joint is off: `slider` is the error of each
    /// of rho1 to rho3, `table` that of theta1 and of theta2.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::jacobian::ToolJacobian;
    /// use verne_solver::{KinematicsError, Machine, TableAngles, platform_working};
    ///
    /// let machine = Machine::verne();
    /// let posture = platform_working(&machine, [30.0, 40.0, 1200.0])?;
    /// let level = TableAngles { theta1: 0.0, theta2: 0.0 };
    /// let jacobian = ToolJacobian::of(&machine, &posture, level, 0.0).expect("no parallel singularity");
    /// let [.., theta2] = jacobian.tip_errors(1e-3, 1e-5);
    /// assert!((theta2 - 50.0 * 1e-5).abs() < 1e-12, "the tool's end is 50 mm from the table's axis");
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn tip_errors(&self, slider: f64, table: f64) -> [f64; 5] {
        let column = |i: usize| Vector3::from([0, 1, 2].map(|row: usize| self.matrix[row][i])).norm();
        std::array::from_fn(|i| column(i) * if i < 3 { slider } else { table })
    }

    /// Rates of the tool's end with each slider, while theta1 follows alpha and the tool's axis stands still.
    fn translation(&self) -> Matrix3<f64> {
        Matrix3::from_fn(|row, i| self.matrix[row][i] + self.matrix[row][3] * self.inclination_rates[i])
    }
}
