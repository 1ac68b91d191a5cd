//! The polynomials of names on pieces of a curve.

use std::f64::consts::{FRAC_PI_8, TAU};

use super::{Course, FitQuality, StretchPiece, TERMS, WORK_TERMS, polynomial, within};
use crate::analysis::quantities::meter::{Meter, MeterBlock, Name};
use crate::analysis::sweep::Row;
use crate::mechanism::{Configuration, Measured};
use crate::number::Number;
use crate::number::sorting::sort_by;
use crate::number::tolerance::ROUNDING;
use crate::solve::{Stage, Watch};

/// A piece that is to be examined.
struct Ahead {
    stretch: usize,
    span: [f64; 2],
    ends: [Configuration<f64>; 2],
    depth: u32,
    /// The distance of each name from its polynomial on the piece that this is half of.
    off: Vec<f64>,
}

/// Places on a piece, in order: the extremes of the Chebyshev polynomial of that degree, and two between them where the
/// polynomial through these is compared.
pub(super) const PLACES: usize = TERMS + 2;
const COMPARED: [usize; 2] = [3, 6];

/// The place in the middle.
const MIDDLE: usize = 5;

/// The number of times a stretch is halved where a name has a kink or a pole.
const DEEPEST: u32 = 40;

impl Course<'_> {
    /// Finds the polynomials of the names, which a meter reads.
    pub fn look(&mut self, meter: &mut Meter, watch: &Watch) {
        let lagrange = lagrange(None);
        if let (true, Some((at, time, _))) = (self.stretches.is_empty(), &self.last) {
            let ends = [at.clone(), at.clone()];
            let stretch = self.passage.stretch(ends, [*time; 2], false);
            self.stretches.push(stretch);
        }
        let stretches = self.stretches.iter().enumerate();
        let mut ahead: Vec<Ahead> = stretches
            .map(|(stretch, of)| Ahead {
                stretch,
                span: [0.0, 1.0],
                ends: of.ends.clone(),
                depth: 0,
                off: Vec::new(),
            })
            .collect();
        // how often pieces may be halved
        let mut left = 20_000 + 8 * ahead.len();
        while !ahead.is_empty() {
            let (samples, middles) = self.sampled(&ahead, meter, watch);
            for of in samples.iter().flatten() {
                let sizes = of.iter().map(|[value, _]| value.abs());
                for (most, size) in self.most.iter_mut().zip(sizes) {
                    *most = most.max(if size.is_finite() { size } else { 0.0 });
                }
            }
            let mut halves = Vec::new();
            for ((of, samples), middle) in ahead.into_iter().zip(samples).zip(middles) {
                let (piece, off) = self.fitted(&of, &samples, &lagrange);
                match middle {
                    Some(middle)
                        if piece.fits.contains(&FitQuality::Rough)
                            && of.depth < DEEPEST
                            && left > 0 =>
                    {
                        left -= 1;
                        let [begin, end] = of.ends;
                        let half = 0.5 * (of.span[0] + of.span[1]);
                        let sides = [
                            ([begin, middle.clone()], [of.span[0], half]),
                            ([middle, end], [half, of.span[1]]),
                        ];
                        halves.extend(sides.map(|(ends, span)| Ahead {
                            stretch: of.stretch,
                            span,
                            ends,
                            depth: of.depth + 1,
                            off: off.clone(),
                        }));
                    }
                    _ => self.pieces.push(piece),
                }
            }
            ahead = halves;
        }
        let key = |of: &StretchPiece| (of.stretch, of.span[0]);
        let order = |a: &StretchPiece, b: &StretchPiece| {
            let (a, b) = (key(a), key(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        };
        sort_by(&mut self.pieces, order);
        self.continue_crossings(meter);
        // angles go on without jumps
        for name in (0..self.names.len()).filter(|name| self.names[*name].turns()) {
            let mut before: Option<f64> = None;
            for piece in &mut self.pieces {
                let ends = [-1.0, 1.0].map(|s| polynomial(&piece.terms[name], s));
                if let Some(before) = before.filter(|_| ends[0].is_finite()) {
                    piece.terms[name][0] += TAU * ((before - ends[0]) / TAU).round();
                }
                let end = polynomial(&piece.terms[name], 1.0);
                before = Some(end).filter(|end| end.is_finite()).or(before);
            }
        }
    }

    /// Integrates powers over the time, in s for all of it, to the works among the names: ∫ P·t′ ds, of the polynomials
    /// term by term.
    pub fn gather(&mut self, duration: f64) {
        let lagrange = lagrange(None);
        let time = self.names.len();
        let power_of = |name: &Name| match name.of {
            Measured::Work(of) => self
                .names
                .iter()
                .position(|of_it| of_it.of == Measured::Power(of)),
            _ => None,
        };
        let powers = self.names.iter().map(power_of).enumerate();
        let powers: Vec<(usize, usize)> =
            powers.filter_map(|(work, of)| Some((work, of?))).collect();
        for (work, power) in powers {
            let (mut done, mut size, mut noise) = (0.0, 0.0, 0.0);
            for i in 0..self.pieces.len() {
                let end =
                    |piece: usize, s: f64| polynomial(&self.pieces[piece].terms[power], s).abs();
                let before = i.checked_sub(1).map_or(f64::NAN, |before| end(before, 1.0));
                let beside = match before.is_nan() && i + 1 < self.pieces.len() {
                    true => end(i + 1, -1.0),
                    false => before,
                };
                let piece = &mut self.pieces[i];
                let mut terms = [0.0; WORK_TERMS];
                for (n, p) in piece.terms[power].iter().enumerate() {
                    for k in 1..TERMS {
                        let product = p * piece.terms[time][k] * k as f64;
                        terms[n + k] += duration * product / (n + k) as f64;
                    }
                }
                let [from, to] = [-1.0, 1.0].map(|s| polynomial(&piece.terms[time], s));
                let long = duration * (to - from).abs();
                // more than rounding of the work so far lost at a kink: the power has no bound
                if piece.fits[power] == FitQuality::Rough {
                    let known = beside * long <= ROUNDING * size || long == 0.0;
                    terms = [if known { 0.0 } else { f64::NAN }; WORK_TERMS];
                }
                terms[0] = done - polynomial(&terms, -1.0);
                let value = |s: f64| polynomial(&terms, s);
                noise += long * piece.noise[power] + f64::EPSILON * done.abs();
                let through = places().into_iter().enumerate();
                let through = through.filter(|(place, _)| !COMPARED.contains(place));
                let mut fitted = [0.0; TERMS];
                for (basis, (_, s)) in lagrange.iter().zip(through) {
                    let value = value(s);
                    fitted
                        .iter_mut()
                        .zip(basis)
                        .for_each(|(term, of)| *term += value * of);
                }
                let off = COMPARED.map(|place| {
                    (polynomial(&fitted, places()[place]) - value(places()[place])).abs()
                });
                piece.noise[work] = noise + off[0].max(off[1]);
                piece.terms[work] = fitted;
                piece.works.push(terms);
                size += (value(1.0) - done).abs();
                done = value(1.0);
            }
        }
    }

    /// The names at the places of each piece, the time at last, and how far they may be off; and the configurations in
    /// the middle.
    fn sampled(
        &mut self,
        ahead: &[Ahead],
        meter: &mut Meter,
        watch: &Watch,
    ) -> (Vec<Samples>, Vec<Option<Configuration<f64>>>) {
        let count = self.names.len();
        let mut read: Vec<[f64; 2]> = Vec::new();
        let mut take = taking(&mut read);
        let mut order = Vec::new();
        let mut middles = vec![None; ahead.len()];
        let none = vec![[f64::NAN, 0.0]; count + 1];
        let mut samples: Vec<Samples> = vec![std::array::from_fn(|_| none.clone()); ahead.len()];
        for (k, of) in ahead.iter().enumerate() {
            if k % 64 == 0 && watch.stops(Stage::Steps, k, Some(ahead.len())) {
                self.whole = false;
                break;
            }
            for (place, s) in places().into_iter().enumerate() {
                let part = within(of.span, s);
                let near = usize::from(s > 0.0);
                let from = (of.span[near], &of.ends[near]);
                let stretch = &self.stretches[of.stretch];
                let Some((at, time)) = self.passage.at(stretch, part, from) else {
                    continue;
                };
                if place == MIDDLE {
                    middles[k] = Some(at.clone());
                }
                samples[k][place][count] = [time, f64::EPSILON];
                order.push((k, place));
                meter.read_row(&Row::of(at), time, &mut take);
            }
        }
        meter.read_waiting(&mut take);
        drop(take);
        for ((k, place), values) in order.into_iter().zip(read.chunks_exact(count.max(1))) {
            samples[k][place][..count].copy_from_slice(&values[..count]);
        }
        (samples, middles)
    }

    /// The polynomials through samples.
    fn fitted(
        &self,
        of: &Ahead,
        samples: &Samples,
        lagrange: &[[f64; TERMS]; TERMS],
    ) -> (StretchPiece, Vec<f64>) {
        let mut all_off = Vec::new();
        let mut piece = StretchPiece {
            stretch: of.stretch,
            span: of.span,
            ends: of.ends.clone(),
            terms: Vec::new(),
            noise: Vec::new(),
            fits: Vec::new(),
            works: Vec::new(),
        };
        let is_solved = samples.iter().all(|of| !of[self.names.len()][0].is_nan());
        for name in 0..=self.names.len() {
            let fit = self.fit(name, samples, None, lagrange);
            let before = of.off.get(name);
            let rounded = before.is_some_and(|before| fit.off > 0.8 * before);
            // rounding near a singularity: halving the piece does not make it less
            let rounded = fit.known && rounded && fit.off <= 1e-6 * fit.largest;
            all_off.push(if fit.known { fit.off } else { f64::INFINITY });
            // no value anywhere, though the configurations are known
            let nowhere = samples.iter().all(|of| of[name][0].is_nan()) && is_solved;
            let (fitted, terms) = match (fit.near, rounded) {
                (true, _) => (FitQuality::Near, fit.terms),
                (false, true) => (FitQuality::Rounded, fit.terms),
                _ if nowhere => (FitQuality::Near, [f64::NAN; TERMS]),
                _ => (FitQuality::Rough, [f64::NAN; TERMS]),
            };
            piece.terms.push(terms);
            piece.noise.push(fit.may_be_off());
            piece.fits.push(fitted);
        }
        (piece, all_off)
    }

    /// The polynomial of a name through its samples, but for those at a place that is left out.
    pub(super) fn fit(
        &self,
        name: usize,
        samples: &Samples,
        without: Option<usize>,
        lagrange: &[[f64; TERMS]; TERMS],
    ) -> PolynomialFit {
        let mut values: [f64; PLACES] = std::array::from_fn(|place| samples[place][name][0]);
        if self.names.get(name).is_some_and(Name::turns) {
            for i in 1..PLACES {
                let jump = values[i] - values[i - 1];
                if jump.is_finite() {
                    values[i] -= TAU * (jump / TAU).round();
                }
            }
        }
        let mut terms = [0.0; TERMS];
        for (basis, place) in lagrange.iter().zip(through(without)) {
            for (term, of_basis) in terms.iter_mut().zip(basis) {
                *term += values[place] * of_basis;
            }
        }
        let finite = |most: f64, x: f64| if x.is_finite() { most.max(x) } else { most };
        let largest = values.iter().map(|x| x.abs()).fold(0.0, finite);
        let noise = samples.iter().map(|of| of[name][1]).fold(0.0, finite);
        let off = COMPARED.map(|place| (polynomial(&terms, places()[place]) - values[place]).abs());
        let most = self.most.get(name).copied().unwrap_or(0.0);
        // relative to the largest value on the piece
        let near = (1e-11 * largest + 8.0 * noise).max(f64::EPSILON * most);
        PolynomialFit {
            near: off.iter().all(|off| *off <= near),
            known: off.iter().all(|off| off.is_finite()),
            off: off.into_iter().fold(0.0, finite),
            terms,
            largest,
            noise,
        }
    }
}

/// A polynomial through samples of a name.
pub(super) struct PolynomialFit {
    pub terms: [f64; TERMS],
    /// The largest value among them, and the most by which one may be off.
    pub largest: f64,
    pub noise: f64,
    /// The distance from the samples that it is compared with.
    pub off: f64,
    /// True if these have values, and if it is as near to them as rounding lets it be.
    pub known: bool,
    pub near: bool,
}

impl PolynomialFit {
    /// The most by which a value may be off.
    pub fn may_be_off(&self) -> f64 {
        self.noise + self.off
    }
}

/// Takes what a meter reads of names: values, and how far they may be off.
pub(super) fn taking(read: &mut Vec<[f64; 2]>) -> impl FnMut(&MeterBlock) {
    |block| {
        for i in 0..block.len() {
            let columns = block.columns().iter();
            read.extend(columns.map(|of| [of.values[i], of.noise[i]]));
        }
    }
}

/// The places, but for those compared and one that is left out.
fn through(without: Option<usize>) -> impl Iterator<Item = usize> {
    (0..PLACES).filter(move |place| !COMPARED.contains(place) && Some(*place) != without)
}

/// For each place of a piece the names, the time at last, and how far they may be off.
pub(super) type Samples = [Vec<[f64; 2]>; PLACES];

/// The places on a piece, in order.
pub(super) fn places() -> [f64; PLACES] {
    let at = |k: usize| -Number::sin_cos(FRAC_PI_8 * k as f64).1;
    [
        -1.0,
        at(1),
        at(2),
        -0.55,
        at(3),
        0.0,
        0.19,
        at(5),
        at(6),
        at(7),
        1.0,
    ]
}

/// The terms of the polynomials that are 1 at one of the places and 0 at the others, but for those compared and one that
/// is left out.
pub(super) fn lagrange(without: Option<usize>) -> [[f64; TERMS]; TERMS] {
    let through: Vec<f64> = through(without).map(|place| places()[place]).collect();
    std::array::from_fn(|one| {
        let mut terms = [0.0; TERMS];
        if one == through.len() {
            return terms;
        }
        terms[0] = 1.0;
        for (_, other) in through.iter().enumerate().filter(|(k, _)| *k != one) {
            let scale = 1.0 / (through[one] - other);
            for i in (0..TERMS).rev() {
                let lower = if i > 0 { terms[i - 1] } else { 0.0 };
                terms[i] = scale * (lower - other * terms[i]);
            }
        }
        terms
    })
}
