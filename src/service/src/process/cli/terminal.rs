//! The terminal on which results are read.

use console::Term;

/// Columns of a terminal that does not state them.
const DEFAULT_WIDTH: usize = 80;

/// A terminal. Answers on it are tables and words; in a file or a pipe they are JSON.
#[derive(Clone, Copy, Debug)]
pub struct Terminal {
    /// Its columns.
    pub width: usize,
    /// Whether it shows colours and its user wants them (`NO_COLOR`, `CLICOLOR`).
    pub colours: bool,
}

impl Terminal {
    /// The terminal of standard output; `None` if that is a file or a pipe.
    pub fn of_standard_output() -> Option<Self> {
        let terminal = Term::stdout();
        terminal.is_term().then(|| {
            let width = terminal.size_checked().map(|(_, columns)| usize::from(columns));
            Self {
                width: width.filter(|width| *width > 0).unwrap_or(DEFAULT_WIDTH),
                colours: console::colors_enabled(),
            }
        })
    }
}
