//! The drives of a machine as JSON: mm and degrees, per second and second squared.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use verne_solver::machine::{Drive, Drives};

use crate::wire::degrees::{from_degrees, to_degrees};
use crate::wire::strict_object::strict_object;

/// The drives of the machine, for the times of tool paths. They change no posture, no margin and no workspace, and
/// neither the machine's hash nor the id of a workspace.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct DrivesObject {
    /// Each of the three sliders.
    #[serde(deserialize_with = "strict_object")]
    #[schema(inline)]
    pub slider: SliderDrive,
    /// theta1.
    #[serde(deserialize_with = "strict_object")]
    #[schema(inline)]
    pub tilt: AxisDrive,
    /// theta2.
    #[serde(deserialize_with = "strict_object")]
    #[schema(inline)]
    pub rotary: AxisDrive,
}

/// The drive of a slider.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct SliderDrive {
    /// Greatest velocity, mm/s.
    #[schema(minimum = 1e-3, maximum = 1e6)]
    pub velocity: f64,
    /// Greatest acceleration, mm/s². Without it, the slider changes its velocity at once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(minimum = 1e-3, maximum = 1e9)]
    pub acceleration: Option<f64>,
}

/// The drive of one of the table's axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct AxisDrive {
    /// Greatest velocity, degrees/s.
    #[schema(minimum = 1e-3, maximum = 1e6)]
    pub velocity: f64,
    /// Greatest acceleration, degrees/s². Without it, the axis changes its velocity at once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(minimum = 1e-3, maximum = 1e9)]
    pub acceleration: Option<f64>,
}

impl From<&DrivesObject> for Drives {
    fn from(object: &DrivesObject) -> Self {
        let SliderDrive { velocity, acceleration } = object.slider;
        let axis = |drive: &AxisDrive| Drive {
            velocity: from_degrees(drive.velocity),
            acceleration: drive.acceleration.map(from_degrees),
        };
        Self {
            slider: Drive { velocity, acceleration },
            tilt: axis(&object.tilt),
            rotary: axis(&object.rotary),
        }
    }
}

impl From<&Drives> for DrivesObject {
    fn from(drives: &Drives) -> Self {
        let Drive { velocity, acceleration } = drives.slider;
        let axis = |drive: Drive| AxisDrive {
            velocity: to_degrees(drive.velocity),
            acceleration: drive.acceleration.map(to_degrees),
        };
        Self {
            slider: SliderDrive { velocity, acceleration },
            tilt: axis(drives.tilt),
            rotary: axis(drives.rotary),
        }
    }
}
