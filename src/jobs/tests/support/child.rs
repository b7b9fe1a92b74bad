//! This test binary once more, as a process that may be killed or kept short.

use std::io::{BufRead, BufReader, Lines};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};

const DIRECTORY: &str = "VERNE_JOBS_TEST_DIRECTORY";
const ROUND: &str = "VERNE_JOBS_TEST_ROUND";

/// A process that runs the ignored test `name`; ends with its standard input.
pub(crate) struct Process {
    child: Child,
    lines: Lines<BufReader<ChildStdout>>,
}

impl Process {
    /// With `blocks`, its files grow no larger than so many blocks of the shell's `ulimit`.
    pub(crate) fn start(name: &str, directory: &Path, round: usize, blocks: Option<u32>) -> Self {
        let program = std::env::current_exe().unwrap();
        let limit = blocks.map(|blocks| format!("trap '' XFSZ; ulimit -f {blocks};")).unwrap_or_default();
        let mut child = Command::new("sh")
            .args(["-c", &format!("{limit} exec \"$0\" \"$@\"")])
            .arg(program)
            .args([name, "--exact", "--ignored", "--nocapture"])
            .env(DIRECTORY, directory)
            .env(ROUND, round.to_string())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap()).lines();
        Self { child, lines }
    }

    /// What it says next; `None` when it has ended.
    pub(crate) fn line(&mut self) -> Option<String> {
        self.lines.next().map(Result::unwrap)
    }

    /// As `kill -9`.
    pub(crate) fn kill(mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    pub(crate) fn succeeds(mut self) -> bool {
        while self.line().is_some() {}
        self.child.wait().unwrap().success()
    }
}

/// In the process: its directory and round. `None` when the test was not called for as a process.
pub(crate) fn task() -> Option<(String, usize)> {
    Some((std::env::var(DIRECTORY).ok()?, std::env::var(ROUND).ok()?.parse().ok()?))
}

/// In the process: waits until the caller has gone.
pub(crate) fn wait() {
    std::io::stdin().lines().for_each(drop);
}
