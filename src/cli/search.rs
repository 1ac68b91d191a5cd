//! The search for all assemblies, as commands make it.

use std::cell::Cell;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Args;
use linkwork::analysis::assemblies::{
    AssembliesError, AssembliesSettings, AssemblySolver, GenericSolutions, Progress,
};
use linkwork::output::assemblies::progress;
use linkwork::system::Question;

use super::{Refusal, say};

#[derive(Args)]
pub struct Search {
    /// Seed of random starts: it decides the way to the answer, not the answer
    #[arg(long, default_value_t = AssembliesSettings::default().seed)]
    pub seed: u64,
    /// Keep the generic solutions in a file; if it has those of this question, nothing is searched
    #[arg(long, value_name = "FILE")]
    store: Option<PathBuf>,
}

impl Search {
    /// The solver for a question, from the store if it has it.
    pub fn solver(&self, question: &Question) -> Result<AssemblySolver, Refusal> {
        let (mechanism, held) = (question.mechanism(), question.held());
        if let Some(path) = &self.store
            && let Some(stored) = load(path)?
        {
            match AssemblySolver::from_stored(mechanism, &held, stored) {
                Err(AssembliesError::StoredForAnotherQuestion) => say(&format!(
                    "note: {} has the solutions of another question and is written anew\n",
                    path.display()
                )),
                solver => return solver.map_err(|error| Refusal(format!("error: {error}\n"))),
            }
        }
        let settings = AssembliesSettings {
            seed: self.seed,
            ..AssembliesSettings::default()
        };
        let tell = teller();
        let solver = AssemblySolver::watched(mechanism, &held, &settings, &tell)
            .map_err(|error| Refusal(format!("error: {error}\n")))?;
        if let Some(path) = &self.store {
            save(path, solver.generic())?;
        }
        Ok(solver)
    }
}

/// Says every second how far it is.
pub fn teller() -> impl Fn(Progress) {
    let told = Cell::new(Instant::now());
    move |now: Progress| {
        if told.get().elapsed() > Duration::from_secs(1) {
            told.set(Instant::now());
            say(&progress(&now));
        }
    }
}

/// What is stored; nothing if there is no such file yet.
fn load(path: &Path) -> Result<Option<GenericSolutions>, Refusal> {
    let refused = |reason: &dyn std::fmt::Display| {
        let path = path.display();
        Refusal(format!(
            "error: {path} does not hold stored solutions: {reason}\n"
        ))
    };
    match std::fs::read_to_string(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(refused(&error)),
        Ok(text) => GenericSolutions::from_text(&text)
            .map(Some)
            .map_err(|error| refused(&error)),
    }
}

/// Written beside the store and then put in its place, so that it is never half written.
fn save(path: &Path, generic: &GenericSolutions) -> Result<(), Refusal> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(".part");
    let written = std::fs::write(&beside, generic.to_text());
    written
        .and_then(|()| std::fs::rename(&beside, path))
        .map_err(|error| {
            let path = path.display();
            Refusal(format!(
                "error: the solutions cannot be stored in {path}: {error}\n"
            ))
        })
}
