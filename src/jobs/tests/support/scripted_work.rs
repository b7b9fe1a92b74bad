//! Work that follows the script in its payload and reports its runs to the test.

use std::collections::HashSet;
use std::time::Duration;

use bytes::Bytes;
use parking_lot::{Condvar, Mutex, MutexGuard};
use tokio::sync::watch;
use verne_jobs::{JobId, RunControl, Submission, Work, WorkError};

/// Payloads are `name verb`.
#[derive(Default)]
pub(crate) struct ScriptedWork {
    /// It cannot run any job.
    is_outdated: bool,
    released: Mutex<HashSet<String>>,
    released_changed: Condvar,
    started: watch::Sender<Vec<String>>,
    ended: watch::Sender<Vec<String>>,
}

impl ScriptedWork {
    pub(crate) fn outdated() -> Self {
        Self { is_outdated: true, ..Self::default() }
    }

    /// Waits until so many runs have started. Returns their names in the order of their starts.
    pub(crate) async fn started(&self, count: usize) -> Vec<String> {
        self.started.subscribe().wait_for(|names| names.len() >= count).await.unwrap().clone()
    }

    /// Waits until so many runs have ended. Returns their names in the order of their ends.
    pub(crate) async fn ended(&self, count: usize) -> Vec<String> {
        self.ended.subscribe().wait_for(|names| names.len() >= count).await.unwrap().clone()
    }

    /// Lets a run that waits continue.
    pub(crate) fn release(&self, name: &str) {
        self.released.lock().insert(name.to_owned());
        self.released_changed.notify_all();
    }

    fn wait(&self, name: &str, control: &dyn RunControl) -> Result<(), WorkError> {
        let mut released = self.released.lock();
        while !released.contains(name) {
            // This call may pause the thread, which must not block others meanwhile.
            if MutexGuard::unlocked(&mut released, || control.cancelled()) {
                return Err(WorkError::Cancelled);
            }
            self.released_changed.wait_for(&mut released, Duration::from_millis(5));
        }
        Ok(())
    }

    fn follow(&self, name: &str, verb: &str, control: &dyn RunControl) -> Result<(), WorkError> {
        match verb.split(' ').next().unwrap_or_default() {
            "pass" | "split" => Ok(()),
            "split-progress" => self.follow(name, "progress", control),
            "wait" => self.wait(name, control),
            "fail" => Err(WorkError::Failed(Bytes::from("as told"))),
            "panic" => panic!("as told"),
            // Panics on another thread of the pool.
            "panic-inside" => {
                rayon::scope(|scope| scope.spawn(|_| panic!("as told, inside")));
                Ok(())
            }
            "progress" => {
                for fraction in [0.2, 0.1, f64::NAN, 0.5, 0.3] {
                    control.progress(fraction);
                    self.wait(&format!("{name}-{fraction}"), control)?;
                }
                Ok(())
            }
            "threads" => Err(WorkError::Failed(rayon::current_num_threads().to_string().into())),
            "ignore-stop" | "stop-late" => {
                let mut released = self.released.lock();
                while !released.contains(name) {
                    self.released_changed.wait(&mut released);
                }
                if verb == "stop-late" && control.cancelled() { Err(WorkError::Cancelled) } else { Ok(()) }
            }
            _ => Err(WorkError::Failed(Bytes::from("no such verb"))),
        }
    }
}

impl Work for ScriptedWork {
    /// The subtasks of a job with the verb `split`: words `name=verb` or `name=verb=cost`. In their verbs `+` stands
    /// for a space and `:` for `=`.
    fn subtasks(&self, _job: &JobId, payload: &[u8]) -> Result<Vec<Submission>, WorkError> {
        let text = String::from_utf8(payload.to_vec()).unwrap();
        let mut words = text.split(' ');
        let name = words.next().unwrap();
        match words.next().unwrap() {
            verb if self.is_outdated || verb == "other-version" => {
                self.started.send_modify(|names| names.push(name.to_owned()));
                Err(WorkError::CannotRunHere(Bytes::from("another version's")))
            }
            "split" | "split-progress" => Ok(words.map(subtask).collect()),
            "split-fail" => Err(WorkError::Failed(Bytes::from("as told"))),
            "split-panic" => panic!("as told"),
            _ => Ok(Vec::new()),
        }
    }

    fn run(&self, _job: &JobId, payload: &[u8], control: &dyn RunControl) -> Result<(), WorkError> {
        let text = String::from_utf8(payload.to_vec()).unwrap();
        let (name, verb) = text.split_once(' ').unwrap();
        self.started.send_modify(|names| names.push(name.to_owned()));
        let _report = ReportEnd(self, name);
        self.follow(name, verb, control)
    }
}

struct ReportEnd<'a>(&'a ScriptedWork, &'a str);

impl Drop for ReportEnd<'_> {
    fn drop(&mut self) {
        self.0.ended.send_modify(|names| names.push(self.1.to_owned()));
    }
}

fn subtask(text: &str) -> Submission {
    let words: Vec<_> = text.split('=').collect();
    let cost = words.get(2).map_or(10.0, |cost| cost.parse().unwrap());
    Submission { cost, ..job("", words[0], &words[1].replace('+', " ").replace(':', "=")) }
}

/// A large job of a client.
pub(crate) fn job(client: &str, name: &str, verb: &str) -> Submission {
    Submission {
        id: id(name),
        client: client.to_owned(),
        cost: 10.0,
        payload: format!("{name} {verb}").into(),
        deadline: None,
    }
}

/// The id of the job with this name.
pub(crate) fn id(name: &str) -> JobId {
    let mut bytes = [0; 32];
    for (byte, character) in bytes.iter_mut().zip(name.bytes()) {
        *byte = character;
    }
    JobId::from_bytes(bytes)
}
