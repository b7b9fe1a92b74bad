//! The distance of a solution from the `near` of a request. Lengths count in mm, angles as arcs of radius R1.

use std::f64::consts::{PI, TAU};

use verne_solver::{Posture, TableAngles};

use crate::wire::degrees::from_degrees;
use crate::wire::field_errors::FieldErrors;
use crate::wire::request::{Joints, Near, NearPose};

/// Checks the numbers of `near`.
pub(crate) fn check_near(near: &Near, faults: &mut FieldErrors) {
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

/// Squared distance, mm², of a solution from `near`. `radius` is R1, mm.
pub(crate) fn squared_distance(
    near: &Near,
    radius: f64,
    posture: &Posture,
    table: Option<TableAngles>,
) -> f64 {
    match near {
        Near::Joints(joints) => joint_distance(joints, radius, posture, table),
        Near::Pose(pose) => pose_distance(pose, radius, posture),
    }
}

fn joint_distance(joints: &Joints, radius: f64, posture: &Posture, table: Option<TableAngles>) -> f64 {
    let sliders: f64 = joints.rho.0.iter().zip(posture.rho).map(|(near, rho)| (rho - near).powi(2)).sum();
    let Some(table) = table else { return sliders };
    // The table's angles are on the winding nearest to `near` already.
    let arc = |near: Option<f64>, angle: f64| {
        near.map_or(0.0, |near| (radius * (angle - from_degrees(near))).powi(2))
    };
    sliders + arc(joints.theta1, table.theta1) + arc(joints.theta2, table.theta2)
}

fn pose_distance(near: &NearPose, radius: f64, posture: &Posture) -> f64 {
    let pose = &posture.pose;
    let turned = near.alpha.map_or(0.0, |alpha| (pose.alpha - from_degrees(alpha) + PI).rem_euclid(TAU) - PI);
    (pose.x - near.x).powi(2)
        + (pose.y - near.y).powi(2)
        + (pose.z - near.z).powi(2)
        + (radius * turned).powi(2)
}
