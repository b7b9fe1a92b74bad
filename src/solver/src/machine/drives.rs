//! Velocities and accelerations of a machine's drives.

/// The greatest velocity and acceleration of a drive, in both directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Greatest velocity: mm/s of a slider, rad/s of an axis of the table.
    pub velocity: f64,
    /// Greatest acceleration: mm/s² or rad/s². `None`: the drive changes its velocity at once.
    pub acceleration: Option<f64>,
}

/// The drives of a machine. They determine times, and nothing else: no posture and no margin depends on them.
///
/// # Units
///
/// Millimetres, radians and seconds.
///
/// # Errors
///
/// [`Machine::new`](crate::Machine::new) refuses velocities and accelerations that are not positive.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::machine::{Drive, Drives};
///
/// let slider = Drive { velocity: 500.0, acceleration: Some(3000.0) };
/// let axis = Drive { velocity: 1.5, acceleration: None };
/// let drives = Drives { slider, tilt: axis, rotary: axis };
/// let mut data = Machine::verne().data().clone();
/// data.drives = Some(drives);
/// assert_eq!(Machine::new(data)?.data().drives, Some(drives));
/// # Ok::<(), Vec<verne_solver::MachineError>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drives {
    /// Each of the three sliders.
    pub slider: Drive,
    /// theta1.
    pub tilt: Drive,
    /// theta2.
    pub rotary: Drive,
}

impl Drives {
    /// The drives of rho1, rho2, rho3, theta1 and theta2.
    ///
    /// # Units
    ///
    /// Millimetres, radians and seconds.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::machine::{Drive, Drives};
    ///
    /// let drive = |velocity| Drive { velocity, acceleration: None };
    /// let drives = Drives { slider: drive(500.0), tilt: drive(1.0), rotary: drive(2.0) };
    /// assert_eq!(drives.of_joints().map(|drive| drive.velocity), [500.0, 500.0, 500.0, 1.0, 2.0]);
    /// ```
    pub fn of_joints(&self) -> [Drive; 5] {
        [self.slider, self.slider, self.slider, self.tilt, self.rotary]
    }

    /// What turning of theta1 and theta2 by a radian costs: time, relative to the faster of both drives. So equal
    /// drives weigh 1, as those of a machine without drives.
    pub(crate) fn turning_weights(&self) -> [f64; 2] {
        let fastest = self.tilt.velocity.max(self.rotary.velocity);
        [self.tilt, self.rotary].map(|drive| fastest / drive.velocity)
    }
}
