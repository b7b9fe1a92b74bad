//! A tilted plane.

use nalgebra::{Matrix3, Vector3};

/// A tilted plane: points are relative to its origin, along its axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TiltedPlane {
    /// In the program's frame, mm.
    pub(crate) origin: Vector3<f64>,
    /// Its columns are the axes of the plane in the program's frame.
    pub(crate) rotation: Matrix3<f64>,
    /// G53.1 was stated: the tool's axis is the plane's normal.
    pub(crate) aligned: bool,
}

impl TiltedPlane {
    pub(crate) fn point_to_program(&self, point: [f64; 3]) -> [f64; 3] {
        (self.origin + self.rotation * Vector3::from(point)).into()
    }

    pub(crate) fn point_from_program(&self, point: [f64; 3]) -> [f64; 3] {
        (self.rotation.transpose() * (Vector3::from(point) - self.origin)).into()
    }

    /// A direction in the program's frame. A unit vector stays one.
    pub(crate) fn direction_to_program(&self, direction: [f64; 3]) -> [f64; 3] {
        (self.rotation * Vector3::from(direction)).into()
    }
}
