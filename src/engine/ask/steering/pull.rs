//! Moving a mechanism by a point of it: along its own freedoms, whatever is held. What is held is taken along, through its
//! dead points too.

use std::f64::consts::TAU;

use super::ways::{Ways, at_limits, within_limits};
use super::{Question, Steering};
use crate::analysis::sweep::{SweepEnd, SweepReport};
use crate::geometry::Vector3;
use crate::linear::{Decomposition, norm};
use crate::mechanism::{Configuration, Point};
use crate::number::tolerance::{LONGEST_STEP, ROUNDING};
use crate::solve::Watch;
use crate::system::{Coordinate, FrameTwists, Held, System};

/// A place of the mechanism and where it is wanted.
struct Pulled<'a> {
    grip: &'a [(Point, f64)],
    to: Vector3<f64>,
    sight: Option<Vector3<f64>>,
}

/// A grip where it is: its mean place, and how fast that moves in each motion, in characteristic lengths.
struct GripPlace {
    way: Vector3<f64>,
    velocities: Vec<Vector3<f64>>,
}

impl Steering {
    /// Moves the mechanism so that the weighted mean of points, such as a point of a rod between its ends, comes near to a
    /// place, both seen along `sight`: the step of least squares on its motions, damped (J. Baillieul 1985, C. Wampler
    /// 1986), and no longer than is sure. Joints at a limit stay there rather than go beyond it. Where branches meet, the
    /// pull says which is taken.
    pub fn pull(
        &mut self,
        grip: &[(Point, f64)],
        to: [f64; 3],
        sight: Option<[f64; 3]>,
        watch: &Watch,
    ) -> SweepReport {
        let mechanism = self.mechanism.clone();
        let pulled = Pulled {
            grip,
            to: mechanism.to_centre(Vector3(to)),
            sight: sight.map(Vector3),
        };
        let loose = self.held_but(&self.driven);
        let system = System::new(mechanism.dimensions(), &loose);
        let ways = Ways::of(self, &system, &self.at);
        let (parts, stopped) = self.parts(&pulled, &ways);
        let local = ways.chosen(self.driven.len(), &stopped, &self.driven, None);
        if local.iter().all(|of| self.driven.contains(of)) {
            self.regular = Some(self.at.clone());
        }
        let targets = local.iter().filter(|of| !stopped.contains(of)).map(|&of| {
            let step = ways.rate(of, &parts) * of.scale(&mechanism);
            let to = of.of(&mechanism, &self.at) + step;
            let limits = match of {
                Coordinate::Joint(joint) => mechanism.joints()[joint].limits,
                _ => None,
            };
            (
                of,
                limits.map_or(to, |(low, high)| to.clamp(low.min(high), high)),
            )
        });
        let targets: Vec<_> = targets.collect();
        let mut by = Steering {
            driven: local,
            stopped: None,
            regular: None,
            ..self.clone()
        };
        let mut report = by.move_to(&targets, watch);
        let went = norm(&system.difference(&self.at, &by.at));
        if !report.ending.is_whole()
            && report.ending != SweepEnd::Limit
            && went < 0.1 * norm(&parts)
        {
            let there = by.stopped.as_ref().unwrap_or(&self.at);
            if let Some(at) = self.slipped(&pulled, &system, there, watch) {
                by.at = at;
                report.ending = SweepEnd::Complete;
            }
        }
        let after = Ways::of(self, &system, &by.at);
        if ways.side(&self.driven, &after) < 0.0 {
            self.crossed = !self.crossed;
        }
        self.at = by.at;
        self.stopped = None;
        report
    }

    /// Multiples of the motions that bring the place where it is wanted, and the joints that stay at their limits.
    fn parts(&self, pulled: &Pulled, ways: &Ways) -> (Vec<f64>, Vec<Coordinate>) {
        let place = self.place(pulled, ways, &self.at);
        let count = place.velocities.len();
        let mut stopped: Vec<Coordinate> = Vec::new();
        loop {
            let still = ways.rows(&stopped);
            let mut matrix = Vec::new();
            for (k, velocity) in place.velocities.iter().enumerate() {
                matrix.extend(velocity.0);
                // damping in characteristic lengths: a weak motion is not forced
                matrix.extend((0..count).map(|row| if row == k { 0.03 } else { 0.0 }));
                // a limit is firm
                matrix.extend(still.iter().map(|rates| 1e4 * rates[k]));
            }
            let rows = 3 + count + still.len();
            let mut right = place.way.0.to_vec();
            right.resize(rows, 0.0);
            let mut parts = Decomposition::of(rows, count, &matrix).solve(&right);
            let shorter = (LONGEST_STEP / norm(&parts).max(LONGEST_STEP)).min(1.0);
            parts.iter_mut().for_each(|part| *part *= shorter);
            // what a firm row leaves is rounding
            let rate = |of| ways.rate(of, &parts);
            let next = at_limits(&self.mechanism, &self.at, rate).find(|of| !stopped.contains(of));
            match next {
                Some(of) => stopped.push(of),
                None => return (parts, stopped),
            }
        }
    }

    fn place(&self, pulled: &Pulled, ways: &Ways, at: &Configuration<f64>) -> GripPlace {
        let (mechanism, freedoms) = (&self.mechanism, &ways.freedoms);
        let length = mechanism.characteristic_length();
        let points: Vec<Point> = pulled.grip.iter().map(|(point, _)| *point).collect();
        let twists = FrameTwists::new(mechanism.dimensions(), &freedoms.unknowns, &points);
        let placement = twists.placed(at);
        let mean = |of: &dyn Fn(usize) -> Vector3<f64>| {
            let weighted = pulled.grip.iter().enumerate();
            weighted.fold(Vector3::zero(), |sum, (i, (_, weight))| {
                sum + of(i).times(*weight)
            })
        };
        let seen = |v: Vector3<f64>| match pulled.sight {
            Some(sight) => v - sight.times(v.dot(&sight) / sight.dot(&sight)),
            None => v,
        };
        let from = mean(&|i| twists.origin(i, &placement));
        let velocity = |motion: &Vec<f64>| {
            let velocity = mean(&|i| twists.twist(i, &placement, motion).velocity);
            seen(velocity).times(1.0 / length)
        };
        GripPlace {
            way: seen(pulled.to - from).times(1.0 / length),
            velocities: freedoms.motions.iter().map(velocity).collect(),
        }
    }

    /// A short step where branches meet, in the direction of the pull, closed again; none if no branch leads nearer.
    fn slipped(
        &self,
        pulled: &Pulled,
        system: &System<f64>,
        there: &Configuration<f64>,
        watch: &Watch,
    ) -> Option<Configuration<f64>> {
        let from = Steering {
            at: there.clone(),
            ..self.clone()
        };
        let ways = Ways::of(self, system, there);
        let (parts, _) = from.parts(pulled, &ways);
        let left = |at: &Configuration<f64>| {
            let way = self.place(pulled, &ways, at).way;
            way.dot(&way)
        };
        let before = left(&self.at);
        let found = from.stepped(system, &ways, &parts, watch);
        found.filter(|at| left(at) < before)
    }

    /// A short step along a combination of motions, closed again on a branch that it leads to.
    fn stepped(
        &self,
        system: &System<f64>,
        ways: &Ways,
        parts: &[f64],
        watch: &Watch,
    ) -> Option<Configuration<f64>> {
        let size = norm(parts);
        if size < ROUNDING {
            return None;
        }
        let along: Vec<f64> = parts.iter().map(|part| part / size).collect();
        let chosen = ways.chosen(self.driven.len(), &[], &self.driven, Some(&along));
        let motion = ways.motion(&along);
        [0.02, 0.06, 0.006].into_iter().find_map(|size| {
            let step: Vec<f64> = motion.iter().map(|x| x * size).collect();
            let displaced = system.displaced(&self.at, &step);
            let at = self.closed(&chosen, &displaced, watch)?;
            let off = norm(&system.difference(&displaced, &at));
            (off < 0.7 * size && within_limits(&self.mechanism, &at)).then_some(at)
        })
    }

    /// The assembly beside a configuration that has its values of these coordinates.
    fn closed(
        &self,
        of: &[Coordinate],
        near: &Configuration<f64>,
        watch: &Watch,
    ) -> Option<Configuration<f64>> {
        let mechanism = &self.mechanism;
        let asked = Question::new(mechanism.clone()).free("actuated");
        let asked = of.iter().fold(asked, |asked, of| {
            asked.hold(of.name(mechanism), of.of(mechanism, near))
        });
        let question = asked.resolved().ok()?.near(near).with_spins_still();
        let mut at = asked.nearest(&question, 0, watch)?;
        // on the turn that is nearest
        for (joint, of) in mechanism.joints().iter().enumerate() {
            if of.kind.is_angle() {
                let turns = ((near.joints[joint] - at.joints[joint]) / TAU).round();
                at.joints[joint] += TAU * turns;
            }
        }
        Some(at)
    }

    /// The configurations a short step away from the singular one where the mechanism is or was stopped: along every
    /// freedom gained and, where branches meet, along every motion; the nearest to where it is first.
    pub fn ways_on(&self, watch: &Watch) -> Vec<Configuration<f64>> {
        let there = self.where_stopped();
        let loose: Held<f64> = self.held_but(&self.driven);
        let system = System::new(self.mechanism.dimensions(), &loose);
        let ways = Ways::of(self, &system, &there.at);
        let count = ways.freedoms.motions.len();
        let rows = ways.rows(&self.driven);
        let matrix: Vec<f64> = (0..count)
            .flat_map(|k| rows.iter().map(move |row| row[k]))
            .collect();
        // what stands still where what is held does, or nearly so
        let decomposition = Decomposition::of(rows.len(), count, &matrix);
        let mut parts = decomposition.null_space();
        if parts.is_empty() {
            let weakest = decomposition.weakest();
            parts.extend(weakest.map(|(_, motion)| motion.to_vec()));
        }
        if count > rows.len() {
            let unit = |k: usize| (0..count).map(|i| f64::from(u8::from(i == k))).collect();
            parts.extend((0..count).map(unit));
        }
        let mut found: Vec<Configuration<f64>> = Vec::new();
        for part in &parts {
            for sign in [-1.0, 1.0] {
                let along: Vec<f64> = part.iter().map(|x| sign * x).collect();
                let Some(at) = there.stepped(&system, &ways, &along, watch) else {
                    continue;
                };
                let apart = |other: &Configuration<f64>| norm(&system.difference(other, &at));
                if found.iter().all(|other| apart(other) > 4e-3) {
                    found.push(at);
                }
            }
        }
        let far = |at: &Configuration<f64>| norm(&system.difference(&self.at, at));
        found.sort_by(|a, b| far(a).total_cmp(&far(b)));
        found
    }
}
