//! A line on a terminal that says how far a long computation has come.

use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

/// What is done sooner needs no such line; and it is not to flicker.
const PATIENCE: Duration = Duration::from_millis(500);

pub struct Progress {
    terminal: bool,
    last: Instant,
    shown: bool,
}

impl Progress {
    pub fn new() -> Self {
        Progress {
            terminal: io::stderr().is_terminal(),
            last: Instant::now(),
            shown: false,
        }
    }

    /// Shows which part of the work is done, from 0 to 1, if somebody may be looking.
    pub fn show(&mut self, part: f64) {
        if self.terminal && self.last.elapsed() >= PATIENCE {
            self.last = Instant::now();
            self.shown = true;
            // nobody is harmed if it cannot be shown
            let _ = write!(io::stderr(), "\r{:5.1} % done", 100.0 * part);
        }
    }

    /// Shows how much there is so far of what has no known end.
    pub fn count(&mut self, so_far: &str) {
        if self.terminal && self.last.elapsed() >= PATIENCE {
            self.last = Instant::now();
            self.shown = true;
            let _ = write!(io::stderr(), "\r\x1b[K{so_far}");
        }
    }

    /// Takes the line away.
    pub fn clear(&self) {
        if self.shown {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
    }
}
