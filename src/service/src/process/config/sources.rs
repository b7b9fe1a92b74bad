//! Reads the settings: flags override environment variables, these override the file, and the file overrides the
//! defaults.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::{ArgMatches, Command, Error};

use crate::process::config::layers::Settings;
use crate::process::config::{checks, file, print};

/// A command line with the settings file that it names.
pub(crate) struct CommandLine {
    /// The values of all arguments.
    pub matches: ArgMatches,
    /// The effective settings as TOML, if `--print-config` asks for them.
    pub printed: Option<String>,
}

/// Reads the command line `words`, and the settings file that it or the environment names. The settings of the file
/// become flags, so clap checks the values of all layers.
pub(crate) fn read(mut command: Command, words: &[OsString]) -> Result<CommandLine, Error> {
    // clap can name an argument in a message only after this.
    command.build();
    let mut matches = command.clone().try_get_matches_from(words)?;
    let (depth, asked, values) = innermost(&command, &matches);
    let mut in_file = Vec::new();
    if let Ok(Some(path)) = values.try_get_one::<PathBuf>("config") {
        let settings = file::read(path, asked, values).map_err(invalid)?;
        let (before, after) = words.split_at(words.len().min(depth + 1));
        let flags: Vec<OsString> = settings.iter().flat_map(|setting| setting.flags.clone()).collect();
        matches = command.clone().try_get_matches_from([before.to_vec(), flags, after.to_vec()].concat())?;
        in_file = settings.into_iter().map(|setting| setting.name).collect();
    }
    let (_, asked, values) = innermost(&command, &matches);
    checks::check(&Settings { command: asked, matches: values, in_file }).map_err(invalid)?;
    let print = matches!(values.try_get_one("print_config"), Ok(Some(true)));
    let printed = print.then(|| print::to_toml(asked, values));
    Ok(CommandLine { matches, printed })
}

/// The subcommand on the command line, its values, and the number of words that name it.
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

fn invalid(message: String) -> Error {
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
            setting("verbose").action(ArgAction::SetTrue),
            setting("count").value_parser(value_parser!(u8).range(1..)),
            setting("data"),
            setting("memory_only").action(ArgAction::SetTrue),
            setting("tls_certificate"),
            setting("tls_key"),
        ];
        Command::new("program").subcommand(Command::new("work").args(settings))
    }

    /// The settings that are printed for a file with this text.
    fn settings(text: &str, words: &str) -> Result<String, String> {
        let file = NamedTempFile::new().unwrap();
        fs::write(file.path(), text).unwrap();
        let words = format!("program work --print_config --config {} {words}", file.path().display());
        let words: Vec<OsString> = words.split_whitespace().map(OsString::from).collect();
        let read = read(command(), &words).map_err(|error| error.to_string())?;
        Ok(read.printed.unwrap())
    }

    #[test]
    fn each_layer_overrides_the_one_below() {
        let file =
            "count = 3\npackage = 'mine'\norigin = ['https://a', 'https://b']\nverbose = true\ndata = '/f'";
        assert_eq!(
            settings(file, "--count 4 --data /d").unwrap().lines().collect::<Vec<_>>(),
            [
                "count = 4",
                "data = \"/d\"",
                "memory_only = false",
                "origin = [\"https://a\", \"https://b\"]",
                "package = \"verne-service\"",
                "verbose = true",
            ]
        );
    }

    #[test]
    fn printed_settings_can_be_read_as_a_file() {
        let printed = settings("count = 3\norigin = 'https://a,https://b'\nverbose = false", "").unwrap();
        assert!(printed.contains("count = 3\n") && printed.contains("verbose = false\n"), "{printed}");
        assert_eq!(settings(&printed, "").unwrap(), printed);
    }

    #[test]
    fn errors_name_the_file_and_the_setting() {
        for (file, words, expected) in [
            ("count = 0", "", ": count: invalid value '0': 0 is not in 1..=255"),
            ("count = true", "", ": count: invalid value 'true'"),
            ("count = [1, 2]", "", ": count: must be one value, not an array"),
            ("count = 1\n[data]\nx = 1", "", ": data: must be a value, not a table"),
            ("count = 1\nverbose = 'yes'", "", ": verbose: must be true or false"),
            ("count = 1\nconfig = 'other'", "", ": config: no setting has this name"),
            ("count = 1\nmemory-only = true", "", "the settings are count, data, memory_only, origin, "),
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
    fn errors_do_not_repeat_the_text_of_the_file() {
        let error = settings("count = 1\ndata = \"nats://me:secret@host", "").unwrap_err();
        assert!(error.contains("line 2") && !error.contains("secret"), "{error}");
    }

    #[test]
    fn settings_of_different_layers_are_checked_together() {
        assert!(settings("count = 1\ntls_key = 'k'", "--tls_certificate c").is_ok());
        let printed = settings("count = 1\ndata = '/f'", "--memory_only").unwrap();
        assert!(printed.contains("memory_only = true\n"), "{printed}");
    }
}
