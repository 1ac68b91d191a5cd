//! What kind of singularity a configuration is.

mod resisted;

use serde::{Deserialize, Serialize};

use crate::linear::{orthonormal, remove};
use crate::mechanism::{Configuration, Mechanism};
use crate::system::{
    Coordinate, Lock, Locked, Mobility, Neighbourhood, Screw, TwistSpace, Unknown,
};

/// The types of D. Zlatanov, R. G. Fenton and B. Benhabib 1994.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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

/// What is singular about a configuration; nothing may be.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Singularity {
    /// The type of C. Gosselin and J. Angeles 1990: 1 inverse, 2 direct, 3 both; `None` if neither
    /// Jacobian loses rank.
    pub gosselin_angeles: Option<u8>,
    /// The types of Zlatanov, Fenton and Benhabib.
    pub zlatanov: Vec<Zlatanov>,
    /// Freedoms gained with the inputs at rest (A. Ghosal).
    pub gain: usize,
    /// Freedoms of the outputs lost (A. Ghosal).
    pub loss: usize,
    /// Infinitesimal freedoms with nothing held, beyond those of configurations nearby.
    pub more_mobility: usize,
    /// What moves while the inputs stand still.
    pub gained: Option<Movement>,
    /// What moves while the outputs stand still.
    pub idle_inputs: Option<Movement>,
    /// What outputs that lost freedoms resist whatever the inputs do, where that is determined.
    pub resisted: Vec<Resisted>,
    /// How far the nearest singularity is.
    pub distances: Distances,
    /// Whether a configuration nearby was found to compare with; if not, what is singular everywhere
    /// cannot be told from what is singular here only.
    pub compared: bool,
}

/// Infinitesimal motions, with other things at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Movement {
    /// How many are independent.
    pub freedoms: usize,
    /// The joints that move, with their rates if there is only one motion: components of a unit
    /// vector, in rad and characteristic lengths.
    pub joints: Vec<Moving>,
    /// The motions of the platforms, or of the links at the closures.
    pub twists: Vec<TwistSpace>,
}

/// A joint that moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moving {
    /// Its name.
    pub joint: String,
    /// How fast; `None` if several motions are independent.
    pub rate: Option<f64>,
}

/// Wrenches that an output takes without help of the inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Resisted {
    /// The output; the platform, where outputs are coordinates of one.
    pub output: String,
    /// As screws: the direction is that of the force, or of the moment where there is no point.
    pub wrenches: Vec<Screw>,
}

/// The smallest singular values of the dimensionless matrices, of those that vanish only at
/// singularities; `None` where nothing can vanish. Lengths are over the normalising length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distances {
    /// Of the closure Jacobian J: zero at constraint singularities.
    pub constraint: Option<f64>,
    /// Of [J; H] with the rates of the inputs: zero where freedoms are gained.
    pub direct: Option<f64>,
    /// Of [J; O] with the rates of the outputs: zero where inputs move without them.
    pub inverse: Option<f64>,
}

impl Singularity {
    /// Whether anything is singular.
    pub fn is_singular(&self) -> bool {
        !self.zlatanov.is_empty()
    }
}

/// Dimensions of what the four matrices map to zero.
#[derive(Clone, Copy, Debug)]
struct Nullities {
    closures: usize,
    direct: usize,
    inverse: usize,
    both: usize,
}

/// Tells singularities of one split into inputs and outputs.
pub(super) struct Classifier<'m> {
    near: Neighbourhood<'m>,
    closures: Locked,
    pub direct: Locked,
    pub inverse: Locked,
    both: Locked,
    /// Rates of the outputs: rows at the end of `inverse`.
    outputs: Vec<Lock>,
    generic: Nullities,
    /// A configuration that is not special.
    beside: Option<Configuration<f64>>,
}

impl<'m> Classifier<'m> {
    /// Compares with configurations beside the one given.
    pub fn new(
        mechanism: &'m Mechanism,
        inputs: &[Coordinate],
        outputs: &[Lock],
        at: &Configuration<f64>,
    ) -> Self {
        let inputs: Vec<Lock> = inputs.iter().copied().map(Lock::Coordinate).collect();
        let all: Vec<Lock> = inputs.iter().chain(outputs).copied().collect();
        let mut classifier = Classifier {
            near: Neighbourhood::new(mechanism),
            closures: Locked::new(mechanism, &[]),
            direct: Locked::new(mechanism, &inputs),
            inverse: Locked::new(mechanism, outputs),
            both: Locked::new(mechanism, &all),
            outputs: outputs.to_vec(),
            generic: Nullities {
                closures: 0,
                direct: 0,
                inverse: 0,
                both: 0,
            },
            beside: Mobility::beside(mechanism, at).map(|mobility| mobility.at().clone()),
        };
        let here = classifier.nullities(at);
        classifier.generic = match classifier.beside.clone() {
            Some(beside) => here.least(classifier.nullities(&beside)),
            None => here,
        };
        classifier
    }

    /// The rank of the direct and the inverse matrix where nothing is special.
    pub fn regular_ranks(&self) -> [usize; 2] {
        let columns = self.direct.columns();
        [self.generic.direct, self.generic.inverse].map(|nullity| columns - nullity)
    }

    /// The idle motions where nothing is special, over the unknowns with nothing held: links turn
    /// about their own lines and nothing else moves.
    pub fn idle(&mut self, at: &Configuration<f64>) -> Vec<Vec<f64>> {
        let at = self.beside.as_ref().unwrap_or(at).clone();
        self.near.tangent(at).idle
    }

    fn nullities(&mut self, at: &Configuration<f64>) -> Nullities {
        let nullity = |locked: &mut Locked| {
            let rank = locked.decomposition(at).rank();
            locked.columns() - rank
        };
        Nullities {
            closures: nullity(&mut self.closures),
            direct: nullity(&mut self.direct),
            inverse: nullity(&mut self.inverse),
            both: nullity(&mut self.both),
        }
    }

    /// What is singular at an assembled configuration.
    pub fn at(&mut self, at: &Configuration<f64>) -> Singularity {
        let generic = self.generic;
        let here = self.nullities(at);
        let more = |here: usize, generic: usize| here.saturating_sub(generic);
        let more_mobility = more(here.closures, generic.closures);
        let gain = more(here.direct, generic.direct);
        let passive = more(here.both, generic.both);
        // ranks of the maps from motions to inputs and to outputs
        let input_rank = |n: Nullities| n.closures - n.direct.min(n.closures);
        let output_rank = |n: Nullities| n.closures - n.inverse.min(n.closures);
        let lost_inputs = more(input_rank(generic), input_rank(here));
        let loss = more(output_rank(generic), output_rank(here));
        let idle = |n: Nullities| n.inverse - n.both.min(n.inverse);
        let idle_inputs = more(idle(here), idle(generic));
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
                let motions = self.direct.decomposition(at).null_space();
                let idle = self.near.tangent(at.clone()).idle;
                self.movement(at, motions, &idle)
            }),
            idle_inputs: (idle_inputs > 0).then(|| {
                let motions = self.inverse.decomposition(at).null_space();
                let passive = self.both.decomposition(at).null_space();
                self.movement(at, motions, &passive)
            }),
            resisted: match loss {
                0 => Vec::new(),
                _ => self.resisted(at),
            },
            distances: self.distances(at),
            compared: self.beside.is_some(),
        }
    }

    /// The smallest singular values that are not zero everywhere.
    pub fn distances(&mut self, at: &Configuration<f64>) -> Distances {
        let generic = self.generic;
        let least = |locked: &mut Locked, nullity: usize| {
            let rank = locked.columns() - nullity;
            let decomposition = locked.decomposition(at);
            let values = decomposition.singular_values();
            let last = rank.checked_sub(1)?;
            Some(values.get(last).copied().unwrap_or(0.0))
        };
        Distances {
            constraint: least(&mut self.closures, generic.closures),
            direct: least(&mut self.direct, generic.direct),
            inverse: least(&mut self.inverse, generic.inverse),
        }
    }

    /// Motions without those that are of no interest.
    fn movement(
        &self,
        at: &Configuration<f64>,
        mut motions: Vec<Vec<f64>>,
        without: &[Vec<f64>],
    ) -> Movement {
        /// Below this a component of a unit motion is rounding.
        const ROUNDING: f64 = 1e-6;
        motions
            .iter_mut()
            .for_each(|motion| remove(motion, without));
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
        let unknowns = self.direct.system().unknowns().iter().enumerate();
        let joints = unknowns.filter_map(|(i, unknown)| {
            let Unknown::Joint(joint) = *unknown else {
                return None;
            };
            let moves = motions.iter().any(|motion| motion[i].abs() > ROUNDING);
            moves.then(|| Moving {
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

impl Nullities {
    fn least(self, other: Nullities) -> Nullities {
        Nullities {
            closures: self.closures.min(other.closures),
            direct: self.direct.min(other.direct),
            inverse: self.inverse.min(other.inverse),
            both: self.both.min(other.both),
        }
    }
}

/// Which matrix loses rank.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// [J; H]: freedoms are gained while the inputs stand still.
    Direct,
    /// [J; O]: inputs move while the outputs stand still.
    Inverse,
}

impl Kind {
    /// Whether a singularity is of this kind, or of both.
    pub(super) fn is_of(self, singularity: &Singularity) -> bool {
        let own = match self {
            Kind::Direct => 2,
            Kind::Inverse => 1,
        };
        matches!(singularity.gosselin_angeles, Some(kind) if kind == own || kind == 3)
    }
}
