//! Long work in Python: without the interpreter's lock, with progress, ended by Ctrl-C.

use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::solve::{Progress, Watch};

/// The time between two looks at Python's signals and two calls of a progress function.
const BETWEEN: Duration = Duration::from_millis(50);

/// The stack of a thread of long work, as large as that of the main thread of a program.
const STACK: usize = 8 << 20;

/// Does work without the interpreter's lock. Signals reach only the thread that calls, and long work occupies all of
/// them: it has a thread of its own, beside which the calling one looks for Ctrl-C.
pub fn watched<R: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    long: bool,
    work: impl FnOnce(&Watch) -> R + Send,
) -> PyResult<R> {
    let (result, failed) = match long {
        true => aside(py, progress, work)?,
        false => here(py, progress, work),
    };
    match failed {
        Some(error) => Err(error),
        None => {
            py.check_signals()?;
            Ok(result)
        }
    }
}

fn here<R: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&Watch) -> R + Send,
) -> (R, Option<PyErr>) {
    let looked = Mutex::new((Instant::now(), None));
    let observer = |now: Progress| {
        let Ok(mut looked) = looked.try_lock() else {
            return ControlFlow::Continue(());
        };
        let (last, failed) = &mut *looked;
        if last.elapsed() >= BETWEEN {
            *last = Instant::now();
            *failed = look(progress.as_ref(), Some(now)).err();
        }
        match failed {
            Some(_) => ControlFlow::Break(()),
            None => ControlFlow::Continue(()),
        }
    };
    let result = py.detach(|| on_threads(|| work(&Watch::new(&observer))));
    let (_, failed) = looked.into_inner().unwrap_or_else(PoisonError::into_inner);
    (result, failed)
}

fn aside<R: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&Watch) -> R + Send,
) -> PyResult<(R, Option<PyErr>)> {
    let latest = Mutex::new(None);
    let stop = AtomicBool::new(false);
    let observer = |now: Progress| {
        // where another thread says how far it is, that will do
        if let Ok(mut latest) = latest.try_lock() {
            *latest = Some(now);
        }
        match stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    };
    py.detach(|| {
        let (done, finished) = sync_channel::<()>(1);
        thread::scope(|scope| {
            let worker = thread::Builder::new().stack_size(STACK);
            let worker = worker.spawn_scoped(scope, || {
                let _done = done;
                on_threads(|| work(&Watch::new(&observer)))
            })?;
            let mut failed = None;
            while finished.recv_timeout(BETWEEN) == Err(RecvTimeoutError::Timeout) {
                let now = latest.try_lock().ok().and_then(|mut latest| latest.take());
                if failed.is_none() {
                    failed = look(progress.as_ref(), now).err();
                    stop.store(failed.is_some(), Ordering::Relaxed);
                }
            }
            match worker.join() {
                Ok(result) => Ok((result, failed)),
                Err(panic) => resume_unwind(panic),
            }
        })
    })
}

/// Looks for Ctrl-C, and says how far the work is.
fn look(progress: Option<&Py<PyAny>>, now: Option<Progress>) -> PyResult<()> {
    Python::attach(|py| {
        py.check_signals()?;
        if let (Some(progress), Some(now)) = (progress, now) {
            progress.call1(py, (now.stage.to_string(), now.done, now.of))?;
        }
        Ok(())
    })
}

/// The process in which this module was loaded.
static LOADED_IN: OnceLock<u32> = OnceLock::new();

pub fn begin() {
    LOADED_IN.get_or_init(process::id);
}

/// A process that was forked has none of the threads of the one it came from: there work gets threads of its own.
fn on_threads<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    static FORKED: Mutex<Option<(u32, rayon::ThreadPool)>> = Mutex::new(None);
    if LOADED_IN.get() == Some(&process::id()) {
        return work();
    }
    let mut forked = FORKED.lock().unwrap_or_else(PoisonError::into_inner);
    if forked.as_ref().is_none_or(|(id, _)| *id != process::id()) {
        let pool = rayon::ThreadPoolBuilder::new().build();
        *forked = pool.ok().map(|pool| (process::id(), pool));
    }
    match &*forked {
        Some((_, pool)) => pool.install(work),
        None => work(),
    }
}
