//! The rows that wait for what follows.

use std::collections::VecDeque;

use super::super::rows::Row;
use super::corner::Corner;
use super::passes::{Ends, backward, forward};
use super::phases::phases;
use super::segment::Segment;
use super::times::{Governor, TimedRow, Times};
use crate::machine::Drive;

/// Greatest number of rows that wait.
const MOST_WAITING: usize = 4096;

/// What joins a segment to the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Link {
    /// Both belong to one track.
    Smooth,
    /// The track before has ended.
    Corner,
    /// The machine stands still between them.
    Rest,
}

enum Waiting {
    /// A row that changes no speed, with its time if that is known.
    Timed(Row, Option<(f64, Option<Governor>)>),
    Moving(Row, Box<Segment>, Link),
}

/// The rows that wait, and the times of those that do not.
pub(super) struct Window<F> {
    /// The drives, if any of them has an acceleration.
    drives: Option<[Drive; 5]>,
    cycle: f64,
    emit: F,
    times: Times,
    waiting: VecDeque<Waiting>,
    link: Link,
    /// The last segment that was timed, and the speed at its end.
    last: Option<(Box<Segment>, f64)>,
}

impl<F: FnMut(&TimedRow)> Window<F> {
    pub(super) fn new(drives: Option<[Drive; 5]>, cycle: f64, emit: F) -> Self {
        let (times, waiting) = (Times::default(), VecDeque::new());
        Self { drives, cycle, emit, times, waiting, link: Link::Rest, last: None }
    }

    pub(super) fn is_accelerating(&self) -> bool {
        self.drives.is_some()
    }

    /// The machine stands still here.
    pub(super) fn rest(&mut self) {
        self.link = Link::Rest;
    }

    /// Takes a row that changes no speed.
    pub(super) fn push_timed(&mut self, row: &Row, timing: Option<(f64, Option<Governor>)>) {
        if self.waiting.is_empty() {
            self.emit_timed(row, timing);
        } else {
            self.waiting.push_back(Waiting::Timed(*row, timing));
            self.bound();
        }
        self.end_track(row);
    }

    /// Takes a row to which the machine moves along a segment.
    pub(super) fn push(&mut self, row: &Row, mut segment: Segment) {
        let Some(drives) = self.drives else { return };
        if self.link == Link::Smooth {
            let before = self.waiting.iter_mut().rev().find_map(|waiting| match waiting {
                Waiting::Moving(_, segment, _) => Some(segment),
                Waiting::Timed(..) => None,
            });
            if let Some(before) = before {
                Segment::join(before, &mut segment, &drives);
            }
        }
        self.waiting.push_back(Waiting::Moving(*row, Box::new(segment), self.link));
        self.link = Link::Smooth;
        self.end_track(row);
        self.bound();
    }

    fn end_track(&mut self, row: &Row) {
        if row.ends_track && self.link == Link::Smooth {
            self.link = Link::Corner;
        }
    }

    /// Times rows if too many wait.
    fn bound(&mut self) {
        if self.waiting.len() < MOST_WAITING {
            return;
        }
        self.settle(false);
        if self.waiting.len() > MOST_WAITING / 4 * 3 {
            // Rows without motion follow the last segment.
            self.settle(true);
            self.link = Link::Rest;
        }
    }

    pub(super) fn finish(mut self) -> Times {
        self.settle(true);
        self.times
    }

    /// Times the segments whose speed nothing later changes; all of them if the machine stops at the end. The last
    /// segment waits for the next row of its track.
    fn settle(&mut self, stops: bool) {
        let corners = self.corners();
        let segments = self.segments().zip(&corners);
        let usable = if stops { corners.len() } else { corners.len().saturating_sub(1) };
        let known: Vec<_> = segments.take(usable).collect();
        let from_rest = backward(known.iter().copied(), 0.0);
        let count = if stops {
            usable
        } else {
            let free = backward(known.iter().copied(), f64::INFINITY);
            let equal = from_rest.iter().zip(&free).rposition(|(rest, free)| rest[0] == free[0]);
            // Half of the rows, if the speed of fewer is certain.
            equal.unwrap_or(0).max(usable / 2)
        };
        drop(known);
        self.time(&corners, &from_rest, count);
        if stops {
            while let Some(Waiting::Timed(row, timing)) = self.waiting.pop_front() {
                self.emit_timed(&row, timing);
            }
        }
    }

    fn segments(&self) -> impl DoubleEndedIterator<Item = &Segment> {
        self.waiting.iter().filter_map(|waiting| match waiting {
            Waiting::Moving(_, segment, _) => Some(&**segment),
            Waiting::Timed(..) => None,
        })
    }

    /// The corner before each of the segments that wait.
    fn corners(&self) -> Vec<Corner> {
        let Some(drives) = self.drives else { return Vec::new() };
        let mut before = self.last.as_ref().map(|(segment, _)| &**segment);
        let mut corners = Vec::new();
        for waiting in &self.waiting {
            let Waiting::Moving(_, segment, link) = waiting else { continue };
            corners.push(match (link, before) {
                (Link::Smooth, Some(_)) => Corner::SMOOTH,
                (Link::Corner, Some(before)) => Corner::between(before, segment, &drives, self.cycle),
                (Link::Rest, _) | (_, None) => Corner::REST,
            });
            before = Some(segment);
        }
        corners
    }

    /// Times this many segments, and the rows between them.
    fn time(&mut self, corners: &[Corner], most: &[Ends], count: usize) {
        for (corner, most) in corners.iter().zip(most).take(count) {
            while let Some(waiting) = self.waiting.pop_front() {
                match waiting {
                    Waiting::Timed(row, timing) => self.emit_timed(&row, timing),
                    Waiting::Moving(row, segment, _) => {
                        self.emit_moving(&row, segment, corner, *most);
                        break;
                    }
                }
            }
        }
    }

    fn emit_moving(&mut self, row: &Row, segment: Box<Segment>, corner: &Corner, most: Ends) {
        let before = self.last.as_ref().map_or(0.0, |(_, speed)| *speed);
        let ends = forward(&segment, corner, before, most);
        let mut longest = (0.0, segment.governor);
        let mut duration = 0.0;
        for (time, governor) in phases(&segment, ends) {
            self.times.add(time, governor);
            duration += time;
            if time > longest.0 {
                longest = (time, governor);
            }
        }
        self.last = Some((segment, ends[1]));
        (self.emit)(&TimedRow { row: *row, duration: Some(duration), governor: Some(longest.1) });
    }

    fn emit_timed(&mut self, row: &Row, timing: Option<(f64, Option<Governor>)>) {
        let governor = timing.and_then(|(_, governor)| governor);
        match (timing, governor) {
            (Some((duration, _)), Some(governor)) => self.times.add(duration, governor),
            (None, _) if row.way.is_some() => self.times.unknown += 1,
            _ => {}
        }
        let duration = timing.map(|(duration, _)| duration);
        (self.emit)(&TimedRow { row: *row, duration, governor });
    }
}
