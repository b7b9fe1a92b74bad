//! Work that does as its payload says, and tells the test what it does.

use std::collections::HashSet;
use std::time::Duration;

use bytes::Bytes;
use parking_lot::{Condvar, Mutex, MutexGuard};
use tokio::sync::watch;
use verne_jobs::{JobId, Stop, Submission, Watch, Work};

/// Payloads are `name verb`.
#[derive(Default)]
pub(crate) struct Stage {
    /// It can read no payload.
    old: bool,
    open: Mutex<HashSet<String>>,
    opened: Condvar,
    begun: watch::Sender<Vec<String>>,
    left: watch::Sender<Vec<String>>,
}

impl Stage {
    pub(crate) fn old() -> Self {
        Self { old: true, ..Self::default() }
    }

    /// The names of the runs in the order in which they began, once there are so many.
    pub(crate) async fn begun(&self, count: usize) -> Vec<String> {
        self.begun.subscribe().wait_for(|names| names.len() >= count).await.unwrap().clone()
    }

    /// The names of the runs that have ended, once there are so many.
    pub(crate) async fn left(&self, count: usize) -> Vec<String> {
        self.left.subscribe().wait_for(|names| names.len() >= count).await.unwrap().clone()
    }

    /// Lets a run that holds go on to its end.
    pub(crate) fn open(&self, name: &str) {
        self.open.lock().insert(name.to_owned());
        self.opened.notify_all();
    }

    fn hold(&self, name: &str, watch: &dyn Watch) -> Result<(), Stop> {
        let mut open = self.open.lock();
        while !open.contains(name) {
            // A look may rest, and must not hold up others meanwhile.
            if MutexGuard::unlocked(&mut open, || watch.cancelled()) {
                return Err(Stop::Cancelled);
            }
            self.opened.wait_for(&mut open, Duration::from_millis(5));
        }
        Ok(())
    }

    fn play(&self, name: &str, verb: &str, watch: &dyn Watch) -> Result<(), Stop> {
        match verb.split(' ').next().unwrap_or_default() {
            "pass" | "split" => Ok(()),
            "split-wavering" => self.play(name, "waver", watch),
            "hold" => self.hold(name, watch),
            "fail" => Err(Stop::Failed(Bytes::from("as told"))),
            "panic" => panic!("as told"),
            // A piece of the work that panics on another thread of the pool.
            "panic-inside" => {
                rayon::scope(|scope| scope.spawn(|_| panic!("as told, inside")));
                Ok(())
            }
            "waver" => {
                for part in [0.2, 0.1, f64::NAN, 0.5, 0.3] {
                    watch.progress(part);
                    self.hold(&format!("{name}-{part}"), watch)?;
                }
                Ok(())
            }
            "threads" => Err(Stop::Failed(rayon::current_num_threads().to_string().into())),
            // Does not look whether to stop; "late" does at last.
            "deaf" | "late" => {
                let mut open = self.open.lock();
                while !open.contains(name) {
                    self.opened.wait(&mut open);
                }
                if verb == "late" && watch.cancelled() { Err(Stop::Cancelled) } else { Ok(()) }
            }
            _ => Err(Stop::Failed(Bytes::from("no such verb"))),
        }
    }
}

impl Work for Stage {
    /// Of a job that splits: `name=verb` or `name=verb=cost` each. In a part's verb `+` and `:` stand for space and `=`.
    fn parts(&self, _job: &JobId, payload: &[u8]) -> Result<Vec<Submission>, Stop> {
        let text = String::from_utf8(payload.to_vec()).unwrap();
        let mut words = text.split(' ');
        let name = words.next().unwrap();
        match words.next().unwrap() {
            verb if self.old || verb == "foreign" => {
                self.begun.send_modify(|names| names.push(name.to_owned()));
                Err(Stop::Elsewhere(Bytes::from("another version's")))
            }
            "split" | "split-wavering" => Ok(words.map(part).collect()),
            "split-fail" => Err(Stop::Failed(Bytes::from("as told"))),
            "split-panic" => panic!("as told"),
            _ => Ok(Vec::new()),
        }
    }

    fn run(&self, _job: &JobId, payload: &[u8], watch: &dyn Watch) -> Result<(), Stop> {
        let text = String::from_utf8(payload.to_vec()).unwrap();
        let (name, verb) = text.split_once(' ').unwrap();
        self.begun.send_modify(|names| names.push(name.to_owned()));
        let _leaving = Leaving(self, name);
        self.play(name, verb, watch)
    }
}

struct Leaving<'a>(&'a Stage, &'a str);

impl Drop for Leaving<'_> {
    fn drop(&mut self) {
        self.0.left.send_modify(|names| names.push(self.1.to_owned()));
    }
}

fn part(text: &str) -> Submission {
    let words: Vec<_> = text.split('=').collect();
    let cost = words.get(2).map_or(10.0, |cost| cost.parse().unwrap());
    Submission { cost, ..job("", words[0], &words[1].replace('+', " ").replace(':', "=")) }
}

/// A job of `client` that is too large for the express lane.
pub(crate) fn job(client: &str, name: &str, verb: &str) -> Submission {
    Submission {
        id: id(name),
        client: client.to_owned(),
        cost: 10.0,
        payload: format!("{name} {verb}").into(),
        deadline: None,
    }
}

/// Of the job of that name.
pub(crate) fn id(name: &str) -> JobId {
    let mut bytes = [0; 32];
    for (byte, character) in bytes.iter_mut().zip(name.bytes()) {
        *byte = character;
    }
    JobId::from_bytes(bytes)
}
