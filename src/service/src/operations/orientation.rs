//! The orientations (phi1, phi2) that a pose in the part frame asks for.

use arrayvec::ArrayVec;
use verne_solver::axis::{Preimages, preimages};

use crate::wire::degrees::from_degrees;
use crate::wire::field_errors::FieldErrors;
use crate::wire::request::{Near, TargetPose};

/// One orientation, or the two that share a tool axis; radians.
#[derive(Debug, Default)]
pub(crate) struct Orientations {
    /// `[phi1, phi2]`.
    pub(crate) each: ArrayVec<[f64; 2], 2>,
    /// Whether phi2 is only one choice of many.
    pub(crate) free: bool,
}

impl Orientations {
    fn one(phi1: f64, phi2: f64) -> Self {
        Self { each: [[phi1, phi2]].into_iter().collect(), free: false }
    }

    /// The member of the family that keeps the table where it is, or at zero.
    fn family(phi1: f64, near: Option<&Near>) -> Self {
        let theta2 = match near {
            Some(Near::Joints(joints)) => joints.theta2.unwrap_or(0.0),
            _ => 0.0,
        };
        Self { free: true, ..Self::one(phi1, 0.0 - from_degrees(theta2)) }
    }
}

/// Reads the orientation of a pose; faults where it says too little or too much.
pub(crate) fn orientations(pose: &TargetPose, near: Option<&Near>, faults: &mut FieldErrors) -> Orientations {
    faults.angle("/pose/phi1", pose.phi1);
    faults.angle("/pose/phi2", pose.phi2);
    match (pose.phi1, pose.phi2, pose.axis) {
        (phi1, None, None) if phi1.unwrap_or(0.0) % 180.0 == 0.0 => {
            Orientations::family(from_degrees(phi1.unwrap_or(0.0)), near)
        }
        (phi1, phi2, None) => {
            Orientations::one(from_degrees(phi1.unwrap_or(0.0)), from_degrees(phi2.unwrap_or(0.0)))
        }
        (None, phi2, Some(axis)) => along_axis(axis.0, phi2, near, faults),
        (Some(_), _, Some(_)) => {
            faults.add("/pose/axis", "replaces phi1 and phi2: give either axis, or phi1 and phi2");
            Orientations::default()
        }
    }
}

fn along_axis(
    axis: [f64; 3],
    phi2: Option<f64>,
    near: Option<&Near>,
    faults: &mut FieldErrors,
) -> Orientations {
    match (preimages(axis), phi2) {
        (None, _) => {
            faults.add("/pose/axis", "must be a direction: three finite numbers, not all zero");
            Orientations::default()
        }
        (Some(Preimages::Two(both)), None) => Orientations { each: both.into(), free: false },
        (Some(Preimages::Two(_)), Some(_)) => {
            faults.add(
                "/pose/phi2",
                "is determined by this axis: give phi2 with axis only for the table's own axis",
            );
            Orientations::default()
        }
        (Some(Preimages::Free { phi1 }), Some(phi2)) => Orientations::one(phi1, from_degrees(phi2)),
        (Some(Preimages::Free { phi1 }), None) => Orientations::family(phi1, near),
    }
}

/// Adds errors for an orientation where the frame has none.
pub(crate) fn no_orientation(pose: &TargetPose, faults: &mut FieldErrors) {
    let given = [
        ("/pose/phi1", pose.phi1.is_some()),
        ("/pose/phi2", pose.phi2.is_some()),
        ("/pose/axis", pose.axis.is_some()),
    ];
    for (pointer, _) in given.into_iter().filter(|(_, given)| *given) {
        faults.add(pointer, "is allowed only in frame part: in other frames the orientation follows");
    }
}
