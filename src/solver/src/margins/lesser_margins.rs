//! The worst margin of a posture, and those that are less than known ones. The margins of joints and of most distances
//! between rods are computed at a few postures only: a bound of their change usually shows that they do not matter at
//! the postures nearby.

use super::posture_margins::{det_margin, heights, range_margins};
use super::worst::{FAMILY_ROD, WorstMargin, each_length, each_range, least};
use super::{cone, interference};
use crate::clearance::Clearance;
use crate::fast_math::greater;
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::pose::{PlatformPose, TableAngles};
use crate::rods::Rods;

/// Greatest change of a rod's direction, as a chord, for which the margins are bounded, and an upper bound of an angle
/// up to that chord over the chord.
const GREATEST_CHORD: f64 = 1.0;
const ANGLE_OVER_CHORD: f64 = 1.0472;
/// Upper bound of the rounding error of a fraction of a range.
const ROUNDING: f64 = 1e-12;

/// The least known margin of each constraint, in the order of [`Constraint::ALL`].
pub(crate) type Known = [f64; Constraint::COUNT];

/// The joints and the platform, with what follows from them. Lengths are millimetres, angles radians.
pub(crate) struct ClosedPosture<'a> {
    pub(crate) pose: &'a PlatformPose,
    pub(crate) rho: [f64; 3],
    pub(crate) rods: &'a Rods,
    pub(crate) table: TableAngles,
    pub(crate) clearance: Option<Clearance>,
}

/// The margins of joints, and of the distances between rods but those of one parallelogram, at one posture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reference {
    pose: PlatformPose,
    rho: [f64; 3],
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
        let ClosedPosture { pose, rho, rods, .. } = *posture;
        let factors = &machine.normalization;
        let directions = cone::columns(&rods.directions);
        let joints = cone::margins(limits.slider_cone, &home.slider_axes, &directions);
        let (family, slider_joint) = least(&joints);
        lesser.meet(Constraint::SliderJoint, FAMILY_ROD[family], slider_joint, factors.slider_joint);
        let directions = cone::in_platform(rods, &directions);
        let joints = cone::margins(limits.platform_cone, &home.platform_axes, &directions);
        let (family, platform_joint) = least(&joints);
        lesser.meet(Constraint::PlatformJoint, FAMILY_ROD[family], platform_joint, factors.platform_joint);
        let (distance, [a, b]) = interference::least_distance_of_others(g, rods);
        let (rod_interference, element) = (distance - 2.0 * g.rod_radius, Element::Rods(a, b));
        lesser.meet(Constraint::RodInterference, element, rod_interference, factors.rod_interference);
        Self { pose: *pose, rho, slider_joint, platform_joint, rod_interference }
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
        let (a, b) = (&self.pose, posture.pose);
        let alpha = (a.alpha - b.alpha).abs();
        let platform = (a.x - b.x).abs() + (a.y - b.y).abs() + (a.z - b.z).abs();
        // How far the rods' ends are from those of the reference.
        let platform_end = platform + greater(g.R1, g.R2) * alpha;
        let slider = |i: usize| (self.rho[i] - posture.rho[i]).abs();
        let slider_end = greater(slider(0), greater(slider(1), slider(2)));
        let [first, _, second, third] = machine.mechanism.inverse_lengths;
        let chord = (platform_end + slider_end) * greater(first, greater(second, third));
        let angle = ANGLE_OVER_CHORD * chord;
        let distance = self.rod_interference - 2.0 * greater(platform_end, slider_end);
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
    let ClosedPosture { pose, rho, rods, table, clearance } = posture;
    let worst = WorstMargin::new(g.R1 * rods.c - g.r1, factors.rod_crossing);
    let crossing = worst.margin;
    let mut lesser = Lesser { worst, known, found };
    lesser.note(crossing);
    let stroke = [0, 1, 2].map(|i| range_margins(limits.stroke[i], rho[i]));
    let mut meet = |constraint, element, value, factor| lesser.meet(constraint, element, value, factor);
    each_length(machine, &stroke, &heights(g, pose, *rho, rods), &mut meet);
    let (tilt, rotary) =
        (range_margins(limits.tilt, table.theta1), range_margins(limits.rotary, table.theta2));
    each_range(machine, Some(tilt), Some(rotary), &mut meet);
    let (family, value) = least(&rods.directions.map(|direction| direction[2] - limits.serial_margin));
    meet(Constraint::SerialSingularity, FAMILY_ROD[family], value, factors.serial_singularity);
    let det = det_margin(machine, rods);
    meet(Constraint::ParallelSingularity, Element::Platform, det, factors.parallel_singularity);
    let (distance, [a, b]) = interference::least_distance_in_parallelograms(g, rods);
    let (value, element) = (distance - 2.0 * g.rod_radius, Element::Rods(a, b));
    meet(Constraint::RodInterference, element, value, factors.rod_interference);
    if let Some(clearance) = clearance {
        let Margin { constraint, element, value } = clearance.margin(machine, pose, *table);
        meet(constraint, element, value, factors.table_clearance);
    }
    if !reference.is_some_and(|reference| reference.excludes(machine, posture, &lesser)) {
        *reference = Some(Reference::of(machine, posture, &mut lesser));
    }
    (lesser.worst.margin, lesser.worst.fraction)
}
