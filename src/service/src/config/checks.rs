//! What settings have to do with each other, whatever layers they come from.

use super::layered::{Layer, Settings};

/// Both or neither.
const TOGETHER: [[&str; 2]; 2] = [["tls_certificate", "tls_key"], ["broker_certificate", "broker_key"]];

/// Refuses settings that contradict each other; the error names them.
pub(super) fn check(settings: &Settings) -> Result<(), String> {
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
    Ok(())
}
