//! A curve of configurations followed from a place on it, in a box and within limits.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::{Curve, Driven};
use crate::linear::{Decomposition, dot, norm};
use crate::mechanism::{Configuration, Mechanism, turn_near};
use crate::number::tolerance::{LONGEST_STEP, ROUNDING, SAME};
use crate::solve::{Continuation, CurvePoint, Progress, SolutionCurve, Watch};
use crate::system::{Coordinate, Held};

/// A curve whose points are, or contain, configurations.
pub trait ConfigurationCurve: SolutionCurve {
    /// The configuration of a point.
    fn configuration(point: &Self::Point) -> &Configuration<f64>;
    /// The configurations among which it is a curve.
    fn closed(&self) -> &Curve;
    /// True if a component of a step between configurations distinguishes curves.
    fn sees(&self, component: usize) -> bool;

    /// The step from one configuration to another, whole turns left out: as the first components of a tangent.
    fn apart(&self, from: &Self::Point, to: &Self::Point) -> Vec<f64> {
        let [from, to] = [from, to].map(Self::configuration);
        self.closed().difference_but_turns(from, to)
    }

    /// The part of such a step that distinguishes curves.
    fn seen(&self, mut step: Vec<f64>) -> Vec<f64> {
        for (component, x) in step.iter_mut().enumerate() {
            *x *= f64::from(u8::from(self.sees(component)));
        }
        step
    }
}

impl ConfigurationCurve for Curve {
    fn configuration(point: &Configuration<f64>) -> &Configuration<f64> {
        point
    }

    fn closed(&self) -> &Curve {
        self
    }

    fn sees(&self, _: usize) -> bool {
        true
    }
}

/// End of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum LocusEnd {
    /// At its own start: a closed curve.
    Closed,
    /// At an edge of the box.
    Box,
    /// At a limit of a joint.
    Limit,
    /// In a point beyond which no step is certain not to change branch.
    Lost,
}

/// A followed curve.
#[derive(Clone, Debug)]
pub struct Traced<P> {
    /// Places on it, in order.
    pub places: Vec<CurvePoint<P>>,
    /// Ends at the first place and at the last; both [`LocusEnd::Closed`] if the curve closes.
    pub ends: [LocusEnd; 2],
    /// Crossings with other curves.
    pub crossings: Vec<CurvePoint<P>>,
}

/// The box and the limits that curves are followed in.
#[derive(Clone, Copy, Debug)]
pub struct Region<'m> {
    /// The mechanism with its limits.
    pub mechanism: &'m Mechanism,
    /// Held coordinates: their limits do not count.
    pub held: &'m Held<f64>,
    /// The coordinates of the box.
    pub sides: &'m [Driven],
    /// Tolerances and step lengths of the continuation.
    pub method: &'m Continuation,
    /// Asked at every step; a curve that it stops ends there as lost.
    pub watch: &'m Watch<'m>,
    /// The progress reported to it.
    pub now: Progress,
}

impl Region<'_> {
    /// A coordinate of the box at a configuration; angles of platforms near the middle of the box.
    pub fn side(&self, at: &Configuration<f64>, side: &Driven) -> f64 {
        let x = side.coordinate.of(self.mechanism, at);
        match side.coordinate {
            Coordinate::Pose(_, c) if c.is_angle() => {
                let middle = 0.5 * (side.from + side.to);
                turn_near(x, middle)
            }
            _ => x,
        }
    }

    /// Distances of a configuration inside each bound of the box, then inside limits, in rad and characteristic
    /// lengths.
    fn margins(&self, at: &Configuration<f64>) -> Vec<f64> {
        let length = self.mechanism.characteristic_length();
        let unit = |is_angle: bool| if is_angle { 1.0 } else { 1.0 / length };
        let mut margins = Vec::new();
        for side in self.sides {
            let x = self.side(at, side);
            let unit = unit(side.coordinate.is_angle(self.mechanism));
            margins.extend([x - side.from, side.to - x].map(|margin| margin * unit));
        }
        for (i, joint) in self.mechanism.joints().iter().enumerate() {
            let held = self.held.joints[i];
            if let Some((low, high)) = joint.limits.filter(|_| !held) {
                let inside = [at.joints[i] - low, high - at.joints[i]];
                margins.extend(inside.map(|margin| margin * unit(joint.kind.is_angle())));
            }
        }
        margins
    }

    /// True if a configuration is inside the box and the limits.
    pub fn inside(&self, at: &Configuration<f64>) -> bool {
        self.margins(at)
            .into_iter()
            .all(|margin| margin >= -ROUNDING)
    }

    /// The whole curve through a place.
    pub fn traced<C: ConfigurationCurve>(
        &self,
        curve: &mut C,
        place: CurvePoint<C::Point>,
    ) -> Traced<C::Point> {
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
        let back = back.into_iter().rev().map(CurvePoint::reversed);
        let mut all: Vec<_> = back.collect();
        all.pop();
        all.append(&mut places);
        Traced {
            places: all,
            ends: [start, end],
            crossings,
        }
    }

    /// The curve from a place on in the direction of its tangent.
    fn half<C: ConfigurationCurve>(
        &self,
        curve: &mut C,
        start: CurvePoint<C::Point>,
    ) -> Half<C::Point> {
        const STEPS: usize = 100_000;
        let method = self.method;
        let mut places = vec![start.clone()];
        let mut crossings = Vec::new();
        let mut place = start.clone();
        // the ways gone by configurations, and by whole points
        let (mut length, mut gone, mut gone_in_all) = (0.1 * method.longest, 0.0, 0.0);
        // whether no crossing was found ahead of the place
        let mut none_ahead = false;
        for _ in 0..STEPS {
            if self.watch.at(self.now).is_break() {
                break;
            }
            let to = match method.step(curve, &place, length) {
                Ok((to, changed)) => {
                    length = method.next_length(length, changed, &to);
                    to
                }
                Err(_) if length > 1e-3 * method.longest => {
                    length *= 0.5;
                    continue;
                }
                Err(_) => match (!none_ahead).then(|| self.beyond(curve, &place)).flatten() {
                    Some([crossing, to]) => {
                        crossings.push(crossing);
                        length = 0.1 * method.longest;
                        to
                    }
                    None if length > method.shortest => {
                        none_ahead = true;
                        length *= 0.5;
                        continue;
                    }
                    None => return (places, LocusEnd::Lost, crossings),
                },
            };
            gone += norm(&curve.apart(&place.at, &to.at));
            gone_in_all += norm(&curve.difference(&place.at, &to.at));
            // a unit vector of two or more motions has turned all round at one configuration
            if gone < SAME && gone_in_all > TAU {
                return (places, LocusEnd::Closed, crossings);
            }
            let (before, after) = (
                self.margins(C::configuration(&place.at)),
                self.margins(C::configuration(&to.at)),
            );
            let left = (before.iter().zip(&after))
                .enumerate()
                .filter(|(_, (b, a))| **a < -ROUNDING && **a < **b)
                .map(|(i, (b, a))| (i, b.max(0.0) / (b.max(0.0) - a)))
                .min_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((i, _)) = left {
                let end = match i < 2 * self.sides.len() {
                    true => LocusEnd::Box,
                    false => LocusEnd::Limit,
                };
                if before[i] > 0.0 {
                    let mut margin = |_: &mut C, p: &CurvePoint<C::Point>| {
                        self.margins(C::configuration(&p.at))[i]
                    };
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
            none_ahead = false;
        }
        (places, LocusEnd::Lost, crossings)
    }

    /// A crossing of loci just ahead, and the place behind it straight on.
    fn beyond<C: ConfigurationCurve>(
        &self,
        curve: &mut C,
        place: &CurvePoint<C::Point>,
    ) -> Option<[CurvePoint<C::Point>; 2]> {
        let method = self.method;
        let reach = 0.2 * method.longest;
        let point = method.branch_point(curve, &place.at, reach)?;
        let way = curve.difference(&place.at, &point.at);
        let straight = point.straight_on(&way, &place.tangent)?;
        let (to, _) = method.leave(curve, &point.at, &straight)?;
        Some([point.place(curve, &straight), to])
    }
}

/// Places, the end, crossings.
type Half<P> = (Vec<CurvePoint<P>>, LocusEnd, Vec<CurvePoint<P>>);

/// The place of a curve that Gauss–Newton steps of bounded length reach from afar, if they do.
pub fn settled<C: SolutionCurve>(
    curve: &mut C,
    point: C::Point,
    method: &Continuation,
) -> Option<CurvePoint<C::Point>> {
    let near = neared(curve, point, |size, _| size < 1e-3)?;
    method.settle(curve, near).ok()
}

/// The point that bounded Gauss–Newton steps reach from afar; `arrived` gets the next step's size and the residual.
pub fn neared<C: SolutionCurve>(
    curve: &mut C,
    mut point: C::Point,
    arrived: impl Fn(f64, &[f64]) -> bool,
) -> Option<C::Point> {
    const STEPS: usize = 40;
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
        if arrived(size, &residual) {
            return Some(point);
        }
        let factor = (LONGEST_STEP / size).min(1.0);
        step.iter_mut().for_each(|x| *x *= -factor);
        point = curve.displaced(&point, &step);
    }
    None
}

/// Position of a place on a traced curve: the index of the last point before it plus the part of the way to the next;
/// `None` if the curve does not pass through it.
pub fn met_at<C: ConfigurationCurve>(
    curve: &mut C,
    traced: &Traced<C::Point>,
    place: &CurvePoint<C::Point>,
    method: &Continuation,
) -> Option<f64> {
    let goal = C::configuration(&place.at);
    let mut step = vec![0.0; curve.closed().unknowns()];
    let mut distance = |i: usize| {
        let from = C::configuration(&traced.places[i].at);
        (curve.closed()).difference_but_turns_into(from.view(), goal.view(), &mut step);
        let seen = (step.iter().enumerate()).filter(|(component, _)| curve.sees(*component));
        seen.map(|(_, x)| x * x).sum::<f64>().sqrt()
    };
    let nearest = (0..traced.places.len())
        .map(|i| (i, distance(i)))
        .min_by(|a, b| a.1.total_cmp(&b.1));
    let (i, apart) = nearest.filter(|(_, apart)| *apart < 2.0 * method.longest)?;
    if apart < SAME {
        return Some(i as f64);
    }
    // a curve on which nothing moves that is seen may cross others, and is none of them
    if norm(&curve.seen(place.tangent[..step.len()].to_vec())) < SAME {
        return None;
    }
    // the foot of the place on a piece, by Newton steps from one of its ends
    let foot_from = |curve: &mut C, from: &CurvePoint<C::Point>, to: &CurvePoint<C::Point>| {
        const STEPS: usize = 12;
        let tangent = from.tangent[..curve.closed().unknowns()].to_vec();
        let tangent = curve.seen(tangent);
        let [before, after] = [from, to].map(|end| dot(&curve.apart(&end.at, &place.at), &tangent));
        if (before < 0.0) == (after < 0.0) {
            return None;
        }
        let end = dot(&curve.difference(&from.at, &to.at), &from.tangent);
        let (part, slope) = (before / (before - after), (before - after) / end);
        let mut along = part * end;
        for _ in 0..STEPS {
            let (point, _) = method.ahead(curve, from, along)?;
            let gap = curve.seen(curve.apart(&point, &place.at));
            let apart = norm(&gap);
            if apart < SAME {
                return Some(part);
            }
            let step = dot(&gap, &tangent) / slope;
            // tangents turn by less than 60° on a piece, so that a foot is no farther away
            if apart > 3.0 * step.abs() {
                return None;
            }
            along += step;
        }
        None
    };
    let foot = |curve: &mut C, i: usize| {
        let from = &method.restored(curve, &traced.places[i])?;
        let to = &method.restored(curve, &traced.places[i + 1])?;
        // where others cross between them, only one of both leads there by sure steps
        let part =
            foot_from(curve, from, to).or_else(|| Some(1.0 - foot_from(curve, to, from)?))?;
        Some(i as f64 + part)
    };
    // a closed curve begins and ends at one place
    let pieces = traced.places.len() - 1;
    let round = traced.ends[1] == LocusEnd::Closed && (i == 0 || i == pieces);
    let beside = match round {
        true => [pieces.checked_sub(1), (pieces > 0).then_some(0)],
        false => [i.checked_sub(1), (i < pieces).then_some(i)],
    };
    beside.into_iter().flatten().find_map(|i| foot(curve, i))
}

/// The place between two where the curve comes back to its start, after the length `gone`.
pub(super) fn closed<C: ConfigurationCurve>(
    curve: &mut C,
    start: &CurvePoint<C::Point>,
    from: &CurvePoint<C::Point>,
    to: &CurvePoint<C::Point>,
    gone: f64,
    method: &Continuation,
) -> Option<CurvePoint<C::Point>> {
    let step = norm(&curve.apart(&from.at, &to.at));
    if gone <= 1.5 * step || norm(&curve.apart(&from.at, &start.at)) > 2.0 * step {
        return None;
    }
    let freedoms = curve.apart(&start.at, &start.at).len();
    let tangent = start.tangent[..freedoms].to_vec();
    let mut ahead =
        |curve: &mut C, p: &CurvePoint<C::Point>| dot(&curve.apart(&start.at, &p.at), &tangent);
    if !(ahead(curve, from) < 0.0 && ahead(curve, to) >= 0.0) {
        return None;
    }
    let place = method.root(curve, from, to, &mut ahead);
    let apart = norm(&curve.apart(&start.at, &place.at));
    (apart < SAME && dot(&place.tangent[..freedoms], &tangent) > 0.0).then_some(place)
}
