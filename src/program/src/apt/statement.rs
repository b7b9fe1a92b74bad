//! A statement: a word and its arguments, with their places in the file.

use arrayvec::ArrayVec;

use crate::apt::lexer::{Token, TokenKind, tokens};
use crate::diagnostics::shortened;
use crate::error::ProgramError;
use crate::numerals::whole;

/// Where a part of a statement stands in the file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    /// Where the part begins in the statement, in bytes.
    pub(crate) offset: usize,
    /// The physical line, from 1.
    pub(crate) line: u32,
    /// The byte of the line, from 0.
    pub(crate) column: usize,
}

/// A statement of CL text.
#[derive(Debug)]
pub(crate) struct Statement<'a> {
    /// Its text as written, without comments.
    pub(crate) text: &'a str,
    parts: &'a [Part],
    tokens: Vec<Token<'a>>,
    /// The number of tokens before the arguments.
    head: usize,
}

impl<'a> Statement<'a> {
    /// `capitals` is `text` in capitals, byte by byte. `parts` are not empty.
    pub(crate) fn new(text: &'a str, capitals: &'a str, parts: &'a [Part]) -> Self {
        let tokens = tokens(capitals);
        let words = tokens.iter().take_while(|token| token.kind == TokenKind::Word).count();
        let slash = tokens.get(words).is_some_and(|token| token.is("/"));
        let head = if slash { words } else { words.min(1) };
        Self { text, parts, tokens, head }
    }

    /// The first physical line, from 1.
    pub(crate) fn line(&self) -> u32 {
        self.parts.first().map_or(0, |part| part.line)
    }

    /// The words before the slash; without a slash, the first word.
    pub(crate) fn head(&self) -> &[Token<'a>] {
        &self.tokens[..self.head]
    }

    /// The first word.
    pub(crate) fn word(&self) -> &'a str {
        self.head().first().map_or("", |token| token.text)
    }

    /// The tokens after the slash.
    pub(crate) fn arguments(&self) -> &[Token<'a>] {
        let slash = self.tokens.get(self.head).is_some_and(|token| token.is("/"));
        &self.tokens[self.head + usize::from(slash)..]
    }

    /// Whether one of the arguments is the word.
    pub(crate) fn has(&self, word: &str) -> bool {
        self.arguments().iter().any(|token| token.is(word))
    }

    /// The arguments, which must all be numbers, at most `N`.
    pub(crate) fn numbers<const N: usize>(&self, accepted: &str) -> Result<ArrayVec<f64, N>, ProgramError> {
        let mut numbers = ArrayVec::new();
        for token in self.arguments() {
            let value = self.number(token, accepted)?;
            if numbers.try_push(value).is_err() {
                return Err(self.fault(format!("{} has too many numbers; accepted: {accepted}", self.word())));
            }
        }
        Ok(numbers)
    }

    /// The number of a token, which must be finite.
    pub(crate) fn number(&self, token: &Token<'_>, accepted: &str) -> Result<f64, ProgramError> {
        match token.kind {
            TokenKind::Number(value) if value.is_finite() => Ok(value),
            TokenKind::Number(_) => Err(self.fault_at(token, "the number is too large".to_owned())),
            _ => Err(self.fault_at(token, format!("this is not a number; accepted: {accepted}"))),
        }
    }

    /// The whole number of a token: `3`, or `3.` as some systems write it.
    pub(crate) fn count(&self, token: &Token<'_>) -> Result<u32, ProgramError> {
        whole(token.text)
            .ok_or_else(|| self.fault_at(token, "this is not a whole number from 0 to 4294967295".to_owned()))
    }

    /// A fault of the statement as a whole.
    pub(crate) fn fault(&self, detail: String) -> ProgramError {
        let offset = self.tokens.first().map_or(0, |token| token.offset);
        self.error(offset, self.word(), detail)
    }

    /// A fault at one of its tokens.
    pub(crate) fn fault_at(&self, token: &Token<'_>, detail: String) -> ProgramError {
        self.error(token.offset, token.text, detail)
    }

    fn error(&self, offset: usize, word: &str, detail: String) -> ProgramError {
        let part = self.parts.iter().rev().find(|part| part.offset <= offset).or(self.parts.first());
        let (line, column) =
            part.map_or((1, 0), |part| (part.line, part.column + offset.saturating_sub(part.offset)));
        let column = u32::try_from(column + 1).unwrap_or(u32::MAX);
        ProgramError { line, column, word: shortened(word), detail }
    }
}
