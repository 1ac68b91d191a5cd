//! Other angles of balls in gimbal lock, from which the bodies move as on real balls.
//!
//! Where the first and the third axis of a ball written as three rows are one line, the ball turns about no axis normal to that
//! line and to the second axis z₂. But z₂ may stand anywhere about the line: the configurations with other angles make a
//! component of their own, along which no body moves, and which the motions of the bodies leave where z₂ is as they need it.

use super::follow::{FINITE_STEP, mixture};
use super::{Neighbourhood, Tangent};
use crate::linear::Decomposition;
use crate::mechanism::{Configuration, LockedBall};
use crate::number::real;
use crate::solve::{Equations, Newton};
use crate::system::Unknown;

impl Neighbourhood<'_> {
    /// The motions beside the bodies' poses of a configuration with balls in gimbal lock, out of it; `None` if no ball is locked
    /// whose bodies could move otherwise.
    pub fn unlocked(&mut self, at: &Configuration<f64>) -> Option<Tangent> {
        let balls = self.mechanism.locked_balls(at).into_iter();
        let balls: Vec<(usize, LockedBall)> = balls
            .filter_map(|ball| {
                let place = self.system.place_of(Unknown::Joint(ball.middle));
                Some((place?, ball))
            })
            .collect();
        if balls.is_empty() || self.system.is_large() {
            return None;
        }
        let here = self.tangent(at.clone());
        let (rows, columns) = (self.system.rows(), self.system.unknowns().len());
        self.system.linearise(at, &mut self.work);
        let mut jacobian = self.system.dense_jacobian(&self.work);
        // the column of z₂ a quarter of a turn on is that of the axis that is missing
        for (place, ball) in &balls {
            let mut beyond = at.clone();
            ball.turn(&mut beyond, std::f64::consts::FRAC_PI_2);
            self.system.linearise(&beyond, &mut self.work);
            let turned = self.system.dense_jacobian(&self.work);
            jacobian.extend(&turned[place * rows..][..rows]);
        }
        let motions = Decomposition::of(rows, columns + balls.len(), &jacobian).null_space();
        let mixed = mixture(&motions)?;
        let mut turned = at.clone();
        for (k, (place, ball)) in balls.iter().enumerate() {
            ball.turn(&mut turned, real::atan2(mixed[columns + k], mixed[*place]));
        }
        let there = self.tangent(turned);
        if there.motions.len() <= here.motions.len() {
            return None;
        }
        let mixed = mixture(&there.motions)?;
        let step: Vec<f64> = mixed.iter().map(|x| x * FINITE_STEP).collect();
        let start = self.system.displaced(&there.at, &step);
        let at = self.solve(&Newton::default(), start)?;
        Some(self.tangent(at))
    }
}
