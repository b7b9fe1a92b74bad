//! The published machines: the built-in one and those of a directory, each ready to answer.

use std::collections::BTreeMap;
use std::fmt;
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

/// A checked machine with what answers say about it.
#[derive(Debug)]
pub(crate) struct Published {
    /// The machine.
    pub machine: Machine,
    /// Its name and hash.
    pub id: MachineId,
}

impl Published {
    /// Prepares a machine for answering.
    pub(crate) fn new(machine: Machine) -> Self {
        let id = MachineId { name: machine.name().into(), hash: machine_hash(machine.data()).into() };
        Self { machine, id }
    }

    /// The id of a question's answer about this machine; see [`ResultId::of`].
    pub(crate) fn result_id(&self, layout: &[u8], numbers: impl IntoIterator<Item = f64>) -> ResultId {
        ResultId::of(layout, &self.id, &self.machine.data().description, numbers)
    }

    /// Checks a machine.
    pub(crate) fn from_object(object: &MachineObject) -> Result<Self, Vec<MachineError>> {
        Machine::new(MachineData::from(object)).map(Self::new)
    }

    /// Reads a machine from a JSON file.
    pub(crate) fn from_file(path: &Path) -> Result<Self, BadFile> {
        let bad = |faults| BadFile { path: path.to_owned(), faults };
        let text = std::fs::read(path).map_err(|error| bad(vec![FieldError::new("", error.to_string())]))?;
        let object = parse_body::<MachineObject>(&text).map_err(|error| bad(faults_of(error)))?;
        Self::from_object(&object).map_err(|faults| bad(below("", faults)))
    }
}

/// A machine file that cannot be used.
#[derive(Debug)]
pub struct BadFile {
    path: PathBuf,
    faults: Vec<FieldError>,
}

impl fmt::Display for BadFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is not a machine", self.path.display())?;
        for FieldError { pointer, detail } in &self.faults {
            write!(f, "\n  {pointer}{}{detail}", if pointer.is_empty() { "" } else { ": " })?;
        }
        Ok(())
    }
}

impl std::error::Error for BadFile {}

/// The published machines by name.
#[derive(Debug)]
pub(crate) struct Registry(BTreeMap<String, Arc<Published>>);

impl Default for Registry {
    fn default() -> Self {
        let verne = Published::new(Machine::verne());
        Self(BTreeMap::from([(verne.machine.name().to_owned(), Arc::new(verne))]))
    }
}

impl Registry {
    /// Publishes every `*.json` of a directory beside the machines already here.
    pub(crate) fn publish_directory(&mut self, directory: &Path) -> Result<(), BadFile> {
        let bad = |error: std::io::Error| BadFile {
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

    fn publish_file(&mut self, path: &Path) -> Result<(), BadFile> {
        let published = Published::from_file(path)?;
        let name = published.machine.name().to_owned();
        let refused = |detail: String| {
            Err(BadFile { path: path.to_owned(), faults: vec![FieldError::new("/name", detail)] })
        };
        // GET /machines/schema is the schema, so no machine can be had there.
        if name == "schema" || name.contains('/') {
            return refused(format!("a machine cannot be published as {name:?}"));
        }
        if self.0.contains_key(&name) {
            return refused(format!("another machine is already published as {name:?}"));
        }
        self.0.insert(name, Arc::new(published));
        Ok(())
    }

    /// The machine published under a name.
    pub(crate) fn get(&self, name: &str) -> Option<&Arc<Published>> {
        self.0.get(name)
    }

    /// All of them, by name.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Published> {
        self.0.values().map(AsRef::as_ref)
    }

    /// The machine that a request names or carries.
    pub(crate) fn resolve(&self, wanted: &MachineRef) -> Result<Arc<Published>, OperationError> {
        let faults = match wanted {
            MachineRef::Name(name) => match self.get(name) {
                Some(published) => return Ok(Arc::clone(published)),
                None => vec![FieldError::new("/machine", format!("no machine is published as {name:?}"))],
            },
            MachineRef::Whole(object) => match Published::from_object(object) {
                Ok(published) => return Ok(Arc::new(published)),
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
