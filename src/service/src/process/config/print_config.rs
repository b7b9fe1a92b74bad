//! The settings in force, as a file that could be read again.

use std::fmt::Write;

use clap::{Arg, ArgAction};
use toml::Value;

use crate::process::config::sources::{Layer, Settings, settings_of};

/// One line a setting, with the layer that it comes from; what is not set is commented out. Passwords are masked.
pub(crate) fn written(settings: &Settings) -> String {
    let mut text = String::new();
    for setting in settings_of(settings.command) {
        let key = setting.get_id();
        // Writing to a string cannot fail.
        let _ = match value(settings, setting) {
            Some(value) => writeln!(text, "{key} = {value} # {}", origin(settings, setting)),
            None => writeln!(text, "# {key}: not set"),
        };
    }
    text
}

fn value(settings: &Settings, setting: &Arg) -> Option<String> {
    let id = setting.get_id().as_str();
    if matches!(setting.get_action(), ArgAction::SetTrue) {
        return Some(settings.matches.get_flag(id).to_string());
    }
    let mut values =
        settings.matches.get_raw(id)?.map(|value| masked(id, &value.to_string_lossy())).map(|v| literal(&v));
    if matches!(setting.get_action(), ArgAction::Append) {
        return Some(format!("[{}]", values.collect::<Vec<_>>().join(", ")));
    }
    values.next()
}

fn origin(settings: &Settings, setting: &Arg) -> String {
    let path = settings.file.map(|file| file.path.display().to_string()).unwrap_or_default();
    match settings.layer(setting.get_id().as_str()) {
        None | Some(Layer::Default) => "default".to_owned(),
        Some(Layer::File) => format!("file {path:?}"),
        Some(Layer::Environment) => {
            format!("environment {}", setting.get_env().unwrap_or_default().to_string_lossy())
        }
        Some(Layer::Flag) => format!("flag --{}", setting.get_long().unwrap_or_default()),
    }
}

/// A number where it reads back as the same text, else a string.
fn literal(text: &str) -> String {
    let number = [text.parse().ok().map(Value::Integer), text.parse().ok().map(Value::Float)];
    let number =
        number.into_iter().flatten().map(|number| number.to_string()).find(|written| written == text);
    number.unwrap_or_else(|| Value::String(text.to_owned()).to_string())
}

/// Settings that are addresses, with a user and a password or a token in them perhaps.
const ADDRESSES: [&str; 3] = ["broker", "otlp", "store"];

/// Addresses without what is secret in them, also where their scheme was left out.
fn masked(id: &str, text: &str) -> String {
    if !ADDRESSES.contains(&id) {
        return text.to_owned();
    }
    let without = |piece: &str| match piece.rfind('@') {
        Some(at) => format!("***{}", piece.get(at..).unwrap_or_default()),
        None => piece.to_owned(),
    };
    text.split("://").map(without).collect::<Vec<_>>().join("://")
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::{literal, masked};

    #[test]
    fn nobody_reads_a_password() {
        for (id, address, shown) in [
            ("broker", "nats://me:p@ss@one:4222,tls://token@two", "nats://***@one:4222,tls://***@two"),
            ("broker", "nats://one,nats://two", "nats://one,nats://two"),
            ("broker", "me:secret@one:4222", "***@one:4222"),
            ("otlp", "http://me:secret@one:4318", "http://***@one:4318"),
            ("keys", "/etc/verne@home.toml", "/etc/verne@home.toml"),
        ] {
            assert_eq!(masked(id, address), shown);
        }
    }

    #[test]
    fn literals_read_back_as_the_same_text() {
        for (text, written) in [
            ("10000", "10000"),
            ("0.5", "0.5"),
            ("007", "\"007\""),
            ("nan", "nan"),
            ("127.0.0.1:80", "\"127.0.0.1:80\""),
            ("a\"b\\c", "'a\"b\\c'"),
        ] {
            assert_eq!(literal(text), written);
            let read: toml::Table = format!("x = {written}").parse().unwrap();
            let read = read["x"].as_str().map_or_else(|| read["x"].to_string(), str::to_owned);
            assert_eq!(read, text);
        }
    }
}
