//! Special points of the paths of traced points: cusps and double points.

mod crossings;

use serde::{Deserialize, Serialize};

use super::At;
use crate::geometry::Vector3;
use crate::linear::dot;
use crate::mechanism::{Configuration, Mechanism, NamedPoint, Placement, Variable};
use crate::number::sorting::sort_by;
use crate::number::tolerance::ROUNDING;
use crate::solve::Continuation;
use crate::system::{Curve, Event, FrameTwists, Segment};
use crossings::double_points;

/// Cusps and double points of the path of a point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PathReport {
    /// The point, as it was asked for.
    pub point: String,
    /// The joints, in the order of the file.
    pub variables: Vec<Variable>,
    /// Cusps, at which the point stands still for an instant while the mechanism moves, in the order in which they were
    /// met.
    pub cusps: Vec<PathPoint>,
    /// Double points, at which its path crosses itself, sorted.
    pub double_points: Vec<PathPoint>,
    /// The order of the whole algebraic curve, all circuits and complex points included, where it was asked for and
    /// is certain: with so many points a line in its plane meets it, or a plane a curve in space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub order: Option<usize>,
}

/// A point of a path with the configurations that lead there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PathPoint {
    /// Position in ground, in m.
    pub position: [f64; 3],
    /// The joints, rad or m, in the order of the file: one row for each passage.
    pub joints: Vec<Vec<f64>>,
    /// The numbers of the circuits that pass, from 1, in the same order.
    pub circuits: Vec<usize>,
}

/// A point whose path is searched for cusps and double points.
pub(super) struct Tracer {
    point: NamedPoint,
    variables: Vec<Variable>,
    twists: FrameTwists<f64>,
    placement: Placement<f64>,
    length: f64,
    /// Position in ground, in m, from which the kinematics measures positions.
    centre: Vector3<f64>,
}

impl Tracer {
    pub fn new(mechanism: &Mechanism, curve: &Curve, point: &NamedPoint) -> Self {
        let (dimensions, unknowns) = (mechanism.dimensions(), curve.system().unknowns());
        let twists = FrameTwists::new(dimensions, unknowns, &[point.point.frame]);
        Tracer {
            point: point.clone(),
            variables: Variable::joints(mechanism),
            placement: twists.placement(),
            twists,
            length: mechanism.characteristic_length(),
            centre: Vector3(dimensions.centre),
        }
    }

    /// The position of the point from the centre, in m.
    fn position(&mut self, at: &Configuration<f64>) -> Vector3<f64> {
        self.twists.place(at, &mut self.placement);
        let frame = self.twists.frame(0, &self.placement);
        self.point.point.placed(frame)
    }

    /// Its velocity along the tangent, in characteristic lengths.
    fn velocity(&mut self, place: &At) -> Vector3<f64> {
        let position = self.position(&place.at);
        let arm = position - self.twists.origin(0, &self.placement);
        let twist = self.twists.twist(0, &self.placement, &place.tangent);
        (twist.velocity + twist.omega.cross(&arm)).times(1.0 / self.length)
    }

    /// The place between two where the point stands still for an instant: its velocity turns back
    /// there. It lies on the moving centrode then.
    fn cusp(&mut self, curve: &mut Curve, method: &Continuation, from: &At, to: &At) -> Option<At> {
        let [before, after] = [from, to].map(|place| self.velocity(place));
        let place = if before.norm() < ROUNDING {
            from.clone()
        } else if before.dot(&after) < 0.0 {
            let along = before - after;
            let mut test = |_: &mut Curve, place: &At| self.velocity(place).dot(&along);
            method.root(curve, from, to, &mut test)
        } else {
            return None;
        };
        // one at the end of a step is met at the beginning of the next
        let still = self.velocity(&place).norm() < ROUNDING && after.norm() >= ROUNDING;
        (still && !self.retraces(curve, method, &place)).then_some(place)
    }

    /// True if the path comes back the way it went from a point at rest, as at the end of an arc.
    fn retraces(&mut self, curve: &mut Curve, method: &Continuation, still: &At) -> bool {
        const STEPS: usize = 12;
        let step = 0.5 * method.longest;
        let Some(ahead) = method.across(curve, still, step) else {
            return false;
        };
        let wanted = self.position(&ahead.at);
        let mut back = step;
        for _ in 0..STEPS {
            let Some(place) = method.across(curve, still, -back) else {
                return false;
            };
            let gap = (wanted - self.position(&place.at)).times(1.0 / self.length);
            // retraced; at a cusp the gap is about the third power of the step
            if gap.norm() < 1e-11 {
                return true;
            }
            let rate = self.velocity(&place);
            back -= gap.dot(&rate) / rate.dot(&rate);
        }
        false
    }
}

/// The tracers of a motion and the way it went.
pub(super) struct TracedTrail {
    tracers: Vec<Tracer>,
    method: Continuation,
    places: Vec<At>,
    cusps: Vec<Vec<PathPoint>>,
}

impl TracedTrail {
    pub fn new(
        mechanism: &Mechanism,
        curve: &Curve,
        points: &[NamedPoint],
        method: &Continuation,
    ) -> Self {
        let tracers = points
            .iter()
            .map(|point| Tracer::new(mechanism, curve, point));
        TracedTrail {
            tracers: tracers.collect(),
            method: method.clone(),
            places: Vec::new(),
            cusps: vec![Vec::new(); points.len()],
        }
    }

    /// Events of a step with the cusps of paths, which are roots by the number of their point.
    pub fn events(&mut self, curve: &mut Curve, leg: &Segment) -> Vec<(At, Event)> {
        let mut events = leg.events.clone();
        let met = events.len();
        for (number, tracer) in self.tracers.iter_mut().enumerate() {
            let cusp = tracer.cusp(curve, &self.method, &leg.from, &leg.to);
            events.extend(cusp.map(|place| (place, Event::Root(number))));
        }
        if events.len() > met {
            let along = |p: &At| {
                dot(
                    &curve.difference_but_turns(&leg.from.at, &p.at),
                    &leg.from.tangent,
                )
            };
            sort_by(&mut events, |(a, _), (b, _)| along(a).total_cmp(&along(b)));
        }
        if self.places.is_empty() && !self.tracers.is_empty() {
            self.places.push(leg.from.clone());
        }
        events
    }

    /// Continues to a place, past an event there.
    pub fn reach(&mut self, place: &At, event: Option<&Event>) {
        match event {
            Some(Event::Root(number)) => {
                let cusp = self.tracers[*number].passed(&[(place, 1)]);
                self.cusps[*number].push(cusp);
            }
            _ if !self.tracers.is_empty() => self.places.push(place.clone()),
            _ => {}
        }
    }

    pub fn reports(self, curve: &mut Curve, closed: bool) -> Vec<PathReport> {
        let curves = [(&self.places[..], closed)];
        let of_point = self.tracers.into_iter().zip(self.cusps);
        let reports = of_point
            .map(|(mut tracer, cusps)| tracer.told_all(cusps, curve, &self.method, &curves));
        reports.collect()
    }
}

impl Tracer {
    /// Cusps and double points of the path over several curves.
    pub fn report(
        &mut self,
        curve: &mut Curve,
        method: &Continuation,
        curves: &[(&[At], bool)],
    ) -> PathReport {
        let mut cusps = Vec::new();
        for (number, (places, _)) in curves.iter().enumerate() {
            for pair in places.windows(2) {
                let cusp = self.cusp(curve, method, &pair[0], &pair[1]);
                cusps.extend(cusp.map(|place| self.passed(&[(&place, number + 1)])));
            }
        }
        self.told_all(cusps, curve, method, curves)
    }

    fn told_all(
        &mut self,
        cusps: Vec<PathPoint>,
        curve: &mut Curve,
        method: &Continuation,
        curves: &[(&[At], bool)],
    ) -> PathReport {
        PathReport {
            point: self.point.name.clone(),
            variables: self.variables.clone(),
            cusps,
            double_points: double_points(self, curve, method, curves),
            order: None,
        }
    }

    fn passed(&mut self, passages: &[(&At, usize)]) -> PathPoint {
        PathPoint {
            position: (self.position(&passages[0].0.at) + self.centre).0,
            joints: (passages.iter())
                .map(|(place, _)| place.at.joints.clone())
                .collect(),
            circuits: passages.iter().map(|(_, circuit)| *circuit).collect(),
        }
    }
}
