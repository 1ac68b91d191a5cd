//! What a mechanism with nothing held can do near an assembled configuration.

use super::{ClosureWrenches, FrameTwists, Held, System, Unknown, Work};
use crate::description::{ClosureKind, Role};
use crate::linear::{Decomposition, RANK_TOLERANCE, complement, dot, norm, orthonormal, rank_of};
use crate::mechanism::{Body, Configuration, Frame, Mechanism};
use crate::solve::{Equations, Newton, Stop};

/// What is rounding among the rates of motions of unit norm.
const ROUNDING: f64 = 1e-6;

/// A mechanism with nothing held, or what a question holds, to be looked at near assembled
/// configurations.
#[derive(Clone, Debug)]
pub struct Neighbourhood<'a> {
    mechanism: &'a Mechanism,
    system: System<f64>,
    work: Work<f64>,
    frames: FrameTwists<f64>,
}

/// The closure equations linearised at an assembled configuration: J ξ = 0.
#[derive(Clone, Debug)]
pub struct Tangent {
    /// The configuration.
    pub at: Configuration<f64>,
    /// The Jacobian J, column-major and dimensionless, with nothing held.
    pub jacobian: Vec<f64>,
    /// Its decomposition.
    pub decomposition: Decomposition,
    /// Orthonormal basis of the infinitesimal motions ξ that are more than idle.
    pub motions: Vec<Vec<f64>>,
    /// Orthonormal basis of the idle ones: links turn about their own lines and nothing else moves.
    pub idle: Vec<Vec<f64>>,
}

/// Where a finite step along an infinitesimal motion leads.
#[derive(Clone, Debug)]
pub struct Followed {
    /// The configuration at which every equation is met that the Jacobian sees.
    pub at: Configuration<f64>,
    /// What is left of the others, dimensionless: zero if the motion is finite.
    pub gap: f64,
}

impl<'a> Neighbourhood<'a> {
    /// Prepares a mechanism of which nothing is held.
    pub fn new(mechanism: &'a Mechanism) -> Self {
        Neighbourhood::holding(mechanism, &Held::nothing(mechanism))
    }

    /// Prepares a mechanism of which something is held.
    pub fn holding(mechanism: &'a Mechanism, held: &Held<f64>) -> Self {
        let system = System::new(mechanism.dimensions(), held);
        let frames = mechanism.frames();
        Neighbourhood {
            mechanism,
            work: system.work(),
            frames: FrameTwists::new(mechanism.dimensions(), system.unknowns(), &frames),
            system,
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
        let jacobian = self.system.dense_jacobian(&mut self.work);
        let columns = self.system.unknowns().len();
        let decomposition = Decomposition::of(self.system.rows(), columns, &jacobian);
        let all = decomposition.null_space();
        let felt = self.felt(&at, &all);
        let split = Decomposition::of(felt.len() / all.len().max(1), all.len(), &felt);
        let combine = |weights: &Vec<f64>| -> Vec<f64> {
            let along = |i: usize| all.iter().zip(weights).map(|(m, w)| m[i] * w).sum();
            (0..columns).map(along).collect()
        };
        let idle = match split.singular_values().first() {
            // all of it is rounding beside motions of unit norm
            Some(&largest) if largest < ROUNDING => complement(&[], all.len()),
            _ => split.null_space(),
        };
        let motions = complement(&idle, all.len());
        Tangent {
            idle: idle.iter().map(combine).collect(),
            // without idle ones the basis stays as sparse as it came
            motions: if idle.is_empty() {
                all
            } else {
                motions.iter().map(combine).collect()
            },
            at,
            jacobian,
            decomposition,
        }
    }

    /// The rank of the closure equations at a configuration.
    pub fn rank(&mut self, at: &Configuration<f64>) -> usize {
        self.system.linearise(at, &mut self.work);
        let jacobian = self.system.dense_jacobian(&mut self.work);
        rank_of(self.system.rows(), self.system.unknowns().len(), &jacobian)
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
        let mut trial = at.clone();
        let report = newton.solve(&self.system, &mut at, &mut trial, &mut self.work);
        (report.stop == Stop::Solved).then_some(at)
    }

    /// Whether motions are idle: links turn about their own lines and nothing else moves.
    pub fn are_idle(&self, at: &Configuration<f64>, motions: &[Vec<f64>]) -> bool {
        let felt = self.felt(at, motions);
        felt.iter().all(|rate| rate.abs() < ROUNDING)
    }

    /// For each motion a column of all that idle freedoms leave at rest: origins of frames,
    /// platforms, driven joints, links that end in something else than a ball, joints that no
    /// closure feels.
    fn felt(&self, at: &Configuration<f64>, motions: &[Vec<f64>]) -> Vec<f64> {
        let mechanism = self.mechanism;
        let mut placement = self.frames.placement();
        self.frames.place(at, &mut placement);
        let scale = 1.0 / mechanism.characteristic_length();
        let frames: Vec<Frame> = self.frames.frames().collect();
        let turning: Vec<usize> = (mechanism.closures().iter())
            .filter(|closure| {
                !matches!(closure.kind, ClosureKind::Spherical | ClosureKind::Distance)
            })
            .flat_map(|closure| closure.frames)
            .filter_map(|frame| frames.iter().position(|f| *f == frame))
            .collect();
        let unfelt = mechanism.unfelt_joints();
        // platforms on balls apart: what leaves the balls at rest turns them about the line of these
        let balls = |platform: usize| {
            let closures = mechanism.closures().iter();
            let balls = closures
                .flat_map(|closure| closure.frames)
                .filter(move |frame| mechanism.body(*frame) == Body::Platform(platform));
            balls.filter_map(|frame| frames.iter().position(|f| *f == frame))
        };
        let apart = |i: usize, j: usize| {
            let [a, b] = [i, j].map(|k| self.frames.origin(k, &placement));
            (a - b).norm() > 1e-6 / scale
        };
        let rods: Vec<usize> = (0..mechanism.platforms().len())
            .filter(|&platform| balls(platform).any(|i| balls(platform).any(|j| apart(i, j))))
            .collect();
        let mut felt = Vec::new();
        for motion in motions {
            for i in 0..frames.len() {
                let twist = self.frames.twist(i, &placement, motion);
                felt.extend(twist.velocity.times(scale).0);
            }
            for &i in &turning {
                felt.extend(self.frames.twist(i, &placement, motion).omega.0);
            }
            for (unknown, &rate) in self.system.unknowns().iter().zip(motion) {
                let idle = match *unknown {
                    Unknown::Joint(joint) => {
                        mechanism.joints()[joint].role == Role::Passive && !unfelt.contains(&joint)
                    }
                    Unknown::Twist { platform, .. } => rods.contains(&platform),
                };
                if !idle {
                    felt.push(rate);
                }
            }
        }
        felt
    }

    /// Moves a distance along a motion and back onto the equations that the Jacobian sees.
    ///
    /// With P = J⁺ fixed, x ← x ⊖ P r(x) solves the part of r in the range of J for given motion
    /// components: the reduction of Lyapunov and Schmidt. What is left of r is a function of the
    /// motion components alone, and a freedom is finite where it vanishes identically. `None` if
    /// the iteration does not settle.
    /// Source: Golubitsky and Schaeffer, Singularities and Groups in Bifurcation Theory I, 1985.
    pub fn follow(&mut self, from: &Tangent, direction: &[f64], distance: f64) -> Option<Followed> {
        const STEPS: usize = 60;
        /// What rounding leaves of a dimensionless residual.
        const CLOSED: f64 = 4e-15;
        // a residual that is rounding asks for corrections of this length
        let noise = (CLOSED / from.decomposition.smallest()).max(1e-12);
        if noise > distance {
            return None;
        }
        let step: Vec<f64> = direction.iter().map(|x| x * distance).collect();
        let mut at = self.system.displaced(&from.at, &step);
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            self.system.residual(&at, &mut self.work);
            let residual = self.system.residual_of(&self.work);
            let correction = from.decomposition.solve(residual);
            let size = norm(&correction);
            // not even within the distance: the linear picture does not hold so far out
            if size.is_nan() || size >= 10.0 * distance {
                return None;
            }
            if size < 1e-14 || (size < noise && size >= 0.5 * before) {
                let gap = norm(residual);
                return Some(Followed { at, gap });
            }
            before = size;
            let back: Vec<f64> = correction.iter().map(|x| -x).collect();
            at = self.system.displaced(&at, &back);
        }
        None
    }

    /// The finite step along a motion if there is one: no longer than `distance`, shortened as far
    /// as needed for it to settle, which near a singular configuration is about the distance to that.
    /// `Err` has the gap of one that leaves the closures open.
    pub fn free_step(
        &mut self,
        from: &Tangent,
        direction: &[f64],
        distance: f64,
    ) -> Result<Followed, Option<f64>> {
        /// This gap may be left and the motion still counts as free: rounding. A freedom that is
        /// infinitesimal to order five only leaves 0.05⁶ = 1.6e-8 times its curvature.
        const FREE: f64 = 1e-11;
        /// The same for a step so short that a freedom of second order would leave no more than that.
        const FREE_IF_SHORT: f64 = 1e-13;
        const SHORT: f64 = 1e-3;
        let mut length = distance;
        while length > RANK_TOLERANCE {
            if let Some(step) = self.follow(from, direction, length) {
                let free = if length < SHORT { FREE_IF_SHORT } else { FREE };
                return match step.gap <= free {
                    true => Ok(step),
                    false => Err(Some(step.gap)),
                };
            }
            length *= 0.5;
        }
        Err(None)
    }

    /// Whether all motions are finite, tried along one that mixes them all: a shaky structure has some
    /// that are not.
    pub fn is_mobile(&mut self, at: &Tangent) -> bool {
        const STEP: f64 = 0.05;
        let mut mixed = vec![0.0; self.system.unknowns().len()];
        for (motion, weight) in at.motions.iter().zip(1u8..) {
            let weight = (1.7 * f64::from(weight)).sin();
            (mixed.iter_mut().zip(motion)).for_each(|(x, m)| *x += weight * m);
        }
        let size = norm(&mixed);
        if size == 0.0 {
            return true;
        }
        mixed.iter_mut().for_each(|x| *x /= size);
        self.free_step(at, &mixed, STEP).is_ok()
    }

    /// About how far the nearest singular configuration is along the motions, in rad and
    /// characteristic lengths; `None` if that is more than `within` or nothing leads there.
    ///
    /// The smallest singular value σ = uᵀ J v that counts changes by gᵢ = uᵀ (∂J/∂mᵢ) v along a
    /// motion mᵢ, so that to first order it vanishes at the distance σ/‖g‖.
    pub fn singular_within(&mut self, from: &Tangent, within: f64) -> Option<f64> {
        /// Step of the central differences.
        const STEP: f64 = 1e-4;
        let (u, v) = from.decomposition.weakest()?;
        let smallest = from.decomposition.smallest();
        let rows = self.system.rows();
        let mut squares = 0.0;
        for motion in &from.motions {
            let mut slope = 0.0;
            for step in [STEP, -STEP] {
                let ahead: Vec<f64> = motion.iter().map(|x| x * step).collect();
                let at = self.system.displaced(&from.at, &ahead);
                self.system.linearise(&at, &mut self.work);
                let jacobian = self.system.dense_jacobian(&mut self.work);
                let columns = jacobian.chunks_exact(rows).zip(v);
                let value: f64 = columns.map(|(column, v)| v * dot(u, column)).sum();
                slope += value / (2.0 * step);
            }
            squares += slope * slope;
        }
        let distance = smallest / squares.sqrt();
        (distance < within).then_some(distance)
    }

    /// The largest dimensionless row of the equations at a configuration.
    pub fn residual(&mut self, at: &Configuration<f64>) -> f64 {
        self.system.residual(at, &mut self.work).largest
    }

    /// What a motion ξ leaves of the equations to second order: wᵀ H(ξ, ξ) for each of the given w
    /// with wᵀ J = 0. Motions of higher order that a finite one would need do not enter.
    pub fn second_order(
        &mut self,
        from: &Tangent,
        dependencies: &[Vec<f64>],
        motion: &[f64],
    ) -> Vec<f64> {
        /// Balances the fourth order against rounding.
        const STEP: f64 = 1e-3;
        let mut sums = vec![0.0; dependencies.len()];
        for step in [STEP, -STEP] {
            let step: Vec<f64> = motion.iter().map(|x| x * step).collect();
            let at = self.system.displaced(&from.at, &step);
            self.system.residual(&at, &mut self.work);
            let residual = self.system.residual_of(&self.work);
            (sums.iter_mut().zip(dependencies)).for_each(|(sum, w)| *sum += dot(w, residual));
        }
        sums.iter().map(|sum| sum / (STEP * STEP)).collect()
    }

    /// The assembled configuration that Gauss–Newton steps of least length reach from a point, to
    /// rounding; `None` if they go further than `reach` or do not arrive.
    pub fn settle(&mut self, mut at: Configuration<f64>, reach: f64) -> Option<Configuration<f64>> {
        const STEPS: usize = 60;
        const TOLERANCE: f64 = 1e-12;
        let start = at.clone();
        let mut best: Option<(f64, Configuration<f64>)> = None;
        let mut stale = 0;
        for _ in 0..STEPS {
            let size = self.system.linearise(&at, &mut self.work).largest;
            if best.as_ref().is_none_or(|(least, _)| size < 0.5 * least) {
                best = Some((size, at.clone()));
                stale = 0;
            } else {
                stale += 1;
            }
            if size == 0.0 || (stale > 2 && best.as_ref().is_some_and(|b| b.0 <= TOLERANCE)) {
                break;
            }
            let jacobian = self.system.dense_jacobian(&mut self.work);
            let (rows, columns) = (self.system.rows(), self.system.unknowns().len());
            let decomposition = Decomposition::of(rows, columns, &jacobian);
            let mut back = decomposition.solve(self.system.residual_of(&self.work));
            let longest = norm(&back);
            let factor = (reach / longest).min(1.0);
            back.iter_mut().for_each(|x| *x *= -factor);
            at = self.system.displaced(&at, &back);
            if norm(&self.system.difference(&start, &at)) > 10.0 * reach {
                return None;
            }
        }
        let (size, at) = best?;
        (size <= TOLERANCE).then_some(at)
    }
}

impl Tangent {
    /// The motions of an independent part of the mechanism alone.
    pub fn within(self, own: &[bool]) -> Tangent {
        if own.iter().all(|own| *own) {
            return self;
        }
        let parts = |motions: &[Vec<f64>]| {
            let part = |motion: &Vec<f64>| -> Vec<f64> {
                let all = motion.iter().zip(own);
                all.map(|(x, own)| if *own { *x } else { 0.0 }).collect()
            };
            orthonormal(&motions.iter().map(part).collect::<Vec<_>>(), 1e-6)
        };
        Tangent {
            motions: parts(&self.motions),
            idle: parts(&self.idle),
            ..self
        }
    }

    /// How many unknowns there are.
    pub fn columns(&self) -> usize {
        match (self.motions.first(), self.idle.first()) {
            (Some(motion), _) | (None, Some(motion)) => motion.len(),
            (None, None) => self.decomposition.rank(),
        }
    }

    /// How far a unit vector is from being a motion: the sine of the angle between them.
    pub fn misses(&self, direction: &[f64]) -> f64 {
        let along = self.motions.iter().chain(&self.idle);
        let squares: f64 = along.map(|motion| dot(motion, direction).powi(2)).sum();
        (1.0 - squares).max(0.0).sqrt()
    }
}
