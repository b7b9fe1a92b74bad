//! The distance between the region's surface and its boundary, measured at origins near the surface.
//!
//! The refinement looks along normals. Where the region is sharper than a cell is wide they may miss its boundary. So
//! origins near the surface are examined, whatever the refinement has found.

use rayon::prelude::*;

use super::boundary_search::moved;
use super::closed_surface::ClosedSurface;
use super::membership::Membership;
use crate::pose::Point;
use crate::toolpath::placement::even_numbers;
use crate::workspace::observer::check_cancelled;
use crate::workspace::vector::{distance, minus};
use crate::workspace::{Observer, WorkspaceError};

/// Number of origins near the surface at which it is compared with the region.
pub const ORIGIN_SAMPLES: u32 = 1 << 14;
/// Error of the surface as a multiple of the greatest distance that was found: nobody finds the greatest of all.
const SAFETY: f64 = 1.5;

/// The error of a surface: one and a half times the greatest distance from it of an origin on its wrong side. The
/// origins are at most `around` from the surface along each axis.
pub(super) fn measured_error(
    membership: &Membership<'_>,
    surface: &ClosedSurface<'_>,
    around: f64,
    observer: &dyn Observer,
) -> Result<f64, WorkspaceError> {
    let errors = (0..ORIGIN_SAMPLES).into_par_iter().map_init(
        || 0,
        |hint, number| {
            check_cancelled(observer)?;
            let at = sample(surface, around, number);
            let is_right = membership.contains(at, hint) == surface.contains(at);
            let nearest = if is_right { None } else { surface.nearest(at) };
            Ok(nearest.map_or(0.0, |nearest| SAFETY * distance(nearest, at)))
        },
    );
    errors.try_reduce(|| 0.0, |a: f64, b| Ok(a.max(b)))
}

/// One of origins that are evenly distributed over the triangles, small or large, and around them.
fn sample(surface: &ClosedSurface<'_>, around: f64, number: u32) -> Point {
    let [which, u, v, offset @ ..] = even_numbers::<6>(number);
    let [a, b, c] = surface.corners(share(which, surface.triangles.len()));
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    let on = moved(moved(a, minus(b, a), u), minus(c, a), v);
    moved(on, offset.map(|c| 2.0 * c - 1.0), around)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "from 0 up to the number of triangles, which is far below 2^52"
)]
fn share(part: f64, count: usize) -> usize {
    ((part * count as f64) as usize).min(count.saturating_sub(1))
}
