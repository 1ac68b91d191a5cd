//! Start and sense of a motion without inputs.

use std::ops::ControlFlow;

use super::At;
use crate::mechanism::{Mechanism, Role};
use crate::number::tolerance::ROUNDING;
use crate::solve::{Continuation, Stage, Watch};
use crate::system::{Coordinate, Curve, Event, Walk};

/// Steps after which a curve without end is given up.
pub(super) const MOST_STEPS: usize = 100_000;

/// The place from which the whole curve through another one is followed: an end of it, if it has ends.
pub(super) fn beginning(
    mechanism: &Mechanism,
    curve: &mut Curve,
    place: At,
    method: &Continuation,
    watch: &Watch,
) -> At {
    let place = forwards(mechanism, curve, place);
    let back = place.clone().reversed();
    let mut walk = Walk::new(mechanism, curve, back, method.clone());
    first_end(&mut walk, curve, watch).map_or(place, At::reversed)
}

/// The place with its tangent in the sense in which the first joint that is driven, or else the first that moves,
/// grows; where none moves, the first coordinate of a platform.
pub(super) fn forwards(mechanism: &Mechanism, curve: &Curve, place: At) -> At {
    let rate = |joint: usize| {
        curve
            .column(joint)
            .map_or(0.0, |column| place.tangent[column])
    };
    let driven = |joint: &usize| mechanism.joints()[*joint].role == Role::Actuated;
    let joints = 0..mechanism.joints().len();
    let ordered = joints.clone().filter(driven).chain(joints);
    let platforms = Coordinate::all(mechanism).filter(|of| of.platform().is_some());
    let of_platform = |of| curve.rate(&place.at, &place.tangent, of);
    let mut rates = ordered.map(rate).chain(platforms.map(of_platform));
    let first = rates.find(|rate| rate.abs() > ROUNDING);
    match first.is_some_and(|rate| rate < 0.0) {
        true => place.reversed(),
        false => place,
    }
}

/// The limit that a walk ends at; `None` if it closes.
fn first_end(walk: &mut Walk, curve: &mut Curve, watch: &Watch) -> Option<At> {
    let mut steps = 0;
    let end = walk.follow(curve, |_, leg| {
        if watch.stops(Stage::Steps, steps, None) || steps == MOST_STEPS {
            return ControlFlow::Break(None);
        }
        steps += 1;
        (leg.events.iter()).try_for_each(|(place, event)| match event {
            Event::Closed => ControlFlow::Break(None),
            Event::Limit { .. } => ControlFlow::Break(Some(place.clone())),
            _ => ControlFlow::Continue(()),
        })
    });
    end.ok().flatten()
}
