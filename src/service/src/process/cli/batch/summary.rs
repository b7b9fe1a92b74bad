//! The outcomes of a batch in words.

use std::io::{self, Write};

use crate::operations::row_tally::{Reason, RowPlace, RowTally};
use crate::process::cli::limit_words::NamedLimit;
use crate::wire::error::{FieldError, OperationError};

/// Writes how many rows have which outcome, and why the first rows without an answer have none.
pub(super) fn write_summary(tally: &RowTally, err: &mut impl Write) -> io::Result<()> {
    let counts = tally.counts().iter().filter(|(_, count)| *count > 0);
    let counts: Vec<_> = counts.map(|(name, count)| format!("{count} {name}")).collect();
    let rows = tally.rows();
    let noun = if rows == 1 { "row" } else { "rows" };
    let colon = if rows == 0 { "" } else { ": " };
    writeln!(err, "{rows} {noun}{colon}{}.", counts.join(", "))?;
    for row in tally.first() {
        let place = match row.place {
            RowPlace::Line(line) => format!("line {line}"),
            RowPlace::Row(row) => format!("row {row}"),
        };
        match &row.reason {
            Reason::Limit(limit) => writeln!(err, "  {place}: {}", NamedLimit::from(limit).in_words())?,
            Reason::Detail(detail) => writeln!(err, "  {place}: {detail}")?,
        }
    }
    match tally.unanswered() - tally.first().len() as u64 {
        0 => Ok(()),
        1 => writeln!(err, "  and 1 more row."),
        more => writeln!(err, "  and {more} more rows."),
    }
}

/// An error of the rows as a message. Columns are named as they are in the file.
pub(crate) fn message(file: &str, error: OperationError) -> String {
    match error {
        OperationError::Fields(faults) => {
            let fault = |FieldError { pointer, detail }: FieldError| {
                let column = pointer.trim_start_matches("/columns/").replace("~1", "/").replace("~0", "~");
                format!("\n  column {column}: {detail}")
            };
            format!("{file} cannot be used{}", faults.into_iter().map(fault).collect::<String>())
        }
        OperationError::Rows(reason) => format!("{file} cannot be read: {reason}"),
        other => other.to_string(),
    }
}
