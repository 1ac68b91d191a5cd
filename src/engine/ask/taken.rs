//! The demands that each analysis takes.

use super::{AskError, Item, Question, Role};

/// The roles of demands that each analysis takes beside those that hold, free and guess.
const TAKES: [(&str, &[Role]); 15] = {
    use Role::*;
    [
        ("solve", &[]),
        ("assemblies", &[]),
        ("mobility", &[Lock]),
        ("velocity", &[Rate, Acceleration, Point]),
        ("statics", &[Wrench, Load, Without]),
        ("equilibrium", &[Lock, Wrench, Load, Without]),
        ("simulate", &[Rate, Lock, Point, Wrench, Load, Without]),
        ("singularities", &[Output, Point]),
        ("singularities along inputs", &[Input, Output, Point]),
        (
            "sweep",
            &[Input, Output, Point, Report, Dwell, Wrench, Load, Without],
        ),
        ("circuits", &[Point]),
        ("workspace", &[Input]),
        ("generate", &[]),
        ("generate with forces", &[Wrench, Load, Without]),
        (
            "study",
            &[
                Output,
                Report,
                Rate,
                Acceleration,
                Wrench,
                Load,
                Without,
                Vary,
                Deviate,
            ],
        ),
    ]
};

impl Question {
    /// Refuses demands that an analysis would not use.
    pub(super) fn takes(&self, analysis: &'static str) -> Result<(), AskError> {
        let takes = |(name, roles): &(&str, &[Role]), role| {
            let everywhere = [Role::Hold, Role::Free, Role::Guess];
            *name == analysis && (everywhere.contains(&role) || roles.contains(&role))
        };
        let mut demands = self.demands.iter().enumerate();
        match demands.find(|(_, demand)| !TAKES.iter().any(|of| takes(of, demand.role))) {
            None => Ok(()),
            Some((index, demand)) => Err(AskError::Unused {
                item: Item::new(index),
                analysis,
                demand: demand.to_string(),
                takers: (TAKES.iter())
                    .filter(|(_, roles)| roles.contains(&demand.role))
                    .map(|(name, _)| *name)
                    .collect(),
            }),
        }
    }
}
