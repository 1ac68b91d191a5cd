use super::layout::Unknown;
use super::{System, SystemWork};
use crate::geometry::{Quaternion, Vector3};
use crate::linear::Factorable;
use crate::mechanism::{Configuration, ConfigurationRef, PlatformPose};
use crate::solve::Equations;

impl<T: Factorable> System<T> {
    /// The configuration moved by dimensionless steps of the unknowns: at ⊕ step.
    pub fn displaced(&self, at: &Configuration<T>, step: &[T]) -> Configuration<T> {
        let mut to = at.clone();
        self.displace(&mut to, step);
        to
    }

    /// Moves a configuration by dimensionless steps of the unknowns, in place.
    #[inline]
    pub fn displace(&self, at: &mut Configuration<T>, step: &[T]) {
        for (joint, value) in at.joints.iter_mut().enumerate() {
            *value = self.moved_joint(joint, *value, step, 1.0);
        }
        for (platform, pose) in at.platforms.iter_mut().enumerate() {
            *pose = self.moved_platform(platform, pose, step, 1.0);
        }
    }

    /// The value of a joint moved by a fraction of its step; the same if it is held.
    #[inline(always)]
    pub(super) fn moved_joint(&self, joint: usize, value: T, step: &[T], fraction: f64) -> T {
        match self.place_of(Unknown::Joint(joint)) {
            Some(i) => value + step[i].scale(fraction * self.joint_scales[joint]),
            None => value,
        }
    }

    /// The pose of a platform moved by a fraction of its step; the same if it is held.
    #[inline(always)]
    pub(super) fn moved_platform(
        &self,
        platform: usize,
        pose: &PlatformPose<T>,
        step: &[T],
        fraction: f64,
    ) -> PlatformPose<T> {
        match self.place_of(Unknown::first_twist(platform)) {
            Some(i) => {
                let omega = Vector3([step[i], step[i + 1], step[i + 2]]).scaled(fraction);
                let length = fraction * self.length;
                let shift = Vector3([step[i + 3], step[i + 4], step[i + 5]]).scaled(length);
                pose.moved_by(&omega, shift)
            }
            None => *pose,
        }
    }

    /// The dimensionless step between configurations: `displaced(from, difference(from, to))` is `to`.
    pub fn difference(&self, from: &Configuration<T>, to: &Configuration<T>) -> Vec<T> {
        let mut step = vec![T::zero(); self.unknowns().len()];
        self.difference_into(from.view(), to.view(), &mut step);
        step
    }

    /// As [`System::difference`], into a slice as long as there are unknowns.
    pub fn difference_into(
        &self,
        from: ConfigurationRef<T>,
        to: ConfigurationRef<T>,
        step: &mut [T],
    ) {
        self.each_difference(from, to, |i, x| step[i] = x);
    }

    /// Takes each number of the dimensionless step between configurations.
    #[inline(always)]
    pub(in crate::system) fn each_difference(
        &self,
        from: ConfigurationRef<T>,
        to: ConfigurationRef<T>,
        mut take: impl FnMut(usize, T),
    ) {
        for (i, &unknown) in self.unknowns().iter().enumerate() {
            match unknown {
                Unknown::Joint(joint) => {
                    let change = to.joints[joint] - from.joints[joint];
                    take(i, change.scale(1.0 / self.joint_scale(joint)));
                }
                Unknown::Twist(platform, 0) => {
                    let (from, to) = (&from.platforms[platform], &to.platforms[platform]);
                    let twist = self.twist_between(from, to);
                    (twist.into_iter().enumerate()).for_each(|(k, x)| take(i + k, x));
                }
                Unknown::Twist(..) => {}
            }
        }
    }

    /// The dimensionless twist that leads from one pose to another.
    pub(crate) fn twist_between(&self, from: &PlatformPose<T>, to: &PlatformPose<T>) -> [T; 6] {
        // q_to q_from* = (1 + ω/2)/‖·‖, the Cayley map turned round
        let [w, x, y, z] = from.orientation.0;
        let back = Quaternion([w, -x, -y, -z]);
        let [w, x, y, z] = to.orientation.then_left(&back).0;
        let turn = [x, y, z].map(|part| part.scale(2.0) / w);
        let shift = (to.position - from.position).0;
        let shift = shift.map(|part| part.scale(1.0 / self.characteristic_length()));
        [turn[0], turn[1], turn[2], shift[0], shift[1], shift[2]]
    }
}

impl System<f64> {
    /// Half the sum of squares of the rows, ½(Σ r² + Σ (w h + m)²), with its gradient: closure rows
    /// r, and rows h of held platform coordinates with the weight w and the multipliers m by which
    /// they are kept (method of multipliers, Hestenes 1969).
    pub fn slope(
        &self,
        at: &Configuration<f64>,
        weight: f64,
        multipliers: &[f64],
        work: &mut SystemWork<f64>,
    ) -> (Vec<f64>, f64) {
        self.linearise(at, work);
        let jacobian = self.dense_jacobian(work);
        let mut rows = self.residual_of(work).to_vec();
        let held = self.hold_rows();
        // scaled once for the square and once more for the derivative of the row
        let mut pull = rows.clone();
        for (i, multiplier) in held.zip(multipliers) {
            rows[i] = weight * rows[i] + multiplier;
            pull[i] = weight * rows[i];
        }
        let columns = jacobian.chunks_exact(self.rows().max(1));
        let gradient = columns.map(|column| column.iter().zip(&pull).map(|(a, b)| a * b).sum());
        let squares: f64 = rows.iter().map(|row| row * row).sum();
        (gradient.collect(), 0.5 * squares)
    }
}
