//! Readers for tool path programs. Every format becomes one list of moves with source lines: a [`Program`].
//!
//! The crate reads what a file states. It knows no machine, no solver and no HTTP: set-up, offsets and tool lengths are
//! applied by those who plan the motion. Lengths are millimetres, angles radians, in the program's own frame. The tool
//! axis is a unit vector from the tip to the holder.
//!
//! A [`Reader`] takes chunks of bytes, [`read`] takes a [`BufRead`](std::io::BufRead). Both read line by line: beside
//! the program itself they hold one statement of at most 64 KiB. Nothing panics, and no number of a program is a NaN.
//!
//! ```
//! use verne_program::{Format, MoveKind, ReadOptions, read};
//!
//! let text = "UNITS/MM\nRAPID\nGOTO/0,0,320\nFEDRAT/1000,MMPM\nGOTO/0,0,300,0,-3,4\nFINI\n";
//! let program = read(Format::Apt, text.as_bytes(), &ReadOptions::default())?;
//! let last = program.moves()[1];
//! assert_eq!((last.line(), last.kind(), last.tip()), (5, MoveKind::Feed, [0.0, 0.0, 300.0]));
//! assert_eq!(last.axis(), [0.0, -0.6, 0.8]);
//! # Ok::<(), verne_program::ReadError>(())
//! ```
//!
//! G-code states points in the part under control of the tool centre point. [`ReadOptions`] say what the file does not:
//!
//! ```
//! use verne_program::{Format, Orientation, ReadOptions, read};
//!
//! let options = ReadOptions { tcp_on: vec!["M428".parse()?], ..ReadOptions::default() };
//! let text = "G21 G90\nM428 (TCP on)\nG0 X0 Y0 Z320 A0 C0\nG1 X10 A30 C-400 F1000\nM30\n";
//! let program = read(Format::Gcode, text.as_bytes(), &options)?;
//! let last = program.moves()[1];
//! let (phi1, phi2) = (30_f64.to_radians(), (-400_f64).to_radians());
//! assert_eq!((last.tip(), last.orientation()), ([10.0, 0.0, 320.0], Orientation::Rotary { phi1, phi2 }));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A program says what a planner needs about lengths and origins by its events, in their places:
//!
//! - [`LengthSource::Tool`] (CL text): [`EventKind::Tool`] loads a tool, and its length counts from there.
//!   [`LengthSource::Offset`] (G-code): a tool that is loaded changes no length; [`EventKind::LengthOffset`] does. Its
//!   `number` is the entry of the table of lengths. Without a number, and before the first such event, no length is in
//!   force.
//! - [`EventKind::WorkOffset`] names the origin of the points that follow. Before the first one it is that of G54.
//! - [`EventKind::CentrePointControl`] and [`EventKind::TiltedPlane`] change nothing about the points of moves. They
//!   interrupt a cut.
//! - After [`EventKind::Home`] the position of the tool is not known. After [`EventKind::WorkOffset`] it is known, but
//!   in the frame of the origin before. The next move has no start in either case.
//!
//! A fault names its line, column and word, and what would be accepted:
//!
//! ```
//! use verne_program::{Format, ReadError, ReadOptions, read};
//!
//! let text = "UNITS/MM\nGOTO/0,0\n";
//! let outcome = read(Format::Apt, text.as_bytes(), &ReadOptions::default());
//! let Err(ReadError::Program(refused)) = outcome else { panic!() };
//! let error = &refused.errors[0];
//! assert_eq!((error.line, error.column, error.word.as_str()), (2, 1, "GOTO"));
//! assert!(error.detail.contains("3 or 6 numbers"));
//! ```

mod apt;
mod arc;
mod builder;
mod code;
mod diagnostics;
mod drilling;
mod error;
mod event;
mod format;
mod gcode;
pub mod joint_program;
mod lines;
mod moves;
mod numerals;
mod options;
mod orientation;
pub mod packed;
mod program;
mod reader;
mod rows;
mod work_offset;

pub use arc::Arc;
pub use code::Code;
pub use error::{ProgramError, ProgramErrors, ReadError, Warning, Warnings};
pub use event::{Coolant, Dwell, Event, EventKind, Rotation, Spindle};
pub use format::{Format, FormatError};
pub use lines::{LONGEST_LINE, line_texts};
pub use moves::{Feed, FeedUnit, Move, MoveKind};
pub use options::{Compensation, ReadOptions, RotarySense, Units};
pub use orientation::Orientation;
pub use program::{Bounds, LengthSource, Program, Segment, Step, Steps, Tool};
pub use reader::{Reader, read};
pub use rows::points::read_points;
pub use rows::row::{Row, RowOrientation};
pub use work_offset::WorkOffset;
