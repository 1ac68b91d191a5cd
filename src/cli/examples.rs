//! `linkwork examples`

use clap::Args;

use super::{Answer, Refusal, shipped};

/// List the mechanisms that the program brings with it, or print one.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork examples\n  \
    linkwork examples jansen_leg | linkwork draw - --svg leg.svg")]
pub struct Examples {
    /// Print the file of this example
    name: Option<String>,
}

impl Examples {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let data = match &self.name {
            Some(name) => shipped::find(name)?.text,
            None => {
                let all = shipped::all();
                let width = all.iter().map(|of| of.name.len()).max().unwrap_or(0);
                let lines = all.iter();
                lines
                    .map(|of| format!("{:width$}  {}\n", of.name, of.about()))
                    .collect()
            }
        };
        Ok(Answer::yes(data, String::new()))
    }
}
