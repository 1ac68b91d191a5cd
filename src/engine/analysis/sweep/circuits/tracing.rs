//! Curves followed from seeds, each once.

use std::ops::ControlFlow;

use super::super::At;
use super::super::begin::forwards;
use super::CircuitsSettings;
use crate::linear::{dot, norm};
use crate::mechanism::{Configuration, Mechanism};
use crate::number::tolerance::SAME;
use crate::solve::{BranchPoint, Continuation, CurvePoint, Stage, Watch};
use crate::system::{Curve, Event, Held, NoStart, Still, Walk, sets_of_angles};

/// A curve as it was followed.
pub(super) struct FoundCurve {
    /// Without their Jacobians.
    pub places: Vec<At>,
    pub turnings: Vec<(usize, At)>,
    /// Turning points of the joint of the slice, each true if its value is greatest there.
    pub folds: Vec<(At, bool)>,
    pub crossings: Vec<BranchPoint<Configuration<f64>>>,
    pub closed: bool,
    pub whole: bool,
    pub length: f64,
    pub seeds: usize,
}

impl FoundCurve {
    /// The places with their Jacobians.
    pub fn restored(&self, curve: &mut Curve, method: &Continuation) -> Vec<At> {
        let places = self.places.iter();
        let restored = places.map(|place| method.restored(curve, place));
        let both = restored.zip(&self.places);
        both.map(|(restored, place)| restored.unwrap_or_else(|| place.clone()))
            .collect()
    }
}

/// Curves found so far.
pub(super) struct Tracing<'a> {
    pub mechanism: &'a Mechanism,
    pub curve: Curve,
    /// The coordinates held with the input, and those that stand still.
    at_rest: (&'a Held<f64>, &'a [Still]),
    /// The joint whose folds are wanted.
    joint: Option<usize>,
    settings: &'a CircuitsSettings,
    watch: &'a Watch<'a>,
    pub traced: Vec<FoundCurve>,
    /// Seeds that are not assembled within limits, or of which no curve leads away.
    pub unusable: usize,
    /// Steps made for all of them.
    steps: usize,
}

impl<'a> Tracing<'a> {
    pub fn new(
        mechanism: &'a Mechanism,
        held: &Held<f64>,
        at_rest: (&'a Held<f64>, &'a [Still]),
        (settings, watch): (&'a CircuitsSettings, &'a Watch<'a>),
    ) -> Self {
        Tracing {
            mechanism,
            curve: Curve::new(mechanism, held),
            at_rest,
            joint: settings.slices.first().map(|slice| slice.joint),
            settings,
            watch,
            traced: Vec::new(),
            unusable: 0,
            steps: 0,
        }
    }

    pub fn method(&self) -> &'a Continuation {
        &self.settings.continuation
    }

    /// True if there are no steps left.
    pub fn is_exhausted(&self) -> bool {
        self.steps >= CircuitsSettings::CURVES * self.settings.most_steps
    }

    /// Follows the curve through a seed if it lies on none so far, and those that cross it.
    pub fn take(&mut self, seed: &Configuration<f64>) {
        let (mechanism, method) = (self.mechanism, self.method());
        let mut seed = seed.clone();
        let begun = self.curve.begin(mechanism, &mut seed, method);
        let place = match begun {
            Ok(place) => place,
            Err(NoStart::Singular) => {
                // a crossing so near is where a seed lies whose tangent rounding hides
                let point = method.branch_point(&mut self.curve, &seed, 1e-3);
                let waiting = point.map_or(Vec::new(), |point| self.leaving(&point));
                self.unusable += usize::from(waiting.is_empty());
                return self.follow(waiting);
            }
            Err(_) => {
                self.unusable += 1;
                return;
            }
        };
        // with another set of the angles of a ball everything moves alike
        let mut sets = sets_of_angles(mechanism, self.at_rest, &seed).into_iter();
        let known = sets.find_map(|mut set| {
            let place = self.curve.begin(mechanism, &mut set, method).ok()?;
            self.holding(&place)
        });
        if let Some(known) = known {
            self.traced[known].seeds += 1;
            return;
        }
        let traced = self.traced.len();
        self.follow(vec![place]);
        if let Some(found) = self.traced.get_mut(traced) {
            found.seeds = 1;
        }
    }

    /// Places beside a crossing on all branches that pass it.
    fn leaving(&mut self, point: &BranchPoint<Configuration<f64>>) -> Vec<At> {
        let (method, curve) = (self.method(), &mut self.curve);
        let places = point.directions.iter();
        let places = places.filter_map(|direction| method.leave(curve, &point.at, direction));
        places.map(|(place, _)| place).collect()
    }

    /// Follows the curves through places that lie on none so far, and all that cross them.
    fn follow(&mut self, mut waiting: Vec<At>) {
        while let Some(place) = waiting.pop() {
            if self.watch.is_stopped() || self.is_exhausted() {
                return;
            }
            let place = self.clear(place);
            if self.holding(&place).is_some() {
                continue;
            }
            let place = forwards(self.mechanism, &self.curve, place);
            let found = self.trace(place);
            for point in &found.crossings {
                waiting.extend(self.leaving(point));
            }
            self.traced.push(found);
        }
    }

    /// A place on the same branch where steps are long and no joint turns back: beside a crossing no step leads from place
    /// to place, and at a dead point rounding decides whether the curve begins before or behind it.
    fn clear(&mut self, place: At) -> At {
        const CLEAR: f64 = 0.02;
        const STEPS: usize = 60;
        let joints = 0..self.mechanism.joints().len();
        let columns: Vec<usize> = joints
            .filter_map(|joint| self.curve.column(joint))
            .collect();
        // a joint that hardly moves is about to turn back
        let turns = |place: &At| columns.iter().any(|j| place.tangent[*j].abs() < 1e-3);
        let clearance = |place: &At| place.least() / place.largest();
        let (mut best, mut turning) = (place.clone(), turns(&place));
        let mut walk = Walk::new(self.mechanism, &self.curve, place, self.method().clone());
        for steps in 0..STEPS {
            if clearance(&best) >= CLEAR && (!turning || steps > 3) {
                break;
            }
            let Ok(leg) = walk.advance(&mut self.curve) else {
                break;
            };
            if leg.events.iter().any(|(_, event)| event.ends()) {
                break;
            }
            // where joints stand still anything is better than where one turns back
            if clearance(&leg.to) > clearance(&best) || turning && clearance(&leg.to) >= CLEAR {
                best = leg.to;
                turning = turns(&best);
            }
        }
        best
    }

    /// The curve that a place lies on.
    fn holding(&mut self, place: &At) -> Option<usize> {
        let method = self.method();
        let curve = &mut self.curve;
        self.traced.iter().position(|known| {
            known.places.iter().any(|node| {
                let gap = curve.difference_but_turns(&node.at, &place.at);
                let apart = norm(&gap);
                if apart < SAME {
                    return true;
                }
                if apart > 1.5 * method.longest {
                    return false;
                }
                let along = dot(&gap, &node.tangent);
                let stepped = (method.restored(curve, node))
                    .and_then(|node| method.step(curve, &node, along).ok());
                stepped.is_some_and(|(at, _)| {
                    norm(&curve.difference_but_turns(&at.at, &place.at)) < SAME
                })
            })
        })
    }

    /// The curve through a place: round it, or from one end to the other.
    fn trace(&mut self, start: At) -> FoundCurve {
        // first backwards to an end, if there is one
        let back = start.clone().reversed();
        let (mut found, end) = self.half(back);
        if !found.closed {
            let begin = end.map_or(start, CurvePoint::reversed);
            return self.half(begin).0;
        }
        // now in the sense it was to have
        found.turnings.reverse();
        found.crossings.reverse();
        let places = found.places.into_iter().rev();
        found.places = places.map(CurvePoint::reversed).collect();
        found
    }

    /// The curve from a place on until it closes or ends; with the limit that it ends at.
    fn half(&mut self, from: At) -> (FoundCurve, Option<At>) {
        let mut found = FoundCurve {
            places: vec![from.clone().thinned()],
            turnings: Vec::new(),
            folds: Vec::new(),
            crossings: Vec::new(),
            closed: false,
            whole: false,
            length: 0.0,
            seeds: 0,
        };
        let method = self.method().clone();
        let mut walk = Walk::new(self.mechanism, &self.curve, from, method);
        let mut steps = 0;
        let (settings, watch, joint) = (self.settings, self.watch, self.joint);
        let end = walk.follow(&mut self.curve, |curve, leg| {
            if watch.stops(Stage::Steps, steps, None) {
                return ControlFlow::Break(None);
            }
            steps += 1;
            for (place, event) in &leg.events {
                match event {
                    Event::Turning(turning) => {
                        if joint == Some(*turning) {
                            let column = curve.column(*turning).expect("what turns back moves");
                            (found.folds).push((place.clone(), leg.from.tangent[column] > 0.0));
                        }
                        found.turnings.push((*turning, place.clone().thinned()));
                    }
                    Event::Branches(point) => found.crossings.push((**point).clone()),
                    Event::Closed | Event::Limit { .. } => {
                        found.length = leg.gone_at(curve, place);
                        found.places.push(place.clone().thinned());
                        found.whole = true;
                        found.closed = matches!(event, Event::Closed);
                        return ControlFlow::Break((!found.closed).then(|| place.clone()));
                    }
                    _ => {}
                }
            }
            found.length = leg.gone_at(curve, &leg.to);
            found.places.push(leg.to.clone().thinned());
            match steps == settings.most_steps {
                true => ControlFlow::Break(None),
                false => ControlFlow::Continue(()),
            }
        });
        self.steps += steps;
        (found, end.ok().flatten())
    }
}
