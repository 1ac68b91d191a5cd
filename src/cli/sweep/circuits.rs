//! `linkwork sweep --circuits`

use std::f64::consts::TAU;

use linkwork::analysis::assemblies::{AssemblySolver, Wanted};
use linkwork::analysis::sweep::{CircuitsSettings, circuits};
use linkwork::mechanism::{Configuration, Mechanism};
use linkwork::output::sweep as output;
use linkwork::solve::Watch;
use linkwork::system::{Holdable, Question, check_count, sampling_range};

use super::super::asked::refusal;
use super::super::format::Format;
use super::super::watched::watched;
use super::super::{Answer, Refusal, style};
use super::Sweep;

impl Sweep {
    pub(super) fn list(&self, mechanism: &Mechanism) -> Result<Answer, Refusal> {
        let released = self.one_freedom(mechanism)?;
        let question = self.split.question(mechanism)?;
        check_count(&question).map_err(|error| refusal(&error, None))?;
        let kept = released.held_coordinates();
        let let_go = question.held_coordinates();
        let mut let_go = let_go.into_iter().filter(|held| !kept.contains(held));
        let (Some(Holdable::Joint(input)), None) = (let_go.next(), let_go.next()) else {
            return Err(Refusal(output::what_moves(None).render(style())));
        };
        let report = watched(|watch| {
            let solver = self.search.solver(&question, watch)?;
            let seeds = seeds(mechanism, &question, &solver, input, watch);
            let (held, settings) = (released.held(), CircuitsSettings::default());
            Ok(circuits(mechanism, &held, input, &seeds, &settings, watch))
        })?;
        let whole = report.circuits.iter().all(|circuit| circuit.whole);
        Ok(Answer {
            data: match self.format {
                Format::Csv => {
                    return Err(Refusal(
                        "error: circuits have no rows: choose another --format, or write the rows of \
                         one with --follow --format csv\n"
                            .into(),
                    ));
                }
                format => format.shown(&report),
            },
            remarks: String::new(),
            yes: whole && !report.circuits.is_empty(),
        })
    }
}

/// All assemblies at home and at values of the input spread over its range.
fn seeds(
    mechanism: &Mechanism,
    question: &Question,
    solver: &AssemblySolver,
    input: usize,
    watch: &Watch,
) -> Vec<Configuration<f64>> {
    const VALUES: u32 = 12;
    let joint = &mechanism.joints()[input];
    let (low, high) = match joint.limits {
        Some(limits) => limits,
        None if mechanism.repeats(input) => (joint.home, joint.home + TAU),
        None => sampling_range(joint, mechanism.characteristic_length()),
    };
    let wanted = Wanted {
        certificates: false,
        all_complex: false,
        starts: true,
    };
    let mut seeds = Vec::new();
    for k in 0..=VALUES {
        let mut at = question.start();
        if k > 0 {
            // uneven, so that nothing special is hit
            let part = (f64::from(k) - 0.618_034) / f64::from(VALUES);
            at.joints[input] = low + part * (high - low);
        }
        let report = solver.at_targets(&at, &question.held(), wanted, watch);
        seeds.extend(
            report
                .assemblies
                .iter()
                .map(|assembly| assembly.configuration(&at)),
        );
    }
    seeds
}
