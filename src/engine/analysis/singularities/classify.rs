//! Classification of singular configurations.

mod resisted;

use serde::{Deserialize, Serialize};

use crate::linear::{Decomposition, orthonormal, remove, singular_values};
use crate::mechanism::{Configuration, Figure, Mechanism};
use crate::number::tolerance::STILL;
use crate::system::{
    Coordinate, Lock, Locked, Neighbourhood, RegularFreedoms, Screw, TwistSpace, Unknown,
};

/// The types of D. Zlatanov, R. G. Fenton and B. Benhabib 1994.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Zlatanov {
    /// Redundant input: inputs move while the outputs stand still.
    #[serde(rename = "RI")]
    RedundantInput,
    /// Redundant output: outputs move while the inputs stand still.
    #[serde(rename = "RO")]
    RedundantOutput,
    /// Impossible input: some rates of the inputs cannot be.
    #[serde(rename = "II")]
    ImpossibleInput,
    /// Impossible output: some rates of the outputs cannot be.
    #[serde(rename = "IO")]
    ImpossibleOutput,
    /// Increased instantaneous mobility: the closures themselves lose rank.
    #[serde(rename = "IIM")]
    IncreasedMobility,
    /// Redundant passive motion: other joints move while inputs and outputs stand still.
    #[serde(rename = "RPM")]
    PassiveMotion,
}

/// Singularity of a configuration; empty at a regular one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Singularity {
    /// The type of Gosselin and Angeles 1990: 1 inverse, 2 direct, 3 both; `None` if neither.
    pub gosselin_angeles: Option<u8>,
    /// The types of Zlatanov, Fenton and Benhabib.
    pub zlatanov: Vec<Zlatanov>,
    /// Freedoms gained with the inputs at rest (A. Ghosal).
    pub gain: usize,
    /// Freedoms of the outputs lost (A. Ghosal).
    pub loss: usize,
    /// Infinitesimal freedoms with nothing held, beyond those of configurations nearby.
    pub more_mobility: usize,
    /// Motions with the inputs at rest.
    pub gained: Option<Movement>,
    /// Motions with the outputs at rest.
    pub idle_inputs: Option<Movement>,
    /// Wrenches that outputs resist in the freedoms they lost, whatever the inputs do.
    pub resisted: Vec<Resisted>,
    /// Distances from the nearest singularities, as singular values.
    pub distances: Distances,
    /// True if a regular configuration nearby was found; without one a rank lost everywhere looks regular.
    pub compared: bool,
}

/// Infinitesimal motions with the inputs, or the outputs, at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Movement {
    /// Number of independent motions.
    pub freedoms: usize,
    /// The joints that move; rates of a single motion are parts of a unit vector, rad and
    /// characteristic lengths.
    pub joints: Vec<MovingJoint>,
    /// The motions of the platforms, or of the links at the closures.
    pub twists: Vec<TwistSpace>,
}

/// A joint that moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MovingJoint {
    /// Its name.
    pub joint: String,
    /// Rate; `None` if several motions are independent.
    pub rate: Option<f64>,
}

/// Wrenches that an output resists without actuation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Resisted {
    /// The output; the platform, where outputs are coordinates of one.
    pub output: String,
    /// As screws: the direction is that of the force, or of the moment where there is no point.
    pub wrenches: Vec<Screw>,
}

/// The smallest singular values of the dimensionless matrices, of those that vanish only at
/// singularities; `None` where nothing can vanish. Lengths are over the normalising length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Distances {
    /// Smallest singular value of the closure Jacobian J: zero at constraint singularities.
    pub constraint: Option<f64>,
    /// Smallest singular value of [J; H] with the rates of the inputs: zero where freedoms are gained.
    pub direct: Option<f64>,
    /// Smallest singular value of [J; O] with the rates of the outputs: zero where inputs move without them.
    pub inverse: Option<f64>,
}

impl Singularity {
    /// True if the configuration is singular.
    pub fn is_singular(&self) -> bool {
        !self.zlatanov.is_empty()
    }
}

/// The dimensions of the null spaces of the four matrices.
type Nullities = [usize; 4];

/// The matrices by their places: J, [J; H], [J; O] and [J; H; O].
const CLOSURES: usize = 0;
pub(super) const DIRECT: usize = 1;
pub(super) const INVERSE: usize = 2;
const BOTH: usize = 3;

/// Classifies singularities for one choice of inputs and outputs.
pub(crate) struct Classifier<'m> {
    near: Neighbourhood<'m>,
    pub matrices: [Locked; 4],
    /// The outputs, rows at the end of [J; O].
    outputs: Vec<Lock>,
    generic: Nullities,
    /// A configuration nearby that is not singular.
    beside: Option<Configuration<f64>>,
}

impl<'m> Classifier<'m> {
    /// Ranks are compared with those at a regular configuration nearby.
    pub fn new(
        mechanism: &'m Mechanism,
        inputs: &[Coordinate],
        outputs: &[Lock],
        at: &Configuration<f64>,
    ) -> Self {
        let inputs: Vec<Lock> = inputs.iter().copied().map(Lock::Coordinate).collect();
        let both = [&inputs[..], outputs].concat();
        let mut classifier = Classifier {
            near: Neighbourhood::new(mechanism),
            matrices: [&[], &inputs[..], outputs, &both].map(|rows| Locked::new(mechanism, rows)),
            outputs: outputs.to_vec(),
            generic: [0; 4],
            beside: RegularFreedoms::beside(mechanism, at).map(|mobility| mobility.at().clone()),
        };
        let here = classifier.nullities(at);
        classifier.generic = match classifier.beside.clone() {
            Some(beside) => {
                let there = classifier.nullities(&beside);
                std::array::from_fn(|k| here[k].min(there[k]))
            }
            None => here,
        };
        classifier
    }

    /// The unknowns with nothing held: the columns of the matrices.
    pub fn unknowns(&self) -> &[Unknown] {
        self.matrices[CLOSURES].system().unknowns()
    }

    /// The ranks of the direct and the inverse matrix at a regular configuration.
    pub fn regular_ranks(&self) -> [usize; 2] {
        [DIRECT, INVERSE].map(|k| self.unknowns().len() - self.generic[k])
    }

    fn decompositions(&mut self, at: &Configuration<f64>) -> [Decomposition; 4] {
        self.matrices
            .each_mut()
            .map(|matrix| matrix.decomposition(at))
    }

    fn nullities(&mut self, at: &Configuration<f64>) -> Nullities {
        let columns = self.unknowns().len();
        self.decompositions(at).map(|found| columns - found.rank())
    }

    /// Classifies an assembled configuration.
    pub fn at(&mut self, at: &Configuration<f64>) -> Singularity {
        let generic = self.generic;
        let matrices = self.decompositions(at);
        let columns = self.unknowns().len();
        let here: Nullities = matrices.each_ref().map(|found| columns - found.rank());
        let gained = |k: usize| here[k].saturating_sub(generic[k]);
        let (more_mobility, gain, passive) = (gained(CLOSURES), gained(DIRECT), gained(BOTH));
        // ranks of the maps from motions to the rates of inputs or outputs
        let rank = |n: Nullities, k: usize| n[CLOSURES].saturating_sub(n[k]);
        let lost = |k: usize| rank(generic, k).saturating_sub(rank(here, k));
        let (lost_inputs, loss) = (lost(DIRECT), lost(INVERSE));
        let idle = |n: Nullities| n[INVERSE].saturating_sub(n[BOTH]);
        let idle_inputs = idle(here).saturating_sub(idle(generic));
        let types = [
            (Zlatanov::RedundantInput, idle_inputs > 0),
            (Zlatanov::RedundantOutput, gain > passive),
            (Zlatanov::ImpossibleInput, lost_inputs > 0),
            (Zlatanov::ImpossibleOutput, loss > 0),
            (Zlatanov::IncreasedMobility, more_mobility > 0),
            (Zlatanov::PassiveMotion, passive > 0),
        ];
        let inverse = idle_inputs > 0 || loss > 0;
        let direct = gain > 0 || lost_inputs > 0;
        Singularity {
            gosselin_angeles: match (inverse, direct) {
                (true, true) => Some(3),
                (false, true) => Some(2),
                (true, false) => Some(1),
                (false, false) => None,
            },
            zlatanov: (types.into_iter())
                .filter_map(|(kind, is)| is.then_some(kind))
                .collect(),
            gain,
            loss,
            more_mobility,
            gained: (gain > 0).then(|| {
                let idle = self.near.tangent(at.clone()).idle;
                self.movement(at, matrices[DIRECT].null_space(), &idle)
            }),
            idle_inputs: (idle_inputs > 0).then(|| {
                let passive = matrices[BOTH].null_space();
                self.movement(at, matrices[INVERSE].null_space(), &passive)
            }),
            resisted: match loss {
                0 => Vec::new(),
                _ => self.resisted(at),
            },
            distances: self.distances(&matrices),
            compared: self.beside.is_some(),
        }
    }

    /// The distance from singularities of the closures, with the inputs at rest, or with the outputs
    /// at rest.
    pub fn distance(&mut self, of: Figure, at: &Configuration<f64>) -> Option<f64> {
        let matrix = match of {
            Figure::Direct => DIRECT,
            Figure::Inverse => INVERSE,
            _ => CLOSURES,
        };
        let locked = &mut self.matrices[matrix];
        let entries = locked.jacobian(at);
        let values = singular_values(locked.rows(), locked.columns(), &entries);
        self.least(matrix, &values)
    }

    /// The smallest singular values that do not vanish everywhere.
    fn distances(&self, matrices: &[Decomposition; 4]) -> Distances {
        let least = |k: usize| self.least(k, matrices[k].singular_values());
        Distances {
            constraint: least(CLOSURES),
            direct: least(DIRECT),
            inverse: least(INVERSE),
        }
    }

    /// The smallest singular value of a matrix that does not vanish everywhere.
    fn least(&self, matrix: usize, values: &[f64]) -> Option<f64> {
        let last = (self.unknowns().len() - self.generic[matrix]).checked_sub(1)?;
        Some(values.get(last).copied().unwrap_or(0.0))
    }

    /// Motions as a report, less those of a subspace of no interest.
    fn movement(
        &self,
        at: &Configuration<f64>,
        mut motions: Vec<Vec<f64>>,
        without: &[Vec<f64>],
    ) -> Movement {
        (motions.iter_mut()).for_each(|motion| remove(motion, without));
        let mut motions = orthonormal(&motions, 1e-3);
        let mechanism = self.near.mechanism();
        // one sense of two, the same on every machine
        for motion in &mut motions {
            let largest = motion.iter().fold(0.0f64, |m, x| m.max(x.abs()));
            let first = motion.iter().find(|x| x.abs() > 0.5 * largest);
            if first.is_some_and(|x| *x < 0.0) {
                motion.iter_mut().for_each(|x| *x = -*x);
            }
        }
        let unknowns = self.unknowns().iter().enumerate();
        let joints = unknowns.filter_map(|(i, unknown)| {
            let Unknown::Joint(joint) = *unknown else {
                return None;
            };
            let moves = motions.iter().any(|motion| motion[i].abs() > STILL);
            moves.then(|| MovingJoint {
                joint: mechanism.joints()[joint].name.clone(),
                rate: match &motions[..] {
                    [one] => Some(one[i]),
                    _ => None,
                },
            })
        });
        Movement {
            freedoms: motions.len(),
            joints: joints.collect(),
            twists: self.near.twist_spaces(at, &motions, &[]),
        }
    }
}

/// Matrix that loses rank.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// [J; H]: freedoms are gained while the inputs stand still.
    Direct,
    /// [J; O]: inputs move while the outputs stand still.
    Inverse,
}

impl Kind {
    /// True if a singularity is of this kind, or of both.
    pub(super) fn is_of(self, singularity: &Singularity) -> bool {
        let own = match self {
            Kind::Direct => 2,
            Kind::Inverse => 1,
        };
        matches!(singularity.gosselin_angeles, Some(kind) if kind == own || kind == 3)
    }
}
