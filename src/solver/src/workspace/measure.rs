//! Volume and area by integration over the plane domain.
//!
//! V = ∬ (`z_hi` - `z_lo`)(j0 + j1 (`z_hi` + `z_lo`)/2), where j0 + j1 z is the Jacobian determinant of the kind's
//! map. The inner integral runs over the intervals of a line x = const. They follow from the domain's cover and are
//! cut where another slider, or the table, begins to bind. The outer integral runs over panels between the x at which
//! the structure of the line changes; the cover proves where it may change. The inner integral goes like a square root
//! there. The substitution x = x0 + (x1 - x0)(3 t² - 2 t³) makes it smooth.

mod line;
mod line_intervals;
mod outer_integral;

use super::domain::Domain;
use super::fold::{self, Covering};
use super::observer::{Observer, check_cancelled};
use super::quadrature::Integral;
use super::request::{Request, WorkspaceError};
use crate::machine::Machine;

/// The volume of a workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Volume {
    /// The volume and its error.
    Value {
        /// mm³.
        value: f64,
        /// mm³. The true volume is within `value ± error`, as far as the quadrature's estimate holds (see
        /// [`measure`]).
        error: f64,
    },
    /// Two platform positions reach the same position somewhere, so the integral is not the volume of the set.
    /// [`measure`] detects it in two ways: the Jacobian determinant has both signs on the columns that the
    /// integration visits, or one of 2,000 points, spread evenly over the columns, has two feasible inverse
    /// solutions. It thus finds two regions of the domain with the same image if that image is more than about 0.15 %
    /// of the workspace, and may miss a smaller one. If one of the points has a second working solution that is not
    /// feasible, it examines 20,000 points, and the error of [`Volume::Value`] includes the part that it may have
    /// missed.
    Folded,
}

/// Volume and area of a workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// The volume.
    pub volume: Volume,
    /// Area of the plane domain, mm²: of all (x, y) with columns.
    pub area: f64,
    /// Error of the area, mm²; see [`measure`].
    pub area_error: f64,
    /// Least and greatest Jacobian determinant of the columns that the integration visited. `None` for an empty
    /// workspace.
    pub jacobian: Option<[f64; 2]>,
    /// Greatest |alpha| of these columns, rad. `None` for an empty workspace.
    pub inclination: Option<f64>,
}

/// Computes the volume and the area of a workspace, with errors: as a rule 1e-6 of the value or better.
///
/// The error consists of the area, and a bound of the volume, of the boxes that the cover leaves undecided, of the
/// places of structural changes, and of four times the quadrature's estimate. The last is an estimate, not a bound;
/// the [module's documentation](super) lists what is proved. The request's tolerance has no effect.
///
/// # Units
///
/// mm², mm³; the inclination is in radians.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number of the request is not finite, beyond [`MAX_INPUT`](crate::MAX_INPUT)
///   or, for the tolerance, below 0.001 mm.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (26) and (27) as maps,
/// constraints of section IV.A; the integral over columns is ours.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, Volume, measure};
///
/// let request = Request::new(Kind::Platform, 20.0);
/// let measured = measure(&Machine::verne(), &request, &Unobserved)?;
/// let Volume::Value { value, error } = measured.volume else { panic!("the platform's map does not fold") };
/// assert!((value - 2.336_92e8).abs() < 1e3 && error < 1e-6 * value);
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn measure(
    machine: &Machine,
    request: &Request,
    observer: &dyn Observer,
) -> Result<Measure, WorkspaceError> {
    request.check()?;
    check_cancelled(observer)?;
    let domain = Domain::new(machine, request, None);
    if domain.empty {
        return Ok(Measure::of(&Integral::ZERO, &line::Extremes::default()));
    }
    let (integral, extremes) = outer_integral::integrate(&domain, observer)?;
    let covering = fold::covering(machine, request, &domain, observer)?;
    observer.progress(1.0);
    Ok(Measure::of(&integral, &extremes).covered(covering))
}

impl Measure {
    /// Whether the map folds; see [`Volume::Folded`] for what is detected.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, measure};
    ///
    /// let request = Request::new(Kind::Platform, 20.0);
    /// assert!(!measure(&Machine::verne(), &request, &Unobserved)?.folded());
    /// # Ok::<(), WorkspaceError>(())
    /// ```
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
