//! How a command prints its answer: as tables and words on a terminal, as JSON elsewhere.

use std::io::Write;

use clap::Args;
use serde_json::Value;

use crate::process::cli::answer::to_json;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::page::Page;

/// The format of an answer.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct AnswerFormat {
    /// Print the answer as JSON on a terminal, too. Into a file or a pipe verne always prints JSON.
    #[arg(long)]
    json: bool,
    /// Print the answer as JSON with line breaks.
    #[arg(long)]
    pretty: bool,
}

impl AnswerFormat {
    /// The terminal, if it shows words instead of JSON.
    pub(crate) fn words_on(self, terminal: Option<Terminal>) -> Option<Terminal> {
        terminal.filter(|_| !self.json && !self.pretty)
    }

    /// Whether JSON has line breaks.
    pub(crate) fn has_line_breaks(self, terminal: Option<Terminal>) -> bool {
        self.pretty || terminal.is_some()
    }

    /// Writes an answer to `out`, which may be a terminal.
    pub(crate) fn write(
        self,
        answer: &Value,
        words: impl FnOnce(&Value) -> Page,
        out: &mut impl Write,
        terminal: Option<Terminal>,
    ) -> Result<(), String> {
        let text = match self.words_on(terminal) {
            Some(terminal) => words(answer).text(terminal),
            None => to_json(answer, self.has_line_breaks(terminal))? + "\n",
        };
        out.write_all(text.as_bytes()).map_err(|error| format!("cannot write the answer: {error}"))
    }
}
