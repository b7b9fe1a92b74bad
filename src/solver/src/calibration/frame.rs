//! The frame of a measuring device.

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::unknown::FrameAxis;

/// Position of a measuring device's frame in the base frame: a point p of the device is at R p + t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasurementFrame {
    rotation: Rotation3<f64>,
    origin: Vector3<f64>,
}

impl MeasurementFrame {
    /// The base frame itself.
    pub(super) const fn base() -> Self {
        let identity = Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
        Self { rotation: Rotation3::from_matrix_unchecked(identity), origin: Vector3::new(0.0, 0.0, 0.0) }
    }

    /// The frame in which the device's points are nearest to points of the base frame, by least squares.
    ///
    /// Umeyama 1991, doi:10.1109/34.88573: the singular value decomposition of the covariance of both, with the sign
    /// that makes it a rotation.
    pub(super) fn aligned(device: &[Vector3<f64>], base: &[Vector3<f64>]) -> Self {
        let (p, u) = (mean(device), mean(base));
        let pairs = device.iter().zip(base);
        let covariance: Matrix3<f64> =
            pairs.map(|(device, base)| (base - u) * (device - p).transpose()).sum();
        let svd = covariance.svd(true, true);
        let (Some(left), Some(right)) = (svd.u, svd.v_t) else { return Self::base() };
        let sign = (left.determinant() * right.determinant()).signum();
        let rotation = left * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * right;
        let rotation = Rotation3::from_matrix_unchecked(rotation);
        Self { rotation, origin: u - rotation * p }
    }

    /// A point of the base frame in the device's frame.
    pub(super) fn point(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.rotation.inverse_transform_vector(&(point - self.origin))
    }

    /// A direction of the base frame in the device's frame.
    pub(super) fn direction(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        self.rotation.inverse_transform_vector(direction)
    }

    /// The frame after a rotation about a point and a shift, both in directions of the base frame.
    pub(super) fn moved(&self, about: &Vector3<f64>, turn: Vector3<f64>, shift: Vector3<f64>) -> Self {
        let turned = Rotation3::new(turn);
        Self { rotation: turned * self.rotation, origin: turned * (self.origin - about) + about + shift }
    }

    /// The device's origin in the base frame, mm.
    pub fn origin(&self) -> [f64; 3] {
        self.origin.into()
    }

    /// The angles a, b, c of the frame's rotation Rot(z, c) Rot(y, b) Rot(x, a), rad.
    pub fn angles(&self) -> [f64; 3] {
        let (a, b, c) = self.rotation.euler_angles();
        [a, b, c]
    }
}

/// The unit vector of an axis.
pub(super) fn unit(axis: FrameAxis) -> Vector3<f64> {
    match axis {
        FrameAxis::X => Vector3::x(),
        FrameAxis::Y => Vector3::y(),
        FrameAxis::Z => Vector3::z(),
    }
}

/// The mean of some points; zero for none.
#[allow(clippy::cast_precision_loss, reason = "a number of points")]
pub(super) fn mean(points: &[Vector3<f64>]) -> Vector3<f64> {
    points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64
}
