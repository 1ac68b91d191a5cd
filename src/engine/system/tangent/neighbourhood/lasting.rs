//! Distinguishing local freedoms from those that are local at one configuration only.

use super::{Neighbourhood, Tangent};
use crate::linear::{complement, dot, orthonormal};
use crate::mechanism::Configuration;
use crate::solve::Newton;
use crate::system::tangent::shake::shaken;

/// Motions at a configuration, divided into those that stay local beside it and those that do not.
#[derive(Clone, Debug)]
pub struct Lasting {
    /// The motions; only those that stay local count as idle.
    pub tangent: Tangent,
    /// Motions that are local at this configuration only.
    pub locked: Vec<Vec<f64>>,
    /// Orthonormal basis of the local freedoms at a configuration beside it.
    pub idle_beside: Vec<Vec<f64>>,
    /// The motions out of gimbal lock, where only there fewer are local.
    pub unlocked: Option<Tangent>,
}

impl Neighbourhood<'_> {
    /// The motions at one of the configurations beside another in directions without symmetry, k > 0.
    pub fn beside(&mut self, at: &Configuration<f64>, k: u8) -> Option<Tangent> {
        let start = shaken(self.mechanism(), at, k);
        let at = self.solve(&Newton::default(), start)?;
        Some(self.tangent(at))
    }
}

impl Tangent {
    /// Counts as local only as many freedoms as the configurations beside this one have at least; the others are listed
    /// apart. In gimbal lock, for example, two of three joints turn against each other and move nothing, but beside it
    /// the freedom moves links.
    pub fn lasting(self, near: &mut Neighbourhood) -> Lasting {
        let unlocked = |tangent: Tangent| Lasting {
            idle_beside: tangent.idle.clone(),
            locked: Vec::new(),
            unlocked: None,
            tangent,
        };
        if self.idle.is_empty() {
            return unlocked(self);
        }
        let beside = (1..4).filter_map(|k| Some(near.beside(&self.at, k)?.idle));
        let mut idle_beside = beside.min_by_key(Vec::len).unwrap_or(self.idle.clone());
        let out = match idle_beside.is_empty() {
            true => None,
            false => near.unlocked(&self.at),
        };
        let out = out.filter(|out| out.idle.len() < idle_beside.len());
        if let Some(out) = &out {
            idle_beside.clone_from(&out.idle);
        }
        if idle_beside.len() >= self.idle.len() {
            return unlocked(self);
        }
        // the directions among the idle ones that are nearest to those that last
        let count = self.idle.len();
        let weights = idle_beside.iter().map(|direction| {
            let shares = self.idle.iter().map(|idle| dot(idle, direction));
            shares.collect()
        });
        // smaller parts of a unit vector do not distinguish directions
        let kept = orthonormal(&weights.collect::<Vec<Vec<f64>>>(), 1e-3);
        let combined = |weights: &Vec<f64>| -> Vec<f64> {
            let along = |i: usize| self.idle.iter().zip(weights).map(|(m, w)| m[i] * w).sum();
            (0..self.columns()).map(along).collect()
        };
        let locked: Vec<Vec<f64>> = complement(&kept, count).iter().map(combined).collect();
        let idle = kept.iter().map(combined).collect();
        let motions = self.motions.iter().chain(&locked).cloned().collect();
        Lasting {
            tangent: Tangent {
                idle,
                motions,
                ..self
            },
            locked,
            idle_beside,
            unlocked: out,
        }
    }
}
