//! Cuts a statement into tokens.

/// One token of a statement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Token<'a> {
    /// The kind of the token.
    pub(crate) kind: TokenKind,
    /// Its characters, in capitals; the content of quotes.
    pub(crate) text: &'a str,
    /// Where it begins in the statement, in bytes.
    pub(crate) offset: usize,
}

/// The kinds of tokens. Commas only separate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum TokenKind {
    /// A number. It may be infinite if its exponent is too large.
    Number(f64),
    /// A word.
    Word,
    /// A text in quotes.
    Text,
    /// One of `(`, `)`, `/`, `=`.
    Mark,
    /// Something that begins like a number and is none.
    NotANumber,
}

impl Token<'_> {
    /// Whether this is the mark or the word.
    pub(crate) fn is(&self, text: &str) -> bool {
        matches!(self.kind, TokenKind::Word | TokenKind::Mark) && self.text == text
    }

    /// Its number, if it is one.
    pub(crate) fn number(&self) -> Option<f64> {
        match self.kind {
            TokenKind::Number(value) => Some(value),
            _ => None,
        }
    }
}

/// The tokens of a statement that is written in capitals.
pub(crate) fn tokens(statement: &str) -> Vec<Token<'_>> {
    let mut tokens = Vec::new();
    let mut rest = 0;
    while let Some(first) = statement[rest..].chars().next() {
        let offset = rest;
        if first.is_whitespace() || first == ',' {
            rest += first.len_utf8();
            continue;
        }
        let (kind, text, end) = match first {
            '(' | ')' | '/' | '=' => (TokenKind::Mark, &statement[offset..=offset], offset + 1),
            '\'' | '"' => {
                let inside = offset + 1;
                let length = statement[inside..].find(first);
                let end = length.map_or(statement.len(), |length| inside + length);
                (TokenKind::Text, &statement[inside..end], end + usize::from(length.is_some()))
            }
            _ => {
                let length = statement[offset..].find(is_delimiter).unwrap_or(statement.len() - offset);
                let text = &statement[offset..offset + length];
                (kind_of(text), text, offset + length)
            }
        };
        tokens.push(Token { kind, text, offset });
        rest = end;
    }
    tokens
}

fn is_delimiter(character: char) -> bool {
    matches!(character, ',' | '(' | ')' | '/' | '=' | '\'' | '"') || character.is_whitespace()
}

/// A number has digits, and no letters but those of an exponent. Rust would also read `INF` and `NAN`.
fn kind_of(text: &str) -> TokenKind {
    let letter = |byte: u8| byte.is_ascii_alphabetic() && !matches!(byte, b'E' | b'D');
    let digits = text.bytes().any(|byte| byte.is_ascii_digit());
    if !digits || text.bytes().any(letter) {
        let numeric = text.bytes().all(|byte| matches!(byte, b'+' | b'-' | b'.' | b'0'..=b'9'));
        return if numeric { TokenKind::NotANumber } else { TokenKind::Word };
    }
    let parsed = if text.contains('D') { text.replace('D', "E").parse() } else { text.parse() };
    match parsed {
        Ok(value) => TokenKind::Number(value),
        Err(_) if text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) => {
            TokenKind::NotANumber
        }
        Err(_) => TokenKind::Word,
    }
}

#[cfg(test)]
mod tests {
    use super::{TokenKind, tokens};

    fn kinds(statement: &str) -> Vec<TokenKind> {
        tokens(statement).iter().map(|token| token.kind).collect()
    }

    #[test]
    fn numbers_are_read_as_cl_files_write_them() {
        for (text, value) in
            [(".9625", 0.9625), ("1.", 1.0), ("-.5", -0.5), ("+3", 3.0), ("1.5D+01", 15.0), ("1E-3", 1e-3)]
        {
            assert_eq!(kinds(text), [TokenKind::Number(value)], "{text}");
        }
    }

    #[test]
    fn words_that_look_like_numbers_are_words_and_broken_numbers_are_none() {
        for word in ["NAN", "INF", "INFINITY", "3DCOMP", "STEP1", "E", "DEEP2", "E5"] {
            assert_eq!(kinds(word), [TokenKind::Word], "{word}");
        }
        for broken in ["1.2.3", "1-2", "-", ".", "5E", "+"] {
            assert_eq!(kinds(broken), [TokenKind::NotANumber], "{broken}");
        }
    }

    #[test]
    fn quotes_keep_marks_and_may_stay_open() {
        let found = tokens("PARTNO/'A \"B\", (C)' , X");
        assert_eq!(found.iter().map(|t| t.text).collect::<Vec<_>>(), ["PARTNO", "/", "A \"B\", (C)", "X"]);
        assert_eq!(kinds("'OPEN"), [TokenKind::Text]);
    }
}
