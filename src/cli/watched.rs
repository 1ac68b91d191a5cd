//! Long work on a terminal: a line that says how far it is, and Ctrl-C, which ends it.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use linkwork::solve::{Progress, Stage, Watch};

static INTERRUPTIONS: AtomicUsize = AtomicUsize::new(0);
/// Set when nobody reads the rows any more.
static UNREAD: AtomicBool = AtomicBool::new(false);

/// Work that is done sooner needs no progress line.
const PATIENCE: Duration = Duration::from_millis(500);
/// Milliseconds between two lines, so that they can be read and cost nothing.
const BETWEEN: u64 = 100;

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
    let (begun, last) = (Instant::now(), AtomicU64::new(0));
    let observer = |now: Progress| {
        let spent = begun.elapsed();
        if spent >= PATIENCE && !bar.is_hidden() {
            let spent = spent.as_millis() as u64;
            let before = last.load(Ordering::Relaxed);
            // one of several threads draws
            let next = last.compare_exchange(before, spent, Ordering::Relaxed, Ordering::Relaxed);
            match next {
                Ok(_) if spent >= before + BETWEEN => show(&bar, now),
                Ok(_) => last.store(before, Ordering::Relaxed),
                Err(_) => {}
            }
        }
        match interruptions() > 0 || UNREAD.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    };
    let result = work(&Watch::new(&observer));
    bar.finish_and_clear();
    result
}

/// How often Ctrl-C was pressed since the first long work began.
pub fn interruptions() -> usize {
    INTERRUPTIONS.load(Ordering::Relaxed)
}

/// Ends the work whose rows nobody reads any more.
pub fn read_no_more() {
    UNREAD.store(true, Ordering::Relaxed);
}

fn show(bar: &ProgressBar, now: Progress) {
    let template = match now.of {
        Some(_) => "{msg}: {human_pos} of {human_len}, {eta} left {wide_bar}",
        None => "{msg}: {human_pos}",
    };
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    match now.of {
        Some(of) => bar.set_length(of as u64),
        None => bar.unset_length(),
    }
    bar.set_message(words(now.stage));
    bar.set_position(now.done as u64);
}

pub fn words(stage: Stage) -> String {
    let words = match stage {
        Stage::Seeds { found } => return format!("{found} generic solutions; seeds tried"),
        Stage::Loops { found } => return format!("{found} generic solutions; monodromy loops"),
        Stage::Starts => "random starts",
        Stage::Paths => "paths followed",
        Stage::Certificates => "assemblies certified",
        Stage::Boxes => "boxes proved",
        Stage::Proofs => "closed forms compared in letters",
        Stage::Samples => "samples",
        Stage::Motion => "steps of the inputs",
        Stage::Steps => "steps along the curve",
        Stage::Inputs => "input values searched for assemblies",
        Stage::Branches => "directions tried",
        Stage::Loci => "random starts for loci",
        Stage::Nodes => "nodes searched for modes",
        Stage::Reached => "nodes in modes reached",
        Stage::Boundary => "edges on which the boundary is located",
        Stage::Rows => "rows",
        Stage::Curves => "kinds of boundary followed",
        _ => "done",
    };
    words.into()
}
