//! What settings have to do with each other, whatever layers they come from.

use clap::Arg;
use clap::builder::OsStr;

use crate::process::config::sources::{Layer, Settings, settings_of};

/// Both or neither.
const TOGETHER: [[&str; 2]; 2] = [["tls_certificate", "tls_key"], ["broker_certificate", "broker_key"]];

/// Refuses settings that contradict each other; the error names them.
pub(crate) fn check(settings: &Settings) -> Result<(), String> {
    let set = |id: &str| settings.layer(id).is_some() && settings.matches.contains_id(id);
    for [one, other] in TOGETHER {
        match (set(one), set(other)) {
            (true, false) => return Err(format!("{one} needs {other}")),
            (false, true) => return Err(format!("{other} needs {one}")),
            _ => {}
        }
    }
    // From different layers, memory_only goes before data.
    let memory_only = settings.layer("memory_only").filter(|_| settings.matches.get_flag("memory_only"));
    let data = settings.layer("data").filter(|layer| *layer != Layer::Default);
    if memory_only.is_some() && memory_only == data {
        return Err("data and memory_only exclude each other".to_owned());
    }
    match of_no_use(settings) {
        Some(of_no_use) => Err(of_no_use),
        None => Ok(()),
    }
}

/// What would be ignored for want of another setting.
fn of_no_use(settings: &Settings) -> Option<String> {
    let broker = settings_of(settings.command).find(|setting| setting.get_id() == "broker");
    if broker.is_some_and(|broker| !is_said(settings, broker)) {
        let of_broker = |setting: &&Arg| setting.get_id().as_str().starts_with("broker_");
        let mut said = settings_of(settings.command).filter(of_broker);
        if let Some(setting) = said.find(|setting| is_said(settings, setting)) {
            return Some(format!("{} needs broker", setting.get_id()));
        }
    }
    let no_rate = settings.layer("rate").filter(|_| settings.matches.get_one("rate") == Some(&0_u32));
    // No limit at all, said in a layer above, goes before.
    let burst = settings.layer("rate_burst").filter(|layer| no_rate.is_some_and(|rate| rate <= *layer));
    burst.filter(|layer| *layer != Layer::Default).map(|_| "rate_burst needs rate".to_owned())
}

/// Whether a setting has a value, and another than the default: what is printed says all.
fn is_said(settings: &Settings, setting: &Arg) -> bool {
    let values = settings.matches.get_raw(setting.get_id().as_str()).into_iter().flatten();
    values.ne(setting.get_default_values().iter().map(OsStr::as_os_str))
}
