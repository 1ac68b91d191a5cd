//! Special points met by a motion.

use serde::{Deserialize, Serialize};

use super::{At, SweepEnd, SweepReport};
use crate::algebra::SiUnit;
use crate::linear::dot;
use crate::mechanism::{Configuration, Mechanism, NamedPoint, Role};
use crate::number::tolerance::STILL;
use crate::solve::Continuation;
use crate::system::{Coordinate, Curve, Driven, Event, NoStart, Unknown};

/// A special point met by a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Met {
    /// Its kind.
    #[serde(flatten)]
    pub kind: MetKind,
    /// The part of the inputs' segment that was gone; `null` without inputs.
    pub part: Option<f64>,
    /// The inputs there, rad or m, in their order.
    pub inputs: Vec<f64>,
    /// All joints there, rad or m, in the order of the file.
    pub joints: Vec<f64>,
    /// The type of C. Gosselin and J. Angeles 1990 (Singularity analysis of closed-loop kinematic
    /// chains): 1 an output stands still while the inputs move, 2 the inputs stand still while the
    /// mechanism moves, 3 both Jacobians lose rank; `null` for what is no singularity.
    pub singularity: Option<u8>,
}

/// Kind of special point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", tag = "met")]
pub enum MetKind {
    /// A joint turns back: driven, it would lock here.
    Turning {
        /// The joint.
        joint: String,
    },
    /// The inputs turn back: driven, they lock here.
    Fold {
        /// The inputs.
        locked: Vec<String>,
        /// The joint that moves fastest here while they stand still.
        moving: Option<String>,
    },
    /// A joint is at a limit.
    Limit {
        /// The joint.
        joint: String,
        /// The limit, rad or m.
        limit: f64,
        /// rad or m.
        unit: SiUnit,
        /// True for the upper limit.
        upper: bool,
    },
    /// A traced point stands still for an instant: its path has a cusp.
    Cusp {
        /// The point, as it was asked for.
        point: String,
    },
    /// The inputs are at an end of their segment.
    End,
    /// The curve has closed.
    Closed,
    /// Branches meet.
    Crossing {
        /// Number of infinitesimal freedoms.
        freedoms: usize,
        /// The branches that pass.
        branches: Vec<Passing>,
    },
}

/// A branch that passes through a crossing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Passing {
    /// True for the branch that was followed.
    pub followed: bool,
    /// Rate of each joint along it, in the order of the file: components of the unit
    /// tangent, lengths over the characteristic length.
    pub rates: Vec<f64>,
}

/// Keeps special points, up to a number: a motion may be of any length.
pub(super) struct Record<'m> {
    mechanism: &'m Mechanism,
    inputs: Vec<Driven>,
    points: &'m [NamedPoint],
    /// The report of the motion so far.
    pub so_far: SweepReport,
}

/// Special points listed at most.
const MOST: usize = 1000;

impl<'m> Record<'m> {
    pub fn new(mechanism: &'m Mechanism, inputs: &[Driven], points: &'m [NamedPoint]) -> Self {
        Record {
            mechanism,
            inputs: inputs.to_vec(),
            points,
            so_far: SweepReport::of(mechanism, inputs, SweepEnd::Stopped),
        }
    }

    pub fn meet(&mut self, curve: &Curve, place: &At, event: &Event) {
        let mechanism = self.mechanism;
        let name = |joint: usize| mechanism.joints()[joint].name.clone();
        let driven = |joint: usize| {
            let mut inputs = self.inputs.iter();
            inputs.any(|input| input.coordinate == Coordinate::Joint(joint))
        };
        let (kind, singularity) = match event {
            // reported by the fold of the curve
            Event::Turning(joint) if driven(*joint) => return,
            Event::Turning(joint) => {
                let actuated = mechanism.joints()[*joint].role == Role::Actuated;
                let locks = actuated && self.inputs.is_empty();
                let joint = name(*joint);
                (MetKind::Turning { joint }, Some(if locks { 2 } else { 1 }))
            }
            Event::Fold => {
                let locked = self.so_far.inputs.iter().map(|input| input.name.clone());
                let moving = curve.system().unknowns().iter().zip(&place.tangent);
                let moving = moving.filter_map(|(unknown, rate)| match *unknown {
                    Unknown::Joint(joint) => Some((joint, rate.abs())),
                    Unknown::Twist(..) => None,
                });
                let fastest = moving.max_by(|a, b| a.1.total_cmp(&b.1));
                let kind = MetKind::Fold {
                    locked: locked.collect(),
                    moving: fastest
                        .filter(|(_, rate)| *rate > STILL)
                        .map(|(j, _)| name(j)),
                };
                (kind, Some(2))
            }
            Event::Limit {
                joint,
                value,
                upper,
            } => (self.limit(*joint, *value, *upper), None),
            Event::End(_) => (MetKind::End, None),
            Event::Closed => (MetKind::Closed, None),
            Event::Root(number) => {
                let point = self.points[*number].name.clone();
                (MetKind::Cusp { point }, None)
            }
            Event::Branches(point) => {
                let along = |d: &Vec<f64>| dot(d, &place.tangent).abs();
                let most = point.directions.iter().map(along).fold(0.0, f64::max);
                let branches = point.directions.iter().map(|direction| Passing {
                    followed: along(direction) == most,
                    rates: (0..mechanism.joints().len())
                        .map(|joint| curve.column(joint).map_or(0.0, |column| direction[column]))
                        .collect(),
                });
                let kind = MetKind::Crossing {
                    freedoms: point.freedoms,
                    branches: branches.collect(),
                };
                (kind, Some(3))
            }
        };
        let at = &place.at;
        if self.so_far.met.len() >= MOST {
            self.so_far.more_met += 1;
            return;
        }
        let part = (!self.inputs.is_empty()).then(|| curve.part(at));
        let inputs = self
            .inputs
            .iter()
            .map(|input| input.coordinate.of(self.mechanism, at));
        self.so_far.met.push(Met {
            kind,
            part,
            inputs: inputs.collect(),
            joints: at.joints.clone(),
            singularity,
        });
    }

    fn limit(&self, joint: usize, limit: f64, upper: bool) -> MetKind {
        let of = &self.mechanism.joints()[joint];
        MetKind::Limit {
            joint: of.name.clone(),
            limit,
            unit: SiUnit::of_coordinate(of.kind.is_angle()),
            upper,
        }
    }

    pub fn latest(&self) -> Option<&MetKind> {
        self.so_far.met.last().map(|met| &met.kind)
    }

    /// A joint that is outside its limits.
    fn outside(&self, joint: usize, at: &Configuration<f64>) -> Option<Met> {
        let (low, high) = self.mechanism.joints()[joint].limits?;
        let upper = at.joints[joint] > 0.5 * (low + high);
        Some(Met {
            kind: self.limit(joint, if upper { high } else { low }, upper),
            part: (!self.inputs.is_empty()).then_some(0.0),
            inputs: self.inputs.iter().map(|input| input.from).collect(),
            joints: at.joints.clone(),
            singularity: None,
        })
    }

    /// Report of a motion that cannot begin, with the limit exceeded or the branches that cross at its start.
    pub fn no_start(
        mut self,
        curve: &mut Curve,
        start: &Configuration<f64>,
        why: NoStart,
        method: &Continuation,
    ) -> SweepReport {
        match why {
            NoStart::NotClosed => return self.report(SweepEnd::Lost, 0, 0.0),
            NoStart::OutsideLimits(joint) => {
                let outside = self.outside(joint, start);
                self.so_far.met.extend(outside);
                return self.report(SweepEnd::OutsideLimits, 0, 0.0);
            }
            NoStart::Singular => {}
        }
        if let Some(point) = method.branch_point(curve, start, 1e-3) {
            let place = point.place(curve, &vec![0.0; curve.system().unknowns().len()]);
            self.meet(curve, &place, &Event::Branches(Box::new(point)));
            if let Some(MetKind::Crossing { branches, .. }) =
                self.so_far.met.last_mut().map(|m| &mut m.kind)
            {
                branches.iter_mut().for_each(|b| b.followed = false);
            }
        }
        self.report(SweepEnd::SingularStart, 0, 0.0)
    }

    pub fn report(self, ending: SweepEnd, rows: usize, length: f64) -> SweepReport {
        SweepReport {
            ending,
            rows,
            length,
            ..self.so_far
        }
    }
}
