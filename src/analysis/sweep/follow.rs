//! The whole curve of a mechanism with one freedom left.

use std::ops::ControlFlow;

use super::met::Record;
use super::points::Paths;
use super::{Ending, MetKind, Row, Sink, SweepReport, SweepSettings};
use crate::mechanism::{Configuration, Mechanism};
use crate::solve::{Place, Stage, Stray, Watch};
use crate::system::{Curve, Event, Held, Walk};

/// Steps after which a curve without end is given up.
const MOST_STEPS: usize = 100_000;

/// Follows the curve through an assembled configuration: once round if it closes, otherwise from
/// one end to the other. Where branches cross it goes straight on.
///
/// `held` must leave one freedom. A row is sent for every step and everything met.
pub fn follow(
    mechanism: &Mechanism,
    held: &Held<f64>,
    start: &Configuration<f64>,
    settings: &SweepSettings,
    sink: &mut Sink,
    watch: &Watch,
) -> SweepReport {
    let mut curve = Curve::new(mechanism, held);
    let mut record = Record::new(mechanism, &[]);
    let mut start = start.clone();
    mechanism.turn_to_limits(&mut start.joints);
    if let Some(met) = record.outside(&start) {
        return record.ended(met, Ending::OutsideLimits);
    }
    let method = &settings.continuation;
    let mut place = match method.settle(&mut curve, start.clone()) {
        Ok(place) if place.is_beside_a_crossing() => {
            return record.no_start(&mut curve, &start, Stray::Singular, method);
        }
        Ok(place) => place,
        Err(stray) => return record.no_start(&mut curve, &start, stray, method),
    };
    place = forwards(mechanism, &curve, place);
    // if it has ends, it is followed from one of them
    let back = place.clone().reversed();
    let mut walk = Walk::new(mechanism, &curve, back, method.clone());
    if let Some(end) = first_end(&mut walk, &mut curve, watch) {
        place = end.reversed();
    }
    let mut paths = Paths::new(mechanism, &settings.points);
    let mut count = 0;
    let mut send = |at: &Configuration<f64>, special: Option<&MetKind>| {
        paths.place(at);
        count += 1;
        sink(&Row {
            number: count - 1,
            step: None,
            configuration: at,
            points: &paths.at,
            special,
        });
        match watch.stops(Stage::Steps, count, None) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    };
    let mut flow = send(&place.at, None);
    let mut walk = Walk::new(mechanism, &curve, place, method.clone());
    let ending = loop {
        if flow.is_break() {
            break Ending::Stopped;
        }
        let Ok(leg) = walk.advance(&mut curve) else {
            break Ending::Lost;
        };
        record.steps += 1;
        if record.steps > MOST_STEPS {
            break Ending::Stopped;
        }
        let mut ending = None;
        for (place, event) in &leg.events {
            record.meet(&curve, place, event);
            flow = send(&place.at, record.latest());
            ending = match event {
                Event::Closed => Some(Ending::Closed),
                Event::Limit { .. } => Some(Ending::Limits),
                _ => None,
            };
            if ending.is_some() || flow.is_break() {
                break;
            }
        }
        if let Some(ending) = ending {
            break ending;
        }
        if let ControlFlow::Continue(()) = flow
            && !leg
                .events
                .iter()
                .any(|(_, e)| matches!(e, Event::Branches(_)))
        {
            flow = send(&leg.to.at, None);
        }
    };
    SweepReport {
        interrupted: watch.is_stopped(),
        ..record.report(ending, count, walk.gone())
    }
}

/// In the sense in which the first joint that is driven, or else the first that moves, grows.
pub(super) fn forwards(
    mechanism: &Mechanism,
    curve: &Curve,
    place: Place<Configuration<f64>>,
) -> Place<Configuration<f64>> {
    let rate = |joint: usize| {
        curve
            .column(joint)
            .map_or(0.0, |column| place.tangent[column])
    };
    let driven =
        |joint: &usize| mechanism.joints()[*joint].role == crate::description::Role::Actuated;
    let joints = 0..mechanism.joints().len();
    let ordered = joints.clone().filter(driven).chain(joints);
    let first = ordered.map(rate).find(|rate| rate.abs() > 1e-9);
    match first.is_some_and(|rate| rate < 0.0) {
        true => place.reversed(),
        false => place,
    }
}

/// The limit that a walk ends at; `None` if it closes.
fn first_end(
    walk: &mut Walk,
    curve: &mut Curve,
    watch: &Watch,
) -> Option<Place<Configuration<f64>>> {
    for step in 0..MOST_STEPS {
        if watch.stops(Stage::Steps, step, None) {
            return None;
        }
        let leg = walk.advance(curve).ok()?;
        for (place, event) in leg.events {
            match event {
                Event::Closed => return None,
                Event::Limit { .. } => return Some(place),
                _ => {}
            }
        }
    }
    None
}
