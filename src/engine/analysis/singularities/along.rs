//! Singularities met by a motion of the inputs along a segment.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::classify::{Classifier, DIRECT, INVERSE, Singularity};
use super::drops::Drops;
use super::outputs::{Coupled, coupled, outputs_of};
use super::{Bound, SingularitiesSettings, names, output_names};
use crate::linear::norm;
use crate::mechanism::{Configuration, Mechanism, Variable};
use crate::number::sorting::sort_by;
use crate::number::tolerance::{ROUNDING, SAME};
use crate::solve::{Continuation, CurvePoint, SolutionCurve, Stage, Watch};
use crate::system::{Coordinate, Curve, Driven, Event, Held, NoStart, Segment, SweepEnd, Walk};

type AlongPlace = CurvePoint<Configuration<f64>>;

/// Singularities met by a motion along a segment of inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AlongReport {
    /// The mechanism's name.
    pub mechanism: String,
    /// The joints, in the order of the file.
    pub variables: Vec<Variable>,
    /// The inputs that singularities refer to.
    pub inputs: Vec<String>,
    /// The outputs.
    pub outputs: Vec<String>,
    /// Outputs that may hide what their positions lose.
    pub coupled: Vec<Coupled>,
    /// The driven coordinates, with their values at the start and at the end.
    pub moved: Vec<Bound>,
    /// End of the motion.
    pub ending: SweepEnd,
    /// The joint whose limit was reached, if one was.
    pub limit: Option<String>,
    /// The part of the segment that was gone at the end.
    pub part: f64,
    /// The singularities, in the order in which they were met.
    pub crossings: Vec<Crossing>,
    /// Sure steps the curve was followed in.
    pub sure_steps: usize,
    /// The length that makes the matrices dimensionless, in m.
    pub normalising_length: f64,
    /// True if the work was stopped before the motion ended.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub interrupted: bool,
}

/// A singularity that was met.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Crossing {
    /// The part of the segment that was gone.
    pub part: f64,
    /// Values of the driven coordinates there, rad or m.
    pub moved: Vec<f64>,
    /// The joints there, rad or m, in the order of the file.
    pub joints: Vec<f64>,
    /// True at a fold: the driven coordinates turn back here, and as inputs they lock.
    pub fold: bool,
    /// True if branches cross here.
    pub branches: bool,
    /// Kinds of singularity and freedoms gained or lost.
    pub singularity: Singularity,
}

/// Moves the inputs along their segment from `start` and locates every singularity to rounding.
///
/// `held` holds the coordinates at rest, none of the driven ones; singularities refer to `inputs`.
pub fn along(
    mechanism: &Mechanism,
    held: &Held<f64>,
    moved: &[Driven],
    inputs: &[Coordinate],
    start: &Configuration<f64>,
    settings: &SingularitiesSettings,
    watch: &Watch,
) -> AlongReport {
    let outputs = outputs_of(mechanism, held, moved, inputs, settings);
    let mut report = AlongReport {
        mechanism: mechanism.name().to_owned(),
        variables: Variable::joints(mechanism),
        inputs: names(mechanism, inputs),
        outputs: output_names(mechanism, &outputs),
        coupled: coupled(mechanism, inputs, &outputs, start, settings, false),
        moved: (moved.iter())
            .map(|input| Bound::new(mechanism, input))
            .collect(),
        ending: SweepEnd::Lost,
        limit: None,
        part: 0.0,
        crossings: Vec::new(),
        sure_steps: 0,
        normalising_length: mechanism.characteristic_length(),
        interrupted: false,
    };
    let mut start = start.clone();
    let mut curve = Curve::along(mechanism, held, moved.to_vec());
    let method = &Continuation::default();
    let begun = curve.begin(mechanism, &mut start, method);
    if let Err(NoStart::OutsideLimits(joint)) = begun {
        report.limit = Some(mechanism.joints()[joint].name.clone());
        report.ending = SweepEnd::OutsideLimits;
        return report;
    }
    let mut search = Tests {
        mechanism,
        classifier: Classifier::new(mechanism, inputs, &outputs, &start),
        moved: moved.to_vec(),
    };
    let place = match begun {
        Ok(place) => place,
        Err(NoStart::NotClosed) => return report,
        Err(_) => {
            let found = search.crossing(&curve, &start, false, true);
            report.crossings.extend(found);
            report.ending = SweepEnd::SingularStart;
            return report;
        }
    };
    let (place, turns_back) = curve.towards_end(place);
    let first = search.crossing(&curve, &place.at, turns_back, false);
    report.crossings.extend(first);
    if turns_back {
        report.ending = SweepEnd::Fold;
        return report;
    }
    let mut walk = Walk::new(mechanism, &curve, place, method.clone());
    let ending = walk.follow(&mut curve, |curve, step| {
        let done = report.part.clamp(0.0, 1.0) * f64::from(PARTS);
        if watch.stops(Stage::Motion, done as usize, Some(PARTS as usize)) {
            report.interrupted = true;
            return ControlFlow::Break(SweepEnd::Stopped);
        }
        report.sure_steps += 1;
        report.part = curve.part(&step.to.at);
        for met in search.met(curve, step, method) {
            report.part = curve.part(&met.place.at);
            let known = report.crossings.last().is_some_and(|last| {
                let apart = (last.joints.iter().zip(&met.place.at.joints))
                    .map(|(a, b)| (a - b).abs())
                    .fold(0.0, f64::max);
                apart < ROUNDING && last.part == report.part
            });
            if !known && (met.fold || met.branches || met.vanishes) {
                let found = search.crossing(curve, &met.place.at, met.fold, met.branches);
                report.crossings.extend(found);
            }
            let ending = match met.end {
                Some(Event::End(true)) => Some(SweepEnd::Complete),
                Some(Event::End(false)) => Some(SweepEnd::Returned),
                Some(Event::Closed) => Some(SweepEnd::Closed),
                Some(Event::Limit { joint, .. }) => {
                    report.limit = Some(mechanism.joints()[joint].name.clone());
                    Some(SweepEnd::Limit)
                }
                _ if met.fold && !settings.follow => Some(SweepEnd::Fold),
                _ if met.branches && !settings.follow => Some(SweepEnd::Crossing),
                _ => None,
            };
            if let Some(ending) = ending {
                return ControlFlow::Break(ending);
            }
        }
        ControlFlow::Continue(())
    });
    report.ending = ending.unwrap_or_else(|_| {
        report.part = curve.part(&walk.place().at);
        SweepEnd::Lost
    });
    report
}

/// Parts of the segment in reports of progress.
const PARTS: u16 = 1000;

struct MetPlace {
    place: AlongPlace,
    fold: bool,
    branches: bool,
    /// The direct or the inverse matrix loses rank.
    vanishes: bool,
    end: Option<Event>,
}

struct Tests<'m> {
    mechanism: &'m Mechanism,
    classifier: Classifier<'m>,
    moved: Vec<Driven>,
}

impl Tests<'_> {
    /// Events in a step, in order; those at one place are one.
    fn met(&mut self, curve: &mut Curve, step: &Segment, method: &Continuation) -> Vec<MetPlace> {
        let mut found: Vec<MetPlace> = Vec::new();
        for (place, event) in &step.events {
            let ends = match event {
                // a turn of what is moved closes the curve and is not the end of the motion
                Event::Closed => curve.part(&place.at).abs() < ROUNDING,
                event => event.ends(),
            };
            let (fold, branches) = (
                matches!(event, Event::Fold),
                matches!(event, Event::Branches(_)),
            );
            if ends || fold || branches {
                found.push(MetPlace {
                    place: place.clone(),
                    fold,
                    branches,
                    vanishes: false,
                    end: ends.then(|| event.clone()),
                });
            }
        }
        for place in self.vanishing(curve, step, method) {
            let near = |met: &&mut MetPlace| {
                met.end.is_none() && norm(&curve.difference(&met.place.at, &place.at)) < SAME
            };
            match found.iter_mut().find(near) {
                Some(met) => met.vanishes = true,
                None => found.push(MetPlace {
                    place,
                    fold: false,
                    branches: false,
                    vanishes: true,
                    end: None,
                }),
            }
        }
        let along = |met: &MetPlace| norm(&curve.difference(&step.from.at, &met.place.at));
        sort_by(&mut found, |a, b| along(a).total_cmp(&along(b)));
        found
    }

    /// Places in a step where the direct or the inverse matrix loses rank.
    fn vanishing(
        &mut self,
        curve: &mut Curve,
        step: &Segment,
        method: &Continuation,
    ) -> Vec<AlongPlace> {
        let ranks = self.classifier.regular_ranks();
        // steps are made from the regular end
        let singular = step.from.is_singular();
        let (from, to) = match singular {
            true => (step.to.clone().reversed(), step.from.clone().reversed()),
            false => (step.from.clone(), step.to.clone()),
        };
        let mut places = Vec::new();
        for (k, rank) in [DIRECT, INVERSE].into_iter().zip(ranks) {
            let locked = &mut self.classifier.matrices[k];
            let mut drops = Drops {
                curve,
                locked,
                rank,
                method,
            };
            places.extend(drops.between(&from, &to));
        }
        if singular {
            places.retain(|place| norm(&curve.difference(&step.from.at, &place.at)) >= SAME);
        }
        places
    }

    /// Classifies a place; `None` if it is regular and neither a fold nor a crossing.
    fn crossing(
        &mut self,
        curve: &Curve,
        at: &Configuration<f64>,
        fold: bool,
        branches: bool,
    ) -> Option<Crossing> {
        let singularity = self.classifier.at(at);
        (singularity.is_singular() || fold || branches).then(|| Crossing {
            part: curve.part(at),
            moved: (self.moved.iter())
                .map(|input| input.coordinate.of(self.mechanism, at))
                .collect(),
            joints: at.joints.clone(),
            fold,
            branches,
            singularity,
        })
    }
}
