//! Proof by interval arithmetic that the rows of a motion lie on one branch.
//!
//! A box round two configurations is certified if, for all inputs between theirs, it holds exactly one zero of as many
//! combinations of the closures as there are joint variables (Neumaier 1990, §5.1): then one continuous branch leads from
//! the one to the other, and the inputs do not turn back on it. A box that is too wide is halved at the middle of the
//! inputs. Neighbouring boxes share the small box round the configuration between them in which its exact place is.

mod moving;

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::mechanism::{Configuration, Mechanism};
use crate::number::Interval;
use crate::number::sorting::sort_by;
use crate::solve::{Conditions, Sides, Stage, Watch, holds_one, nearest};
use crate::system::{Driven, Held, JointSpace, Unfit};
use moving::{MovingInputs, joint};

/// Half the side of the box that holds a configuration's exact place, in rad or characteristic lengths.
const HALF_SIDE: f64 = 1e-8;

/// Largest number of halvings of the way between two rows.
const HALVINGS: usize = 24;

/// Parts of that way that are halved at most, all of one length.
const MOST_PARTS: usize = 1024;

/// Joint variables at most: a box takes as many operations as their cube.
const MOST_VARIABLES: usize = 100;

/// Certificate of the branch between the rows of a motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Certificate {
    /// The reason if nothing is certified.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unfit: Option<Unfit>,
    /// Boxes in which the branch is certified, end to end.
    pub boxes: usize,
    /// Parts of the motion in which it is not.
    pub uncertified: Vec<Uncertified>,
}

impl Certificate {
    /// True if all rows are proved to lie on one branch.
    pub fn is_whole(&self) -> bool {
        self.unfit.is_none() && self.uncertified.is_empty()
    }
}

/// A part of a motion in which the branch is not certified: near a dead point or a crossing, as a rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Uncertified {
    /// The inputs where it begins, in rad or m.
    pub from: Vec<f64>,
    /// The inputs where it ends.
    pub to: Vec<f64>,
}

/// Takes the rows one after the other.
pub(super) struct RowCertifier<'m> {
    mechanism: &'m Mechanism,
    inputs: &'m [Driven],
    space: JointSpace,
    latest: Option<ExactPlace>,
    certificate: Certificate,
    watch: &'m Watch<'m>,
}

/// A configuration on the way.
#[derive(Clone)]
struct ExactPlace {
    inputs: Vec<f64>,
    variables: Vec<f64>,
    /// The box that holds its exact place; none where it is singular.
    exact: Option<Sides>,
}

impl<'m> RowCertifier<'m> {
    /// `held` holds the inputs too; it is `None` where one of them has no value.
    ///
    /// # Errors
    /// If no branch of the mechanism can be certified.
    pub fn new(
        mechanism: &'m Mechanism,
        held: Option<Held<f64>>,
        inputs: &'m [Driven],
        start: &Configuration<f64>,
        watch: &'m Watch<'m>,
    ) -> Result<Self, Unfit> {
        let moving: Vec<usize> = inputs.iter().filter_map(joint).collect();
        let held = held.ok_or(Unfit::Turns)?;
        let space = JointSpace::new(mechanism, &held, &moving, start)?;
        let given = space.enclosure.unknowns().len();
        if given > MOST_VARIABLES {
            let most = MOST_VARIABLES;
            return Err(Unfit::Large { given, most });
        }
        Ok(RowCertifier {
            mechanism,
            inputs,
            space,
            latest: None,
            certificate: Certificate::default(),
            watch,
        })
    }

    /// The next row.
    pub fn row(&mut self, at: &Configuration<f64>) {
        let (space, latest) = (&mut self.space, self.latest.as_ref());
        // angles of platforms are known modulo a turn
        let near = |x: f64, angle: bool, known: Option<f64>| match known {
            Some(known) if angle => x + ((known - x) / TAU).round() * TAU,
            _ => x,
        };
        let inputs = self.inputs.iter().enumerate().map(|(i, input)| {
            let angle = input.coordinate.is_angle(self.mechanism);
            let angle = angle && input.coordinate.platform().is_some();
            let known = latest.map(|latest| latest.inputs[i]);
            near(input.coordinate.of(self.mechanism, at), angle, known)
        });
        let inputs = inputs.collect();
        let mut variables = space.of(self.mechanism, at);
        let joints = self.mechanism.joints().len();
        for (i, &joint) in space.enclosure.unknowns().iter().enumerate() {
            let known = latest.map(|latest| latest.variables[i]);
            variables[i] = near(variables[i], joint >= joints, known);
        }
        let row = ExactPlace::new(space, self.inputs, inputs, variables);
        if let Some(latest) = self.latest.replace(row.clone()) {
            self.join(latest, row);
        }
    }

    pub fn certificate(self) -> Certificate {
        self.certificate
    }

    /// Certifies the branch from one row to the next, or notes where that fails.
    fn join(&mut self, from: ExactPlace, to: ExactPlace) {
        // with the part of the way that is gone before each
        let mut parts = vec![(0.0, from, to)];
        let mut open: Vec<(f64, ExactPlace, ExactPlace)> = Vec::new();
        let mut length = 1.0;
        for halvings in 0..=HALVINGS {
            length *= 0.5;
            let stopped = (self.watch).stops(Stage::Boxes, self.certificate.boxes, None);
            let last = halvings == HALVINGS || parts.len() > MOST_PARTS || stopped;
            let mut halves = Vec::new();
            for (gone, from, to) in parts {
                if self.holds(&from, &to) {
                    self.certificate.boxes += 1;
                    continue;
                }
                match (!last).then(|| self.between(&from, &to)).flatten() {
                    Some(middle) => {
                        halves.push((gone, from, middle.clone()));
                        halves.push((gone + length, middle, to));
                    }
                    None => open.push((gone, from, to)),
                }
            }
            parts = halves;
        }
        sort_by(&mut open, |a, b| a.0.total_cmp(&b.0));
        open.iter().for_each(|(_, from, to)| self.note(from, to));
    }

    /// True if one continuous branch is proved to lead from one place to another.
    fn holds(&mut self, from: &ExactPlace, to: &ExactPlace) -> bool {
        let (Some(start), Some(end), Some(sides)) = (&from.exact, &to.exact, around(from, to))
        else {
            return false;
        };
        let inside = |exact: &Sides| {
            let mut pairs = sides.iter().zip(exact);
            pairs.all(|(a, b)| a.low < b.low && b.high < a.high)
        };
        let moving = MovingInputs::new(&mut self.space, self.inputs, &from.inputs, &to.inputs);
        inside(start) && inside(end) && holds_one(&moving, &sides, &mut moving.work())
    }

    /// The place between two others, one of which is regular at least.
    fn between(&mut self, from: &ExactPlace, to: &ExactPlace) -> Option<ExactPlace> {
        let regular = from.exact.is_some() || to.exact.is_some();
        regular.then(|| ExactPlace::between(&mut self.space, self.inputs, from, to))?
    }

    /// Notes a part that is not certified; a certified stretch between two such parts and not much longer is theirs.
    fn note(&mut self, from: &ExactPlace, to: &ExactPlace) {
        let apart = |a: &[f64], b: &[f64]| {
            let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs());
            apart.fold(0.0, f64::max)
        };
        let (start, end) = (&from.inputs, &to.inputs);
        match self.certificate.uncertified.last_mut() {
            Some(last) if apart(&last.to, start) <= 10.0 * apart(start, end) => {
                last.to.clone_from(end);
            }
            _ => self.certificate.uncertified.push(Uncertified {
                from: start.clone(),
                to: end.clone(),
            }),
        }
    }
}

impl ExactPlace {
    fn new(
        space: &mut JointSpace,
        driven: &[Driven],
        inputs: Vec<f64>,
        variables: Vec<f64>,
    ) -> Self {
        let there = MovingInputs::new(space, driven, &inputs, &inputs);
        let sides: Sides = variables
            .iter()
            .map(|&x| Interval::around(x, HALF_SIDE))
            .collect();
        let exact = holds_one(&there, &sides, &mut there.work()).then_some(sides);
        ExactPlace {
            inputs,
            variables,
            exact,
        }
    }

    /// The place at the middle of the inputs; `None` if nothing regular is found there.
    fn between(
        space: &mut JointSpace,
        driven: &[Driven],
        from: &ExactPlace,
        to: &ExactPlace,
    ) -> Option<Self> {
        let middle = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect()
        };
        let inputs = middle(&from.inputs, &to.inputs);
        let there = MovingInputs::new(space, driven, &inputs, &inputs);
        let start = middle(&from.variables, &to.variables);
        let variables = nearest(&there, &start, &mut there.work())?;
        let place = ExactPlace::new(space, driven, inputs, variables);
        place.exact.is_some().then_some(place)
    }
}

/// A box round two places, wider than the way between them is long; `None` if that is not finite.
fn around(from: &ExactPlace, to: &ExactPlace) -> Option<Sides> {
    let pairs = || from.variables.iter().zip(&to.variables);
    let way = pairs().map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let side = |(a, b): (&f64, &f64)| {
        let half = 0.5 * (a - b).abs();
        Interval::around(0.5 * (a + b), half + 0.3 * way + 4.0 * HALF_SIDE)
    };
    way.is_finite().then(|| pairs().map(side).collect())
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::RowCertifier;
    use crate::mechanism::{Configuration, Mechanism};
    use crate::solve::Watch;
    use crate::system::{Coordinate, Driven, Held};

    /// The shipped 4-bar, with lengths 5, 1, 3 and 4 m, in closed form.
    fn assembled(mechanism: &Mechanism, crank: f64, side: f64) -> Configuration<f64> {
        let (x, y) = (crank.cos() - 5.0, crank.sin());
        let diagonal = x.hypot(y);
        let at_pivot = (16.0 + diagonal * diagonal - 9.0) / (8.0 * diagonal);
        let rocker = y.atan2(x) - side * at_pivot.acos();
        let coupler = (4.0 * rocker.sin() - y).atan2(4.0 * rocker.cos() - x);
        let mut at = mechanism.home();
        for (name, value) in [
            ("theta1", crank),
            ("phi2", coupler - crank),
            ("phi1", rocker),
        ] {
            at.joints[mechanism.joint(name).unwrap()] = value;
        }
        at
    }

    #[test]
    fn rows_on_two_branches_are_not_certified() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../mechanisms/four_bar.ron");
        let mechanism = Mechanism::new(&Mechanism::read(path).unwrap().1).unwrap();
        let mut held = Held::nothing(&mechanism);
        held.joints[0] = true;
        let watch = Watch::none();
        let inputs = [Driven {
            coordinate: Coordinate::Joint(0),
            from: 1.0,
            to: 1.2,
        }];
        for (end, same) in [(1.0, true), (-1.0, false)] {
            let rows = [(1.0, 1.0), (1.2, end)];
            let rows = rows.map(|(crank, side)| assembled(&mechanism, crank, side));
            let held = Some(held.clone());
            let certifier = RowCertifier::new(&mechanism, held, &inputs, &rows[0], &watch);
            let mut certifier = certifier.unwrap();
            rows.iter().for_each(|row| certifier.row(row));
            assert_eq!(certifier.certificate().is_whole(), same);
        }
    }
}
