//! Feed motions.

use super::{RowKind, RowPlace, Rower};
use crate::error::KinematicsError;
use crate::limit::{Constraint, Element, Margin};
use crate::toolpath::joint_segment::{Stop, Track};
use crate::toolpath::linearise::{LineariseError, linearise};
use crate::toolpath::meridian::Span;
use crate::toolpath::motion::Motion;
use crate::toolpath::path::Path;
use crate::toolpath::stretches::Place;

/// Least turn at the pole for which the tool stands still, rad: the edge of a cap rounds azimuths by less.
const LEAST_TURN: f64 = 1e-6;

impl Rower<'_> {
    pub(super) fn feed(&mut self, index: usize, motion: &Motion, path: &Path, spans: &[Span]) {
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
            let mut from = span.from;
            while let Some(rewind) = self.next_rewind(index, span.to) {
                self.follow(index, motion, path, span, [from, rewind.place.s]);
                self.retract(index, motion, rewind.chosen);
                from = rewind.place.s;
            }
            if from < span.to || span.from == span.to {
                self.follow(index, motion, path, span, [from, span.to]);
            }
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
        let Ok(end) = track.node(1.0, Some(&now)) else { return };
        if (end.table.theta2 - now.table.theta2).abs() < LEAST_TURN {
            return;
        }
        let stops = [Stop { s: 0.0, node: now }, Stop { s: 1.0, node: end }];
        self.rows_between(index, motion, &track, stops, RowKind::Turn);
    }

    /// Follows a feed motion on a part of one span.
    fn follow(&mut self, index: usize, motion: &Motion, path: &Path, span: &Span, [from, to]: [f64; 2]) {
        let track = self.track(path, *span, motion.tool_length);
        let end = match track.node(to, self.now.as_ref()) {
            Ok(end) => end,
            Err(refusal) => {
                self.survey(index, &track);
                self.refuse(index, track.target(to).pose, refusal);
                self.now = None;
                return;
            }
        };
        if let Some(now) = self.now {
            let stops = [Stop { s: from, node: now }, Stop { s: to, node: end }];
            self.rows_between(index, motion, &track, stops, RowKind::Feed);
        } else {
            self.survey(index, &track);
            let place = RowPlace::on(path, from, to, to);
            self.row(index, kind_at(RowKind::Feed, to), &place, &end, motion.tool_length);
        }
    }

    fn rows_between(
        &mut self,
        index: usize,
        motion: &Motion,
        track: &Track<'_>,
        stops: [Stop; 2],
        kind: RowKind,
    ) {
        let [Stop { s: start, .. }, Stop { s: end, node: last }] = stops;
        let (feed, mut bend) = (self.settings.feed, self.bends[0]);
        if track.path.is_point() && kind != RowKind::Turn {
            let place = RowPlace::on(track.path, start, end, end);
            self.row(index, kind_at(kind, end), &place, &last, motion.tool_length);
            return;
        }
        let mut from = start;
        let result =
            linearise(track, stops[0], &stops[1], &feed, &mut bend, |stop, rods, segment, deviation| {
                let kind = kind_at(kind, stop.s);
                self.report.deviation = self.report.deviation.with(deviation);
                let (before, start) = (self.now.zip(self.margin), from);
                let mut place = RowPlace::on(track.path, from, stop.s, end);
                if let (RowKind::Turn, Some(way), Some(now)) = (kind, &mut place.way, &self.now) {
                    way.angle = (stop.node.table.theta2 - now.table.theta2).abs();
                }
                from = stop.s;
                self.closed_row(index, kind, &place, (&stop.node, rods), motion.tool_length);
                self.examine_way(index, track, before, [start, stop.s], segment);
            });
        self.bends[0] = bend;
        match result {
            Ok(()) => {}
            Err(LineariseError::Refused(s, refusal)) => {
                self.break_off(index, motion, track, (s, refusal), (&stops[1], kind));
            }
            Err(LineariseError::Jump(s)) => {
                let refusal = KinematicsError::Unreachable(Margin {
                    constraint: Constraint::ParallelSingularity,
                    element: Element::Platform,
                    value: 0.0,
                });
                self.break_off(index, motion, track, (s, refusal), (&stops[1], kind));
            }
        }
    }

    /// Notes that a part of a motion has no joints, and goes on at its end with a row of this kind.
    fn break_off(
        &mut self,
        index: usize,
        motion: &Motion,
        track: &Track<'_>,
        (s, refusal): (f64, KinematicsError),
        (end, kind): (&Stop, RowKind),
    ) {
        self.survey(index, track);
        self.refuse(index, track.target(s).pose, refusal);
        let place = RowPlace::of_arrival(track.path.tip_at(end.s));
        self.row(index, kind_at(kind, end.s), &place, &end.node, motion.tool_length);
    }
}

/// The kind of a row at a parameter of a motion of this kind: a feed motion ends at 1.
fn kind_at(kind: RowKind, s: f64) -> RowKind {
    if kind == RowKind::Feed && s < 1.0 { RowKind::Inserted } else { kind }
}
