//! The curve of a motion, with polynomials of all that its quantities are made of.

mod crossings;
mod pieces;
mod places;
mod samples;

use std::f64::consts::{PI, TAU};

use super::meter::{Meter, Name, evaluated, has_atan2, turns};
use crate::algebra::Expression;
use crate::analysis::sweep::{MetKind, Passage, Row, Stretch};
use crate::mechanism::{Configuration, Quantity};
use crate::number::tolerance::ROUNDING;
use crate::number::{Number, Taylor};

/// The curve that a motion follows, whatever rows are asked for: pieces so short that all names in the quantities are
/// polynomials there. What a quantity does between two places follows from these and its expression.
pub(crate) struct Course<'m> {
    passage: Passage<'m>,
    stretches: Vec<Stretch>,
    /// End of the last of them, with the part of the time, and true if the inputs turn back there.
    last: Option<(Configuration<f64>, f64, bool)>,
    names: Vec<Name>,
    pub pieces: Vec<StretchPiece>,
    /// The numbers of the stretches that begin, or would begin, where branches cross.
    crossings: Vec<usize>,
    /// The largest value of each name that was seen.
    most: Vec<f64>,
    /// True if all of it was examined.
    pub whole: bool,
}

/// A part of a stretch.
pub(crate) struct StretchPiece {
    stretch: usize,
    /// The parts of the stretch where it begins and ends.
    span: [f64; 2],
    ends: [Configuration<f64>; 2],
    /// For each name, and the time at last, the terms of a polynomial of s from −1 to 1; not numbers where it has no value.
    terms: Vec<[f64; TERMS]>,
    /// The most by which each may be off.
    noise: Vec<f64>,
    fits: Vec<FitQuality>,
    /// The terms of each work.
    works: Vec<[f64; WORK_TERMS]>,
}

/// Deviation of a polynomial from the quantity on a piece.
#[derive(Clone, Copy, PartialEq)]
enum FitQuality {
    /// As near as values are known.
    Near,
    /// Near, and halving the piece does not bring it nearer: values are rounded, or there is a kink.
    Rounded,
    /// Beside a crossing: it is that of a longer part of the curve.
    Continued,
    /// Not at all: there is a pole, or no value in places.
    Rough,
}

/// A part of a piece, from s = middle − radius to middle + radius.
#[derive(Clone, Copy)]
pub(crate) struct PieceRange {
    pub piece: usize,
    pub middle: f64,
    pub radius: f64,
}

/// The polynomials are of eighth degree.
const TERMS: usize = 9;
/// Those of the integral of such a power over such a time.
const WORK_TERMS: usize = 2 * TERMS - 1;

impl<'m> Course<'m> {
    pub fn new(passage: Passage<'m>, names: Vec<Name>) -> Self {
        Course {
            passage,
            stretches: Vec::new(),
            last: None,
            most: vec![0.0; names.len()],
            names,
            pieces: Vec::new(),
            crossings: Vec::new(),
            whole: true,
        }
    }

    /// Continues to the next place of the curve, which may be a dead point of the inputs or a crossing.
    pub fn reach(&mut self, row: &Row, time: f64) {
        /// Stretches of which the polynomials fit into memory.
        const MOST: usize = 100_000;
        let at = row.configuration;
        let fold = matches!(row.special, Some(MetKind::Fold { .. }));
        let crosses = matches!(row.special, Some(MetKind::Crossing { .. }));
        if let Some((before, gone, folds)) = &mut self.last {
            let ends = [before.clone(), at.clone()];
            let stretch = self.passage.stretch(ends, [*gone, time], fold || *folds);
            if stretch.is_place() {
                *folds |= fold;
                self.crossings
                    .extend(crosses.then_some(self.stretches.len()));
                return;
            }
            match self.stretches.len() < MOST {
                true => self.stretches.push(stretch),
                false => self.whole = false,
            }
        }
        self.crossings
            .extend(crosses.then_some(self.stretches.len()));
        self.last = Some((at.clone(), time, fold));
    }

    /// The part of the time that is gone where the inputs are, unless a table says it.
    pub fn time(&self, at: &Configuration<f64>) -> f64 {
        self.passage.time(at)
    }

    /// True if there is more than one place.
    pub fn moves(&self) -> bool {
        self.stretches.iter().any(|of| !of.is_place())
    }

    /// True if inputs move it.
    pub fn is_driven(&self) -> bool {
        !self.passage.inputs.is_empty()
    }

    /// The inputs at a configuration.
    pub fn inputs(&self, at: &Configuration<f64>) -> Vec<f64> {
        let inputs = self.passage.inputs.iter();
        inputs
            .map(|input| input.coordinate.of(self.passage.mechanism, at))
            .collect()
    }

    /// The value of an expression over the names at a place of a piece, if it has one, with how far it may be off.
    pub fn value(&self, of: &Sought, piece: usize, s: f64) -> (Option<f64>, f64) {
        let piece = &self.pieces[piece];
        let known = self.names.iter().enumerate().map(|(name, what)| {
            let value = polynomial(&piece.terms[name], s);
            let turned = match what.turns() && !of.turns {
                true => value - TAU * (value / TAU).round(),
                false => value,
            };
            [turned, piece.noise[name]]
        });
        evaluated(of.program, &known.collect::<Vec<_>>())
    }

    /// A name over a part of a piece; the last is the time.
    fn name(&self, name: usize, at: PieceRange) -> Taylor {
        let terms = self.pieces[at.piece].terms[name];
        let terms = about(terms, at.middle, at.radius);
        let mut model = Taylor::zero();
        let count = model.terms.len();
        model.terms.copy_from_slice(&terms[..count]);
        model.rest = terms[count..].iter().map(|term| term.abs()).sum();
        model
    }

    /// The part of the time that is gone at a place of a piece.
    pub fn time_at(&self, piece: usize, s: f64) -> f64 {
        polynomial(&self.pieces[piece].terms[self.names.len()], s)
    }

    /// Its derivative by s.
    pub fn time_rate(&self, piece: usize, s: f64) -> f64 {
        let terms = self.pieces[piece].terms[self.names.len()];
        let slopes = (1..TERMS).rev().map(|k| k as f64 * terms[k]);
        slopes.fold(0.0, |sum, slope| sum * s + slope)
    }

    /// A model of an expression over a part of a piece, if it has a value there.
    fn model(&self, of: &Sought, at: PieceRange) -> Option<Taylor> {
        let names: Vec<Taylor> = (self.names.iter().enumerate())
            .map(|(name, what)| {
                let mut model = self.name(name, at);
                if what.turns() && !of.turns {
                    model.terms[0] -= TAU * (model.terms[0] / TAU).round();
                    let [low, high] = model.range();
                    if low < -PI || high > PI {
                        model = Taylor::zero();
                        model.rest = PI;
                    }
                }
                model
            })
            .collect();
        let model = of.program.evaluate(&|name: &usize| names[*name]).ok();
        // bounds may be too large where no value is
        let value = || self.value(of, at.piece, at.middle).0;
        model.or_else(|| value().map(|_| Taylor::UNBOUNDED))
    }

    /// Walks along the curve and halves pieces as long as the visitor wants it, who is given a model of an expression,
    /// if it has a value there. True if all was seen before the patience ended.
    pub fn walk(
        &self,
        of: &Sought,
        mut patience: usize,
        visit: &mut dyn FnMut(PieceRange, Option<&Taylor>) -> bool,
    ) -> bool {
        let mut before = (of.jumps).then(|| self.value(of, 0, -1.0).0).flatten();
        for piece in 0..self.pieces.len() {
            let mut parts = vec![PieceRange {
                piece,
                middle: 0.0,
                radius: 1.0,
            }];
            while let Some(part) = parts.pop() {
                if patience == 0 {
                    return false;
                }
                patience -= 1;
                let mut model = self.model(of, part);
                let mut vague = false;
                if let (true, Some(model)) = (of.jumps, &mut model) {
                    vague = model.rest > 0.5 && !self.is_narrow(part);
                    if let Some(before) = before {
                        model.terms[0] += TAU * ((before - model.at(-1.0)) / TAU).round();
                    }
                }
                if (vague || visit(part, model.as_ref())) && !self.is_narrow(part) {
                    let radius = 0.5 * part.radius;
                    for middle in [part.middle + radius, part.middle - radius] {
                        parts.push(PieceRange {
                            middle,
                            radius,
                            ..part
                        });
                    }
                } else if let Some(model) = model.filter(|model| model.rest < 0.5) {
                    before = Some(model.at(1.0));
                }
            }
        }
        true
    }

    /// True if a piece may hide values of a quantity: a name in it is no polynomial there, and it is not a mere place.
    pub fn hides(&self, of: &Sought, piece: usize) -> bool {
        let [begin, end] = self.pieces[piece].span;
        self.is_rough(of, piece) && end - begin > ROUNDING
    }

    fn has(&self, of: &Sought, piece: usize, fitted: FitQuality) -> bool {
        let fits = &self.pieces[piece].fits;
        of.program.names().any(|(name, _)| fits[*name] == fitted)
    }

    /// True if a name in a quantity is no polynomial on a piece.
    pub fn is_rough(&self, of: &Sought, piece: usize) -> bool {
        self.has(of, piece, FitQuality::Rough)
    }

    /// True if a name in a quantity is known beside a crossing from farther away: what is read there says less.
    pub fn is_continued(&self, of: &Sought, piece: usize) -> bool {
        self.has(of, piece, FitQuality::Continued)
    }

    /// The part of a stretch on either side of a place of a piece where the best value near it may be.
    pub fn margin(&self, of: &Sought, piece: usize) -> Option<f64> {
        if self.is_continued(of, piece) {
            return None;
        }
        // a fiftieth of the piece; the polynomial of one with a kink may not reach up to it, and then a neighbour has the best
        // value
        let kinked = (piece.saturating_sub(1)..(piece + 2).min(self.pieces.len()))
            .filter(|k| self.has(of, *k, FitQuality::Rounded))
            .map(|k| self.width(k));
        Some(kinked.fold(0.02 * self.width(piece), f64::max))
    }

    /// True if names do not differ by more than rounding from one end of a part to the other.
    pub fn is_narrow(&self, of: PieceRange) -> bool {
        of.radius * self.width(of.piece) < 1e-13
    }

    /// The length of a piece relative to its stretch.
    pub fn width(&self, piece: usize) -> f64 {
        let [begin, end] = self.pieces[piece].span;
        end - begin
    }
}

/// A quantity over the numbers of names.
pub(crate) struct Sought<'e> {
    pub program: &'e Expression<usize>,
    /// True for an angle without jumps.
    pub turns: bool,
    /// True if its expression jumps all the same.
    pub jumps: bool,
}

impl<'e> Sought<'e> {
    pub fn new(quantity: &Quantity, program: &'e Expression<usize>) -> Self {
        let turns = turns(quantity);
        Sought {
            program,
            turns,
            jumps: turns && has_atan2(&quantity.expression),
        }
    }
}

/// The part of a span at s from −1 to 1, the ends without rounding.
fn within([begin, end]: [f64; 2], s: f64) -> f64 {
    match s {
        -1.0 => begin,
        1.0 => end,
        _ => begin + 0.5 * (s + 1.0) * (end - begin),
    }
}

/// The terms of a polynomial in t, where s = middle + radius · t.
fn about(mut terms: [f64; TERMS], middle: f64, radius: f64) -> [f64; TERMS] {
    // by Horner's rule again and again
    for k in 0..TERMS {
        for i in (k..TERMS - 1).rev() {
            terms[i] += middle * terms[i + 1];
        }
    }
    let mut power = 1.0;
    for term in &mut terms {
        *term *= power;
        power *= radius;
    }
    terms
}

fn polynomial(terms: &[f64], s: f64) -> f64 {
    terms.iter().rev().fold(0.0, |sum, term| sum * s + term)
}
