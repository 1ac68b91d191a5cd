//! Warnings about a valid mechanism.

use std::collections::HashSet;

use super::frames::joints_of;
use super::model::{FixedStep, Formula, Given, Symbol};
use super::{Frame, Mechanism};
use crate::description::{
    AxisCondition, Beside, ClosureKind, Convention, Description, Problem, ProblemKind, Turned,
};

pub(super) fn inspect(
    mechanism: &Mechanism,
    description: &Description,
    problems: &mut Vec<Problem>,
) {
    for (joint, described) in mechanism.joints.iter().zip(&description.joints) {
        if let Some((low, high)) = joint.limits
            && !joint.allows(joint.home)
        {
            let kind = ProblemKind::HomeOutsideLimits {
                joint: joint.name.clone(),
                home: joint.home,
                low,
                high,
            };
            problems.push(kind.at(described.value.home.span.clone()));
        }
    }
    let chains = mechanism.chains.iter().zip(&description.chains);
    for (c, (chain, described)) in chains.enumerate() {
        for (i, (row, described)) in chain.rows.iter().zip(&described.value.rows).enumerate() {
            let a = mechanism.constant(&row.a);
            if a < 0.0 {
                let kind = ProblemKind::NegativeLinkLength {
                    chain: chain.name.clone(),
                    row: i + 1,
                    a,
                    turned: mechanism.turned_with(c, i),
                };
                problems.push(kind.at(described.a.span.clone()));
            }
        }
    }
    unused(mechanism, description, problems);
}

fn unused(mechanism: &Mechanism, description: &Description, problems: &mut Vec<Problem>) {
    let mut used: HashSet<Symbol> = HashSet::new();
    mechanism.for_each_formula(&mut |formula: &Formula| {
        used.extend(formula.names().map(|(symbol, _)| *symbol));
    });
    let entries = mechanism.affine_entries();
    let in_rows_and_lengths: HashSet<usize> = entries.flat_map(joints_of).collect();
    let outputs = description.outputs.iter().map(|output| &output.value);
    let coordinates = description.coordinates.iter();
    let places = coordinates.flat_map(|c| c.axes.places().flat_map(|place| place.entries()));
    let evaluated: HashSet<&str> = (outputs.chain(places))
        .flat_map(|entry| entry.expression.names().map(|(name, _)| name.as_str()))
        .collect();
    for (i, named) in description.parameters.iter().enumerate() {
        let name = named.name.value.clone();
        if !used.contains(&Symbol::Parameter(i)) && !evaluated.contains(name.as_str()) {
            let problem = ProblemKind::UnusedParameter { name };
            problems.push(problem.at(named.name.span.clone()));
        }
    }
    let inside = mechanism.joints_in_closures();
    for (i, named) in description.joints.iter().enumerate() {
        let name = named.name.value.clone();
        let span = named.name.span.clone();
        if !in_rows_and_lengths.contains(&i) {
            problems.push(ProblemKind::UnusedJoint { name }.at(span));
        } else if !mechanism.closures.is_empty() && !inside.contains(&i) {
            problems.push(ProblemKind::JointOutsideClosures { name }.at(span));
        }
    }
    let touched: HashSet<usize> = (mechanism.closures.iter().flat_map(|c| c.frames))
        .chain(mechanism.chains.iter().map(|chain| chain.on))
        .filter_map(|frame| match frame {
            Frame::Platform { platform } | Frame::OnPlatform { platform, .. } => Some(platform),
            _ => None,
        })
        .collect();
    for (i, named) in description.platforms.iter().enumerate() {
        if !touched.contains(&i) {
            let name = named.name.value.clone();
            problems.push(ProblemKind::UnusedPlatform { name }.at(named.name.span.clone()));
        }
    }
}

impl Mechanism {
    /// What turns with the x axis along the link of a row of a chain, counted from 0. `None` if something else is
    /// written in the frame that turns: a closure that its x axis affects, or a closed form.
    fn turned_with(&self, chain: usize, row: usize) -> Option<Turned> {
        let rows = self.chains[chain].rows.len();
        let (turning, beside) = match self.chains[chain].convention {
            Convention::Modified if row == 0 => (0, Beside::Base),
            Convention::Modified => (row, Beside::Row(row)),
            Convention::Standard if row + 1 == rows => (rows, Beside::Tip),
            Convention::Standard => (row + 1, Beside::Row(row + 2)),
        };
        let frame = Frame::Link {
            chain,
            row: turning,
        };
        let oriented = |kind: ClosureKind| kind.conditions().axes == AxisCondition::Oriented;
        let mut closures = self.closures.iter();
        let closed =
            closures.any(|closure| oriented(closure.kind) && closure.frames.contains(&frame));
        let printed = self.closed_forms.iter().any(|form| match &form.gives {
            Given::Pose {
                of, relative_to, ..
            } => [*of, *relative_to].contains(&frame),
            Given::Identities(_) => false,
        });
        let on_it = self.chains.iter().filter(|chain| chain.on == frame);
        (!closed && !printed).then(|| Turned {
            beside,
            on_it: on_it.map(|chain| chain.name.clone()).collect(),
        })
    }

    fn for_each_formula(&self, visit: &mut impl FnMut(&Formula)) {
        let fixed = |steps: &[FixedStep], visit: &mut dyn FnMut(&Formula)| {
            for step in steps {
                step.entries().iter().for_each(&mut *visit);
            }
        };
        for parameter in &self.parameters {
            visit(&parameter.definition);
        }
        for (home, limits) in &self.homes.joints {
            limits.iter().flatten().chain([home]).for_each(&mut *visit);
        }
        for home in &self.homes.platforms {
            fixed(home, visit);
        }
        for chain in self.chains.iter() {
            fixed(&chain.base, visit);
            fixed(&chain.tip, visit);
            for row in &chain.rows {
                visit(&row.alpha);
                visit(&row.a);
            }
        }
        for (_, steps) in self
            .platforms
            .iter()
            .flat_map(|platform| platform.frames.iter())
        {
            fixed(steps, visit);
        }
        for affine in self.affine_entries() {
            visit(&affine.constant);
            affine.terms.iter().for_each(|(_, factor)| visit(factor));
        }
        for form in self.closed_forms.iter() {
            form.locals.iter().for_each(|(_, formula)| visit(formula));
            match &form.gives {
                Given::Pose { entries, .. } => entries.iter().for_each(|(_, f)| visit(f)),
                Given::Identities(identities) => identities.iter().for_each(|(_, f)| visit(f)),
            }
        }
    }
}
