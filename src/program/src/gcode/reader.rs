//! Reads G-code line by line.

use crate::builder::Builder;
use crate::diagnostics::shortened;
use crate::error::ProgramError;
use crate::event::EventKind;
use crate::gcode::block::Block;
use crate::gcode::dispatch;
use crate::gcode::lexer::{self, Line, Slip};
use crate::gcode::state::{Extent, State};
use crate::lines::LineReader;
use crate::options::ReadOptions;

/// Reads G-code.
#[derive(Debug)]
pub(crate) struct GcodeReader {
    state: State,
    last_line: u32,
}

impl GcodeReader {
    pub(crate) fn new(options: &ReadOptions) -> Self {
        Self { state: State::new(options), last_line: 0 }
    }

    fn take(&mut self, number: u32, line: Line<'_>) -> Result<(), ProgramError> {
        let state = &mut self.state;
        if line.percent {
            state.extent = match state.extent {
                Extent::Empty | Extent::Marked => Extent::Marked,
                Extent::Open | Extent::OpenMarked | Extent::Finished => Extent::Finished,
            };
            return Ok(());
        }
        if state.extent != Extent::Finished {
            for comment in line.comments.iter().map(|text| text.trim()).filter(|text| !text.is_empty()) {
                let event = state.builder.event(number, EventKind::Comment, comment);
                event.map_err(|detail| ProgramError {
                    line: number,
                    column: 1,
                    word: String::new(),
                    detail,
                })?;
            }
        }
        if line.words.is_empty() {
            return Ok(());
        }
        if line.deletable {
            let detail = "a block with / is read: block delete is taken as off";
            state.builder.diagnostics.warn(number, "/", detail);
        }
        dispatch::execute(state, &Block::new(number, line.words)?)
    }
}

impl LineReader for GcodeReader {
    fn line(&mut self, number: u32, line: &[u8]) {
        self.last_line = number;
        let outcome = match lexer::line(line) {
            Ok(line) => self.take(number, line),
            Err(_) if self.state.extent == Extent::Finished => Ok(()),
            Err(slip) => Err(fault_of(number, &slip)),
        };
        if let Err(error) = outcome {
            self.state.builder.diagnostics.fault(error);
        }
    }

    fn end(&mut self, terminated: bool) {
        let (line, state) = (self.last_line.max(1), &mut self.state);
        if let Some((number, line)) = state.tool.selected {
            let detail = "T without M6 loads no tool";
            state.builder.diagnostics.warn(line, &format!("T{number}"), detail);
        }
        if state.extent == Extent::OpenMarked && !terminated {
            let detail = "the file is truncated: it begins with %, and its last line has neither a line break nor M2, \
                          M30 or %"
                .to_owned();
            state.builder.diagnostics.fault(ProgramError { line, column: 1, word: String::new(), detail });
        } else if state.extent != Extent::Finished {
            let detail = "the file ends without M2, M30 or %; it may be truncated";
            state.builder.diagnostics.warn(line, "", detail);
        }
    }

    fn builder(&mut self) -> &mut Builder {
        &mut self.state.builder
    }

    fn into_builder(self: Box<Self>) -> Builder {
        self.state.builder
    }
}

fn fault_of(line: u32, slip: &Slip<'_>) -> ProgramError {
    let column = u32::try_from(slip.column + 1).unwrap_or(u32::MAX);
    ProgramError { line, column, word: shortened(&slip.text), detail: slip.detail.to_owned() }
}
