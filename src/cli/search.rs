//! The search for all assemblies, as commands make it.

use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::assemblies::{AssembliesError, AssembliesSettings, AssemblySolver};
use linkwork::solve::Watch;
use linkwork::system::Question;

use super::store::Store;
use super::{Refusal, say};

#[derive(Args)]
pub struct Search {
    /// Seed of random starts: it decides the way to the answer, not the answer
    #[arg(long, value_parser = seed, allow_negative_numbers = true)]
    #[arg(default_value_t = AssembliesSettings::default().seed)]
    pub seed: u64,
    /// Keep the generic solutions in a file; if it has those of this question, nothing is searched
    #[arg(long, value_name = "FILE")]
    store: Option<PathBuf>,
}

/// The seed that a text stands for.
pub fn seed(text: &str) -> Result<u64, String> {
    let wanted = format!("a seed is a whole number from 0 to {}", u64::MAX);
    text.parse().map_err(|_| wanted)
}

/// The number of a mode that a text stands for.
pub fn mode(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|mode| *mode > 0);
    number.ok_or_else(|| {
        "a mode is a whole number from 1 on, as `linkwork assemblies` numbers them".into()
    })
}

impl Search {
    /// The solver for a question, from the store if it has it.
    pub fn solver(&self, question: &Question, watch: &Watch) -> Result<AssemblySolver, Refusal> {
        let (mechanism, held) = (question.mechanism(), question.held());
        let store = self.store.as_deref().map(Store::at).transpose()?;
        if let Some(store) = &store {
            if let Some(stored) = store.read()? {
                match AssemblySolver::from_stored(mechanism, &held, stored) {
                    Err(AssembliesError::StoredForAnotherQuestion) => {
                        store.check_writable()?;
                        say(&format!(
                            "note: {} has the solutions of another question and is written anew\n",
                            store.path()
                        ));
                    }
                    solver => return solver.map_err(|error| Refusal(format!("error: {error}\n"))),
                }
            }
            store.check_writable()?;
        }
        let settings = AssembliesSettings {
            seed: self.seed,
            ..AssembliesSettings::default()
        };
        let solver = AssemblySolver::new(mechanism, &held, &settings, watch)
            .map_err(|error| Refusal(format!("error: {error}\n")))?;
        // the answer is not lost with its store
        if let Some(store) = &store
            && !solver.is_interrupted()
            && let Err(error) = store.write(solver.generic())
        {
            say(&format!(
                "warning: the solutions could not be stored in {}: {error}\n",
                store.path()
            ));
        }
        Ok(solver)
    }
}
