//! The region of origins: where the program's frame may be on the table, all else fixed, so that the machine can follow
//! the whole program.
//!
//! A place of the program keeps all limits where its tool position lies in the part workspace of its orientation. So
//! the region is the intersection, over all places, of workspaces that the places move; of each cut both preimages of
//! its axes count. A program has many places, few of which limit the region anywhere: [`OriginSurvey`] finds them, and
//! the nodes of a grid are examined with them alone. The edges of the grid that cross the region's surface are halved,
//! as those of dexterity maps. Where the cuts through the grid's cells are too far from the boundary, they are divided.

mod boundary_search;
mod closed_surface;
mod constraining;
mod cut_windings;
mod extent;
mod measured_error;
mod membership;
mod mesh;
mod nodes;
mod refinement;
mod slice;
mod smoothing;
mod subdivision;

pub use extent::OriginExtent;
pub use measured_error::ORIGIN_SAMPLES;
pub use mesh::{OriginRegion, merge_origins};
pub use nodes::{OriginSlab, origin_slab};
pub use slice::slice_origins;

use super::PlanOptions;
use super::planned_places::PlannedPlaces;
use super::set_up::{AdjustableProgram, SetUp};
use crate::machine::Machine;
use crate::workspace::dexterity::Grid;
use crate::workspace::{Observer, WorkspaceError};
use cut_windings::{Windings, cut_windings};
use membership::Membership;

/// Greatest density of places.
const MOST_DENSE: f64 = 1e3;

/// What is asked for. Lengths are millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OriginRequest {
    /// Step of the grid. Pieces of the region, and gaps in it, that are narrower may be missing.
    pub cell: f64,
    /// About the distance by which the boundary may be off because the program is examined at places, not everywhere.
    pub place_tolerance: f64,
}

/// The distance from the boundary at which the refinement of the surface ends, as a multiple of the grid's step; and
/// the least such distance, as a multiple of that of the places.
const OF_CELL: f64 = 1.0 / 10.0;
const OF_PLACES: f64 = 4.0;

/// What all parts of a region's computation share: the places of the program that limit it, and the grid.
#[derive(Clone, Debug)]
pub struct OriginSurvey {
    places: PlannedPlaces,
    extent: OriginExtent,
    /// The windings of each cut.
    windings: Vec<Windings>,
    place_tolerance: f64,
    /// The grid of origins over the region, with at least one layer of nodes beyond it on each side.
    pub grid: Grid,
}

impl OriginSurvey {
    /// Finds the places that limit the region, and places the grid.
    ///
    /// The answer depends on the arguments alone: every part of a computation finds the same. `known` is the extent
    /// that another part has found with the same arguments; one of other places takes no part.
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
        known: Option<OriginExtent>,
        observer: &dyn Observer,
    ) -> Result<Self, WorkspaceError> {
        // Between places at this distance, a curve of this radius is off by the tolerance.
        let radius = machine.longest() / 8.0;
        let distance = (8.0 * request.place_tolerance * radius).sqrt();
        let density = (machine.longest() / 16.0 / distance).clamp(1.0, MOST_DENSE);
        let places = PlannedPlaces::of_program(machine, program, given, options, density);
        let windings = cut_windings(machine, &places);
        let count = places.places.len();
        let known = known.filter(|known| known.places.iter().all(|place| (*place as usize) < count));
        let extent = match known {
            Some(known) => known,
            None => extent::extent(machine, &places, &windings, observer)?,
        };
        let grid = extent::grid(extent.bounds, request.cell)?;
        Ok(Self { places, extent, windings, place_tolerance: request.place_tolerance, grid })
    }

    /// The part of the survey that takes long. Another part of the computation can begin with it.
    pub fn extent(&self) -> &OriginExtent {
        &self.extent
    }

    /// Number of places of the program, and of those that limit the region.
    pub fn place_counts(&self) -> [usize; 2] {
        [self.places.places.len(), self.extent.places.len()]
    }

    /// Whether an origin belongs to the region.
    ///
    /// # Units
    ///
    /// Millimetres.
    pub fn contains(&self, machine: &Machine, origin: [f64; 3]) -> bool {
        self.membership(machine).contains(origin, &mut 0)
    }

    fn membership<'a>(&'a self, machine: &'a Machine) -> Membership<'a> {
        Membership::new(machine, &self.places, &self.extent.places, &self.windings)
    }

    /// About how far the boundary is off because the program is examined at places, not everywhere.
    ///
    /// # Units
    ///
    /// Millimetres.
    pub fn place_tolerance(&self) -> f64 {
        self.place_tolerance
    }

    /// The distance from the boundary at which the refinement of the surface ends.
    fn surface_tolerance(&self) -> f64 {
        (OF_CELL * self.grid.step).max(OF_PLACES * self.place_tolerance)
    }
}
