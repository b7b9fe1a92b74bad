//! `verne atlas`: computes an atlas without a server.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::Value;

use crate::operations::atlas::answer_atlas;
use crate::operations::machine_registry::MachineRegistry;
use crate::process::cli::answer::{machine, with_flags};
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::files::refuse_equal_files;
use crate::process::cli::map_files::format_of;
use crate::process::cli::progress::TerminalProgress;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::atlases;
use crate::wire::atlas_query::{AtlasBody, AtlasQuery};
use crate::wire::format::SliceFormat;
use crate::wire::parse::parse_body;

/// The command.
#[derive(Debug, Args)]
pub(crate) struct AtlasCommand {
    #[command(flatten)]
    query: AtlasQuery,
    /// Write the atlas to this file: .json, .svg or .dxf. Without it, verne prints the answer of the HTTP service.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    format: AnswerFormat,
}

impl AtlasCommand {
    /// Writes the file, or the answer to `out`.
    pub(crate) fn run(self, out: &mut impl Write, terminal: Option<Terminal>) -> Result<(), String> {
        let output = self.output.as_deref();
        let machine_file = Some(Path::new(&self.query.machine)).filter(|path| path.is_file());
        refuse_equal_files(&[("the machine", machine_file)], &[("--output", output)])?;
        // Before the computation: the extension may be unknown.
        let format = output.map(|path| format_of("--output", path, ".json, .svg or .dxf")).transpose()?;
        let machine = machine(&self.query.machine)?;
        let body = AtlasBody { machine, ..self.query.into_body() };
        let progress = TerminalProgress::new();
        let (machines, format) = (MachineRegistry::default(), format.unwrap_or(SliceFormat::Json));
        let bytes = answer_atlas(&body, &machines, format, &progress).map_err(with_flags)?;
        drop(progress);
        if let Some(path) = output {
            return std::fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()));
        }
        let answer: Value = parse_body(&bytes).map_err(with_flags)?;
        self.format.write(&answer, atlases::atlas, out, terminal)
    }
}
