//! The effective settings as a settings file (`--print-config`).

use clap::{Arg, ArgAction, ArgMatches, Command};
use toml::{Table, Value};

use crate::process::config::layers::settings_of;

/// The settings that have a value, as TOML. Passwords are masked.
pub(crate) fn to_toml(command: &Command, matches: &ArgMatches) -> String {
    let values = settings_of(command)
        .filter_map(|setting| Some((setting.get_id().to_string(), value(setting, matches)?)));
    values.collect::<Table>().to_string()
}

fn value(setting: &Arg, matches: &ArgMatches) -> Option<Value> {
    let id = setting.get_id().as_str();
    if matches!(setting.get_action(), ArgAction::SetTrue) {
        return Some(Value::Boolean(matches.get_flag(id)));
    }
    let mut values = matches.get_raw(id)?.map(|value| literal(&masked(id, &value.to_string_lossy())));
    match setting.get_action() {
        ArgAction::Append => Some(Value::Array(values.collect())),
        _ => values.next(),
    }
}

/// A number if it reads back as the same text, else a string.
fn literal(text: &str) -> Value {
    let number = text.parse().map(Value::Integer).ok().filter(|number| number.to_string() == text);
    number.unwrap_or_else(|| Value::String(text.to_owned()))
}

/// Settings that are URLs and may contain a user with a password or a token.
const URLS: [&str; 3] = ["broker", "otlp", "store"];

/// URLs without their passwords, also if the scheme is missing.
fn masked(id: &str, text: &str) -> String {
    if !URLS.contains(&id) {
        return text.to_owned();
    }
    let without_user = |part: &str| match part.rfind('@') {
        Some(at) => format!("***{}", part.get(at..).unwrap_or_default()),
        None => part.to_owned(),
    };
    text.split("://").map(without_user).collect::<Vec<_>>().join("://")
}

#[cfg(test)]
mod tests {
    use super::{literal, masked};

    #[test]
    fn passwords_are_masked() {
        for (id, url, printed) in [
            ("broker", "nats://me:p@ss@one:4222,tls://token@two", "nats://***@one:4222,tls://***@two"),
            ("broker", "nats://one,nats://two", "nats://one,nats://two"),
            ("broker", "me:secret@one:4222", "***@one:4222"),
            ("otlp", "http://me:secret@one:4318", "http://***@one:4318"),
            ("keys", "/etc/verne@home.toml", "/etc/verne@home.toml"),
        ] {
            assert_eq!(masked(id, url), printed);
        }
    }

    #[test]
    fn only_texts_of_numbers_are_numbers() {
        for (text, printed) in [("10000", "10000"), ("007", "\"007\""), ("127.0.0.1:80", "\"127.0.0.1:80\"")]
        {
            assert_eq!(literal(text).to_string(), printed);
        }
    }
}
