//! Positions of a mechanism along its curve: on one circuit, in which order, and on which side of dead positions.

use std::ops::ControlFlow;

use crate::linear::{dot, norm};
use crate::mechanism::{Configuration, Mechanism};
use crate::number::sorting::sort_by;
use crate::number::tolerance::SAME;
use crate::solve::{Continuation, CurvePoint, SolutionCurve, Stage, StepFailure, Watch};
use crate::system::{Curve, Event, Held, Segment, Walk};

/// Steps after which a curve without end is given up.
const MOST_STEPS: usize = 20_000;

/// The curve through the first of some positions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DesignCourse {
    /// Length of the curve at which each position is met, from the first on; `None` for one that it does not pass.
    pub met: Vec<Option<f64>>,
    /// Lengths at which the driving joint turns back.
    pub dead: Vec<f64>,
    /// Length of the curve.
    pub length: f64,
    /// True if the curve comes back to where it began.
    pub closed: bool,
    /// The joints at whose limits it ends.
    pub limits: Vec<usize>,
    /// True if branches cross on it.
    pub crosses: bool,
    /// True if it was followed from end to end.
    pub whole: bool,
    /// Turn of the driving joint once round a closed curve, in rad.
    pub turn: f64,
}

type CoursePlace = CurvePoint<Configuration<f64>>;

/// Follows the curve through the first position once round, or from there to both of its ends, in steps that cannot change
/// branch unnoticed; positions are met between the ends of a step, at the place of the curve that lies across from them.
///
/// # Errors
/// If the first position is singular, or the mechanism has not one freedom there.
pub fn course(
    mechanism: &Mechanism,
    held: &Held<f64>,
    positions: &[Configuration<f64>],
    driver: Option<usize>,
    watch: &Watch,
) -> Result<DesignCourse, StepFailure> {
    let mut curve = Curve::new(mechanism, held);
    let method = Continuation::default();
    let first = positions.first().ok_or(StepFailure::NotClosed)?;
    let mut first = first.clone();
    mechanism.turn_to_limits(&mut first.joints);
    let start = method.settle(&mut curve, first)?;
    let mut course = DesignCourse {
        met: vec![None; positions.len()],
        ..DesignCourse::default()
    };
    let mut way = DesignWay {
        positions,
        driver,
        course: &mut course,
        method: &method,
        watch,
    };
    let ahead = way.walk(mechanism, &mut curve, start.clone(), 1.0);
    let back = match ahead.is_some() && !way.course.closed {
        true => way.walk(mechanism, &mut curve, start.reversed(), -1.0),
        false => Some(0.0),
    };
    course.length = ahead.unwrap_or(0.0) + back.unwrap_or(0.0);
    course.whole = ahead.is_some() && back.is_some();
    sort_by(&mut course.dead, f64::total_cmp);
    Ok(course)
}

struct DesignWay<'a> {
    positions: &'a [Configuration<f64>],
    driver: Option<usize>,
    course: &'a mut DesignCourse,
    method: &'a Continuation,
    watch: &'a Watch<'a>,
}

impl DesignWay<'_> {
    /// Length of the curve to where it closes or ends; `None` if it was not followed so far.
    fn walk(
        &mut self,
        mechanism: &Mechanism,
        curve: &mut Curve,
        start: CoursePlace,
        sign: f64,
    ) -> Option<f64> {
        let from = self.driver.map_or(0.0, |joint| start.at.joints[joint]);
        let mut walk = Walk::new(mechanism, curve, start, self.method.clone());
        let mut steps = 0;
        let end = walk.follow(curve, |curve, leg| {
            steps += 1;
            if steps > MOST_STEPS || self.watch.stops(Stage::Steps, steps, None) {
                return ControlFlow::Break(None);
            }
            let mut end = None;
            for (place, event) in &leg.events {
                match event {
                    Event::Turning(joint) if Some(*joint) == self.driver => {
                        self.course.dead.push(sign * leg.gone_at(curve, place));
                    }
                    Event::Branches(_) => self.course.crosses = true,
                    Event::Closed => {
                        self.course.closed = true;
                        let turned = self.driver.map_or(0.0, |joint| place.at.joints[joint]);
                        self.course.turn = turned - from;
                        end = Some(leg.gone_at(curve, place));
                    }
                    Event::Limit { joint, .. } => {
                        self.course.limits.push(*joint);
                        end = Some(leg.gone_at(curve, place));
                    }
                    _ => {}
                }
                if end.is_some() {
                    break;
                }
            }
            self.meet(curve, leg, sign, end);
            match end {
                Some(length) => ControlFlow::Break(Some(length)),
                None => ControlFlow::Continue(()),
            }
        });
        end.ok().flatten()
    }

    /// The positions on a leg.
    fn meet(&mut self, curve: &mut Curve, leg: &Segment, sign: f64, end: Option<f64>) {
        let (from, back) = match leg.from.is_singular() {
            true => (leg.to.clone().reversed(), true),
            false => (leg.from.clone(), false),
        };
        let other = if back { &leg.from } else { &leg.to };
        let way = curve.difference(&from.at, &other.at);
        let (along, size) = (dot(&way, &from.tangent), norm(&way));
        for (at, met) in self.positions.iter().zip(&mut self.course.met) {
            if met.is_some() {
                continue;
            }
            let way = curve.difference_but_turns(&from.at, at);
            let s = dot(&way, &from.tangent);
            if norm(&way) > 1.5 * size + SAME || s < -SAME || s > along + SAME {
                continue;
            }
            // beside the ends nothing lies between
            let near =
                |place: &CoursePlace| norm(&curve.difference_but_turns(&place.at, at)) < SAME;
            let place = match [&from, other].into_iter().find(|place| near(place)) {
                Some(place) => Some(place.clone()),
                None => self.method.across(curve, &from, s),
            };
            let Some(place) = place else { continue };
            if norm(&curve.difference_but_turns(&place.at, at)) < SAME {
                let gone = leg.gone_at(curve, &place);
                if end.is_none_or(|end| gone <= end + SAME) {
                    *met = Some(sign * gone);
                }
            }
        }
    }
}

impl DesignCourse {
    /// The positions that it does not pass.
    pub fn elsewhere(&self) -> Vec<usize> {
        let positions = self.met.iter().enumerate();
        positions
            .filter(|(_, met)| met.is_none())
            .map(|(i, _)| i)
            .collect()
    }

    /// The positions in the order in which they are met, from the first on.
    pub fn order(&self) -> Vec<usize> {
        let positions = self.met.iter().enumerate();
        let mut met: Vec<(usize, f64)> = positions.filter_map(|(i, s)| Some((i, (*s)?))).collect();
        sort_by(&mut met, |a, b| a.1.total_cmp(&b.1));
        met.into_iter().map(|(i, _)| i).collect()
    }

    /// True if all positions are met one after another, in either sense.
    pub fn in_order(&self) -> bool {
        let mut order = self.order();
        if order.len() < self.met.len() {
            return false;
        }
        let sorted = |order: &[usize]| order.is_sorted() || order.is_sorted_by(|a, b| a >= b);
        match self.closed {
            true => (0..order.len()).any(|_| {
                order.rotate_left(1);
                sorted(&order)
            }),
            false => sorted(&order),
        }
    }

    /// The positions that a dead position of the driving joint separates from the first.
    pub fn beyond_dead(&self) -> Vec<usize> {
        let part = |s: f64| {
            let part = self.dead.iter().filter(|dead| **dead < s).count();
            // round a closed curve the last part is the first
            if self.closed && part == self.dead.len() {
                0
            } else {
                part
            }
        };
        let near = |s: f64| self.dead.iter().any(|dead| (dead - s).abs() < SAME);
        let first = part(0.0);
        let positions = self.met.iter().enumerate();
        let beyond = positions.filter_map(|(i, s)| Some((i, (*s)?)));
        beyond
            .filter(|(_, s)| part(*s) != first && !near(*s))
            .map(|(i, _)| i)
            .collect()
    }
}
