//! The family a question belongs to: its dimensions and inputs made complex, and ways between
//! members.

mod bound;
mod coordinates;
mod legwise;
mod rods;
mod varied;

pub(super) use bound::{KnownBound, known_bound};
pub(super) use coordinates::{C, Coordinates, Input, size};
pub(super) use legwise::{LegwiseSolutions, count, learn, points, spanning_points};
pub(super) use rods::Rod;

use rand::Rng;
use rand_pcg::Pcg64;

use crate::geometry::{Quaternion, Vector3};
use crate::mechanism::{ClosureKind, Configuration, Dimensions, EVERY_ROW, Kept, Mechanism};
use crate::number::{Number, real};
use crate::system::{Held, HeldPlatform, RegularFreedoms, System};
use varied::VariedDimension;

/// A member of the family: values of the independent parameters, then numbers of other dimensions, and values of the
/// inputs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Member {
    pub parameters: Vec<C>,
    pub inputs: Vec<C>,
}

/// All members of the family of one question.
#[derive(Clone, Debug)]
pub(crate) struct Family {
    pub mechanism: Mechanism,
    pub coordinates: Coordinates,
    pub held: Held<C>,
    /// Values the mechanism itself has.
    pub parameters: Vec<C>,
    /// Dimensions that no parameter gives, each with a number of its own among the parameters.
    varied: Vec<VariedDimension>,
    /// True if the dimensions make the family: there are no inputs, or they only spin links, which carries no solution
    /// to another.
    pub by_dimensions: bool,
    pub home: Configuration<f64>,
    /// Number of closure equations that do not vanish everywhere.
    pub varying_equations: usize,
    /// True if there are as many of them, with those of held coordinates, as unknowns. Where its solutions are isolated
    /// they are independent, and stay solutions whatever numbers the dimensions become.
    pub is_square: bool,
    /// True if no other equations depend on what may vary, so that dimensions need not keep their relations.
    pub is_free: bool,
    /// The equations with these values, if all expressions have one.
    own: Option<System<C>>,
    /// Rows of closures that are evaluated.
    kept: Vec<Kept>,
    /// Parts that rods stand for; what is in them is not among the unknowns.
    pub rods: Vec<Rod>,
    /// Closures that are left out, one after the other.
    cut: Vec<usize>,
    /// For each closure that is left, false if one of its rows is left out.
    whole: Vec<bool>,
    /// The family with rods in place of parts that are no more, if there are any.
    pub reduced: Option<Box<Family>>,
}

fn uniform(rng: &mut Pcg64) -> f64 {
    2.0 * rng.random::<f64>() - 1.0
}

fn complex(rng: &mut Pcg64) -> C {
    C::new(uniform(rng), uniform(rng))
}

fn quaternion(rng: &mut Pcg64) -> Quaternion<C> {
    let parts: [C; 4] = std::array::from_fn(|_| C::new(uniform(rng), 0.5 * uniform(rng)));
    Quaternion(parts).normalised()
}

impl Family {
    pub fn new(mechanism: &Mechanism, held: &Held<f64>) -> Self {
        Family::made(mechanism, held, false)
    }

    /// The family that dimensions make, each a number of its own, whatever is held: solutions that are multiple for all
    /// inputs are simple there. `None` if there are not as many equations as unknowns.
    pub fn wider(mechanism: &Mechanism, held: &Held<f64>) -> Option<Self> {
        let family = Family::made(mechanism, held, true);
        (family.is_square && !family.varied.is_empty()).then_some(family)
    }

    fn made(mechanism: &Mechanism, held: &Held<f64>, wide: bool) -> Self {
        let independent = mechanism.independent_parameters();
        let value = |i: usize| C::from_f64(mechanism.parameters()[i].value);
        let mut family = Family {
            coordinates: Coordinates::new(mechanism, held),
            held: held.map(C::from_f64),
            parameters: independent.into_iter().map(value).collect(),
            varied: Vec::new(),
            is_free: false,
            by_dimensions: false,
            home: mechanism.home(),
            varying_equations: mechanism.equations_that_vary(),
            is_square: false,
            mechanism: mechanism.clone(),
            own: None,
            kept: mechanism.rows_that_vary().to_vec(),
            rods: Vec::new(),
            cut: Vec::new(),
            whole: vec![true; mechanism.closures().len()],
            reduced: None,
        };
        let system = System::new(mechanism.dimensions(), held);
        let equations = family.varying_equations + system.hold_rows().len();
        family.is_square = system.unknowns().len() == equations;
        let counted = family.counted(&system);
        let is_rigid = || match RegularFreedoms::near(mechanism, &family.home) {
            Some(near) => near.count() == 0,
            None => family.is_isolated(),
        };
        let is_rigid = wide || counted.contains(&true) && is_rigid();
        family.by_dimensions = is_rigid || family.coordinates.inputs.is_empty();
        family.widen(&counted, (is_rigid, wide));
        if !family.is_square {
            family.kept.fill(EVERY_ROW);
        }
        family.own = family.system(&family.parameters);
        family.reduced = family.with_rods().map(Box::new);
        family
    }

    /// The family with rods in place of all parts that are no more.
    fn with_rods(&self) -> Option<Self> {
        let own = self.dimensions(&self.parameters)?;
        let rods = Rod::all(&own, &self.held, self.mechanism.rows_that_vary());
        let mut family = Family {
            held: Rod::held(&rods, self.held.clone()),
            varying_equations: self.varying_equations
                - rods.iter().map(Rod::equations).sum::<usize>(),
            kept: Rod::replaced(&rods, self.kept.clone(), vec![EVERY_ROW; rods.len()]),
            own: None,
            rods,
            ..self.clone()
        };
        family.whole = vec![true; family.kept.len()];
        family.own = family.system(&self.parameters);
        let system = family.own.as_ref().filter(|_| !family.rods.is_empty())?;
        family.coordinates = self.coordinates.without(&family.held, system);
        Some(family)
    }

    /// The family without a row of a closure and with a joint held, which is given last among the inputs. A closure of
    /// which no row is left goes.
    pub fn without(&self, (closure, row): (usize, usize), joint: usize) -> Option<Self> {
        let mut family = Family {
            varying_equations: self.varying_equations - 1,
            own: None,
            reduced: None,
            ..self.clone()
        };
        family.held.joints[joint] = true;
        family.kept[closure][row] = false;
        family.whole[closure] = false;
        if self.own.as_ref()?.closure_rows().nth(closure)?.len() == 1 {
            family.cut.push(closure);
            family.kept.remove(closure);
            family.whole.remove(closure);
        }
        family.own = family.system(&self.parameters);
        family.coordinates = self.coordinates.without(&family.held, family.own.as_ref()?);
        family.coordinates.inputs.push(Input::Joint(joint));
        Some(family)
    }

    /// Rows that may be left out, each as a row of a closure and of all, those of the shortest closures first: of rods of
    /// fixed length, and if they are asked for of pins and balls where they join points.
    pub fn rows(&self, of_points: bool) -> Vec<((usize, usize), usize)> {
        let dimensions = self.dimensions(&self.parameters);
        let (Some(dimensions), Some(system)) = (dimensions, &self.own) else {
            return Vec::new();
        };
        let closures = dimensions.closures.iter().zip(system.closure_rows());
        let mut closures: Vec<_> = closures.enumerate().collect();
        closures.sort_by_key(|(_, (_, rows))| rows.len());
        let rows = closures.into_iter().flat_map(|(closure, (of, rows))| {
            let joins = matches!(of.kind, ClosureKind::Revolute | ClosureKind::Spherical);
            let most = match of.kind.has_length() {
                true => usize::from(of.extension.0.is_empty()),
                false => 3 * usize::from(joins && of_points),
            };
            let kept = (0..of.kind.equations()).filter(move |row| self.kept[closure][*row]);
            let own = kept.zip(rows).filter(move |(row, _)| *row < most);
            own.map(move |(row, of_all)| ((closure, row), of_all))
        });
        rows.collect()
    }

    /// True if no single row of a closure is left out.
    pub fn is_whole(&self) -> bool {
        !self.whole.contains(&false)
    }

    /// The equations of members with these parameters. `None` if an expression has no value.
    pub fn system(&self, parameters: &[C]) -> Option<System<C>> {
        match &self.own {
            Some(own) if parameters == self.parameters => Some(own.clone()),
            _ => {
                let dimensions = self.dimensions(parameters)?;
                Some(System::keeping(&dimensions, &self.held, &self.kept, &[]))
            }
        }
    }

    /// Random complex parameters about the mechanism's own. Those that are zero move too. `reach` says how far out
    /// lengths go, as for inputs.
    pub fn random_parameters(&self, rng: &mut Pcg64, reach: f64) -> Vec<C> {
        let typical = self.coordinates.length;
        let (named, own) = self
            .parameters
            .split_at(self.parameters.len() - self.varied.len());
        let named = named.iter().map(|p| match p.re {
            0.0 => 0.2 * typical,
            value => 0.4 * value.abs(),
        });
        let own = own
            .iter()
            .zip(&self.varied)
            .map(|(_, varied)| varied.spread(reach));
        let sizes: Vec<f64> = named.chain(own).collect();
        let all = self.parameters.iter().zip(sizes);
        all.map(|(p, size)| *p + complex(rng) * size).collect()
    }

    /// Random complex inputs: angles anywhere, lengths about those at home. `reach` says how far
    /// out: 1 for the neighbourhood of home.
    pub fn random_inputs(&self, rng: &mut Pcg64, reach: f64) -> Vec<C> {
        let c = &self.coordinates;
        let about = |length: f64, rng: &mut Pcg64| {
            let size = 0.5 * reach * length.abs().max(0.3 * c.length);
            C::from_f64(length) + complex(rng) * size
        };
        let angle = |rng: &mut Pcg64| {
            C::new(
                std::f64::consts::PI * uniform(rng),
                0.7 * reach.sqrt() * uniform(rng),
            )
        };
        let mut inputs = Vec::with_capacity(c.input_count());
        for &input in &c.inputs {
            match input {
                Input::Joint(j) => inputs.push(match self.mechanism.joints()[j].kind.is_angle() {
                    true => angle(rng),
                    false => about(self.home.joints[j], rng),
                }),
                Input::Pose(p) => {
                    inputs.extend(quaternion(rng).0);
                    inputs.extend(self.home.platforms[p].position.0.map(|x| about(x, rng)));
                }
                Input::Target(p, coordinate) => inputs.push(match coordinate.is_angle() {
                    true => angle(rng),
                    false => about(coordinate.of(&self.home.platforms[p].pose()), rng),
                }),
                Input::Orientation(_) => inputs.extend(quaternion(rng).0),
            }
        }
        inputs
    }

    /// A member whose solutions stand for those of all members, but special ones.
    pub fn generic_member(&self, rng: &mut Pcg64) -> Member {
        let inputs = self.random_inputs(rng, 1.0);
        let parameters = match self.by_dimensions {
            true => self.random_parameters(rng, 1.0),
            false => self.parameters.clone(),
        };
        Member { parameters, inputs }
    }

    /// True if the family has more than one member.
    pub fn varies(&self) -> bool {
        !(self.parameters.is_empty() && self.coordinates.inputs.is_empty())
    }

    /// For each flat input, true if it is a length.
    pub fn lengths_among_inputs(&self) -> Vec<bool> {
        let lengths = self.coordinates.inputs.iter().map(|input| match *input {
            Input::Joint(j) => vec![!self.mechanism.joints()[j].kind.is_angle()],
            Input::Pose(_) => [[false; 4].as_slice(), &[true; 3]].concat(),
            Input::Target(_, coordinate) => vec![!coordinate.is_angle()],
            Input::Orientation(_) => vec![false; 4],
        });
        lengths.flatten().collect()
    }

    /// Number of turns after which an angle repeats, if it does; `None` for a joint that is no angle.
    pub fn turns(&self, joint: usize) -> Option<Option<f64>> {
        let is_angle = self.mechanism.joints()[joint].kind.is_angle();
        is_angle.then(|| self.coordinates.turns[joint])
    }

    /// A random complex point, far from assembled. `reach` says how far out, as for inputs: complex
    /// rotations grow as the exponential of their imaginary angle, and positions with them.
    pub fn random_point(&self, rng: &mut Pcg64, reach: f64) -> Vec<C> {
        let c = &self.coordinates;
        let mut x = Vec::with_capacity(c.count());
        for &j in &c.free_joints {
            x.push(match self.mechanism.joints()[j].kind.is_angle() {
                true => C::new(
                    std::f64::consts::PI * c.turns[j].unwrap_or(1.0) * uniform(rng),
                    0.8 * reach.sqrt() * uniform(rng),
                ),
                false => {
                    complex(rng)
                        * (2.0 * reach * (self.home.joints[j] / c.joint_scales[j]).abs().max(0.5))
                }
            });
        }
        for &p in &c.free_platforms {
            let far = Vector3([0, 1, 2].map(|_| C::new(0.0, real::log2(reach) * uniform(rng))));
            x.extend(quaternion(rng).turned_by(&far).0);
            let home = self.home.platforms[p]
                .position
                .0
                .map(|x| C::from_f64(x / c.length));
            x.extend(home.map(|x| x + complex(rng) * reach));
        }
        x
    }

    /// A random point up to about `distance` away from another one in every coordinate.
    pub fn shaken(&self, x: &[C], distance: f64, rng: &mut Pcg64) -> Vec<C> {
        let mut x: Vec<C> = x.iter().map(|x| x + complex(rng) * distance).collect();
        self.coordinates.settle(&mut x);
        x
    }

    /// Number of ways in which the parts that rods stand for close together.
    pub fn ways(&self) -> usize {
        let rods = self.reduced.iter().flat_map(|reduced| &reduced.rods);
        rods.map(Rod::ways).product()
    }

    /// The places of the parts that rods stand for among the flat unknowns, with held coordinates with only them free.
    pub fn parts(&self, rods: &[Rod]) -> Vec<(Vec<usize>, Held<C>)> {
        let c = &self.coordinates;
        let place = |all: &[usize], one: usize| all.iter().position(|x| *x == one);
        let parts = rods.iter().filter_map(|rod| match rod {
            Rod::Hinged { joints, .. } => {
                let places = joints.iter().map(|j| place(&c.free_joints, *j));
                let places: Vec<usize> = places.collect::<Option<_>>()?;
                let held = self.held_but(&places);
                Some((places, held))
            }
            Rod::Body { platform, .. } => {
                let first = c.free_joints.len() + 7 * place(&c.free_platforms, *platform)?;
                let mut held = self.held_but(&[]);
                held.platforms[*platform] = self.held.platforms[*platform].clone();
                Some(((first..first + 7).collect(), held))
            }
        });
        parts.collect()
    }

    /// Held coordinates with only the joints at these places of the unknowns free.
    pub fn held_but(&self, places: &[usize]) -> Held<C> {
        let mut joints = vec![true; self.held.joints.len()];
        for &place in places {
            joints[self.coordinates.free_joints[place]] = false;
        }
        Held {
            joints,
            platforms: vec![HeldPlatform::Pose; self.held.platforms.len()],
        }
    }

    pub fn dimensions(&self, parameters: &[C]) -> Option<Dimensions<C>> {
        let (parameters, own) = parameters.split_at(parameters.len() - self.varied.len());
        let values = self.mechanism.parameters_from(parameters).ok()?;
        let mut dimensions = self.mechanism.dimensions_over(&values).ok()?;
        for (varied, number) in self.varied.iter().zip(own) {
            varied.vary(&mut dimensions, *number);
        }
        // rows and unknowns keep their scale on the way from member to member
        dimensions.characteristic_length = self.coordinates.length;
        dimensions
            .joint_scales
            .clone_from(&self.coordinates.joint_scales);
        if !self.rods.is_empty() {
            dimensions = Rod::standing(&self.rods, &dimensions)?;
        }
        for closure in &self.cut {
            dimensions.closures.remove(*closure);
        }
        Some(dimensions)
    }
}
