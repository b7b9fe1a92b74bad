//! Sections of a program: runs of moves with one tool length and one origin.

use std::sync::Arc;

use verne_program::{
    Event, EventKind, LengthSource, MoveKind, Program, ProgramError, ProgramErrors, WorkOffset,
};

use crate::operations::program_motions::frame::Frame;
use crate::operations::program_motions::tool_lengths::{Length, LengthRule};
use crate::wire::canonical_toolpath::CanonicalToolpath;
use crate::wire::program::WarningObject;
use crate::wire::toolpath::TipName;

/// Most faults that are listed.
pub(crate) const MOST_FAULTS: usize = 20;

/// Most characters of a statement in a fault.
const WORD_CHARACTERS: usize = 64;

/// A run of moves with one tool length and one frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Section {
    /// Index of its first move.
    pub(crate) first: u32,
    /// Index of its frame.
    pub(crate) frame: u32,
    /// Distance from P to the point that the program moves, mm.
    pub(crate) tool_length: f64,
    /// What begins it.
    pub(crate) by: Break,
}

/// What begins a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Break {
    /// A change of length or origin.
    Change,
    /// A change of tool, perhaps at a tool changer.
    Tool,
    /// The beginning of the program, or the machine's home position.
    Home,
}

impl Break {
    /// Whether the next move begins in the joints in which the move before ends.
    pub(crate) fn keeps_joints(self, next: MoveKind) -> bool {
        match self {
            Self::Change => true,
            Self::Tool => next == MoveKind::Feed,
            Self::Home => false,
        }
    }
}

/// The sections of a program.
pub(crate) struct Sections {
    pub(crate) list: Vec<Section>,
    pub(crate) frames: Vec<Frame>,
    pub(crate) warnings: Vec<WarningObject>,
}

/// What is in force at a place of the program.
#[derive(Clone, PartialEq)]
struct State {
    length: Length,
    frame: Result<u32, String>,
    /// The event that changed length or frame last: its line and its statement.
    by: Option<(u32, Arc<str>)>,
}

impl Sections {
    /// Divides a program.
    ///
    /// # Errors
    ///
    /// The lines from which on length or origin are unknown.
    pub(crate) fn of(program: &Program, request: &CanonicalToolpath) -> Result<Self, ProgramErrors> {
        let rule = LengthRule::new(program, request.tool_length.as_ref(), request.length_before);
        let origins = Origins::of(request);
        let mut divider = Divider::new(program, request);
        let mut state = State { length: rule.initial(), frame: origins.get(WorkOffset::default()), by: None };
        divider.begin(0, &state, Break::Home);
        for event in program.events() {
            let before = state.clone();
            let Some(by) = state.apply(event, &rule, &origins) else { continue };
            if state != before {
                state.by = Some((event.line, event.text.as_ref().into()));
            }
            divider.begin(event.before, &state, by);
        }
        let list = divider.end()?;
        let mut warnings = length_warnings(program, &rule);
        warnings.extend(uncertain_ways(program, &list));
        Ok(Self { list, frames: origins.frames, warnings })
    }
}

impl State {
    /// Applies an event, and says whether the move after it begins a section, and by what.
    fn apply(&mut self, event: &Event, rule: &LengthRule<'_>, origins: &Origins) -> Option<Break> {
        match event.kind {
            EventKind::Tool { number, length } => {
                if rule.source == LengthSource::Tool {
                    self.length = rule.of_tool(number, length);
                }
                Some(Break::Tool)
            }
            EventKind::LengthOffset { number } => {
                let length = rule.of_offset(number);
                let is_same = self.length == length;
                self.length = length;
                (!is_same).then_some(Break::Change)
            }
            EventKind::WorkOffset(offset) => {
                let frame = origins.get(offset);
                let is_same = self.frame == frame;
                self.frame = frame;
                (!is_same).then_some(Break::Change)
            }
            EventKind::Home => Some(Break::Home),
            _ => None,
        }
    }
}

/// The frames of the work offsets.
struct Origins {
    frames: Vec<Frame>,
    /// The index of each offset's frame.
    listed: Vec<(WorkOffset, u32)>,
}

impl Origins {
    fn of(request: &CanonicalToolpath) -> Self {
        let mut origins = Self { frames: vec![Frame::of(&request.setup)], listed: Vec::new() };
        for ((name, setup), index) in request.offsets.iter().zip(1..) {
            // The names of a canonical request are valid.
            if let Ok(offset) = name.parse() {
                origins.listed.push((offset, index));
            }
            origins.frames.push(Frame::of(setup));
        }
        origins
    }

    fn get(&self, offset: WorkOffset) -> Result<u32, String> {
        match self.listed.iter().find(|(listed, _)| *listed == offset) {
            Some((_, index)) => Ok(*index),
            None if offset == WorkOffset::default() => Ok(0),
            None => Err(format!("offsets has no frame for {offset}; list it")),
        }
    }
}

struct Divider<'a> {
    program: &'a Program,
    /// What is between the point that the program moves and the tool's end, mm.
    beyond: f64,
    sections: Vec<Section>,
    states: Vec<State>,
    faults: Vec<ProgramError>,
    is_complete: bool,
}

impl<'a> Divider<'a> {
    fn new(program: &'a Program, request: &CanonicalToolpath) -> Self {
        let beyond = match request.tip {
            TipName::End => 0.0,
            TipName::Centre => request.tool_radius.unwrap_or_default(),
        };
        Self {
            program,
            beyond,
            sections: Vec::new(),
            states: Vec::new(),
            faults: Vec::new(),
            is_complete: true,
        }
    }

    /// Begins a section at a move. The last state before a move counts.
    fn begin(&mut self, first: u32, state: &State, by: Break) {
        let same = self.sections.pop_if(|last| last.first == first);
        if same.is_some() {
            self.states.pop();
        }
        self.settle();
        let by = same.map_or(by, |same| by.max(same.by));
        self.sections.push(Section { first, frame: 0, tool_length: 0.0, by });
        self.states.push(state.clone());
    }

    /// Takes length and frame of the last section, now that it has a move, from its state.
    fn settle(&mut self) {
        let Some(state) = self.states.pop() else { return };
        let Some(section) = self.sections.last_mut() else { return };
        let Some(first) = self.program.moves().get(section.first as usize) else {
            self.sections.pop();
            return;
        };
        let length = state.length.and_then(|length| {
            let length = length - self.beyond;
            let short =
                || format!("the tool is {} mm shorter than tool_radius; give a longer one", 0.0 - length);
            if length >= 0.0 { Ok(length) } else { Err(short()) }
        });
        match (length, state.frame) {
            (Ok(length), Ok(frame)) => (section.tool_length, section.frame) = (length, frame),
            (Err(detail), _) | (_, Err(detail)) => {
                let (line, word) = state.by.unwrap_or_else(|| (first.line(), "".into()));
                let word = word.chars().take(WORD_CHARACTERS).collect();
                self.fault(ProgramError { line, column: 1, word, detail });
            }
        }
    }

    fn fault(&mut self, fault: ProgramError) {
        if self.faults.contains(&fault) {
            return;
        }
        self.is_complete &= self.faults.len() < MOST_FAULTS;
        if self.is_complete {
            self.faults.push(fault);
        }
    }

    fn end(mut self) -> Result<Vec<Section>, ProgramErrors> {
        self.settle();
        if self.faults.is_empty() {
            self.sections.shrink_to_fit();
            return Ok(self.sections);
        }
        Err(ProgramErrors { errors: self.faults, complete: self.is_complete })
    }
}

/// What the plan takes from the program, because the request does not state it.
fn length_warnings(program: &Program, rule: &LengthRule<'_>) -> Vec<WarningObject> {
    if rule.lengths.is_some() {
        return Vec::new();
    }
    if rule.is_silent() {
        let line = program.moves().first().map_or(1, verne_program::Move::line);
        let detail = "no tool length is stated: the points are those of P, as for tool_length 0";
        return vec![warning(line, detail, 1)];
    }
    let tools = program.tools();
    let Some(first) = tools.first() else { return Vec::new() };
    let count = u32::try_from(tools.len()).unwrap_or(u32::MAX);
    vec![warning(first.line, "the lengths of the tools are those that the program states", count)]
}

/// The feed moves whose start is not known for sure.
fn uncertain_ways(program: &Program, sections: &[Section]) -> impl Iterator<Item = WarningObject> {
    let details = [
        (
            Break::Tool,
            "a feed move follows a change of tool: it begins where the machine stood before the change, with the new \
             tool; put a rapid before it",
        ),
        (
            Break::Home,
            "a feed move after the home position has no known start: the joints move straight to its end, and the way \
             is not checked; put a rapid before it",
        ),
    ];
    details.into_iter().filter_map(|(by, detail)| {
        let after = sections.iter().filter(|section| section.first > 0 && section.by == by);
        let first_moves = after.filter_map(|section| program.moves().get(section.first as usize));
        let mut feeds = first_moves.filter(|first| first.kind() == MoveKind::Feed);
        let line = feeds.next()?.line();
        let count = u32::try_from(feeds.count()).map_or(u32::MAX, |more| more.saturating_add(1));
        Some(warning(line, detail, count))
    })
}

fn warning(line: u32, detail: &str, occurrences: u32) -> WarningObject {
    WarningObject { line, word: String::new(), detail: detail.to_owned(), occurrences }
}
