//! A locus followed from a place on it.

use super::curve::{LocusCurve, Singular};
use super::locus::LocusEnd;
use crate::linear::{Decomposition, dot, norm};
use crate::mechanism::{Configuration, Mechanism};
use crate::solve::{Continuation, Place, SolutionCurve};
use crate::system::{Driven, Held, Holdable};

pub(super) type At = Place<Singular>;

/// A curve as it was followed.
pub(super) struct Traced {
    pub places: Vec<At>,
    pub ends: [LocusEnd; 2],
    pub crossings: Vec<At>,
}

/// The box and the limits that loci are followed in.
pub(super) struct Region<'m> {
    pub mechanism: &'m Mechanism,
    pub held: &'m Held<f64>,
    pub sides: [Driven; 2],
    pub method: &'m Continuation,
}

impl Region<'_> {
    /// A coordinate of the box at a configuration; angles of platforms near the middle of the box.
    pub fn side(&self, at: &Configuration<f64>, side: &Driven) -> f64 {
        let x = side.coordinate.of(at);
        match side.coordinate {
            Holdable::Coordinate(_, c) if c.is_angle() => {
                let middle = 0.5 * (side.from + side.to);
                let turn = std::f64::consts::TAU;
                x - turn * ((x - middle) / turn).round()
            }
            _ => x,
        }
    }

    /// How far a configuration is inside each bound, of the box and then of limits.
    fn margins(&self, at: &Configuration<f64>) -> Vec<f64> {
        let mut margins = Vec::new();
        for side in &self.sides {
            let x = self.side(at, side);
            margins.extend([x - side.from, side.to - x]);
        }
        for (i, joint) in self.mechanism.joints().iter().enumerate() {
            let held = self.held.joints[i];
            if let Some((low, high)) = joint.limits.filter(|_| !held) {
                margins.extend([at.joints[i] - low, high - at.joints[i]]);
            }
        }
        margins
    }

    /// Whether it is inside all of them.
    pub fn inside(&self, at: &Configuration<f64>) -> bool {
        self.margins(at).into_iter().all(|margin| margin >= -1e-9)
    }

    /// The whole curve through a place.
    pub fn traced(&self, curve: &mut LocusCurve, place: At) -> Traced {
        let (mut places, end, mut crossings) = self.half(curve, place.clone());
        if end == LocusEnd::Closed {
            return Traced {
                places,
                ends: [end; 2],
                crossings,
            };
        }
        let (back, start, more) = self.half(curve, place.reversed());
        crossings.extend(more);
        let back = back.into_iter().rev().map(Place::reversed);
        let mut all: Vec<At> = back.collect();
        all.pop();
        all.append(&mut places);
        Traced {
            places: all,
            ends: [start, end],
            crossings,
        }
    }

    /// The curve from a place on in the direction of its tangent.
    fn half(&self, curve: &mut LocusCurve, start: At) -> (Vec<At>, LocusEnd, Vec<At>) {
        const STEPS: usize = 100_000;
        let method = self.method;
        let mut places = vec![start.clone()];
        let mut crossings = Vec::new();
        let mut place = start.clone();
        let (mut length, mut gone) = (0.1 * method.longest, 0.0);
        for _ in 0..STEPS {
            let to = match method.step(curve, &place, length) {
                Ok((to, changed)) => {
                    length = method.next_length(length, changed);
                    to
                }
                Err(_) if length > 1e-3 * method.longest => {
                    length *= 0.5;
                    continue;
                }
                Err(_) => match self.beyond(curve, &place) {
                    Some((crossing, to)) => {
                        crossings.push(crossing);
                        length = 0.1 * method.longest;
                        to
                    }
                    None if length > method.shortest => {
                        length *= 0.5;
                        continue;
                    }
                    None => return (places, LocusEnd::Lost, crossings),
                },
            };
            gone += norm(&curve.apart(&place.at, &to.at));
            let (before, after) = (self.margins(&place.at.at), self.margins(&to.at.at));
            let left = (before.iter().zip(&after))
                .enumerate()
                .filter(|(_, (b, a))| **a < 0.0 && **a < **b)
                .map(|(i, (b, a))| (i, b.max(0.0) / (b.max(0.0) - a)))
                .min_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((i, _)) = left {
                let end = match i < 4 {
                    true => LocusEnd::Box,
                    false => LocusEnd::Limit,
                };
                if before[i] > 0.0 {
                    let mut margin = |_: &mut LocusCurve, p: &At| self.margins(&p.at.at)[i];
                    places.push(method.root(curve, &place, &to, &mut margin));
                }
                return (places, end, crossings);
            }
            if let Some(end) = closed(curve, &start, &place, &to, gone, method) {
                places.push(end);
                return (places, LocusEnd::Closed, crossings);
            }
            places.push(to.clone());
            place = to;
        }
        (places, LocusEnd::Lost, crossings)
    }

    /// A crossing of loci just ahead, and the place behind it straight on.
    fn beyond(&self, curve: &mut LocusCurve, place: &At) -> Option<(At, At)> {
        let method = self.method;
        let reach = 0.2 * method.longest;
        let point = method.branch_point(curve, &place.at, reach)?;
        let way = curve.difference(&place.at, &point.at);
        if dot(&way, &place.tangent) < 0.9 * norm(&way) {
            return None;
        }
        let along = |d: &Vec<f64>| dot(d, &place.tangent);
        let straight = (point.directions.iter())
            .max_by(|a, b| along(a).abs().total_cmp(&along(b).abs()))
            .filter(|d| along(d).abs() > 0.9)?;
        let sign = along(straight).signum();
        let straight: Vec<f64> = straight.iter().map(|x| sign * x).collect();
        let (to, _) = method.leave(curve, &point.at, &straight)?;
        Some((point.place(curve, &straight), to))
    }
}

/// The singular place that Gauss–Newton steps of bounded length reach, if they do.
pub(super) fn settled(
    curve: &mut LocusCurve,
    mut point: Singular,
    method: &Continuation,
) -> Option<At> {
    const STEPS: usize = 40;
    const LONGEST: f64 = 0.5;
    let regular = curve.unknowns().saturating_sub(1);
    for _ in 0..STEPS {
        let (residual, jacobian) = curve.linearise(&point);
        if !jacobian.iter().chain(&residual).all(|x| x.is_finite()) {
            return None;
        }
        let decomposition =
            Decomposition::of_rank(residual.len(), curve.unknowns(), &jacobian, regular);
        let mut step = decomposition.solve(&residual);
        let size = norm(&step);
        if size < 1e-3 {
            return method.settle(curve, point).ok();
        }
        let factor = (LONGEST / size).min(1.0);
        step.iter_mut().for_each(|x| *x *= -factor);
        point = curve.displaced(&point, &step);
    }
    None
}

/// Whether a curve passes through a place.
pub(super) fn passes(
    curve: &mut LocusCurve,
    traced: &Traced,
    place: &At,
    method: &Continuation,
) -> bool {
    const SAME: f64 = 1e-6;
    let distance = |curve: &LocusCurve, i: usize| {
        norm(&curve.seen(&curve.apart(&traced.places[i].at, &place.at)))
    };
    let nearest = (0..traced.places.len())
        .map(|i| (i, distance(curve, i)))
        .min_by(|a, b| a.1.total_cmp(&b.1));
    let Some((i, apart)) = nearest.filter(|(_, apart)| *apart < 2.0 * method.longest) else {
        return false;
    };
    if apart < SAME {
        return true;
    }
    // the foot of the place on the pieces beside the nearest point
    let freedoms = curve.closed().unknowns();
    let foot = |curve: &mut LocusCurve, from: &At, to: &At| {
        let tangent = curve.seen(&from.tangent[..freedoms]);
        let mut ahead =
            |curve: &mut LocusCurve, p: &At| dot(&curve.apart(&p.at, &place.at), &tangent);
        if (ahead(curve, from) < 0.0) == (ahead(curve, to) < 0.0) {
            return false;
        }
        let foot = method.root(curve, from, to, &mut ahead);
        norm(&curve.seen(&curve.apart(&foot.at, &place.at))) < SAME
    };
    let places = &traced.places;
    (i > 0 && foot(curve, &places[i - 1], &places[i]))
        || (i + 1 < places.len() && foot(curve, &places[i], &places[i + 1]))
}

/// The place between two where the curve comes back to its start.
fn closed(
    curve: &mut LocusCurve,
    start: &At,
    from: &At,
    to: &At,
    gone: f64,
    method: &Continuation,
) -> Option<At> {
    const SAME: f64 = 1e-6;
    let step = norm(&curve.apart(&from.at, &to.at));
    if gone <= 1.5 * step || norm(&curve.apart(&from.at, &start.at)) > 2.0 * step {
        return None;
    }
    let freedoms = curve.closed().unknowns();
    let tangent = start.tangent[..freedoms].to_vec();
    let mut ahead = |curve: &mut LocusCurve, p: &At| dot(&curve.apart(&start.at, &p.at), &tangent);
    if !(ahead(curve, from) < 0.0 && ahead(curve, to) >= 0.0) {
        return None;
    }
    let place = method.root(curve, from, to, &mut ahead);
    let apart = norm(&curve.apart(&start.at, &place.at));
    (apart < SAME && dot(&place.tangent[..freedoms], &tangent) > 0.0).then_some(place)
}
