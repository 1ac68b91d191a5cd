use super::layout::Unknown;
use super::{System, Work};
use crate::geometry::Vector3;
use crate::linear::Factorable;
use crate::mechanism::Configuration;
use crate::solve::Equations;

impl<T: Factorable> System<T> {
    /// The configuration moved by dimensionless steps of the unknowns: at ⊕ step.
    pub fn displaced(&self, at: &Configuration<T>, step: &[T]) -> Configuration<T> {
        let mut to = at.clone();
        for (&unknown, i) in self.unknowns().iter().zip(0..) {
            match unknown {
                Unknown::Joint(joint) => {
                    to.joints[joint] += step[i].scale(self.joint_scale(joint));
                }
                Unknown::Twist {
                    platform,
                    component: 0,
                } => {
                    let omega = Vector3([step[i], step[i + 1], step[i + 2]]);
                    let length = self.characteristic_length();
                    let shift = [3, 4, 5].map(|k| step[i + k].scale(length));
                    to.platforms[platform] =
                        at.platforms[platform].moved_by(&omega, Vector3(shift));
                }
                Unknown::Twist { .. } => {}
            }
        }
        to
    }
}

impl System<f64> {
    /// The gradient Jᵀr of half the sum of squares of the rows, and that half sum.
    pub fn slope(&self, at: &Configuration<f64>, work: &mut Work<f64>) -> (Vec<f64>, f64) {
        let size = self.linearise(at, work);
        let jacobian = self.dense_jacobian(work);
        let residual = self.residual_of(work);
        let columns = jacobian.chunks_exact(self.rows().max(1));
        let gradient = columns.map(|column| column.iter().zip(residual).map(|(a, b)| a * b).sum());
        (gradient.collect(), 0.5 * size.squares)
    }
}
