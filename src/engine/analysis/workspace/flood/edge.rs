//! The way from a node to its neighbour, in steps that cannot change branch unnoticed.

use super::neighbour::Flood;
use crate::analysis::workspace::problem::MapProblem;
use crate::linear::Decomposition;
use crate::mechanism::Configuration;
use crate::solve::{Continuation, CurvePoint};
use crate::system::{Coordinate, Curve, Driven, Event, Lock, Locked, Monitor, Walk};

/// First event on an edge.
#[derive(Clone, Debug)]
pub(crate) enum EdgeEvent {
    Neighbour(Configuration<f64>),
    /// The mapped coordinate turns back: the mode ends.
    Fold(Configuration<f64>, f64),
    /// A joint is at a limit, the upper one or not.
    Limit(Configuration<f64>, f64, usize, bool),
    /// A matrix loses rank.
    Singular(Configuration<f64>, f64),
    /// Branches cross, as at a corner of the boundary.
    Crossing(Configuration<f64>, f64),
    /// Undecided: no step is short enough.
    Nothing,
}

#[derive(Clone, Debug)]
pub(crate) struct Edge {
    pub axis: usize,
    /// The mapped coordinates at its beginning.
    pub values: Vec<f64>,
    /// The mapped coordinate at its end.
    pub to: f64,
}

impl Edge {
    fn moved(&self, problem: &MapProblem) -> Driven {
        Driven {
            coordinate: problem.axes[self.axis].coordinate,
            from: self.values[self.axis],
            to: self.to,
        }
    }
}

/// Events that end a walk along an edge, besides its end and folds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Until<'l> {
    End,
    Limit,
    /// The matrix of these locks loses rank.
    Singular(&'l [Lock]),
}

impl Flood<'_> {
    /// The first event on an edge, located to rounding.
    pub(crate) fn walk(&self, edge: &Edge, from: &Configuration<f64>, until: Until) -> EdgeEvent {
        const LEGS: usize = 500;
        let problem = self.problem;
        let mechanism = problem.mechanism;
        let moved = edge.moved(problem);
        let method = Continuation::default();
        let held = problem.at(&edge.values).without(moved.coordinate).held();
        let mut curve = Curve::along(mechanism, &held, vec![moved]);
        let mut start = problem.put(from, &edge.values);
        if until == Until::Limit {
            mechanism.turn_to_limits(&mut start.joints);
        }
        let Ok(place) = method.settle(&mut curve, start) else {
            return EdgeEvent::Nothing;
        };
        if place.is_beside_a_crossing() || !self.metric.same(place.at.view(), from.view()) {
            return EdgeEvent::Nothing;
        }
        let (place, turns_back) = curve.towards_end(place);
        if turns_back {
            return EdgeEvent::Fold(place.at, 0.0);
        }
        let monitors: Vec<Monitor> = match until {
            Until::Singular(locks) => {
                let mut locked = Locked::without_spins(mechanism, &problem.question.held(), locks);
                let near: Decomposition = locked.decomposition(&place.at);
                let sign = move |_: &mut Curve, place: &CurvePoint<Configuration<f64>>| {
                    locked.orientation(&near, &place.at)
                };
                vec![Box::new(sign)]
            }
            _ => Vec::new(),
        };
        let mut walk = Walk::new(mechanism, &curve, place, method).watching(monitors);
        for _ in 0..LEGS {
            let Ok(leg) = walk.advance(&mut curve) else {
                return EdgeEvent::Nothing;
            };
            for (place, event) in leg.events {
                let part = curve.part(&place.at).clamp(0.0, 1.0);
                match event {
                    Event::End(true) => {
                        let mut at = place.at;
                        if let Coordinate::Joint(joint) = moved.coordinate {
                            at.joints[joint] = moved.to;
                        }
                        return EdgeEvent::Neighbour(at);
                    }
                    Event::Fold => return EdgeEvent::Fold(place.at, part),
                    Event::Limit { joint, upper, .. } if until == Until::Limit => {
                        return EdgeEvent::Limit(place.at, part, joint, upper);
                    }
                    Event::Root(_) => return EdgeEvent::Singular(place.at, part),
                    Event::Branches(_) => return EdgeEvent::Crossing(place.at, part),
                    Event::End(false) => return EdgeEvent::Nothing,
                    _ => {}
                }
            }
        }
        EdgeEvent::Nothing
    }
}
