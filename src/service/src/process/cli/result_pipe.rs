//! Where results go: standard output, which may be a pipe that its reader closes early.

use std::io::{self, ErrorKind, Write};

/// Passes results on, and notes whether their reader has closed the pipe.
pub(crate) struct ResultPipe<W> {
    out: W,
    closed: bool,
}

impl<W: Write> ResultPipe<W> {
    /// A pipe that is open.
    pub(crate) fn new(out: W) -> Self {
        Self { out, closed: false }
    }

    /// Whether the reader has closed the pipe.
    pub(crate) fn is_closed(&self) -> bool {
        self.closed
    }

    fn noted<T>(&mut self, done: io::Result<T>) -> io::Result<T> {
        self.closed |= done.as_ref().is_err_and(|error| error.kind() == ErrorKind::BrokenPipe);
        done
    }
}

impl<W: Write> Write for ResultPipe<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes);
        self.noted(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = self.out.flush();
        self.noted(flushed)
    }
}
