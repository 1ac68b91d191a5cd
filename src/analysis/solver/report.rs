use serde::{Deserialize, Serialize};

use crate::algebra::{Operation, Place, SiUnit};

/// A component of the arrays that go in and out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Component {
    /// The joint, `top.x` for a coordinate of a platform, `top.qw` for a component of its unit quaternion.
    pub name: String,
    /// The unit of its values.
    pub unit: SiUnit,
    /// Its value at the assembled configuration from which the order of elimination was chosen.
    pub value: f64,
}

/// The pose and the twists of a frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameProgram {
    /// Its name.
    pub name: String,
    /// Places of the axes x, y, z and the origin in ground, three components each.
    pub pose: Vec<Place>,
    /// For each input the places of (v, ω) for a unit rate of it; v is the velocity of the origin.
    pub twists: Vec<Vec<Place>>,
}

/// A solver as a straight-line program. Its inputs are numbered: what is held, then the state, then a step of the
/// unknowns.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Solver {
    /// Name of the mechanism.
    pub mechanism: String,
    /// What is held.
    pub inputs: Vec<Component>,
    /// By which numbers a configuration is kept.
    pub state: Vec<Component>,
    /// How many unknowns a step has: one for each free joint, six for each free platform.
    pub unknowns: usize,
    /// All operations; operands stand before what uses them.
    pub operations: Vec<Operation>,
    /// Places of the closure rows r that do not vanish identically, dimensionless.
    pub residual: Vec<Place>,
    /// Places of the entries of their Jacobian J, row by row.
    pub jacobian: Vec<Vec<Place>>,
    /// Places of the pivots that are not constant.
    pub pivots: Vec<Place>,
    /// Places of the components of the step −J⁻¹ r, dimensionless.
    pub step: Vec<Place>,
    /// Places of the state moved by a step.
    pub moved: Vec<Place>,
    /// Frames whose poses and twists are wanted.
    pub frames: Vec<FrameProgram>,
}
