//! Joins physical lines to statements: continuations, comments, texts and card images.

use crate::apt::statement::{Part, Statement};
use crate::apt::vocabulary::{TextWord, text_word};
use crate::lines::LONGEST_LINE;

/// The last column of a card that belongs to the statement. Columns 73 to 80 number the cards.
const CARD: usize = 72;

/// Joins lines.
#[derive(Debug, Default)]
pub(crate) struct Assembler {
    text: String,
    capitals: String,
    parts: Vec<Part>,
    /// Whether the file is known to consist of card images.
    cards: bool,
    after: After,
}

/// The statement that the next line may continue.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum After {
    /// Nothing.
    #[default]
    Statement,
    /// A statement that ends with `$`.
    Continued,
    /// A comment that ends with `$`. Creo goes on with rows of numbers.
    ContinuedComment,
}

/// The statement that a line completes.
#[derive(Debug)]
pub(crate) enum Item<'a> {
    /// A statement.
    Statement(Statement<'a>),
    /// A text for the operator or the controller: its word, and the text.
    Text(u32, TextWord, &'a str),
    /// The statement of these lines is too long.
    TooLong(Statement<'a>),
}

impl Assembler {
    /// Takes a line and passes on what it completes: a statement, a comment, both or none.
    pub(crate) fn line(&mut self, number: u32, line: &[u8], mut each: impl FnMut(Item<'_>)) {
        let decoded = String::from_utf8_lossy(line);
        let card = self.card(&decoded);
        let line = card.trim_end();
        let column = line.len() - line.trim_start().len();
        let line = line.trim_start();
        if line.is_empty() {
            return;
        }
        let after = std::mem::take(&mut self.after);
        if after == After::ContinuedComment
            && line.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
        {
            self.after = continued_comment(line);
            return;
        }
        if after != After::Continued
            && let Some((word, text)) = text_word(line)
        {
            self.after = continued_comment(line);
            return each(Item::Text(number, word, text));
        }
        let (code, end) = split(line);
        let part = Part { offset: self.text.len(), line: number, column };
        if !code.is_empty() {
            self.parts.push(part);
            self.text.push_str(code);
        }
        match end {
            _ if self.text.len() > LONGEST_LINE || self.parts.len() > LONGEST_LINE => {
                self.complete(|statement| each(Item::TooLong(statement)));
            }
            LineEnd::Continued => {
                self.text.push(' ');
                self.parts.extend(code.is_empty().then_some(part));
                self.after = After::Continued;
            }
            LineEnd::Comment(comment) if code.is_empty() && after == After::Continued => {
                self.after = After::Continued;
                each(Item::Text(number, TextWord::Comment, comment.trim()));
            }
            LineEnd::Comment(comment) => {
                self.complete(|statement| each(Item::Statement(statement)));
                self.after = continued_comment(line);
                each(Item::Text(number, TextWord::Comment, comment.trim()));
            }
            LineEnd::Plain => self.complete(|statement| each(Item::Statement(statement))),
        }
    }

    /// The statement that the end of the file cuts off, if there is one.
    pub(crate) fn cut_off(&mut self, take: impl FnOnce(Statement<'_>)) {
        self.complete(take);
    }

    fn complete(&mut self, take: impl FnOnce(Statement<'_>)) {
        if self.parts.is_empty() {
            return;
        }
        self.capitals.clone_from(&self.text);
        self.capitals.make_ascii_uppercase();
        take(Statement::new(self.text.trim_end(), &self.capitals, &self.parts));
        self.text.clear();
        self.parts.clear();
    }

    /// The line without the number of a card.
    ///
    /// A line is a card if digits, perhaps after letters, fill columns 73 to 80, and column 72 is blank; after the
    /// first such line, also if column 72 is not blank. So a long line in free form stays whole.
    fn card<'a>(&mut self, line: &'a str) -> &'a str {
        let (Some(card), Some(sequence)) = (line.get(..CARD), line.get(CARD..)) else { return line };
        let sequence = sequence.trim_end();
        let letters = |c: char| c.is_ascii_alphabetic() || c == ' ';
        let digits = sequence.trim_start_matches(letters);
        let numbered = (1..=8).contains(&sequence.len())
            && !digits.is_empty()
            && digits.bytes().all(|byte| byte.is_ascii_digit());
        let blank = card.ends_with([' ', '$']) && sequence.len() == 8;
        if numbered && (blank || self.cards) {
            self.cards = true;
            return card;
        }
        line
    }
}

/// How a line ends.
enum LineEnd<'a> {
    Plain,
    /// With a single `$`. The reader ignores the rest of the line.
    Continued,
    /// With `$$` and a comment.
    Comment(&'a str),
}

/// The statement of a line, and what its first `$` outside quotes begins.
fn split(line: &str) -> (&str, LineEnd<'_>) {
    let mut quote = None;
    for (at, character) in line.char_indices() {
        match (quote, character) {
            (None, '\'' | '"') => quote = Some(character),
            (Some(open), _) if open == character => quote = None,
            (None, '$') => {
                let code = line[..at].trim_end();
                return match line[at..].strip_prefix("$$") {
                    Some(comment) => (code, LineEnd::Comment(comment)),
                    None => (code, LineEnd::Continued),
                };
            }
            _ => {}
        }
    }
    (line, LineEnd::Plain)
}

fn continued_comment(line: &str) -> After {
    if line.ends_with('$') { After::ContinuedComment } else { After::Statement }
}

#[cfg(test)]
mod tests {
    use super::{Assembler, Item};

    fn items(lines: &[&str]) -> Vec<String> {
        let mut assembler = Assembler::default();
        let mut found = Vec::new();
        for (number, line) in (1..).zip(lines) {
            assembler.line(number, line.as_bytes(), |item| {
                found.push(match item {
                    Item::Statement(statement) => format!("{}: {}", statement.line(), statement.text),
                    Item::Text(line, word, text) => format!("{line}: {word:?} {text}"),
                    Item::TooLong(_) => "too long".to_owned(),
                });
            });
        }
        found
    }

    #[test]
    fn a_dollar_continues_a_statement_and_two_begin_a_comment() {
        let found = items(&["", "GOTO/1,2,$ rest is ignored", "", "  3 $$ done", "GOTO/'$$',1"]);
        assert_eq!(found, ["2: GOTO/1,2, 3", "4: Comment done", "5: GOTO/'$$',1"]);
    }

    #[test]
    fn the_numbers_of_cards_are_removed_and_long_free_lines_stay() {
        let card = |text: &str, number: &str| format!("{text:<72}{number}");
        let full = format!("GOTO/{:0<67}", "1.");
        let lines = [card("PARTNO X", "00000010"), card("FEDRAT/1", "ABC 0020"), card(&full, "00000030")];
        let found = items(&lines.each_ref().map(String::as_str));
        assert_eq!(found, ["1: PartNumber X", "2: FEDRAT/1", &format!("3: {full}")]);
        let free = format!("GOTO/{:0<75}", "1.");
        assert_eq!(items(&[&free]), [format!("1: {free}")]);
    }

    #[test]
    fn a_comment_continued_by_numbers_swallows_them_and_nothing_else() {
        let found =
            items(&["$$-> CSYS / 1.0, 0.0, $", "0.0, 1.0, $", "  -2.0", "GOTO/1,2,3", "$$ 5 $", "FINI"]);
        assert_eq!(found, ["1: Comment -> CSYS / 1.0, 0.0, $", "4: GOTO/1,2,3", "5: Comment 5 $", "6: FINI"]);
    }
}
