//! A workspace cut at a height of its own frame.

mod contour;
mod loops;

use super::cover::{Cover, Purpose};
use super::domain::Domain;
use super::observer::{Observer, go_on};
use super::plane::{ATTEMPTS, Plane};
use super::request::{Request, WorkspaceError};
use crate::limit::DOMAIN;
use crate::machine::Machine;

pub use contour::Contour;

/// A closed polygon with holes; the last corner joins the first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polygon {
    /// Counter-clockwise.
    pub outer: Vec<[f64; 2]>,
    /// Clockwise.
    pub holes: Vec<Vec<[f64; 2]>>,
}

/// The cut of a workspace at one height: (x, y) of the frame of the request's kind, mm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slice {
    /// Parts of the cut; none where the plane misses the workspace.
    pub polygons: Vec<Polygon>,
    /// Lines of constant alpha within the cut.
    pub contours: Vec<Contour>,
}

/// The cut at z = `height` of the kind's own frame, within the request's tolerance of the true
/// one, with the lines on which alpha has one of the values `alphas` (rad).
///
/// Where the request's map folds, polygons may overlap.
pub fn slice(
    machine: &Machine,
    request: &Request,
    height: f64,
    alphas: &[f64],
    observer: &dyn Observer,
) -> Result<Slice, WorkspaceError> {
    request.check()?;
    if height.is_nan() || height.abs() > DOMAIN {
        return Err(WorkspaceError::OutOfDomain { field: "height" });
    }
    go_on(observer)?;
    let domain = Domain::new(machine, request, Some(height));
    let polygons = loops::polygons(&closed(&domain, request.tolerance, observer)?);
    let mut contours = Vec::new();
    if !polygons.is_empty() {
        for &alpha in alphas {
            go_on(observer)?;
            contours.extend(contour::at(&domain, alpha, request.tolerance));
        }
    }
    observer.progress(1.0);
    Ok(Slice { polygons, contours })
}

/// The domain on the first lattice on which its sides close.
fn closed(domain: &Domain<'_>, tolerance: f64, observer: &dyn Observer) -> Result<Plane, WorkspaceError> {
    let cover = Cover::of(domain, Purpose::Pieces(tolerance), observer)?;
    for squares in ATTEMPTS {
        let plane = Plane::trace(domain, &cover, squares, tolerance, usize::MAX, observer)?;
        if plane.closes() {
            return Ok(plane);
        }
    }
    Err(WorkspaceError::Open)
}

impl Slice {
    /// Area of the polygons, mm².
    pub fn area(&self) -> f64 {
        let rings = self.polygons.iter().flat_map(|polygon| polygon.holes.iter().chain([&polygon.outer]));
        rings.map(|ring| loops::area(ring)).sum()
    }
}
