//! Runs this test binary as a child process, which can be killed or limited.

use std::io::{BufRead, BufReader, Lines};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};

const DIRECTORY: &str = "VERNE_JOBS_TEST_DIRECTORY";
const ROUND: &str = "VERNE_JOBS_TEST_ROUND";

/// A process that runs an ignored test. It ends when its standard input is closed.
pub(crate) struct Process {
    child: Child,
    lines: Lines<BufReader<ChildStdout>>,
}

impl Process {
    /// Starts the test `name`. `blocks` limits the size of its files, in blocks of the shell's `ulimit`.
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

    /// Reads the next line of its output; `None` when it has ended.
    pub(crate) fn line(&mut self) -> Option<String> {
        self.lines.next().map(Result::unwrap)
    }

    /// Kills the process as `kill -9` does.
    pub(crate) fn kill(mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    pub(crate) fn succeeds(mut self) -> bool {
        while self.line().is_some() {}
        self.child.wait().unwrap().success()
    }
}

/// In the child process: its directory and round. `None` if the test does not run in a child process.
pub(crate) fn task() -> Option<(String, usize)> {
    Some((std::env::var(DIRECTORY).ok()?, std::env::var(ROUND).ok()?.parse().ok()?))
}

/// In the child process: waits until the parent process has closed its standard input.
pub(crate) fn wait() {
    std::io::stdin().lines().for_each(drop);
}
