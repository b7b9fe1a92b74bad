//! The orientation of the tool.

use nalgebra::Vector3;

/// The orientation of the tool at the end of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientation {
    /// The program states the axis: a unit vector from the tip to the holder. Between two points the axis follows the
    /// great circle.
    Vector([f64; 3]),
    /// The program states rotary words. Between two points the words change linearly.
    Rotary {
        /// Rotation about x, radians.
        phi1: f64,
        /// Rotation about z, radians.
        phi2: f64,
    },
}

impl Orientation {
    /// The axis, a unit vector from the tip to the holder: (sin phi1 sin phi2, -sin phi1 cos phi2, cos phi1) for rotary
    /// words.
    ///
    /// ```
    /// use verne_program::Orientation;
    ///
    /// assert_eq!(Orientation::Rotary { phi1: 0.0, phi2: 1.0 }.axis(), [0.0, 0.0, 1.0]);
    /// ```
    pub fn axis(self) -> [f64; 3] {
        match self {
            Self::Vector(axis) => axis,
            Self::Rotary { phi1, phi2 } => {
                let ((s1, c1), (s2, c2)) = (phi1.sin_cos(), phi2.sin_cos());
                // Adding zero turns -0.0 into 0.0.
                [s1 * s2 + 0.0, 0.0 - s1 * c2, c1 + 0.0]
            }
        }
    }
}

/// The unit vector of a direction: none for a zero vector. Its components are never -0.0, and a vector that is of unit
/// length to the last digits stays as it is.
pub(crate) fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let vector = Vector3::from(vector);
    let largest = vector.amax();
    if largest <= 0.0 || !largest.is_finite() {
        return None;
    }
    let unit = if (vector.norm_squared() - 1.0).abs() <= 4.0 * f64::EPSILON {
        vector
    } else {
        // First by the largest component: squares of very small or large ones would not be representable.
        (vector / largest).normalize()
    };
    Some(unit.add_scalar(0.0).into())
}

#[cfg(test)]
mod tests {
    use super::unit;

    #[test]
    fn unit_vectors_are_exact_and_without_negative_zeros() {
        assert_eq!(unit([0.0, 0.0, 7.0]), Some([0.0, 0.0, 1.0]));
        let axis = unit([-0.0, -0.0, 1.0]).unwrap_or_default();
        assert!(axis.iter().all(|n| n.is_sign_positive()), "{axis:?}");
        assert_eq!(unit([0.0; 3]), None);
        for vector in [[1e-300, 2e-300, -1e-300], [1e300, 1e300, 0.0], [0.1, 0.2, 0.3]] {
            let once = unit(vector).unwrap_or_default();
            assert_eq!(unit(once), Some(once));
        }
    }
}
