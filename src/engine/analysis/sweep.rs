//! Motion through prescribed inputs, and along the whole curve of a mechanism with one freedom.
//!
//! The curve of assembled configurations is followed in steps that cannot change branch unnoticed
//! (see [`Walk`]); the rows that are asked for are solved between the places
//! this leads through, and each is checked to lie between the two it belongs to. So a sweep ends where
//! its branch ends, or where branches cross, and never goes on elsewhere.

mod begin;
mod between;
mod certified;
mod circuits;
mod dwell;
mod law;
mod met;
mod motion;
mod paths;
mod points;
mod rows;
mod schedule;
mod straightness;

pub(crate) use between::{Passage, Stretch};
use certified::RowCertifier;
pub use certified::{Certificate, Uncertified};
pub use circuits::{
    Branch, Circuit, CircuitsReport, CircuitsSettings, FourBarClass, Grashof, JointMotion, Slice,
    Swept, circuits,
};
pub use dwell::Dwell;
pub(crate) use dwell::{Sample, dwell};
pub use law::{Law, Pace};
pub use met::{Met, MetKind, Passing};
pub use motion::Thinned;
pub use motion::{
    Columns, Extreme, Extremum, KeptRows, Missing, MotionReport, MotionsReport, Pole,
};
pub use paths::{PathPoint, PathReport};
pub(crate) use points::Paths;
pub use schedule::Schedule;
pub use straightness::Straightness;

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use crate::mechanism::{Configuration, Mechanism, NamedPoint};
use crate::number::tolerance::{ROUNDING, SAME};
use crate::solve::{Continuation, CurvePoint, Progress, Stage, Watch};
pub use crate::system::SweepEnd;
use crate::system::{Bound, Curve, Driven, Event, Held, Walk};
use begin::{MOST_STEPS, beginning};
use met::Record;
use paths::TracedTrail;
use rows::{RowMaker, holding};

type At = CurvePoint<Configuration<f64>>;

/// Settings of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepSettings {
    /// Number of steps, equal in time, into which the segment of the inputs is divided; there is one row more.
    pub steps: usize,
    /// If true, the motion goes round folds, at which inputs turn back, and straight through crossings; always without
    /// inputs.
    pub follow: bool,
    /// Tolerances and step lengths of the continuation.
    pub continuation: Continuation,
    /// Motion law of the inputs; rows are at equal parts of its time.
    pub pace: Pace,
    /// Table of input values over time instead of a law; `steps` are then equal parts of its time.
    pub schedule: Option<Schedule>,
    /// Points whose path is wanted.
    pub points: Vec<NamedPoint>,
    /// If true, the straightness of these paths is reported.
    pub straightness: bool,
    /// If true, means of all quantities are reported, not those of forces, powers and energies alone.
    pub means: bool,
    /// If true, interval arithmetic certifies that all rows lie on one branch; only where inputs go through their
    /// ranges.
    pub certify: bool,
    /// If true, there are also rows between the steps, so near to one another that a line through them looks smooth.
    pub between: bool,
}

impl Default for SweepSettings {
    fn default() -> Self {
        SweepSettings {
            steps: 100,
            follow: false,
            continuation: Continuation::default(),
            pace: Pace::default(),
            schedule: None,
            points: Vec::new(),
            straightness: false,
            means: false,
            certify: false,
            between: false,
        }
    }
}

/// An assembled configuration of a motion.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// Its number, from 0.
    pub number: usize,
    /// The number of steps of the inputs' segment; `None` between two of them, and without inputs.
    pub step: Option<usize>,
    /// The part of the time that is gone, where a table says it.
    pub time: Option<f64>,
    /// The configuration: no closure row exceeds 1e-12 rad or characteristic lengths.
    pub configuration: &'a Configuration<f64>,
    /// Positions of the traced points, in ground, in m.
    pub points: &'a [[f64; 3]],
    /// The quantities asked for, none where they are not determined.
    pub quantities: &'a [Option<f64>],
    /// Special point located in this very configuration.
    pub special: Option<&'a MetKind>,
    /// True for a row between those that were asked for; it has the number of the next.
    pub between: bool,
}

impl<'a> Row<'a> {
    /// A configuration without quantities.
    pub(crate) fn of(configuration: &'a Configuration<f64>) -> Self {
        Row {
            number: 0,
            step: None,
            time: None,
            configuration,
            points: &[],
            quantities: &[],
            special: None,
            between: false,
        }
    }
}

/// Receiver of the rows, in order.
pub type Sink<'s> = dyn FnMut(&Row) + 's;

/// Receiver inside a sweep, which may end the motion.
type RowFlow<'s> = dyn FnMut(&Row) -> ControlFlow<()> + 's;

/// Outcome of a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SweepReport {
    /// The inputs; none for a motion that follows its curve.
    pub inputs: Vec<Bound>,
    /// End of the motion.
    pub ending: SweepEnd,
    /// Number of rows.
    pub rows: usize,
    /// Turning points, folds, crossings, limits, in the order in which they were met.
    pub met: Vec<Met>,
    /// Number of special points met but not listed.
    pub more_met: usize,
    /// Sure steps that the curve was followed in.
    pub sure_steps: usize,
    /// The length of the curve, in rad and characteristic lengths.
    pub length: f64,
    /// The characteristic length in m.
    pub characteristic_length: f64,
    /// Cusps and double points of the paths that were traced.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub paths: Vec<PathReport>,
    /// Certificate that the rows lie on one branch, by interval arithmetic, if that is asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certificate: Option<Certificate>,
    /// True if the work was stopped before the motion ended.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub interrupted: bool,
}

impl SweepReport {
    /// Report of a motion that ended with nothing met and without rows.
    pub(crate) fn of(mechanism: &Mechanism, inputs: &[Driven], ending: SweepEnd) -> Self {
        SweepReport {
            inputs: inputs
                .iter()
                .map(|input| Bound::new(mechanism, input))
                .collect(),
            ending,
            rows: 0,
            met: Vec::new(),
            more_met: 0,
            sure_steps: 0,
            length: 0.0,
            characteristic_length: mechanism.characteristic_length(),
            paths: Vec::new(),
            certificate: None,
            interrupted: false,
        }
    }
}

/// Moves the inputs from `start`, assembled where their segment begins, to its end. Without inputs the whole curve through
/// `start` is followed: once round if it closes, otherwise from one end to the other, straight on where branches cross.
///
/// `held` holds everything that stands still, and none of the inputs; with the inputs it must leave
/// no freedom, without any of them one. Rows go to `sink` as they are found; nothing is kept of them. Without inputs
/// there is one for every step and everything met.
pub fn sweep(
    mechanism: &Mechanism,
    held: &Held<f64>,
    inputs: &[Driven],
    start: &Configuration<f64>,
    settings: &SweepSettings,
    sink: &mut Sink,
    watch: &Watch,
) -> SweepReport {
    if let Some(schedule) = &settings.schedule {
        let what = (mechanism, held, inputs);
        return schedule.followed(what, start, settings, sink, watch);
    }
    let driven = !inputs.is_empty();
    let follow = settings.follow || !driven;
    let steps = Some(settings.steps);
    let mut reached = 0;
    let mut certifier = (settings.certify && driven)
        .then(|| RowCertifier::new(mechanism, holding(held, inputs), inputs, start, watch));
    let sink: &mut RowFlow = &mut |row| {
        if let Some(Ok(certifier)) = &mut certifier
            && !row.between
        {
            certifier.row(row.configuration);
        }
        sink(row);
        reached = row.step.unwrap_or(reached);
        watch.at(match driven {
            true => Progress {
                done: reached,
                of: steps,
                ..Progress::of(Stage::Motion)
            },
            false => Progress {
                done: row.number + 1,
                ..Progress::of(Stage::Steps)
            },
        })
    };
    let interrupted = |report: SweepReport| SweepReport {
        interrupted: watch.is_stopped(),
        ..report
    };
    let mut curve = Curve::along(mechanism, held, inputs.to_vec());
    let mut record = Record::new(mechanism, inputs, &settings.points);
    let mut start = start.clone();
    let method = &settings.continuation;
    let place = match curve.begin(mechanism, &mut start, method) {
        Ok(place) => place,
        Err(why) => return record.no_start(&mut curve, &start, why, method),
    };
    let (place, turns_back) = match driven {
        true => curve.towards_end(place),
        false => (
            beginning(mechanism, &mut curve, place, method, watch),
            false,
        ),
    };
    let mut rows = RowMaker::new(mechanism, held, &curve, &place, settings);
    if rows.first(&place, sink).is_break() {
        return interrupted(record.report(SweepEnd::Stopped, 1, 0.0));
    }
    if turns_back {
        record.meet(&curve, &place, &Event::Fold);
        return record.report(SweepEnd::Fold, 1, 0.0);
    }
    let mut walk = Walk::new(mechanism, &curve, place, method.clone());
    let mut trail = TracedTrail::new(mechanism, &curve, &settings.points, method);
    let mut length = 0.0;
    let ending = walk.follow(&mut curve, |curve, leg| {
        let done = curve.part(&leg.from.at).clamp(0.0, 1.0) * settings.steps as f64;
        record.so_far.sure_steps += 1;
        let stops = match driven {
            true => watch.stops(Stage::Motion, done as usize, steps),
            false => record.so_far.sure_steps > MOST_STEPS,
        };
        if stops {
            return ControlFlow::Break(SweepEnd::Stopped);
        }
        let stopped = |()| SweepEnd::Stopped;
        let mut from = &leg.from;
        let events = trail.events(curve, leg);
        for (place, event) in &events {
            // a turn of the inputs closes the curve and is not the end of the sweep
            if let Event::Closed = event
                && curve.part(&place.at).abs() > ROUNDING
            {
                continue;
            }
            rows.between(curve, from, place, sink).map_break(stopped)?;
            from = place;
            length = leg.gone_at(curve, place);
            record.meet(curve, place, event);
            let special = !driven || !matches!(event, Event::Turning(_) | Event::End(_));
            if special {
                let row = Row {
                    special: record.latest(),
                    ..Row::of(&place.at)
                };
                rows.sent.send(row, sink).map_break(stopped)?;
            }
            let flow = match event {
                Event::End(end) if *end => ControlFlow::Break(SweepEnd::Complete),
                Event::End(_) => ControlFlow::Break(SweepEnd::Returned),
                Event::Closed => ControlFlow::Break(SweepEnd::Closed),
                Event::Limit { .. } if driven => ControlFlow::Break(SweepEnd::Limit),
                Event::Limit { .. } => ControlFlow::Break(SweepEnd::Limits),
                Event::Fold if !follow => ControlFlow::Break(SweepEnd::Fold),
                Event::Branches(_) if !follow => ControlFlow::Break(SweepEnd::Crossing),
                _ => ControlFlow::Continue(()),
            };
            if flow.is_break() || matches!(event, Event::Root(_)) {
                trail.reach(place, Some(event));
            }
            flow?;
        }
        trail.reach(&leg.to, None);
        rows.between(curve, from, &leg.to, sink)
            .map_break(stopped)?;
        let branches = |(_, event): &(_, Event)| matches!(event, Event::Branches(_));
        let wanted = match driven {
            true => settings.between,
            // a crossing has had its row
            false => !leg.events.iter().any(branches),
        };
        if wanted {
            let row = Row {
                between: driven,
                ..Row::of(&leg.to.at)
            };
            rows.sent.send(row, sink).map_break(stopped)?;
        }
        length = leg.gone_at(curve, &leg.to);
        // an end that was passed unseen is worse than one that was not reached
        match (-SAME..=1.0 + SAME).contains(&curve.part(&leg.to.at)) {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(SweepEnd::Lost),
        }
    });
    let ending = ending.unwrap_or(SweepEnd::Lost);
    let unfit = |unfit| Certificate {
        unfit: Some(unfit),
        ..Certificate::default()
    };
    interrupted(SweepReport {
        certificate: certifier.map(|of| of.map_or_else(unfit, RowCertifier::certificate)),
        paths: trail.reports(&mut curve, ending == SweepEnd::Closed),
        ..record.report(ending, rows.sent.count, length)
    })
}
