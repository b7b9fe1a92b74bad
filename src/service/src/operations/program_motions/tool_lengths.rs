//! Which length the tool has: by the request, or by the program.

use verne_program::{Event, LengthSource, Program};

use crate::wire::toolpath::ToolLengths;

/// What decides the lengths of the tools.
pub(crate) struct LengthRule<'a> {
    pub(crate) lengths: Option<&'a ToolLengths>,
    pub(crate) before: Option<u32>,
    pub(crate) source: LengthSource,
    /// Whether the program loads tools.
    has_tools: bool,
}

/// A length, or why there is none: a sentence that says what would be accepted.
pub(crate) type Length = Result<f64, String>;

impl<'a> LengthRule<'a> {
    /// The rule for a program.
    pub(crate) fn new(program: &Program, lengths: Option<&'a ToolLengths>, before: Option<u32>) -> Self {
        let is_tool = |event: &Event| matches!(event.kind, verne_program::EventKind::Tool { .. });
        let has_tools = program.events().iter().any(is_tool);
        Self { lengths, before, source: program.length_source(), has_tools }
    }

    /// Whether no one states a length: neither the request nor the program, which loads no tool either.
    pub(crate) fn is_silent(&self) -> bool {
        self.lengths.is_none() && self.source == LengthSource::Tool && !self.has_tools
    }

    /// The length before the program calls one.
    pub(crate) fn initial(&self) -> Length {
        match (self.lengths, self.source) {
            (Some(ToolLengths::One(length)), _) => Ok(*length),
            (Some(ToolLengths::Table(_)), _) => match self.before {
                Some(number) => self.entry(number),
                None => Err(format!(
                    "no length is in force here; {} before this line, or give length_before with an entry of \
                     tool_length",
                    match self.source {
                        LengthSource::Tool => "load a tool",
                        LengthSource::Offset => "write G43 H",
                    }
                )),
            },
            (None, LengthSource::Tool) if !self.has_tools => Ok(0.0),
            (None, _) => Err("the length of the tool is unknown; give tool_length".to_owned()),
        }
    }

    /// The length of a tool that is loaded.
    pub(crate) fn of_tool(&self, number: Option<u32>, stated: Option<f64>) -> Length {
        match (self.lengths, number) {
            (Some(ToolLengths::One(length)), _) => Ok(*length),
            (Some(ToolLengths::Table(_)), Some(number)) => self.entry(number),
            (Some(ToolLengths::Table(_)), None) => {
                Err("the program states no number for this tool; give one tool_length for every tool"
                    .to_owned())
            }
            (None, _) => stated.ok_or_else(|| {
                "the program does not state the length of this tool; give tool_length".to_owned()
            }),
        }
    }

    /// The length of a length offset; none after G49.
    pub(crate) fn of_offset(&self, number: Option<u32>) -> Length {
        match (self.lengths, number) {
            (Some(ToolLengths::Table(_)), Some(number)) => self.entry(number),
            _ => self.initial(),
        }
    }

    fn entry(&self, number: u32) -> Length {
        let Some(ToolLengths::Table(table)) = self.lengths else { return self.initial() };
        table.get(&number).copied().ok_or_else(|| {
            let known = table.keys().map(u32::to_string).collect::<Vec<_>>().join(", ");
            format!("tool_length has no entry {number}; its entries are {known}")
        })
    }
}
