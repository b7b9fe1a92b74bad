//! The worst margin of a posture, and those that are less than known ones. The margins of joints and of most distances
//! between rods are computed at a few postures only: a bound of their change usually shows that they do not matter at
//! the postures nearby.

use super::posture_margins::{heights, limited_crossing, margin_of_det, range_margins};
use super::worst::{FAMILY_ROD, WorstMargin, each_length, each_range, least};
use super::{cone, interference};
use crate::fast_math::greater;
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::pose::PlatformPose;
use crate::rods::Rods;

/// Greatest change of a rod's direction, as a chord, for which the margins are bounded, and an upper bound of an angle
/// up to that chord over the chord.
const GREATEST_CHORD: f64 = 1.0;
const ANGLE_OVER_CHORD: f64 = 1.05;
/// Upper bound of the rounding error of a fraction of a range.
const ROUNDING: f64 = 1e-12;

/// The least known margin of each constraint, in the order of [`Constraint::ALL`].
pub(crate) type Known = [f64; Constraint::COUNT];

/// The joints and the platform, with what follows from them. Lengths are millimetres, angles radians.
pub(crate) struct ClosedPosture<'a> {
    pub(crate) pose: &'a PlatformPose,
    pub(crate) rho: [f64; 3],
    pub(crate) rods: &'a Rods,
    /// `det_P`.
    pub(crate) det: f64,
    pub(crate) theta1: f64,
    /// `None`: the range of theta2 takes no part.
    pub(crate) theta2: Option<f64>,
    /// The margin of the height over the table's plane, if it is checked.
    pub(crate) clearance: Option<Margin>,
}

/// The margins of joints, and of the distances between rods but those of one parallelogram, at one posture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reference {
    directions: [[f64; 3]; 4],
    alpha: f64,
    slider_joint: f64,
    platform_joint: f64,
    rod_interference: f64,
}

/// The worst margin so far, and the least of each constraint.
struct Lesser<'a, F> {
    worst: WorstMargin,
    known: &'a mut Known,
    found: F,
}

impl<F: FnMut(Margin)> Lesser<'_, F> {
    #[inline]
    fn meet(&mut self, constraint: Constraint, element: Element, value: f64, factor: f64) {
        self.worst.compare(constraint, element, value, factor);
        self.note(Margin { constraint, element, value });
    }

    #[inline]
    fn note(&mut self, margin: Margin) {
        let known = &mut self.known[margin.constraint as usize];
        if margin.value < *known {
            *known = margin.value;
            (self.found)(margin);
        }
    }

    /// Whether a margin that is at least `value` is neither the worst nor less than the known one.
    #[inline]
    fn is_no_matter(&self, constraint: Constraint, value: f64, factor: f64) -> bool {
        value > self.known[constraint as usize] && value * factor > self.worst.fraction + ROUNDING
    }
}

impl Reference {
    /// Meets the margins of a posture, which becomes the reference.
    #[cold]
    fn of<F: FnMut(Margin)>(
        machine: &Machine,
        posture: &ClosedPosture<'_>,
        lesser: &mut Lesser<'_, F>,
    ) -> Self {
        let (g, limits, home) = (machine.geometry(), machine.limits(), &machine.home);
        let rods = posture.rods;
        let factors = &machine.normalization;
        let directions = cone::columns(&rods.directions);
        let joints = cone::margins(limits.slider_cone, &home.slider_axes, &directions);
        let (family, slider_joint) = least(&joints);
        lesser.meet(Constraint::SliderJoint, FAMILY_ROD[family], slider_joint, factors.slider_joint);
        let directions = cone::in_platform(rods, &directions);
        let joints = cone::margins(limits.platform_cone, &home.platform_axes, &directions);
        let (family, platform_joint) = least(&joints);
        lesser.meet(Constraint::PlatformJoint, FAMILY_ROD[family], platform_joint, factors.platform_joint);
        let (distance, [a, b]) = interference::least_distance_of_others(&machine.mechanism, rods);
        let (rod_interference, element) = (distance - 2.0 * g.rod_radius, Element::Rods(a, b));
        lesser.meet(Constraint::RodInterference, element, rod_interference, factors.rod_interference);
        let (directions, alpha) = (rods.directions, posture.pose.alpha);
        Self { directions, alpha, slider_joint, platform_joint, rod_interference }
    }

    /// Whether the margins of a posture certainly are neither the worst nor less than known ones.
    #[inline]
    fn excludes<F: FnMut(Margin)>(
        &self,
        machine: &Machine,
        posture: &ClosedPosture<'_>,
        lesser: &Lesser<'_, F>,
    ) -> bool {
        let (g, factors) = (machine.geometry(), &machine.normalization);
        let alpha = (self.alpha - posture.pose.alpha).abs();
        let square = |i: usize| {
            let [x, y, z]: [f64; 3] =
                std::array::from_fn(|axis| self.directions[i][axis] - posture.rods.directions[i][axis]);
            x * x + y * y + z * z
        };
        let chord = greater(greater(square(0), square(1)), greater(square(2), square(3))).sqrt();
        let angle = ANGLE_OVER_CHORD * chord;
        // Rods move against each other with the platform's rotation and with their directions.
        let length = greater(g.L1, greater(g.L2, g.L3));
        let distance = self.rod_interference - 2.0 * (greater(g.R1, g.R2) * alpha + length * chord);
        let (at_slider, at_platform) = (self.slider_joint - angle, self.platform_joint - angle - alpha);
        chord <= GREATEST_CHORD
            && lesser.is_no_matter(Constraint::SliderJoint, at_slider, factors.slider_joint)
            && lesser.is_no_matter(Constraint::PlatformJoint, at_platform, factors.platform_joint)
            && lesser.is_no_matter(Constraint::RodInterference, distance, factors.rod_interference)
    }
}

/// The worst margin of a posture and its fraction of its constraint's range. A margin of a constraint that is less than
/// the known one replaces it, and `found` is called with it: the last of a constraint is its least.
#[inline]
pub(crate) fn worst_and_lesser(
    machine: &Machine,
    posture: &ClosedPosture<'_>,
    (known, reference): (&mut Known, &mut Option<Reference>),
    found: impl FnMut(Margin),
) -> (Margin, f64) {
    let (g, limits, factors) = (machine.geometry(), machine.limits(), &machine.normalization);
    let ClosedPosture { pose, rho, rods, det, theta1, theta2, clearance } = *posture;
    let limited = limited_crossing(machine, pose.alpha, g.R1 * rods.c - g.r1);
    let worst = WorstMargin::new(limited, factors.rod_crossing);
    let crossing = worst.margin;
    let mut lesser = Lesser { worst, known, found };
    if limited.is_some() {
        lesser.note(crossing);
    }
    let stroke = [0, 1, 2].map(|i| range_margins(limits.stroke[i], rho[i]));
    let mut meet = |constraint, element, value, factor| lesser.meet(constraint, element, value, factor);
    each_length(machine, &stroke, &heights(g, pose, rho, rods), &mut meet);
    let rotary = limits.rotary.zip(theta2).map(|(range, theta2)| range_margins(range, theta2));
    each_range(machine, Some(range_margins(limits.tilt, theta1)), rotary, &mut meet);
    let (family, value) = least(&rods.directions.map(|direction| direction[2] - limits.serial_margin));
    meet(Constraint::SerialSingularity, FAMILY_ROD[family], value, factors.serial_singularity);
    let det = margin_of_det(machine, det);
    meet(Constraint::ParallelSingularity, Element::Platform, det, factors.parallel_singularity);
    let (distance, [a, b]) = interference::least_distance_in_parallelograms(&machine.mechanism, rods);
    let (value, element) = (distance - 2.0 * g.rod_radius, Element::Rods(a, b));
    meet(Constraint::RodInterference, element, value, factors.rod_interference);
    if let Some(Margin { constraint, element, value }) = clearance {
        meet(constraint, element, value, factors.table_clearance);
    }
    if !reference.is_some_and(|reference| reference.excludes(machine, posture, &lesser)) {
        *reference = Some(Reference::of(machine, posture, &mut lesser));
    }
    (lesser.worst.margin, lesser.worst.fraction)
}
