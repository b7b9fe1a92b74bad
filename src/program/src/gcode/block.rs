//! A block: the words of a line, each of which is used once.

use std::cell::Cell;

use arrayvec::ArrayVec;

use crate::diagnostics::shortened;
use crate::error::ProgramError;
use crate::gcode::lexer::{MOST_WORDS, Word};
use crate::gcode::vocabulary::{Group, general};
use crate::numerals::{tenths, whole};

/// A block.
#[derive(Debug)]
pub(crate) struct Block<'a> {
    /// The physical line, from 1.
    pub(crate) line: u32,
    words: ArrayVec<Word<'a>, MOST_WORDS>,
    /// The letters that were used, one bit each.
    used: Cell<u32>,
}

impl<'a> Block<'a> {
    /// A block, or the fault of a letter that appears twice. G and M may appear several times.
    pub(crate) fn new(line: u32, words: ArrayVec<Word<'a>, MOST_WORDS>) -> Result<Self, ProgramError> {
        let block = Self { line, words, used: Cell::new(0) };
        let mut seen = 0;
        for word in &block.words {
            if matches!(word.letter, b'G' | b'M') {
                continue;
            }
            if seen & bit(word.letter) != 0 {
                let detail = format!("the block has two {} words; accepted is one", char::from(word.letter));
                return Err(block.fault_at(word, detail));
            }
            seen |= bit(word.letter);
        }
        Ok(block)
    }

    pub(crate) fn words(&self) -> &[Word<'a>] {
        &self.words
    }

    /// Whether it has a word of one of these letters that is not used yet.
    pub(crate) fn has_any(&self, letters: &[u8]) -> bool {
        self.first_of(letters).is_some()
    }

    /// The first word of one of these letters that is not used yet.
    pub(crate) fn first_of(&self, letters: &[u8]) -> Option<&Word<'a>> {
        self.words
            .iter()
            .find(|word| letters.contains(&word.letter) && self.used.get() & bit(word.letter) == 0)
    }

    /// The word of a letter, which is used then.
    pub(crate) fn take(&self, letter: u8) -> Option<&Word<'a>> {
        let word = self.first_of(&[letter])?;
        self.used.set(self.used.get() | bit(letter));
        Some(word)
    }

    /// The whole number of a word.
    pub(crate) fn count(&self, word: &Word<'_>) -> Result<u32, ProgramError> {
        whole(word.digits).filter(|_| !word.negative).ok_or_else(|| {
            let detail = format!("{} needs a whole number from 0 to 4294967295", char::from(word.letter));
            self.fault_at(word, detail)
        })
    }

    /// The words of these letters as written, with a blank between them.
    pub(crate) fn text_of(&self, letters: &[u8]) -> String {
        let words: Vec<_> =
            self.words.iter().filter(|word| letters.contains(&word.letter)).map(|word| word.text).collect();
        words.join(" ")
    }

    /// A fault of the block as a whole: at the code of its motion or cycle, otherwise at its first word.
    pub(crate) fn fault(&self, detail: String) -> ProgramError {
        let motion = self.words.iter().find(|word| is_motion(word));
        match motion.or_else(|| self.words.iter().find(|word| word.letter != b'N')).or(self.words.first()) {
            Some(word) => self.fault_at(word, detail),
            None => ProgramError { line: self.line, column: 1, word: String::new(), detail },
        }
    }

    /// A fault at one of its words.
    pub(crate) fn fault_at(&self, word: &Word<'_>, detail: String) -> ProgramError {
        let column = u32::try_from(word.column + 1).unwrap_or(u32::MAX);
        ProgramError { line: self.line, column, word: shortened(word.text), detail }
    }
}

/// Whether a word is one of G0 to G3 or a cycle.
fn is_motion(word: &Word<'_>) -> bool {
    let meaning = tenths(word.digits).filter(|_| word.letter == b'G').map(general);
    matches!(meaning, Some(Ok(meaning)) if meaning.group() == Group::Motion)
}

fn bit(letter: u8) -> u32 {
    1 << u32::from(letter.saturating_sub(b'A').min(31))
}
