//! The text of an answer.

use console::Style;

use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::table::{Table, printable};

/// Text for a terminal.
#[derive(Debug, Default)]
pub(crate) struct Page(Vec<Part>);

#[derive(Debug)]
enum Part {
    Heading(String),
    Table(Table),
    Fields(Table),
    Sentence(String),
}

impl Page {
    /// A page with this first line.
    pub(crate) fn new(heading: impl Into<String>) -> Self {
        Self::default().heading(heading)
    }

    /// Adds a heading.
    pub(crate) fn heading(mut self, heading: impl Into<String>) -> Self {
        self.0.push(Part::Heading(heading.into()));
        self
    }

    /// Adds a table, with a line for each row if the terminal is wide enough.
    pub(crate) fn table(mut self, table: Table) -> Self {
        self.0.push(Part::Table(table));
        self
    }

    /// Adds names with their values, a line for each.
    pub(crate) fn fields<N: Into<String>>(mut self, fields: impl IntoIterator<Item = (N, String)>) -> Self {
        let table =
            fields.into_iter().fold(Table::default(), |table, (name, value)| table.texts(name, [value]));
        self.0.push(Part::Fields(table));
        self
    }

    /// Adds a sentence.
    pub(crate) fn sentence(mut self, sentence: impl Into<String>) -> Self {
        self.0.push(Part::Sentence(sentence.into()));
        self
    }

    /// The lines.
    pub(crate) fn text(&self, terminal: Terminal) -> String {
        let bold = Style::new().bold().force_styling(terminal.colours);
        let part = |part: &Part| match part {
            Part::Heading(heading) => format!("{}\n", bold.apply_to(printable(heading))),
            Part::Table(table) => table.text(terminal),
            Part::Fields(fields) => fields.as_fields(terminal.colours),
            Part::Sentence(sentence) => format!("{}\n", printable(sentence)),
        };
        self.0.iter().map(part).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Page;
    use crate::process::cli::terminal::Terminal;

    #[test]
    fn a_page_has_no_escape_sequences_of_an_answer() {
        let page = Page::new("a\u{1b}[31m").fields([("name", "b\u{7}\nc".to_owned())]).sentence("d\re");
        let text = page.text(Terminal { width: 80, colours: false });
        assert_eq!(text, "a\\u{1b}[31m\n  name  b\\u{7}\\nc\nd\\re\n");
    }
}
