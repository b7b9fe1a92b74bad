//! The canonical bytes of a program, for storage and for content ids: equal programs have equal bytes.
//!
//! The bytes are those of [postcard](https://postcard.jamesmunns.com) for a layout mark, the unit, the source of
//! lengths, moves, arcs, events and warnings. They are written and read as a stream.

use std::borrow::Cow;
use std::fmt;
use std::io::{BufRead, Write};

use serde::{Deserialize, Serialize};

use crate::arc::Arc;
use crate::error::Warnings;
use crate::event::Event;
use crate::moves::Move;
use crate::options::Units;
use crate::program::{LengthSource, Program};

/// Identifies the format and its layout.
const LAYOUT: [u8; 8] = *b"verneP02";

/// The longest text, in bytes.
const SCRATCH: usize = 256 << 10;

/// The reason why bytes are not a program.
#[derive(Debug)]
pub enum UnpackError {
    /// The bytes are not a program of this layout, are damaged, or cannot be read.
    Bytes(postcard::Error),
    /// The bytes decode to moves that no reader makes.
    Invalid,
}

impl fmt::Display for UnpackError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bytes(error) => write!(f, "not a packed program: {error}"),
            Self::Invalid => f.write_str("not a packed program: its moves contradict each other"),
        }
    }
}

impl std::error::Error for UnpackError {}

#[derive(Serialize, Deserialize)]
struct Packed<'a> {
    layout: [u8; 8],
    units: Units,
    length_source: LengthSource,
    moves: Cow<'a, [Move]>,
    arcs: Cow<'a, [Arc]>,
    events: Cow<'a, [Event]>,
    warnings: Cow<'a, Warnings>,
}

/// Writes a program in small pieces: about 60 bytes a move. A writer that hashes gives the content id.
///
/// # Errors
///
/// The writer's error.
///
/// ```
/// use verne_program::{Format, ReadOptions, packed, read};
///
/// let program = read(Format::Csv, "x,y,z\n1,2,3\n".as_bytes(), &ReadOptions::default())?;
/// let mut bytes = Vec::new();
/// packed::write(&program, &mut bytes)?;
/// assert_eq!(packed::unpack(bytes.as_slice())?, program);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write(program: &Program, writer: impl Write) -> Result<(), postcard::Error> {
    let packed = Packed {
        layout: LAYOUT,
        units: program.units,
        length_source: program.length_source,
        moves: (&program.moves).into(),
        arcs: (&program.arcs).into(),
        events: (&program.events).into(),
        warnings: Cow::Borrowed(&program.warnings),
    };
    postcard::to_io(&packed, writer).map(drop)
}

/// Reads the program that [`write()`] wrote. Numbers are the same to the last bit.
///
/// # Errors
///
/// - [`UnpackError::Bytes`]: the bytes are not a packed program of this layout, are damaged, or cannot be read.
/// - [`UnpackError::Invalid`]: they decode to moves that no reader makes.
pub fn unpack(reader: impl BufRead) -> Result<Program, UnpackError> {
    let mut scratch = vec![0; SCRATCH];
    let (packed, _): (Packed<'_>, _) =
        postcard::from_io((reader, scratch.as_mut_slice())).map_err(UnpackError::Bytes)?;
    let Packed { layout, units, length_source, moves, arcs, events, warnings } = packed;
    if layout != LAYOUT {
        return Err(UnpackError::Bytes(postcard::Error::DeserializeBadEncoding));
    }
    let program = Program {
        units,
        length_source,
        moves: moves.into_owned(),
        arcs: arcs.into_owned(),
        events: events.into_owned(),
        warnings: warnings.into_owned(),
    };
    if is_valid(&program) { Ok(program) } else { Err(UnpackError::Invalid) }
}

/// Whether the parts fit together: what holds for every program that a reader makes.
fn is_valid(program: &Program) -> bool {
    let mut arcs_used = 0;
    let moves = program.moves.iter().enumerate().all(|(index, one)| {
        let numbered = one.arc_number().is_none_or(|number| {
            arcs_used += 1;
            number.get() == arcs_used && index > 0
        });
        one.is_valid() && numbered
    });
    let arcs = program.arcs.len() == arcs_used as usize && program.arcs.iter().all(Arc::is_valid);
    let last = program.moves.len();
    let events = program.events.iter().all(|event| event.before as usize <= last && event.kind.is_valid())
        && program.events.is_sorted_by_key(|event| event.before);
    moves && arcs && events && last > 0
}
