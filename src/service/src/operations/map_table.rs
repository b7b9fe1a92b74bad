//! The points of a map as a table.

use verne_rows::Format;

use crate::operations::dexterity_table::DexterityTable;
use crate::operations::error_map_table::ErrorTable;
use crate::operations::question_text::QuestionKind;
use crate::wire::error::OperationError;

/// Writes the table of a map, piece by piece.
pub(crate) enum MapTable {
    /// Of a dexterity map.
    Dexterity(DexterityTable),
    /// Of an error map.
    Errors(ErrorTable),
}

impl MapTable {
    /// A table of the stored points of a map. Call it on the compute pool.
    pub(crate) fn new(kind: QuestionKind, stored: &[u8], format: Format) -> Result<Self, OperationError> {
        match kind {
            QuestionKind::ErrorMap => ErrorTable::new(stored, format).map(Self::Errors),
            _ => DexterityTable::new(stored, format).map(Self::Dexterity),
        }
    }

    /// The next bytes; `None` at the end. Call it on the compute pool.
    pub(crate) fn next(&mut self) -> Result<Option<Vec<u8>>, OperationError> {
        match self {
            Self::Dexterity(table) => table.next(),
            Self::Errors(table) => table.next(),
        }
    }
}
