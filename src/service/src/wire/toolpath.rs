//! `POST /toolpath`: the request as a client sends it.

use std::collections::BTreeMap;
use std::fmt;

use clap::ValueEnum;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use utoipa::ToSchema;
use verne_program::Units;

use crate::wire::machine_ref::MachineRef;
use crate::wire::program_points::ProgramPoints;
use crate::wire::program_query::units;
use crate::wire::start::Start;
use crate::wire::strict_object::{StrictObject, optional_strict_object, strict_object};

/// A request for the joint motion of a program.
#[derive(Clone, Debug, Default, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ToolpathRequest {
    /// The program: the id of a stored program, or its points.
    #[serde(default)]
    #[schema(value_type = ProgramRef)]
    pub program: Option<ProgramRef>,
    /// The unit of lengths in the points: `mm` (default) or `inch`. A stored program states its own unit.
    #[serde(default)]
    #[schema(schema_with = units)]
    pub units: Option<Units>,
    /// The machine: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// The program's frame in the part frame.
    #[serde(default, deserialize_with = "strict_object")]
    pub setup: Setup,
    /// The program's frame in the part frame for each work offset that the program calls, by the names `G54` to `G59`,
    /// `G59.1`, `G59.2` and `G59.3`. `setup` is the frame of G54 unless it is listed here.
    #[serde(default, deserialize_with = "strict_objects")]
    pub offsets: BTreeMap<String, Setup>,
    /// Distance from P to the tool end, mm: one number for every tool, or an object with the length of each tool by its
    /// number. Without it the lengths that the program states are used.
    #[serde(default)]
    pub tool_length: Option<ToolLengths>,
    /// The entry of `tool_length` for moves before the program calls a tool.
    #[serde(default)]
    pub length_before: Option<u32>,
    /// Radius of the tool's end, mm. Only `tip: "centre"` and `table_clearance` use it.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// The point of the tool that the program moves.
    #[serde(default)]
    pub tip: TipName,
    /// The motion of the axis between two points. The default follows the words of each point: `vector` for i, j, k,
    /// and `rotary` for phi1, phi2.
    #[serde(default)]
    pub orientation: Option<OrientationName>,
    /// Whether the table keeps the program's phi2 also where phi1 is 0, so that phi2 does not turn the tool's axis. It
    /// then turns through the stated angles everywhere; otherwise theta2 is free there. Only moves between points with
    /// rotary words keep it, and only frames with a = b = 0 allow it.
    #[serde(default)]
    pub hold_rotary: bool,
    /// Greatest deviations.
    #[serde(default, deserialize_with = "strict_object")]
    pub tolerance: Tolerance,
    /// Half-angle of the cap around the table's own axis in which theta2 is free, degrees: less than the axis
    /// tolerance, of which it is a part. The default is half the axis tolerance.
    #[serde(default)]
    pub pole: Option<f64>,
    /// The motion in rapids.
    #[serde(default)]
    pub rapids: RapidsName,
    /// Where the machine stands before the program: it moves from there to the first point as in a rapid. Without it,
    /// the machine stands at the first point.
    #[serde(default, deserialize_with = "optional_strict_object")]
    pub start: Option<Start>,
    /// Least height of the tool's end and of the platform's six joints over the table (the plane Z = 0 of the part
    /// frame), mm. The default is the limit of the machine; if the machine has none, the service does not check the
    /// table.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7)]
    pub table_clearance: Option<f64>,
    /// Cycle of the controller, s: at a corner of the path the velocity of each drive changes by at most what its
    /// acceleration changes in this time. Only a machine with accelerations in `drives` uses it. The default is 0.004.
    #[serde(default)]
    #[schema(minimum = 1e-6, maximum = 1)]
    pub cycle: Option<f64>,
    /// Behaviour where the machine cannot follow a cut.
    #[serde(default)]
    pub on_limit: OnLimitName,
    /// How far the tool leaves the part along its axis, and how far above the program's highest point it turns with the
    /// table, mm. The default is 50. Only with `on_limit: "retract"`.
    #[serde(default)]
    #[schema(minimum = 0.1, maximum = 1e7)]
    pub clearance: Option<f64>,
    /// Height of the tool's end in the part frame at which the table turns, mm; at least that of the program's highest
    /// point. The default is `clearance` above it. Only with `on_limit: "retract"`.
    #[serde(default)]
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub retract_z: Option<f64>,
}

fn strict_objects<'de, D: Deserializer<'de>>(deserializer: D) -> Result<BTreeMap<String, Setup>, D::Error> {
    let frames = BTreeMap::<String, StrictObject<Setup>>::deserialize(deserializer)?;
    Ok(frames.into_iter().map(|(name, frame)| (name, frame.0)).collect())
}

/// A program: the id of a stored one, or points.
#[derive(Clone, Debug, ToSchema)]
#[serde(untagged)]
pub(crate) enum ProgramRef {
    /// The id from an answer of /programs.
    Id(String),
    /// The points of a short program.
    Points(ProgramPoints),
}

impl<'de> Deserialize<'de> for ProgramRef {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(IdOrPoints)
    }
}

/// Decides by the JSON type: an error inside an object then has its pointer.
struct IdOrPoints;

impl<'de> Visitor<'de> for IdOrPoints {
    type Value = ProgramRef;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the id of a program or {\"points\": [...]}")
    }

    fn visit_str<E: Error>(self, id: &str) -> Result<ProgramRef, E> {
        Ok(ProgramRef::Id(id.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, fields: A) -> Result<ProgramRef, A::Error> {
        ProgramPoints::deserialize(MapAccessDeserializer::new(fields)).map(ProgramRef::Points)
    }
}

/// A frame: p = T + Rot(z, c) Rot(y, b) Rot(x, a) p', with T = (x, y, z).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Setup {
    /// x of the origin, mm.
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub x: f64,
    /// y of the origin, mm.
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub y: f64,
    /// z of the origin, mm.
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub z: f64,
    /// Rotation about x, degrees.
    #[schema(minimum = -36000, maximum = 36000)]
    pub a: f64,
    /// Rotation about y, degrees.
    #[schema(minimum = -36000, maximum = 36000)]
    pub b: f64,
    /// Rotation about z, degrees.
    #[schema(minimum = -36000, maximum = 36000)]
    pub c: f64,
}

/// The lengths of the tools.
#[derive(Clone, Debug, PartialEq, Serialize, ToSchema)]
#[serde(untagged)]
pub(crate) enum ToolLengths {
    /// The length of every tool, mm.
    One(f64),
    /// The length of each tool by its number, mm.
    Table(BTreeMap<u32, f64>),
}

impl<'de> Deserialize<'de> for ToolLengths {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OneOrTable)
    }
}

struct OneOrTable;

impl<'de> Visitor<'de> for OneOrTable {
    type Value = ToolLengths;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or an object of lengths by tool number such as {\"1\": 120}")
    }

    fn visit_f64<E: Error>(self, length: f64) -> Result<ToolLengths, E> {
        Ok(ToolLengths::One(length))
    }

    fn visit_i64<E: Error>(self, length: i64) -> Result<ToolLengths, E> {
        #[expect(clippy::cast_precision_loss, reason = "as JSON's numbers are read elsewhere")]
        Ok(ToolLengths::One(length as f64))
    }

    fn visit_u64<E: Error>(self, length: u64) -> Result<ToolLengths, E> {
        #[expect(clippy::cast_precision_loss, reason = "as JSON's numbers are read elsewhere")]
        Ok(ToolLengths::One(length as f64))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut fields: A) -> Result<ToolLengths, A::Error> {
        let mut table = BTreeMap::new();
        while let Some((name, length)) = fields.next_entry::<String, f64>()? {
            let number = name.parse::<u32>().map_err(|_| {
                A::Error::custom(format_args!("`{name}` is no tool number: a whole number such as \"1\""))
            })?;
            if table.insert(number, length).is_some() {
                return Err(A::Error::custom(format_args!("tool {number} has two lengths")));
            }
        }
        Ok(ToolLengths::Table(table))
    }
}

/// The point of the tool that a program moves: `end` (default), its end; `centre`, the centre of its ball, which is
/// `tool_radius` nearer to the holder.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[schema(as = Tip)]
pub(crate) enum TipName {
    /// The tool's end.
    #[default]
    End,
    /// The centre of the tool's ball.
    Centre,
}

/// The motion of the tool's axis between two points: `vector`, along the great circle at a constant rate; `rotary`,
/// with phi1 and phi2 of the program linear in the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[schema(as = OrientationInterpolation)]
pub(crate) enum OrientationName {
    /// Along the great circle.
    Vector,
    /// With linear angles.
    Rotary,
}

/// The motion in rapids: `linear` (default), the tool's end follows the straight line within `tolerance.rapid` while
/// preimage and winding stay; `joint`, all joints move straight to the end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[schema(as = Rapids)]
pub(crate) enum RapidsName {
    /// The tool's end follows the line.
    #[default]
    Linear,
    /// The joints move straight.
    Joint,
}

/// Behaviour where no winding of the table serves a whole cut: `fail` (default), the report states the limit;
/// `retract`, the tool leaves the part, the table turns by whole turns, and the tool returns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[schema(as = OnLimit)]
pub(crate) enum OnLimitName {
    /// The report states the limit.
    #[default]
    Fail,
    /// The tool leaves the part, the table turns by whole turns, and the tool returns.
    Retract,
}

/// Greatest deviations of the joint motion from the program.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Tolerance {
    /// Deviation of the tool's end in feed moves, mm.
    #[schema(minimum = 1e-5, maximum = 100, default = 0.01)]
    pub tip: f64,
    /// Deviation of the tool's axis in feed moves, degrees.
    #[schema(minimum = 1e-5, maximum = 10, default = 0.05)]
    pub axis: f64,
    /// Deviation of the tool's end in rapids, mm.
    #[schema(minimum = 1e-5, maximum = 1000, default = 1.0)]
    pub rapid: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { tip: 0.01, axis: 0.05, rapid: 1.0 }
    }
}
