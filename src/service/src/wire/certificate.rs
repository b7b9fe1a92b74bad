//! Proofs of solutions in answers.

use serde::Serialize;
use utoipa::ToSchema;
use verne_solver::certificate::{Incomplete, PostureBox, Unproved};

use crate::wire::degrees::enclosing_degrees;
use crate::wire::fixed_array::{FixedArray, Pair, PairPerSlider};

/// The proof of a solution.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Certificate)]
pub(crate) struct CertificateObject {
    /// Whether it is proved that the equations have exactly one solution in `box`.
    pub proved: bool,
    /// Bounds of each coordinate: `[low, high]`. Only a proved solution has it.
    #[serde(rename = "box", skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub bounds: Option<BoxObject>,
    /// Why nothing is proved: `merged` or `near_singularity`. Only a solution without a proof has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub reason: Option<UnprovedReason>,
}

/// A box that contains exactly one solution, and the numbers of the answer. Coordinates that the request gives have
/// equal bounds. theta1 and theta2 follow from alpha, phi1 and phi2.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = SolutionBox)]
pub(crate) struct BoxObject {
    /// x of the platform, mm.
    #[schema(inline)]
    pub x: Pair,
    /// y of the platform, mm.
    #[schema(inline)]
    pub y: Pair,
    /// z of the platform, mm.
    #[schema(inline)]
    pub z: Pair,
    /// Rotation of the platform, degrees. A bound may exceed 180.
    #[schema(inline)]
    pub alpha: Pair,
    /// The sliders, mm. Only answers of /ik have them.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(inline, nullable = false)]
    pub rho: Option<PairPerSlider>,
}

/// Reason why a solution is not proved: `merged`, two solutions coincide within double precision; `near_singularity`,
/// rounding decides about the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum UnprovedReason {
    /// Two solutions coincide within double precision.
    Merged,
    /// Rounding decides about the equations.
    NearSingularity,
}

/// Whether it is proved that the equations have no solutions but those of the answer.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Completeness)]
pub(crate) struct CompletenessObject {
    /// Whether that is proved. With `solutions` other than `all`, it is proved that no other solution is in the working
    /// mode; those that break a limit are left out of `feasible`, which is not proved.
    pub complete: bool,
    /// Why it is not proved. Only an answer that is not complete has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub reason: Option<IncompleteReason>,
}

/// Reason why an answer is not proved to be complete: `unproved_solution`, a solution has no box; `undecided`, rounding
/// decides whether there is another solution, as where two nearly merge; `undecided_mode`, rounding decides whether a
/// solution is in the working mode; `self_motion`, the solutions form a curve; `free_phi2`, they form a family, because
/// phi2 is free.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum IncompleteReason {
    /// A solution has no box.
    UnprovedSolution,
    /// Rounding decides whether there is another solution.
    Undecided,
    /// Rounding decides whether a solution is in the working mode.
    UndecidedMode,
    /// The solutions form a curve.
    SelfMotion,
    /// The solutions form a family.
    FreePhi2,
}

impl CertificateObject {
    /// The proof of a solution with this alpha in degrees.
    pub(crate) fn new(proof: &Result<PostureBox, Unproved>, alpha: f64, with_sliders: bool) -> Self {
        match proof {
            Ok(found) => Self {
                proved: true,
                bounds: Some(BoxObject {
                    x: FixedArray(found.x),
                    y: FixedArray(found.y),
                    z: FixedArray(found.z),
                    alpha: FixedArray(enclosing_degrees(found.alpha, alpha)),
                    rho: with_sliders.then(|| FixedArray(found.rho.map(FixedArray))),
                }),
                reason: None,
            },
            Err(reason) => Self { proved: false, bounds: None, reason: Some((*reason).into()) },
        }
    }
}

impl From<Result<(), IncompleteReason>> for CompletenessObject {
    fn from(complete: Result<(), IncompleteReason>) -> Self {
        Self { complete: complete.is_ok(), reason: complete.err() }
    }
}

impl From<Unproved> for UnprovedReason {
    fn from(reason: Unproved) -> Self {
        match reason {
            Unproved::Merged => Self::Merged,
            Unproved::NearSingularity => Self::NearSingularity,
        }
    }
}

impl From<Incomplete> for IncompleteReason {
    fn from(reason: Incomplete) -> Self {
        match reason {
            Incomplete::Unproved => Self::UnprovedSolution,
            Incomplete::Undecided => Self::Undecided,
            Incomplete::UndecidedMode => Self::UndecidedMode,
        }
    }
}
