//! Finite steps from an assembled configuration.

use super::{Neighbourhood, Tangent};
use crate::linear::{Svd, add, dot, norm};
use crate::mechanism::Configuration;
use crate::number::real;
use crate::number::tolerance::{DIFFERENCE, NOT_PRINTED, SOLVED, SUMMED};
use crate::solve::Equations;
use crate::system::equations::settle;

/// Length of a finite step along a motion, in rad and characteristic lengths: one that is infinitesimal only, to second order,
/// leaves a gap of about its square.
pub const FINITE_STEP: f64 = 0.05;

/// A finite step along an infinitesimal motion.
#[derive(Clone, Debug)]
pub struct FiniteStep {
    /// The configuration at which every equation in the range of the Jacobian holds.
    pub at: Configuration<f64>,
    /// The residual of the others, dimensionless: zero if the motion is finite.
    pub gap: f64,
}

impl Neighbourhood<'_> {
    /// Moves a distance along a motion and back onto the equations in the range of the Jacobian.
    ///
    /// With P = J⁺ fixed, x ← x ⊖ P r(x) solves the part of r in the range of J for given motion components: the
    /// reduction of Lyapunov and Schmidt. What is left of r is a function of the motion components alone, and a
    /// freedom is finite where it vanishes identically. `None` if the iteration does not settle.
    /// Source: Golubitsky and Schaeffer, Singularities and Groups in Bifurcation Theory I, 1985.
    pub fn follow(
        &mut self,
        from: &Tangent,
        direction: &[f64],
        distance: f64,
    ) -> Option<FiniteStep> {
        const STEPS: usize = 60;
        // a residual that is rounding, 4e-15, asks for corrections of this length
        let noise = (4e-15 / from.decomposition.smallest()).max(1e-12);
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
            // not within the distance: the linearisation does not hold so far out
            if size.is_nan() || size >= 10.0 * distance {
                return None;
            }
            if size < 1e-14 || (size < noise && size >= 0.5 * before) {
                let gap = norm(residual);
                return Some(FiniteStep { at, gap });
            }
            before = size;
            let back: Vec<f64> = correction.iter().map(|x| -x).collect();
            at = self.system.displaced(&at, &back);
        }
        None
    }

    /// The finite step along a motion if there is one: `distance`, or as much shorter as it takes to settle, near a
    /// singular configuration about the distance to that. `Err` has the gap of one that leaves the closures open, and
    /// `None` if no step settles that is long enough to tell.
    pub fn free_step(
        &mut self,
        from: &Tangent,
        direction: &[f64],
        distance: f64,
    ) -> Result<FiniteStep, Option<f64>> {
        let mut length = distance;
        // a second-order freedom leaves κℓ²/2 of a dimensionless equation with curvature κ: in a step shorter than √(1e-13/κ)
        // with κ = 1e-3 it cannot be told from a free one
        while length > 1e-5 {
            if let Some(step) = self.follow(from, direction, length) {
                // rounding: a freedom of order five leaves 0.05⁶ = 1.6e-8 times its curvature; a short step would leave
                // no more of one of second order
                let free = if length < 1e-3 { SUMMED } else { 1e-11 };
                return match step.gap <= free {
                    true => Ok(step),
                    false => Err(Some(step.gap)),
                };
            }
            length *= 0.5;
        }
        Err(None)
    }

    /// The motions as one and the others, if the size of what is left of the equations after a finite step is a function of
    /// that one alone: its slopes at finite steps in some random directions are all along it.
    pub fn hindered_alone(
        &mut self,
        from: &Tangent,
        directions: &[Vec<f64>],
        distance: f64,
    ) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
        /// Half the step of the central differences as part of the distance.
        const PART: f64 = 1e-3;
        let motions = &from.motions;
        let dependencies = from.decomposition.left_null_space();
        let mut left_at = |place: &[f64], part: f64, motion: &[f64]| {
            let mut direction = place.to_vec();
            add(&mut direction, part, motion);
            self.follow(from, &direction, distance)?;
            let residual = self.system.residual_of(&self.work);
            let parts: Vec<f64> = dependencies.iter().map(|w| dot(w, residual)).collect();
            Some(norm(&parts))
        };
        let mut slopes = Vec::new();
        for motion in motions {
            for place in directions {
                slopes.push(left_at(place, PART, motion)? - left_at(place, -PART, motion)?);
            }
        }
        let svd = Svd::of(directions.len(), motions.len(), &slopes);
        let next = svd.values.get(1);
        // what differences leave of zero
        if next.is_some_and(|next| *next > 1e-4 * svd.values[0]) {
            return None;
        }
        let mut along = svd.right.iter().map(|weights| {
            let mut sum = vec![0.0; motions[0].len()];
            let parts = motions.iter().zip(weights);
            parts.for_each(|(motion, weight)| add(&mut sum, *weight, motion));
            sum
        });
        Some((along.next()?, along.collect()))
    }

    /// True if all motions are finite, tried along one motion that mixes them; false for a shaky structure.
    pub fn is_mobile(&mut self, at: &Tangent) -> bool {
        mixture(&at.motions).is_none_or(|mixed| self.free_step(at, &mixed, FINITE_STEP).is_ok())
    }

    /// About how far the nearest singular configuration is along the motions, in rad and
    /// characteristic lengths; `None` if that is more than `within` or nothing leads there.
    ///
    /// The smallest singular value σ = uᵀ J v that counts changes by gᵢ = uᵀ (∂J/∂mᵢ) v along a
    /// motion mᵢ, so that to first order it vanishes at the distance σ/‖g‖.
    pub fn singular_within(&mut self, from: &Tangent, within: f64) -> Option<f64> {
        let (u, v) = from.decomposition.weakest()?;
        let smallest = from.decomposition.smallest();
        // along a unit motion J changes by about its own size at most
        if smallest > 2.0 * within * from.decomposition.singular_values()[0] {
            return None;
        }
        let mut squares = 0.0;
        for motion in &from.motions {
            let mut slope = 0.0;
            for step in [DIFFERENCE, -DIFFERENCE] {
                let ahead: Vec<f64> = motion.iter().map(|x| x * step).collect();
                let at = self.system.displaced(&from.at, &ahead);
                self.system.linearise(&at, &mut self.work);
                slope += self.system.form(&self.work, u, v) / (2.0 * step);
            }
            squares += slope * slope;
        }
        let distance = smallest / squares.sqrt();
        (distance < within).then_some(distance)
    }

    /// Second-order residual of a motion ξ that other motions cannot correct: wᵀ H(ξ, ξ) for each given w with wᵀ J =
    /// 0.
    pub fn second_order(
        &mut self,
        from: &Tangent,
        dependencies: &[Vec<f64>],
        motion: &[f64],
    ) -> Vec<f64> {
        // balances the fourth order against rounding
        let length = 1e-3;
        let mut sums = vec![0.0; dependencies.len()];
        for step in [length, -length] {
            let step: Vec<f64> = motion.iter().map(|x| x * step).collect();
            let at = self.system.displaced(&from.at, &step);
            self.system.residual(&at, &mut self.work);
            let residual = self.system.residual_of(&self.work);
            (sums.iter_mut().zip(dependencies)).for_each(|(sum, w)| *sum += dot(w, residual));
        }
        sums.iter().map(|sum| sum / (length * length)).collect()
    }

    /// The assembled configuration nearest to a point, in rad and characteristic lengths, downhill from an assembled
    /// one.
    ///
    /// Takes back the part of the distance along the motions ξ: x ← x ⊖ Σ ξ (ξ · (x ⊖ point)), shortened until x is
    /// nearer.
    pub fn nearest(
        &mut self,
        point: &Configuration<f64>,
        mut at: Configuration<f64>,
    ) -> Configuration<f64> {
        const STEPS: usize = 200;
        let mut part = 1.0;
        let mut away = self.system.difference(point, &at);
        let mut along = self.along_motions(&at, &away);
        for _ in 0..STEPS {
            let size = part * norm(&along);
            if size < NOT_PRINTED {
                break;
            }
            let back: Vec<f64> = along.iter().map(|x| -part * x).collect();
            let ahead = self.system.displaced(&at, &back);
            let nearer = self.settle(ahead, size).and_then(|settled| {
                let further = self.system.difference(point, &settled);
                let left = self.along_motions(&settled, &further);
                let (before, after) = (norm(&away), norm(&further));
                // a distance is flat where it is least: there its slope decides
                let nearer = match (after - before).abs() <= SOLVED * before {
                    true => norm(&left) < norm(&along),
                    false => after < before,
                };
                nearer.then_some((settled, further, left))
            });
            match nearer {
                Some(nearer) => {
                    (at, away, along) = nearer;
                    part = f64::min(2.0 * part, 1.0);
                }
                None => part *= 0.5,
            }
        }
        at
    }

    /// The part of a change that is along the motions at a configuration.
    fn along_motions(&mut self, at: &Configuration<f64>, change: &[f64]) -> Vec<f64> {
        let mut along = vec![0.0; change.len()];
        for motion in &self.tangent(at.clone()).motions {
            add(&mut along, dot(motion, change), motion);
        }
        along
    }

    /// The assembled configuration that Gauss–Newton steps of least length reach within `reach`, to rounding.
    pub fn settle(&mut self, at: Configuration<f64>, reach: f64) -> Option<Configuration<f64>> {
        settle(&self.system, &mut self.work, at, reach, self.watch)
    }
}

/// A unit motion that mixes all; `None` if there are none.
pub(super) fn mixture(motions: &[Vec<f64>]) -> Option<Vec<f64>> {
    let mut mixed = vec![0.0; motions.first()?.len()];
    for (motion, weight) in motions.iter().zip(1u8..) {
        add(&mut mixed, real::sin(1.7 * f64::from(weight)), motion);
    }
    let size = norm(&mixed);
    mixed.iter_mut().for_each(|x| *x /= size);
    (size > 0.0).then_some(mixed)
}
