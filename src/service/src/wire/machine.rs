//! The machine as JSON: lengths in mm, angles in degrees.

use serde::{Deserialize, Deserializer, Serialize};
use utoipa::ToSchema;
use verne_solver::MachineData;
use verne_solver::machine::{Geometry, Limits, Table};

use crate::wire::degrees::{from_degrees, to_degrees};
use crate::wire::drives::DrivesObject;
use crate::wire::fixed_array::{Axes, FixedArray, Pair, PairPerSlider};
use crate::wire::strict_object::{optional_strict_object, strict_object};

/// A machine of the VERNE architecture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Machine)]
pub struct MachineObject {
    /// Short name. Answers repeat it.
    #[schema(min_length = 1, max_length = 64, example = "verne")]
    pub name: String,
    /// Source of the numbers.
    #[serde(default)]
    pub description: String,
    /// The parallel module.
    #[serde(deserialize_with = "strict_object")]
    #[schema(inline)]
    pub geometry: GeometryObject,
    /// The tilting table.
    #[serde(deserialize_with = "strict_object")]
    #[schema(inline)]
    pub table: TableObject,
    /// Limits of joints and of singularities.
    #[serde(deserialize_with = "strict_object")]
    #[schema(inline)]
    pub limits: LimitsObject,
    /// The drives, for the times of tool paths. They change neither the machine's hash nor the id of a workspace.
    #[serde(default, deserialize_with = "optional_strict_object", skip_serializing_if = "Option::is_none")]
    #[schema(inline)]
    pub drives: Option<DrivesObject>,
}

/// Dimensions of the parallel module, in mm, with the paper's symbols (Fig. 3, Eqs (3)-(6)).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[allow(non_snake_case, reason = "the paper's symbols: D1 and d1 are two dimensions")]
pub struct GeometryObject {
    /// x of leg I's joints on the platform, in the platform frame.
    #[schema(minimum = -1e6, maximum = 1e6)]
    pub D1: f64,
    /// x of leg I's guideway, in the base frame.
    #[schema(minimum = -1e6, maximum = 1e6)]
    pub d1: f64,
    /// x of legs II and III's joints on the platform, in the platform frame.
    #[schema(minimum = -1e6, maximum = 1e6)]
    pub D2: f64,
    /// x of the guideways of legs II and III, in the base frame.
    #[schema(minimum = -1e6, maximum = 1e6)]
    pub d2: f64,
    /// Half-distance of the joints of leg I on the platform. It must be at least r1. With R1 = r1
    /// the platform does not turn, and the machine is a linear delta.
    #[schema(minimum = 1e-3, maximum = 1e6)]
    pub R1: f64,
    /// Half-distance of leg I's joints on the slider.
    #[schema(minimum = 1e-3, maximum = 1e6)]
    pub r1: f64,
    /// Half-distance of legs II and III on the platform.
    #[schema(minimum = 1e-3, maximum = 1e6)]
    pub R2: f64,
    /// Half-distance of legs II and III's guideways.
    #[schema(minimum = 1e-3, maximum = 1e6)]
    pub r4: f64,
    /// Rod length of leg I.
    #[schema(minimum = 1e-3, maximum = 1e6)]
    pub L1: f64,
    /// Rod length of leg II.
    #[schema(minimum = 1e-3, maximum = 1e6)]
    pub L2: f64,
    /// Rod length of leg III.
    #[schema(minimum = 1e-3, maximum = 1e6)]
    pub L3: f64,
    /// Half-width of the parallelograms of legs II and III.
    #[schema(minimum = 1e-3, maximum = 1e6)]
    pub parallelogram_half_width: f64,
    /// Angle from x towards y of the width of leg II's parallelogram, degrees; that of leg III has the opposite angle.
    /// It must be 0, the default, unless R1 = r1. It matters for rod interference only.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schema(minimum = -180, maximum = 180, default = 0)]
    pub parallelogram_direction: f64,
    /// Radius of every rod.
    #[schema(minimum = 0, maximum = 1e6)]
    pub rod_radius: f64,
}

/// The tilting table's offsets, in mm (Eq (7)).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct TableObject {
    /// z of the tilting axis in the base frame; z points down.
    #[schema(minimum = -1e6, maximum = 1e6)]
    pub da: f64,
    /// Offset from the tilting axis to the table's origin.
    #[schema(minimum = -1e6, maximum = 1e6)]
    pub dt: f64,
}

/// Limits of joints and of singularities.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitsObject {
    /// `[min, max]` of each slider, mm.
    #[schema(inline)]
    pub stroke: PairPerSlider,
    /// Half-angle of the cone that each rod may use at its slider, degrees.
    #[schema(exclusive_minimum = 0, maximum = 180)]
    pub slider_cone: f64,
    /// Half-angle of the cone that each rod may use at the platform, degrees.
    #[schema(exclusive_minimum = 0, maximum = 180)]
    pub platform_cone: f64,
    /// Least cosine of the angle between a rod and its guideway.
    #[schema(minimum = 0, exclusive_maximum = 1)]
    pub serial_margin: f64,
    /// Least parallel conditioning, with the sign that it has at home.
    #[schema(minimum = 0, exclusive_maximum = 1)]
    pub parallel_margin: f64,
    /// `[min, max]` of theta1, degrees.
    #[schema(inline)]
    pub tilt: Pair,
    /// `[min, max]` of theta2, degrees; null if the table turns without a limit.
    #[serde(deserialize_with = "nullable")]
    #[schema(inline, required)]
    pub rotary: Option<Pair>,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Without it, the service checks the table only if a request has a clearance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(minimum = 0, maximum = 1e6)]
    pub table_clearance: Option<f64>,
    /// Axes of the slider cones in the base frame, for rod 11, rod 12, leg II and leg III, from slider to platform, of
    /// any length. The default is the directions of the rods at home (x = y = alpha = 0).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(inline)]
    pub slider_axes: Option<Axes>,
    /// Axes of the platform cones in the platform frame, in the same order and direction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(inline)]
    pub platform_axes: Option<Axes>,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde calls it with a reference")]
fn is_zero(number: &f64) -> bool {
    *number == 0.0
}

/// Reads a field that may be null but not missing.
fn nullable<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Pair>, D::Error> {
    Option::deserialize(deserializer)
}

impl From<&MachineObject> for MachineData {
    fn from(object: &MachineObject) -> Self {
        let l = &object.limits;
        Self {
            name: object.name.clone(),
            description: object.description.clone(),
            geometry: (&object.geometry).into(),
            table: Table { da: object.table.da, dt: object.table.dt },
            limits: Limits {
                stroke: l.stroke.0.map(|range| range.0),
                slider_cone: from_degrees(l.slider_cone),
                platform_cone: from_degrees(l.platform_cone),
                serial_margin: l.serial_margin,
                parallel_margin: l.parallel_margin,
                tilt: l.tilt.0.map(from_degrees),
                rotary: l.rotary.map(|range| range.0.map(from_degrees)),
                table_clearance: l.table_clearance,
                slider_axes: l.slider_axes.map(|axes| axes.0.map(|axis| axis.0)),
                platform_axes: l.platform_axes.map(|axes| axes.0.map(|axis| axis.0)),
            },
            drives: object.drives.as_ref().map(Into::into),
        }
    }
}

impl From<&MachineData> for MachineObject {
    fn from(data: &MachineData) -> Self {
        let l = &data.limits;
        Self {
            name: data.name.clone(),
            description: data.description.clone(),
            geometry: (&data.geometry).into(),
            table: TableObject { da: data.table.da, dt: data.table.dt },
            limits: LimitsObject {
                stroke: FixedArray(l.stroke.map(FixedArray)),
                slider_cone: to_degrees(l.slider_cone),
                platform_cone: to_degrees(l.platform_cone),
                serial_margin: l.serial_margin,
                parallel_margin: l.parallel_margin,
                tilt: FixedArray(l.tilt.map(to_degrees)),
                rotary: l.rotary.map(|range| FixedArray(range.map(to_degrees))),
                table_clearance: l.table_clearance,
                slider_axes: l.slider_axes.map(|axes| FixedArray(axes.map(FixedArray))),
                platform_axes: l.platform_axes.map(|axes| FixedArray(axes.map(FixedArray))),
            },
            drives: data.drives.as_ref().map(Into::into),
        }
    }
}

/// Converts dimensions, whose fields have the same names in requests and in the solver.
macro_rules! convert_dimensions {
    ($($name:ident),*) => {
        impl From<&GeometryObject> for Geometry {
            fn from(g: &GeometryObject) -> Self {
                let parallelogram_direction = from_degrees(g.parallelogram_direction);
                Self { $($name: g.$name,)* parallelogram_direction }
            }
        }

        impl From<&Geometry> for GeometryObject {
            fn from(g: &Geometry) -> Self {
                let parallelogram_direction = to_degrees(g.parallelogram_direction);
                Self { $($name: g.$name,)* parallelogram_direction }
            }
        }
    };
}

convert_dimensions!(D1, d1, D2, d2, R1, r1, R2, r4, L1, L2, L3, parallelogram_half_width, rod_radius);
