//! The places of a plan, and their margins when the set-up changes while the tracks stay.
//!
//! A change of the origin, of the rotation about z, and of the tool's length leaves phi1 of a place as it is, and
//! changes phi2 by the rotation. So the margins of any places are those of [`part_working_rows`], without a plan.

use super::PlanOptions;
use super::azimuth::inclination;
use super::cap::Cap;
use super::meridian::Meridian;
use super::motion::{MotionKind, Motions, Standstill, Turning};
use super::node::Setting;
use super::path::dense_places;
use super::rows::{Row, RowKind};
use super::set_up::{AdjustableProgram, SetUp};
use super::stretches::stretches;
use crate::clearance::Clearance;
use crate::error::KinematicsError;
use crate::fast_math::sin_cos;
use crate::inverse::part_working_rows;
use crate::machine::Machine;
use crate::margins::{Margins, PostureColumns, margin_rows};
use crate::pose::{PartPose, Point, TableAngles};
use crate::registers::Registers;

/// Most places that are computed together.
const BLOCK: usize = 256;

/// A place of the path in the set-up of the plan. Lengths are millimetres, angles radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedPlace {
    /// Index of the motion.
    pub motion: usize,
    /// Index of the cut that the place, or the rapid through it, belongs to.
    pub cut: usize,
    /// Whether the place is on the rapid to the cut, before its end.
    pub is_rapid: bool,
    /// The tool's end.
    pub tip: Point,
    /// Inclination of the tool.
    pub phi1: f64,
    /// Azimuth of the tool, on the winding of the plan.
    pub phi2: f64,
    /// Length of the tool.
    pub tool_length: f64,
    /// Whether the set-up is the frame of the place.
    pub is_adjusted: bool,
    /// Whether phi2 follows the rotation of the set-up. Before the first inclined axis it does not.
    pub is_turned: bool,
}

/// The places of a plan.
#[derive(Clone, Debug)]
pub struct PlannedPlaces {
    /// The set-up of the plan.
    pub set_up: SetUp,
    /// The places, in the order of the program.
    pub places: Vec<PlannedPlace>,
    tool_radius: f64,
    table_clearance: Option<f64>,
    /// Whether the last row belongs to a cut.
    is_cutting: bool,
    /// Index of the present cut.
    cut: usize,
    /// Number of leading motions whose phi2 is not the program's.
    free: usize,
}

impl PlannedPlaces {
    /// No place yet, of a plan of `motions` with this set-up and these options.
    pub fn new(machine: &Machine, motions: &dyn Motions, set_up: SetUp, options: &PlanOptions) -> Self {
        let free = if options.start.is_some() {
            0
        } else {
            free_motions(motions, &Cap::new(options.pole, machine.longest()))
        };
        Self {
            set_up,
            places: Vec::new(),
            tool_radius: options.tool_radius,
            table_clearance: options.table_clearance,
            is_cutting: false,
            cut: 0,
            free,
        }
    }

    /// Places of the exact path of a program in this set-up, on one of its preimages, whether or not the machine
    /// reaches them. Long parts of the path have `density` places for each that the choice of tracks examines: a
    /// sixteenth of the machine's longest dimension, or 0.1 rad.
    pub fn of_program(
        machine: &Machine,
        program: &dyn AdjustableProgram,
        set_up: SetUp,
        options: &PlanOptions,
        density: f64,
    ) -> Self {
        let motions = program.motions(&set_up);
        let motions = &*motions;
        let cap = Cap::new(options.pole, machine.longest());
        let none = (Standstill::default(), None);
        let stretches = stretches(motions, &cap, none);
        let setting = Setting {
            machine,
            stretches: &stretches,
            table_clearance: options.table_clearance,
            tool_radius: options.tool_radius,
        };
        let mut meridian = Meridian::new(cap, &stretches, none);
        let mut found = Self::new(machine, motions, set_up, options);
        for index in 0..motions.count() {
            let motion = motions.motion(index);
            meridian.advance(&motion);
            found.cut += usize::from(motion.kind != MotionKind::Feed);
            for span in &meridian.spans {
                let count = match &meridian.path {
                    Some(path) => dense_places(machine.longest(), path, span.to - span.from, density),
                    None => 1,
                };
                for place in 1..=count {
                    let s = span.from + (span.to - span.from) * f64::from(place) / f64::from(count);
                    let at = meridian.path.as_ref().map_or(motion.end, |path| path.at(s));
                    let pose = setting.target(span, s, &at, [0, 0]).pose;
                    let is_rapid = motion.kind == MotionKind::Rapid && s < 1.0;
                    found.add((index, is_rapid), at.tip, [pose.phi1, pose.phi2], motion.tool_length, program);
                }
            }
        }
        found
    }

    fn add(
        &mut self,
        (motion, is_rapid): (usize, bool),
        tip: Point,
        [phi1, phi2]: [f64; 2],
        tool_length: f64,
        program: &dyn AdjustableProgram,
    ) {
        let is_adjusted = program.is_adjusted(motion);
        let is_turned = motion >= self.free && is_adjusted;
        let cut = self.cut;
        self.places.push(PlannedPlace {
            motion,
            cut,
            is_rapid,
            tip,
            phi1,
            phi2,
            tool_length,
            is_adjusted,
            is_turned,
        });
    }

    /// Adds the place of a row, with its tool. Rows off the part are left out: the plan alone decides about them.
    pub fn push(&mut self, row: &Row, tool_length: f64, program: &dyn AdjustableProgram) {
        if matches!(row.kind, RowKind::Retract | RowKind::Rewind | RowKind::Approach) {
            return;
        }
        // A cut begins at the row before its first way.
        let is_cutting = row.kind.is_cut() && row.way.is_some();
        self.cut += usize::from(self.is_cutting && !is_cutting);
        self.is_cutting = is_cutting;
        let phi2 = -row.table.theta2;
        let (sine, cosine) = sin_cos(phi2);
        let phi1 = inclination(row.position.axis, [sine, cosine]).0;
        let is_rapid = row.kind == RowKind::Rapid && !row.ends_track;
        self.add((row.motion, is_rapid), row.position.tip, [phi1, phi2], tool_length, program);
    }

    /// The pose of a place in another set-up. `other` is whether it is on the other preimage than planned.
    pub fn pose(&self, place: &PlannedPlace, set_up: &SetUp, other: bool) -> (PartPose, f64) {
        let turn = set_up.turn - self.set_up.turn;
        let tool_length = place.tool_length + (set_up.tool_length - self.set_up.tool_length);
        let [x, y, z] = if place.is_adjusted {
            let (s, c) = if turn == 0.0 { (0.0, 1.0) } else { turn.sin_cos() };
            let [x, y, z]: Point = std::array::from_fn(|i| place.tip[i] - self.set_up.origin[i]);
            let [a, b, d] = set_up.origin;
            [a + (c * x - s * y), b + (s * x + c * y), d + z]
        } else {
            place.tip
        };
        let phi2 = if place.is_turned { place.phi2 + turn } else { place.phi2 };
        let [phi1, phi2] =
            if other { [-place.phi1, phi2 + std::f64::consts::PI] } else { [place.phi1, phi2] };
        (PartPose { x, y, z, phi1, phi2 }, tool_length)
    }

    /// Calls `found` with the index, in turn, and the margins of each of some places in another set-up, or the reason
    /// why it has none. The range of theta2 takes no part: whole turns are the plan's choice.
    ///
    /// # Units
    ///
    /// Each field of [`Margins`] states its unit: mm, rad, or none.
    pub fn margins(
        &self,
        machine: &Machine,
        places: &[u32],
        (set_up, other): (&SetUp, bool),
        mut found: impl FnMut(usize, Result<&Margins, KinematicsError>),
    ) {
        let (mut targets, mut postures) = (Vec::<PartPose>::new(), PostureColumns::new());
        let (mut errors, mut all, mut first) = (Vec::new(), Vec::new(), 0);
        while first < places.len() {
            targets.clear();
            postures.clear();
            errors.clear();
            let mut length = 0.0;
            for (number, place) in places[first..].iter().take(BLOCK).enumerate() {
                let (pose, tool_length) = self.pose(&self.places[*place as usize], set_up, other);
                if number == 0 {
                    length = tool_length;
                } else if length.to_bits() != tool_length.to_bits() {
                    break;
                }
                targets.push(pose);
            }
            part_working_rows(machine, &targets, length, Registers::Widest, |i, posture| match posture {
                Ok(posture) => {
                    let theta1 = posture.pose.alpha - targets[i].phi1;
                    postures.push(&posture, Some(TableAngles { theta1, theta2: -targets[i].phi2 }));
                    errors.push(None);
                }
                Err(error) => errors.push(Some(error)),
            });
            let clearance = Clearance::of(machine, self.table_clearance, length, self.tool_radius);
            all.clear();
            margin_rows(machine, &postures, clearance.as_ref(), Registers::Widest, |_, margins| {
                all.extend((0..margins.len()).map(|i| margins.row(i)));
            });
            let mut next = all.iter();
            for (i, error) in errors.iter().enumerate() {
                match error {
                    Some(error) => found(first + i, Err(*error)),
                    None => next.by_ref().take(1).for_each(|margins| found(first + i, Ok(margins))),
                }
            }
            first += targets.len();
        }
    }
}

/// The number of leading motions during which phi2 is no angle of the program: all axes are in the cap, up to the last
/// arrival from anywhere before the first axis outside.
fn free_motions(motions: &dyn Motions, cap: &Cap) -> usize {
    let mut free = 0;
    for index in 0..motions.count() {
        let motion = motions.motion(index);
        if matches!(motion.turning, Turning::Held { .. }) {
            return free;
        }
        let is_inside = cap.has(motion.end.axis);
        if motion.kind == MotionKind::Arrive || index == 0 {
            free = index;
        }
        if !is_inside {
            return free;
        }
    }
    motions.count()
}
