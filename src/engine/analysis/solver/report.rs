use serde::{Deserialize, Serialize};

use crate::algebra::{Operation, OperationIndex, Pivot, SiUnit};
use crate::system::is_origin;

/// A component of the input or the state array.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Component {
    /// The joint, `top.x` for a coordinate of a platform, `top.qw` for a component of its unit quaternion.
    pub name: String,
    /// The unit of its values.
    pub unit: SiUnit,
    /// Its value at the assembled configuration from which the order of elimination was chosen.
    pub value: f64,
    /// The limits of a joint.
    #[serde(default)]
    pub limits: Option<(f64, f64)>,
}

/// The pose and the twists of a frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrameProgram {
    /// Its name.
    pub name: String,
    /// Places of the axes x, y, z and the origin in ground, three components each.
    pub pose: Vec<OperationIndex>,
    /// For each input the places of (v, ω) for a unit rate of it; v is the velocity of the origin.
    pub twists: Vec<Vec<OperationIndex>>,
}

/// The force or moment at an input.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ForceComponent {
    /// N or N·m.
    pub unit: SiUnit,
    /// Its place.
    pub place: OperationIndex,
}

/// Inverse dynamics: the forces that drive the inputs. Their further inputs are numbered after those of a step: rates of the
/// inputs, accelerations of the inputs, the time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ForceProgram {
    /// For each input the force or moment along it.
    pub forces: Vec<ForceComponent>,
    /// Places of numbers, each with true if it must be negative: elsewhere the configuration is singular.
    pub decisions: Vec<(OperationIndex, bool)>,
}

/// A divisor, with its reciprocal and its natural size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Divisor {
    /// Its place.
    pub place: OperationIndex,
    /// The place of its reciprocal.
    pub inverse: OperationIndex,
    /// Its natural size: the divisor is small if it is small relative to this.
    pub scale: f64,
}

impl Divisor {
    /// A pivot, unless it is constant.
    pub(super) fn of(pivot: &Pivot) -> Option<Self> {
        let varies = pivot.number.constant().is_none();
        varies.then(|| Divisor {
            place: pivot.number.unsigned().place(),
            inverse: pivot.inverse.unsigned().place(),
            scale: pivot.scale,
        })
    }
}

/// A number whose square root is taken.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Radicand {
    /// Its place.
    pub place: OperationIndex,
    /// The place of the number relative to which it is small.
    pub size: OperationIndex,
}

/// The state in closed form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClosedProgram {
    /// The places of the state.
    pub state: Vec<OperationIndex>,
    /// The places of the signs by which the nearest solution is chosen, in their order.
    pub signs: Vec<OperationIndex>,
    /// Numbers that must not be negative.
    pub radicands: Vec<Radicand>,
    /// Divisors, each with the size below which it is zero.
    pub divisors: Vec<(OperationIndex, f64)>,
}

/// A solver as a straight-line program. Its inputs are numbered: the held coordinates, then the state, then a step of
/// the unknowns.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Solver {
    /// Name of the mechanism.
    pub mechanism: String,
    /// The held coordinates.
    pub inputs: Vec<Component>,
    /// The numbers that define a configuration.
    pub state: Vec<Component>,
    /// The place in ground, in m, from which positions of platforms in the state are measured.
    #[serde(default, skip_serializing_if = "is_origin")]
    pub centre: [f64; 3],
    /// Number of unknowns of a step: one for each free joint, six for each free platform.
    pub unknowns: usize,
    /// All operations; operands stand before what uses them.
    pub operations: Vec<Operation>,
    /// Places of the closure rows r that do not vanish identically, dimensionless.
    pub residual: Vec<OperationIndex>,
    /// Places of the entries of their Jacobian J, row by row.
    pub jacobian: Vec<Vec<OperationIndex>>,
    /// Places of the rows that Newton's method brings to zero: the closure rows, or distances between the points where a
    /// platform stands on three balls, which hold if those do; with the factors by which no closure row is larger.
    pub iterated: Vec<(OperationIndex, f64)>,
    /// Places of the entries of their Jacobian by the unknowns that are iterated, row by row.
    pub slopes: Vec<Vec<OperationIndex>>,
    /// The rate at which that changes for a unit change of inputs and state, weighted so that they are dimensionless.
    pub curvature: f64,
    /// The weights of the inputs, then of the state; 0 where it does not depend on them.
    pub weights: Vec<f64>,
    /// Pivots of the step.
    pub pivots: Vec<Divisor>,
    /// The unknowns that are iterated, with the places of their components of the step −J⁻¹ r, dimensionless.
    pub step: Vec<(usize, OperationIndex)>,
    /// Places of the state moved by a step.
    pub moved: Vec<OperationIndex>,
    /// Components of the state that follow from the others, with their places.
    pub placed: Vec<(usize, OperationIndex)>,
    /// The state in closed form, if it has one: for where the iteration fails, and without a start.
    #[serde(default)]
    pub closed: Option<ClosedProgram>,
    /// For each input the places of the rates of the state for a unit rate of it.
    pub rates: Vec<Vec<OperationIndex>>,
    /// Frames whose poses and twists are wanted.
    pub frames: Vec<FrameProgram>,
    /// The forces that drive the inputs, if they are wanted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub forces: Option<ForceProgram>,
}

impl Solver {
    /// The number of the state from which on all follow from those before it.
    pub fn first_following(&self) -> usize {
        let follows = |i: &usize| self.placed.iter().any(|(placed, _)| placed == i);
        let mut numbers = (0..self.state.len()).rev();
        numbers.find(|i| !follows(i)).map_or(1, |last| last + 1)
    }
}
