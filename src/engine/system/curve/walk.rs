//! Following a curve of assembled configurations and locating its special points.

use std::ops::ControlFlow;

use super::Curve;
use super::trace::closed;
use crate::description::Role;
use crate::linear::{dot, norm};
use crate::mechanism::{Configuration, Mechanism};
use crate::number::tolerance::{NOT_PRINTED, SAME};
use crate::number::{real, sorting::sort_by};
use crate::solve::{ALIGNED, BranchPoint, Continuation, CurvePoint, SolutionCurve, StepFailure};

type CurvePlace = CurvePoint<Configuration<f64>>;

/// A function of places whose zeros are to be located; they are reported by its number.
pub type Monitor<'m> = Box<dyn FnMut(&mut Curve, &CurvePlace) -> f64 + 'm>;

/// A special point of the curve.
#[derive(Clone, Debug)]
pub enum Event {
    /// A joint turns back at the end of its range, where driven it would lock; in large mechanisms an actuated one.
    Turning(usize),
    /// The inputs turn back: beyond this part of the segment the branch does not exist.
    Fold,
    /// A joint reaches a limit, from within.
    Limit {
        /// The joint.
        joint: usize,
        /// The limit, rad or m.
        value: f64,
        /// True for the upper limit.
        upper: bool,
    },
    /// The inputs reach the start (`false`) or the end (`true`) of the segment.
    End(bool),
    /// A function to be watched vanishes.
    Root(usize),
    /// The curve has come back to where it began.
    Closed,
    /// Branches meet.
    Branches(Box<BranchPoint<Configuration<f64>>>),
}

/// A piece of a curve without branch points inside, with the events on it, in order.
#[derive(Clone, Debug)]
pub struct Segment {
    /// Its beginning.
    pub from: CurvePlace,
    /// Its end; the Jacobian there is singular if branches meet.
    pub to: CurvePlace,
    /// The length of the curve up to its beginning, in rad and characteristic lengths.
    pub gone: f64,
    /// Events on it, each with its place.
    pub events: Vec<(CurvePlace, Event)>,
}

/// A walk along a curve, in steps that cannot change branch unnoticed ([`Continuation::step`]).
pub struct Walk<'m> {
    method: Continuation,
    monitors: Vec<Monitor<'m>>,
    /// Joints with their limits, and how far beyond them they stand at one.
    limits: Vec<(usize, [f64; 2], f64)>,
    /// The joints whose turning points are located, with their columns.
    turning: Vec<(usize, usize)>,
    start: CurvePlace,
    place: CurvePlace,
    length: f64,
    gone: f64,
    /// σ of the place before with the length of the step to here, while it falls.
    falling: Option<(f64, f64)>,
    tried: f64,
    /// A branch point that was reached but not yet left.
    waiting: Option<Box<BranchPoint<Configuration<f64>>>>,
}

impl<'m> Walk<'m> {
    /// A walk from a regular place along its tangent, with joints [within their limits](Mechanism::turn_to_limits).
    pub fn new(
        mechanism: &Mechanism,
        curve: &Curve,
        start: CurvePlace,
        method: Continuation,
    ) -> Self {
        let limits = mechanism.joints().iter().enumerate();
        let limits = limits.filter(|(joint, _)| curve.column(*joint).is_some());
        let turning = mechanism.joints().iter().enumerate();
        let turning = turning
            .filter(|(_, joint)| joint.role == Role::Actuated || !curve.system().is_large())
            .filter_map(|(joint, _)| Some((joint, curve.column(joint)?)));
        Walk {
            turning: turning.collect(),
            limits: limits
                .filter_map(|(joint, j)| j.limits.map(|ends| (joint, ends.into(), j.slack())))
                .collect(),
            length: 0.1 * method.longest,
            place: start.clone(),
            start,
            method,
            monitors: Vec::new(),
            gone: 0.0,
            falling: None,
            tried: f64::INFINITY,
            waiting: None,
        }
    }

    /// Also locates the zeros of these functions.
    pub fn watching(mut self, monitors: Vec<Monitor<'m>>) -> Self {
        self.monitors = monitors;
        self
    }

    /// The present place of the walk.
    pub fn place(&self) -> &CurvePlace {
        &self.place
    }

    /// Walks leg by leg until the visitor breaks; returns its value.
    ///
    /// # Errors
    /// As [`Walk::advance`].
    pub fn follow<B>(
        &mut self,
        curve: &mut Curve,
        mut visit: impl FnMut(&mut Curve, &Segment) -> ControlFlow<B>,
    ) -> Result<B, StepFailure> {
        loop {
            let leg = self.advance(curve)?;
            if let ControlFlow::Break(value) = visit(curve, &leg) {
                return Ok(value);
            }
        }
    }

    /// The next leg. After one that ended where branches meet, the walk continues straight on.
    ///
    /// # Errors
    /// If no step is short enough to be sure, which happens where the curve ends in a point of higher order.
    pub fn advance(&mut self, curve: &mut Curve) -> Result<Segment, StepFailure> {
        if let Some(point) = self.waiting.take() {
            return self.leave(curve, &point);
        }
        if let Some(leg) = self.branches_ahead(curve) {
            return Ok(leg);
        }
        loop {
            match self.method.step(curve, &self.place, self.length) {
                Ok((to, changed)) => {
                    let (least, before) = (to.least(), self.place.least());
                    self.falling = (least < before).then_some((before, self.length));
                    let from = std::mem::replace(&mut self.place, to.clone());
                    let length = self.length;
                    self.length = self.method.next_length(length, changed, &to);
                    let leg = self.leg(curve, from, to);
                    self.gone = leg.gone_at(curve, &leg.to);
                    return Ok(leg);
                }
                Err(_) => {
                    if let Some(leg) = self.branches_ahead(curve) {
                        return Ok(leg);
                    }
                    self.length *= 0.5;
                    if self.length < self.method.shortest {
                        return Err(StepFailure::TooShort);
                    }
                }
            }
        }
    }

    /// The leg to a branch point, if the singular value across the curve falls to zero nearby.
    fn branches_ahead(&mut self, curve: &mut Curve) -> Option<Segment> {
        let (before, length) = self.falling?;
        let least = self.place.least();
        let ahead = least * length / (before - least);
        if ahead > 0.2 * self.method.longest || ahead > 0.5 * self.tried {
            return None;
        }
        self.tried = ahead;
        let step: Vec<f64> = self.place.tangent.iter().map(|x| x * ahead).collect();
        let guess = curve.displaced(&self.place.at, &step);
        let point = self.method.branch_point(curve, &guess, 2.0 * ahead)?;
        let way = curve.difference(&self.place.at, &point.at);
        let direction = point.straight_on(&way, &self.place.tangent)?;
        let to = point.place(curve, &direction);
        let from = self.place.clone();
        let mut leg = self.leg(curve, from, to.clone());
        // what ends the walk may come first, and is then met by shorter steps
        if leg.events.iter().any(|(_, event)| event.ends()) && norm(&way) > SAME {
            return None;
        }
        self.gone = leg.gone_at(curve, &to);
        self.place = to.clone();
        self.waiting = Some(Box::new(point.clone()));
        leg.events.push((to, Event::Branches(Box::new(point))));
        Some(leg)
    }

    /// Leaves a branch point straight on.
    fn leave(
        &mut self,
        curve: &mut Curve,
        point: &BranchPoint<Configuration<f64>>,
    ) -> Result<Segment, StepFailure> {
        let from = self.place.clone();
        let (to, length) =
            (self.method.leave(curve, &point.at, &from.tangent)).ok_or(StepFailure::Singular)?;
        self.falling = None;
        self.tried = f64::INFINITY;
        self.length = 0.3 * length;
        self.place = to.clone();
        let leg = self.leg(curve, from, to);
        self.gone = leg.gone_at(curve, &leg.to);
        Ok(leg)
    }

    /// The special points between two places.
    fn leg(&mut self, curve: &mut Curve, from: CurvePlace, to: CurvePlace) -> Segment {
        let method = &self.method.clone();
        let mut events: Vec<(CurvePlace, Event)> = Vec::new();
        let changes = |a: f64, b: f64| (a < 0.0) != (b < 0.0) && a.abs().max(b.abs()) > NOT_PRINTED;
        for &(joint, column) in &self.turning {
            if changes(from.tangent[column], to.tangent[column]) {
                let place = method.root(curve, &from, &to, &mut |_, p| p.tangent[column]);
                events.push((place, Event::Turning(joint)));
            }
        }
        if !curve.inputs().is_empty() {
            let rate = |curve: &Curve, p: &CurvePlace| curve.part_rate(&p.at, &p.tangent);
            if changes(rate(curve, &from), rate(curve, &to)) {
                let place = method.root(curve, &from, &to, &mut |c, p| rate(c, p));
                events.push((place, Event::Fold));
            }
            for (end, outward) in [(0.0, -1.0), (1.0, 1.0)] {
                let beyond =
                    move |curve: &Curve, p: &CurvePlace| outward * (curve.part(&p.at) - end);
                let (a, b) = (beyond(curve, &from), beyond(curve, &to));
                // the inputs may turn back just beyond the end
                let fold = events
                    .iter()
                    .find(|(_, event)| matches!(event, Event::Fold));
                let fold = fold.filter(|(place, _)| beyond(curve, place) > 1e-12);
                let reached = match (b >= 0.0, fold) {
                    (true, _) => Some(&to),
                    (false, fold) => fold.map(|(place, _)| place),
                };
                if let Some(reached) = reached.filter(|_| a < -1e-12) {
                    let place = method.root(curve, &from, reached, &mut |c, p| beyond(c, p));
                    events.push((place, Event::End(end == 1.0)));
                }
            }
        }
        for &(joint, [low, high], slack) in &self.limits {
            for (value, upper) in [(low, false), (high, true)] {
                let sign = if upper { 1.0 } else { -1.0 };
                let beyond = |p: &CurvePlace| sign * (p.at.joints[joint] - value);
                let (a, b) = (beyond(&from), beyond(&to));
                if b > slack && b > a {
                    let place = match a < 0.0 {
                        true => method.root(curve, &from, &to, &mut |_, p| beyond(p)),
                        false => from.clone(),
                    };
                    let limit = Event::Limit {
                        joint,
                        value,
                        upper,
                    };
                    events.push((place, limit));
                }
            }
        }
        for (i, monitor) in self.monitors.iter_mut().enumerate() {
            let (a, b) = (monitor(curve, &from), monitor(curve, &to));
            if (a < 0.0) != (b < 0.0) {
                let place = method.root(curve, &from, &to, monitor);
                events.push((place, Event::Root(i)));
            }
        }
        let gone = self.gone;
        let back = match closed(curve, &self.start, &from, &to, gone, method) {
            None if gone > 0.0 => passed_beside_a_crossing(curve, &self.start, &from, &to),
            back => back,
        };
        if let Some(place) = back {
            events.push((place, Event::Closed));
        }
        let along = |p: &CurvePlace| dot(&curve.difference(&from.at, &p.at), &from.tangent);
        sort_by(&mut events, |(a, _), (b, _)| along(a).total_cmp(&along(b)));
        Segment {
            from,
            to,
            gone,
            events,
        }
    }
}

/// The start, if it lies between a crossing and a place beside it, on the branch that joins them: there no step leads
/// from one to the other. Branches are distinguished by their directions, as where they are left.
fn passed_beside_a_crossing(
    curve: &Curve,
    start: &CurvePlace,
    from: &CurvePlace,
    to: &CurvePlace,
) -> Option<CurvePlace> {
    let crossing = [from, to].into_iter().find(|place| place.is_singular())?;
    let way = curve.difference_but_turns(&crossing.at, &start.at);
    let end = |place: &CurvePlace| {
        dot(
            &curve.difference(&crossing.at, &place.at),
            &crossing.tangent,
        )
    };
    let (along, beside) = (dot(&way, &crossing.tangent), norm(&way));
    let between = (along - end(from)) * (end(to) - along) >= 0.0;
    let straight = along.abs() >= ALIGNED * beside && beside > 0.0;
    let alike = dot(&start.tangent, &crossing.tangent) >= ALIGNED;
    (between && straight && alike).then(|| {
        let mut place = start.clone();
        place.at = curve.displaced(&crossing.at, &way);
        place
    })
}

impl Segment {
    /// The length of the curve up to a place of this leg, in rad and characteristic lengths.
    ///
    /// A chord c between tangents θ apart spans the arc c·(θ/2)/sin(θ/2) of a circle; that of the curve
    /// differs from it in the fifth order of the step.
    pub fn gone_at(&self, curve: &Curve, place: &CurvePlace) -> f64 {
        let chord = norm(&curve.difference(&self.from.at, &place.at));
        let tangents = self.from.tangent.iter().zip(&place.tangent);
        let apart: Vec<f64> = tangents.map(|(a, b)| b - a).collect();
        let half_sine = (0.5 * norm(&apart)).min(1.0);
        let bulge = match half_sine > 0.0 {
            true => real::asin(half_sine) / half_sine,
            false => 1.0,
        };
        self.gone + chord * bulge
    }
}

impl Event {
    /// True if following ends at the event.
    pub fn ends(&self) -> bool {
        matches!(self, Event::Limit { .. } | Event::End(_) | Event::Closed)
    }
}
