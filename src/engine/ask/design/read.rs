//! The parts of a design question, resolved.

use super::targets::{size, targets_of};
use super::weights::Weights;
use super::{Design, DesignError};
use crate::algebra::{Measure, SiUnit};
use crate::analysis::design::{Deviation, FoundEnd};
use crate::ask::{Question, study};
use crate::description::{
    Description, DesignDescription, DesignPart, DesignProblem, Entry, Named, Problem, ProblemKind,
    Role, Varied, nearest,
};
use crate::mechanism::{Measured, Mechanism};
use crate::number::Interval;
use crate::number::sorting::sort_by;
use crate::number::tolerance::SAME;
use crate::system::{Bundle, Held, Target, Value};

/// A number that varies.
pub(super) struct VariedNumber {
    pub parameter: usize,
    pub range: (f64, f64),
    /// The values that it may have, in ascending order; none where it may have all of its range.
    pub listed: Vec<f64>,
    pub unit: SiUnit,
    pub angle: bool,
}

/// A design question about a mechanism, its names resolved.
pub(super) struct Read {
    pub varied: Vec<VariedNumber>,
    pub targets: Vec<Target>,
    /// By how much each target may be missed.
    pub tolerances: Vec<Option<f64>>,
    pub held: Held<f64>,
    /// The first driven joint.
    pub driver: Option<usize>,
    /// True if the positions give its values.
    pub driven: bool,
    /// The size of what the targets describe, in m.
    pub size: f64,
}

impl Design {
    /// The mechanism file with the further unknowns among its parameters. Those whose ranges have no unit are angles or lengths
    /// as what they are used for, where the mechanism is known.
    pub(super) fn extended(&self, known: Option<&Mechanism>) -> Description {
        let mut description = self.mechanism.clone();
        for varied in &self.asked.vary {
            let name = &varied.name.value;
            if description
                .parameters
                .iter()
                .any(|of| of.name.value == *name)
            {
                continue;
            }
            // amid its values, whose unit it has
            let entries = varied.value.entries();
            let (Some(from), Some(to)) = (entries.first(), entries.last()) else {
                continue;
            };
            let plain = (entries.iter()).all(|of| of.expression.as_number().is_some());
            let unit = match known {
                Some(mechanism) if plain => self.unit_in_use(name, mechanism),
                _ => "",
            };
            let text = format!("(({}) + ({}))/2{unit}", from.expression, to.expression);
            let value = Entry::read(&text).unwrap_or_else(|_| from.clone());
            let named = Named::new(name.clone(), value);
            if let Some(coordinates) = &mut description.coordinates {
                coordinates.axes.parameters.push(named.clone());
            }
            description.parameters.push(named);
        }
        description
    }

    /// The mechanism file in which numbers follow from others as the question says.
    pub(super) fn tied(&self, mut description: Description) -> Result<Description, DesignError> {
        for (i, named) in self.asked.vary.iter().enumerate() {
            if let Varied::Equal(entry) = &named.value {
                let text = entry.expression.to_string();
                let tied = description.with_parameter(&named.name.value, &text);
                description = tied.map_err(|error| {
                    let why = error.to_string();
                    DesignProblem::Value { text, why }.of_value(DesignPart::Vary(i))
                })?;
            }
        }
        Ok(description)
    }

    /// A factor with the unit of the first place where the positions use a further unknown.
    fn unit_in_use(&self, unknown: &str, mechanism: &Mechanism) -> &'static str {
        let is_it = |name: &str| name.trim() == unknown;
        for named in self.asked.positions.iter().flatten() {
            let target = &named.name.value;
            let offsets = target.split_once('+').map_or("", |(_, offsets)| offsets);
            let mut values = named.value.iter().flat_map(|of| of.expression.names());
            let in_value = values.any(|(name, _)| is_it(name));
            let joint = mechanism.joint(target);
            let angle = joint.is_some_and(|joint| mechanism.joints()[joint].kind.is_angle())
                || [".roll", ".pitch", ".yaw"]
                    .iter()
                    .any(|end| target.ends_with(end));
            if in_value && angle {
                return "*(1 rad)";
            }
            if offsets.split(',').any(is_it) || in_value && named.value.len() > 1 {
                return "*(1 m)";
            }
        }
        ""
    }
}

impl Read {
    pub(super) fn new(
        asked: &DesignDescription,
        boxed: usize,
        mechanism: &std::sync::Arc<Mechanism>,
    ) -> Result<Self, DesignError> {
        let varied = varied(asked, mechanism)?;
        if asked.positions.is_empty() {
            return Err(DesignProblem::NoPositions.at(DesignPart::Whole));
        }
        let mut targets = Vec::new();
        let mut tolerances = Vec::new();
        let weights = Weights::of(&asked.weights, DesignPart::Weight, asked, boxed)?;
        let allowed = Weights::of(&asked.tolerances, DesignPart::Tolerance, asked, boxed)?;
        for (k, position) in asked.positions.iter().enumerate() {
            if position.is_empty() {
                let position = k + 1;
                return Err(DesignProblem::NoTargets { position }.at(DesignPart::Whole));
            }
            for (i, named) in position.iter().enumerate() {
                let part = DesignPart::Position(k, i);
                for mut target in targets_of(mechanism, (k, k >= boxed), named, part)? {
                    let weight = weights.value(mechanism, named, &target)?;
                    let tolerance = allowed.value(mechanism, named, &target)?;
                    target.weight *= weight.unwrap_or(1.0) / tolerance.unwrap_or(1.0);
                    targets.push(target);
                    tolerances.push(tolerance);
                }
            }
            let near = |(a, b): (&Target, &Target)| {
                let unit = match a.quantity.unit == SiUnit::METRE {
                    true => size(mechanism, &targets),
                    false => 1.0,
                };
                a.quantity == b.quantity && (a.value - b.value).abs() <= SAME * unit
            };
            let of = |k: usize| targets.iter().filter(move |of| of.configuration == k);
            let same = |first: &usize| {
                of(*first).count() == of(k).count() && of(*first).zip(of(k)).all(near)
            };
            if let Some(first) = (0..k).find(same) {
                let (first, second) = (first + 1, k + 1);
                let problem = DesignProblem::SamePositions { first, second };
                return Err(problem.at(DesignPart::Position(k, 0)));
            }
        }
        // one weight is the largest
        let weighed = !asked.weights.is_empty() || !asked.tolerances.is_empty();
        let aims = || targets.iter().filter(|of| !of.exact);
        let most = aims().map(|of| of.weight).fold(0.0, f64::max);
        if weighed && most > 0.0 {
            let aims = targets.iter_mut().filter(|of| !of.exact);
            aims.for_each(|of| of.weight /= most);
        }
        let used = |parameter: usize| {
            let of = |target: &Target| {
                let mut names = target.quantity.measured();
                names.any(|name| *name == Measured::Parameter(parameter))
            };
            let name = &*mechanism.parameters()[parameter].name;
            let idle = |problem: &Problem| matches!(&problem.kind, ProblemKind::UnusedParameter { name: idle } if idle == name);
            targets.iter().any(of) || !mechanism.warnings().iter().any(idle)
        };
        for (i, of) in asked.vary.iter().enumerate() {
            let name = &of.name.value;
            let mut parameters = mechanism.parameters().iter();
            if parameters
                .position(|of| *of.name == **name)
                .is_some_and(|of| !used(of))
            {
                let known = mechanism.parameters().iter().map(|of| &*of.name);
                let known = known.filter(|known| known != name);
                let (name, suggestion) = (name.clone(), nearest(name, known).map(str::to_owned));
                return Err(DesignProblem::Unused { name, suggestion }.at(DesignPart::Vary(i)));
            }
        }
        let question = Question::new(mechanism.clone());
        let held = match question.released() {
            Ok(question) => question.with_spins_still().held(),
            Err(_) => Held::nothing(mechanism),
        };
        let roles = mechanism.joints().iter();
        let driver = roles.clone().position(|joint| joint.role == Role::Actuated);
        let given = |target: &Target| target.exact;
        Ok(Read {
            driven: targets.iter().any(given),
            size: size(mechanism, &targets),
            varied,
            targets,
            tolerances,
            held,
            driver,
        })
    }

    pub(super) fn ranges(&self) -> Vec<(f64, f64)> {
        self.varied.iter().map(|of| of.range).collect()
    }

    /// The values that all parameters of the mechanism can have in the ranges.
    pub(super) fn possible(&self, mechanism: &Mechanism) -> Vec<Interval> {
        let independent = mechanism.independent_parameters().into_iter();
        let value = |i: usize| match self.varied.iter().find(|of| of.parameter == i) {
            Some(of) => Interval {
                low: of.range.0,
                high: of.range.1,
            },
            None => Interval::point(mechanism.parameters()[i].value),
        };
        let values: Vec<Interval> = independent.map(value).collect();
        let any = Interval {
            low: f64::NEG_INFINITY,
            high: f64::INFINITY,
        };
        let all = mechanism.parameters_from(&values);
        all.unwrap_or_else(|_| vec![any; mechanism.parameters().len()])
    }

    /// The residuals of the targets.
    pub(super) fn missed(&self, bundle: &Bundle, found: &FoundEnd) -> Option<Vec<Deviation>> {
        let deviations = bundle.deviations(&found.at)?;
        let all = deviations.into_iter().zip(&self.tolerances);
        let aims = all.filter(|((target, _), _)| !target.exact);
        let missed = aims.map(|((target, deviation), tolerance)| Deviation {
            tolerance: *tolerance,
            ..Deviation::of(target, deviation)
        });
        Some(missed.collect())
    }

    /// Closures and targets of all positions.
    pub(super) fn bundle<'m>(&self, mechanism: &'m Mechanism, positions: usize) -> Bundle<'m> {
        // one unit is a metre or a radian, or for lengths the size of the task
        let unit = |of: &VariedNumber| match of.unit {
            unit if unit == SiUnit::METRE => (of.parameter, self.size),
            _ => (of.parameter, 1.0),
        };
        let numbers: Vec<(usize, f64)> = self.varied.iter().map(unit).collect();
        let bundle = Bundle::new(mechanism, self.held.clone(), &numbers).within(self.ranges());
        let bundle = self.targets.iter().fold(bundle, |bundle, target| {
            let with = bundle.target(target.clone());
            with.expect("rates and forces were refused")
        });
        bundle.written(positions)
    }
}

fn varied(
    asked: &DesignDescription,
    mechanism: &Mechanism,
) -> Result<Vec<VariedNumber>, DesignError> {
    let independent = mechanism.independent_parameters();
    let added = |i: usize| mechanism.parameters()[i].name.to_string();
    let mut all = Vec::new();
    for (i, named) in asked.vary.iter().enumerate() {
        let (part, name) = (DesignPart::Vary(i), &named.name.value);
        if matches!(named.value, Varied::Equal(_)) {
            continue;
        }
        if mechanism.joint(name).is_some() {
            return Err(DesignProblem::VariesJoint { name: name.clone() }.at(part));
        }
        let parameters = 0..mechanism.parameters().len();
        let Some(parameter) = parameters.clone().find(|of| added(*of) == *name) else {
            let names: Vec<String> = parameters.map(added).collect();
            let suggestion = nearest(name, names.iter().map(String::as_str)).map(str::to_owned);
            let name = name.clone();
            return Err(DesignProblem::NotAName { name, suggestion }.at(part));
        };
        if !independent.contains(&parameter) {
            return Err(DesignProblem::VariesFormula { name: name.clone() }.at(part));
        }
        let number = |entry: &Entry| {
            let text = entry.expression.to_string();
            let value = Value::Text(text.clone());
            study::number(mechanism, parameter, &value).map_err(|error| {
                let why = error.to_string();
                DesignProblem::Value { text, why }.of_value(part)
            })
        };
        let listed = matches!(named.value, Varied::OneOf(_));
        let values = named.value.entries().iter().map(number);
        let mut values = values.collect::<Result<Vec<f64>, _>>()?;
        if listed {
            sort_by(&mut values, f64::total_cmp);
            values.dedup();
        }
        let (Some(&from), Some(&to)) = (values.first(), values.last()) else {
            continue;
        };
        if from > to {
            return Err(DesignProblem::Reversed { name: name.clone() }.of_value(part));
        }
        let measure = match mechanism.measure_in_use(parameter) {
            Measure::Open | Measure::Number => mechanism.parameters()[parameter].measure,
            known => known,
        };
        all.push(VariedNumber {
            parameter,
            range: (from, to),
            listed: if listed { values } else { Vec::new() },
            unit: measure.si_unit().unwrap_or(SiUnit::ONE),
            angle: measure == Measure::Angle,
        });
    }
    Ok(all)
}
