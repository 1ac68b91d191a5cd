//! Balance of the loads of a moving mechanism: forces of its drives, and reactions.

use super::joint_reactions::{Bearings, Carried};
use super::loaded::{Acting, Loaded, Moving};
use super::{FrameTwists, Load, Motion};
use crate::geometry::Vector3;
use crate::linear::Factorable;
use crate::mechanism::{Carrier, Configuration, Frame, Friction, Kinematics, Mechanism, Worker};
use crate::number::tolerance::{CANCELLED, ROUNDING};
use crate::number::{Dual, Number};

/// The forces that drive a mechanism so that it moves as it does, by d'Alembert: loads, weights, springs and the
/// forces of inertia are in equilibrium with those of the drives and with the reactions.
#[derive(Clone, Debug)]
pub struct Balance<T: Factorable = f64> {
    loaded: Loaded<T>,
    /// Its points to second order, if bodies have mass.
    changing: Option<FrameTwists<Dual<T>>>,
    bearings: Option<Bearings<T>>,
    /// Friction with the number of the link behind its joint, and true for a hinge.
    frictions: Vec<(Friction, Option<usize>, bool)>,
    /// For each friction the direction in which its joint slides, 0 where it does not, if that is told.
    pub slides: Vec<f64>,
    /// True if accelerations are known.
    changes: bool,
    /// Everything that acts.
    pub acting: Acting<T>,
    /// Force or moment at each held coordinate, in N or N·m.
    pub forces: Vec<T>,
    /// The reactions of closures, then of joints, if they are wanted.
    pub reactions: Vec<Carried<T>>,
    /// The inertia that each held coordinate feels, once it [is wanted](Balance::feel), in kg·m² or kg.
    pub inertias: Vec<T>,
    /// The power of the drives, in W.
    pub power: T,
    /// The sum of the sizes of all that acts, moments over the characteristic length, in N: rounding is in proportion to it.
    pub size: T,
    length: f64,
    /// Those of the rows of closures, in N·m.
    multipliers: Vec<T>,
    /// For each link and closure the number of its reaction.
    joint_links: Vec<Option<usize>>,
    /// For each load of the file the number of its power, if it acts.
    workers: Vec<Option<usize>>,
}

/// Motion at the instant: what [`Moving`] says beside the rates, with the direction in which friction is overcome.
#[derive(Clone, Copy)]
pub struct Instant<T> {
    /// The pace against the rates of the motion, as in [`Moving`].
    pub pace: [T; 2],
    /// In s.
    pub time: T,
    /// For a mechanism at rest the sign of the rates with which it is about to move.
    pub impending: Option<f64>,
}

impl Load {
    /// True if reactions decide how much friction there is.
    pub fn has_friction(&self) -> bool {
        !self.own.frictions.is_empty()
    }
}

impl<T: Factorable> Balance<T> {
    /// Frames that must be placed.
    pub fn frames(mechanism: &Mechanism, load: &Load, reactions: bool) -> Vec<Frame> {
        let mut frames: Vec<Frame> = load.frames().collect();
        if reactions || load.has_friction() {
            frames.extend(Bearings::<T>::frames(mechanism));
        }
        frames
    }

    /// For a motion that places its [frames](Self::frames).
    pub fn new(
        mechanism: &Mechanism,
        load: &Load,
        motion: &Motion<T>,
        kinematics: &Kinematics<T>,
        reactions: bool,
    ) -> Self {
        let unknowns = motion.unknowns();
        let loaded = Loaded::new(mechanism, unknowns, load, kinematics);
        let changing = load.has_inertia();
        let changing = changing.then(|| FrameTwists::moving(mechanism, motion, loaded.points()));
        let bearings = (reactions || load.has_friction())
            .then(|| Bearings::new(mechanism, unknowns, &loaded, kinematics));
        let link_of = |joint: usize| {
            let links = bearings.as_ref()?.links().iter();
            let mut links = links.map(|(_, chain, row)| &mechanism.chains()[*chain].rows[row - 1]);
            links.position(|row| row.joints().contains(&joint))
        };
        let joint_links = (0..mechanism.joints().len()).map(link_of).collect();
        Balance {
            frictions: (load.own.frictions.iter())
                .map(|friction| {
                    let turns = mechanism.joints()[friction.joint].kind.is_angle();
                    (friction.clone(), link_of(friction.joint), turns)
                })
                .collect(),
            slides: Vec::new(),
            changes: false,
            loaded,
            changing,
            bearings,
            acting: Acting::default(),
            forces: Vec::new(),
            reactions: Vec::new(),
            multipliers: Vec::new(),
            inertias: Vec::new(),
            power: T::zero(),
            size: T::zero(),
            length: mechanism.characteristic_length(),
            joint_links,
            workers: (mechanism.loads().names())
                .map(|name| load.own.names().position(|known| known == name))
                .collect(),
        }
    }

    /// The reaction of a joint or a closure, if it is known.
    pub fn reaction(&self, of: Carrier) -> Option<&Carried<T>> {
        self.reactions.get(self.place(of)?)
    }

    /// The power of drives or loads, in W.
    pub fn power_of(&self, worker: Worker) -> T {
        match worker {
            Worker::Drives => self.power,
            Worker::Loads => self.acting.supplied,
            Worker::Load(i) => {
                let known = self.workers[i].and_then(|place| self.acting.powers.get(place));
                known.copied().unwrap_or(T::zero())
            }
        }
    }

    /// The number of its reaction.
    pub fn place(&self, of: Carrier) -> Option<usize> {
        let closures = self.bearings.as_ref()?.closures();
        Some(match of {
            Carrier::Closure(closure) => closure,
            Carrier::Joint(joint) => closures + (*self.joint_links.get(joint)?)?,
        })
    }

    /// The force that the moving bodies exert on ground and its moment about the origin of ground: that of weights, inertia
    /// and what else acts from outside. Springs and forces between two bodies cancel out.
    pub fn shaking(&self, motion: &Motion<T>, centre: [f64; 3]) -> [Vector3<T>; 2] {
        let centre = Vector3(centre.map(T::from_f64));
        let mut sum = [Vector3::zero(); 2];
        for (i, [force, moment]) in self.acting.wrenches.iter().enumerate() {
            let arm = self.loaded.origin(i, motion.placement()) + centre;
            sum[0] += *force;
            sum[1] += *moment + arm.cross(force);
        }
        sum
    }

    /// The loads, the forces at held coordinates and the reactions, where the motion was last factorised and its rates and
    /// accelerations are known. `responses` are its motions for a unit rate of each held coordinate, if wanted.
    pub fn at(
        &mut self,
        motion: &mut Motion<T>,
        at: &Configuration<T>,
        responses: &[(&[T], bool)],
        instant: Instant<T>,
    ) {
        let [rates, _] = motion.known();
        let rates = rates.to_vec();
        let changes = self.changing.as_ref().zip(Some(motion.changes()));
        let moving = Moving {
            rates: &rates,
            changes: changes.map(|(twists, (rates, placement))| (twists, rates, placement)),
            pace: instant.pace,
            time: instant.time,
        };
        let placement = motion.placement();
        let at_rest = instant.impending.is_some();
        self.changes = !at_rest;
        let moving = (!at_rest).then_some(moving);
        (self.loaded).act(at, placement, moving, &mut self.acting);
        if self.bearings.is_some() {
            let sign = instant
                .impending
                .unwrap_or_else(|| instant.pace[0].real().signum());
            let efforts = self.rub(motion, &rates, sign);
            for (effort, (friction, ..)) in efforts.into_iter().zip(&self.frictions) {
                let joint = friction.joint;
                let rate = rates[joint].scale(self.loaded.joint_scale(joint)) * instant.pace[0];
                self.acting.supplied += effort * rate;
                self.acting.powers.push(effort * rate);
            }
            self.react(motion);
        }
        let placement = motion.placement();
        // τ δh + g δx = 0: what holds a coordinate does the work of the load
        let forces = responses.iter().map(|(rates, wanted)| match wanted {
            true => -self.loaded.power(&self.acting, rates, placement),
            false => T::from_f64(f64::NAN),
        });
        self.forces.clear();
        self.forces.extend(forces);
        let sizes = self
            .acting
            .wrenches
            .iter()
            .map(|[force, moment]| force.norm() + moment.norm().scale(1.0 / self.length));
        self.size = sizes.fold(T::zero(), |sum, size| sum + size);
        let power = self.loaded.power(&self.acting, &rates, placement);
        self.power = -(power * instant.pace[0]);
    }

    /// The reactions to what acts: λ = −(J⁺)ᵀ·g, row by row the power of the load while the row opens.
    fn react(&mut self, motion: &mut Motion<T>) {
        let Some(bearings) = &self.bearings else {
            return;
        };
        self.multipliers.clear();
        for row in 0..motion.rows() {
            let opening = motion.opening(row).to_vec();
            let placement = motion.placement();
            let power = self.loaded.power(&self.acting, &opening, placement);
            self.multipliers.push(power);
        }
        bearings.carried(
            (&self.loaded, &self.acting),
            &motion.closure_wrenches(),
            &self.multipliers,
            motion.placement(),
            &mut self.reactions,
        );
    }

    /// Adds friction against a motion and returns the effort of each: constant, and in proportion to the force across the joint, which depends on all
    /// friction. Not a number where no friction is large enough for the reactions that it causes: then the mechanism jams.
    ///
    /// Where a joint turns back, the friction is that just before.
    fn rub(&mut self, motion: &mut Motion<T>, rates: &[T], sign: f64) -> Vec<T> {
        const STEPS: usize = 40;
        let changes = match self.changes {
            true => motion.known()[1].to_vec(),
            false => vec![T::zero(); rates.len()],
        };
        let largest = |of: &[T]| of.iter().map(|x| x.real().abs()).fold(0.0, f64::max);
        let [still, steady] = [rates, &changes].map(|of| ROUNDING * largest(of));
        let sign_of = |friction: &Friction| {
            let rate = rates[friction.joint].real() * sign;
            let change = changes[friction.joint].real();
            match (rate.abs() <= still, change.abs() <= steady) {
                (false, _) => rate.signum(),
                (true, false) => -change.signum(),
                (true, true) => 0.0,
            }
        };
        let frictions = self.frictions.clone();
        let told = |i: usize, friction: &Friction| match self.slides.get(i) {
            Some(sign) => *sign,
            None => sign_of(friction),
        };
        let signs = frictions.iter().enumerate();
        let signs: Vec<f64> = signs.map(|(i, (friction, ..))| told(i, friction)).collect();
        let constant = frictions.iter().zip(&signs);
        let constant = constant.map(|((of, ..), sign)| T::from_f64(-of.constant * sign));
        let mut all: Vec<T> = constant.collect();
        for ((friction, ..), effort) in frictions.iter().zip(&all) {
            self.acting.efforts[friction.joint] += *effort;
        }
        let rubbing: Vec<_> = (frictions.iter().zip(&signs).enumerate())
            .filter(|(_, ((friction, ..), sign))| friction.coefficient > 0.0 && **sign != 0.0)
            .filter_map(|(i, ((friction, link, turns), sign))| {
                Some((friction, (*link)?, *turns, *sign, i))
            })
            .collect();
        let count = rubbing.len();
        if count == 0 {
            return all;
        }
        let closures = self.bearings.as_ref().map_or(0, Bearings::closures);
        let forces = |of: &Self| -> Vec<[f64; 3]> {
            let across = rubbing.iter().map(|(_, link, ..)| {
                let Carried { force, axis, .. } = &of.reactions[closures + link];
                let across = *force - axis.times(axis.dot(force));
                across.0.map(Number::real)
            });
            across.collect()
        };
        // forces across the joints are affine in the friction of each
        self.react(motion);
        let alone = forces(self);
        let mut unit = Vec::with_capacity(count);
        for (friction, ..) in &rubbing {
            self.acting.efforts[friction.joint] += T::one();
            self.react(motion);
            let with = forces(self);
            self.acting.efforts[friction.joint] -= T::one();
            let slope = |(a, b): (&[f64; 3], &[f64; 3])| [0, 1, 2].map(|i| a[i] - b[i]);
            unit.push(with.iter().zip(&alone).map(slope).collect::<Vec<_>>());
        }
        let factor = |k: usize| {
            let (friction, _, turns, sign, _) = &rubbing[k];
            -sign * friction.factor(*turns)
        };
        // Newton on f − c·|F(f)| = 0
        let mut efforts = nalgebra::DVector::<f64>::zeros(count);
        let mut settled = false;
        for _ in 0..STEPS {
            let mut gap = efforts.clone();
            let mut slopes = nalgebra::DMatrix::<f64>::identity(count, count);
            for j in 0..count {
                let force = [0, 1, 2].map(|i| {
                    let friction = (0..count).map(|k| unit[k][j][i] * efforts[k]);
                    alone[j][i] + friction.sum::<f64>()
                });
                let size = force.iter().map(|x| x * x).sum::<f64>().sqrt();
                gap[j] -= factor(j) * size;
                for k in 0..count {
                    let along: f64 = (0..3).map(|i| force[i] * unit[k][j][i]).sum();
                    if size > 0.0 {
                        slopes[(j, k)] -= factor(j) * along / size;
                    }
                }
            }
            let largest = efforts.amax().max(gap.amax());
            if gap.amax() <= CANCELLED * largest || largest == 0.0 {
                settled = true;
                break;
            }
            match slopes.lu().solve(&gap) {
                Some(step) => efforts -= step,
                None => break,
            }
        }
        for (k, (friction, .., i)) in rubbing.iter().enumerate() {
            let effort = T::from_f64(if settled { efforts[k] } else { f64::NAN });
            self.acting.efforts[friction.joint] += effort;
            all[*i] += effort;
        }
        all
    }

    /// The inertia that each held coordinate feels, for its motions that are wanted, where the motion was last factorised.
    pub fn feel(&mut self, motion: &Motion<T>, responses: &[(&[T], bool)]) {
        let inertias = responses.iter().map(|(rates, wanted)| match wanted {
            true => self.loaded.inertia(rates, motion.placement()),
            false => T::from_f64(f64::NAN),
        });
        self.inertias.clear();
        self.inertias.extend(inertias);
    }

    /// The mass matrix of motions of dimensionless rates, row by row, where the motion was last factorised.
    pub fn inertias(&self, motion: &Motion<T>, motions: &[Vec<T>]) -> Vec<T> {
        self.loaded.inertias(motions, motion.placement())
    }

    /// The power of what acts in a motion of dimensionless rates, where the motion was last factorised.
    pub fn power(&self, motion: &Motion<T>, rates: &[T]) -> T {
        self.loaded.power(&self.acting, rates, motion.placement())
    }
}
