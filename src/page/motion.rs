//! Motions on a page: through a range of an input, along the whole curve, and by itself.

use serde::Serialize;
use serde_json::json;

use super::request::{LetGoRequest, SweepRequest};
use super::state::State;
use super::{Page, RefusedReply, answered, not_assembled, nothing, refused, words};
use crate::analysis::simulation::SimulationSettings;
use crate::analysis::sweep::{MetKind, MotionReport, Pace, Row, SweepEnd, SweepSettings};
use crate::ask::Question;
use crate::mechanism::{Frame, Point};
use crate::solve::Watch;

/// A configuration of a motion.
#[derive(Serialize)]
struct ShownRow {
    at: State,
    special: Option<MetKind>,
    points: Vec<[f64; 3]>,
}

impl Page {
    pub(super) fn sweep(
        &self,
        sweep: &SweepRequest,
        watch: &Watch,
    ) -> Result<String, RefusedReply> {
        let mechanism = &self.mechanism()?;
        let asked = self.asked(mechanism);
        let mut asked = match &sweep.input {
            Some((name, from, to)) => (asked.let_go(name)).input(name, *from, *to),
            // along the whole curve, from where it is
            None => {
                let steering = self.steering()?;
                let values = steering.driven().iter();
                let values = values.map(|of| (of.name(mechanism), of.of(mechanism, steering.at())));
                values.fold(asked, |asked, (name, value)| {
                    asked.let_go(&name).guess(name, value)
                })
            }
        };
        asked = self.pressed(asked);
        for point in &sweep.points {
            asked = asked.point(point);
        }
        for quantity in &sweep.report {
            asked = asked.report(quantity);
        }
        let pace = Pace::default();
        let settings = SweepSettings {
            pace: Pace {
                duration: sweep.duration.unwrap_or(pace.duration),
                ..pace
            },
            steps: sweep.steps,
            follow: sweep.follow,
            ..SweepSettings::default()
        };
        let motions = asked.motions(&settings, watch).map_err(refused(&asked))?;
        let mut states = Vec::new();
        let mut keep = |_: Option<usize>, row: &Row| {
            states.push(ShownRow {
                at: State::of(row.configuration),
                special: row.special.cloned(),
                points: row.points.to_vec(),
            });
        };
        let report = motions.report(usize::MAX, &mut keep, watch);
        let begins = |motion: &MotionReport| motion.sweep.ending != SweepEnd::SingularStart;
        if !report.motions.iter().all(begins) {
            return Err(nothing(
                "The motion begins where branches meet. Move the mechanism a little first, so that it is on one of them.",
            ));
        }
        Ok(answered(mechanism, &report, &states))
    }

    /// The motion by itself from where the mechanism is, at rest, under the loads of the file and the one on it.
    pub(super) fn let_go(
        &self,
        asked: &LetGoRequest,
        watch: &Watch,
    ) -> Result<String, RefusedReply> {
        let mechanism = &self.mechanism()?;
        let steering = self.steering()?;
        let mut question = self.pressed(steering.question().near(steering.at().clone()));
        for point in &asked.points {
            question = question.point(point);
        }
        let settings = SimulationSettings {
            duration: asked.duration,
            rows: asked.rows,
            restitution: asked.restitution,
            through: asked.through,
            ..SimulationSettings::default()
        };
        let report = question.simulation(&settings, watch);
        let report = report.map_err(refused(&question))?.closed();
        let report = report.ok_or_else(not_assembled)?;
        if let Some(why) = words::not_let_go(&report) {
            return Err(nothing(&why));
        }
        let points = asked.points.iter();
        let points: Vec<Point> = points
            .filter_map(|name| Point::read(mechanism, name).ok())
            .collect();
        let states = report.configurations.iter().map(|at| ShownRow {
            at: State::of(at),
            special: None,
            points: (points.iter())
                .map(|point| {
                    let pose = mechanism.transform(Frame::Ground, point.frame, at);
                    point.placed(&pose).0
                })
                .collect(),
        });
        let states = states.collect::<Vec<_>>();
        let said = json!(words::let_go(&report));
        let answer = answered(mechanism, &report, &states);
        Ok(format!("{{\"said\":{said},{}", &answer[1..]))
    }

    /// With the load that was put on a body.
    fn pressed(&self, asked: Question) -> Question {
        match &self.load {
            Some(load) => asked.wrench(&load.point, load.force, [0.0; 3]),
            None => asked,
        }
    }
}
