//! The least and greatest values of quantities over a motion, and where they have no bound.

mod bounds;

use std::cmp::Ordering;

use super::Meter;
use super::course::{Course, Sought};
use super::means::means;
use super::poles::{change_of_sign, middle_of_gap, unbounded};
use crate::algebra::SiUnit;
use crate::analysis::sweep::{Extreme, Extremum, Missing, Pole};
use crate::mechanism::{Measured, Order, Quantity};
use crate::number::sorting::sort_by;
use crate::number::tolerance::{NOT_PRINTED, ROUNDING, SAME, SOLVED};
use crate::solve::summit;
use bounds::{Bounds, bounds};

/// The senses of least and greatest.
const SENSES: [f64; 2] = [-1.0, 1.0];

/// The extremes of quantities over a curve, with a meter that reads them.
pub(crate) fn located(
    course: &mut Course,
    quantities: &[Quantity],
    sought: &[Sought],
    meter: &mut Meter,
    all_means: bool,
) -> Vec<Extremum> {
    let all = quantities.iter().zip(sought).enumerate();
    let all = all.map(|(i, (quantity, of))| {
        let bounds = bounds(course, of);
        // means tell of forces, powers and energies
        let means = (all_means || quantity.unit.has_force())
            .then(|| means(course, of))
            .flatten();
        let found = extremum(course, meter, (i, quantity, of), bounds);
        let swing = means.filter(|_| quantity.unit == SiUnit::WATT);
        Extremum {
            mean: means.map(|of| of.mean),
            rms: means.map(|of| of.rms),
            work: swing.map(|of| of.mean * meter.duration()),
            fluctuation: swing.map(|of| of.swing * meter.duration()),
            ..found
        }
    });
    all.collect()
}

fn extremum(
    course: &mut Course,
    meter: &mut Meter,
    (i, quantity, sought): (usize, &Quantity, &Sought),
    bounds: Bounds,
) -> Extremum {
    let none = Extremum {
        name: quantity.name.clone(),
        unit: quantity.unit,
        constant: None,
        least: None,
        greatest: None,
        unbounded: Vec::new(),
        at_least: bounds.cut,
        missing: None,
        mean: None,
        rms: None,
        work: None,
        fluctuation: None,
    };
    let [Some(least), Some(greatest)] = bounds.best else {
        return Extremum {
            missing: course.whole.then(|| missing(quantity)),
            at_least: false,
            ..none
        };
    };
    // one value is within what rounding leaves open everywhere
    let [low, high] = bounds.allowed;
    let [least_value, greatest_value] = [least.0, greatest.0];
    let differ = greatest_value - least_value;
    if course.moves()
        && low <= high
        && differ <= 4.0 * bounds.slack(greatest_value).max(bounds.slack(least_value))
    {
        let zero = low <= 0.0 && high >= 0.0;
        return Extremum {
            constant: Some(if zero { 0.0 } else { 0.5 * (low + high) }),
            ..none
        };
    }
    let driven = course.is_driven();
    let mut poles: Vec<Pole> = Vec::new();
    let mut best = [least, greatest].map(|(value, piece, s)| {
        let (stretch, part) = course.place(piece, s);
        FoundExtreme {
            value,
            stretch,
            part,
            beside: course.margin(sought, piece),
        }
    });
    let mut known: Vec<(usize, f64)> = Vec::new();
    // at a dead point or a pole there is no value, and rounding may hide that those beside it have no bound
    let suspects = bounds
        .suspects
        .iter()
        .map(|&(piece, s)| course.place(piece, s));
    let mut suspects: Vec<(usize, f64)> = suspects.collect();
    for stretch in 0..course.stretches() {
        for part in [0.0, 1.0] {
            let piece = course.piece(stretch, part);
            if piece.is_some_and(|piece| course.is_continued(sought, piece)) {
                continue;
            }
            let value = course
                .read(meter, (stretch, part))
                .and_then(|(all, _)| all[i]);
            suspects.extend(value.is_none().then_some((stretch, part)));
        }
    }
    for (stretch, part) in suspects {
        /// Poles sought at most.
        const MOST: usize = 1000;
        let again = |(of, at): &(usize, f64)| *of == stretch && (at - part).abs() < ROUNDING;
        if known.len() == MOST || known.iter().any(again) {
            continue;
        }
        known.push((stretch, part));
        match pole(course, meter, i, (stretch, part), driven) {
            Some(pole) => merge(&mut poles, pole),
            // a kink, where there may be more than beside it
            None => {
                for (best, sense) in best.iter_mut().zip(SENSES) {
                    let found = FoundExtreme {
                        stretch,
                        part,
                        beside: Some(KINK),
                        ..*best
                    };
                    let found = found.refined(course, meter, i, sense);
                    if found.is_some_and(|of| sense * of.value > sense * best.value) {
                        *best = found.unwrap_or(*best);
                    }
                }
            }
        }
    }
    sort_by(&mut poles, |a, b| {
        a.time.partial_cmp(&b.time).unwrap_or(Ordering::Equal)
    });
    let largest = least_value.abs().max(greatest_value.abs());
    let mut sides = best.into_iter().zip(SENSES).map(|(best, sense)| {
        let found = best.refined(course, meter, i, sense).unwrap_or(best);
        let (at, time) = course.at(found.stretch, found.part)?;
        let (at, time) = (at.clone(), time);
        Some(Extreme {
            value: if found.value.abs() > SOLVED * largest {
                found.value
            } else {
                0.0
            },
            time: driven.then_some(time),
            inputs: course.inputs(&at),
            joints: at.joints,
        })
    });
    let [least, greatest] = [sides.next().flatten(), sides.next().flatten()];
    let bounded = |upwards: bool| {
        let mut sides = poles.iter().flat_map(|pole| pole.upwards);
        !sides.any(|side| side == Some(upwards))
    };
    Extremum {
        least: least.filter(|_| bounded(false)),
        greatest: greatest.filter(|_| bounded(true)),
        unbounded: poles,
        ..none
    }
}

/// The part of a stretch on either side of a kink or a pole where it may be.
const KINK: f64 = 1e-7;

/// The best value so far, at a part of a stretch.
#[derive(Clone, Copy)]
struct FoundExtreme {
    value: f64,
    stretch: usize,
    part: f64,
    /// Largest distance of the extreme from there; `None` if it is not read again.
    beside: Option<f64>,
}

impl FoundExtreme {
    /// The value read exactly, where it is best near the place.
    fn refined(self, course: &mut Course, meter: &mut Meter, i: usize, sense: f64) -> Option<Self> {
        let beside = self.beside?;
        let mut read = |part: f64| {
            // the motion goes no farther
            if !(0.0..=1.0).contains(&part) {
                return None;
            }
            meter.settle(i, self.value);
            Some(sense * course.read(meter, (self.stretch, part))?.0[i]?)
        };
        let here = read(self.part).map(|height| (self.part, height));
        let ends = [self.part - beside, self.part + beside];
        let [from, to] = ends.map(|part| part.clamp(0.0, 1.0));
        let ends = [from, to].map(|part| Some((part, read(part)?)));
        // beyond an edge there is no value
        let top = summit(from, to, |part| {
            Some(read(part).unwrap_or(f64::NEG_INFINITY))
        });
        let all = [here, top].into_iter().chain(ends).flatten();
        let best = all.reduce(|a, b| if b.1 > a.1 { b } else { a });
        best.filter(|of| of.1.is_finite())
            .map(|(part, height)| FoundExtreme {
                value: sense * height,
                part,
                ..self
            })
    }
}

/// The place near one where no bound was found, if the quantity grows without bound there.
fn pole(
    course: &mut Course,
    meter: &mut Meter,
    i: usize,
    (stretch, part): (usize, f64),
    driven: bool,
) -> Option<Pole> {
    let mut read = |part: f64| {
        let value = course.read(meter, (stretch, part))?.0[i];
        Some((value, meter.noise()[i]))
    };
    let [from, to] = [part - KINK, part + KINK].map(|part| part.clamp(0.0, 1.0));
    let mut gap = None;
    let place = match part {
        _ if part < NOT_PRINTED => 0.0,
        _ if part > 1.0 - NOT_PRINTED => 1.0,
        _ => {
            let mut value = |part: f64| read(part).and_then(|(value, _)| value);
            let top = summit(from, to, |part| {
                let value = value(part);
                if value.is_none() {
                    gap = Some(part);
                }
                Some(value?.abs())
            });
            match (top, gap, value(from), value(to)) {
                (_, _, Some(a), Some(b)) if a * b < 0.0 => {
                    change_of_sign([from, to], a, &mut value)
                }
                (Some((part, _)), ..) => part,
                (None, Some(gap), ..) => middle_of_gap(gap, &mut value),
                (None, None, ..) => part,
            }
        }
    };
    let upwards = unbounded(place, &mut |part| {
        let (value, noise) = read(part)?;
        // what is nothing but rounding grows where it is divided by little
        value.map(|x| if x.abs() > 4.0 * noise { x } else { 0.0 })
    });
    if upwards == [None; 2] {
        return None;
    }
    let (at, time) = course.at(stretch, place)?;
    let at = at.clone();
    Some(Pole {
        time: driven.then_some(time),
        inputs: course.inputs(&at),
        joints: at.joints,
        upwards,
    })
}

/// The reason why a quantity has no value anywhere.
fn missing(quantity: &Quantity) -> Missing {
    if (quantity.measured()).any(|of| matches!(of, Measured::Transmission(_))) {
        return Missing::PlanarLoop;
    }
    let still = |of: &Measured| match of {
        Measured::Parameter(_) => true,
        Measured::Joint(_, order) | Measured::Place(_, _, order) => *order == Order::Value,
        _ => false,
    };
    match quantity.measured().all(still) {
        true => Missing::Expression,
        false => Missing::Rates,
    }
}

/// Adds a pole to others; each is seen from either side.
fn merge(poles: &mut Vec<Pole>, pole: Pole) {
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < SAME);
    let same =
        |known: &&mut Pole| near(&known.inputs, &pole.inputs) && near(&known.joints, &pole.joints);
    match poles.iter_mut().find(same) {
        Some(known) => {
            for (known, side) in known.upwards.iter_mut().zip(pole.upwards) {
                *known = known.or(side);
            }
        }
        None => poles.push(pole),
    }
}
