//! The files of maps: their formats, and the points of the grid.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use clap::ValueEnum;

use crate::operations::map_table::MapTable;
use crate::operations::question_text::QuestionKind;
use crate::process::cli::answer::with_flags;
use crate::wire::row_format::RowFormat;

/// The format that the extension of a file names.
pub(crate) fn format_of<F: ValueEnum>(flag: &str, path: &Path, known: &str) -> Result<F, String> {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    F::from_str(extension, true).map_err(|_| format!("{flag} {} must end in {known}", path.display()))
}

/// Writes the points of a map of this kind, which are JSON, to a file in a format.
pub(crate) fn write_cells(
    kind: QuestionKind,
    cells: &[u8],
    format: RowFormat,
    path: &Path,
) -> Result<(), String> {
    let unwritable = |error: std::io::Error| format!("{}: {error}", path.display());
    let Some(format) = format.columns() else {
        return std::fs::write(path, cells).map_err(unwritable);
    };
    let mut table = MapTable::new(kind, cells, format).map_err(with_flags)?;
    let mut file = BufWriter::new(File::create(path).map_err(unwritable)?);
    while let Some(piece) = table.next().map_err(with_flags)? {
        file.write_all(&piece).map_err(unwritable)?;
    }
    file.flush().map_err(unwritable)
}
