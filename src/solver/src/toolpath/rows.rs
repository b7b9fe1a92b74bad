//! The rows of a program for a choice of states.

mod examination;
mod feed;
mod rapid;
mod retract;
mod standstill;

use super::choice::{Choice, Chosen, Rewind};
use super::joint_segment::{Deviation, Track};
use super::linearise::Bend;
use super::meridian::{Meridian, Span};
use super::motion::{MotionKind, Motions, ToolPosition};
use super::node::{ClosedRods, Node, Setting};
use super::path::Path;
use super::report::{LeastMargins, Report};
use super::start::Start;
use crate::error::KinematicsError;
use crate::limit::{Constraint, Element, Margin};
use crate::pose::{PartPose, Point, TableAngles};

/// The purpose of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowKind {
    /// A place of a rapid, or the first position.
    Rapid,
    /// The end of a feed motion.
    Feed,
    /// A place between the ends of a feed motion.
    Inserted,
    /// The rotary axis turns while the tool stands still at the pole.
    Turn,
    /// The tool leaves the part within a cut.
    Retract,
    /// The rotary axis turns by whole turns while the tool is off the part.
    Rewind,
    /// The tool returns to the part.
    Approach,
}

impl RowKind {
    /// Whether the row belongs to a feed motion's path, so that its feed counts. Rapids and the ways off the part and
    /// back do not.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::toolpath::RowKind;
    ///
    /// assert!(RowKind::Inserted.is_cut() && !RowKind::Rewind.is_cut());
    /// ```
    pub fn is_cut(self) -> bool {
        match self {
            Self::Feed | Self::Inserted | Self::Turn => true,
            Self::Rapid | Self::Retract | Self::Rewind | Self::Approach => false,
        }
    }
}

/// One row: the joints to which the machine moves, all of them linearly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Index of the motion that the row belongs to.
    pub motion: usize,
    /// The purpose of the row.
    pub kind: RowKind,
    /// Where the tool is.
    pub position: ToolPosition,
    /// The sliders, mm.
    pub rho: [f64; 3],
    /// The table's angles, rad.
    pub table: TableAngles,
    /// The worst margin.
    pub margin: Margin,
    /// The way from the row before to this one. `None`: the machine arrives from anywhere.
    pub way: Option<Way>,
    /// Whether a smooth track of the joints ends here: at the end of a motion, and where phi2 begins to follow another
    /// rule.
    pub ends_track: bool,
}

/// The part of a motion's path that leads from one row to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Change of the path parameter; all of a motion is 1, and so is all of a turn at the pole.
    pub fraction: f64,
    /// Length of the path of the tool's end, mm. Joints that move straight in a rapid leave this path.
    pub length: f64,
    /// Angle that the axis moves through, rad: along the great circle, or the hypotenuse of the changes of phi1 and
    /// phi2 where these are linear. In a turn at the pole that of theta2.
    pub angle: f64,
}

/// Where a row is on the program's path.
pub(super) struct RowPlace {
    pub(super) tip: Point,
    /// `None`: the machine does not follow the path to this place.
    pub(super) way: Option<Way>,
    pub(super) ends_track: bool,
}

impl RowPlace {
    /// The end of a motion, which the machine reaches from anywhere.
    pub(super) fn of_arrival(tip: Point) -> Self {
        Self { tip, way: None, ends_track: true }
    }

    /// A place that the machine reaches along the path from the parameter `from`; the track ends at `end`.
    pub(super) fn on(path: &Path, from: f64, s: f64, end: f64) -> Self {
        let fraction = s - from;
        let way = Way { fraction, length: path.length() * fraction, angle: path.angle() * fraction };
        Self { tip: path.tip_at(s), way: Some(way), ends_track: s >= end }
    }
}

/// How the tool leaves the part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Retraction {
    /// Way along the tool's axis, mm.
    pub(super) clearance: f64,
    /// Height of the tool's end in the part frame at which the rotary axis may turn, mm.
    pub(super) height: f64,
}

/// Tolerances and mode of a program's rows.
pub(super) struct RowSettings {
    pub(super) feed: Deviation,
    pub(super) rapid: Deviation,
    pub(super) joint_rapids: bool,
    /// Where the machine stands before the program, if that is known.
    pub(super) start: Option<Start>,
    /// How the tool leaves the part within a cut, if it may.
    pub(super) retraction: Option<Retraction>,
}

/// Makes the rows.
pub(super) struct Rower<'a> {
    setting: Setting<'a>,
    settings: &'a RowSettings,
    choice: std::slice::Iter<'a, Chosen>,
    rewinds: &'a [Rewind],
    emit: &'a mut dyn FnMut(&Row),
    report: Report,
    least: LeastMargins,
    /// Where the machine stands.
    now: Option<Node>,
    /// Length of the tool in the last motion.
    tool_length: Option<f64>,
    h: [i32; 2],
    /// The worst margin of the last row, as a fraction of its range.
    margin: Option<f64>,
    /// Of the last segment of a feed motion, and of a rapid.
    bends: [Bend; 2],
}

impl<'a> Rower<'a> {
    pub(super) fn new(
        setting: Setting<'a>,
        settings: &'a RowSettings,
        choice: &'a Choice,
        emit: &'a mut dyn FnMut(&Row),
    ) -> Self {
        Self {
            setting,
            settings,
            choice: choice.chosen.iter(),
            rewinds: &choice.rewinds,
            emit,
            report: Report::new(),
            least: LeastMargins::new(),
            now: None,
            tool_length: None,
            h: [0; 2],
            margin: None,
            bends: Default::default(),
        }
    }

    /// Makes the rows of all motions; `go_on` is asked before each and ends the work by `false`.
    pub(super) fn run(
        mut self,
        motions: &dyn Motions,
        mut meridian: Meridian<'_>,
        mut go_on: impl FnMut(usize, u64) -> bool,
    ) -> Option<Report> {
        for index in 0..motions.count() {
            if !go_on(index, self.report.rows) {
                return None;
            }
            let motion = motions.motion(index);
            if index == 0 {
                self.begin(&motion);
            }
            meridian.advance(&motion);
            match &meridian.path {
                Some(path) => {
                    let changed = self.take_tool(index, &motion, path);
                    let path = changed.as_ref().unwrap_or(path);
                    if motion.kind == MotionKind::Rapid {
                        self.rapid(index, &motion, path, &meridian.spans);
                    } else {
                        self.feed(index, &motion, path, &meridian.spans);
                    }
                }
                None => self.arrive(index, &motion, &meridian.spans),
            }
            self.tool_length = Some(motion.tool_length);
        }
        self.report.least = self.least.found();
        // An arc is longer than its chord.
        let axis = &mut self.report.deviation.axis;
        *axis = 2.0 * (0.5 * *axis).min(1.0).asin();
        Some(self.report)
    }

    pub(super) fn next_choice(&mut self) -> Chosen {
        self.choice.next().copied().unwrap_or(Chosen { h: self.h, alpha: None })
    }

    /// The next change of winding within a cut, if it is in this motion up to this parameter.
    pub(super) fn next_rewind(&mut self, index: usize, s: f64) -> Option<Rewind> {
        let (next, rest) = self.rewinds.split_first()?;
        let is_here = next.place.motion == index && next.place.s <= s;
        is_here.then(|| {
            self.rewinds = rest;
            *next
        })
    }

    pub(super) fn change_to(&mut self, chosen: Chosen) {
        if (chosen.h[1] - self.h[1]) % 2 != 0 && self.report.rows > 0 {
            self.report.preimage_changes += 1;
        }
        self.h = chosen.h;
    }

    pub(super) fn refuse(&mut self, index: usize, pose: PartPose, refusal: KinematicsError) {
        let margin = match refusal {
            KinematicsError::Unreachable(margin) => margin,
            KinematicsError::SelfMotion => Margin {
                constraint: Constraint::ParallelSingularity,
                element: Element::Platform,
                value: -self.setting.machine.limits().parallel_margin,
            },
            KinematicsError::OutOfDomain | KinematicsError::OutOfProportion => {
                Margin { constraint: Constraint::LegLength, element: Element::Leg(1), value: f64::MIN }
            }
        };
        self.report.fail(index, (pose, None), (margin, margin.value));
    }

    pub(super) fn track<'p>(&self, path: &'p Path, span: Span, tool_length: f64) -> Track<'p>
    where
        'a: 'p,
    {
        Track { setting: self.setting, path, span, h: self.h, tool_length }
    }

    pub(super) fn row(
        &mut self,
        index: usize,
        kind: RowKind,
        place: &RowPlace,
        node: &Node,
        tool_length: f64,
    ) {
        let rods = node.closed_rods(self.setting.machine);
        self.closed_row(index, kind, place, (node, &rods), tool_length);
    }

    /// The same with the rods.
    pub(super) fn closed_row(
        &mut self,
        index: usize,
        kind: RowKind,
        place: &RowPlace,
        (node, rods): (&Node, &ClosedRods),
        tool_length: f64,
    ) {
        let (margin, fraction) = self.meet_closed(index, (node, rods), tool_length);
        let position = ToolPosition { tip: place.tip, axis: node.turns.axis() };
        self.report.add_row(node, self.now.as_ref());
        (self.emit)(&Row {
            motion: index,
            kind,
            position,
            rho: node.rho,
            table: node.table,
            margin,
            way: place.way.filter(|_| self.now.is_some()),
            ends_track: place.ends_track,
        });
        (self.now, self.margin) = (Some(*node), Some(fraction));
    }
}
