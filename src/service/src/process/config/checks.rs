//! Checks of settings that depend on each other.

use clap::Arg;
use clap::builder::OsStr;

use crate::process::config::layers::{Layer, Settings, settings_of};

/// Settings that need each other.
const PAIRS: [[&str; 2]; 2] = [["tls_certificate", "tls_key"], ["broker_certificate", "broker_key"]];

/// Rejects settings that contradict each other, or that have no effect without another one. The error names them.
pub(crate) fn check(settings: &Settings) -> Result<(), String> {
    check_pairs(settings)?;
    check_memory_only(settings)?;
    check_broker(settings)?;
    check_rate(settings)
}

fn check_pairs(settings: &Settings) -> Result<(), String> {
    let is_set = |id: &str| settings.layer(id).is_some() && settings.matches.contains_id(id);
    for [one, other] in PAIRS {
        match (is_set(one), is_set(other)) {
            (true, false) => return Err(format!("{one} needs {other}")),
            (false, true) => return Err(format!("{other} needs {one}")),
            _ => {}
        }
    }
    Ok(())
}

/// In different layers, `memory_only` overrides `data`.
fn check_memory_only(settings: &Settings) -> Result<(), String> {
    let memory_only = settings.layer("memory_only").filter(|_| settings.matches.get_flag("memory_only"));
    let data = settings.layer("data").filter(|layer| *layer != Layer::Default);
    if memory_only.is_some() && memory_only == data {
        return Err("data and memory_only exclude each other".to_owned());
    }
    Ok(())
}

fn check_broker(settings: &Settings) -> Result<(), String> {
    let mut all = settings_of(settings.command);
    if all.any(|setting| setting.get_id() == "broker" && differs_from_default(settings, setting)) {
        return Ok(());
    }
    let of_broker = |setting: &&Arg| setting.get_id().as_str().starts_with("broker_");
    let mut others = settings_of(settings.command).filter(of_broker);
    match others.find(|setting| differs_from_default(settings, setting)) {
        Some(setting) => Err(format!("{} needs broker", setting.get_id())),
        None => Ok(()),
    }
}

/// In a higher layer, a rate without limit overrides `rate_burst`.
fn check_rate(settings: &Settings) -> Result<(), String> {
    let no_rate = settings.layer("rate").filter(|_| settings.matches.get_one("rate") == Some(&0_u32));
    let burst = settings.layer("rate_burst").filter(|layer| *layer != Layer::Default);
    match (no_rate, burst) {
        (Some(rate), Some(burst)) if rate <= burst => Err("rate_burst needs rate".to_owned()),
        _ => Ok(()),
    }
}

/// Whether a setting has another value than its default. A printed configuration sets all values.
fn differs_from_default(settings: &Settings, setting: &Arg) -> bool {
    let values = settings.matches.get_raw(setting.get_id().as_str()).into_iter().flatten();
    values.ne(setting.get_default_values().iter().map(OsStr::as_os_str))
}
