//! The tip's path as coloured lines in a GLB.

use serde_json::json;
use verne_mesh::glb::{self, Options, Up};
use verne_mesh::{ColourScale, PathBuilder, Stroke, Swatch};

use crate::operations::toolpath_question::ToolpathQuestion;
use crate::operations::toolpath_rows::read_chunk;
use crate::wire::error::OperationError;
use crate::wire::toolpath_path::PathQuery;

/// Most points of a file: some 8 MB. A longer path is thinned.
const MOST_POINTS: u64 = 250_000;

/// Bytes of a point in the file.
const POINT_BYTES: usize = 28;

/// Colour of rapids, sRGB.
const RAPID: [u8; 3] = [140, 140, 140];

/// The path of a tool path's rows, which come chunk by chunk.
pub(crate) struct ToolpathLines {
    builder: PathBuilder,
    rows: u64,
    /// Whether no row came yet.
    is_empty: bool,
}

impl ToolpathLines {
    /// The path of so many rows.
    pub(crate) fn new(rows: u64) -> Self {
        Self { builder: PathBuilder::new(rows, MOST_POINTS), rows, is_empty: true }
    }

    /// Adds the rows of a chunk.
    pub(crate) fn add(&mut self, question: &ToolpathQuestion, chunk: &[u8]) -> Result<(), OperationError> {
        for row in read_chunk(chunk) {
            let row = row?;
            let stroke = if self.is_empty {
                Stroke::None
            } else if row.kind.is_cut() {
                Stroke::Coloured
            } else {
                Stroke::Plain
            };
            self.is_empty = false;
            // Beyond its range, a margin has the colour of the end.
            let fraction = row.margin.fraction(&question.machine).clamp(-1.0, 1.0);
            let pushed = self.builder.push(row.position.tip, fraction, stroke);
            pushed.map_err(|_| OperationError::Internal)?;
        }
        Ok(())
    }

    /// The file.
    pub(crate) fn write(
        self,
        question: &ToolpathQuestion,
        colours: PathQuery,
    ) -> Result<Vec<u8>, OperationError> {
        let PathQuery { least, greatest } = colours;
        let rapid = Swatch { name: "rapid".to_owned(), rgb: RAPID };
        let path = self.builder.finish("feed".to_owned(), rapid, ColourScale { least, greatest });
        let machine = &question.machine.id;
        let extras = json!({
            "unit": "m",
            "frame": "part",
            "kind": "toolpath",
            "machine": { "name": machine.name, "hash": machine.hash },
            "id": question.id,
            "program": question.request.program,
            "solver": concat!("verne ", env!("CARGO_PKG_VERSION")),
            "rows": self.rows,
            "rows_per_point": path.points_per_vertex(),
            "colours": { "value": "worst margin / range of its constraint", "yellow": least, "blue": greatest },
        });
        let name = format!("tool path of {}", machine.name);
        let mut file = Vec::with_capacity(POINT_BYTES * path.points().len());
        glb::write_path(&path, &Options { name, up: Up::PositiveZ, extras }, &mut file)
            .map_err(|_| OperationError::Internal)?;
        Ok(file)
    }
}
