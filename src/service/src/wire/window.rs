//! `POST /toolpath/window`.

use std::fmt;

use clap::ValueEnum;
use serde::de::MapAccess;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::wire::answer::MachineId;
use crate::wire::canonical_toolpath::CanonicalToolpath;
use crate::wire::constraint::{ConstraintName, ElementName, Unit};
use crate::wire::limit::Unchecked;
use crate::wire::result_id::ResultId;
use crate::wire::toolpath::{Setup, ToolLengths};
use crate::wire::toolpath_report::MarginObject;
use crate::wire::toolpath_with::{MoreFields, ToolpathWith, read_once};

/// A request for a window.
pub(crate) type WindowBody = ToolpathWith<WindowFields>;

/// The fields of a window beside those of its tool path.
#[derive(Clone, Copy, Debug, Default, ToSchema)]
pub(crate) struct WindowFields {
    /// The parameter. Its own value in the request takes no part.
    #[schema(value_type = WindowParameter)]
    pub parameter: Option<WindowParameter>,
    /// The least value, mm or degrees.
    #[schema(value_type = f64, minimum = -1e7, maximum = 1e7)]
    pub from: Option<f64>,
    /// The greatest value, mm or degrees.
    #[schema(value_type = f64, minimum = -1e7, maximum = 1e7)]
    pub to: Option<f64>,
}

impl MoreFields for WindowFields {
    const REQUEST: &'static str = "WindowRequest";
    const DESCRIPTION: &'static str = "A request for the values of a parameter with which the machine can run a \
                                       program.";

    const NAMES: &'static [&'static str] = &["parameter", "from", "to"];

    fn read<'de, A: MapAccess<'de>>(&mut self, name: &'static str, map: &mut A) -> Result<(), A::Error> {
        match name {
            "parameter" => read_once(&mut self.parameter, name, map),
            "from" => read_once(&mut self.from, name, map),
            _ => read_once(&mut self.to, name, map),
        }
    }
}

/// A parameter of a tool path: `tool_length`, the length of every tool, mm; `setup.x`, `setup.y`, `setup.z`, the origin
/// of the program's frame, mm; `setup.a`, `setup.b`, `setup.c`, its rotations, degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema, ValueEnum)]
pub(crate) enum WindowParameter {
    /// The length of every tool.
    #[serde(rename = "tool_length")]
    #[value(name = "tool_length")]
    ToolLength,
    /// x of the origin.
    #[serde(rename = "setup.x")]
    #[value(name = "setup.x")]
    X,
    /// y of the origin.
    #[serde(rename = "setup.y")]
    #[value(name = "setup.y")]
    Y,
    /// z of the origin.
    #[serde(rename = "setup.z")]
    #[value(name = "setup.z")]
    Z,
    /// Rotation about x.
    #[serde(rename = "setup.a")]
    #[value(name = "setup.a")]
    A,
    /// Rotation about y.
    #[serde(rename = "setup.b")]
    #[value(name = "setup.b")]
    B,
    /// Rotation about z.
    #[serde(rename = "setup.c")]
    #[value(name = "setup.c")]
    C,
}

impl fmt::Display for WindowParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::ToolLength => "tool_length",
            Self::X => "setup.x",
            Self::Y => "setup.y",
            Self::Z => "setup.z",
            Self::A => "setup.a",
            Self::B => "setup.b",
            Self::C => "setup.c",
        })
    }
}

impl WindowParameter {
    /// The unit of its values.
    pub(crate) fn unit(self) -> Unit {
        if matches!(self, Self::A | Self::B | Self::C) { Unit::Degree } else { Unit::Millimetre }
    }

    /// The set-up with a value of the parameter.
    pub(crate) fn setup_with(self, setup: &Setup, value: f64) -> Setup {
        let mut setup = *setup;
        match self {
            Self::ToolLength => return setup,
            Self::X => setup.x = value,
            Self::Y => setup.y = value,
            Self::Z => setup.z = value,
            Self::A => setup.a = value,
            Self::B => setup.b = value,
            Self::C => setup.c = value,
        }
        setup
    }

    /// The tool path with a value of the parameter.
    pub(crate) fn toolpath_with(self, toolpath: &CanonicalToolpath, value: f64) -> CanonicalToolpath {
        let mut changed = toolpath.clone();
        changed.setup = self.setup_with(&toolpath.setup, value);
        if self == Self::ToolLength {
            changed.tool_length = Some(ToolLengths::One(value));
        }
        changed
    }
}

/// The request for a window with its default values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = CanonicalWindowRequest)]
pub(crate) struct CanonicalWindow {
    /// The tool path with the least value of the parameter.
    pub toolpath: CanonicalToolpath,
    /// The parameter.
    pub parameter: WindowParameter,
    /// The least value, mm or degrees.
    pub from: f64,
    /// The greatest value, mm or degrees.
    pub to: f64,
}

/// The values of a parameter with which the machine can run a program.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Window)]
pub(crate) struct WindowAnswer {
    /// BLAKE3 hash of the request, the machine, the program and the version of the service. Equal requests have equal
    /// ids.
    #[schema(value_type = String)]
    pub id: ResultId,
    /// The machine.
    pub machine: MachineId,
    /// The id of the program.
    #[schema(value_type = String)]
    pub program: ResultId,
    /// The request with its default values.
    pub request: CanonicalWindow,
    /// Unit of the parameter's values.
    pub unit: Unit,
    /// The intervals in which the verdict of /toolpath is `ok`, in order.
    pub intervals: Vec<WindowIntervalObject>,
    /// If there is no interval: the examined value that comes nearest to one, with the worst margin there.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub nearest: Option<NearestObject>,
    /// Greatest distance between an end of an interval and the nearest value with the verdict `fails`.
    pub precision: f64,
    /// Width of the intervals, and of the gaps between them, that the search may have missed. Between examined values
    /// it assumes that the worst margin changes at most twice as fast as between the values around.
    pub resolution: f64,
    /// Number of plans of the whole program that the answer rests on.
    pub plans: u64,
    /// Conditions that the service did not check.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Paths of the results.
    pub links: WindowLinks,
}

/// An interval of values. The verdict of /toolpath is `ok` with both of its ends.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = WindowInterval)]
pub(crate) struct WindowIntervalObject {
    /// The least value.
    pub from: f64,
    /// The greatest value.
    pub to: f64,
    /// Its lower and its upper end.
    #[schema(value_type = Vec<WindowEndObject>, min_items = 2, max_items = 2)]
    pub ends: [WindowEndObject; 2],
    /// Greatest distance of two values in the interval, one after the other, with which the whole program was planned.
    pub step: f64,
}

/// The end of an interval: `limit`, the first limit that breaks outside; `bound`, the range of the request.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[schema(as = WindowEnd)]
pub(crate) enum WindowEndObject {
    /// A limit of the machine.
    Limit {
        /// The constraint.
        constraint: ConstraintName,
        /// The part of the machine, such as `slider2.max`.
        #[schema(value_type = String, example = "slider2.max")]
        element: ElementName,
        /// The line.
        line: u32,
    },
    /// The range that was asked for.
    Bound,
}

/// The value that comes nearest to a window.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = NearestToWindow)]
pub(crate) struct NearestObject {
    /// The value of the parameter.
    pub value: f64,
    /// The worst margin with it.
    pub margin: Option<MarginObject>,
}

/// Paths of a window.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct WindowLinks {
    /// This answer.
    #[serde(rename = "self")]
    pub itself: String,
}
