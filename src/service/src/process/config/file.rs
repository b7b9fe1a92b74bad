//! The settings file, in TOML.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use clap::{Arg, ArgAction, ArgMatches, Command};
use toml::{Table, Value};

use crate::limits::toml_error;
use crate::process::config::layers::{Layer, layer_of_words, settings_of};

/// The value of a setting in the file.
#[derive(Debug)]
pub(crate) struct FileSetting {
    /// The name of the setting.
    pub name: String,
    /// The value as flags of the command.
    pub flags: Vec<OsString>,
}

/// The settings of a file that neither flags nor environment variables in `matches` override. The error names the file
/// and the setting.
pub(crate) fn read(path: &Path, command: &Command, matches: &ArgMatches) -> Result<Vec<FileSetting>, String> {
    let in_file = |message: String| format!("{}: {message}", path.display());
    let text = fs::read_to_string(path).map_err(|error| in_file(error.to_string()))?;
    let table: Table = text.parse().map_err(|error| in_file(toml_error::describe(&error, &text)))?;
    let mut settings = Vec::new();
    for (name, value) in table {
        let setting = settings_of(command).find(|setting| *setting.get_id() == *name);
        let setting = setting.ok_or_else(|| in_file(unknown(&name, command)))?;
        let of_setting = |message| in_file(format!("{name}: {message}"));
        let flags = flags(setting, &value).map_err(of_setting)?;
        if layer_of_words(matches, &name) < Layer::File {
            check(setting, &flags).map_err(of_setting)?;
            settings.push(FileSetting { name, flags });
        }
    }
    Ok(settings)
}

fn unknown(name: &str, command: &Command) -> String {
    let mut names: Vec<_> = settings_of(command).map(|setting| setting.get_id().as_str()).collect();
    names.sort_unstable();
    format!("{name}: no setting has this name; the settings are {}", names.join(", "))
}

fn flags(setting: &Arg, value: &Value) -> Result<Vec<OsString>, String> {
    let flag = setting.get_long().unwrap_or_default();
    let with_value = |value: &Value| scalar(value).map(|text| OsString::from(format!("--{flag}={text}")));
    match (setting.get_action(), value) {
        (ArgAction::SetTrue, Value::Boolean(true)) => Ok(vec![OsString::from(format!("--{flag}"))]),
        (ArgAction::SetTrue, Value::Boolean(false)) => Ok(Vec::new()),
        (ArgAction::SetTrue, _) => Err("must be true or false".to_owned()),
        (ArgAction::Append, Value::Array(items)) => items.iter().map(with_value).collect(),
        (_, value) => Ok(vec![with_value(value)?]),
    }
}

fn scalar(value: &Value) -> Result<String, String> {
    match value {
        Value::String(text) => Ok(text.clone()),
        Value::Integer(_) | Value::Float(_) | Value::Boolean(_) | Value::Datetime(_) => Ok(value.to_string()),
        Value::Array(_) => Err("must be one value, not an array".to_owned()),
        Value::Table(_) => Err("must be a value, not a table".to_owned()),
    }
}

/// Has clap check the value of one setting. Returns clap's message without the name of the flag.
fn check(setting: &Arg, flags: &[OsString]) -> Result<(), String> {
    let command = Command::new("verne").no_binary_name(true).arg(setting.clone().required(false));
    let Err(error) = command.try_get_matches_from(flags) else { return Ok(()) };
    let text = error.to_string();
    let text = text.split("\n\n").next().unwrap_or_default();
    Err(text.trim_start_matches("error: ").replace(&format!(" for '{setting}'"), "").trim().to_owned())
}
