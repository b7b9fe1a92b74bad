//! The request of an atlas: which plane, which part of it, how exactly; and the errors.

use std::fmt;

use crate::machine::Machine;
use crate::mechanism::FAMILY_EDGE;
use crate::request_range::{MAX_INPUT, MAX_LENGTH_RATIO};

/// The plane of an atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Space {
    /// (x, y) of the platform's point P: the number of inverse solutions.
    Platform,
    /// (rho2 - rho1, rho3 - rho1): the number of forward solutions.
    Joints,
}

/// A rectangle of the plane, mm. Its sides are along the coordinates u and v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Least and greatest u.
    pub u: [f64; 2],
    /// Least and greatest v.
    pub v: [f64; 2],
}

/// The request of one atlas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtlasRequest {
    /// The plane.
    pub space: Space,
    /// The part of the plane.
    pub window: Window,
    /// Greatest distance between a curve of the answer and the true curve, mm: see [`AtlasRequest::tolerances`].
    pub tolerance: f64,
}

/// A special machine near which curves lie close together in pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SpecialMachine {
    /// R1 = r1.
    LinearDelta,
    /// e1 = e2.
    EqualOffsets,
}

/// The reason why an atlas was not computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AtlasError {
    /// A number is out of range.
    OutOfDomain {
        /// The request's field: `u`, `v` or `tolerance`.
        field: &'static str,
    },
    /// The observer asked the computation to stop.
    Cancelled,
    /// The curves have more points, or need more boxes, than the limit: they lie too close together.
    TooFine {
        /// The special machine that this one is nearly, but not exactly.
        near: Option<SpecialMachine>,
    },
    /// The curves do not separate places with different numbers of solutions: a curve was lost. There is no answer.
    Disagreement {
        /// The special machine that this one is nearly, but not exactly.
        near: Option<SpecialMachine>,
    },
}

/// Sides of a window, relative to the machine's longest dimension.
const LEAST_SIDE: f64 = 1e-6;
/// Finest and coarsest tolerance, relative to the window's longer side.
const TOLERANCES: [f64; 2] = [1e-5, 0.1];
/// The tolerance that a request without one has: this part of the window's longer side, but at most this many mm if
/// that is not too fine.
const DEFAULT_TOLERANCE: [f64; 2] = [1e-3, 1.0];

impl Window {
    /// The window that a request without one has: ± L1 of the platform, or ± the greatest stroke of the sliders.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::atlas::{Space, Window};
    ///
    /// assert_eq!(Window::whole(&Machine::verne(), Space::Platform).u, [-1050.0, 1050.0]);
    /// assert_eq!(Window::whole(&Machine::verne(), Space::Joints).v, [-750.0, 750.0]);
    /// ```
    pub fn whole(machine: &Machine, space: Space) -> Self {
        let half = match space {
            Space::Platform => machine.geometry().L1,
            Space::Joints => {
                let spans = machine.limits().stroke.map(|[low, high]| high - low);
                spans.into_iter().fold(0.0, f64::max)
            }
        };
        Self { u: [-half, half], v: [-half, half] }
    }

    /// The longer side.
    pub(super) fn side(&self) -> f64 {
        (self.u[1] - self.u[0]).max(self.v[1] - self.v[0])
    }
}

impl SpecialMachine {
    /// The special machine that a machine is nearly, but not exactly.
    pub(super) fn near(machine: &Machine) -> Option<Self> {
        let mechanism = &machine.mechanism;
        let g = machine.geometry();
        if !mechanism.is_delta() && g.R1 - g.r1 < FAMILY_EDGE * g.R1 {
            Some(Self::LinearDelta)
        } else {
            let is_near = mechanism.offsets_nearly_equal && mechanism.e1 != mechanism.e2;
            is_near.then_some(Self::EqualOffsets)
        }
    }
}

impl AtlasRequest {
    /// The request of the whole plane, or of a window of it, with the default tolerance.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::atlas::{AtlasRequest, Space};
    ///
    /// let request = AtlasRequest::new(&Machine::verne(), Space::Joints, None);
    /// assert_eq!(request.tolerance, 1.0);
    /// ```
    pub fn new(machine: &Machine, space: Space, window: Option<Window>) -> Self {
        let window = window.unwrap_or_else(|| Window::whole(machine, space));
        let [part, most] = DEFAULT_TOLERANCE;
        let finest = TOLERANCES[0] * window.side();
        Self { space, window, tolerance: (part * window.side()).min(most).max(finest) }
    }

    /// The finest and the coarsest tolerance of a window.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::atlas::{AtlasRequest, Space};
    ///
    /// let request = AtlasRequest::new(&Machine::verne(), Space::Joints, None);
    /// let [finest, coarsest] = request.tolerances();
    /// assert!((finest - 0.015).abs() < 1e-12 && (coarsest - 150.0).abs() < 1e-9);
    /// ```
    pub fn tolerances(&self) -> [f64; 2] {
        TOLERANCES.map(|part| part * self.window.side())
    }

    /// The least side of a window, mm.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::atlas::AtlasRequest;
    ///
    /// assert!((AtlasRequest::least_side(&Machine::verne()) - 1.05e-3).abs() < 1e-12);
    /// ```
    pub fn least_side(machine: &Machine) -> f64 {
        LEAST_SIDE * machine.longest()
    }

    pub(super) fn check(&self, machine: &Machine) -> Result<(), AtlasError> {
        let most = (MAX_LENGTH_RATIO * machine.longest()).min(MAX_INPUT);
        for (field, [low, high]) in [("u", self.window.u), ("v", self.window.v)] {
            let within = low.abs() <= most && high.abs() <= most;
            if !within
                || (high - low).partial_cmp(&Self::least_side(machine)).is_none_or(std::cmp::Ordering::is_lt)
            {
                return Err(AtlasError::OutOfDomain { field });
            }
        }
        let [finest, coarsest] = self.tolerances();
        if (finest..=coarsest).contains(&self.tolerance) {
            Ok(())
        } else {
            Err(AtlasError::OutOfDomain { field: "tolerance" })
        }
    }
}

impl fmt::Display for AtlasError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfDomain { field } => write!(f, "{field} is out of range"),
            Self::Cancelled => write!(f, "cancelled"),
            Self::TooFine { near } => {
                write!(f, "the curves need more points than the limit{}", because(*near))
            }
            Self::Disagreement { near } => {
                write!(f, "the numbers of solutions do not agree with the curves{}", because(*near))
            }
        }
    }
}

/// The condition that a special machine fulfils, and this one only nearly.
fn because(near: Option<SpecialMachine>) -> &'static str {
    match near {
        None => "",
        Some(SpecialMachine::LinearDelta) => ": R1 is nearly, but not exactly, r1",
        Some(SpecialMachine::EqualOffsets) => ": D1 - d1 is nearly, but not exactly, D2 - d2",
    }
}

impl std::error::Error for AtlasError {}
