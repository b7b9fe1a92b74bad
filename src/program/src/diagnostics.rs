//! A bounded collection of faults and warnings.

use crate::error::{ProgramError, ProgramErrors, Warning, Warnings};

/// The reader stops at so many faults.
const MOST_ERRORS: usize = 20;
/// So many different warnings are listed.
const MOST_WARNINGS: usize = 100;
/// So many characters of a word are reported.
const LONGEST_WORD: usize = 64;

/// Faults and warnings in the order of the file.
#[derive(Debug, Default)]
pub(crate) struct Diagnostics {
    errors: Vec<ProgramError>,
    warnings: Warnings,
    stopped: bool,
}

impl Diagnostics {
    /// Records a fault.
    pub(crate) fn fault(&mut self, error: ProgramError) {
        if self.errors.len() < MOST_ERRORS {
            self.errors.push(error);
        }
        self.stopped |= self.errors.len() == MOST_ERRORS;
    }

    /// Records a fault after which nothing of the source makes sense.
    pub(crate) fn stop(&mut self, error: ProgramError) {
        self.fault(error);
        self.stopped = true;
    }

    /// Whether reading on is pointless.
    pub(crate) fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// Records a warning. Warnings with the same word and detail become one.
    pub(crate) fn warn(&mut self, line: u32, word: &str, detail: &str) {
        self.warnings.total += 1;
        let word = shortened(word);
        let known = self.warnings.list.iter_mut().find(|known| known.word == word && known.detail == detail);
        if let Some(known) = known {
            known.occurrences = known.occurrences.saturating_add(1);
        } else if self.warnings.list.len() < MOST_WARNINGS {
            self.warnings.list.push(Warning { line, word, detail: detail.to_owned(), occurrences: 1 });
        }
    }

    /// The warnings, or the faults if there are any.
    pub(crate) fn into_result(self) -> Result<Warnings, ProgramErrors> {
        if self.errors.is_empty() {
            Ok(self.warnings)
        } else {
            Err(ProgramErrors { errors: self.errors, complete: !self.stopped })
        }
    }
}

/// The beginning of a word, as reports show it.
pub(crate) fn shortened(word: &str) -> String {
    word.chars().take(LONGEST_WORD).collect()
}
