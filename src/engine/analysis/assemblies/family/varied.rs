//! Dimensions as numbers of their own, whatever expressions of the file they came from.

use rand::SeedableRng;
use rand_pcg::Pcg64;

use super::Family;
use super::coordinates::C;
use crate::geometry::{Axis, Pose, Quaternion, Rotation, Vector3};
use crate::mechanism::Dimensions;
use crate::number::tolerance::ROUNDING;
use crate::number::{Number, complex::norm};
use crate::solve::Equations;
use crate::system::{HeldPlatform, System, Unknown, independent_parts};

/// A dimension with a number among the parameters.
#[derive(Clone, Copy, Debug)]
pub(super) enum VariedDimension {
    /// The lengths of a displacement, by a factor; `small` is what they are of the characteristic length where they are short.
    Lengths { link: usize, small: f64 },
    /// The angle between z before and after a displacement, to which it is added.
    Twist { link: usize },
    /// The length of a rod, by a factor.
    Rod { closure: usize },
}

/// The displacements between joint axes, and from them to frames of closures.
fn links(of: &mut Dimensions<C>) -> impl Iterator<Item = &mut Pose<C>> {
    let chains = of.chains.iter_mut().flat_map(|chain| {
        let rows = chain.rows.iter_mut();
        let rows = rows.flat_map(|row| [&mut row.before, &mut row.after]);
        rows.chain([&mut chain.base, &mut chain.tip])
    });
    chains.chain(of.platforms.iter_mut().flatten())
}

/// The common normal of z before and after a rotation. `None` where they are parallel or perpendicular, and stay so.
fn normal(rotation: &Rotation<C>) -> Option<Vector3<C>> {
    let [x, y, z] = rotation.column(Axis::Z).0;
    let sine = Number::sqrt(x * x + y * y);
    let is_special = norm(sine) <= ROUNDING || norm(z) <= ROUNDING;
    (!is_special).then(|| Vector3([-y / sine, x / sine, C::from_f64(0.0)]))
}

impl VariedDimension {
    /// All that may vary: lengths that are zero stay so, and axes that are parallel or perpendicular.
    fn all(of: &mut Dimensions<C>) -> Vec<VariedDimension> {
        let mut all = Vec::new();
        let length = of.characteristic_length;
        for (link, pose) in links(of).enumerate() {
            let small = pose.position.0.into_iter().map(norm).fold(0.0, f64::max) / length;
            if small > ROUNDING {
                all.push(VariedDimension::Lengths { link, small });
            }
            if normal(&pose.rotation).is_some() {
                all.push(VariedDimension::Twist { link });
            }
        }
        let rods = of.closures.iter().enumerate();
        let rods = rods.filter(|(_, of)| of.length != C::from_f64(0.0));
        all.extend(rods.map(|(closure, _)| VariedDimension::Rod { closure }));
        all
    }

    /// The numbers of the file that it consists of.
    fn value(self, of: &mut Dimensions<C>) -> Vec<C> {
        match self {
            VariedDimension::Rod { closure } => vec![of.closures[closure].length],
            VariedDimension::Lengths { link, .. } => {
                let pose = links(of).nth(link);
                pose.map_or(Vec::new(), |pose| pose.position.0.to_vec())
            }
            VariedDimension::Twist { link } => {
                let axes = links(of).nth(link).map(|pose| pose.rotation.0);
                axes.into_iter().flatten().flat_map(|axis| axis.0).collect()
            }
        }
    }

    /// The number that leaves it as it is.
    fn neutral(self) -> C {
        C::from_f64(if matches!(self, VariedDimension::Twist { .. }) {
            0.0
        } else {
            1.0
        })
    }

    /// Writes it with its number.
    pub fn vary(self, of: &mut Dimensions<C>, number: C) {
        match self {
            VariedDimension::Rod { closure } => of.closures[closure].length *= number,
            VariedDimension::Lengths { link, .. } => {
                let pose = links(of).nth(link);
                pose.into_iter()
                    .for_each(|pose| pose.position = pose.position.times(number));
            }
            VariedDimension::Twist { link } => {
                if let Some(pose) = links(of).nth(link)
                    && let Some(about) = normal(&pose.rotation)
                {
                    let (sin, cos) = (number * 0.5).sin_cos();
                    let [x, y, z] = about.times(sin).0;
                    pose.rotation = Quaternion([cos, x, y, z]).rotation() * pose.rotation;
                }
            }
        }
    }

    /// Range by which its number is varied.
    pub fn spread(self, reach: f64) -> f64 {
        match self {
            VariedDimension::Lengths { small, .. } => 0.4 * reach * (0.5 / small).max(1.0),
            VariedDimension::Rod { .. } => 0.4 * reach,
            // axes that are nearly parallel have solutions far out, which come near where they are not
            VariedDimension::Twist { .. } => 0.5 * reach.sqrt(),
        }
    }
}

impl Family {
    /// For each closure, true if its part of the mechanism has as many equations as unknowns.
    pub(super) fn counted(&self, system: &System<f64>) -> Vec<bool> {
        let closures = self.mechanism.closures();
        if self.is_square {
            return vec![true; closures.len()];
        }
        let unknowns = system.unknowns();
        let parts = independent_parts(&self.mechanism, unknowns);
        let of = closures.iter().map(|closure| {
            let (joints, platforms) = self.mechanism.within_loop(closure);
            let own = |u: &Unknown| match u {
                Unknown::Joint(joint) => joints.contains(joint),
                Unknown::Twist(platform, _) => platforms.contains(platform),
            };
            let first = unknowns.iter().position(own)?;
            parts.iter().position(|part| part[first])
        });
        let of: Vec<Option<usize>> = of.collect();
        let is_free = |u: &usize| match unknowns[*u] {
            Unknown::Twist(platform, _) => self.held.platforms[platform] == HeldPlatform::Free,
            Unknown::Joint(_) => true,
        };
        let is_counted = |part: &usize| {
            let own: Vec<usize> = (0..unknowns.len()).filter(|u| parts[*part][*u]).collect();
            let within = (0..closures.len()).filter(|c| of[*c] == Some(*part));
            let equations = within.flat_map(|c| &self.kept[c][..closures[c].kind.equations()]);
            let count = equations.filter(|varies| **varies).count();
            own.iter().all(is_free) && own.len() == count
        };
        let counted = of.iter().map(|part| part.as_ref().is_some_and(is_counted));
        counted.collect()
    }

    /// Makes dimensions that no parameter changes, or all in a `wide` family, numbers of their own where they are in
    /// `counted` parts only, if these are rigid: with nothing to vary a family has one member, and no loop goes through it.
    /// Independent equations as many as unknowns keep their solutions when anything changes a little; of an
    /// overconstrained mechanism they would be lost.
    pub(super) fn widen(&mut self, counted: &[bool], (is_rigid, wide): (bool, bool)) {
        self.is_free = self.is_square;
        let mut rng = Pcg64::seed_from_u64(1);
        let other = self.random_parameters(&mut rng, 1.0);
        let both = (self.dimensions(&self.parameters), self.dimensions(&other));
        let (Some(mut own), Some(mut other)) = both else {
            return;
        };
        let at = self.random_point(&mut rng, 1.0);
        let at = self.coordinates.placed(&at, &self.home);
        let rest = |system: &System<C>| -> Vec<C> {
            let mut work = system.work();
            system.linearise(&at, &mut work);
            let residual = system.residual_of(&work);
            let rows = system
                .closure_rows()
                .zip(counted)
                .filter(|(_, counted)| !**counted);
            rows.flat_map(|(rows, _)| residual[rows].to_vec()).collect()
        };
        let system = System::new(&own, &self.held);
        let before = rest(&system);
        // where a closure does not depend on a dimension, rounding is left, half way too
        let stays = |of: &Dimensions<C>| {
            let Some((mut half, way)) = system.towards(&System::new(of, &self.held)) else {
                return false;
            };
            half.go(&way, C::from_f64(0.5), &mut half.work());
            let mut pairs = before.iter().zip(rest(&half));
            pairs.all(|(a, b)| norm(a - b) <= ROUNDING)
        };
        self.is_free |= stays(&other);
        if !is_rigid {
            return;
        }
        let mut varied = VariedDimension::all(&mut own);
        varied.retain(|varied| {
            let is_own = wide || matches!(varied, VariedDimension::Rod { .. });
            let mut changed = own.clone();
            varied.vary(&mut changed, C::new(1.5, 0.5));
            (is_own || varied.value(&mut own) == varied.value(&mut other)) && stays(&changed)
        });
        self.parameters
            .extend(varied.iter().map(|varied| varied.neutral()));
        self.varied = varied;
    }
}
