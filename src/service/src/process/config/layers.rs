//! The settings of a command, and the layer from which each of them comes.

use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command};

/// Flags that are no settings.
const NO_SETTINGS: [&str; 2] = ["config", "print_config"];

/// A source of settings. The greater overrides the smaller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Layer {
    /// The default value.
    Default,
    /// The settings file.
    File,
    /// An environment variable.
    Environment,
    /// A flag.
    Flag,
}

/// The settings of one (sub)command.
pub(crate) struct Settings<'a> {
    /// The command.
    pub command: &'a Command,
    /// The values.
    pub matches: &'a ArgMatches,
    /// Names of the settings whose values come from the file.
    pub in_file: Vec<String>,
}

impl Settings<'_> {
    /// The layer of a setting. `None`: the command does not have this setting.
    pub(crate) fn layer(&self, id: &str) -> Option<Layer> {
        settings_of(self.command).find(|setting| setting.get_id() == id)?;
        if self.in_file.iter().any(|name| name == id) {
            return Some(Layer::File);
        }
        Some(layer_of_words(self.matches, id))
    }
}

/// The layer of a setting, without the settings file.
pub(crate) fn layer_of_words(matches: &ArgMatches, id: &str) -> Layer {
    match matches.value_source(id) {
        Some(ValueSource::CommandLine) => Layer::Flag,
        Some(ValueSource::EnvVariable) => Layer::Environment,
        _ => Layer::Default,
    }
}

/// The settings that a command has.
pub(crate) fn settings_of(command: &Command) -> impl Iterator<Item = &Arg> {
    command.get_arguments().filter(|argument| {
        argument.get_long().is_some()
            && matches!(argument.get_action(), ArgAction::Set | ArgAction::Append | ArgAction::SetTrue)
            && !NO_SETTINGS.contains(&argument.get_id().as_str())
    })
}
