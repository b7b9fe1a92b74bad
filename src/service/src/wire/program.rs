//! The answer of `/programs`, and the faults of programs.

use serde::Serialize;
use utoipa::ToSchema;
use verne_program::{Bounds, Format, Program, ProgramError, Tool, Units, Warning};

use crate::wire::fixed_array::FixedArray;
use crate::wire::result_id::ResultId;
use crate::wire::workspace_summary::BoundsObject;

/// A fault of a program.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct ProgramFault {
    /// Line of the file, from 1; for rows of a request the number of the row.
    pub line: u32,
    /// Byte of the line where the word begins, from 1.
    pub column: u32,
    /// The word at fault; empty if the line as a whole is.
    pub word: String,
    /// The fault, and what would be accepted.
    pub detail: String,
}

/// A program that the service keeps.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct ProgramSummary {
    /// BLAKE3 hash of the file, its format, the options for reading, and the version and the target of the binary.
    /// Equal programs have equal ids.
    #[schema(value_type = String)]
    pub id: ResultId,
    /// The format of the file.
    #[schema(value_type = String, example = "apt")]
    pub format: &'static str,
    /// The unit of the file. All lengths in answers are mm.
    #[schema(value_type = String, example = "mm")]
    pub units: Units,
    /// Bytes of the file, after decoding.
    pub bytes: u64,
    /// Lines of the file.
    pub lines: u32,
    /// Moves of the program. Cycles count with the moves of their holes; moves without length and turning are left out.
    pub moves: usize,
    /// Events: what the program states beside its moves.
    pub events: usize,
    /// The tools in the order of their first use.
    pub tools: Vec<ToolObject>,
    /// Box around the tip's path in the frame of the program, mm. Helices are taken without their pitch.
    pub bounds: BoundsObject,
    /// Places where the reader did otherwise than the file may mean: at most 100 different warnings.
    pub warnings: Vec<WarningObject>,
    /// The number of lines with warnings, also of those that the list leaves out.
    pub warning_count: u64,
    /// Paths of the program.
    pub links: ProgramLinks,
}

/// A tool that a program loads.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[schema(as = ProgramTool)]
pub(crate) struct ToolObject {
    /// Its number; null if the program states none.
    pub number: Option<u32>,
    /// Its length, mm; null if the program states none.
    pub length: Option<f64>,
    /// The line that loads it first.
    pub line: u32,
}

/// Something in a program that its author should know.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = ProgramWarning)]
pub(crate) struct WarningObject {
    /// The first line that it concerns.
    pub line: u32,
    /// The word that it concerns; empty if the line as a whole.
    pub word: String,
    /// The reader's action.
    pub detail: String,
    /// How many lines it concerns.
    pub occurrences: u32,
}

/// Paths of a program.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct ProgramLinks {
    /// This summary.
    #[serde(rename = "self")]
    pub itself: String,
    /// The file as it was sent.
    pub source: String,
}

/// The size of a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct FileSize {
    /// Its bytes.
    pub bytes: u64,
    /// Its lines.
    pub lines: u32,
}

impl ProgramSummary {
    /// The summary of a program that was read from a file of this format and size.
    pub(crate) fn new(id: ResultId, format: Format, size: FileSize, program: &Program) -> Option<Self> {
        let warnings = program.warnings();
        Some(Self {
            id,
            format: format.name(),
            units: program.units(),
            bytes: size.bytes,
            lines: size.lines,
            moves: program.moves().len(),
            events: program.events().len(),
            tools: program.tools().into_iter().map(ToolObject::from).collect(),
            bounds: program.bounds()?.into(),
            warnings: warnings.list.iter().cloned().map(WarningObject::from).collect(),
            warning_count: warnings.total,
            links: ProgramLinks { itself: program_path(id), source: source_path(id) },
        })
    }
}

/// The path of a program.
pub(crate) fn program_path(id: ResultId) -> String {
    format!("/programs/{id}")
}

/// The path of the file of a program.
pub(crate) fn source_path(id: ResultId) -> String {
    format!("/programs/{id}/source")
}

impl From<ProgramError> for ProgramFault {
    fn from(error: ProgramError) -> Self {
        let ProgramError { line, column, word, detail } = error;
        Self { line, column, word, detail }
    }
}

impl From<Tool> for ToolObject {
    fn from(tool: Tool) -> Self {
        let Tool { number, length, line } = tool;
        Self { number, length, line }
    }
}

impl From<Warning> for WarningObject {
    fn from(warning: Warning) -> Self {
        let Warning { line, word, detail, occurrences } = warning;
        Self { line, word, detail, occurrences }
    }
}

impl From<Bounds> for BoundsObject {
    fn from(bounds: Bounds) -> Self {
        Self { min: FixedArray(bounds.min), max: FixedArray(bounds.max) }
    }
}
