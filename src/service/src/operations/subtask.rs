//! Subtasks of large questions: jobs of their own, from whose results the answer is merged.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::error_map_question::ErrorMapQuestion;
use crate::operations::family_question::FamilyQuestion;
use crate::operations::machine_registry::IdentifiedMachine;
use crate::operations::origins::OriginsPart;
use crate::operations::origins_question::OriginsQuestion;
use crate::operations::toolpath_question::ToolpathQuestion;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::wire::dexterity::CanonicalDexterity;
use crate::wire::error_map::CanonicalErrorMap;
use crate::wire::origins::CanonicalOrigins;
use crate::wire::result_id::ResultId;
use crate::wire::workspace::CanonicalWorkspace;

/// Begins the hash of every subtask. It changes when the bytes of a subtask's result change their layout.
const HASH_PREFIX: &[u8] = b"verne piece 1";

/// Seconds of one core that a slab should take.
const SLAB_COST: f64 = 2.0;

/// Most slabs of a map.
const MAX_SLABS: f64 = 64.0;

/// Seconds of one core that a slab of a region of origins should take, and most slabs of a region: those that begin
/// together find the limiting places of the program several times.
const REGION_SLAB_COST: f64 = 1.0;
const MAX_REGION_SLABS: f64 = 16.0;

/// The grid's fraction of a region's work, about; the rest is the refinement of its surface.
const GRID_FRACTION: f64 = 0.25;

/// The volumes' fraction of a map's work, about.
const VOLUMES_FRACTION: f64 = 0.2;

/// The surface's fraction of an error map's work, about.
const SURFACE_FRACTION: f64 = 0.2;

/// A subtask of a family, of a map or of a region of origins.
#[derive(Clone, Debug)]
pub(crate) struct Subtask {
    /// The machine.
    pub machine: Arc<IdentifiedMachine>,
    /// The work.
    pub request: SubtaskRequest,
}

/// The work of a subtask.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum SubtaskRequest {
    /// A member of a family. Unlike the workspace itself, a member that cannot be computed is a result as well.
    Member(CanonicalWorkspace),
    /// One of `count` slabs of a dexterity map.
    Slab {
        /// The map.
        map: CanonicalDexterity,
        /// The slab's number, from 0.
        number: u32,
        /// How many slabs the map has.
        count: u32,
    },
    /// The volumes of a dexterity map.
    Volumes(CanonicalDexterity),
    /// A part of a region of origins.
    Origins {
        /// The region.
        region: Box<CanonicalOrigins>,
        /// The part.
        part: OriginsPart,
    },
    /// One of `count` slabs of an error map.
    ErrorSlab {
        /// The map.
        map: Box<CanonicalErrorMap>,
        /// The slab's number, from 0.
        number: u32,
        /// How many slabs the map has.
        count: u32,
    },
    /// The surface of an error map.
    ErrorSurface(Box<CanonicalErrorMap>),
}

impl Subtask {
    /// The subtask that computes a member of a family.
    pub(crate) fn of_member(member: &WorkspaceQuestion) -> Self {
        Self { machine: Arc::clone(&member.machine), request: SubtaskRequest::Member(member.request) }
    }

    /// The members of a family.
    pub(crate) fn of_family(family: &FamilyQuestion) -> Vec<Self> {
        family.members.iter().map(Self::of_member).collect()
    }

    /// The slabs of a map, then its volumes.
    pub(crate) fn of_map(question: &DexterityQuestion) -> Vec<Self> {
        let map = question.request;
        let count = slab_count(question.cost(), SLAB_COST, MAX_SLABS);
        let slabs = (0..count).map(|number| SubtaskRequest::Slab { map, number, count });
        slabs
            .chain([SubtaskRequest::Volumes(map)])
            .map(|request| Self { machine: Arc::clone(&question.machine), request })
            .collect()
    }

    /// The slabs of a region of origins.
    pub(crate) fn of_region(question: &OriginsQuestion) -> Vec<Self> {
        let count = slab_count(GRID_FRACTION * question.cost(), REGION_SLAB_COST, MAX_REGION_SLABS);
        let slabs = (0..count).map(|number| OriginsPart { number, count });
        let of_part = |part| SubtaskRequest::Origins { region: Box::new(question.request()), part };
        slabs
            .map(|part| Self { machine: Arc::clone(&question.toolpath.machine), request: of_part(part) })
            .collect()
    }

    /// The slabs of an error map, then its surface.
    pub(crate) fn of_error_map(question: &ErrorMapQuestion) -> Vec<Self> {
        let map = Box::new(question.request);
        let count = slab_count(question.grid_cost(), SLAB_COST, MAX_SLABS);
        let slabs = (0..count).map(|number| SubtaskRequest::ErrorSlab { map: map.clone(), number, count });
        slabs
            .chain([SubtaskRequest::ErrorSurface(map.clone())])
            .map(|request| Self { machine: Arc::clone(&question.machine), request })
            .collect()
    }

    /// The region of origins that a part belongs to.
    pub(crate) fn region(&self, region: &CanonicalOrigins) -> OriginsQuestion {
        let toolpath = ToolpathQuestion::of(Arc::clone(&self.machine), region.toolpath.clone(), 0.0);
        OriginsQuestion::of(toolpath, region.cell)
    }

    /// The id under which its result is stored.
    pub(crate) fn id(&self) -> ResultId {
        let machine = Arc::clone(&self.machine);
        let (kind, id, [number, count]) = match &self.request {
            SubtaskRequest::Member(member) => (b"m", WorkspaceQuestion::of(machine, *member).id, [0, 0]),
            SubtaskRequest::Slab { map, number, count } => {
                (b"s", DexterityQuestion::of(machine, *map).id, [*number, *count])
            }
            SubtaskRequest::Volumes(map) => (b"v", DexterityQuestion::of(machine, *map).id, [0, 0]),
            SubtaskRequest::Origins { region, part } => {
                (b"o", self.region(region).id, [part.number, part.count])
            }
            SubtaskRequest::ErrorSlab { map, number, count } => {
                (b"e", ErrorMapQuestion::of(machine, map).id, [*number, *count])
            }
            SubtaskRequest::ErrorSurface(map) => (b"f", ErrorMapQuestion::of(machine, map).id, [0, 0]),
        };
        let mut hasher = blake3::Hasher::new();
        hasher.update(HASH_PREFIX).update(kind).update(id.job().as_bytes());
        hasher.update(&number.to_le_bytes()).update(&count.to_le_bytes());
        hasher.finalize().into()
    }

    /// Estimated work, seconds of one core, of one of `count` subtasks of a question whose work is `total`.
    pub(crate) fn cost(&self, total: f64, count: u32) -> f64 {
        match self.request {
            SubtaskRequest::Member(_) => total / f64::from(count.max(1)),
            SubtaskRequest::Origins { .. } => total * GRID_FRACTION / f64::from(count.max(1)),
            SubtaskRequest::Slab { number, count, .. } => {
                total * (1.0 - VOLUMES_FRACTION) * work_of_slab(number, count)
            }
            SubtaskRequest::ErrorSlab { number, count, .. } => {
                total * (1.0 - SURFACE_FRACTION) * work_of_slab(number, count)
            }
            SubtaskRequest::Volumes(_) => total * VOLUMES_FRACTION,
            SubtaskRequest::ErrorSurface(_) => total * SURFACE_FRACTION,
        }
    }
}

/// The number of slabs, at most `most`, of which each costs about `each`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 64")]
fn slab_count(cost: f64, each: f64, most: f64) -> u32 {
    (cost / each).clamp(1.0, most) as u32
}

/// The fraction of the slabs' work that slab `number` of `count` takes.
fn work_of_slab(number: u32, count: u32) -> f64 {
    let [from, to] = [number, number + 1].map(|cut| f64::from(cut) / f64::from(count));
    work_below(to) - work_below(from)
}

/// The fraction of the slabs' work below `cut`, which runs from 0 to 1 through the map. A layer has much to compute in
/// the middle, where the machine reaches far, and nothing at the ends: the work per layer is taken as a parabola.
fn work_below(cut: f64) -> f64 {
    cut * cut * (3.0 - 2.0 * cut)
}
