//! A curve as something on which points can be found: the zeros of a function, or leg I's fold in closed form.

use nalgebra::{Matrix3, Vector3};

use super::continuation::dot;
use super::fold::Fold;
use super::place::Configuration;
use super::target::System;

/// A curve.
#[derive(Clone, Copy, Debug)]
pub(super) enum Path<'a> {
    Zeros(System<'a>),
    Fold(Fold<'a>),
}

impl Path<'_> {
    /// The point between two points of the curve.
    pub(super) fn between(
        &self,
        a: &Configuration,
        b: &Configuration,
        fraction: f64,
    ) -> Option<Configuration> {
        match self {
            Self::Zeros(system) => system.between(a, b, fraction),
            Self::Fold(fold) => Some(fold.between(a, b, fraction)),
        }
    }

    pub(super) fn image(&self, q: &Configuration) -> [f64; 2] {
        match self {
            Self::Zeros(system) => system.image(q),
            Self::Fold(fold) => fold.image(q),
        }
    }

    /// The unit vector along the image, of either sense.
    pub(super) fn direction(&self, q: &Configuration) -> Option<[f64; 2]> {
        let along = match self {
            Self::Zeros(system) if system.target.is_critical() => system.range_of_image(q)?,
            Self::Zeros(system) => system.velocity(q, &system.tangent(q)?),
            Self::Fold(fold) => fold.direction(q),
        };
        let length = along[0].hypot(along[1]);
        (length > 1e-12).then(|| along.map(|component| component / length))
    }

    /// Whether the image may turn back.
    pub(super) fn is_critical(&self) -> bool {
        matches!(self, Self::Zeros(system) if system.target.is_critical())
    }

    /// The velocity of the image of a critical curve, for a motion in the sense of a chord.
    pub(super) fn critical_velocity(&self, q: &Configuration, chord: &Configuration) -> Option<[f64; 2]> {
        match self {
            Self::Zeros(system) if system.target.is_critical() => {
                let tangent = system.tangent(q)?;
                let sense = dot(&tangent, chord).signum();
                Some(system.velocity(q, &tangent).map(|component| component * sense))
            }
            _ => None,
        }
    }
}

impl System<'_> {
    /// The velocity of the image for a velocity of the configuration.
    pub(super) fn velocity(&self, q: &Configuration, rate: &Configuration) -> [f64; 2] {
        self.image_slopes(q).map(|slopes| dot(&slopes, rate))
    }

    /// The direction in which the image can move where it can move in one direction only.
    fn range_of_image(&self, q: &Configuration) -> Option<[f64; 2]> {
        let (_, [first, second, third, _]) = self.linearised(q);
        let gradients = [first, second, third];
        // The slopes less their parts along the gradients of the three equations that hold.
        let gram = Matrix3::from_fn(|row, column| dot(&gradients[row], &gradients[column]));
        let inverse = gram.try_inverse()?;
        let projected = self.image_slopes(q).map(|slopes| {
            let along = inverse * Vector3::from_fn(|i, _| dot(&gradients[i], &slopes));
            let free: Configuration =
                std::array::from_fn(|j| slopes[j] - (0..3).map(|i| along[i] * gradients[i][j]).sum::<f64>());
            free
        });
        // The dominant eigenvector of the 2×2 matrix of products.
        let [a, b, d] = [
            dot(&projected[0], &projected[0]),
            dot(&projected[0], &projected[1]),
            dot(&projected[1], &projected[1]),
        ];
        let half = 0.5 * (a - d);
        let root = half.hypot(b);
        Some(if half > 0.0 { [half + root, b] } else { [b, root - half] })
    }
}
