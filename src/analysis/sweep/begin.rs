//! The whole curve of a mechanism with one freedom left.

use std::ops::ControlFlow;

use super::met::Record;
use super::paths::Trail;
use super::rows::Sent;
use super::{At, Flow, Row, Sink, SweepEnd, SweepReport, SweepSettings};
use crate::mechanism::{Configuration, Mechanism, Role};
use crate::solve::{Progress, Stage, Watch};
use crate::system::{Coordinate, Curve, Event, Held, Walk};

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
    let mut record = Record::new(mechanism, &[], &settings.points);
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
    let sink: &mut Flow = &mut |row| {
        sink(row);
        watch.at(Progress {
            done: row.number + 1,
            ..Progress::of(Stage::Steps)
        })
    };
    let mut sent = Sent::new(mechanism, &settings.points);
    let mut flow = sent.send(Row::of(&place.at), sink);
    let mut walk = Walk::new(mechanism, &curve, place, method.clone());
    let mut trail = Trail::new(mechanism, &curve, &settings.points, method);
    let stopped = |()| SweepEnd::Stopped;
    let mut length = 0.0;
    let ending = walk.follow(&mut curve, |curve, leg| {
        flow.map_break(stopped)?;
        record.so_far.sure_steps += 1;
        if record.so_far.sure_steps > MOST_STEPS {
            return ControlFlow::Break(SweepEnd::Stopped);
        }
        for (place, event) in &trail.events(curve, leg) {
            record.meet(curve, place, event);
            if event.ends() || matches!(event, Event::Root(_)) {
                trail.reach(place, Some(event));
            }
            length = leg.gone_at(curve, place);
            let row = Row {
                special: record.latest(),
                ..Row::of(&place.at)
            };
            flow = sent.send(row, sink);
            match event {
                Event::Closed => return ControlFlow::Break(SweepEnd::Closed),
                Event::Limit { .. } => return ControlFlow::Break(SweepEnd::Limits),
                _ => flow.map_break(stopped)?,
            }
        }
        trail.reach(&leg.to, None);
        let branches = |(_, event): &(_, Event)| matches!(event, Event::Branches(_));
        if !leg.events.iter().any(branches) {
            flow = sent.send(Row::of(&leg.to.at), sink);
        }
        length = leg.gone_at(curve, &leg.to);
        ControlFlow::Continue(())
    });
    let ending = ending.unwrap_or(SweepEnd::Lost);
    SweepReport {
        interrupted: watch.is_stopped(),
        paths: trail.reports(&mut curve, ending == SweepEnd::Closed),
        ..record.report(ending, sent.count, length)
    }
}

/// In the sense in which the first joint that is driven, or else the first that moves, grows; where
/// none moves, the first coordinate of a platform.
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
    let first = rates.find(|rate| rate.abs() > 1e-9);
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
