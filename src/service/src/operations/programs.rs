//! Programs that clients send. They are read while they arrive ([`receiver`]) and kept in the result store as three
//! blobs of one id: the packed program, the compressed file, and the summary. They count in the limits of the store and
//! may be evicted; then the client sends them again, under the same id.

pub(crate) mod receiver;

use std::io::{BufRead, BufReader};
use std::sync::Arc;

use flate2::read::GzDecoder;
use serde::Deserialize;
use tokio::runtime::Handle;
use verne_program::{Format, Program, line_texts, packed};
use verne_store::{Content, ContentReader};

use crate::operations::blocking_results::BlockingResults;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::programs::receiver::ReceivedProgram;
use crate::operations::results::Results;
use crate::operations::stored_reader::StoredReader;
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::result_id::ResultId;

/// The blob with the packed program.
const PROGRAM: &str = "program";

/// The blob with the file, compressed with gzip.
const SOURCE: &str = "source";

/// The blob with the summary as JSON. It is stored last: whoever finds it expects the others.
const SUMMARY: &str = "program-summary";

/// About the bytes of a summary.
const SUMMARY_BYTES: usize = 2048;

/// A program that the store has.
#[derive(Debug)]
pub(crate) struct StoredProgram {
    /// Its id.
    pub id: ResultId,
    /// Its summary as JSON.
    pub summary: Content,
    /// Whether it was stored now: the store did not have it before.
    pub is_new: bool,
}

/// Stores a program, unless the store has all of it.
///
/// # Errors
///
/// - [`OperationError::ProgramTooLarge`]: the store has no room for it, even if it evicts all else.
/// - [`OperationError::StoreUnavailable`]: the store that all processes share refuses it.
pub(crate) async fn store_program(
    results: &Results,
    received: &ReceivedProgram,
) -> Result<StoredProgram, OperationError> {
    let id = received.id;
    if let Some(summary) = complete_summary(results, id).await {
        return Ok(StoredProgram { id, summary, is_new: false });
    }
    let (received, source) = (received.clone(), received.source.clone());
    let (packed, summary) = run_on_pool(move |_| {
        let summary = received.summary().ok_or(OperationError::Internal)?;
        Ok::<_, OperationError>((pack(&received.program)?, write_json(&summary, SUMMARY_BYTES)?))
    })
    .await?;
    results.put_uncached_blob(id, PROGRAM, packed).await?;
    results.put_uncached_blob(id, SOURCE, source).await?;
    results.put_blob(id, SUMMARY, summary).await?;
    // The store drops what it has no room for without a word.
    let summary = complete_summary(results, id).await.ok_or(OperationError::ProgramTooLarge)?;
    Ok(StoredProgram { id, summary, is_new: true })
}

/// The summary of a stored program as JSON.
///
/// # Errors
///
/// [`OperationError::ProgramNotFound`]
pub(crate) async fn program_summary(results: &Results, id: ResultId) -> Result<Content, OperationError> {
    results.blob(id, SUMMARY).await.ok_or_else(|| unknown(id))
}

/// The file of a stored program, compressed with gzip, and its format.
///
/// # Errors
///
/// [`OperationError::ProgramNotFound`]
pub(crate) async fn program_source(
    results: &Results,
    id: ResultId,
) -> Result<(ContentReader, Format), OperationError> {
    let summary = program_summary(results, id).await?;
    let source = results.find_blob(id, SOURCE).await.ok_or_else(|| unknown(id))?;
    let about: FormatField<'_> =
        serde_json::from_slice(&summary.bytes).map_err(|_| OperationError::Internal)?;
    Ok((source, about.format.parse().map_err(|_| OperationError::Internal)?))
}

/// The format in a summary.
#[derive(Deserialize)]
struct FormatField<'a> {
    format: &'a str,
}

/// A stored program.
///
/// # Errors
///
/// [`OperationError::ProgramNotFound`]
pub(crate) async fn load_program(results: &Results, id: ResultId) -> Result<Arc<Program>, OperationError> {
    let packed = results.find_blob(id, PROGRAM).await.ok_or_else(|| unknown(id))?;
    let packed = StoredReader::new(&packed, Handle::current());
    run_on_pool(move |_| unpack(id, packed)).await
}

/// The same for the threads of the job queue.
pub(crate) fn load_program_in_job(
    results: &BlockingResults,
    id: ResultId,
) -> Result<Arc<Program>, OperationError> {
    unpack(id, results.reader(id, PROGRAM).ok_or_else(|| unknown(id))?)
}

/// The texts of some lines of a stored program, for the threads of the job queue. `numbers` are the lines from 1, in
/// ascending order. Rows have no texts: they may state the lines of another file.
///
/// # Errors
///
/// [`OperationError::ProgramNotFound`]
pub(crate) fn program_lines_in_job(
    results: &BlockingResults,
    id: ResultId,
    numbers: &[u32],
) -> Result<Vec<(u32, String)>, OperationError> {
    let (_, format) = results.runtime.block_on(program_source(&results.results, id))?;
    if matches!(format, Format::Csv | Format::Ndjson | Format::Arrow) {
        return Ok(Vec::new());
    }
    let source = results.reader(id, SOURCE).ok_or_else(|| unknown(id))?;
    line_texts(BufReader::new(GzDecoder::new(source)), numbers).map_err(|error| {
        tracing::warn!(%id, %error, "cannot read the file of a stored program");
        unknown(id)
    })
}

/// The summary, if the store has all parts of the program.
async fn complete_summary(results: &Results, id: ResultId) -> Option<Content> {
    for part in [PROGRAM, SOURCE] {
        results.find_blob(id, part).await?;
    }
    results.blob(id, SUMMARY).await
}

fn pack(program: &Program) -> Result<Vec<u8>, OperationError> {
    let mut packed = Vec::new();
    packed::write(program, &mut packed).map_err(|_| OperationError::Internal)?;
    Ok(packed)
}

/// A blob that cannot be unpacked is damaged; the client replaces it when it sends the program again.
fn unpack(id: ResultId, blob: impl BufRead) -> Result<Arc<Program>, OperationError> {
    match packed::unpack(blob) {
        Ok(program) => Ok(Arc::new(program)),
        Err(error) => {
            tracing::warn!(%id, %error, "cannot read a stored program");
            Err(unknown(id))
        }
    }
}

fn unknown(id: ResultId) -> OperationError {
    OperationError::ProgramNotFound(id.to_string())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use tokio::runtime::Handle;
    use verne_program::{Format, ReadOptions, Row};
    use verne_store::Store;

    use super::receiver::{ProgramReceiver, ReceivedProgram, receive_points};
    use super::{load_program, load_program_in_job, program_lines_in_job, store_program};
    use crate::operations::blocking_results::BlockingResults;
    use crate::operations::results::Results;
    use crate::wire::error::OperationError;

    fn received(format: Format, text: &str) -> ReceivedProgram {
        let mut receiver = ProgramReceiver::new(format, &ReadOptions::default());
        assert!(receiver.push(text.as_bytes()).is_continue());
        receiver.finish().unwrap()
    }

    #[tokio::test(flavor = "multi_thread")]
    async fn handlers_and_jobs_load_what_was_stored() {
        let results = Results::new(Store::in_memory(1 << 20));
        let sent = received(Format::Apt, "UNITS/MM\nGOTO/0,0,300,0,0.6,0.8\nSTOP\nGOTO/10,0,300\n");
        let missing = load_program(&results, sent.id).await.unwrap_err();
        assert_eq!(missing, OperationError::ProgramNotFound(sent.id.to_string()));
        let stored = store_program(&results, &sent).await.unwrap();
        assert!(stored.is_new && !store_program(&results, &sent).await.unwrap().is_new);
        assert_eq!(load_program(&results, sent.id).await.unwrap(), sent.program);
        let in_job = BlockingResults { results, runtime: Handle::current() };
        let work = move || {
            assert_eq!(load_program_in_job(&in_job, sent.id).unwrap(), sent.program);
            assert_eq!(program_lines_in_job(&in_job, sent.id, &[3]).unwrap(), [(3, "STOP".to_owned())]);
        };
        tokio::task::spawn_blocking(work).await.unwrap();
    }

    #[test]
    fn points_of_a_request_are_the_program_of_the_same_rows_in_a_file() {
        let objects = r#"[{"x": 1, "y": 2, "z": 0.1, "phi1": 20, "phi2": 1e3, "feed": 800, "line": 7},
                          {"x": 1.0, "y": 2, "z": 3, "phi1": -0.3, "phi2": 0, "kind": "rapid"},
                          [1.5, 2, 3, 0.1, 17.000000000000004]]"#;
        for text in
            [objects, "[[0, 0, 300], [1e-7, 0, 299.9]]", "[[0, 0, 3, 0, 0.6, 0.8], [9, 0, 3, 0, 0, 1]]"]
        {
            let rows: Vec<Row> = serde_json::from_str(text).unwrap();
            let points = receive_points(&rows, &ReadOptions::default()).unwrap();
            let lines = rows.iter().map(|row| serde_json::to_string(row).unwrap() + "\n");
            let file = received(Format::Ndjson, &lines.collect::<String>());
            assert_eq!((points.id, points.size), (file.id, file.size));
            assert_eq!(points.program, file.program);
        }
    }
}
