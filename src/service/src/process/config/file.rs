//! A file of settings, in TOML.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command, Error};
use toml::{Table, Value};

use crate::process::config::sources::settings_of;

/// How alike a key must be to be meant, from 0 to 1.
const ALIKE: f64 = 0.8;

/// The settings that a file decides: those that neither flags nor the environment name.
#[derive(Debug)]
pub(crate) struct SettingsInFile {
    /// The file.
    pub path: PathBuf,
    decided: Vec<Setting>,
}

#[derive(Debug)]
struct Setting {
    key: String,
    /// The setting as flags.
    words: Vec<OsString>,
    /// How clap calls it in its messages.
    name: String,
}

/// Line and fault, without the line's text: there may be a password in it.
fn told_of(error: &toml::de::Error, text: &str) -> String {
    let before = error.span().and_then(|span| text.get(..span.start));
    let line = before.map(|before| format!("line {}: ", before.matches('\n').count() + 1));
    format!("{}{}", line.unwrap_or_default(), error.message())
}

impl SettingsInFile {
    /// Reads a file for a command that has these values already. The error names file and key.
    pub(crate) fn read(path: &Path, command: &Command, told: &ArgMatches) -> Result<Self, String> {
        let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let table: Table =
            text.parse().map_err(|error| format!("{}: {}", path.display(), told_of(&error, &text)))?;
        let mut decided = Vec::new();
        for (key, value) in table {
            let fault = |what: String| format!("{}: {what}", path.display());
            let setting = settings_of(command).find(|setting| *setting.get_id() == *key);
            let setting = setting.ok_or_else(|| fault(unknown(&key, command)))?;
            let words = as_flags(setting, &value).map_err(|what| fault(format!("{key}: {what}")))?;
            if !matches!(told.value_source(&key), Some(ValueSource::CommandLine | ValueSource::EnvVariable)) {
                decided.push(Setting { key, words, name: setting.to_string() });
            }
        }
        Ok(Self { path: path.to_owned(), decided })
    }

    /// Whether this file decides a setting.
    pub(crate) fn decides(&self, id: &str) -> bool {
        self.decided.iter().any(|setting| setting.key == id)
    }

    /// All of it as flags.
    pub(crate) fn words(&self) -> Vec<OsString> {
        self.decided.iter().flat_map(|setting| setting.words.clone()).collect()
    }

    /// What is wrong with the first setting that fails by itself.
    pub(crate) fn blame(&self, try_words: impl Fn(&[OsString]) -> Option<Error>) -> Option<String> {
        self.decided.iter().find_map(|setting| {
            let error = try_words(&setting.words)?;
            let said = said(&error, &setting.name);
            Some(format!("{}: {}: {said}", self.path.display(), setting.key))
        })
    }
}

/// A key that is no setting, with the one that may be meant.
fn unknown(key: &str, command: &Command) -> String {
    let known = settings_of(command).map(|setting| setting.get_id().as_str());
    let nearest = known
        .map(|known| (strsim::jaro_winkler(&key.replace('-', "_"), known), known))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .filter(|(likeness, _)| *likeness > ALIKE);
    let meant = nearest.map(|(_, known)| format!("; did you mean {known}?")).unwrap_or_default();
    format!("{key}: no setting has this name{meant}")
}

fn as_flags(setting: &Arg, value: &Value) -> Result<Vec<OsString>, String> {
    let flag = setting.get_long().unwrap_or_default();
    let word = |value: &Value| scalar(value).map(|text| OsString::from(format!("--{flag}={text}")));
    match (setting.get_action(), value) {
        (ArgAction::SetTrue, Value::Boolean(true)) => Ok(vec![OsString::from(format!("--{flag}"))]),
        (ArgAction::SetTrue, Value::Boolean(false)) => Ok(Vec::new()),
        (ArgAction::SetTrue, _) => Err("must be true or false".to_owned()),
        (ArgAction::Append, Value::Array(items)) => items.iter().map(word).collect(),
        (_, value) => Ok(vec![word(value)?]),
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

/// What clap says of a value, without what belongs to a command line.
fn said(error: &Error, name: &str) -> String {
    let text = error.to_string();
    let text = text.split("\n\n").next().unwrap_or_default();
    text.trim_start_matches("error: ").replace(&format!(" for '{name}'"), "").trim().to_owned()
}
