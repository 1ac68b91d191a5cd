//! Infinitesimal freedoms and mobility.

use std::collections::BTreeMap;

use super::neighbourhood::Neighbourhood;
use super::shake::shaken;
use crate::geometry::RollPitchYaw;
use crate::linear::{INDEPENDENT, Svd, norm, remove};
use crate::mechanism::{Configuration, Dimensions, Mechanism, PoseCoordinate};
use crate::number::sorting::sort_by;
use crate::number::tolerance::STILL;
use crate::solve::{Equations, Newton};
use crate::system::{Coordinate, Held, Places, System, SystemWork, Unknown};

/// The infinitesimal motions of a mechanism at a configuration, with some coordinates held.
#[derive(Clone, Debug)]
pub struct Freedoms {
    /// The unknowns, in the order of the motions' components.
    pub unknowns: Vec<Unknown>,
    /// Orthonormal basis of the motions, dimensionless: rad and characteristic lengths.
    pub motions: Vec<Vec<f64>>,
    /// Singular values of the Jacobian, largest first; of a large one the largest and the smallest that counts.
    singular_values: Vec<f64>,
}

impl Freedoms {
    /// The motions that closures and held coordinates leave at a configuration.
    pub fn at(dimensions: &Dimensions<f64>, held: &Held<f64>, at: &Configuration<f64>) -> Self {
        let system = System::new(dimensions, held);
        Freedoms::of(&system, at, &mut system.work())
    }

    /// As [`Freedoms::at`], with equations and storage at hand.
    pub fn of(system: &System<f64>, at: &Configuration<f64>, work: &mut SystemWork<f64>) -> Self {
        system.linearise(at, work);
        let unknowns = system.unknowns().to_vec();
        let (motions, singular_values) = match system.is_large() {
            true => {
                let decomposition = system.decomposition(work);
                let values = decomposition.singular_values().to_vec();
                (decomposition.null_space(), values)
            }
            false => {
                let jacobian = system.dense_jacobian(work);
                let svd = Svd::of(system.rows(), unknowns.len(), &jacobian);
                (svd.null_space().to_vec(), svd.values)
            }
        };
        Freedoms {
            unknowns,
            motions,
            singular_values,
        }
    }

    /// The numerical rank of the Jacobian.
    pub fn rank(&self) -> usize {
        self.unknowns.len() - self.motions.len()
    }

    /// Condition number; infinite where unknowns are not determined.
    pub fn condition(&self) -> f64 {
        match self.motions.is_empty() {
            true => self.condition_of_determined(),
            false => f64::INFINITY,
        }
    }

    /// Condition number over the determined unknowns: largest singular value over the smallest that counts.
    pub fn condition_of_determined(&self) -> f64 {
        let counted = self.rank().min(self.singular_values.len());
        match self.singular_values[..counted] {
            [] => 1.0,
            [largest, .., smallest] => largest / smallest,
            [_] => 1.0,
        }
    }

    /// The rate of an unknown in each motion, weighted; zero for one that is held.
    fn rates(&self, places: &Places, unknown: Unknown, weights: &[f64]) -> Vec<f64> {
        let place = places.of(unknown);
        let rate = |motion: &Vec<f64>| {
            let rates = place.into_iter().flat_map(|place| &motion[place..]);
            rates.zip(weights).map(|(rate, weight)| weight * rate).sum()
        };
        self.motions.iter().map(rate).collect()
    }

    /// The joints and platforms that take part in the free motions, the most mobile first.
    pub fn moving(&self, mechanism: &Mechanism) -> Vec<String> {
        moving(mechanism, &self.unknowns, &self.motions)
    }

    /// True if all motions are local freedoms: links turn about their own axes, and no point moves.
    pub fn are_local(&self, mechanism: &Mechanism, at: &Configuration<f64>) -> bool {
        if self.motions.is_empty() {
            return true;
        }
        let near = Neighbourhood::new(mechanism);
        let own = near.system().unknowns().iter();
        let all = Places::new(&self.unknowns);
        let places: Vec<Option<usize>> = own.map(|unknown| all.of(*unknown)).collect();
        let whole = |motion: &Vec<f64>| {
            let parts = places.iter().map(|place| place.map_or(0.0, |i| motion[i]));
            parts.collect()
        };
        near.are_local(at, &self.motions.iter().map(whole).collect::<Vec<_>>())
    }
}

/// The joints and platforms that take part in motions, the most mobile first.
pub fn moving(mechanism: &Mechanism, unknowns: &[Unknown], motions: &[Vec<f64>]) -> Vec<String> {
    let mut sums: BTreeMap<&str, f64> = BTreeMap::new();
    for (i, unknown) in unknowns.iter().enumerate() {
        let share: f64 = motions.iter().map(|motion| motion[i] * motion[i]).sum();
        *sums.entry(unknown.owner(mechanism)).or_default() += share;
    }
    let shares = sums
        .into_iter()
        .map(|(name, share)| (name.to_owned(), share));
    let mut shares: Vec<(String, f64)> = shares.collect();
    shares.retain(|(_, share)| *share > STILL);
    // those that move alike but for rounding stand by name
    let rank = |share: f64| (share * 1e6).round();
    sort_by(&mut shares, |a, b| {
        (rank(b.1).total_cmp(&rank(a.1))).then_with(|| a.0.cmp(&b.0))
    });
    shares.into_iter().map(|(name, _)| name).collect()
}

/// The freedoms of a mechanism with nothing held, at a regular assembled configuration.
#[derive(Clone, Debug)]
pub struct RegularFreedoms {
    freedoms: Freedoms,
    at: Configuration<f64>,
    idle: usize,
}

impl RegularFreedoms {
    /// Mobility at the nearest assembled configuration if all its motions are finite and none is local; otherwise at that near
    /// the start with the fewest freedoms, and of these the fewest local ones, so that those of a special configuration, as in
    /// gimbal lock, do not count. `None` if none is found.
    pub fn near(mechanism: &Mechanism, start: &Configuration<f64>) -> Option<Self> {
        RegularFreedoms::among(mechanism, start, 0..4)
    }

    /// As [`RegularFreedoms::near`], without the start itself, which may be singular.
    pub fn beside(mechanism: &Mechanism, start: &Configuration<f64>) -> Option<Self> {
        RegularFreedoms::among(mechanism, start, 1..4)
    }

    fn among(
        mechanism: &Mechanism,
        start: &Configuration<f64>,
        shakes: std::ops::Range<u8>,
    ) -> Option<Self> {
        let mut near = Neighbourhood::new(mechanism);
        let columns = near.system().unknowns().len();
        let fewest = columns.saturating_sub(mechanism.equations_that_vary());
        let mut work = near.system().work();
        let mut found: Vec<(Freedoms, Configuration<f64>)> = Vec::new();
        // the start itself, three points nearby in directions without symmetry, and one where no ball is in gimbal lock
        for k in shakes.map(Some).chain([None]) {
            let at = match k {
                Some(k) => near.solve(&Newton::default(), shaken(mechanism, start, k)),
                None => near.unlocked(start).map(|tangent| tangent.at),
            };
            let Some(at) = at else { continue };
            let freedoms = Freedoms::of(near.system(), &at, &mut work);
            // no other configuration has fewer
            let least =
                freedoms.motions.len() == fewest && near.tangent(at.clone()).idle.is_empty();
            let first = found.is_empty();
            found.push((freedoms, at));
            if least && first {
                return found.pop().map(RegularFreedoms::without_local);
            } else if least {
                break;
            }
        }
        let fewest = found.iter().map(|(f, _)| f.motions.len()).min()?;
        if found[0].0.motions.len() > fewest {
            // where every motion is finite and moves some point, what has fewer is another assembly, not this one made general
            let tangent = near.tangent(found[0].1.clone());
            if tangent.idle.is_empty() && near.is_mobile(&tangent) {
                return Some(RegularFreedoms::without_local(found.swap_remove(0)));
            }
        }
        let mut best: Option<(Freedoms, Configuration<f64>, usize)> = None;
        for (freedoms, at) in found.into_iter().filter(|(f, _)| f.motions.len() == fewest) {
            let idle = near.tangent(at.clone()).idle.len();
            if best.as_ref().is_none_or(|(_, _, least)| idle < *least) {
                best = Some((freedoms, at, idle));
            }
            if idle == 0 {
                break;
            }
        }
        let (freedoms, at, idle) = best?;
        Some(RegularFreedoms { freedoms, at, idle })
    }

    fn without_local((freedoms, at): (Freedoms, Configuration<f64>)) -> Self {
        RegularFreedoms {
            freedoms,
            at,
            idle: 0,
        }
    }

    /// The configuration whose freedoms they are.
    pub fn at(&self) -> &Configuration<f64> {
        &self.at
    }

    /// The number of freedoms without local ones.
    pub fn count(&self) -> usize {
        self.freedoms.motions.len() - self.idle.min(self.freedoms.motions.len())
    }

    /// True if the freedoms are finite, tried along one motion that mixes them; false for a shaky structure.
    pub fn is_finite(&self, mechanism: &Mechanism) -> bool {
        let mut near = Neighbourhood::new(mechanism);
        let tangent = near.tangent(self.at.clone());
        near.is_mobile(&tangent)
    }

    /// The number of local freedoms.
    pub fn idle(&self) -> usize {
        self.idle
    }

    /// The first of the candidates that are independent, as many as there are freedoms at most: they leave no choice.
    pub fn independent(&self, mechanism: &Mechanism, candidates: &[Coordinate]) -> Vec<Coordinate> {
        let mut chosen = Vec::new();
        let mut basis: Vec<Vec<f64>> = Vec::new();
        let places = Places::new(&self.freedoms.unknowns);
        for &candidate in candidates {
            if chosen.len() == self.count() {
                break;
            }
            let mut row = self.rates(mechanism, &places, candidate);
            let size = norm(&row);
            remove(&mut row, &basis);
            let left = norm(&row);
            if left > INDEPENDENT && left > INDEPENDENT * size {
                row.iter_mut().for_each(|a| *a /= left);
                basis.push(row);
                chosen.push(candidate);
            }
        }
        chosen
    }

    /// Rate of a coordinate along each freedom.
    fn rates(&self, mechanism: &Mechanism, places: &Places, candidate: Coordinate) -> Vec<f64> {
        match candidate {
            Coordinate::Joint(joint) => self.freedoms.rates(places, Unknown::Joint(joint), &[1.0]),
            Coordinate::Pose(platform, _) | Coordinate::Turn(platform, _) => {
                let pose = self.at.platforms[platform].pose();
                let slope = match candidate {
                    // roll and yaw turn about one line there: only whole orientations are held, by any three angles
                    Coordinate::Pose(_, c)
                        if c.is_angle() && RollPitchYaw::is_locked(&pose.rotation) =>
                    {
                        let axis = c as usize - PoseCoordinate::Roll as usize;
                        std::array::from_fn(|i| f64::from(u8::from(i == axis)))
                    }
                    _ => candidate.slope(&pose, mechanism.characteristic_length()),
                };
                (self.freedoms).rates(places, Unknown::first_twist(platform), &slope)
            }
        }
    }
}
