//! The region of origins: where the program's frame may be on the table, all else fixed, so that the machine can follow
//! the whole program.
//!
//! A place of the program keeps all limits where its tool position lies in the part workspace of its orientation. So
//! the region is the intersection, over all places, of workspaces that the places move; of each cut both preimages of
//! its axes count. A program has many places, few of which limit the region anywhere: [`OriginSurvey`] finds them, and
//! the nodes of a grid are examined with them alone. The edges of the grid that cross the region's surface are halved,
//! as those of dexterity maps.

mod constraining;
mod extent;
mod membership;
mod mesh;
mod nodes;
mod slice;

pub use mesh::{OriginRegion, merge_origins, origin_volume};
pub use nodes::{OriginSlab, origin_slab};
pub use slice::slice_origins;

use super::PlanOptions;
use super::planned_places::PlannedPlaces;
use super::set_up::{AdjustableProgram, SetUp};
use crate::machine::Machine;
use crate::workspace::dexterity::Grid;
use crate::workspace::{Observer, WorkspaceError};

/// Greatest density of places.
const MOST_DENSE: f64 = 1e3;

/// What is asked for. Lengths are millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OriginRequest {
    /// Step of the grid.
    pub cell: f64,
    /// About the distance by which the surface may be off because the program is examined at places, not everywhere.
    pub tolerance: f64,
}

/// What all parts of a region's computation share: the places of the program that limit it, and the grid.
#[derive(Clone, Debug)]
pub struct OriginSurvey {
    places: PlannedPlaces,
    /// Indices of the places that limit the region.
    set: Vec<u32>,
    /// Whether the range of the rotary axis admits each cut on each preimage.
    admitted: Vec<[bool; 2]>,
    /// The box around the region; `None` if no origin was found in it.
    bounds: Option<[[f64; 3]; 2]>,
    /// The grid of origins over the region, with at least one layer of nodes beyond it on each side.
    pub grid: Grid,
}

impl OriginSurvey {
    /// Finds the places that limit the region, and places the grid.
    ///
    /// The answer depends on the arguments alone: every part of a computation finds the same.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Errors
    ///
    /// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
    /// - [`WorkspaceError::TooManyNodes`]: the grid would have more than
    ///   [`MOST_NODES`](crate::workspace::dexterity::MOST_NODES) nodes.
    pub fn new(
        machine: &Machine,
        program: &dyn AdjustableProgram,
        given: SetUp,
        request: &OriginRequest,
        options: &PlanOptions,
        observer: &dyn Observer,
    ) -> Result<Self, WorkspaceError> {
        // Between places at this distance, a curve with the radius of the machine is off by the tolerance.
        let distance = (8.0 * request.tolerance * machine.longest()).sqrt();
        let density = (machine.longest() / 16.0 / distance).clamp(1.0, MOST_DENSE);
        let places = PlannedPlaces::of_program(machine, program, given, options, density);
        let admitted = membership::admitted_cuts(machine, &places);
        let (set, bounds) = extent::extent(machine, &places, &admitted, observer)?;
        let grid = extent::grid(bounds, request.cell)?;
        Ok(Self { places, set, admitted, bounds, grid })
    }

    /// The same region on a grid with another step.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Errors
    ///
    /// [`WorkspaceError::TooManyNodes`]
    pub fn with_cell(&self, cell: f64) -> Result<Self, WorkspaceError> {
        Ok(Self { grid: extent::grid(self.bounds, cell)?, ..self.clone() })
    }

    /// Number of places of the program, and of those that limit the region.
    pub fn place_counts(&self) -> [usize; 2] {
        [self.places.places.len(), self.set.len()]
    }

    /// Whether an origin belongs to the region.
    ///
    /// # Units
    ///
    /// Millimetres.
    pub fn contains(&self, machine: &Machine, origin: [f64; 3]) -> bool {
        membership::Membership::new(machine, &self.places, &self.set, &self.admitted).contains(origin, &mut 0)
    }
}
