//! The options of every search for assemblies.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use linkwork::analysis::assemblies::AssembliesSettings;

use super::Refusal;
use super::question_options::Posed;
use super::store::FileStore;

#[derive(Args)]
pub struct SearchArgs {
    /// Seed of random starts; where several assemblies exist it may decide which of them is found
    #[arg(long, value_parser = seed, allow_negative_numbers = true)]
    #[arg(default_value_t = AssembliesSettings::default().seed)]
    pub seed: u64,
    /// Keep the generic solutions in a file; if it already has those of this question, the search is skipped
    #[arg(long, value_name = "FILE")]
    store: Option<PathBuf>,
}

pub fn seed(text: &str) -> Result<u64, String> {
    let wanted = format!("a seed is a whole number from 0 to {}", u64::MAX);
    text.parse().map_err(|_| wanted)
}

pub fn mode(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|mode| *mode > 0);
    number.ok_or_else(|| {
        "a mode is a whole number from 1 on, as `linkwork assemblies` numbers them".into()
    })
}

impl SearchArgs {
    pub fn pose(&self, posed: &mut Posed) -> Result<(), Refusal> {
        posed.ask_with(|question| question.seed(self.seed));
        if let Some(path) = &self.store {
            let store = Arc::new(FileStore::at(path)?);
            posed.ask_with(|question| question.store(store));
        }
        Ok(())
    }
}
