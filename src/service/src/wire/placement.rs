//! `POST /toolpath/placement`.

use serde::de::MapAccess;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use verne_solver::Constraint;

use crate::wire::answer::MachineId;
use crate::wire::canonical_toolpath::CanonicalToolpath;
use crate::wire::constraint::{ConstraintName, ElementName, Unit};
use crate::wire::fixed_array::Pair;
use crate::wire::limit::Unchecked;
use crate::wire::result_id::ResultId;
use crate::wire::strict_object::StrictObject;
use crate::wire::toolpath::Setup;
use crate::wire::toolpath_report::{MarginObject, Verdict};
use crate::wire::toolpath_with::{MoreFields, ToolpathWith, read_once};

/// A request for a placement.
pub(crate) type PlacementBody = ToolpathWith<PlacementFields>;

/// The fields of a placement beside those of its tool path.
#[derive(Clone, Debug, Default, ToSchema)]
pub(crate) struct PlacementFields {
    /// The parameters that the service may change, each with its least and its greatest value.
    #[schema(value_type = FreeParameters)]
    pub free: Option<FreeParameters>,
    /// The distance to keep from the limits of some constraints.
    #[schema(value_type = Reserve)]
    pub reserve: Option<Reserve>,
}

impl MoreFields for PlacementFields {
    const REQUEST: &'static str = "PlacementRequest";
    const DESCRIPTION: &'static str =
        "A request for the set-up with the greatest reserve. The search begins at `setup` and `tool_length`.";
    const NAMES: &'static [&'static str] = &["free", "reserve"];

    fn read<'de, A: MapAccess<'de>>(&mut self, name: &'static str, map: &mut A) -> Result<(), A::Error> {
        if name == "free" {
            let mut free = self.free.map(StrictObject);
            read_once(&mut free, name, map)?;
            self.free = free.map(|free| free.0);
        } else {
            let mut reserve = self.reserve.map(StrictObject);
            read_once(&mut reserve, name, map)?;
            self.reserve = reserve.map(|reserve| reserve.0);
        }
        Ok(())
    }
}

/// The free parameters of a placement, each with `[least, greatest]`; the others keep the value of the request.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FreeParameters {
    /// x of the program's frame, mm.
    #[serde(default, rename = "setup.x", skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Vec<f64>, min_items = 2, max_items = 2)]
    pub x: Option<Pair>,
    /// y, mm.
    #[serde(default, rename = "setup.y", skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Vec<f64>, min_items = 2, max_items = 2)]
    pub y: Option<Pair>,
    /// z, mm.
    #[serde(default, rename = "setup.z", skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Vec<f64>, min_items = 2, max_items = 2)]
    pub z: Option<Pair>,
    /// Rotation of the program's frame about z, degrees.
    #[serde(default, rename = "setup.c", skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Vec<f64>, min_items = 2, max_items = 2)]
    pub c: Option<Pair>,
    /// The length of the tool, mm. The request must state one number for every tool.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Vec<f64>, min_items = 2, max_items = 2)]
    pub tool_length: Option<Pair>,
}

impl FreeParameters {
    /// The names of the parameters, in the order of [`Self::ranges`].
    pub(crate) const NAMES: [&'static str; 5] = ["setup.x", "setup.y", "setup.z", "setup.c", "tool_length"];

    /// The bounds of each parameter that is free.
    pub(crate) fn ranges(&self) -> [Option<[f64; 2]>; 5] {
        [self.x, self.y, self.z, self.c, self.tool_length].map(|range| range.map(|range| range.0))
    }
}

/// The distances to keep, in the units of the margins: mm, degrees, or none. Constraints that are not listed must only
/// hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Reserve {
    /// From the ends of the sliders' strokes, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, exclusive_minimum = 0)]
    pub stroke: Option<f64>,
    /// Height that the length of each leg leaves, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, exclusive_minimum = 0)]
    pub leg_length: Option<f64>,
    /// From serial singularities, a cosine.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, exclusive_minimum = 0)]
    pub serial_singularity: Option<f64>,
    /// From parallel singularities, a pure number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, exclusive_minimum = 0)]
    pub parallel_singularity: Option<f64>,
    /// From the cones of the joints at the sliders, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, exclusive_minimum = 0)]
    pub slider_joint: Option<f64>,
    /// From the cones of the joints at the platform, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, exclusive_minimum = 0)]
    pub platform_joint: Option<f64>,
    /// From crossed rods of leg I, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, exclusive_minimum = 0)]
    pub rod_crossing: Option<f64>,
    /// Between rods, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, exclusive_minimum = 0)]
    pub rod_interference: Option<f64>,
    /// From the ends of the range of theta1, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, exclusive_minimum = 0)]
    pub tilt: Option<f64>,
    /// From the ends of the range of theta2, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, exclusive_minimum = 0)]
    pub rotary: Option<f64>,
    /// From the least height over the table, mm. Only where the table is checked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, exclusive_minimum = 0)]
    pub table_clearance: Option<f64>,
}

impl Reserve {
    /// The reserves, in the units of the wire.
    pub(crate) fn list(&self) -> impl Iterator<Item = (Constraint, f64)> {
        use Constraint as C;
        let all = [
            (C::Stroke, self.stroke),
            (C::LegLength, self.leg_length),
            (C::SerialSingularity, self.serial_singularity),
            (C::ParallelSingularity, self.parallel_singularity),
            (C::SliderJoint, self.slider_joint),
            (C::PlatformJoint, self.platform_joint),
            (C::RodCrossing, self.rod_crossing),
            (C::RodInterference, self.rod_interference),
            (C::Tilt, self.tilt),
            (C::Rotary, self.rotary),
            (C::TableClearance, self.table_clearance),
        ];
        all.into_iter().filter_map(|(constraint, reserve)| Some((constraint, reserve?)))
    }
}

/// The request for a placement with its default values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = CanonicalPlacementRequest)]
pub(crate) struct CanonicalPlacement {
    /// The tool path in the given set-up.
    pub toolpath: CanonicalToolpath,
    /// The free parameters.
    pub free: FreeParameters,
    /// The distances to keep.
    pub reserve: Reserve,
}

/// The set-up with the greatest reserve.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Placement)]
pub(crate) struct PlacementAnswer {
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
    pub request: CanonicalPlacement,
    /// Whether the machine can run the program in this set-up: the verdict of /toolpath on it.
    pub verdict: Verdict,
    /// The least ratio of a margin to its reserve over the whole program: at 1 every margin in `reserve` is as great as
    /// asked for, at 0 one is at its limit, and below 0 one is beyond. Null if the machine does not reach all of the
    /// program.
    pub t: Option<f64>,
    /// The program's frame in the part frame.
    pub setup: Setup,
    /// The length of the tool, mm; null if the request does not state one number.
    pub tool_length: Option<f64>,
    /// The set-up of the request.
    pub given: GivenSetup,
    /// How sure it is that no other set-up within the bounds is better.
    pub guarantee: Guarantee,
    /// The margins that limit t, and those without a reserve that are at their limits or beyond; the first 24 of them.
    pub active: Vec<ActiveObject>,
    /// The least margin of each constraint over the whole program, between the rows, too.
    pub margins: Vec<MarginObject>,
    /// Number of rows of the joint motion that was checked.
    pub rows: u64,
    /// Conditions that the service did not check.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Paths of the results.
    pub links: PlacementLinks,
}

/// The request's own set-up.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
pub(crate) struct GivenSetup {
    /// Whether the machine can run the program in it.
    pub verdict: Verdict,
    /// t in it; null if the machine does not reach all of the program.
    pub t: Option<f64>,
    /// Whether it is within the bounds. The answer is never worse than a given set-up within them.
    pub within_bounds: bool,
}

/// How sure it is that no other set-up within the bounds is better: `best_of_starts`, the answer is the best that
/// searches from many set-ups found. The answer itself is planned with all its rows and checked between them.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[schema(as = PlacementGuarantee)]
pub(crate) struct Guarantee {
    /// The kind.
    #[schema(inline)]
    pub kind: GuaranteeKind,
    /// Number of searches.
    pub starts: u32,
}

/// The kind of a guarantee.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum GuaranteeKind {
    /// The best that searches from many set-ups found.
    BestOfStarts,
}

/// A margin that limits the placement.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = ActiveMargin)]
pub(crate) struct ActiveObject {
    /// The line.
    pub line: u32,
    /// The constraint.
    pub constraint: ConstraintName,
    /// The part of the machine, such as `slider2.max`.
    #[schema(value_type = String, example = "slider2.max")]
    pub element: ElementName,
    /// The margin.
    pub margin: f64,
    /// Unit of `margin` and `reserve`.
    pub unit: Unit,
    /// The reserve of the constraint; missing if the margin is only to be at least zero.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub reserve: Option<f64>,
}

/// Paths of a placement.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct PlacementLinks {
    /// This answer.
    #[serde(rename = "self")]
    pub itself: String,
}
