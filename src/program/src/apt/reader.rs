//! Reads CL text line by line.

use crate::apt::assembler::{Assembler, Item};
use crate::apt::dispatch;
use crate::apt::state::{Extent, State};
use crate::apt::vocabulary::TextWord;
use crate::builder::Builder;
use crate::error::ProgramError;
use crate::event::EventKind;
use crate::lines::{LONGEST_LINE, LineReader};
use crate::options::ReadOptions;

/// Reads CL text.
#[derive(Debug)]
pub(crate) struct AptReader {
    assembler: Assembler,
    state: State,
    last_line: u32,
}

impl AptReader {
    pub(crate) fn new(options: &ReadOptions) -> Self {
        Self { assembler: Assembler::default(), state: State::new(options), last_line: 0 }
    }

    fn fault_at_end(&mut self, detail: &str) {
        let (line, detail) = (self.last_line.max(1), detail.to_owned());
        let error = ProgramError { line, column: 1, word: String::new(), detail };
        self.state.builder.diagnostics.fault(error);
    }
}

impl LineReader for AptReader {
    fn line(&mut self, number: u32, line: &[u8]) {
        self.last_line = number;
        let state = &mut self.state;
        self.assembler.line(number, line, |item| {
            let outcome = match item {
                Item::Statement(statement) => dispatch::execute(state, &statement),
                Item::Text(line, word, text) => take_text(state, line, word, text),
                Item::TooLong(statement) => {
                    Err(statement.fault(format!("a statement takes at most {LONGEST_LINE} bytes")))
                }
            };
            if let Err(error) = outcome {
                state.builder.diagnostics.fault(error);
            }
        });
    }

    fn end(&mut self, terminated: bool) {
        let state = &mut self.state;
        self.assembler.cut_off(|statement| {
            let detail = "the file ends within this statement: it is truncated, or the last $ is too much";
            state.builder.diagnostics.fault(statement.fault(detail.to_owned()));
        });
        if state.arc.is_some_and(|arc| arc.swept.is_none()) {
            self.fault_at_end("the file ends before the end of a circle; write a GOTO after it");
        }
        let ended = matches!(self.state.extent, Extent::Ended | Extent::Finished);
        if !ended && !terminated && self.state.extent == Extent::Begun {
            self.fault_at_end(
                "the file is truncated: it begins with PARTNO or TOOL PATH, and its last line has neither a line break \
                 nor FINI, END or END-OF-PATH",
            );
        } else if !ended {
            let detail = "the file ends without FINI, END or END-OF-PATH; it may be truncated";
            self.state.builder.diagnostics.warn(self.last_line, "", detail);
        }
    }

    fn builder(&mut self) -> &mut Builder {
        &mut self.state.builder
    }

    fn into_builder(self: Box<Self>) -> Builder {
        self.state.builder
    }
}

/// A comment, the name of the part, or a text for the controller.
fn take_text(state: &mut State, line: u32, word: TextWord, text: &str) -> Result<(), ProgramError> {
    if state.extent == Extent::Finished {
        return Ok(());
    }
    let kind = match word {
        TextWord::Insert => EventKind::Insert,
        TextWord::PartNumber => {
            state.extent = Extent::Begun;
            EventKind::Comment
        }
        TextWord::Comment => EventKind::Comment,
    };
    state.creo |= kind == EventKind::Comment && text.to_ascii_uppercase().contains("PRO/CLFILE");
    if text.is_empty() {
        return Ok(());
    }
    state.builder.event(line, kind, text).map_err(|detail| ProgramError {
        line,
        column: 1,
        word: String::new(),
        detail,
    })
}
