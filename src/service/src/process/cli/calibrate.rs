//! `verne calibrate`: the parameters of a machine from measurements in a file.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::Value;
use verne_rows::Format;

use crate::operations::calibration::{MOST_MEASUREMENTS, calibration_answer};
use crate::operations::calibration_table::CalibrationTable;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::observers::ObserverFns;
use crate::process::cli::answer::{machine, to_json, with_flags};
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::batch::summary::message;
use crate::process::cli::batch::{format_of, format_parser};
use crate::process::cli::files::{destination, is_standard, name_of, refuse_equal_files, source};
use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::calibration;
use crate::wire::calibration_query::CalibrationQuery;

/// Most bytes of a file: some hundred for each measurement and its extra columns, and the header.
const MOST_BYTES: u64 = 64 * 1024 * 1024;

/// The command.
#[derive(Debug, Args)]
pub(crate) struct CalibrateCommand {
    /// The measurements, a table with named columns: .csv, .ndjson, .jsonl or .arrow (the streaming format); `-` is
    /// standard input.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Format of standard input. Default: csv.
    #[arg(long = "format", value_parser = format_parser())]
    from: Option<Format>,
    #[command(flatten)]
    query: CalibrationQuery,
    /// Write the machine to this file, which every --machine accepts; `-` writes it to standard output instead of the
    /// answer.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    format: AnswerFormat,
}

impl CalibrateCommand {
    /// Writes the answer to `out`, which may be a terminal, and the machine to a file.
    pub(crate) fn run(self, out: &mut impl Write, terminal: Option<Terminal>) -> Result<(), String> {
        let Self { file, from, query, output, format } = self;
        let machine_file = Some(Path::new(&query.machine)).filter(|path| path.is_file());
        refuse_equal_files(
            &[("the measurements", Some(&*file)), ("the machine", machine_file)],
            &[("--output", output.as_deref())],
        )?;
        let from = format_of("FILE", &file, from)?;
        let start = machine(&query.machine)?;
        let table = CalibrationTable::new(&query.into_request(start), &MachineRegistry::default());
        let table = table.map_err(with_flags)?;
        let name = name_of(&file);
        let unreadable = |error| format!("{name}: {error}");
        let mut body = Vec::new();
        source(&file)?.take(MOST_BYTES + 1).read_to_end(&mut body).map_err(unreadable)?;
        if body.len() as u64 > MOST_BYTES {
            return Err(format!("{name} has more than {MOST_BYTES} bytes"));
        }
        let faults = |error| message(&name, error);
        let question = table.read(from, &body, MOST_MEASUREMENTS).map_err(faults)?;
        let observer = ObserverFns { progress: |_| (), cancelled: || false };
        let answer = calibration_answer(&question, &observer).map_err(faults)?;
        if let Some(path) = &output {
            let text = to_json(&answer.machine, true)? + "\n";
            let mut destination = destination(path, out)?;
            let written = destination.write_all(text.as_bytes()).and_then(|()| destination.flush());
            written.map_err(|error| format!("cannot write {}: {error}", path.display()))?;
            if is_standard(path) {
                return Ok(());
            }
        }
        let answer: Value = serde_json::to_value(&answer).map_err(|error| error.to_string())?;
        format.write(&answer, calibration::calibration, out, terminal)
    }
}
