//! The states of all places where they may change, and the way back through them.

use crate::toolpath::stretches::Place;

/// The chosen state at a place where it may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::toolpath) struct Chosen {
    pub(in crate::toolpath) h: [i32; 2],
    /// alpha of the working solution, for a comparison; `None` if the place has no solution.
    pub(in crate::toolpath) alpha: Option<f32>,
}

/// A place of a cut where the tool leaves the part and the rotary axis turns by whole turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::toolpath) struct Rewind {
    pub(in crate::toolpath) place: Place,
    pub(in crate::toolpath) chosen: Chosen,
}

/// The chosen states.
#[derive(Debug, Default)]
pub(in crate::toolpath) struct Choice {
    /// One for each arrival, rapid, and beginning and end of a bounded stretch, in order.
    pub(in crate::toolpath) chosen: Vec<Chosen>,
    /// In order.
    pub(in crate::toolpath) rewinds: Vec<Rewind>,
}

/// A state in twelve bytes: a program of a million rapids has five million.
#[derive(Clone, Copy, Debug)]
struct Packed {
    alpha: f32,
    /// h less that of the first state of the stage.
    h: [i16; 2],
    parent: u8,
    has_alpha: bool,
}

#[derive(Clone, Copy, Debug)]
struct Stage {
    first: u32,
    h: i32,
}

/// The states at the places where they may change, each with the index of the state before it.
#[derive(Debug, Default)]
pub(super) struct Stages {
    states: Vec<Packed>,
    all: Vec<Stage>,
    /// The stages within a cut, with their places.
    rewinds: Vec<(usize, Place)>,
}

impl Stages {
    /// Adds a stage; `place` is given if it is within a cut.
    pub(super) fn push(&mut self, place: Option<Place>, states: impl Iterator<Item = (Chosen, usize)>) {
        if let Some(place) = place {
            self.rewinds.push((self.all.len(), place));
        }
        let first = u32::try_from(self.states.len()).unwrap_or(u32::MAX);
        let mut states = states.peekable();
        let base = states.peek().map_or(0, |(chosen, _)| chosen.h[0]);
        self.all.push(Stage { first, h: base });
        self.states.extend(states.map(|(chosen, parent)| Packed::new(chosen, parent, base)));
    }

    /// The sequence that ends with a state of the last stage.
    pub(super) fn traced(mut self, last: usize) -> Choice {
        let (mut index, mut choice) = (last, Choice::default());
        while let Some(stage) = self.all.pop() {
            let Some(packed) = self.states.get(stage.first as usize + index).copied() else { break };
            let chosen = packed.chosen(stage.h);
            index = usize::from(packed.parent);
            match self.rewinds.pop_if(|(number, _)| *number == self.all.len()) {
                Some((_, place)) => {
                    if self.last_h(index) != Some(chosen.h) {
                        choice.rewinds.push(Rewind { place, chosen });
                    }
                }
                None => choice.chosen.push(chosen),
            }
        }
        choice.chosen.reverse();
        choice.rewinds.reverse();
        choice
    }

    /// h of a state of the last stage.
    fn last_h(&self, index: usize) -> Option<[i32; 2]> {
        let stage = self.all.last()?;
        let packed = self.states.get(stage.first as usize + index)?;
        Some([packed.chosen(stage.h).h[1]; 2])
    }
}

impl Packed {
    #[allow(clippy::cast_possible_truncation, reason = "alpha serves a comparison; the rest is clamped")]
    fn new(chosen: Chosen, parent: usize, base: i32) -> Self {
        let offset = |h: i32| (h - base).clamp(i16::MIN.into(), i16::MAX.into()) as i16;
        Self {
            alpha: chosen.alpha.unwrap_or_default(),
            h: chosen.h.map(offset),
            parent: u8::try_from(parent).unwrap_or(u8::MAX),
            has_alpha: chosen.alpha.is_some(),
        }
    }

    fn chosen(&self, base: i32) -> Chosen {
        Chosen { h: self.h.map(|h| base + i32::from(h)), alpha: self.has_alpha.then_some(self.alpha) }
    }
}
