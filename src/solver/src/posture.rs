//! A posture: platform pose and slider positions that satisfy Eqs (3)-(6), and its labels.

use arrayvec::ArrayVec;

use crate::error::KinematicsError;
use crate::limit::Margin;
use crate::pose::PlatformPose;

/// The relative height of a leg's two ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Side {
    /// The slider is above the platform (s = +1).
    Above,
    /// The slider is below the platform (s = -1).
    Below,
}

impl Side {
    /// The side of a slider whose platform end lies `height` below it (z points down).
    #[inline(always)]
    pub(crate) fn of(height: f64) -> Self {
        if height < 0.0 { Self::Below } else { Self::Above }
    }

    /// +1 for above, -1 for below.
    #[inline(always)]
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Above => 1.0,
            Self::Below => -1.0,
        }
    }
}

/// The label of a solution: the sign of each leg's root, and whether the rods of leg I cross.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Mode {
    /// The signs s1, s2, s3.
    pub legs: [Side; 3],
    /// Whether R1 cos alpha < r1.
    pub crossed: bool,
}

/// A posture of the parallel module that satisfies Eqs (3)-(6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Posture {
    /// Pose of the platform.
    pub pose: PlatformPose,
    /// Slider positions, mm.
    pub rho: [f64; 3],
    /// The label.
    pub mode: Mode,
    /// Whether the posture is in the working mode: on all six rods the slider end is above the platform end, and the
    /// rods of leg I do not cross.
    pub working: bool,
    /// Whether two solutions coincide here, within double precision: a singularity.
    pub merged: bool,
    /// Largest error of a rod's length in Eqs (3)-(6), mm.
    pub residual: f64,
}

/// The greatest number of postures of one request (whole machine, inverse problem).
pub const MAX_POSTURES: usize = 24;

/// All solutions of one request.
pub type Postures = ArrayVec<Posture, MAX_POSTURES>;

/// The postures that `fill` finds, or the margin that prevents them if it finds none. They are built in place, because
/// moving them would cost as much as finding some of them.
#[inline]
pub(crate) fn postures_or_error(
    fill: impl FnOnce(&mut Postures),
    preventing_margin: impl FnOnce() -> Margin,
) -> Result<Postures, KinematicsError> {
    let mut answer = Ok(Postures::new());
    if let Ok(found) = &mut answer {
        fill(found);
        if found.is_empty() {
            answer = Err(KinematicsError::Unreachable(preventing_margin()));
        }
    }
    answer
}
