//! Forces, inertia and energies at an instant, and reasons for which there are none.

/// Forces, inertia and energies at an instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Accelerated {
    /// Second derivatives of the independent coordinates, in m/s² and rad/s².
    pub accelerations: Vec<f64>,
    /// The power of what acts, inertia included, for a unit rate of each with no acceleration of these, in N and N·m.
    pub forces: Vec<f64>,
    /// The mass matrix, row by row, in kg, kg·m and kg·m².
    pub mass: Vec<f64>,
    /// Kinetic energy, in J.
    pub kinetic: f64,
    /// Potential energy of weights and springs, in J.
    pub potential: f64,
    /// The power of given forces and drives less that of dampers, in W.
    pub supplied: f64,
    /// The forces of what drives coordinates, in N and N·m.
    pub drives: Vec<f64>,
}

/// Reasons for which a mechanism has no equations of motion at a configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoDynamics {
    /// It has more freedoms there than nearby: branches of motion meet.
    Singular,
    /// No coordinates determine it.
    NoCoordinates,
    /// A force has no value.
    NoForce,
}
