//! The whole curve of a mechanism with one freedom left.

use std::ops::ControlFlow;

use super::met::Record;
use super::points::Paths;
use super::{MetKind, Row, Sink, SweepEnd, SweepReport, SweepSettings};
use crate::mechanism::{Configuration, Mechanism};
use crate::solve::{Place, Stage, Watch};
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
    let method = &settings.continuation;
    let mut place = match curve.begin(mechanism, &mut start, method) {
        Ok(place) => place,
        Err(why) => return record.no_start(&mut curve, &start, why, method),
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
    let stopped = |()| SweepEnd::Stopped;
    let mut length = 0.0;
    let ending = walk.follow(&mut curve, |curve, leg| {
        flow.map_break(stopped)?;
        record.steps += 1;
        if record.steps > MOST_STEPS {
            return ControlFlow::Break(SweepEnd::Stopped);
        }
        for (place, event) in &leg.events {
            record.meet(curve, place, event);
            length = leg.gone_at(curve, place);
            flow = send(&place.at, record.latest());
            match event {
                Event::Closed => return ControlFlow::Break(SweepEnd::Closed),
                Event::Limit { .. } => return ControlFlow::Break(SweepEnd::Limits),
                _ => flow.map_break(stopped)?,
            }
        }
        let branches = |(_, event): &(_, Event)| matches!(event, Event::Branches(_));
        if !leg.events.iter().any(branches) {
            flow = send(&leg.to.at, None);
        }
        length = leg.gone_at(curve, &leg.to);
        ControlFlow::Continue(())
    });
    let ending = ending.unwrap_or(SweepEnd::Lost);
    SweepReport {
        interrupted: watch.is_stopped(),
        ..record.report(ending, count, length)
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
    let mut steps = 0;
    let end = walk.follow(curve, |_, leg| {
        if watch.stops(Stage::Steps, steps, None) || steps == MOST_STEPS {
            return ControlFlow::Break(None);
        }
        steps += 1;
        for (place, event) in &leg.events {
            match event {
                Event::Closed => return ControlFlow::Break(None),
                Event::Limit { .. } => return ControlFlow::Break(Some(place.clone())),
                _ => {}
            }
        }
        ControlFlow::Continue(())
    });
    end.ok().flatten()
}
