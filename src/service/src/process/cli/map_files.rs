//! The files of maps: a mesh, and the points of the grid.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use clap::ValueEnum;
use verne_mesh::Mesh;

use crate::operations::map_table::MapTable;
use crate::operations::mesh_files::{MeshDescription, write_mesh};
use crate::operations::question_text::QuestionKind;
use crate::process::cli::answer::with_flags;
use crate::process::cli::files::refuse_equal_files;
use crate::wire::format::MeshFormat;
use crate::wire::row_format::RowFormat;

/// The files that the options --output and --cells name, with their formats.
pub(crate) struct MapFiles<'a> {
    mesh: Option<(&'a Path, MeshFormat)>,
    cells: Option<(&'a Path, RowFormat)>,
}

impl<'a> MapFiles<'a> {
    /// Checks the names. Call it before the computation: an extension may be unknown.
    pub(crate) fn new(
        machine: &str,
        output: Option<&'a Path>,
        cells: Option<&'a Path>,
    ) -> Result<Self, String> {
        let machine_file = Some(Path::new(machine)).filter(|path| path.is_file());
        refuse_equal_files(&[("the machine", machine_file)], &[("--output", output), ("--cells", cells)])?;
        let mesh = output
            .map(|path| Ok::<_, String>((path, format_of("--output", path, ".glb, .stl, .ply or .json")?)))
            .transpose()?;
        let cells = cells
            .map(|path| {
                Ok::<_, String>((path, format_of("--cells", path, ".json, .csv, .ndjson or .arrow")?))
            })
            .transpose()?;
        Ok(Self { mesh, cells })
    }

    /// Writes the mesh.
    pub(crate) fn write_mesh(&self, description: &MeshDescription<'_>, mesh: &Mesh) -> Result<(), String> {
        let Some((path, format)) = self.mesh else { return Ok(()) };
        let file = write_mesh(description, mesh, format).map_err(with_flags)?;
        std::fs::write(path, file).map_err(|error| format!("{}: {error}", path.display()))
    }

    /// Writes the points of a map of this kind, which are JSON.
    pub(crate) fn write_cells(&self, kind: QuestionKind, cells: &[u8]) -> Result<(), String> {
        self.cells.map_or(Ok(()), |(path, format)| write_cells(kind, cells, format, path))
    }
}

/// The format that the extension of a file names.
pub(crate) fn format_of<F: ValueEnum>(flag: &str, path: &Path, known: &str) -> Result<F, String> {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    F::from_str(extension, true).map_err(|_| format!("{flag} {} must end in {known}", path.display()))
}

/// Writes the points of a map of this kind, which are JSON, to a file in a format.
fn write_cells(kind: QuestionKind, cells: &[u8], format: RowFormat, path: &Path) -> Result<(), String> {
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
