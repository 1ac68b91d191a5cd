//! Long work on a terminal: a line that says how far it is, and Ctrl-C, which ends it.

use std::mem::discriminant;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use linkwork::solve::{Progress, Stage, Watch};

static INTERRUPTIONS: AtomicUsize = AtomicUsize::new(0);
/// Set when Ctrl-C ended work that was not done.
static CUT_SHORT: AtomicBool = AtomicBool::new(false);
/// Set when nobody reads the rows any more.
static UNREAD: AtomicBool = AtomicBool::new(false);

/// Work that is done sooner needs no progress line.
const PATIENCE: Duration = Duration::from_millis(500);
/// Time between two lines, so that they can be read and cost nothing.
const BETWEEN: Duration = Duration::from_millis(100);

/// Does long work, showing how far it is on a terminal. The first Ctrl-C ends the work with what it has, the second ends
/// the writing of rows with a whole one, the third ends the program.
pub fn watched<R>(work: impl FnOnce(&Watch) -> R) -> R {
    // where no handler can be installed, or one is already, nothing is lost
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTIONS.fetch_add(1, Ordering::Relaxed) >= 2 {
            std::process::exit(130);
        }
    });
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    let begun = Instant::now();
    let shown: Mutex<(Duration, Option<Stage>)> = Mutex::default();
    let observer = |now: Progress| {
        let spent = begun.elapsed();
        // one of several threads draws
        if spent >= PATIENCE
            && !bar.is_hidden()
            && let Ok(mut shown) = shown.try_lock()
            && spent >= shown.0 + BETWEEN
        {
            let another = |stage| discriminant(&stage) != discriminant(&now.stage);
            if shown.1.is_none_or(another) {
                bar.reset_eta();
            }
            *shown = (spent, Some(now.stage));
            show(&bar, now);
        }
        match cuts_short(0) || UNREAD.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    };
    let result = work(&Watch::new(&observer));
    bar.finish_and_clear();
    result
}

/// Number of times Ctrl-C was pressed since the first long work began.
pub fn interruptions() -> usize {
    INTERRUPTIONS.load(Ordering::Relaxed)
}

/// True if unfinished work ends, as Ctrl-C was pressed more than so many times.
pub fn cuts_short(before: usize) -> bool {
    let pressed = interruptions() > before;
    if pressed {
        CUT_SHORT.store(true, Ordering::Relaxed);
    }
    pressed
}

/// True if any work was cut short: where Ctrl-C came later the answer is whole.
pub fn was_cut_short() -> bool {
    CUT_SHORT.load(Ordering::Relaxed)
}

/// The answer says itself that work ended so.
pub fn cut_short_is_said() {
    CUT_SHORT.store(false, Ordering::Relaxed);
}

/// Ends the work whose rows nobody reads any more.
pub fn read_no_more() {
    UNREAD.store(true, Ordering::Relaxed);
}

/// Draws the line once, with all of its parts.
fn show(bar: &ProgressBar, now: Progress) {
    let amount = match now.of {
        Some(_) => "{human_pos} of {human_len}, {eta} left {wide_bar}",
        None => "{human_pos}",
    };
    if let Ok(style) = ProgressStyle::with_template(&format!("{}: {amount}", now.stage)) {
        bar.set_style(style);
    }
    bar.update(|state| {
        if let Some(of) = now.of {
            state.set_len(of as u64);
        }
        state.set_pos(now.done as u64);
    });
}
