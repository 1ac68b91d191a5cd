//! Solutions found with rods, completed by what the rods stand for.

use std::f64::consts::{FRAC_PI_2, PI};

use rand::SeedableRng;
use rand_pcg::Pcg64;

use super::homotopy::{ParameterHomotopy, START};
use super::path::{End, arrived};
use crate::analysis::assemblies::family::{
    C, Coordinates, Family, LegwiseSolutions, Member, learn, size, spanning_points,
};
use crate::mechanism::Dimensions;
use crate::number::Number;
use crate::solve::{Equations, Homotopy, Newton, Stop};
use crate::system::{System, SystemWork};

/// The equations of every part that a rod stands for, at one member.
#[derive(Clone, Debug)]
pub(crate) struct Lift<'f> {
    whole: ParameterHomotopy<'f>,
    parts: Vec<LiftPart>,
}

#[derive(Clone, Debug)]
struct LiftPart {
    system: System<C>,
    work: SystemWork<C>,
    /// Of its unknowns among those of the whole.
    places: Vec<usize>,
    ways: usize,
}

impl LiftPart {
    /// The angle φ of a single hinge at which its rows, which are a + b cos φ + c sin φ, are least, however far from real it is.
    fn hinge_angle(&mut self, whole: &mut ParameterHomotopy<'_>, x: &[C], place: usize) -> C {
        let mut x = x.to_vec();
        let [at_zero, at_right, at_half] = [0.0, FRAC_PI_2, PI].map(|angle| {
            x[place] = C::from_f64(angle);
            whole.residual(START, &x);
            self.system.residual(&whole.here.at, &mut self.work);
            self.system.residual_of(&self.work).to_vec()
        });
        let half = |sign: f64| -> Vec<C> {
            let pairs = at_zero.iter().zip(&at_half);
            pairs.map(|(x, y)| (x + y * sign) * 0.5).collect()
        };
        let (a, b) = (half(1.0), half(-1.0));
        let c: Vec<C> = at_right.iter().zip(&a).map(|(x, a)| x - a).collect();
        let dot = |x: &[C], y: &[C]| -> C { x.iter().zip(y).map(|(x, y)| x.conj() * y).sum() };
        let (bb, bc, cc) = (dot(&b, &b), dot(&b, &c), dot(&c, &c));
        let (ba, ca) = (dot(&b, &a), dot(&c, &a));
        let size = bb * cc - bc * bc.conj();
        let cos = (bc * ca - cc * ba) / size;
        let sin = (bc.conj() * ba - bb * ca) / size;
        // of exp(iφ) and exp(−iφ) the larger one has all digits
        let i = C::new(0.0, 1.0);
        let [forth, back] = [cos + i * sin, cos - i * sin];
        match forth.norm_sqr() >= back.norm_sqr() {
            true => -i * Number::ln(forth),
            false => i * Number::ln(back),
        }
    }
}

impl<'f> Lift<'f> {
    /// Of a family that has a reduced one; `None` if an expression has no value.
    pub fn new(family: &'f Family, member: &Member) -> Option<Self> {
        let dimensions = family.dimensions(&member.parameters)?;
        let rods = &family.reduced.as_ref()?.rods;
        let parts = rods.iter().zip(family.parts(rods));
        let parts = parts.map(|(rod, (places, held))| {
            let (one, other) = rod.closures();
            let own = [Some(one), other].into_iter().flatten();
            let own = Dimensions {
                closures: own.map(|c| dimensions.closures[c].clone()).collect(),
                ..dimensions.clone()
            };
            let system = System::new(&own, &held);
            LiftPart {
                work: system.work(),
                system,
                places,
                ways: rod.ways(),
            }
        });
        Some(Lift {
            parts: parts.collect(),
            whole: family.homotopy(member, member)?,
        })
    }

    /// The solutions that one of the reduced family stands for; `None` if not every part closes in as many ways as it does in
    /// general.
    pub fn of(&mut self, x: &[C]) -> Option<LegwiseSolutions> {
        const TRIES: u64 = 40;
        let family = self.whole.family;
        let coordinates = &family.coordinates;
        let mut whole = vec![C::from_f64(0.0); coordinates.count()];
        let rest = kept(coordinates, &family.reduced.as_ref()?.coordinates);
        rest.zip(x).for_each(|(place, x)| whole[place] = *x);
        let mut found: Vec<Vec<Vec<C>>> = vec![Vec::new(); self.parts.len()];
        for (part, found) in self.parts.iter_mut().zip(&mut found) {
            if let [place] = part.places[..] {
                found.push(vec![part.hinge_angle(&mut self.whole, &whole, place)]);
                continue;
            }
            for k in 0..TRIES {
                // most ways are near, some far out
                let reach = [1.0, 1.0, 4.0, 16.0, 64.0][k as usize % 5];
                let random = family.random_point(&mut Pcg64::seed_from_u64(k), reach);
                (part.places.iter()).for_each(|&place| whole[place] = random[place]);
                self.whole.residual(START, &whole);
                let mut at = self.whole.here.at.clone();
                let mut trial = at.clone();
                let newton = Newton::default();
                let report = newton.solve(&part.system, &mut at, &mut trial, &mut part.work);
                let ended = coordinates.flatten(&at);
                let near = 1e-8 * (1.0 + size(&ended).powi(2));
                if report.stop == Stop::StepLimit
                    || report.size.largest.is_nan()
                    || report.size.largest > near
                {
                    continue;
                }
                let way: Vec<C> = part.places.iter().map(|place| ended[*place]).collect();
                let is_joint = part.places[0] < coordinates.free_joints.len();
                let is_new = !found.iter().any(|known| match is_joint {
                    true => coordinates.same_way(&part.places, known, &way),
                    false => coordinates.same_pose(known, &way),
                });
                if is_new {
                    found.push(way);
                }
                if found.len() == part.ways {
                    break;
                }
            }
            if found.len() < part.ways {
                return None;
            }
        }
        let mut all = Vec::new();
        for k in 0..self.parts.iter().map(|part| part.ways).max()? {
            for (part, found) in self.parts.iter().zip(&found) {
                let way = &found[k % found.len()];
                part.places
                    .iter()
                    .zip(way)
                    .for_each(|(place, x)| whole[*place] = *x);
            }
            let Some(End::Regular(x)) = arrived(&mut self.whole, &whole) else {
                return None;
            };
            learn(&mut all, coordinates, &x);
        }
        let [one] = all.as_slice() else { return None };
        (one.count() == family.ways()).then(|| one.clone())
    }
}

/// Places among the unknowns of what is unknown with rods too.
fn kept<'a>(all: &'a Coordinates, rest: &'a Coordinates) -> impl Iterator<Item = usize> + 'a {
    let joints = all.free_joints.iter().enumerate();
    let joints = joints
        .filter(|(_, j)| rest.free_joints.contains(j))
        .map(|(place, _)| place);
    let platforms = all.free_platforms.iter().enumerate();
    let platforms = platforms.filter(|(_, p)| rest.free_platforms.contains(p));
    joints.chain(platforms.flat_map(|(k, _)| {
        let first = all.free_joints.len() + 7 * k;
        first..first + 7
    }))
}

/// The solutions of a family with rods for parts.
pub(crate) fn reduced(family: &Family, legwise: &[LegwiseSolutions]) -> Vec<LegwiseSolutions> {
    let mut all = Vec::new();
    if let Some(reduced) = &family.reduced {
        let (whole, rest) = (&family.coordinates, &reduced.coordinates);
        for x in spanning_points(legwise, whole) {
            let x: Vec<C> = kept(whole, rest).map(|place| x[place]).collect();
            learn(&mut all, rest, &x);
        }
    }
    all
}
