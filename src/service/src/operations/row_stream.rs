//! A batch whose rows come in columns: it is answered chunk by chunk, while further rows arrive.

use verne_rows::{Chunk, Column, Format, ReadError, Reader, Writer};
use verne_solver::workspace::Observer;

use crate::operations::column_rows::pointer;
use crate::operations::machine_registry::IdentifiedMachine;
use crate::operations::outcome_columns::write_error;
use crate::operations::row_tally::RowTally;
use crate::wire::error::{FieldError, OperationError};

/// Answers the rows of a batch, chunk by chunk.
pub(crate) trait RowAnswer: Send {
    /// The names of the columns of numbers.
    fn numbers(&self) -> &'static [&'static str];

    /// Checks which columns there are. Called once, before the first rows.
    fn begin(&mut self, columns: &[Column]) -> Result<(), OperationError>;

    /// The columns of the answer to the next rows.
    fn answer(&mut self, chunk: &Chunk, observer: &dyn Observer) -> Result<Vec<Column>, OperationError>;

    /// The outcomes of all rows so far.
    fn tally(&self) -> &RowTally;

    /// The machine.
    fn machine(&self) -> &IdentifiedMachine;
}

/// The rows of a batch and their answers, as bytes.
pub(crate) struct RowStream {
    answer: Box<dyn RowAnswer>,
    reader: Reader,
    format: Format,
    writer: Stage,
    ended: bool,
    /// Rows that are answered.
    rows: usize,
}

/// The writer of the answer.
enum Stage {
    /// The columns are not known.
    Beginning,
    Writing(Box<Writer>),
    Finished,
}

impl RowStream {
    /// Reads rows in one format and answers them in another. `message_bytes` is the greatest size of a message of
    /// Arrow.
    pub(crate) fn new(answer: Box<dyn RowAnswer>, from: Format, to: Format, message_bytes: usize) -> Self {
        let reader = Reader::new(from, answer.numbers(), message_bytes);
        Self { answer, reader, format: to, writer: Stage::Beginning, ended: false, rows: 0 }
    }

    /// Takes the next bytes of the request. Take no more before [`next`](Self::next) returns `None`.
    pub(crate) fn push(&mut self, bytes: &[u8]) {
        self.reader.push(bytes);
    }

    /// No bytes follow.
    pub(crate) fn end(&mut self) {
        self.reader.end();
        self.ended = true;
    }

    /// The next bytes of the answer. `None` before more bytes of the request arrive, and after the end. Call it on the
    /// compute pool.
    pub(crate) fn next(&mut self, observer: &dyn Observer) -> Result<Option<Vec<u8>>, OperationError> {
        let chunk = self.reader.next_chunk().map_err(read_error)?;
        if matches!(self.writer, Stage::Beginning)
            && let Some(columns) = self.reader.columns()
        {
            self.answer.begin(&columns)?;
            let columns = self.answered(&Chunk::without_rows(columns), observer)?;
            self.writer = Stage::Writing(Box::new(Writer::new(self.format, &columns).map_err(write_error)?));
        }
        if let Some(chunk) = chunk {
            let columns = self.answered(&chunk, observer)?;
            self.rows += chunk.rows();
            let Stage::Writing(writer) = &mut self.writer else { return Err(OperationError::Internal) };
            return writer.write(&columns).map(Some).map_err(write_error);
        }
        if !self.ended {
            return Ok(None);
        }
        let Stage::Writing(writer) = std::mem::replace(&mut self.writer, Stage::Finished) else {
            return Ok(None);
        };
        let rest = writer.finish().map_err(write_error)?;
        Ok(Some(rest).filter(|bytes| !bytes.is_empty()))
    }

    /// How many rows are answered since the last call.
    pub(crate) fn take_rows(&mut self) -> usize {
        std::mem::take(&mut self.rows)
    }

    /// The outcomes of all rows so far.
    pub(crate) fn tally(&self) -> &RowTally {
        self.answer.tally()
    }

    /// The columns that the answer passes on, and those of the answer. A column of the answer replaces an equal-named
    /// one: the answer of one batch can be the body of another.
    fn answered(&mut self, chunk: &Chunk, observer: &dyn Observer) -> Result<Vec<Column>, OperationError> {
        let numbers = self.answer.numbers();
        let answered = self.answer.answer(chunk, observer)?;
        let is_replaced = |name: &str| answered.iter().any(|column| column.name() == name);
        let extra = chunk.columns().iter().map(|column| (column.name(), column));
        let extra = extra.filter(|(name, _)| !numbers.contains(name) && !is_replaced(name));
        let mut columns: Vec<_> = extra.map(|(_, column)| column.clone()).collect();
        columns.extend(answered);
        Ok(columns)
    }
}

/// The error of rows that cannot be read.
pub(crate) fn read_error(error: ReadError) -> OperationError {
    match error {
        ReadError::Column { name, detail } => {
            OperationError::Fields(vec![FieldError::new(pointer(&name), detail)])
        }
        ReadError::Malformed(reason) => OperationError::Rows(reason),
    }
}
