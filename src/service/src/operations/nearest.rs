//! Sorting solutions by distance from a place: lengths in mm, angles as arcs of radius R1.

use std::f64::consts::{PI, TAU};

use crate::operations::solutions::Found;
use crate::wire::degrees::from_degrees;
use crate::wire::field_errors::FieldErrors;
use crate::wire::request::{Joints, Near, NearPose};

/// Checks the numbers of a place.
pub(crate) fn check(near: &Near, faults: &mut FieldErrors) {
    match near {
        Near::Joints(joints) => {
            faults.lengths("/near/rho", &joints.rho.0);
            faults.angle("/near/theta1", joints.theta1);
            faults.angle("/near/theta2", joints.theta2);
        }
        Near::Pose(pose) => {
            for (pointer, value) in [("/near/x", pose.x), ("/near/y", pose.y), ("/near/z", pose.z)] {
                faults.length(pointer, value);
            }
            faults.angle("/near/alpha", pose.alpha);
        }
    }
}

/// Distance of a solution from a place, squared. The radius R1 turns angles into arcs.
pub(crate) fn distance(near: &Near, radius: f64, found: &Found) -> f64 {
    match near {
        Near::Joints(joints) => joint_distance(joints, radius, found),
        Near::Pose(pose) => pose_distance(pose, radius, found),
    }
}

fn joint_distance(joints: &Joints, radius: f64, found: &Found) -> f64 {
    let sliders: f64 =
        joints.rho.0.iter().zip(found.posture.rho).map(|(near, rho)| (rho - near).powi(2)).sum();
    let Some(table) = found.table.map(|table| table.angles) else { return sliders };
    // The table's joints count their revolutions, and stand on the winding nearest to this place.
    let arc = |near: Option<f64>, angle: f64| {
        near.map_or(0.0, |near| (radius * (angle - from_degrees(near))).powi(2))
    };
    sliders + arc(joints.theta1, table.theta1) + arc(joints.theta2, table.theta2)
}

fn pose_distance(near: &NearPose, radius: f64, found: &Found) -> f64 {
    let pose = &found.posture.pose;
    let turned = near.alpha.map_or(0.0, |alpha| (pose.alpha - from_degrees(alpha) + PI).rem_euclid(TAU) - PI);
    (pose.x - near.x).powi(2)
        + (pose.y - near.y).powi(2)
        + (pose.z - near.z).powi(2)
        + (radius * turned).powi(2)
}
