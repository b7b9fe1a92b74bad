//! The published machines: the built-in ones and those of a directory.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use verne_solver::{Machine, MachineData, MachineError};

use crate::operations::machine_hash::machine_hash;
use crate::wire::answer::MachineId;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::machine::MachineObject;
use crate::wire::machine_ref::MachineRef;
use crate::wire::parse::parse_body;
use crate::wire::result_id::ResultId;

/// A checked machine with the name and the hash that answers state.
#[derive(Debug)]
pub(crate) struct IdentifiedMachine {
    machine: Machine,
    /// Its name and hash.
    pub id: MachineId,
}

impl Deref for IdentifiedMachine {
    type Target = Machine;

    fn deref(&self) -> &Machine {
        &self.machine
    }
}

impl IdentifiedMachine {
    /// Computes the hash of a machine.
    pub(crate) fn new(machine: Machine) -> Self {
        let id = MachineId { name: machine.name().into(), hash: machine_hash(machine.data()).into() };
        Self { machine, id }
    }

    /// Checks a machine object.
    pub(crate) fn from_object(object: &MachineObject) -> Result<Self, Vec<MachineError>> {
        Machine::new(MachineData::from(object)).map(Self::new)
    }

    /// Reads a machine from a JSON file.
    pub(crate) fn from_file(path: &Path) -> Result<Self, MachineFileError> {
        let bad = |faults| MachineFileError { path: path.to_owned(), faults };
        let text = std::fs::read(path).map_err(|error| bad(vec![FieldError::new("", error.to_string())]))?;
        let object = parse_body::<MachineObject>(&text).map_err(|error| bad(faults_of(error)))?;
        Self::from_object(&object).map_err(|faults| bad(below("", faults)))
    }

    /// The id of the answer to a question about this machine; see [`ResultId::of`].
    pub(crate) fn result_id(&self, prefix: &[u8], numbers: impl IntoIterator<Item = f64>) -> ResultId {
        ResultId::of(prefix, &self.id, &self.data().description, numbers)
    }

    /// Table clearance and tool radius of a request with their default values, without -0. The machine's own clearance
    /// is the default. Only a request with a clearance has a radius.
    pub(crate) fn canonical_clearance(&self, clearance: Option<f64>, tool_radius: f64) -> [Option<f64>; 2] {
        let clearance = clearance.or(self.data().limits.table_clearance);
        [clearance, clearance.map(|_| tool_radius)].map(|length| length.map(|length| length + 0.0))
    }
}

/// A machine file that cannot be used.
#[derive(Debug)]
pub struct MachineFileError {
    path: PathBuf,
    faults: Vec<FieldError>,
}

impl fmt::Display for MachineFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is not a machine", self.path.display())?;
        for FieldError { pointer, detail } in &self.faults {
            write!(f, "\n  {pointer}{}{detail}", if pointer.is_empty() { "" } else { ": " })?;
        }
        Ok(())
    }
}

impl std::error::Error for MachineFileError {}

/// The published machines, by name.
#[derive(Debug)]
pub(crate) struct MachineRegistry(BTreeMap<String, Arc<IdentifiedMachine>>);

impl Default for MachineRegistry {
    fn default() -> Self {
        let built_in = [Machine::verne(), Machine::linear_delta()].map(IdentifiedMachine::new);
        Self(built_in.into_iter().map(|machine| (machine.name().to_owned(), Arc::new(machine))).collect())
    }
}

impl MachineRegistry {
    /// Publishes the machine of every `*.json` file in a directory.
    pub(crate) fn publish_directory(&mut self, directory: &Path) -> Result<(), MachineFileError> {
        let bad = |error: std::io::Error| MachineFileError {
            path: directory.to_owned(),
            faults: vec![FieldError::new("", error.to_string())],
        };
        for entry in std::fs::read_dir(directory).map_err(bad)? {
            let path = entry.map_err(bad)?.path();
            if path.extension().is_some_and(|extension| extension == "json") {
                self.publish_file(&path)?;
            }
        }
        Ok(())
    }

    fn publish_file(&mut self, path: &Path) -> Result<(), MachineFileError> {
        let machine = IdentifiedMachine::from_file(path)?;
        let name = machine.name().to_owned();
        let refused = |detail: String| {
            Err(MachineFileError { path: path.to_owned(), faults: vec![FieldError::new("/name", detail)] })
        };
        // /machines/schema and /machines/calibration are no machines, and a name is one segment of a path.
        let is_reserved = ["schema", "calibration"].contains(&name.split('.').next().unwrap_or_default());
        if is_reserved || name.contains('/') {
            return refused(format!("a machine cannot be published as {name:?}"));
        }
        if self.0.contains_key(&name) {
            return refused(format!("another machine is already published as {name:?}"));
        }
        self.0.insert(name, Arc::new(machine));
        Ok(())
    }

    /// The machine published under a name.
    pub(crate) fn get(&self, name: &str) -> Option<&Arc<IdentifiedMachine>> {
        self.0.get(name)
    }

    /// All machines, in the order of their names.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &IdentifiedMachine> {
        self.0.values().map(AsRef::as_ref)
    }

    /// The machine that a request names or contains.
    pub(crate) fn resolve(&self, machine: &MachineRef) -> Result<Arc<IdentifiedMachine>, OperationError> {
        let faults = match machine {
            MachineRef::Name(name) => match self.get(name) {
                Some(machine) => return Ok(Arc::clone(machine)),
                None => vec![FieldError::new("/machine", format!("no machine is published as {name:?}"))],
            },
            MachineRef::Object(object) => match IdentifiedMachine::from_object(object) {
                Ok(machine) => return Ok(Arc::new(machine)),
                Err(faults) => below("/machine", faults),
            },
        };
        Err(OperationError::Fields(faults))
    }
}

fn below(pointer: &str, faults: Vec<MachineError>) -> Vec<FieldError> {
    faults
        .into_iter()
        .map(|fault| FieldError::new(format!("{pointer}/{}", fault.field), fault.detail))
        .collect()
}

fn faults_of(error: OperationError) -> Vec<FieldError> {
    match error {
        OperationError::Fields(faults) => faults,
        other => vec![FieldError::new("", other.to_string())],
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    fn resolved(drives: Value) -> Result<Arc<IdentifiedMachine>, OperationError> {
        let mut machine = serde_json::to_value(MachineObject::from(Machine::verne().data())).unwrap();
        machine["drives"] = drives;
        let object: MachineObject = parse_body(machine.to_string().as_bytes())?;
        MachineRegistry::default().resolve(&MachineRef::Object(Box::new(object)))
    }

    fn pointers(error: OperationError) -> Vec<String> {
        let OperationError::Fields(faults) = error else { return Vec::new() };
        faults.into_iter().map(|fault| fault.pointer).collect()
    }

    #[test]
    fn drives_do_not_change_the_hash() {
        let axis = json!({"velocity": 60, "acceleration": 500});
        let drives = json!({"slider": {"velocity": 500, "acceleration": 3000}, "tilt": axis, "rotary": axis});
        let machine = resolved(drives).unwrap();
        assert_eq!(machine.id.hash, resolved(Value::Null).unwrap().id.hash);
        let drives = machine.data().drives.unwrap();
        assert_eq!((drives.slider.velocity, drives.tilt.velocity), (500.0, 60_f64.to_radians()));
    }

    #[test]
    fn bad_drives_are_refused_at_their_pointer() {
        let drives = |slider: Value| {
            let axis = json!({"velocity": 60});
            resolved(json!({"slider": slider, "tilt": axis, "rotary": axis}))
        };
        let error = drives(json!({"velocity": 0, "acceleration": -1})).unwrap_err();
        let both = ["/machine/drives/slider/velocity", "/machine/drives/slider/acceleration"];
        assert_eq!(pointers(error), both);
        assert_eq!(pointers(drives(json!({"acceleration": 5})).unwrap_err()), ["/drives/slider/velocity"]);
        assert_eq!(pointers(drives(json!([500])).unwrap_err()), ["/drives/slider"]);
        assert!(drives(json!({"velocity": 1e6, "acceleration": 1e9})).is_ok());
        assert!(drives(json!({"velocity": 0.001, "acceleration": 0.001})).is_ok());
    }
}
