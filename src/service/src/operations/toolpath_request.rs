//! Reads a request for a tool path: its options are checked, and its program is found or received.

use verne_program::Format;

use crate::operations::machine_registry::MachineRegistry;
use crate::operations::programs::receiver::{ReceivedProgram, receive_points};
use crate::operations::toolpath_question::CheckedToolpath;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::parse::parse_body;
use crate::wire::program_query::ProgramQuery;
use crate::wire::result_id::ResultId;
use crate::wire::toolpath::{ProgramRef, ToolpathRequest};

/// Where the program of a request is.
pub(crate) enum ProgramSource {
    /// In the store.
    Stored(ResultId),
    /// In the request.
    Received(Box<ReceivedProgram>),
}

impl ProgramSource {
    /// The id of the program.
    pub(crate) fn id(&self) -> ResultId {
        match self {
            Self::Stored(id) => *id,
            Self::Received(received) => received.id,
        }
    }
}

/// Reads a request in JSON. It reads the program, too, if the body contains its points: call it on the compute pool.
pub(crate) fn read_request(
    body: &[u8],
    machines: &MachineRegistry,
) -> Result<(CheckedToolpath, ProgramSource), OperationError> {
    read_fields(&parse_body(body)?, machines)
}

/// Checks a request, and reads its program if it contains the points: call it on the compute pool.
pub(crate) fn read_fields(
    request: &ToolpathRequest,
    machines: &MachineRegistry,
) -> Result<(CheckedToolpath, ProgramSource), OperationError> {
    let fault = |pointer: &str, detail: &str| OperationError::Fields(vec![FieldError::new(pointer, detail)]);
    let source = match &request.program {
        None => {
            return Err(OperationError::Fields(vec![FieldError::missing("/program".to_owned(), "program")]));
        }
        Some(ProgramRef::Id(_)) if request.units.is_some() => {
            return Err(fault("/units", "is allowed only with points: a stored program has its unit"));
        }
        Some(ProgramRef::Id(id)) => {
            let id = id.parse().map_err(|_| {
                fault("/program", "must be the id from an answer of /programs: 64 hexadecimal digits")
            })?;
            ProgramSource::Stored(id)
        }
        Some(ProgramRef::Points(points)) => {
            let reading = ProgramQuery { units: request.units, ..ProgramQuery::default() };
            let options = reading.options(Format::Ndjson)?;
            ProgramSource::Received(Box::new(receive_points(&points.points, &options)?))
        }
    };
    Ok((CheckedToolpath::new(request, machines)?, source))
}
