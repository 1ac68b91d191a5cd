//! Where the axes of a mechanism lie.

use super::{System, Work};
use crate::geometry::Vector3;
use crate::linear::Factorable;
use crate::mechanism::Configuration;

/// The axes of one closure in ground.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosureAxes<T> {
    /// Each unknown joint that moves the closure, with ω and the closure's velocity per unit of its scaled variable.
    pub joints: Vec<(usize, Vector3<T>, Vector3<T>)>,
    /// The z axes of the two frames it joins; of frames whose origin alone counts they are not known.
    pub frames: [Vector3<T>; 2],
}

impl<T: Factorable> System<T> {
    /// The axes of each closure at a configuration, assembled or not.
    pub fn axes(&self, at: &Configuration<T>, work: &mut Work<T>) -> Vec<ClosureAxes<T>> {
        self.kinematics.place(at, &mut work.placement);
        let placement = &work.placement;
        let closures = self.plans.iter().zip(&self.closures);
        let axes = closures.map(|(plan, closure)| {
            let rows = closure.rows(placement, at);
            let joints = plan.movers.iter().map(|(side, mover, _)| {
                let (omega, v) = placement.twist(mover, rows.velocity_point(*side));
                (mover.joint, omega, v)
            });
            ClosureAxes {
                joints: joints.collect(),
                frames: closure.frames(placement).map(|pose| pose.rotation.0[2]),
            }
        });
        axes.collect()
    }
}
