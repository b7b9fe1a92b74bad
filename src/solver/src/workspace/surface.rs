//! The boundary surface of a workspace: two sheets over the plane domain and the walls between.

mod part;
mod tidy;
mod twins;

use super::cover::{Cover, Purpose};
use super::domain::{Binding, Domain};
use super::observer::{Observer, Pace, go_on};
use super::plane::{ATTEMPTS, Plane, Rim};
use super::request::{Request, WorkspaceError};
use crate::machine::Machine;
use crate::pose::Point;

/// Fractions of the work that are done when the patches are joined, when the surface is a manifold, and when its
/// short edges are contracted.
const JOINED: f64 = 0.93;
const PARTED: f64 = 0.95;
const TIDIED: f64 = 0.98;

/// A closed surface of triangles that face outwards. An empty workspace has no triangles.
///
/// Every edge belongs to two triangles, which run along it in opposite directions. The triangles at a vertex form one
/// ring: where parts of the workspace touch, each part has its own vertices. An edge marks each change of the binding
/// slider or constraint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Positions of the vertices in the frame of the request's kind, mm.
    pub positions: Vec<Point>,
    /// Vertex numbers of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle the constraint that bounds the workspace there.
    pub bindings: Vec<Binding>,
}

/// Computes the boundary surface, within the request's tolerance of the true one, in both directions. The tolerance is
/// checked at sample points (see the [module's documentation](super)), not proved.
///
/// A workspace that is nowhere as thick as the tolerance has no triangles. If the request's map folds (see
/// [`super::Measure::folded`]), the surface is the image of the platform workspace's boundary and passes through
/// itself.
///
/// # Units
///
/// Millimetres, in the frame of the request's kind.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number of the request is not finite, beyond [`MAX_INPUT`](crate::MAX_INPUT) or,
///   for the tolerance, below 0.001 mm.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
/// - [`WorkspaceError::TooFine`]: the surface has more vertices than 32 bits can number.
/// - [`WorkspaceError::Open`]: the surface could not be closed on any of three lattices.
/// - [`WorkspaceError::Disagreement`]: the surface is empty although the cover proves that the domain holds a box as
///   wide as the tolerance.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Figs 7 and 8; Eqs (26) and (27) as
/// maps; the construction is ours.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, surface};
///
/// let request = Request {
///     kind: Kind::Platform,
///     tool_length: 0.0,
///     phi1: 0.0,
///     phi2: 0.0,
///     table_clearance: None,
///     tool_radius: 0.0,
///     tolerance: 20.0,
/// };
/// let surface = surface(&Machine::verne(), &request, &Unobserved)?;
/// assert_eq!(surface.triangles.len(), surface.bindings.len());
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn surface(
    machine: &Machine,
    request: &Request,
    observer: &dyn Observer,
) -> Result<Surface, WorkspaceError> {
    surface_within(machine, request, usize::MAX, observer)
}

/// Computes the same surface as [`surface()`], but stops as soon as it has more triangles than `most`.
///
/// # Units
///
/// Millimetres, in the frame of the request's kind.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number of the request is not finite, beyond [`MAX_INPUT`](crate::MAX_INPUT) or,
///   for the tolerance, below 0.001 mm.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
/// - [`WorkspaceError::TooFine`]: the surface has more vertices than 32 bits can number.
/// - [`WorkspaceError::Open`]: the surface could not be closed on any of three lattices.
/// - [`WorkspaceError::Disagreement`]: the surface is empty although the cover proves that the domain holds a box as
///   wide as the tolerance.
/// - [`WorkspaceError::TooManyTriangles`]: there are more than `most`.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): as for [`surface()`].
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, surface_within};
///
/// let request = Request {
///     kind: Kind::Platform,
///     tool_length: 0.0,
///     phi1: 0.0,
///     phi2: 0.0,
///     table_clearance: None,
///     tool_radius: 0.0,
///     tolerance: 20.0,
/// };
/// let refused = surface_within(&Machine::verne(), &request, 10, &Unobserved);
/// assert_eq!(refused, Err(WorkspaceError::TooManyTriangles { most: 10 }));
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn surface_within(
    machine: &Machine,
    request: &Request,
    most: usize,
    observer: &dyn Observer,
) -> Result<Surface, WorkspaceError> {
    request.check()?;
    go_on(observer)?;
    let domain = Domain::new(machine, request, None);
    let mut surface = closed(&domain, request.tolerance, most, observer)?;
    let mut pace = Pace::new(observer);
    let mut volume = 0.0;
    for triangle in &surface.triangles {
        pace.step()?;
        volume += surface.six_volumes(triangle);
    }
    if volume < 0.0 {
        // The map turns the workspace inside out.
        for triangle in &mut surface.triangles {
            pace.step()?;
            triangle.swap(1, 2);
        }
    }
    observer.progress(1.0);
    Ok(surface)
}

/// Makes the surface over the first lattice on which it closes.
fn closed(
    domain: &Domain<'_>,
    tolerance: f64,
    most: usize,
    observer: &dyn Observer,
) -> Result<Surface, WorkspaceError> {
    let mut answer = Err(WorkspaceError::Open);
    let cover = Cover::of(domain, Purpose::Pieces(tolerance), observer)?;
    for squares in ATTEMPTS {
        let plane = Plane::trace(domain, &cover, squares, tolerance, most, observer)?;
        go_on(observer)?;
        if plane.triangles.is_empty() && cover.holds(tolerance) {
            return Err(WorkspaceError::Disagreement);
        }
        if plane.is_thin(&cover, tolerance) {
            return Ok(Surface::default());
        }
        observer.progress(JOINED);
        let mut pace = Pace::new(observer);
        answer = made_one(Surface::over(domain, &plane, &mut pace)?, tolerance, &mut pace);
        if answer != Err(WorkspaceError::Open) {
            break;
        }
    }
    answer
}

fn made_one(mut surface: Surface, tolerance: f64, pace: &mut Pace<'_>) -> Result<Surface, WorkspaceError> {
    part::part(&mut surface, pace)?;
    pace.observer.progress(PARTED);
    tidy::contract(&mut surface, tolerance, pace)?;
    pace.observer.progress(TIDIED);
    // Contraction preserves manifolds. This checks the result at little cost.
    part::part(&mut surface, pace)?;
    Ok(surface)
}

impl Surface {
    /// The volume that the surface encloses.
    ///
    /// # Units
    ///
    /// mm³.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, surface};
    ///
    /// let request = Request {
    ///     kind: Kind::Platform,
    ///     tool_length: 0.0,
    ///     phi1: 0.0,
    ///     phi2: 0.0,
    ///     table_clearance: None,
    ///     tool_radius: 0.0,
    ///     tolerance: 20.0,
    /// };
    /// let volume = surface(&Machine::verne(), &request, &Unobserved)?.volume();
    /// assert!((volume - 2.336_92e8).abs() < 0.05 * volume, "{volume} at a tolerance of 20 mm");
    /// # Ok::<(), WorkspaceError>(())
    /// ```
    pub fn volume(&self) -> f64 {
        self.triangles.iter().map(|triangle| self.six_volumes(triangle)).sum::<f64>() / 6.0
    }

    pub(super) fn area_of(&self, triangle: &[u32; 3]) -> f64 {
        let [a, b, c] = triangle.map(|corner| self.positions[corner as usize]);
        let (p, q) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
        let normal = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
        0.5 * normal.iter().map(|part| part * part).sum::<f64>().sqrt()
    }

    /// Six times the volume between a triangle and the first vertex.
    pub(super) fn six_volumes(&self, triangle: &[u32; 3]) -> f64 {
        let Some(&[ox, oy, oz]) = self.positions.first() else { return 0.0 };
        let [a, b, c] = triangle.map(|corner| {
            let [x, y, z] = self.positions[corner as usize];
            [x - ox, y - oy, z - oz]
        });
        a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    }

    /// The least and the greatest coordinates; `None` if the surface is empty.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, surface};
    ///
    /// let request = Request {
    ///     kind: Kind::Platform,
    ///     tool_length: 0.0,
    ///     phi1: 0.0,
    ///     phi2: 0.0,
    ///     table_clearance: None,
    ///     tool_radius: 0.0,
    ///     tolerance: 20.0,
    /// };
    /// let surface = surface(&Machine::verne(), &request, &Unobserved)?;
    /// let [low, high] = surface.bounds().expect("not empty");
    /// assert!(low[0] < 0.0 && high[0] > 0.0 && high[2] - low[2] < 757.0);
    /// # Ok::<(), WorkspaceError>(())
    /// ```
    pub fn bounds(&self) -> Option<[Point; 2]> {
        let first = *self.positions.first()?;
        Some(self.positions.iter().fold([first; 2], |[least, greatest], position| {
            [
                [0, 1, 2].map(|i| f64::min(least[i], position[i])),
                [0, 1, 2].map(|i| f64::max(greatest[i], position[i])),
            ]
        }))
    }

    fn over(domain: &Domain<'_>, plane: &Plane, pace: &mut Pace<'_>) -> Result<Self, WorkspaceError> {
        let mut surface = Self::default();
        let count = 2 * plane.triangles.len() + 2 * plane.rims.len();
        surface.triangles.reserve_exact(count);
        surface.bindings.reserve_exact(count);
        let sheets = surface.vertices(plane, pace)?;
        for triangle in &plane.triangles {
            pace.step()?;
            let [a, b, c] = triangle.corners.map(|corner| sheets[corner as usize]);
            surface.add([a[0], c[0], b[0]], domain.sheet_binding(triangle.sliders[0], false));
            surface.add([a[1], b[1], c[1]], domain.sheet_binding(triangle.sliders[1], true));
        }
        for rim in &plane.rims {
            pace.step()?;
            surface.wall(domain, plane, rim, rim.ends.map(|end| sheets[end as usize]));
        }
        Ok(surface)
    }

    /// Numbers of each plane vertex's lower and upper position.
    fn vertices(&mut self, plane: &Plane, pace: &mut Pace<'_>) -> Result<Vec<[u32; 2]>, WorkspaceError> {
        self.positions.reserve_exact(2 * plane.vertices.len());
        let mut sheets = Vec::with_capacity(plane.vertices.len());
        for vertex in &plane.vertices {
            pace.step()?;
            let low = u32::try_from(self.positions.len()).unwrap_or(u32::MAX);
            self.positions.push(vertex.ends[0]);
            if !vertex.pinched {
                self.positions.push(vertex.ends[1]);
            }
            sheets.push([low, low + u32::from(!vertex.pinched)]);
        }
        Ok(sheets)
    }

    /// Adds the wall over a side, split by the shorter of its diagonals. If it stems from rod interference, its
    /// binding names the two rods that are nearest half-way along the side.
    fn wall(&mut self, domain: &Domain<'_>, plane: &Plane, rim: &Rim, [a, b]: [[u32; 2]; 2]) {
        let [from, to] = rim.ends.map(|end| plane.vertices[end as usize].at);
        let limit = domain.binding_at(rim.limit, [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])]);
        let ends = rim.ends.map(|end| plane.vertices[end as usize].ends);
        let length = |p: Point, q: Point| (0..3).map(|i| (p[i] - q[i]).powi(2)).sum::<f64>();
        if a[0] == a[1] || b[0] == b[1] || length(ends[0][0], ends[1][1]) <= length(ends[1][0], ends[0][1]) {
            self.add([a[0], b[0], b[1]], limit);
            self.add([a[0], b[1], a[1]], limit);
        } else {
            self.add([a[0], b[0], a[1]], limit);
            self.add([b[0], b[1], a[1]], limit);
        }
    }

    fn add(&mut self, [a, b, c]: [u32; 3], binding: Binding) {
        if a != b && b != c && c != a {
            self.triangles.push([a, b, c]);
            self.bindings.push(binding);
        }
    }
}
