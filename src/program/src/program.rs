//! A program that was read.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::arc::Arc;
use crate::error::Warnings;
use crate::event::{Event, EventKind};
use crate::moves::Move;
use crate::options::Units;

/// A program: moves, and events in their places among them.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    pub(crate) units: Units,
    pub(crate) length_source: LengthSource,
    pub(crate) moves: Vec<Move>,
    pub(crate) arcs: Vec<Arc>,
    pub(crate) events: Vec<Event>,
    pub(crate) warnings: Warnings,
}

/// The statement that decides the length of the tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum LengthSource {
    /// The tool that is loaded: [`EventKind::Tool`] names the entry of the table of lengths. CL text and rows.
    Tool,
    /// The length offset in force: [`EventKind::LengthOffset`] names the entry, whatever tool is loaded. G-code.
    Offset,
}

/// The smallest box, parallel to the axes, around the tip's path. Helices are taken without their pitch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Smallest x, y and z in mm.
    pub min: [f64; 3],
    /// Largest x, y and z in mm.
    pub max: [f64; 3],
}

/// A tool that a program loads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tool {
    /// Its number, if the program states one.
    pub number: Option<u32>,
    /// Its length in mm, if the program states it.
    pub length: Option<f64>,
    /// The line that loads it first.
    pub line: u32,
}

/// One move together with its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment<'a> {
    /// The index of the move.
    pub index: usize,
    /// The move before: its tip and orientation are the start. The first move, and one after
    /// [`EventKind::Home`] or [`EventKind::WorkOffset`], has none.
    pub start: Option<&'a Move>,
    /// The move.
    pub end: &'a Move,
    /// Its arc; without one the tip moves straight.
    pub arc: Option<&'a Arc>,
}

/// A move or an event, in the order of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step<'a> {
    /// The tool moves.
    Move(Segment<'a>),
    /// Something else happens.
    Event(&'a Event),
}

/// The moves and events of a program in their order.
#[derive(Clone, Debug)]
pub struct Steps<'a> {
    program: &'a Program,
    next_move: usize,
    next_event: usize,
    start: Option<&'a Move>,
}

impl Program {
    /// The unit that the file states. All numbers of the program are in mm.
    pub fn units(&self) -> Units {
        self.units
    }

    /// Whether the tool or the length offset decides the length.
    pub fn length_source(&self) -> LengthSource {
        self.length_source
    }

    /// The moves, without the events.
    pub fn moves(&self) -> &[Move] {
        &self.moves
    }

    /// The events in the order of the program.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Messages for the author of the program.
    pub fn warnings(&self) -> &Warnings {
        &self.warnings
    }

    /// The arc of one of the moves of this program; a straight move has none.
    pub fn arc(&self, of: &Move) -> Option<&Arc> {
        self.arcs.get(of.arc_number()?.get() as usize - 1)
    }

    /// Moves and events in their order.
    ///
    /// ```
    /// use verne_program::{Format, ReadOptions, Step, read};
    ///
    /// let text = "UNITS/MM\nLOADTL/3\nGOTO/0,0,320\nSTOP\nGOTO/0,0,300\n";
    /// let program = read(Format::Apt, text.as_bytes(), &ReadOptions::default())?;
    /// let lines: Vec<u32> = program
    ///     .steps()
    ///     .map(|step| match step {
    ///         Step::Move(segment) => segment.end.line(),
    ///         Step::Event(event) => event.line,
    ///     })
    ///     .collect();
    /// assert_eq!(lines, [2, 3, 4, 5]);
    /// # Ok::<(), verne_program::ReadError>(())
    /// ```
    pub fn steps(&self) -> Steps<'_> {
        Steps { program: self, next_move: 0, next_event: 0, start: None }
    }

    /// The tools in the order of their first use. A tool without a number is listed for each loading.
    ///
    /// ```
    /// use verne_program::{Format, ReadOptions, read};
    ///
    /// let text = "UNITS/MM\nLOADTL/3,LENGTH,95\nLOAD/TOOL,1\nLOADTL/3,LENGTH,95\nGOTO/0,0,0\n";
    /// let tools = read(Format::Apt, text.as_bytes(), &ReadOptions::default())?.tools();
    /// assert_eq!(tools.iter().map(|tool| tool.number).collect::<Vec<_>>(), [Some(3), Some(1)]);
    /// assert_eq!(tools[0].length, Some(95.0));
    /// # Ok::<(), verne_program::ReadError>(())
    /// ```
    pub fn tools(&self) -> Vec<Tool> {
        let mut known = std::collections::BTreeSet::new();
        let mut tools = Vec::new();
        for event in &self.events {
            if let EventKind::Tool { number, length } = event.kind
                && number.is_none_or(|number| known.insert((number, length.map(f64::to_bits))))
            {
                tools.push(Tool { number, length, line: event.line });
            }
        }
        tools
    }

    /// The box around the tip's path; a program without moves has none.
    ///
    /// ```
    /// use verne_program::{Format, ReadOptions, read};
    ///
    /// let text = "UNITS/MM\nGOTO/10,0,5\nCIRCLE/0,0,5,0,0,1\nGOTO/-10,0,5\n";
    /// let bounds = read(Format::Apt, text.as_bytes(), &ReadOptions::default())?.bounds().unwrap();
    /// assert_eq!((bounds.min, bounds.max), ([-10.0, 0.0, 5.0], [10.0, 10.0, 5.0]));
    /// # Ok::<(), verne_program::ReadError>(())
    /// ```
    pub fn bounds(&self) -> Option<Bounds> {
        let first = self.moves.first()?.tip();
        let mut bounds = Bounds { min: first, max: first };
        let mut start = None;
        for (index, end) in self.moves.iter().enumerate() {
            bounds.include(end.tip());
            let segment = Segment { index, start, end, arc: self.arc(end) };
            segment.extremes().into_iter().for_each(|tip| bounds.include(tip));
            start = Some(end);
        }
        Some(bounds)
    }
}

impl Bounds {
    fn include(&mut self, tip: [f64; 3]) {
        for ((low, high), value) in self.min.iter_mut().zip(&mut self.max).zip(tip) {
            *low = low.min(value);
            *high = high.max(value);
        }
    }
}

impl Segment<'_> {
    /// The tip at the path parameter `t` from 0 to 1; without a start, the end.
    ///
    /// ```
    /// use verne_program::{Format, ReadOptions, Step, read};
    ///
    /// let text = "UNITS/MM\nGOTO/0,0,0\nGOTO/10,0,0\n";
    /// let program = read(Format::Apt, text.as_bytes(), &ReadOptions::default())?;
    /// let Some(Step::Move(segment)) = program.steps().last() else { panic!() };
    /// assert_eq!(segment.tip_at(0.25), [2.5, 0.0, 0.0]);
    /// # Ok::<(), verne_program::ReadError>(())
    /// ```
    pub fn tip_at(&self, t: f64) -> [f64; 3] {
        let end = self.end.tip();
        let Some(start) = self.start.map(Move::tip).filter(|_| t < 1.0) else { return end };
        match self.arc {
            Some(arc) => arc.point(start, end, t),
            None => Vector3::from(start).lerp(&Vector3::from(end), t.max(0.0)).into(),
        }
    }

    /// The length of the tip's path in mm; without a start, zero.
    pub fn length(&self) -> f64 {
        match (self.start, self.arc) {
            (None, _) => 0.0,
            (Some(start), Some(arc)) => arc.length(start.tip(), self.end.tip()),
            (Some(start), None) => (Vector3::from(self.end.tip()) - Vector3::from(start.tip())).norm(),
        }
    }

    fn extremes(&self) -> Vec<[f64; 3]> {
        match (self.start, self.arc) {
            (Some(start), Some(arc)) => {
                arc.extremes(start.tip()).into_iter().map(|t| self.tip_at(t)).collect()
            }
            _ => Vec::new(),
        }
    }
}

impl<'a> Iterator for Steps<'a> {
    type Item = Step<'a>;

    fn next(&mut self) -> Option<Step<'a>> {
        let program = self.program;
        if let Some(event) = program.events.get(self.next_event)
            && event.before as usize <= self.next_move
        {
            self.next_event += 1;
            if event.kind.hides_start() {
                self.start = None;
            }
            return Some(Step::Event(event));
        }
        let index = self.next_move;
        let end = program.moves.get(index)?;
        self.next_move += 1;
        let start = self.start.replace(end);
        Some(Step::Move(Segment { index, start, end, arc: program.arc(end) }))
    }
}
