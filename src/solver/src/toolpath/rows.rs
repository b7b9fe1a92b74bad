//! The rows of a program for a choice of states.

use std::f64::consts::PI;

use super::choice::{Chosen, places};
use super::joint_segment::{Deviation, JointSegment, Stop, Track};
use super::linearise::{LineariseError, linearise};
use super::meridian::{Meridian, Place, Span};
use super::motion::{Motion, MotionKind, Motions, ToolPosition};
use super::node::{Node, Setting};
use super::path::Path;
use super::report::{Departure, MOST_DEPARTURES, Report};
use crate::axis::tool_axis;
use crate::limit::{Constraint, Element, Margin, Refusal};
use crate::pose::{PartPose, TableAngles};
use crate::table::part_pose;

/// Fraction of a margin's range below which a segment's margins are examined between its ends.
const GUARD: f64 = 0.02;

/// What a row is for.
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
}

/// One row: the joints to which the machine moves, all of them linearly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Index of the motion that the row belongs to.
    pub motion: usize,
    /// What the row is for.
    pub kind: RowKind,
    /// Where the tool is.
    pub position: ToolPosition,
    /// The sliders, mm.
    pub rho: [f64; 3],
    /// The table's angles, rad.
    pub table: TableAngles,
    /// The worst margin.
    pub margin: Margin,
}

/// What the rows of a program are made with.
pub(super) struct RowSettings {
    pub(super) feed: Deviation,
    pub(super) rapid: Deviation,
    pub(super) joint_rapids: bool,
}

/// Makes the rows.
pub(super) struct Rower<'a, F> {
    setting: Setting<'a>,
    settings: &'a RowSettings,
    choice: std::slice::Iter<'a, Chosen>,
    emit: F,
    report: Report,
    now: Option<Node>,
    h: [i32; 2],
    margin: Option<f64>,
}

impl<'a, F: FnMut(&Row)> Rower<'a, F> {
    pub(super) fn new(
        setting: Setting<'a>,
        settings: &'a RowSettings,
        choice: &'a [Chosen],
        emit: F,
    ) -> Self {
        let choice = choice.iter();
        Self { setting, settings, choice, emit, report: Report::new(), now: None, h: [0; 2], margin: None }
    }

    /// Makes the rows of all motions; `go_on` is asked before each and ends the work by `false`.
    pub(super) fn run<M: Motions + ?Sized>(
        mut self,
        motions: &M,
        mut meridian: Meridian<'_>,
        mut go_on: impl FnMut(usize, u64) -> bool,
    ) -> Option<Report> {
        let mut position: Option<ToolPosition> = None;
        for index in 0..motions.count() {
            if !go_on(index, self.report.rows) {
                return None;
            }
            let motion = motions.motion(index);
            match position {
                Some(start) if motion.kind != MotionKind::Arrive => {
                    let path = Path::new(start, &motion);
                    meridian.pass(motion.kind, &path);
                    if motion.kind == MotionKind::Rapid {
                        self.rapid(index, &motion, &path, &meridian.spans);
                    } else {
                        self.feed(index, &motion, &path, &meridian.spans);
                    }
                }
                _ => {
                    meridian.arrive(&motion);
                    self.arrive(index, &motion, &meridian.spans);
                }
            }
            position = Some(motion.end);
        }
        Some(self.report)
    }

    fn next_choice(&mut self) -> Chosen {
        self.choice.next().copied().unwrap_or(Chosen { h: self.h, alpha: None })
    }

    /// A motion whose path is not the program's.
    fn arrive(&mut self, index: usize, motion: &Motion, spans: &[Span]) {
        let chosen = self.next_choice();
        self.change_to(chosen);
        self.now = None;
        self.go_straight(index, motion, spans, chosen);
    }

    fn change_to(&mut self, chosen: Chosen) {
        if (chosen.h[1] - self.h[1]) % 2 != 0 && self.report.rows > 0 {
            self.report.preimage_changes += 1;
        }
        self.h = chosen.h;
    }

    /// Moves all joints straight to the end of a motion.
    fn go_straight(&mut self, index: usize, motion: &Motion, spans: &[Span], chosen: Chosen) -> Option<Node> {
        let span = spans.last()?;
        let target = self.setting.target(span, 1.0, &motion.end, chosen.h);
        match self.setting.node(&target, motion.tool_length, chosen.alpha) {
            Ok(node) => {
                self.row(index, RowKind::Rapid, &motion.end, 1.0, &node, motion.tool_length);
                Some(node)
            }
            Err(refusal) => {
                self.refuse(index, 1.0, refusal);
                self.now = None;
                None
            }
        }
    }

    fn rapid(&mut self, index: usize, motion: &Motion, path: &Path, spans: &[Span]) {
        self.report.length[1] += path.length();
        let chosen = self.next_choice();
        let keeps = chosen.h == self.h && !self.settings.joint_rapids;
        self.change_to(chosen);
        if keeps && self.now.is_some() && self.keep_state(index, motion, path, spans, chosen) {
            return;
        }
        let before = self.now;
        let after = self.go_straight(index, motion, spans, chosen);
        if let (Some(before), Some(after)) = (before, after) {
            self.depart(index, motion, path, &before, &after);
        }
    }

    /// Follows a rapid's path with continuous joints; nothing happens if that is not possible.
    fn keep_state(
        &mut self,
        index: usize,
        motion: &Motion,
        path: &Path,
        spans: &[Span],
        chosen: Chosen,
    ) -> bool {
        let Some(mut now) = self.now else { return false };
        let mut rows: Vec<(f64, Node)> = Vec::new();
        for span in spans {
            let track = self.track(path, *span, motion.tool_length);
            let Ok(end) = track.node(span.to, Some(now.pose.alpha)) else { return false };
            let stops = [Stop { s: span.from, node: now }, Stop { s: span.to, node: end }];
            let result = linearise(&track, stops[0], stops[1], &self.settings.rapid, |stop, _, _| {
                rows.push((stop.s, stop.node));
            });
            if result.is_err() {
                return false;
            }
            now = end;
        }
        let is_chosen = chosen.alpha.is_none_or(|alpha| (alpha - now.pose.alpha).abs() < 1e-6);
        if !is_chosen {
            return false;
        }
        if rows.is_empty() {
            rows.push((1.0, now));
        }
        for (s, node) in rows {
            self.row(index, RowKind::Rapid, &path.at(s), s, &node, motion.tool_length);
        }
        true
    }

    /// Notes how far a rapid with straight joints leaves its line.
    fn depart(&mut self, index: usize, motion: &Motion, path: &Path, before: &Node, after: &Node) {
        self.report.departure_count += 1;
        if self.report.departures.len() >= MOST_DEPARTURES {
            return;
        }
        let segment = JointSegment::new(self.setting.machine, before, after);
        let greatest = segment.map(|segment| {
            self.examine(index, &segment, motion.tool_length);
            let of =
                |node: &Node| part_pose(self.setting.machine, &node.pose, node.table, motion.tool_length);
            let places = segment.places(self.setting.machine).flatten();
            let found = places.map(|(_, node)| from_line(path, &of(&node)));
            found.fold((0.0, [0.0; 3]), |greatest, found| if found.0 > greatest.0 { found } else { greatest })
        });
        let departure = match greatest {
            Some((distance, direction)) => Departure { motion: index, distance: Some(distance), direction },
            None => Departure { motion: index, distance: None, direction: [0.0; 3] },
        };
        self.report.departures.push(departure);
    }

    fn feed(&mut self, index: usize, motion: &Motion, path: &Path, spans: &[Span]) {
        self.report.length[0] += path.length();
        for span in spans {
            let stretch = span.stretch().map(|number| self.setting.stretches[number]);
            let bounded = stretch.filter(|stretch| stretch.is_bounded && !stretch.has_rapid);
            if let Some(stretch) =
                bounded.filter(|stretch| stretch.start == Place { motion: index, s: span.from })
            {
                let chosen = self.next_choice();
                self.change_to(chosen);
                if stretch.is_point() {
                    self.turn(index, motion, path, span);
                }
            }
            self.follow(index, motion, path, span);
            if bounded.is_some_and(|stretch| stretch.end == Place { motion: index, s: span.to }) {
                let chosen = self.next_choice();
                self.change_to(chosen);
            }
        }
    }

    /// Turns the rotary axis at the pole while the tool stands still.
    fn turn(&mut self, index: usize, motion: &Motion, path: &Path, span: &Span) {
        let Some(now) = self.now else { return };
        let position = path.at(span.from);
        let held = Path::new(position, &Motion { end: position, ..*motion });
        let turning = span.turning();
        let track = self.track(&held, turning, motion.tool_length);
        let Ok(end) = track.node(1.0, Some(now.pose.alpha)) else { return };
        self.rows_between(index, motion, &track, [now, end], RowKind::Turn);
    }

    /// Follows a feed motion on one span.
    fn follow(&mut self, index: usize, motion: &Motion, path: &Path, span: &Span) {
        let track = self.track(path, *span, motion.tool_length);
        let alpha = self.now.map(|node| node.pose.alpha);
        let end = match track.node(span.to, alpha) {
            Ok(end) => end,
            Err(refusal) => {
                self.survey(index, &track);
                self.refuse(index, span.to, refusal);
                self.now = None;
                return;
            }
        };
        match self.now {
            Some(now) => self.rows_between(index, motion, &track, [now, end], RowKind::Feed),
            None => {
                self.survey(index, &track);
                self.row(index, RowKind::Feed, &path.at(span.to), span.to, &end, motion.tool_length);
            }
        }
    }

    fn rows_between(
        &mut self,
        index: usize,
        motion: &Motion,
        track: &Track<'_>,
        ends: [Node; 2],
        kind: RowKind,
    ) {
        let [start, end] = [track.span.from, track.span.to];
        let stops = [Stop { s: start, node: ends[0] }, Stop { s: end, node: ends[1] }];
        let feed = self.settings.feed;
        if track.path.is_point() && kind != RowKind::Turn {
            self.row(index, kind, &track.path.at(end), end, &ends[1], motion.tool_length);
            return;
        }
        let mut failure = None;
        let result = linearise(track, stops[0], stops[1], &feed, |stop, segment, deviation| {
            let is_end = stop.s >= 1.0;
            let kind = if kind == RowKind::Feed && !is_end { RowKind::Inserted } else { kind };
            self.report.deviation = self.report.deviation.with(deviation);
            let before = self.margin;
            self.row(index, kind, &track.path.at(stop.s), stop.s, &stop.node, motion.tool_length);
            let least = before.unwrap_or(f64::INFINITY).min(self.margin.unwrap_or(f64::INFINITY));
            if let Some(segment) = segment.filter(|_| least < GUARD) {
                self.examine(index, segment, motion.tool_length);
            }
        });
        if let Err(error) = result {
            failure = Some(error);
        }
        match failure {
            None => {}
            Some(LineariseError::Refused(s, refusal)) => {
                self.break_off(index, motion, track, s, refusal, &ends[1])
            }
            Some(LineariseError::Jump(s)) => {
                let refusal = Refusal::Blocked(Margin {
                    constraint: Constraint::ParallelSingularity,
                    element: Element::Platform,
                    value: 0.0,
                });
                self.break_off(index, motion, track, s, refusal, &ends[1]);
            }
        }
    }

    /// Notes that a part of a motion has no joints, and goes on at its end.
    fn break_off(
        &mut self,
        index: usize,
        motion: &Motion,
        track: &Track<'_>,
        s: f64,
        refusal: Refusal,
        end: &Node,
    ) {
        self.survey(index, track);
        self.refuse(index, s, refusal);
        let position = track.path.at(track.span.to);
        self.row(index, RowKind::Feed, &position, track.span.to, end, motion.tool_length);
    }

    /// Examines the places of a path that has no rows, for the report.
    fn survey(&mut self, index: usize, track: &Track<'_>) {
        let Span { from, to, .. } = track.span;
        let count = places(self.setting.machine.longest(), track.path, to - from);
        for place in 0..count {
            let s = from + (to - from) * f64::from(place) / f64::from(count);
            match track.node(s, None) {
                Ok(node) => {
                    let margins = self.setting.margins(&node, track.tool_length);
                    self.report.meet(self.setting.machine, index, s, &margins);
                }
                Err(refusal) => self.refuse(index, s, refusal),
            }
        }
    }

    fn refuse(&mut self, index: usize, s: f64, refusal: Refusal) {
        let margin = match refusal {
            Refusal::Blocked(margin) => margin,
            Refusal::OutOfDomain | Refusal::TooFar | Refusal::SelfMotion => {
                Margin { constraint: Constraint::LegLength, element: Element::Leg(1), value: f64::MIN }
            }
        };
        self.report.fail(index, s, margin, margin.value);
    }

    /// Examines the margins between the ends of a segment.
    fn examine(&mut self, index: usize, segment: &JointSegment, tool_length: f64) {
        if let Some(margins) = segment.worst(&self.setting, tool_length) {
            self.report.meet(self.setting.machine, index, 1.0, &margins);
        }
    }

    fn track<'p>(&self, path: &'p Path, span: Span, tool_length: f64) -> Track<'p>
    where
        'a: 'p,
    {
        Track { setting: self.setting, path, span, h: self.h, tool_length }
    }

    fn row(&mut self, index: usize, kind: RowKind, at: &ToolPosition, s: f64, node: &Node, tool_length: f64) {
        let margins = self.setting.margins(node, tool_length);
        let (margin, fraction) = self.report.meet(self.setting.machine, index, s, &margins);
        let phi = [node.pose.alpha - node.table.theta1, -node.table.theta2];
        let position = ToolPosition { tip: at.tip, axis: tool_axis(phi[0], phi[1]) };
        let inclination = (phi[0] + PI).rem_euclid(2.0 * PI) - PI;
        self.report.add_row(node, self.now.as_ref(), inclination);
        (self.emit)(&Row { motion: index, kind, position, rho: node.rho, table: node.table, margin });
        (self.now, self.margin) = (Some(*node), Some(fraction));
    }
}

/// Distance of a tool position from the line between a path's ends, and the unit vector from the line to it.
fn from_line(path: &Path, tool: &PartPose) -> (f64, [f64; 3]) {
    let (start, end) = (path.at(0.0).tip, path.at(1.0).tip);
    let tip = [tool.x, tool.y, tool.z];
    let along: [f64; 3] = std::array::from_fn(|i| end[i] - start[i]);
    let from: [f64; 3] = std::array::from_fn(|i| tip[i] - start[i]);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let square = dot(along, along);
    let t = if square > 0.0 { (dot(from, along) / square).clamp(0.0, 1.0) } else { 0.0 };
    let off: [f64; 3] = std::array::from_fn(|i| from[i] - along[i] * t);
    let distance = dot(off, off).sqrt();
    (distance, if distance > 0.0 { off.map(|c| c / distance) } else { [0.0; 3] })
}
