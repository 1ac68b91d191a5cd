//! Mechanisms whose numbers are rounded: the nearest linkage that closes exactly.
//!
//! A loop that closes only for special dimensions, as planar and spherical ones in space or Bennett's, no longer moves once
//! these are rounded. It is recognised by finite motion. Directions that closures resist less than rounding explains are
//! followed as if they were free; where what is left open stays within what the rounding of the file's numbers explains, the
//! nearest numbers are sought for which all configurations on the way close (a [`Bundle`] with the numbers of the file as its
//! shared unknowns, the change of each measured by its own rounding). A structure does not pass: along the way of a shaky one
//! what is left grows with the square of the way, and a frame that only nearly closes needs a larger change.

mod explained;
mod snap;
mod walk;

use crate::algebra::Measure;
use crate::description::{Description, Literal, Problem, roundings};
use crate::mechanism::{Configuration, Mechanism, NumberChange, Rounded, Rounding};
use crate::solve::{LeastSquares, LevenbergMarquardt};
use crate::system::{Bundle, Bundled, Gap, Held};
use explained::least_largest;
pub use snap::{Snap, snap};
use walk::Walk;

/// Changes up to so many roundings are explained by them: half a unit of the last digit, and what arithmetic adds.
const EXPLAINED: f64 = 1.05;

/// Beyond so many nothing of it is rounding; between the two it is not decided.
const BEYOND: f64 = 1.5;

/// The most unknowns of a mechanism that is looked at: each singular value decomposition grows as their cube.
const MOST_UNKNOWNS: usize = 150;

/// The mechanism of a description, and its description: where loops close within the rounding of the numbers, those of the
/// nearest linkage that closes exactly, which [says so](Mechanism::rounding). Where the file gives a
/// tolerance every number may be off by it, angles by it over the characteristic length; otherwise each by half a unit of its
/// last digit.
///
/// # Errors
/// All problems of the description.
pub fn posed(description: Description) -> Result<(Description, Mechanism), Vec<Problem>> {
    let mechanism = Mechanism::new(&description)?;
    Ok(match Numbers::of(&description, &mechanism).nearest() {
        None => (description, mechanism),
        Some(Found::Undecided(change)) => {
            let mechanism = mechanism.with_rounding(Rounding::Undecided { change });
            (description, mechanism)
        }
        Some(Found::Nearest(found)) => {
            let (description, mechanism, rounded) = *found;
            (
                description,
                mechanism.with_rounding(Rounding::Nearest(rounded)),
            )
        }
    })
}

/// A file with its numbers that may have been rounded.
struct Numbers<'a> {
    description: &'a Description,
    mechanism: &'a Mechanism,
    literals: Vec<Literal>,
    /// The most by which each literal is off, in m or rad.
    off: Vec<Option<f64>>,
}

enum Found {
    Undecided(f64),
    Nearest(Box<(Description, Mechanism, Rounded)>),
}

impl<'a> Numbers<'a> {
    fn of(description: &'a Description, mechanism: &'a Mechanism) -> Self {
        let literals = description.literals();
        let length = mechanism.characteristic_length();
        let allowed = |of: &Literal, tolerance: f64| match of.measure {
            _ if of.written == 0.0 && !of.in_vector => None,
            Measure::Length | Measure::Open => Some(tolerance),
            _ => Some(tolerance / length),
        };
        let off = match mechanism.tolerance() {
            Some(tolerance) => literals.iter().map(|of| allowed(of, tolerance)).collect(),
            None => roundings(&literals, length),
        };
        Numbers {
            description,
            mechanism,
            literals,
            off,
        }
    }

    /// Angles that are multiples of 15° but for their rounding, with these.
    fn meant(&self) -> Vec<(usize, f64)> {
        let step = std::f64::consts::PI / 12.0;
        let meant = |(i, of): (usize, &Literal)| {
            let (value, off) = (of.value(), self.off[i]?);
            let whole = (value / step).round() * step;
            let near = (whole - value).abs() <= EXPLAINED * off && whole != 0.0;
            (of.measure == Measure::Angle && near && whole != value).then_some((i, whole))
        };
        self.literals.iter().enumerate().filter_map(meant).collect()
    }

    fn nearest(&self) -> Option<Found> {
        let joints = self.mechanism.joints().len();
        let unknowns = joints + 6 * self.mechanism.platforms().len();
        let none = self.off.iter().all(Option::is_none);
        if none || self.mechanism.closures().is_empty() || unknowns > MOST_UNKNOWNS {
            return None;
        }
        let plain = self.closed(&[])?;
        let meant = self.meant();
        if meant.is_empty() || matches!(plain, Found::Undecided(_)) {
            return Some(plain);
        }
        match self.closed(&meant) {
            Some(found @ Found::Nearest(_)) => Some(found),
            _ => Some(plain),
        }
    }

    /// The nearest linkage that closes exactly and in which some literals have given values.
    fn closed(&self, meant: &[(usize, f64)]) -> Option<Found> {
        let fixed = |i: &usize| meant.iter().any(|(of, _)| of == i);
        let rounded = |i: &usize| self.off[*i].is_some() && !fixed(i);
        let places: Vec<usize> = (0..self.literals.len()).filter(rounded).collect();
        let sizes: Vec<f64> = places.iter().filter_map(|&i| self.off[i]).collect();
        let given = self.description.with_literals(meant).ok()?;
        let (named, names) = given.with_named_literals(&places).ok()?;
        let named = Mechanism::new(&named).ok()?;
        let parameter = |name: &String| named.parameters().iter().position(|of| *of.name == **name);
        let numbers = names.iter().zip(&sizes);
        let numbers: Option<Vec<(usize, f64)>> = numbers
            .map(|(name, size)| Some((parameter(name)?, *size)))
            .collect();
        let bundle = Bundle::new(&named, Held::nothing(&named), &numbers?);
        let file = bundle.file();
        let walk = Walk::new(&bundle, &named, &file, !meant.is_empty())?;
        let mut configurations = walk.configurations()?;
        // a linkage must close between and beyond the configurations that it was made for
        for _ in 0..2 {
            let (found, change, rows) = walk.closing(&file, &configurations)?;
            let largest = change.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            if largest > EXPLAINED {
                match least_largest(&rows, &change) {
                    least if least > BEYOND => return None,
                    least if least > EXPLAINED => return Some(Found::Undecided(least)),
                    _ => {}
                }
            }
            match walk.opens(&found) {
                Some(more) => configurations.extend(more),
                None => {
                    let values = places.iter().copied().zip(found.numbers);
                    let values = meant.iter().copied().chain(values);
                    return self.changed(values.collect(), &configurations);
                }
            }
        }
        None
    }

    /// The file with other numbers.
    fn changed(
        &self,
        values: Vec<(usize, f64)>,
        configurations: &[Configuration<f64>],
    ) -> Option<Found> {
        /// A change of this part of the rounding is none: it comes from the arithmetic.
        const NONE: f64 = 1e-6;
        let is_changed = |(literal, to): &(usize, f64)| {
            let (of, off) = (&self.literals[*literal], self.off[*literal].unwrap_or(0.0));
            let change = (to - of.value()).abs();
            change > NONE * off && change > 4.0 * f64::EPSILON * of.value().abs()
        };
        let mut values: Vec<(usize, f64)> = values.into_iter().filter(is_changed).collect();
        values.sort_by_key(|(literal, _)| *literal);
        if values.is_empty() {
            return None;
        }
        let gaps = configurations
            .iter()
            .flat_map(|at| Gap::of(self.mechanism, at));
        let (gap, gap_angle) = gaps.fold((0.0, 0.0), |(distance, angle): (f64, f64), gap| {
            (distance.max(gap.distance), angle.max(gap.angle))
        });
        let change = |&(literal, to): &(usize, f64)| {
            let of = &self.literals[literal];
            NumberChange {
                place: of.place.clone(),
                from: of.value(),
                to,
                is_length: matches!(of.measure, Measure::Length | Measure::Open),
            }
        };
        let rounded = Rounded {
            gap,
            gap_angle,
            changes: values.iter().map(change).collect(),
        };
        let description = self.description.with_literals(&values).ok()?;
        let mechanism = Mechanism::new(&description).ok()?;
        Some(Found::Nearest(Box::new((description, mechanism, rounded))))
    }
}

impl Walk<'_> {
    /// The numbers nearest to the file's with which configurations close, the change of each in its roundings, and the
    /// conditions that they meet there. Where numbers are rounded, conditions on them are told apart only as far as the rounding
    /// allows; nearer to a solution more of them are.
    fn closing(
        &self,
        file: &[f64],
        configurations: &[Configuration<f64>],
    ) -> Option<(Bundled, Vec<f64>, Vec<Vec<f64>>)> {
        /// What is left of all rows then is rounding of doubles.
        const CLOSED: f64 = 1e-12;
        const ROUNDS: usize = 10;
        /// A condition counts that is larger than what is left, by this factor; a tenth of the last that counted at first.
        const TOLD_APART: f64 = 30.0;
        const LEAST: f64 = 1e-9;
        let mut at = Bundled {
            numbers: file.to_vec(),
            configurations: configurations.to_vec(),
        };
        if file.is_empty() {
            return Some((at, Vec::new(), Vec::new()));
        }
        let search = LevenbergMarquardt {
            damping: 0.0,
            tolerance: 1e-13,
            steps: 20,
        };
        let nearest = self.bundle.clone().near(file.to_vec());
        let mut cut = self.cut;
        for _ in 0..ROUNDS {
            let nearest = nearest.clone().redundant(self.rank, cut);
            let end = search.solve(&nearest, at);
            let left = end.misfit.equations.sqrt();
            at = end.point;
            if left < CLOSED {
                let change = self.bundle.departures(&at.numbers, file);
                let rows = nearest.model(&at)?.rows();
                return Some((at, change, rows));
            }
            let nearer = (TOLD_APART * left).max(LEAST).max(0.1 * cut);
            if nearer >= cut {
                return None;
            }
            cut = nearer;
        }
        None
    }
}
