//! A broker of one test's own.

use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::time::Duration;

use tempfile::TempDir;
use verne_jobs::JetStream;
use verne_jobs::jetstream::{Config, Worker, WorkerConfig};

use crate::stage::Stage;

/// Killed, and forgotten, with this.
pub(crate) struct Broker {
    directory: TempDir,
    port: u16,
    server: Child,
}

impl Broker {
    /// Started, and there.
    pub(crate) fn start() -> Self {
        Self::with("")
    }

    /// With more lines of configuration.
    pub(crate) fn with(more: &str) -> Self {
        let directory = TempDir::new().unwrap();
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        configure(&directory, port, more);
        let server = serve(&directory, port);
        Self { directory, port, server }
    }

    /// As `kill -9`.
    pub(crate) fn kill(&mut self) {
        self.server.kill().unwrap();
        self.server.wait().unwrap();
    }

    /// As if its disk had been replaced.
    pub(crate) fn forget(&self) {
        std::fs::remove_dir_all(self.directory.path().join("store")).unwrap();
    }

    /// Other lines of configuration, from the next start on.
    pub(crate) fn configure(&self, more: &str) {
        configure(&self.directory, self.port, more);
    }

    /// On the same port, with what it has stored.
    pub(crate) fn restart(&mut self) {
        self.server = serve(&self.directory, self.port);
    }

    /// Short waits, so that what is given up is given up soon.
    pub(crate) fn config(&self) -> Config {
        Config {
            ack_wait: Duration::from_secs(2),
            lease: Duration::from_secs(2),
            mend_after: Duration::from_secs(1),
            max_attempts: 3,
            handing_on: Duration::from_millis(10),
            ..Config::at(format!("nats://127.0.0.1:{}", self.port))
        }
    }

    pub(crate) async fn connect(&self) -> JetStream {
        JetStream::connect(self.config()).await.unwrap()
    }
}

/// With one thread and one place beside the express lane.
pub(crate) fn worker(backend: &JetStream, stage: &Arc<Stage>) -> Worker {
    Worker::start(backend, WorkerConfig { threads: 1, slots: 1 }, stage.clone()).unwrap()
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
