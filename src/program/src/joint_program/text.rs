//! Texts in a joint program. None of them can end its comment or its line.

/// The most characters of a text: controllers read lines of 256.
const LONGEST_TEXT: usize = 200;

/// Comments that begin with these words are commands of LinuxCNC: some of them write files.
const COMMANDS: [&str; 6] = ["debug", "print", "log", "probeopen", "logopen", "logappend"];

/// Whether a line can stand in a program as it is.
pub(super) fn is_line(text: &str) -> bool {
    text.len() <= LONGEST_TEXT && text.bytes().all(|byte| matches!(byte, b' '..=b'~'))
}

/// The text as a line: other characters than printable ASCII become blanks.
pub(super) fn line(text: &str) -> String {
    let printable = |c: char| if matches!(c, ' '..='~') { c } else { ' ' };
    text.trim().chars().take(LONGEST_TEXT).map(printable).collect()
}

/// A comment with the text, in parentheses. A text that a controller would obey begins with a hyphen.
pub(super) fn comment(text: &str) -> String {
    let text = line(text).replace('(', "[").replace(')', "]");
    let word = text.split(',').next().filter(|word| word.len() < text.len()).unwrap_or_default();
    let word: String = word.split_whitespace().collect();
    let hyphen = if COMMANDS.contains(&word.to_ascii_lowercase().as_str()) { "- " } else { "" };
    format!("({hyphen}{text})")
}

#[cfg(test)]
mod tests {
    use super::comment;

    #[test]
    fn a_text_stays_in_its_comment() {
        assert_eq!(comment("a) G0 X0 (b"), "(a] G0 X0 [b)");
        assert_eq!(comment("one\r\nG0 X0\u{85}\u{2028}Ø"), "(one  G0 X0   )");
        assert_eq!(comment(&"x".repeat(1000)).len(), 202);
    }

    #[test]
    fn a_comment_is_no_command() {
        assert_eq!(comment("LOGOPEN,/etc/passwd"), "(- LOGOPEN,/etc/passwd)");
        assert_eq!(comment(" p r int ,#1"), "(- p r int ,#1)");
        assert_eq!(comment("MSG, change the tool"), "(MSG, change the tool)");
        assert_eq!(comment("print"), "(print)");
    }
}
