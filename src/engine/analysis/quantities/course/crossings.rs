//! Quantities where branches cross: so near to one another there that rounding decides which is read.

use std::ops::Range;

use super::pieces::{PLACES, PolynomialFit, Samples, lagrange, places, taking};
use super::{Course, FitQuality, about, within};
use crate::analysis::quantities::meter::Meter;
use crate::analysis::sweep::Row;
use crate::mechanism::Configuration;

/// A part of the curve that ends at a crossing.
#[derive(Clone)]
struct Approach {
    /// Its stretches; all of them are measured by the same coordinate or all by the time.
    stretches: Range<usize>,
    /// The measure at its far end and at the crossing.
    measures: [f64; 2],
}

/// The place of a part that is the crossing itself, where not every name has a value.
const AT: usize = PLACES - 1;

impl Course<'_> {
    /// Makes the polynomials of names beside crossings those of longer parts of the curve, whose places are far enough
    /// from the crossing: every branch goes through it smoothly.
    pub(super) fn continue_crossings(&mut self, meter: &mut Meter) {
        /// The lengths of parts, in rad and characteristic lengths: the shorter, the more is rounded.
        const LENGTHS: [f64; 5] = [0.4, 0.2, 0.1, 0.05, 0.025];
        let basis = lagrange(Some(AT));
        for crossing in self.crossings.clone() {
            for before in [true, false] {
                let mut best: Vec<Option<(PolynomialFit, Approach)>> = Vec::new();
                best.resize_with(self.names.len(), || None);
                for length in LENGTHS {
                    let part = self.approach(crossing, before, length);
                    let sampled = part.and_then(|part| {
                        let samples = self.approached(&part, before, meter)?;
                        Some((part, samples))
                    });
                    let Some((part, samples)) = sampled else {
                        continue;
                    };
                    for (name, best) in best.iter_mut().enumerate() {
                        let fit = self.fit(name, &samples, Some(AT), &basis);
                        let better =
                            |(known, _): &(PolynomialFit, _)| fit.may_be_off() < known.may_be_off();
                        // places near the crossing are rounded more
                        let near = fit.near || fit.known && fit.off <= 1e-8 * fit.largest;
                        if near && best.as_ref().is_none_or(better) {
                            *best = Some((fit, part.clone()));
                        }
                    }
                }
                for (name, found) in best.into_iter().enumerate() {
                    if let Some((fit, part)) = found {
                        self.continue_name(name, &fit, &part);
                    }
                }
            }
        }
    }

    /// The part of the curve before or behind a crossing that goes no farther than so much from it.
    fn approach(&self, crossing: usize, before: bool, length: f64) -> Option<Approach> {
        let next = |k: usize| match before {
            true => k.checked_sub(1),
            false => Some(k + 1),
        };
        let first = match before {
            true => crossing.checked_sub(1)?,
            false => crossing,
        };
        let [near, far] = if before { [1, 0] } else { [0, 1] };
        let at = &self.stretches.get(first)?.ends[near];
        let (along, ends) = self.stretches[first].measured();
        let (mut last, mut measures) = (first, [ends[near]; 2]);
        let mut here = Some(first);
        while let Some(k) = here
            && let Some(stretch) = self.stretches.get(k)
        {
            let (of, ends) = stretch.measured();
            let onwards = (ends[far] - ends[near]) * (measures[0] - measures[1]) >= 0.0;
            let edge = if before { k + 1 } else { k };
            if of != along
                || ends[near] != measures[0]
                || !onwards
                || k != first && self.crossings.contains(&edge)
            {
                break;
            }
            let gone = self.passage.far([at, &stretch.ends[near]]);
            let to = self.passage.far([at, &stretch.ends[far]]);
            last = k;
            if to > length {
                measures[0] += (ends[far] - ends[near]) * (length - gone) / (to - gone);
                break;
            }
            measures[0] = ends[far];
            here = next(k);
        }
        (measures[0] != measures[1]).then_some(Approach {
            stretches: first.min(last)..first.max(last) + 1,
            measures,
        })
    }

    /// The names at the places of a part, from its far end on, but for the crossing.
    fn approached(&mut self, part: &Approach, before: bool, meter: &mut Meter) -> Option<Samples> {
        /// One branch is told from the others if the distance to the crossing changes by no more than this at once.
        const NEARER: f64 = 0.7;
        let count = self.names.len();
        let mut read = Vec::new();
        let mut take = taking(&mut read);
        let mut samples: Samples = std::array::from_fn(|_| vec![[f64::NAN, 0.0]; count + 1]);
        let [far, near] = part.measures;
        let start = if before { 0.0 } else { 1.0 };
        let mut known: Option<(usize, f64, Configuration<f64>)> = None;
        for (place, s) in places().into_iter().enumerate().take(AT) {
            let to = within(part.measures, s);
            let mut ordered: Vec<usize> = part.stretches.clone().collect();
            if before {
                ordered.reverse();
            }
            // the nearest to the crossing that it is on
            let holds = |k: &usize| {
                let (_, [a, b]) = self.stretches[*k].measured();
                a.min(b) <= to && to <= a.max(b)
            };
            let k = ordered.into_iter().find(holds)?;
            let stretch = &self.stretches[k];
            let (_, [begin, end]) = stretch.measured();
            let (mut gone, mut at) = match known.take() {
                Some((of, gone, at)) if of == k => (gone, at),
                _ => (start, stretch.ends[start as usize].clone()),
            };
            loop {
                let here = begin + gone * (end - begin);
                let next = near
                    + (to - near).abs().max(NEARER * (here - near).abs()) * (far - near).signum();
                let last = (next - to).abs() <= 1e-12 * (far - near).abs();
                let part = if last {
                    (to - begin) / (end - begin)
                } else {
                    (next - begin) / (end - begin)
                };
                let (found, time) = self.passage.at(stretch, part, (gone, &at))?;
                (gone, at) = (part, found.clone());
                if last {
                    samples[place][count] = [time, f64::EPSILON];
                    meter.read_row(&Row::of(&at), time, &mut take);
                    break;
                }
            }
            known = Some((k, gone, at));
        }
        meter.read_waiting(&mut take);
        drop(take);
        for (sample, values) in samples.iter_mut().zip(read.chunks_exact(count.max(1))) {
            sample[..count].copy_from_slice(&values[..count]);
        }
        Some(samples)
    }

    /// Takes the polynomial of a name along a part for that on pieces of it: next to the crossing, and where it is better.
    fn continue_name(&mut self, name: usize, fit: &PolynomialFit, part: &Approach) {
        /// At the crossing, beyond the last of its places, rounding grows 15-fold (the sum of the Lagrange polynomials there)
        /// and the distance seen at the second compared place 13-fold (the ratio of the products of distances to the places),
        /// as far as the ninth derivative is constant; here it may be three times as large.
        const GROWS: f64 = 40.0;
        let off = GROWS * fit.may_be_off();
        let [far, near] = part.measures;
        for piece in &mut self.pieces {
            if !part.stretches.contains(&piece.stretch) {
                continue;
            }
            let (_, measures) = self.stretches[piece.stretch].measured();
            let ends = piece.span.map(|at| {
                let measure = measures[0] + at * (measures[1] - measures[0]);
                2.0 * (measure - far) / (near - far) - 1.0
            });
            let beyond = ends[0].min(ends[1]) < -1.0 - 1e-12;
            // in the tenth next to the crossing rounding shows
            let next = ends[0].min(ends[1]) > 0.8;
            let worse = piece.fits[name] == FitQuality::Rough || piece.noise[name] > off;
            if beyond || !next && !worse {
                continue;
            }
            piece.terms[name] = about(
                fit.terms,
                0.5 * (ends[0] + ends[1]),
                0.5 * (ends[1] - ends[0]),
            );
            piece.noise[name] = off;
            piece.fits[name] = FitQuality::Continued;
        }
    }
}
