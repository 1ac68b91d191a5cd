//! Warnings about a valid mechanism.

use std::collections::HashSet;

use super::frames::joints_of;
use super::model::{FixedStep, Formula, GivenForm, Symbol};
use super::{Frame, Mechanism, relation};
use crate::algebra::Measure;
use crate::description::{
    AxisCondition, Beside, ClosureKind, Convention, Description, Displacement, Problem,
    ProblemKind, Turned,
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
    mechanism.for_each_formula(&mut |formula: &Formula, _: Measure| {
        used.extend(formula.names().map(|(symbol, _)| *symbol));
    });
    let entries = mechanism.affine_entries();
    let related = mechanism.closures.iter().flat_map(|of| &of.relation);
    let related = related.flat_map(relation::joints_of);
    let in_rows_and_lengths: HashSet<usize> = entries.flat_map(joints_of).chain(related).collect();
    let outputs = description.outputs.iter().map(|output| &output.value);
    let coordinates = description.coordinates.iter();
    let drawn = coordinates.flat_map(|made| made.axes.entries());
    let evaluated: HashSet<&str> = (outputs.chain(drawn))
        .flat_map(|entry| entry.expression.names().map(|(name, _)| name.as_str()))
        .collect();
    let in_loads = description.loads.names();
    for (i, named) in description.parameters.iter().enumerate() {
        let name = named.name.value.clone();
        if !used.contains(&Symbol::Parameter(i))
            && !evaluated.contains(name.as_str())
            && !in_loads.contains(&name)
        {
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
    /// The parts that turn with the x axis along the link of a row of a chain, counted from 0. `None` if something else
    /// is written in the frame that turns: a closure that its x axis affects, or a closed form.
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
            GivenForm::Pose {
                of, relative_to, ..
            } => [*of, *relative_to].contains(&frame),
            GivenForm::Identities(_) => false,
        });
        let on_it = self.chains.iter().filter(|chain| chain.on == frame);
        let tilted = !self.chains[chain].rows[row].beta.is_zero();
        (!closed && !printed && !tilted).then(|| Turned {
            beside,
            on_it: on_it.map(|chain| chain.name.clone()).collect(),
        })
    }

    /// The dimension of a parameter: that of the units in its definition, otherwise the only one that fits all places where
    /// it stands.
    pub fn measure_in_use(&self, parameter: usize) -> Measure {
        let own = self.parameters[parameter].measure;
        if matches!(own, Measure::Length | Measure::Angle) {
            return own;
        }
        let fits = |measure: Measure| {
            let of = |symbol: &Symbol| match *symbol {
                Symbol::Parameter(i) if i == parameter => measure,
                Symbol::Parameter(i) => self.parameters[i].measure,
                Symbol::Joint(_) | Symbol::Local(_) => Measure::Open,
            };
            let mut fits = true;
            self.for_each_formula(&mut |formula: &Formula, wanted: Measure| {
                fits &= wanted == Measure::Open || formula.check_measure(wanted, &of).is_ok();
            });
            fits
        };
        match (fits(Measure::Length), fits(Measure::Angle)) {
            (true, false) => Measure::Length,
            (false, true) => Measure::Angle,
            _ => own,
        }
    }

    /// Visits every formula, with the dimension that it must have; open where it may have any.
    fn for_each_formula(&self, visit: &mut impl FnMut(&Formula, Measure)) {
        let fixed = |steps: &[FixedStep], visit: &mut dyn FnMut(&Formula, Measure)| {
            for step in steps {
                let wanted = match step {
                    Displacement::Rotate(..) => Measure::Angle,
                    Displacement::Translate(..) | Displacement::TranslateBy(_) => Measure::Length,
                };
                step.entries().iter().for_each(|entry| visit(entry, wanted));
            }
        };
        for parameter in &self.parameters {
            visit(&parameter.definition, Measure::Open);
        }
        for (joint, (home, limits)) in self.joints.iter().zip(&self.homes.joints) {
            let wanted = match joint.kind.is_angle() {
                true => Measure::Angle,
                false => Measure::Length,
            };
            let values = limits.iter().flatten().chain([home]);
            values.for_each(|value| visit(value, wanted));
        }
        for home in &self.homes.platforms {
            fixed(home, visit);
        }
        for chain in self.chains.iter() {
            fixed(&chain.base, visit);
            fixed(&chain.tip, visit);
            for row in &chain.rows {
                visit(&row.alpha, Measure::Angle);
                visit(&row.a, Measure::Length);
                visit(&row.d.constant, Measure::Length);
                visit(&row.theta.constant, Measure::Angle);
                visit(&row.beta, Measure::Angle);
            }
        }
        for (_, steps) in self
            .platforms
            .iter()
            .flat_map(|platform| platform.frames.iter())
        {
            fixed(steps, visit);
        }
        for length in self.closures.iter().filter_map(|of| of.length.as_ref()) {
            visit(&length.constant, Measure::Length);
        }
        let mut open = |formula: &Formula| visit(formula, Measure::Open);
        let related = self.closures.iter().flat_map(|of| &of.relation);
        related.for_each(&mut open);
        let terms = self.affine_entries().flat_map(|affine| &affine.terms);
        terms.for_each(|(_, factor)| open(factor));
        for form in self.closed_forms.iter() {
            form.locals.iter().for_each(|(_, formula)| open(formula));
            match &form.gives {
                GivenForm::Pose { entries, .. } => entries.iter().for_each(|(_, f)| open(f)),
                GivenForm::Identities(identities) => identities.iter().for_each(|(_, f)| open(f)),
            }
        }
    }
}
