//! Mechanisms whose numbers are rounded: the nearest linkage that closes exactly.
//!
//! A loop that closes only for special dimensions, as planar and spherical ones in space or Bennett's, no longer moves once
//! these are rounded. It is recognised by finite motion. Directions that closures resist less than rounding explains are
//! followed as if they were free; where what is left open stays within what the rounding of the file's numbers explains, the
//! nearest numbers are sought for which all configurations on the way close (a [`Bundle`] with the numbers of the file as its
//! shared unknowns, the change of each measured by its own rounding). A structure does not pass: along the way of a shaky one
//! what is left grows with the square of the way, and a frame that only nearly closes needs a larger change.

mod directions;
mod explained;
mod lengths;
mod parts;
mod poses;
mod snap;
mod walk;

use std::path::Path;

use crate::algebra::Measure;
use crate::description::{Description, Literal, LoadError, Problem, roundings};
use crate::mechanism::{Configuration, Mechanism, NumberChange, Rounded, Rounding};
use crate::number::tolerance::{EXACT, ROUNDING, SOLVED, SUMMED};
use crate::solve::{LeastSquares, LevenbergMarquardt};
use crate::system::{Bundle, Bundled, Gap};
use explained::least_largest;
use parts::LinkedLoops;
pub use snap::{Snapped, snap};
use walk::RoundedDirections;

/// Changes up to so many roundings are explained by them: half a unit of the last digit, and what arithmetic adds.
const EXPLAINED: f64 = 1.05;

/// The most unknowns of loops that are looked at together: each singular value decomposition grows as their cube.
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
    let (literals, length) = (description.literals(), mechanism.characteristic_length());
    let off = match mechanism.tolerance() {
        Some(tolerance) => inexact(&literals, |i| match literals[i].measure {
            Measure::Length | Measure::Open => tolerance,
            _ => tolerance / length,
        }),
        None => roundings(&literals, length),
    };
    Ok(exact(description, mechanism, literals, off))
}

/// As [`posed`], of a description whose numbers were computed from poses in another file, the numbers of which are off by at
/// most this, of lengths in m.
///
/// A quaternion with parts off by ε turns by up to 2√3·ε, so that an angle between two frames is off by about 4·ε. A length is
/// off by the positions at its ends, 2·ε; in tables a common normal also by that angle over the offsets along the axes at its
/// ends, an offset by it over the normals at its ends, both over sin α of these.
///
/// # Errors
/// All problems of the description.
pub fn posed_from_poses(
    description: Description,
    off: f64,
) -> Result<(Description, Mechanism), Vec<Problem>> {
    let mechanism = Mechanism::new(&description)?;
    let literals = description.literals();
    let sizes = poses::sizes(&description, &literals);
    let off = inexact(&literals, |i| sizes[i] * off);
    Ok(exact(description, mechanism, literals, off))
}

/// The most by which each literal is off; zeros are exact but in vectors.
fn inexact(literals: &[Literal], size: impl Fn(usize) -> f64) -> Vec<Option<f64>> {
    let is_inexact = |of: &Literal| of.written != 0.0 || of.in_vector;
    let all = literals.iter().enumerate();
    all.map(|(i, of)| is_inexact(of).then(|| size(i))).collect()
}

fn exact(
    description: Description,
    mechanism: Mechanism,
    literals: Vec<Literal>,
    off: Vec<Option<f64>>,
) -> (Description, Mechanism) {
    let numbers = Numbers {
        description: &description,
        mechanism: &mechanism,
        literals,
        off,
    };
    match numbers.nearest() {
        None => (description, mechanism),
        Some(FoundClosing::Undecided(change)) => {
            let mechanism = mechanism.with_rounding(Rounding::Undecided { change });
            (description, mechanism)
        }
        Some(FoundClosing::Nearest(found)) => {
            let (description, mechanism, rounded) = *found;
            let mechanism = mechanism.with_rounding(Rounding::Nearest(rounded));
            (description, mechanism)
        }
    }
}

/// Reads a mechanism file; where its loops close only within the rounding of its numbers, as the nearest linkage that
/// closes exactly ([`posed`]).
///
/// # Errors
/// If the file cannot be read, or has problems; then with all of them.
pub fn load(path: impl AsRef<Path>) -> Result<Mechanism, LoadError> {
    let (text, description) = Mechanism::read(&path)?;
    let made = posed(description).map_err(|problems| LoadError::wrong(path, text, problems))?;
    Ok(made.1)
}

/// A file with its numbers that may have been rounded.
struct Numbers<'a> {
    description: &'a Description,
    mechanism: &'a Mechanism,
    literals: Vec<Literal>,
    /// The most by which each literal is off, in m or rad.
    off: Vec<Option<f64>>,
}

enum FoundClosing {
    Undecided(f64),
    Nearest(Box<(Description, Mechanism, Rounded)>),
}

/// Numbers that close the loops of a part exactly.
enum ClosedPart {
    Undecided(f64),
    /// Literals with their values, and the largest gaps with those of the file.
    Nearest(Vec<(usize, f64)>, Gap),
}

impl Numbers<'_> {
    /// Numbers of a part as a drawing means them where they differ by their rounding only: angles that are multiples of 15°,
    /// lengths that are nothing, so that axes are parallel, perpendicular, or meet.
    fn meant(&self, part: &LinkedLoops) -> Vec<(usize, f64)> {
        let step = std::f64::consts::PI / 12.0;
        let meant = |&i: &usize| {
            let (of, off) = (&self.literals[i], self.off[i]?);
            let value = of.value();
            let whole = match of.measure {
                Measure::Angle => (value / step).round() * step,
                Measure::Length if !of.in_vector => 0.0,
                _ => return None,
            };
            let near = (whole - value).abs() <= EXPLAINED * off;
            (near && whole != value).then_some((i, whole))
        };
        part.numbers.iter().filter_map(meant).collect()
    }

    fn nearest(&self) -> Option<FoundClosing> {
        if self.mechanism.closures().is_empty() {
            return None;
        }
        let rounded = |i: &usize| self.off[*i].is_some();
        let places: Vec<usize> = (0..self.literals.len()).filter(rounded).collect();
        let (named, numbers) = self.named(&places, &[])?;
        let parts = LinkedLoops::of(&named, &numbers)?.into_iter();
        let mut undecided: Option<f64> = None;
        let (mut values, mut most) = (Vec::new(), Gap::NONE);
        for mut part in parts.filter(|part| part.unknowns() <= MOST_UNKNOWNS) {
            if !is_rounded(&named, &part, &numbers) {
                continue;
            }
            part.numbers = part.numbers.iter().map(|&k| places[k]).collect();
            match self.nearest_of(&part) {
                Some(ClosedPart::Undecided(change)) => {
                    undecided = Some(undecided.map_or(change, |other| other.max(change)));
                }
                Some(ClosedPart::Nearest(of_part, gap)) => {
                    values.extend(of_part);
                    most = most.max(gap);
                }
                None => {}
            }
        }
        match undecided {
            Some(change) => Some(FoundClosing::Undecided(change)),
            None => self.changed(values, most),
        }
    }

    fn nearest_of(&self, part: &LinkedLoops) -> Option<ClosedPart> {
        let mut meant = self.meant(part);
        meant.extend(self.parallel(part));
        let wanted = [self.equal(part, &meant), meant];
        let found = wanted.into_iter().filter(|meant| !meant.is_empty());
        let found = found.map(|meant| self.closed(part, &meant));
        let mut found =
            found.filter_map(|found| found.filter(|of| matches!(of, ClosedPart::Nearest(..))));
        found.next().or_else(|| self.closed(part, &[]))
    }

    /// The mechanism in which literals are parameters, these with the most that each is off, and others have given values.
    fn named(
        &self,
        places: &[usize],
        given: &[(usize, f64)],
    ) -> Option<(Mechanism, Vec<(usize, f64)>)> {
        let given = self.description.with_literals(given).ok()?;
        let (named, names) = given.with_named_literals(places).ok()?;
        let named = Mechanism::new(&named).ok()?;
        let parameter = |name: &String| named.parameters().iter().position(|of| *of.name == **name);
        let sizes = places.iter().filter_map(|&i| self.off[i]);
        let numbers = names.iter().zip(sizes);
        let numbers: Option<Vec<(usize, f64)>> = numbers
            .map(|(name, size)| Some((parameter(name)?, size)))
            .collect();
        Some((named, numbers?))
    }

    /// The nearest linkage that closes exactly and in which some literals have given values.
    fn closed(&self, part: &LinkedLoops, meant: &[(usize, f64)]) -> Option<ClosedPart> {
        let fixed = |i: &usize| meant.iter().any(|(of, _)| of == i);
        let places: Vec<usize> = part.numbers.iter().copied().filter(|i| !fixed(i)).collect();
        let (named, numbers) = self.named(&places, meant)?;
        let bundle = Bundle::new(&named, part.held(&named), &numbers).only(&part.closures);
        let file = bundle.file();
        let walk = RoundedDirections::new(&bundle, &named, &file, !meant.is_empty())?;
        let mut configurations = walk.configurations()?;
        // a linkage must close between and beyond the configurations that it was made for
        for _ in 0..2 {
            let (found, change, rows) = walk.closing(&file, &configurations)?;
            let largest = change.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            if largest > EXPLAINED {
                match least_largest(&rows, &change) {
                    // between the two it is not decided
                    least if least > 1.5 => return None,
                    least if least > EXPLAINED => return Some(ClosedPart::Undecided(least)),
                    _ => {}
                }
            }
            match walk.opens(&found) {
                Some(more) => configurations.extend(more),
                None => {
                    let values = places.iter().copied().zip(found.numbers);
                    let values = meant.iter().copied().chain(values);
                    let gaps = configurations.iter().flat_map(|at| {
                        let gaps = Gap::of(self.mechanism, at);
                        part.closures.iter().map(move |&i| gaps[i])
                    });
                    return Some(ClosedPart::Nearest(
                        values.collect(),
                        gaps.fold(Gap::NONE, Gap::max),
                    ));
                }
            }
        }
        None
    }

    /// The file with other numbers.
    fn changed(&self, mut values: Vec<(usize, f64)>, gap: Gap) -> Option<FoundClosing> {
        values.iter_mut().for_each(|(_, to)| {
            if to.abs() < EXACT {
                *to = 0.0;
            }
        });
        let is_changed = |(literal, to): &(usize, f64)| {
            let (of, off) = (&self.literals[*literal], self.off[*literal].unwrap_or(0.0));
            let change = (to - of.value()).abs();
            // a millionth of the rounding comes from the arithmetic, unless loops would stay open by it
            change > (1e-6 * off).min(SUMMED) && change > 4.0 * f64::EPSILON * of.value().abs()
        };
        values.retain(is_changed);
        values.sort_by_key(|(literal, _)| *literal);
        if values.is_empty() {
            return None;
        }
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
            gap: gap.distance,
            gap_angle: gap.angle,
            changes: values.iter().map(change).collect(),
        };
        let description = self.description.with_literals(&values).ok()?;
        let mechanism = Mechanism::new(&description).ok()?;
        Some(FoundClosing::Nearest(Box::new((
            description,
            mechanism,
            rounded,
        ))))
    }
}

/// True if the numbers of a part, among those of a mechanism, leave it open, but not by more than rounding explains.
fn is_rounded(named: &Mechanism, part: &LinkedLoops, numbers: &[(usize, f64)]) -> bool {
    let own: Vec<(usize, f64)> = part.numbers.iter().map(|&k| numbers[k]).collect();
    let bundle = Bundle::new(named, part.held(named), &own).only(&part.closures);
    RoundedDirections::new(&bundle, named, &bundle.file(), false).is_some()
}

impl RoundedDirections<'_> {
    /// The numbers nearest to the file's with which configurations close, the change of each in its roundings, and the
    /// conditions that they meet there. Where numbers are rounded, conditions on them are told apart only as far as the rounding
    /// allows; nearer to a solution more of them are.
    fn closing(
        &self,
        file: &[f64],
        configurations: &[Configuration<f64>],
    ) -> Option<(Bundled, Vec<f64>, Vec<Vec<f64>>)> {
        const ROUNDS: usize = 10;
        /// Steps taken although they may lead away.
        const AHEAD: usize = 4;
        let mut at = Bundled {
            numbers: file.to_vec(),
            configurations: configurations.to_vec(),
        };
        let search = LevenbergMarquardt {
            damping: 0.0,
            tolerance: 1e-13,
            steps: 20,
        };
        let nearest = self.bundle.clone().near(file.to_vec());
        // without numbers to change they must close as they are
        if file.is_empty() {
            let closes = nearest.misfit(&at).equations.sqrt() < SOLVED;
            return closes.then(|| (at, Vec::new(), Vec::new()));
        }
        let mut cut = self.cut;
        for _ in 0..ROUNDS {
            let nearest = nearest.clone().redundant(self.rank, cut);
            let end = search.solve(&nearest, at);
            let mut left = end.misfit.equations.sqrt();
            at = end.point;
            // a step along what is badly conditioned opens what is not, and the steps after it close that
            let mut ahead = at.clone();
            for _ in 0..AHEAD {
                if left < SOLVED {
                    break;
                }
                ahead = nearest.stepped(&ahead, &nearest.model(&ahead)?, 0.0).0;
                let open = nearest.misfit(&ahead).equations.sqrt();
                if open < left {
                    (left, at) = (open, ahead.clone());
                }
            }
            if left < SOLVED {
                let change = self.bundle.departures(&at.numbers, file);
                let rows = nearest.model(&at)?.rows();
                return Some((at, change, rows));
            }
            // a condition counts that is clearly larger than what is left; a tenth of the last that counted at first
            let nearer = (30.0 * left).max(ROUNDING).max(0.1 * cut);
            if nearer >= cut {
                return None;
            }
            cut = nearer;
        }
        None
    }
}
