//! Settings in layers: defaults, then a file, then the environment, then flags; the later goes before the earlier.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command, Error};

use crate::process::config::file::SettingsInFile;
use crate::process::config::{checks, print_config};

/// Flags that are no settings.
const ABOUT_SETTINGS: [&str; 2] = ["config", "print_config"];

/// What the command line comes to.
pub(crate) struct Read {
    /// The words, completed by the file.
    pub matches: ArgMatches,
    /// The settings in force, if they were asked for.
    pub printed: Option<String>,
}

/// A layer of settings; the greater goes before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Layer {
    /// Nothing was said.
    Default,
    /// The file.
    File,
    /// The environment.
    Environment,
    /// The command line.
    Flag,
}

/// The settings of one (sub)command, with the layer of each.
pub(crate) struct Settings<'a> {
    /// The command.
    pub command: &'a Command,
    /// Its values.
    pub matches: &'a ArgMatches,
    /// The file, where there is one.
    pub file: Option<&'a SettingsInFile>,
}

impl Settings<'_> {
    /// Where a setting comes from; nothing for what the command does not have.
    pub(crate) fn layer(&self, id: &str) -> Option<Layer> {
        settings_of(self.command).find(|setting| setting.get_id() == id)?;
        if self.file.is_some_and(|file| file.decides(id)) {
            return Some(Layer::File);
        }
        Some(match self.matches.value_source(id) {
            Some(ValueSource::CommandLine) => Layer::Flag,
            Some(ValueSource::EnvVariable) => Layer::Environment,
            _ => Layer::Default,
        })
    }
}

/// The settings that a command has.
pub(crate) fn settings_of(command: &Command) -> impl Iterator<Item = &Arg> {
    command.get_arguments().filter(|argument| {
        argument.get_long().is_some()
            && matches!(argument.get_action(), ArgAction::Set | ArgAction::Append | ArgAction::SetTrue)
            && !ABOUT_SETTINGS.contains(&argument.get_id().as_str())
    })
}

/// Reads the command line, and the file that it or the environment names. The file's values are put among the words:
/// types, ranges and messages are clap's for all layers.
pub(crate) fn read(mut command: Command, words: &[OsString]) -> Result<Read, Error> {
    // Before that, arguments cannot say how they are called in messages.
    command.build();
    let strict = |words: &[OsString]| command.clone().try_get_matches_from(words);
    let loose = loosened(command.clone());
    // What is wrong already is said in the words of the command as it is.
    let Ok(told) = loose.clone().try_get_matches_from(words) else {
        return Ok(Read { matches: strict(words)?, printed: None });
    };
    let (depth, asked, values) = innermost(&command, &told);
    let file = match values.try_get_one::<PathBuf>("config") {
        Ok(Some(path)) => Some(SettingsInFile::read(path, asked, values).map_err(refusal)?),
        _ => None,
    };
    let completed = |inserted: &[OsString]| {
        let (command_words, rest) = words.split_at(words.len().min(depth + 1));
        [command_words, inserted, rest].concat()
    };
    let matches = match &file {
        None => strict(words)?,
        Some(file) => strict(&completed(&file.words())).map_err(|error| {
            let fault = file.blame(|inserted| loose.clone().try_get_matches_from(completed(inserted)).err());
            fault.map_or(error, refusal)
        })?,
    };
    let (_, asked, values) = innermost(&command, &matches);
    let settings = Settings { command: asked, matches: values, file: file.as_ref() };
    checks::check(&settings).map_err(refusal)?;
    let print = matches!(values.try_get_one("print_config"), Ok(Some(true)));
    let printed = print.then(|| print_config::written(&settings));
    Ok(Read { matches, printed })
}

/// What must be set may be set in the file.
fn loosened(command: Command) -> Command {
    command.mut_args(|argument| argument.required(false)).mut_subcommands(loosened)
}

/// The subcommand that was asked for, its values, and the number of words that name it.
fn innermost<'a>(
    mut command: &'a Command,
    mut matches: &'a ArgMatches,
) -> (usize, &'a Command, &'a ArgMatches) {
    let mut depth = 0;
    while let Some((name, below)) = matches.subcommand() {
        let Some(found) = command.find_subcommand(name) else { break };
        (depth, command, matches) = (depth + 1, found, below);
    }
    (depth, command, matches)
}

fn refusal(message: String) -> Error {
    Error::raw(ErrorKind::ValueValidation, message + "\n")
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::ffi::OsString;
    use std::fs;

    use clap::{Arg, ArgAction, Command, value_parser};
    use tempfile::NamedTempFile;

    use super::read;

    /// A command whose setting `package` is always in the environment: cargo sets it.
    fn command() -> Command {
        let setting = |id: &'static str| Arg::new(id).long(id);
        let settings = [
            setting("config").value_parser(value_parser!(std::path::PathBuf)),
            setting("print_config").action(ArgAction::SetTrue),
            setting("package").env("CARGO_PKG_NAME"),
            setting("origin").action(ArgAction::Append).value_delimiter(','),
            setting("loud").action(ArgAction::SetTrue),
            setting("count").required(true).value_parser(value_parser!(u8).range(1..)),
            setting("data"),
            setting("memory_only").action(ArgAction::SetTrue),
            setting("tls_certificate"),
            setting("tls_key"),
        ];
        Command::new("program").subcommand(Command::new("work").args(settings))
    }

    fn settings(file: &str, words: &str) -> Result<String, String> {
        let place = NamedTempFile::new().unwrap();
        fs::write(place.path(), file).unwrap();
        let words = format!("program work --print_config --config {} {words}", place.path().display());
        let words: Vec<OsString> = words.split_whitespace().map(OsString::from).collect();
        let read = read(command(), &words).map_err(|error| error.to_string())?;
        Ok(read.printed.unwrap().replace(&place.path().display().to_string(), "f"))
    }

    #[test]
    fn each_layer_goes_before_the_one_below() {
        let file =
            "count = 3\npackage = 'mine'\norigin = ['https://a', 'https://b']\nloud = true\ndata = '/f'";
        assert_eq!(
            settings(file, "--count 4 --data /d").unwrap().lines().collect::<Vec<_>>(),
            [
                "package = \"verne-service\" # environment CARGO_PKG_NAME",
                "origin = [\"https://a\", \"https://b\"] # file \"f\"",
                "loud = true # file \"f\"",
                "count = 4 # flag --count",
                "data = \"/d\" # flag --data",
                "memory_only = false # default",
                "# tls_certificate: not set",
                "# tls_key: not set",
            ]
        );
    }

    #[test]
    fn what_is_printed_is_a_file() {
        let printed = settings("count = 3\norigin = 'https://a,https://b'\nloud = false", "").unwrap();
        assert!(printed.contains("count = 3 # file") && printed.contains("loud = false # file"), "{printed}");
        let values = |text: &str| text.parse::<toml::Table>().unwrap();
        assert_eq!(values(&settings(&printed, "").unwrap()), values(&printed));
    }

    #[test]
    fn refusals_name_file_and_key() {
        for (file, words, expected) in [
            ("", "", "--count"),
            ("count = 0", "", ": count: invalid value '0': 0 is not in 1..=255"),
            ("count = true", "", ": count: invalid value 'true'"),
            ("count = [1, 2]", "", ": count: must be one value, not an array"),
            ("count = 1\n[data]\nx = 1", "", ": data: must be a value, not a table"),
            ("count = 1\nloud = 'yes'", "", ": loud: must be true or false"),
            ("count = 1\nconfig = 'other'", "", ": config: no setting has this name"),
            ("count = 1\nmemory-onl = true", "", "did you mean memory_only?"),
            ("count = 1\ndata = '/f'\nmemory_only = true", "", "data and memory_only exclude each other"),
            ("count = 1", "--data /d --memory_only", "data and memory_only exclude each other"),
            ("count = 1\ntls_key = 'k'", "", "tls_key needs tls_certificate"),
            ("count = 1", "--tls_certificate c", "tls_certificate needs tls_key"),
            ("count = ", "", "line 1"),
        ] {
            let error = settings(file, words).unwrap_err();
            assert!(error.contains(expected), "{file:?} {words}: {error}");
        }
    }

    #[test]
    fn a_refusal_does_not_repeat_the_file() {
        let error = settings("count = 1\ndata = \"nats://me:secret@host", "").unwrap_err();
        assert!(error.contains("line 2") && !error.contains("secret"), "{error}");
    }

    #[test]
    fn layers_complete_each_other() {
        assert!(settings("count = 1\ntls_key = 'k'", "--tls_certificate c").is_ok());
        let printed = settings("count = 1\ndata = '/f'", "--memory_only").unwrap();
        assert!(printed.contains("memory_only = true # flag"), "{printed}");
    }
}
