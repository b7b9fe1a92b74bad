//! Volume and area by integration over the plane domain.
//!
//! V = ∬ (`z_hi` - `z_lo`)(j0 + j1 (`z_hi` + `z_lo`)/2), where j0 + j1 z is the Jacobian determinant of the
//! kind's map. The inner integral runs over the intervals of a line x = const, which are found from
//! the domain's cover, cut where another slider begins to bind; the outer one over panels between
//! the x at which the line's structure changes: the cover proves where it may. There the inner integral
//! goes like a square root, which the
//! substitution x = x0 + (x1 - x0)(3 t² - 2 t³) makes smooth.

mod crossing;
mod line;
mod panels;

use super::domain::Domain;
use super::fold::{self, Covering};
use super::observer::{Observer, go_on};
use super::quadrature::Integral;
use super::request::{Request, WorkspaceError};
use crate::machine::Machine;

/// The volume of a workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Volume {
    /// The volume, and a bound of its error, mm³.
    Value {
        /// mm³.
        value: f64,
        /// mm³; the true volume lies within `value ± error`.
        error: f64,
    },
    /// Some positions are reached from two platform positions, and the integral is not the volume
    /// of the set. It is known in two ways: the map's Jacobian determinant has both signs on the
    /// columns that the integration looks at; or one of 2,000 points, spread evenly over the
    /// columns, has two feasible inverse solutions. So two parts of the platform's domain that map
    /// onto the same set are found if that set is more than about 0.15 % of the workspace, and may
    /// be missed if it is less. Where a second working solution exists at one of the points, though
    /// not a feasible one, 20,000 points are looked at, and a [`Volume::Value`]'s error includes
    /// what may have been missed.
    Folded,
}

/// Volume and area of a workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// The volume.
    pub volume: Volume,
    /// Area of the plane domain over which columns exist, mm².
    pub area: f64,
    /// Bound of the area's error, mm².
    pub area_error: f64,
    /// Least and greatest Jacobian determinant met; `None` for an empty workspace.
    pub jacobian: Option<[f64; 2]>,
    /// Greatest |alpha| met, rad; `None` for an empty workspace.
    pub inclination: Option<f64>,
}

/// Volume and area of the workspace, with bounds of their errors: relative 1e-6 or better as a rule.
///
/// Where so much of the domain's boundary cannot be decided at reasonable cost that a part of the
/// domain might be missed, the errors include it: the undecided area, and it times a bound of the
/// columns' volume. The quadrature's own errors are estimated by refinement.
///
/// The tolerance of the request is without effect: it belongs to surfaces and slices.
pub fn measure(
    machine: &Machine,
    request: &Request,
    observer: &dyn Observer,
) -> Result<Measure, WorkspaceError> {
    request.check()?;
    go_on(observer)?;
    let domain = Domain::new(machine, request, None);
    if domain.empty {
        return Ok(Measure::of(&Integral::ZERO, &line::Extremes::default()));
    }
    let (integral, extremes) = panels::integrate(&domain, observer)?;
    let covering = fold::covering(machine, request, &domain, observer)?;
    observer.progress(1.0);
    Ok(Measure::of(&integral, &extremes).covered(covering))
}

impl Measure {
    /// Whether the map folds.
    pub fn folded(&self) -> bool {
        self.volume == Volume::Folded
    }

    fn covered(self, covering: Covering) -> Self {
        let volume = match (covering, self.volume) {
            (Covering::Once { unseen }, Volume::Value { value, error }) => {
                Volume::Value { value, error: error + unseen * value }
            }
            _ => Volume::Folded,
        };
        Self { volume, ..self }
    }

    fn of(integral: &Integral<2>, extremes: &line::Extremes) -> Self {
        let [area, signed] = integral.value;
        let [area_error, error] = integral.error;
        let jacobian = extremes.jacobian;
        let folded = jacobian.is_some_and(|[least, greatest]| least < 0.0 && greatest > 0.0);
        let volume = if folded { Volume::Folded } else { Volume::Value { value: signed.abs(), error } };
        Self { volume, area, area_error, jacobian, inclination: extremes.sine.map(f64::asin) }
    }
}
