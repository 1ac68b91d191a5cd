//! The way from a node to its neighbour, in steps that cannot change branch unnoticed.

use super::asked::Asked;
use super::step::Measure;
use crate::linear::Decomposition;
use crate::mechanism::Configuration;
use crate::solve::{Continuation, Place};
use crate::system::{Curve, Driven, Event, Holdable, Lock, Locked, Monitor, Walk};

/// What is met on the way.
#[derive(Clone, Debug)]
pub(super) enum Met {
    /// The neighbour.
    Neighbour(Configuration<f64>),
    /// The mapped coordinate turns back: the mode ends.
    Fold(Configuration<f64>, f64),
    /// A joint is at a limit, the upper one or not.
    Limit(Configuration<f64>, f64, usize, bool),
    /// A matrix loses rank.
    Singular(Configuration<f64>, f64),
    /// Nothing for sure: branches cross, or no step is short enough.
    Nothing,
}

/// An edge of the grid.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    pub axis: usize,
    /// The mapped coordinates at its beginning.
    pub values: Vec<f64>,
    /// The mapped coordinate at its end.
    pub to: f64,
}

/// What ends a way besides its end and folds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Until<'l> {
    End,
    Limit,
    /// The matrix of these locks loses rank.
    Singular(&'l [Lock]),
}

pub(super) fn walk(
    asked: &Asked,
    measure: &Measure,
    edge: &Edge,
    from: &Configuration<f64>,
    until: Until,
) -> Met {
    const LEGS: usize = 500;
    let mechanism = asked.mechanism;
    let moved = Driven {
        coordinate: asked.axes[edge.axis].coordinate,
        from: edge.values[edge.axis],
        to: edge.to,
    };
    let held = asked.at(&edge.values).without(moved.coordinate).held();
    let mut curve = Curve::along(mechanism, &held, vec![moved]);
    let method = Continuation::default();
    let mut start = asked.put(from, &edge.values);
    if until == Until::Limit {
        Walk::within_limits(mechanism, &mut start);
    }
    let Ok(place) = method.settle(&mut curve, start) else {
        return Met::Nothing;
    };
    if place.is_beside_a_crossing() || measure.apart(&place.at, from) > 1e-6 {
        return Met::Nothing;
    }
    let rate = curve.part_rate(&place.at, &place.tangent);
    if rate.abs() < 1e-9 {
        return Met::Fold(place.at, 0.0);
    }
    let place = if rate < 0.0 { place.reversed() } else { place };
    let monitors: Vec<Monitor> = match until {
        Until::Singular(locks) => {
            let mut locked = Locked::new(mechanism, locks);
            let near: Decomposition = locked.decomposition(&place.at);
            let sign = move |_: &mut Curve, place: &Place<Configuration<f64>>| {
                locked.orientation(&near, &place.at)
            };
            vec![Box::new(sign)]
        }
        _ => Vec::new(),
    };
    let mut walk = Walk::new(mechanism, &curve, place, method).watching(monitors);
    for _ in 0..LEGS {
        let Ok(leg) = walk.advance(&mut curve) else {
            return Met::Nothing;
        };
        for (place, event) in leg.events {
            let part = curve.part(&place.at).clamp(0.0, 1.0);
            match event {
                Event::End(true) => {
                    let mut at = place.at;
                    if let Holdable::Joint(joint) = moved.coordinate {
                        at.joints[joint] = moved.to;
                    }
                    return Met::Neighbour(at);
                }
                Event::Fold => return Met::Fold(place.at, part),
                Event::Limit { joint, upper, .. } if until == Until::Limit => {
                    return Met::Limit(place.at, part, joint, upper);
                }
                Event::Root(_) => return Met::Singular(place.at, part),
                Event::End(false) | Event::Branches(_) => return Met::Nothing,
                _ => {}
            }
        }
    }
    Met::Nothing
}
