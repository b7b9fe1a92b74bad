//! `verne completions` and `verne man`: the command line for shells and as manual pages.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args, Command, ValueEnum};
use clap_complete::aot::{Bash, Fish, PowerShell, Zsh, generate};
use clap_mangen::Man;

/// The shell.
#[derive(Debug, Args)]
pub(crate) struct CompletionsCommand {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

/// A shell.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Shell {
    /// Bash.
    Bash,
    /// Zsh.
    Zsh,
    /// Fish.
    Fish,
    /// PowerShell.
    #[value(name = "powershell")]
    Power,
}

impl CompletionsCommand {
    /// Writes the script for the shell.
    pub(crate) fn run(&self, mut command: Command, out: &mut impl Write) -> Result<(), String> {
        // The generators panic if they cannot write, so they write to memory.
        let mut script = Vec::new();
        match self.shell {
            Shell::Bash => generate(Bash, &mut command, "verne", &mut script),
            Shell::Zsh => generate(Zsh, &mut command, "verne", &mut script),
            Shell::Fish => generate(Fish, &mut command, "verne", &mut script),
            Shell::Power => generate(PowerShell, &mut command, "verne", &mut script),
        }
        out.write_all(&script).map_err(|error| format!("cannot write the completions: {error}"))
    }
}

/// The pages.
#[derive(Debug, Args)]
pub(crate) struct ManCommand {
    /// Write the pages of all commands to this directory: verne.1, verne-ik.1 and so on. Without it, verne prints the
    /// page of `verne` itself.
    #[arg(value_name = "DIRECTORY")]
    directory: Option<PathBuf>,
}

impl ManCommand {
    /// Writes the pages.
    pub(crate) fn run(&self, command: Command, out: &mut impl Write) -> Result<(), String> {
        let written = match &self.directory {
            Some(directory) => {
                let created = std::fs::create_dir_all(directory);
                created.and_then(|()| clap_mangen::generate_to(command, directory))
            }
            None => Man::new(command).render(out),
        };
        let place = self.directory.as_ref().map(|directory| format!("{}: ", directory.display()));
        written.map_err(|error| format!("cannot write the manual: {}{error}", place.unwrap_or_default()))
    }
}
