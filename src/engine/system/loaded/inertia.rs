//! Weights, forces of inertia and mass matrices.

use super::here::Here;
use super::{Acting, Loaded};
use crate::geometry::Vector3;
use crate::mechanism::{Mass, Placement};
use crate::number::Number;

impl<T: Number> Loaded<T> {
    /// Weights, and forces and moments of inertia: F = m·(g − a), M = −(I·α + ω × I·ω).
    pub(super) fn weigh(&self, here: &Here<T>, acting: &mut Acting<T>) {
        let gravity = Vector3(self.own.gravity.map(T::from_f64));
        let centre = Vector3(self.centre.map(T::from_f64));
        for (mass, &i) in self.own.masses.iter().zip(&self.masses) {
            let m = mass.mass;
            let height = self.twists.origin(i, here.placement) + centre;
            acting.potential += -gravity.dot(&height).scale(m);
            acting.wrenches[i][0] += gravity.scaled(m);
            let Some([omega, velocity]) = here.motion(i) else {
                acting.powers.push(T::zero());
                continue;
            };
            acting.powers.push(gravity.dot(&velocity).scale(m));
            let spin = self.angular_momentum(i, mass, &omega, here.placement);
            let twice = velocity.dot(&velocity).scale(m) + omega.dot(&spin);
            acting.kinetic += twice.scale(0.5);
            if let Some([alpha, acceleration]) = here.change(i) {
                let change = self.angular_momentum(i, mass, &alpha, here.placement);
                acting.wrenches[i][0] += -acceleration.scaled(m);
                acting.wrenches[i][1] += -(change + omega.cross(&spin));
            }
        }
    }

    /// I·ω of a mass, in ground.
    fn angular_momentum(
        &self,
        i: usize,
        mass: &Mass,
        omega: &Vector3<T>,
        placement: &Placement<T>,
    ) -> Vector3<T> {
        let turn = &self.twists.frame(i, placement).rotation;
        let own = turn.inverse_rotate(omega);
        let along = |row: &[f64; 3]| {
            let parts = row.iter().zip(own.0).filter(|(entry, _)| **entry != 0.0);
            parts.fold(T::zero(), |sum, (entry, part)| sum + part.scale(*entry))
        };
        *turn * Vector3(mass.inertia.each_ref().map(along))
    }

    /// The inertia in a motion, Σ m·v² + ω·I·ω, for dimensionless rates of the unknowns.
    pub fn inertia(&self, rates: &[T], placement: &Placement<T>) -> T {
        let masses = self.own.masses.iter().zip(&self.masses);
        let parts = masses.map(|(mass, &i)| {
            let of = self.momenta(i, mass, rates, placement);
            Loaded::coupled(mass, [&of, &of])
        });
        parts.fold(T::zero(), |sum, part| sum + part)
    }

    /// The inertia that couples each two of several motions, row by row. For motions of unit rates of coordinates it is the
    /// mass matrix.
    pub fn inertias(&self, motions: &[Vec<T>], placement: &Placement<T>) -> Vec<T> {
        let count = motions.len();
        let mut sums = vec![T::zero(); count * count];
        let mut moving = Vec::with_capacity(count);
        for (mass, &i) in self.own.masses.iter().zip(&self.masses) {
            moving.clear();
            let all = motions.iter();
            moving.extend(all.map(|rates| self.momenta(i, mass, rates, placement)));
            for (a, first) in moving.iter().enumerate() {
                for (b, second) in moving[..=a].iter().enumerate() {
                    sums[a * count + b] += Loaded::coupled(mass, [first, second]);
                }
            }
        }
        for a in 0..count {
            for b in 0..a {
                sums[b * count + a] = sums[a * count + b];
            }
        }
        sums
    }

    /// Velocity, angular velocity and angular momentum of a mass.
    fn momenta(
        &self,
        i: usize,
        mass: &Mass,
        rates: &[T],
        placement: &Placement<T>,
    ) -> [Vector3<T>; 3] {
        let twist = self.twists.twist(i, placement, rates);
        let spin = self.angular_momentum(i, mass, &twist.omega, placement);
        [twist.velocity, twist.omega, spin]
    }

    /// m·v₁·v₂ + ω₁·I·ω₂.
    fn coupled(mass: &Mass, [[v, omega, _], [w, _, spin]]: [&[Vector3<T>; 3]; 2]) -> T {
        v.dot(w).scale(mass.mass) + omega.dot(spin)
    }
}
