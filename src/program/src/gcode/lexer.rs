//! Cuts a line into words, a letter and a number each, and comments.

use std::borrow::Cow;

use arrayvec::ArrayVec;

use crate::gcode::text::decoded;

/// The most words of a block.
pub(crate) const MOST_WORDS: usize = 64;

/// A word: a letter and a number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Word<'a> {
    /// The letter in capitals.
    pub(crate) letter: u8,
    /// As written.
    pub(crate) text: &'a str,
    /// Where it begins in the line, from 0.
    pub(crate) column: usize,
    /// Whether the number has a minus sign.
    pub(crate) negative: bool,
    /// The number without its sign: digits with at most one point.
    pub(crate) digits: &'a str,
    /// The number, finite.
    pub(crate) value: f64,
}

/// A line of a program.
#[derive(Debug, Default)]
pub(crate) struct Line<'a> {
    /// A line that begins with `%` begins or ends a program.
    pub(crate) percent: bool,
    /// Whether the block begins with `/`.
    pub(crate) deletable: bool,
    pub(crate) words: ArrayVec<Word<'a>, MOST_WORDS>,
    pub(crate) comments: Vec<Cow<'a, str>>,
}

/// The place in a line that is no word.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Slip<'a> {
    /// From 0.
    pub(crate) column: usize,
    pub(crate) text: Cow<'a, str>,
    pub(crate) detail: &'static str,
}

const WORD: &str = "accepted is a word of a letter and a number, as in G1 or X-1.5";
const PARAMETER: &str =
    "parameters and expressions are not read; accepted is a number. Post the program without them";
const SUBPROGRAM: &str = "subprograms are not read; accepted is O with digits alone in the first block. Post one \
                          program without calls";

/// The details of faults of words of several letters.
const NAMES: [(&str, &str); 9] = [
    (
        "CYCLE",
        "cycles of Siemens, such as CYCLE800, are not read; accepted are G68.2 with G53.1 for tilted planes",
    ),
    ("PLANE", "PLANE SPATIAL of Heidenhain is not read; accepted are G68.2 with G53.1 for tilted planes"),
    ("TRAORI", "TRAORI of Siemens is not read; accepted are G43.4 and G43.5 with H"),
    ("IF", "branches are not read; post the program without them"),
    ("WHILE", "loops are not read; post the program without them"),
    ("GOTO", "branches are not read; post the program without them. A GOTO of CL text needs format=apt"),
    ("BEGIN", "programs of Heidenhain are not read; post the tool path as CL text"),
    ("DO", "loops are not read; post the program without them"),
    ("END", "loops are not read; post the program without them"),
];

/// Reads a line.
pub(crate) fn line(bytes: &[u8]) -> Result<Line<'_>, Slip<'_>> {
    let mut lexer = Lexer { bytes, at: 0 };
    let mut line = Line::default();
    lexer.skip_blanks();
    if lexer.peek() == Some(b'%') {
        return Ok(Line { percent: true, ..line });
    }
    loop {
        lexer.skip_blanks();
        let begin = lexer.at;
        match lexer.peek() {
            None => return Ok(line),
            Some(b';') => {
                line.comments.push(decoded(&bytes[begin + 1..]));
                return Ok(line);
            }
            Some(b'(') => line.comments.push(lexer.comment()?),
            Some(b'/') if line.words.iter().all(|word| word.letter == b'N') => {
                line.deletable = true;
                lexer.skip(|byte| byte == b'/' || byte.is_ascii_digit());
            }
            Some(letter) if letter.is_ascii_alphabetic() => {
                let word = lexer.word(letter.to_ascii_uppercase())?;
                if line.words.try_push(word).is_err() {
                    return Err(lexer.slip(begin, "a block has at most 64 words"));
                }
            }
            Some(b'#' | b'[' | b']' | b'=' | b'<') => return Err(lexer.slip(begin, PARAMETER)),
            Some(b')') => {
                return Err(lexer.slip(begin, "the parenthesis has no beginning; a comment is (text)"));
            }
            Some(_) => return Err(lexer.slip(begin, WORD)),
        }
    }
}

struct Lexer<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Lexer<'a> {
    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn skip(&mut self, mut accepted: impl FnMut(u8) -> bool) {
        while self.peek().is_some_and(&mut accepted) {
            self.at += 1;
        }
    }

    fn skip_blanks(&mut self) {
        self.skip(|byte| byte.is_ascii_whitespace() || byte == 0x0B);
    }

    /// A comment in parentheses, which may contain further ones.
    fn comment(&mut self) -> Result<Cow<'a, str>, Slip<'a>> {
        let begin = self.at;
        let mut depth = 0_usize;
        while let Some(byte) = self.peek() {
            self.at += 1;
            match byte {
                b'(' => depth += 1,
                b')' => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                return Ok(decoded(&self.bytes[begin + 1..self.at - 1]));
            }
        }
        self.at = begin;
        Err(self.slip(begin, "the comment has no end; accepted is (text) within one line, or ;text"))
    }

    /// The word that begins here.
    fn word(&mut self, letter: u8) -> Result<Word<'a>, Slip<'a>> {
        let begin = self.at;
        self.at += 1;
        self.skip_blanks();
        let negative = self.peek() == Some(b'-');
        if matches!(self.peek(), Some(b'+' | b'-')) {
            self.at += 1;
            self.skip_blanks();
        }
        let number = self.at;
        self.skip(|byte| byte.is_ascii_digit());
        if self.peek() == Some(b'.') {
            self.at += 1;
            self.skip(|byte| byte.is_ascii_digit());
        }
        let digits = ascii(&self.bytes[number..self.at]);
        if !digits.bytes().any(|byte| byte.is_ascii_digit()) {
            return Err(self.no_number(begin, letter));
        }
        let unsigned: f64 = digits.parse().unwrap_or(f64::INFINITY);
        if !unsigned.is_finite() {
            return Err(self.slip(begin, "the number is too large"));
        }
        let value = if negative { -unsigned } else { unsigned };
        let text = ascii(&self.bytes[begin..self.at]);
        self.skip_blanks();
        match self.peek() {
            Some(b'.' | b'0'..=b'9' | b'+' | b'-') => {
                Err(self.slip(begin, "a number has digits and at most one point"))
            }
            Some(b'[' | b'#' | b'=' | b'<' | b'*') => Err(self.slip(begin, PARAMETER)),
            Some(next) if letter == b'O' && !matches!(next, b'(' | b';') => Err(self.slip(begin, SUBPROGRAM)),
            _ => Ok(Word { letter, text, column: begin, negative, digits, value }),
        }
    }

    /// The slip of a letter without a number.
    fn no_number(&self, begin: usize, letter: u8) -> Slip<'a> {
        let run = self.bytes[begin..].iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
        let name = ascii(&self.bytes[begin..begin + run]);
        let known = |(known, _): &&(&str, &str)| {
            let start = name.get(..known.len()).filter(|start| start.eq_ignore_ascii_case(known));
            start.is_some() && (run == known.len() || known.len() > 4)
        };
        let detail = match NAMES.iter().find(known) {
            _ if letter == b'O' => SUBPROGRAM,
            Some((_, detail)) => detail,
            None if matches!(self.peek(), Some(b'#' | b'[')) => PARAMETER,
            None => WORD,
        };
        self.slip(begin, detail)
    }

    /// The text from `begin` to the next blank.
    fn slip(&self, begin: usize, detail: &'static str) -> Slip<'a> {
        let rest = &self.bytes[begin..];
        let end = rest.iter().skip(1).position(u8::is_ascii_whitespace).map_or(rest.len(), |end| end + 1);
        Slip { column: begin, text: decoded(&rest[..end]), detail }
    }
}

/// Bytes that are known to be ASCII.
fn ascii(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap_or_default()
}
