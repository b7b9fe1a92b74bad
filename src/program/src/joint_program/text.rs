//! Texts in a joint program. None of them can end its comment or its line.

/// The most characters of a text: controllers read lines of 256.
const LONGEST_TEXT: usize = 200;

/// Comments that begin with these words are commands of LinuxCNC: some of them write files.
const COMMANDS: [&str; 6] = ["debug", "print", "log", "probeopen", "logopen", "logappend"];

/// Whether a line can stand in a program as it is.
pub(super) fn is_line(text: &str) -> bool {
    text.len() <= LONGEST_TEXT && text.bytes().all(|byte| matches!(byte, b' '..=b'~'))
}

/// The M words that end a program, or leave it for another one.
const LEAVING: [u32; 4] = [2, 30, 98, 99];

/// Whether a text consists of M, S and T words, perhaps after a block number, and none of them ends the program or
/// leaves it.
pub(super) fn is_auxiliary(text: &str) -> bool {
    let compact: String = text.trim().to_ascii_uppercase().split(' ').collect();
    let starts = compact.char_indices().filter(|(_, c)| c.is_ascii_alphabetic()).map(|(start, _)| start);
    let ends = starts.clone().skip(1).chain([compact.len()]);
    let mut words = starts.zip(ends).map(|(start, end)| compact[start..end].split_at(1)).peekable();
    // `parse` alone would accept a sign; letters, such as those of an exponent, begin a word.
    let whole = |number: &str| number.parse::<u32>().ok().filter(|_| !number.starts_with('+'));
    words.next_if(|(letter, number)| *letter == "N" && whole(number).is_some());
    is_line(text.trim())
        && compact.starts_with(|c: char| c.is_ascii_alphabetic())
        && words.peek().is_some()
        && words.all(|(letter, number)| match letter {
            "M" => whole(number).is_some_and(|code| !LEAVING.contains(&code)),
            "S" => number.starts_with(|c: char| c.is_ascii_digit()) && number.parse::<f64>().is_ok(),
            "T" => whole(number).is_some(),
            _ => false,
        })
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
    use super::{comment, is_auxiliary};

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

    #[test]
    fn only_m_s_and_t_words_go_to_the_controller() {
        for text in ["M8", " m08 ", "N10 M8 M 51", "S6000.5 M3", "T12", "T1M6S300"] {
            assert!(is_auxiliary(text), "{text}");
        }
        let other = [
            "",
            "N10",
            "G0 X777",
            "G91",
            "Stock Size X95. Y150.",
            "M8 (x)",
            "/M8",
            "M64 P2",
            "M98 P1",
            "M99",
            "M30",
            "m02",
            "M8 N1",
            "M",
            "M-8",
            "S+1",
            "S1E5",
            "SINF",
            "SNAN",
            "T1.5",
            "10 M8",
            "M8 Ø",
            "M8\nG0X1",
            "M8;G0X1",
            "%M8",
            "#1=5",
            "M#1",
            "TOOL",
            "STOP",
        ];
        for text in other {
            assert!(!is_auxiliary(text), "{text}");
        }
        assert!(!is_auxiliary(&"M8 ".repeat(100)));
    }
}
