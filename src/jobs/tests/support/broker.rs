//! A broker for one test.

use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::time::Duration;

use tempfile::TempDir;
use verne_jobs::JetStream;
use verne_jobs::jetstream::{Config, Worker, WorkerConfig};

use crate::scripted_work::ScriptedWork;

/// Killed and deleted when this is dropped.
pub(crate) struct Broker {
    directory: TempDir,
    port: u16,
    server: Child,
}

impl Broker {
    /// Starts a broker and waits until it accepts connections.
    pub(crate) fn start() -> Self {
        Self::with("")
    }

    /// Starts a broker with more lines of configuration.
    pub(crate) fn with(more: &str) -> Self {
        let directory = TempDir::new().unwrap();
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        configure(&directory, port, more);
        let server = serve(&directory, port);
        Self { directory, port, server }
    }

    /// Kills the broker as `kill -9` does.
    pub(crate) fn kill(&mut self) {
        self.server.kill().unwrap();
        self.server.wait().unwrap();
    }

    /// Deletes the broker's data.
    pub(crate) fn forget(&self) {
        std::fs::remove_dir_all(self.directory.path().join("store")).unwrap();
    }

    /// Changes the lines of configuration for the next start.
    pub(crate) fn configure(&self, more: &str) {
        configure(&self.directory, self.port, more);
    }

    /// Starts the broker again on the same port with its data.
    pub(crate) fn restart(&mut self) {
        self.server = serve(&self.directory, self.port);
    }

    /// Settings with short time limits.
    pub(crate) fn config(&self) -> Config {
        Config {
            ack_wait: Duration::from_secs(2),
            lease: Duration::from_secs(2),
            requeue_after: Duration::from_secs(1),
            max_attempts: 3,
            return_delay: Duration::from_millis(10),
            ..Config::at(format!("nats://127.0.0.1:{}", self.port))
        }
    }

    pub(crate) async fn connect(&self) -> JetStream {
        JetStream::connect(self.config()).await.unwrap()
    }
}

/// A worker with one main slot of one thread.
pub(crate) fn worker(backend: &JetStream, work: &Arc<ScriptedWork>) -> Worker {
    Worker::start(backend, WorkerConfig { threads: 1, slots: 1 }, work.clone()).unwrap()
}

fn configure(directory: &TempDir, port: u16, more: &str) {
    let store = directory.path().join("store");
    let jetstream = format!("jetstream {{ store_dir: \"{}\", sync_interval: always }}", store.display());
    let text = format!("listen: \"127.0.0.1:{port}\"\n{jetstream}\n{more}\n");
    std::fs::write(directory.path().join("nats.conf"), text).unwrap();
}

fn serve(directory: &TempDir, port: u16) -> Child {
    let program = std::env::var_os("VERNE_NATS_SERVER");
    let program = program.unwrap_or_else(|| panic!("VERNE_NATS_SERVER=$(tests/nats-server) is to be set"));
    let mut server = Command::new(program)
        .arg("-c")
        .arg(directory.path().join("nats.conf"))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    while TcpStream::connect(("127.0.0.1", port)).is_err() {
        assert!(server.try_wait().unwrap().is_none(), "the broker has not started");
        std::thread::sleep(Duration::from_millis(10));
    }
    server
}

impl Drop for Broker {
    fn drop(&mut self) {
        drop(self.server.kill());
        drop(self.server.wait());
    }
}
