//! Tables in a terminal.

use console::{Alignment, Style, measure_text_width, pad_str};

use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::values::decimal;

/// Columns of the terminal before a line, and between two columns of a table.
const GAP: usize = 2;

/// Columns with names. A column whose cells are all empty is not shown.
#[derive(Debug, Default)]
pub(crate) struct Table(Vec<Column>);

#[derive(Debug)]
struct Column {
    name: String,
    alignment: Alignment,
    cells: Vec<String>,
}

impl Table {
    /// Adds a column of texts.
    pub(crate) fn texts(
        self,
        name: impl Into<String>,
        cells: impl IntoIterator<Item = impl AsRef<str>>,
    ) -> Self {
        let cells = cells.into_iter().map(|cell| printable(cell.as_ref())).collect();
        self.column(&name.into(), Alignment::Left, cells)
    }

    /// Adds a column of numbers, aligned at the decimal point.
    pub(crate) fn numbers(self, name: &str, cells: impl IntoIterator<Item = Option<f64>>) -> Self {
        let cells = cells.into_iter().map(|cell| cell.map(decimal).unwrap_or_default()).collect();
        self.column(name, Alignment::Right, cells)
    }

    fn column(mut self, name: &str, alignment: Alignment, cells: Vec<String>) -> Self {
        if cells.iter().any(|cell| !cell.is_empty()) {
            self.0.push(Column { name: printable(name), alignment, cells });
        }
        self
    }

    /// A line for each row below a line of names; on a terminal that is too narrow for that, a line for each field.
    pub(crate) fn text(&self, terminal: Terminal) -> String {
        let total: usize = self.0.iter().map(|column| GAP + column.width()).sum();
        if total > terminal.width {
            return self.as_fields(terminal.colours);
        }
        let bold = Style::new().bold().force_styling(terminal.colours);
        let names = self.0.iter().map(|column| bold.apply_to(column.padded(&column.name)).to_string());
        let mut lines = vec![joined(names)];
        for row in 0..self.rows() {
            let cells = self.0.iter().map(|column| styled(column.padded(column.cell(row)), terminal.colours));
            lines.push(joined(cells));
        }
        lines.concat()
    }

    /// A line for each field, with an empty line between two rows.
    pub(crate) fn as_fields(&self, colours: bool) -> String {
        let width = self.0.iter().map(|column| measure_text_width(&column.name)).max().unwrap_or_default();
        let rows = (0..self.rows()).map(|row| {
            let shown = self.0.iter().filter(|column| !column.cell(row).is_empty());
            let lines = shown.map(|column| {
                let name = pad_str(&column.name, width, Alignment::Left, None).into_owned();
                joined([name, styled(column.cell(row).to_owned(), colours)].into_iter())
            });
            lines.collect::<String>()
        });
        rows.collect::<Vec<_>>().join("\n")
    }

    fn rows(&self) -> usize {
        self.0.iter().map(|column| column.cells.len()).max().unwrap_or_default()
    }
}

impl Column {
    fn width(&self) -> usize {
        let cells = self.cells.iter().map(|cell| measure_text_width(cell));
        cells.chain([measure_text_width(&self.name)]).max().unwrap_or_default()
    }

    fn cell(&self, row: usize) -> &str {
        self.cells.get(row).map(String::as_str).unwrap_or_default()
    }

    fn padded(&self, text: &str) -> String {
        pad_str(text, self.width(), self.alignment, None).into_owned()
    }
}

/// A line without spaces at its end.
fn joined(cells: impl Iterator<Item = String>) -> String {
    let gap = " ".repeat(GAP);
    let line = cells.fold(String::new(), |line, cell| line + &gap + &cell);
    format!("{}\n", line.trim_end())
}

/// Green for what is good, red for what is not.
fn styled(cell: String, colours: bool) -> String {
    let style = match cell.trim() {
        "feasible" | "succeeded" => Style::new().green(),
        "infeasible" | "not working" | "failed" => Style::new().red(),
        _ => return cell,
    };
    style.force_styling(colours).apply_to(cell).to_string()
}

/// A text whose control characters do nothing to a terminal: names may come from other people's files.
pub(crate) fn printable(text: &str) -> String {
    let escaped = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.to_string() };
    text.chars().map(escaped).collect()
}

#[cfg(test)]
mod tests {
    use super::Table;
    use crate::process::cli::terminal::Terminal;

    fn table() -> Table {
        Table::default()
            .texts("#", ["1", "2"])
            .numbers("rho1", [Some(449.4342), Some(-5.0)])
            .numbers("theta1", [None, None])
            .texts("state", ["feasible", "infeasible"])
            .texts("limit", ["é 1", ""])
    }

    #[test]
    fn rows_are_lines_if_they_fit() {
        let text = table().text(Terminal { width: 40, colours: false });
        let expected =
            "  #     rho1  state       limit\n  1  449.434  feasible    é 1\n  2   -5.000  infeasible\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn fields_are_lines_in_a_narrow_terminal() {
        let text = table().text(Terminal { width: 20, colours: false });
        let row = "  rho1   449.434\n  state  feasible\n  limit  é 1\n";
        assert!(text.contains(row) && text.ends_with("\n  rho1   -5.000\n  state  infeasible\n"), "{text}");
    }

    #[test]
    fn colours_are_there_if_they_are_wanted() {
        let text = |colours| table().text(Terminal { width: 80, colours });
        assert!(text(true).contains("\u{1b}[32mfeasible") && !text(false).contains('\u{1b}'));
    }
}
