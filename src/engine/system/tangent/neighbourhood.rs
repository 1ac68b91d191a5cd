//! The motions of a mechanism near an assembled configuration.

mod follow;
mod lasting;
mod unlocked;

use std::collections::HashSet;

use super::twists::{FrameTwists, Twist};
use crate::description::Role;
use crate::linear::{
    Decomposition, RowGroup, Svd, add, complement, independent, orthonormal, rank_of,
};
use crate::mechanism::{Body, Configuration, Frame, Mechanism};
use crate::number::tolerance::{SAME, STILL};
use crate::solve::{Equations, Newton, Stop, Watch};
use crate::system::equations::solve;
use crate::system::{ClosureWrenches, Held, System, SystemWork, Unknown};

pub use follow::{FINITE_STEP, FiniteStep};
pub use lasting::Lasting;

/// A mechanism near assembled configurations, with nothing held or as a question holds it.
#[derive(Clone, Debug)]
pub struct Neighbourhood<'a> {
    mechanism: &'a Mechanism,
    system: System<f64>,
    work: SystemWork<f64>,
    frames: FrameTwists<f64>,
    watch: Option<&'a Watch<'a>>,
}

/// The closure equations linearised at an assembled configuration: J ξ = 0.
#[derive(Clone, Debug)]
pub struct Tangent {
    /// The configuration.
    pub at: Configuration<f64>,
    /// The dimensionless Jacobian J, decomposed.
    pub decomposition: Decomposition,
    /// Orthonormal basis of the infinitesimal motions ξ without local freedoms.
    pub motions: Vec<Vec<f64>>,
    /// Orthonormal basis of the local (passive) freedoms: links turn about their own axes.
    pub idle: Vec<Vec<f64>>,
}

impl<'a> Neighbourhood<'a> {
    /// Prepares a mechanism with nothing held.
    pub fn new(mechanism: &'a Mechanism) -> Self {
        Neighbourhood::holding(mechanism, &Held::nothing(mechanism))
    }

    /// Prepares a mechanism with held coordinates.
    pub fn holding(mechanism: &'a Mechanism, held: &Held<f64>) -> Self {
        let system = System::new(mechanism.dimensions(), held);
        let frames = mechanism.frames();
        Neighbourhood {
            mechanism,
            work: system.work(),
            frames: FrameTwists::new(mechanism.dimensions(), system.unknowns(), &frames),
            system,
            watch: None,
        }
    }

    /// Lets `watch` stop the steps of large mechanisms.
    pub fn watched(self, watch: &'a Watch<'a>) -> Self {
        Neighbourhood {
            watch: Some(watch),
            ..self
        }
    }

    /// The closure equations.
    pub fn system(&self) -> &System<f64> {
        &self.system
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &'a Mechanism {
        self.mechanism
    }

    /// Twists of every frame of the mechanism.
    pub fn frames(&self) -> &FrameTwists<f64> {
        &self.frames
    }

    /// Linearises at an assembled configuration.
    pub fn tangent(&mut self, at: Configuration<f64>) -> Tangent {
        self.system.linearise(&at, &mut self.work);
        let columns = self.system.unknowns().len();
        let decomposition = self.system.decomposition(&self.work);
        let all = decomposition.null_space();
        let moved = self.displacements(&at, &all);
        let split = self.system.decomposed(all.len(), moved);
        let combine = |weights: &Vec<f64>| -> Vec<f64> {
            let mut sum = vec![0.0; columns];
            let parts = all
                .iter()
                .zip(weights)
                .filter(|(_, weight)| **weight != 0.0);
            parts.for_each(|(motion, weight)| add(&mut sum, *weight, motion));
            sum
        };
        let idle = match split.singular_values().first() {
            // everything is rounding compared with motions of unit norm
            Some(&largest) if largest < STILL => complement(&[], all.len()),
            _ => split.null_space(),
        };
        Tangent {
            idle: idle.iter().map(combine).collect(),
            // without local freedoms the basis stays as sparse as it came
            motions: match idle.is_empty() {
                true => all,
                false => (complement(&idle, all.len()).iter()).map(combine).collect(),
            },
            at,
            decomposition,
        }
    }

    /// The rank of the closure equations at a configuration.
    pub fn rank(&mut self, at: &Configuration<f64>) -> usize {
        self.system.linearise(at, &mut self.work);
        if self.system.is_large() {
            return self.system.decomposition(&self.work).rank();
        }
        let jacobian = self.system.dense_jacobian(&self.work);
        rank_of(self.system.rows(), self.system.unknowns().len(), &jacobian)
    }

    /// True if the equations of an independent part of the mechanism, but for those that vanish everywhere, are
    /// independent at a configuration: then its motions there are finite.
    pub fn is_regular(&mut self, at: &Configuration<f64>, own: &[bool]) -> bool {
        let left = self.system.linearise(at, &mut self.work).largest;
        let jacobian = self.system.dense_jacobian(&self.work);
        let (all, columns) = (self.system.rows(), own.len());
        let entry = |row: usize, column: usize| jacobian[column * all + row];
        let closures = (self.system.closure_rows()).zip(self.mechanism.rows_that_vary());
        let varying = closures.flat_map(|(rows, kept)| {
            let rows = rows.zip(kept).filter(|(_, kept)| **kept);
            rows.map(|(row, _)| row)
        });
        let varying: Vec<usize> = varying.chain(self.system.hold_rows()).collect();
        // a row without slope belongs to no part
        let is_flat = |row: &usize| (0..columns).all(|k| entry(*row, k) == 0.0);
        if varying.iter().any(is_flat) {
            return false;
        }
        let own: Vec<usize> = (0..columns).filter(|&k| own[k]).collect();
        let touches = |row: &usize| own.iter().any(|&k| entry(*row, k) != 0.0);
        let rows: Vec<usize> = varying.into_iter().filter(touches).collect();
        let entries: Vec<f64> = (own.iter())
            .flat_map(|&k| rows.iter().map(move |&row| (row, k)))
            .map(|(row, k)| entry(row, k))
            .collect();
        let svd = Svd::of(rows.len(), own.len(), &entries);
        independent(rows.len(), &svd.values, left)
    }

    /// The wrenches of every closure's rows at a configuration.
    pub fn closure_wrenches(&mut self, at: &Configuration<f64>) -> Vec<ClosureWrenches<f64>> {
        self.system.residual(at, &mut self.work);
        self.system.closure_wrenches(at, &self.work)
    }

    /// The assembled configuration that Newton's method reaches from a start, if it does.
    pub fn solve(
        &mut self,
        newton: &Newton,
        mut at: Configuration<f64>,
    ) -> Option<Configuration<f64>> {
        let report = solve(newton, &self.system, &mut at, &mut self.work);
        (report.stop == Stop::Solved).then_some(at)
    }

    /// The largest dimensionless row of the equations at a configuration.
    pub fn residual(&mut self, at: &Configuration<f64>) -> f64 {
        self.system.residual(at, &mut self.work).largest
    }

    /// True if motions are local freedoms: links turn about their own axes and nothing else moves.
    pub fn are_local(&self, at: &Configuration<f64>, motions: &[Vec<f64>]) -> bool {
        let moved = self.displacements(at, motions);
        let mut rates = moved.iter().flat_map(|rows| &rows.entries);
        rates.all(|rate| rate.abs() < STILL)
    }

    /// The body on which that of a frame slides by rows put in front of a closure: it turns with it.
    fn slides_on(&self, frame: Frame) -> Option<Body> {
        let mechanism = self.mechanism;
        match mechanism.body(frame) {
            body @ Body::Link { chain, .. } if mechanism.is_added(body) => {
                let rows = &mechanism.dimensions().chains[chain].rows;
                let slides = rows.iter().all(|row| row.turn.0.is_empty());
                slides.then(|| mechanism.body(mechanism.chains()[chain].on))
            }
            _ => None,
        }
    }

    /// The rates that vanish in local freedoms, as those of origins, platforms and driven joints, over the motions.
    fn displacements(&self, at: &Configuration<f64>, motions: &[Vec<f64>]) -> Vec<RowGroup> {
        let mechanism = self.mechanism;
        let placement = self.frames.placed(at);
        let scale = 1.0 / mechanism.characteristic_length();
        let frames: Vec<Frame> = self.frames.frames().collect();
        let bodies: Vec<Body> = frames.iter().map(|&frame| mechanism.body(frame)).collect();
        let attached: HashSet<Frame> = (mechanism.closures().iter())
            .flat_map(|closure| closure.frames)
            .chain(mechanism.chains().iter().map(|chain| chain.on))
            .collect();
        // the frame that the last row of a standard table puts beside the joint axis says nothing about a link to whose tip
        // something is attached
        let is_of_link = |&i: &usize| match frames[i] {
            Frame::Link { chain, row } if row > 0 && !attached.contains(&frames[i]) => {
                let tip = Frame::Tip { chain };
                let beside = mechanism.dimensions().chains[chain].rows[row - 1]
                    .after
                    .position;
                beside.norm() == 0.0 || !attached.contains(&tip) || bodies[i] != mechanism.body(tip)
            }
            _ => true,
        };
        let of_links: Vec<usize> = (0..frames.len()).filter(is_of_link).collect();
        let apart = |i: usize, j: usize| {
            let [a, b] = [i, j].map(|k| self.frames.origin(k, &placement));
            (a - b).norm() > SAME / scale
        };
        // two points of a link at rest leave a turn about their line, also of one cut in two or sliding in itself
        let (of_links, bodies) = (&of_links, &bodies);
        let has_line = |place: usize, joined: [Frame; 2]| {
            let carriers = joined.map(|frame| self.slides_on(frame));
            let joined = joined.map(|frame| mechanism.body(frame));
            let joined: Vec<Body> = carriers.into_iter().flatten().chain(joined).collect();
            let mut others = of_links.iter().filter(|k| joined.contains(&bodies[**k]));
            others.any(|other| apart(place, *other))
        };
        let places = self.frames.places();
        // the axes about which a frame may turn without the other frame of its closure
        let turning: Vec<(usize, Vec<usize>)> = (mechanism.closures().iter())
            .filter(|closure| !closure.kind.leaves_orientation())
            .flat_map(|closure| closure.frames.map(|frame| (closure, frame)))
            .filter_map(|(closure, frame)| {
                let place = *places.get(&frame)?;
                let axes: Vec<usize> = match closure.kind.leaves_turn() {
                    true => (closure.frames.iter())
                        .filter_map(|frame| places.get(frame).copied())
                        .collect(),
                    false => vec![],
                };
                let turns_as_one = axes.is_empty() && has_line(place, closure.frames);
                (!turns_as_one).then_some((place, axes))
            })
            .collect();
        let outside = mechanism.joints_outside_closures();
        // platforms on several balls only spin about their line; a ball may be rows of a chain on the platform, or be on a
        // rod that slides in it
        let is_carried = |mut body: Body, platform: usize| {
            while let Body::Link { chain, row } = body {
                let mut rows = mechanism.dimensions().chains[chain].rows[..row].iter();
                if rows.any(|row| !row.turn.0.is_empty()) {
                    return false;
                }
                body = mechanism.body(mechanism.chains()[chain].on);
            }
            body == Body::Platform(platform)
        };
        let balls = |platform: usize| {
            let closures = mechanism.closures().iter();
            let carried = mechanism.chains().iter().map(|chain| chain.on);
            let balls = (closures.flat_map(|closure| closure.frames)).chain(carried);
            let places = balls.filter_map(|frame| places.get(&frame).copied());
            places.filter(move |&place| is_carried(bodies[place], platform))
        };
        let rods: Vec<usize> = (0..mechanism.platforms().len())
            .filter(|&platform| balls(platform).any(|i| balls(platform).any(|j| apart(i, j))))
            .collect();
        let unknowns = self.system.unknowns();
        // the motions in which each unknown moves
        let mut moving: Vec<Vec<usize>> = vec![Vec::new(); unknowns.len()];
        for (number, motion) in motions.iter().enumerate() {
            let rates = moving.iter_mut().zip(motion).filter(|(_, x)| **x != 0.0);
            rates.for_each(|(moving, _)| moving.push(number));
        }
        let of_frame = |place: usize, rates: &dyn Fn(Twist<f64>) -> [f64; 3]| {
            let columns = self.frames.columns(place);
            let mut touched: Vec<usize> = columns.flat_map(|k| &moving[k]).copied().collect();
            touched.sort_unstable();
            touched.dedup();
            let twist = |motion: &usize| self.frames.twist(place, &placement, &motions[*motion]);
            RowGroup {
                count: 3,
                entries: touched.iter().flat_map(|of| rates(twist(of))).collect(),
                unknowns: touched,
            }
        };
        let velocities =
            (of_links.iter()).map(|&place| of_frame(place, &|twist| twist.velocity.times(scale).0));
        let turns = turning.iter().map(|(place, axes)| {
            of_frame(*place, &|twist| {
                let mut omega = twist.omega;
                // parallel, or at right angles as those of a universal joint
                for &k in axes {
                    let axis = self.frames.axis(k, &placement);
                    omega = omega - axis.times(omega.dot(&axis));
                }
                omega.0
            })
        });
        let counted = unknowns
            .iter()
            .enumerate()
            .filter(|(_, unknown)| match **unknown {
                Unknown::Joint(joint) => {
                    mechanism.joints()[joint].role != Role::Passive || outside.contains(&joint)
                }
                Unknown::Twist(platform, _) => !rods.contains(&platform),
            });
        let rates = counted.map(|(k, _)| RowGroup {
            count: 1,
            entries: moving[k].iter().map(|&motion| motions[motion][k]).collect(),
            unknowns: moving[k].clone(),
        });
        velocities.chain(turns).chain(rates).collect()
    }
}

impl Tangent {
    /// The motions of an independent part of the mechanism alone.
    pub fn within(&self, own: &[bool]) -> Tangent {
        if own.iter().all(|own| *own) {
            return self.clone();
        }
        let places: Vec<usize> = (0..own.len()).filter(|&i| own[i]).collect();
        let parts = |motions: &[Vec<f64>]| {
            let touches = |motion: &&Vec<f64>| places.iter().any(|&i| motion[i] != 0.0);
            let part = |motion: &Vec<f64>| {
                let mut part = vec![0.0; own.len()];
                places.iter().for_each(|&i| part[i] = motion[i]);
                part
            };
            let touching = motions.iter().filter(touches).map(part);
            orthonormal(&touching.collect::<Vec<_>>(), STILL)
        };
        Tangent {
            at: self.at.clone(),
            decomposition: self.decomposition.clone(),
            motions: parts(&self.motions),
            idle: parts(&self.idle),
        }
    }

    /// Number of unknowns.
    pub fn columns(&self) -> usize {
        match (self.motions.first(), self.idle.first()) {
            (Some(motion), _) | (None, Some(motion)) => motion.len(),
            (None, None) => self.decomposition.rank(),
        }
    }
}
