//! The orientations (phi1, phi2) that a pose in the part frame requests.

use arrayvec::ArrayVec;
use verne_solver::axis::{Preimages, preimages};
use verne_solver::certificate::EnclosedOrientation;

use crate::wire::degrees::{from_degrees, radians_around};
use crate::wire::field_errors::FieldErrors;
use crate::wire::fixed_array::FixedArray;
use crate::wire::request::{Near, TargetPose};

/// The requested orientations: one, or the two that have the same tool axis.
#[derive(Debug, Default)]
pub(crate) struct RequestedOrientations {
    /// `[phi1, phi2]`, rad.
    pub(crate) each: ArrayVec<[f64; 2], 2>,
    /// Whether the axis leaves phi2 free. The orientation is then one of a family.
    pub(crate) free: bool,
}

impl RequestedOrientations {
    fn one(phi1: f64, phi2: f64) -> Self {
        Self { each: [[phi1, phi2]].into_iter().collect(), free: false }
    }

    /// The member of the family with theta2 of `near`, or with theta2 = 0.
    fn family(phi1: f64, near: Option<&Near>) -> Self {
        Self { free: true, ..Self::one(phi1, 0.0 - from_degrees(theta2_of_family(near))) }
    }
}

/// theta2 of the member of a family of solutions, degrees.
fn theta2_of_family(near: Option<&Near>) -> f64 {
    match near {
        Some(Near::Joints(joints)) => joints.theta2.unwrap_or(0.0),
        _ => 0.0,
    }
}

/// Bounds of the orientations of [`requested_orientations`], in the same order: of the angles in degrees, or of the
/// axis, that the request states. An axis near the table's own counts as the table's own.
pub(crate) fn enclosed_orientations(
    pose: &TargetPose,
    near: Option<&Near>,
) -> ArrayVec<EnclosedOrientation, 2> {
    if let Some(both) = pose.axis.and_then(|axis| EnclosedOrientation::of_axis(axis.0)) {
        return both.into();
    }
    let along_axis = pose.axis.map(|FixedArray([_, _, k])| if k > 0.0 { 0.0 } else { 180.0 });
    let phi1 = along_axis.or(pose.phi1).unwrap_or(0.0);
    // theta2 = -phi2; a free phi2 is that of the family's member.
    let is_free = phi1 % 180.0 == 0.0;
    let phi2 = pose.phi2.unwrap_or_else(|| if is_free { 0.0 - theta2_of_family(near) } else { 0.0 });
    EnclosedOrientation::within(radians_around(phi1), radians_around(phi2)).into_iter().collect()
}

/// The orientations of a pose in frame `part`. Adds a fault if the pose determines none, or contradicts itself.
pub(crate) fn requested_orientations(
    pose: &TargetPose,
    near: Option<&Near>,
    faults: &mut FieldErrors,
) -> RequestedOrientations {
    faults.angle("/pose/phi1", pose.phi1);
    faults.angle("/pose/phi2", pose.phi2);
    match (pose.phi1, pose.phi2, pose.axis) {
        (phi1, None, None) if phi1.unwrap_or(0.0) % 180.0 == 0.0 => {
            RequestedOrientations::family(from_degrees(phi1.unwrap_or(0.0)), near)
        }
        (phi1, phi2, None) => {
            RequestedOrientations::one(from_degrees(phi1.unwrap_or(0.0)), from_degrees(phi2.unwrap_or(0.0)))
        }
        (None, phi2, Some(axis)) => along_axis(axis.0, phi2, near, faults),
        (Some(_), _, Some(_)) => {
            faults.add("/pose/axis", "replaces phi1 and phi2: give either axis, or phi1 and phi2");
            RequestedOrientations::default()
        }
    }
}

fn along_axis(
    axis: [f64; 3],
    phi2: Option<f64>,
    near: Option<&Near>,
    faults: &mut FieldErrors,
) -> RequestedOrientations {
    match (preimages(axis), phi2) {
        (None, _) => {
            faults.add("/pose/axis", "must be a direction: three finite numbers, not all zero");
            RequestedOrientations::default()
        }
        (Some(Preimages::Two(both)), None) => RequestedOrientations { each: both.into(), free: false },
        (Some(Preimages::Two(_)), Some(_)) => {
            faults.add(
                "/pose/phi2",
                "is determined by this axis: give phi2 with axis only for the table's own axis",
            );
            RequestedOrientations::default()
        }
        (Some(Preimages::Free { phi1 }), Some(phi2)) => RequestedOrientations::one(phi1, from_degrees(phi2)),
        (Some(Preimages::Free { phi1 }), None) => RequestedOrientations::family(phi1, near),
    }
}

/// Adds a fault for each field of the orientation, in a frame that has none.
pub(crate) fn check_no_orientation(pose: &TargetPose, faults: &mut FieldErrors) {
    let given = [
        ("/pose/phi1", pose.phi1.is_some()),
        ("/pose/phi2", pose.phi2.is_some()),
        ("/pose/axis", pose.axis.is_some()),
    ];
    for (pointer, _) in given.into_iter().filter(|(_, given)| *given) {
        faults.add(pointer, "is allowed only in frame part: in other frames the orientation follows");
    }
}
