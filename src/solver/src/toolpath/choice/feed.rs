//! The states along a feed motion.

use super::rewind::rewound;
use super::state::advance;
use super::{Chooser, MOST_STATES, Skipped};
use crate::toolpath::meridian::Span;
use crate::toolpath::motion::Motion;
use crate::toolpath::path::Path;
use crate::toolpath::stretches::Place;

/// Angle and fraction of the machine's longest dimension between two ends of motions: in a longer program, ends that
/// are closer to the last place are not examined.
const LEAST_ANGLE: f64 = 0.01;
const LEAST_LENGTH: f64 = 1.0 / 256.0;

impl Chooser<'_> {
    pub(super) fn feed(&mut self, index: usize, motion: &Motion, path: &Path, spans: &[Span]) {
        for span in spans {
            let stretch = span.stretch().map(|number| self.setting.stretches[number]);
            let bounded = stretch.filter(|stretch| stretch.is_bounded && !stretch.has_rapid);
            if let Some(stretch) =
                bounded.filter(|stretch| stretch.start == Place { motion: index, s: span.from })
            {
                self.spread(stretch.phi2[1]);
            }
            let is_skipped = self.skips(index, motion, span, path);
            if !is_skipped {
                let along = self.along(path, span, motion.tool_length);
                let mut states = std::mem::take(&mut self.states);
                along.advance(&mut states, |states, s| {
                    std::mem::swap(states, &mut self.states);
                    self.rewind(Place { motion: index, s });
                    std::mem::swap(states, &mut self.states);
                });
                self.states = states;
            }
            if bounded.is_some_and(|stretch| stretch.end == Place { motion: index, s: span.to }) {
                self.gather();
            }
        }
    }

    /// Whether the end of a span is so near to the last place that it is left for later.
    fn skips(&mut self, index: usize, motion: &Motion, span: &Span, path: &Path) -> bool {
        if !self.is_long {
            return false;
        }
        let part = span.to - span.from;
        let (length, angle) = (path.length() * part, (path.turn() + path.sweep()) * part);
        let before = self.skipped.as_ref().map_or((0.0, 0.0), |skipped| (skipped.length, skipped.angle));
        let (length, angle) = (before.0 + length, before.1 + angle);
        let is_near = length < LEAST_LENGTH * self.setting.machine.longest() && angle < LEAST_ANGLE;
        self.skipped = is_near.then(|| Skipped {
            motion: index,
            tool_length: motion.tool_length,
            span: *span,
            at: path.at(span.to),
            length,
            angle,
        });
        is_near
    }

    /// Examines the end of the last motion, if it has been skipped.
    pub(super) fn examine_skipped(&mut self) {
        if let Some(Skipped { motion, tool_length, span, at, .. }) = self.skipped.take() {
            advance(&mut self.states, &self.setting, self.weights, tool_length, |h| {
                self.setting.target(&span, span.to, &at, h)
            });
            self.rewind(Place { motion, s: span.to });
        }
    }

    /// Adds the states that whole turns of theta2 off the part lead to.
    fn rewind(&mut self, place: Place) {
        if self.may_retract
            && let Some(states) = rewound(&self.states, &self.setting, self.weights)
        {
            self.states = states;
            self.states.truncate(MOST_STATES);
            self.stage(Some(place));
        }
    }
}
