//! A checked question about the region of origins of a program.

use crate::operations::toolpath_question::{CheckedToolpath, ToolpathQuestion};
use crate::wire::dexterity::default_cell;
use crate::wire::error::OperationError;
use crate::wire::field_errors::FieldErrors;
use crate::wire::json::write_json;
use crate::wire::origins::{CanonicalOrigins, OriginsFields};
use crate::wire::result_id::ResultId;
use crate::wire::toolpath::{OnLimitName, Setup};

/// Begins the hash of every region. It changes when the bytes of the answer to the same question change.
const HASH_PREFIX: &[u8] = b"verne origins 2";

/// About the bytes of a request.
const REQUEST_BYTES: usize = 1024;

/// About the seconds of one core of a region beside its grid, and of a square cell of its surface.
const SURVEY_COST: f64 = 2.0;
const CELL_COST: f64 = 1.5e-2;

/// The frame of `setup` by its other name.
const FIRST_OFFSET: &str = "G54";

/// A question about a region of origins that has an answer.
#[derive(Clone, Debug)]
pub(crate) struct OriginsQuestion {
    /// The tool path, with its origin at zero.
    pub toolpath: ToolpathQuestion,
    /// Step of the grid, mm.
    pub cell: f64,
    /// The id of the answer.
    pub id: ResultId,
}

/// The checked fields of a region.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CheckedOrigins {
    cell: f64,
}

impl CheckedOrigins {
    /// Checks the fields beside those of the tool path, and those of the tool path that a region does not allow.
    ///
    /// # Errors
    ///
    /// All fields that cannot be used.
    pub(crate) fn new(fields: &OriginsFields, toolpath: &CheckedToolpath) -> Result<Self, OperationError> {
        let mut faults = FieldErrors::default();
        let cell = fields.cell.unwrap_or_else(default_cell);
        faults.cell(cell);
        if toolpath.request.on_limit == OnLimitName::Retract {
            faults.add("/on_limit", "must be fail: the ways off the part are not examined");
        }
        if toolpath.request.offsets.contains_key(FIRST_OFFSET) {
            let detail = "is the frame whose origin the region is for: give it as setup";
            faults.add(format!("/offsets/{FIRST_OFFSET}"), detail);
        }
        faults.into_result()?;
        Ok(Self { cell })
    }

    /// The question about a tool path. The origin of its set-up has no effect.
    pub(crate) fn question(self, toolpath: ToolpathQuestion) -> OriginsQuestion {
        let ToolpathQuestion { machine, mut request, cost, .. } = toolpath;
        request.setup = Setup { x: 0.0, y: 0.0, z: 0.0, ..request.setup };
        OriginsQuestion::of(ToolpathQuestion::of(machine, request, cost), self.cell)
    }
}

impl OriginsQuestion {
    /// The question of a checked request.
    pub(crate) fn of(toolpath: ToolpathQuestion, cell: f64) -> Self {
        let request = CanonicalOrigins { toolpath: toolpath.request.clone(), cell };
        // Writing these fields to memory cannot fail.
        let text = write_json(&request, REQUEST_BYTES).unwrap_or_default();
        let machine = &toolpath.machine;
        let id = ResultId::of_text(HASH_PREFIX, &machine.id, &machine.data().description, &text);
        Self { toolpath, cell, id }
    }

    /// The request with its default values.
    pub(crate) fn request(&self) -> CanonicalOrigins {
        CanonicalOrigins { toolpath: self.toolpath.request.clone(), cell: self.cell }
    }

    /// Estimated work, seconds of one core. The region is about as wide as the machine.
    pub(crate) fn cost(&self) -> f64 {
        let cells = self.toolpath.machine.longest() / self.cell;
        SURVEY_COST + self.toolpath.cost + CELL_COST * cells * cells
    }
}
