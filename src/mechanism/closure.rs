//! Residuals of the eight closures and their derivatives along twists: the only copy of either.
//!
//! With A and B the two frames, a, b their axes in ground, g = p_B − p_A, and L the characteristic
//! length, a closure consists of these rows, all dimensionless and zero when the joint is closed:
//!
//! | rows | residual | derivative along a relative twist (ω, v) |
//! |---|---|---|
//! | point (3) | g/L | v/L at the own point of each side |
//! | perpendicular (1) | a_z·b_z | ω·(b_z × a_z) |
//! | alignment (2) | u = 2 a_x·b_z/(1 + c), likewise y; c = a_z·b_z | ω·(2 b_z × a_x − u b_z × a_z)/(1 + c) |
//! | orientation (3) | w = 2 s/t, s = vee(Rᵀ_A R_B − ·ᵀ), t = 1 + tr(Rᵀ_A R_B) | ω·(2 δs − w δt)/t |
//! | offset (1, 2) | a_x·g/L, … | a_x·v/L at p_B |
//! | distance (1) | (g·g − s²)/2L² | g·v/L² at the own point of each side |
//!
//! Alignment is twice the tangent of half the angle between the axes (a stereographic projection),
//! orientation the Rodrigues vector 2 tan(θ/2)·n: the flipped axis, which a_x·b_z = a_y·b_z = 0
//! alone would admit, lies at infinity. A side-A motion counts with the opposite sign; taking its
//! velocity at p_B accounts for the turning of A's axes.

use super::ClosureKind;
use super::configuration::Configuration;
use super::dimensions::{ClosureDimensions, Dimensions, LinearForm};
use super::kinematics::{Kinematics, Mover, Need, Placement, Slot};
use crate::description::AxisCondition;
use crate::geometry::{Pose, Vector3};
use crate::number::Number;

/// The most rows a closure has.
pub(crate) const MOST_ROWS: usize = 6;

/// A closure ready for evaluation.
#[derive(Clone, Debug)]
pub struct Closure<T> {
    /// The joint that it restores.
    pub kind: ClosureKind,
    slots: [Slot; 2],
    /// The joints that move side A and side B.
    pub(crate) movers: [Vec<Mover<T>>; 2],
    /// The platforms that carry sides A and B.
    pub(crate) platforms: [Option<usize>; 2],
    length: T,
    extension: LinearForm<T>,
    /// The natural sizes of the joint variables of the extension.
    extension_scales: Vec<f64>,
    inverse_length: f64,
}

/// A side of a closure: the first or the second frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Side {
    A,
    B,
}

impl Side {
    #[inline(always)]
    fn sign(self) -> f64 {
        match self {
            Side::A => -1.0,
            Side::B => 1.0,
        }
    }
}

/// The rows of a closure at a configuration: residuals and the wrenches that measure twists.
#[derive(Clone, Debug)]
pub(crate) struct Rows<T> {
    /// Residuals, in the order point, moments, forces.
    pub residual: [T; MOST_ROWS],
    point: bool,
    moments: [Vector3<T>; 3],
    moment_count: usize,
    forces: [Vector3<T>; 2],
    force_count: usize,
    /// Where the velocity of side A and side B is taken.
    points: [Vector3<T>; 2],
    inverse_length: f64,
}

/// How much of the poses of its two frames the rows of a closure use.
pub(crate) fn needs(kind: ClosureKind) -> [Need; 2] {
    match kind.conditions().axes {
        AxisCondition::Free => [Need::Position; 2],
        AxisCondition::Perpendicular => [Need::Axis; 2],
        AxisCondition::Aligned => [Need::Pose, Need::Axis],
        AxisCondition::Oriented => [Need::Pose; 2],
    }
}

impl<T: Number> Closure<T> {
    pub(crate) fn new(
        dimensions: &Dimensions<T>,
        closure: &ClosureDimensions<T>,
        kinematics: &Kinematics<T>,
    ) -> Self {
        let slots = closure.frames.map(|frame| {
            (kinematics.slot(frame))
                .expect("the kinematics was planned for the frames of all closures")
        });
        let sides = slots.map(|slot| kinematics.movers(slot, &dimensions.joint_scales));
        let platforms = [sides[0].1, sides[1].1];
        Closure {
            kind: closure.kind,
            slots,
            movers: sides.map(|(movers, _)| movers),
            platforms,
            length: closure.length,
            extension: closure.extension.clone(),
            extension_scales: (closure.extension.0.iter())
                .map(|&(joint, _)| dimensions.joint_scales[joint])
                .collect(),
            inverse_length: 1.0 / dimensions.characteristic_length,
        }
    }

    /// The joint variables that occur in the length of a `Distance`, with the derivative of its residual for
    /// a unit of the scaled variable: −s cⱼ/L².
    pub(crate) fn length_column(&self, joint: usize, at: &Configuration<T>) -> T {
        let length = self.length(&at.joints);
        let terms = self.extension.0.iter().zip(&self.extension_scales);
        let mut terms = terms.filter(|((j, _), _)| *j == joint);
        terms
            .next()
            .map_or(T::zero(), |(&(_, coefficient), scale)| {
                -(length * coefficient).scale(scale * self.inverse_length * self.inverse_length)
            })
    }

    /// The joints whose variables affect the closure, without repetition.
    pub(crate) fn joints(&self) -> Vec<usize> {
        let moved = self.movers.iter().flatten().map(|mover| mover.joint);
        let extending = self.extension.0.iter().map(|(joint, _)| *joint);
        let joints: std::collections::BTreeSet<usize> = moved.chain(extending).collect();
        joints.into_iter().collect()
    }

    /// Whether a joint variable occurs in the length of the closure.
    pub(crate) fn extends_with(&self, joint: usize) -> bool {
        self.extension.0.iter().any(|(j, _)| *j == joint)
    }

    /// The poses of the two frames: ground from A, ground from B.
    #[inline(always)]
    pub(crate) fn frames<'a>(&self, placement: &'a Placement<T>) -> [&'a Pose<T>; 2] {
        let [a, b] = self.slots;
        [placement.pose(a), placement.pose(b)]
    }

    /// The length of a `Distance` in m.
    #[inline]
    pub(crate) fn length(&self, joints: &[T]) -> T {
        self.length + self.extension.at(joints)
    }

    /// Residuals only. Nothing allocates.
    #[inline]
    pub(crate) fn residual(&self, placement: &Placement<T>, at: &Configuration<T>, out: &mut [T]) {
        let [a, b] = self.frames(placement);
        let gap = b.position - a.position;
        match self.kind {
            ClosureKind::Spherical => {
                for (out, gap) in out.iter_mut().zip(gap.0) {
                    *out = gap.scale(self.inverse_length);
                }
            }
            ClosureKind::Distance => {
                let mut rows = Rows::new(self.inverse_length, [a.position, b.position]);
                rows.distance(&gap, self.length(&at.joints));
                out[0] = rows.residual[0];
            }
            _ => {
                // extracted as a whole, so that unused wrenches are not computed
                let residual = self.rows(placement, at).residual;
                out.copy_from_slice(&residual[..out.len()]);
            }
        }
    }

    /// Quantities that vanish where the joint is closed, without the denominators and factors that scale residuals:
    /// of a residual n/d the numerator n. The flipped joint, at which d vanishes, is not excluded by it.
    pub(crate) fn conditions(&self, placement: &Placement<T>, joints: &[T]) -> Vec<T> {
        let [a, b] = self.frames(placement);
        let gap = b.position - a.position;
        let conditions = self.kind.conditions();
        let axes = &a.rotation.0;
        let mut all = Vec::with_capacity(MOST_ROWS);
        if conditions.origins {
            all.extend(gap.0);
        }
        match conditions.axes {
            AxisCondition::Free => {}
            AxisCondition::Perpendicular => all.push(axes[2].dot(&b.rotation.0[2])),
            AxisCondition::Aligned => all.extend(misalignment(a, b).0),
            AxisCondition::Oriented => all.extend(disorientation(a, b).0),
        }
        all.extend(axes[conditions.offsets].iter().map(|axis| axis.dot(&gap)));
        if self.kind.has_length() {
            let length = self.length(joints);
            all.push(gap.dot(&gap) - length * length);
        }
        all
    }

    /// Residuals and wrenches.
    #[inline(always)]
    pub(crate) fn rows(&self, placement: &Placement<T>, at: &Configuration<T>) -> Rows<T> {
        let [a, b] = self.frames(placement);
        let gap = b.position - a.position;
        let mut rows = Rows::new(self.inverse_length, [a.position, b.position]);
        match self.kind {
            ClosureKind::Spherical => rows.point(&gap),
            ClosureKind::Revolute => {
                rows.point(&gap);
                rows.alignment(a, b);
            }
            ClosureKind::Universal => {
                rows.point(&gap);
                rows.perpendicular(a, b);
            }
            ClosureKind::Rigid => {
                rows.point(&gap);
                rows.orientation(a, b);
            }
            ClosureKind::Prismatic => {
                rows.orientation(a, b);
                rows.offsets(&gap, &a.rotation.0[..2]);
            }
            ClosureKind::Cylindrical => {
                rows.alignment(a, b);
                rows.offsets(&gap, &a.rotation.0[..2]);
            }
            ClosureKind::Planar => {
                rows.alignment(a, b);
                rows.offsets(&gap, &a.rotation.0[2..]);
            }
            ClosureKind::Distance => rows.distance(&gap, self.length(&at.joints)),
        }
        rows
    }
}

/// a_x·b_z, a_y·b_z and 1 + a_z·b_z: sine and one plus cosine of the angle between the axes.
#[inline(always)]
fn misalignment<T: Number>(a: &Pose<T>, b: &Pose<T>) -> ([T; 2], T) {
    let ([ax, ay, az], bz) = (a.rotation.0, b.rotation.0[2]);
    ([ax.dot(&bz), ay.dot(&bz)], T::one() + az.dot(&bz))
}

/// s = vee(Rᵀ_A R_B − ·ᵀ) and t = 1 + tr(Rᵀ_A R_B): 2 n sin θ and 2 + 2 cos θ.
#[inline(always)]
fn disorientation<T: Number>(a: &Pose<T>, b: &Pose<T>) -> ([T; 3], T) {
    let (a, b) = (&a.rotation.0, &b.rotation.0);
    let trace = a[0].dot(&b[0]) + a[1].dot(&b[1]) + a[2].dot(&b[2]);
    let s = |(i, j): (usize, usize)| a[j].dot(&b[i]) - a[i].dot(&b[j]);
    let [x, y, z] = CYCLIC;
    ([s(x), s(y), s(z)], T::one() + trace)
}

const CYCLIC: [(usize, usize); 3] = [(1, 2), (2, 0), (0, 1)];

impl<T: Number> Rows<T> {
    #[inline(always)]
    fn new(inverse_length: f64, points: [Vector3<T>; 2]) -> Self {
        Rows {
            residual: [T::zero(); MOST_ROWS],
            point: false,
            moments: [Vector3::zero(); 3],
            moment_count: 0,
            forces: [Vector3::zero(); 2],
            force_count: 0,
            points,
            inverse_length,
        }
    }

    #[inline(always)]
    fn next_row(&self) -> usize {
        3 * usize::from(self.point) + self.moment_count + self.force_count
    }

    #[inline(always)]
    fn point(&mut self, gap: &Vector3<T>) {
        for (row, gap) in self.residual.iter_mut().zip(gap.0) {
            *row = gap.scale(self.inverse_length);
        }
        self.point = true;
    }

    #[inline(always)]
    fn moment(&mut self, residual: T, moment: Vector3<T>) {
        let row = self.next_row();
        self.residual[row] = residual;
        self.moments[self.moment_count] = moment;
        self.moment_count += 1;
    }

    #[inline(always)]
    fn perpendicular(&mut self, a: &Pose<T>, b: &Pose<T>) {
        let (az, bz) = (a.rotation.0[2], b.rotation.0[2]);
        self.moment(az.dot(&bz), bz.cross(&az));
    }

    #[inline(always)]
    fn alignment(&mut self, a: &Pose<T>, b: &Pose<T>) {
        let ([ax, ay, az], bz) = (a.rotation.0, b.rotation.0[2]);
        let (sines, bottom) = misalignment(a, b);
        let inverse = T::one() / bottom;
        let slope = bz.cross(&az);
        for (axis, sine) in [ax, ay].into_iter().zip(sines) {
            let u = sine.scale(2.0) * inverse;
            let twice = bz.cross(&axis).times(T::from_f64(2.0));
            self.moment(u, (twice - slope.times(u)).times(inverse));
        }
    }

    #[inline(always)]
    fn orientation(&mut self, a: &Pose<T>, b: &Pose<T>) {
        let (sines, bottom) = disorientation(a, b);
        let inverse = T::one() / bottom;
        let (a, b) = (&a.rotation.0, &b.rotation.0);
        let slope = b[0].cross(&a[0]) + b[1].cross(&a[1]) + b[2].cross(&a[2]);
        for ((i, j), s) in CYCLIC.into_iter().zip(sines) {
            let w = s.scale(2.0) * inverse;
            let twice = (b[i].cross(&a[j]) - b[j].cross(&a[i])).times(T::from_f64(2.0));
            self.moment(w, (twice - slope.times(w)).times(inverse));
        }
    }

    #[inline(always)]
    fn offsets(&mut self, gap: &Vector3<T>, axes: &[Vector3<T>]) {
        for axis in axes {
            let row = self.next_row();
            self.residual[row] = axis.dot(gap).scale(self.inverse_length);
            self.forces[self.force_count] = axis.times(T::from_f64(self.inverse_length));
            self.force_count += 1;
        }
        self.points[0] = self.points[1];
    }

    #[inline(always)]
    fn distance(&mut self, gap: &Vector3<T>, length: T) {
        let factor = self.inverse_length * self.inverse_length;
        self.residual[0] = (gap.dot(gap) - length * length).scale(0.5 * factor);
        self.forces[0] = gap.times(T::from_f64(factor));
        self.force_count = 1;
    }

    /// The rate of every row along a motion of one side, given as rotation rate and the velocity
    /// at that side's [`Rows::velocity_point`].
    #[inline(always)]
    pub(crate) fn rates(&self, side: Side, omega: &Vector3<T>, v: &Vector3<T>, out: &mut [T]) {
        let sign = side.sign();
        let mut out = out.iter_mut();
        if self.point {
            let factor = sign * self.inverse_length;
            for (out, v) in out.by_ref().take(3).zip(v.0) {
                *out += v.scale(factor);
            }
        }
        for (moment, out) in self.moments[..self.moment_count].iter().zip(out.by_ref()) {
            *out += moment.dot(omega).scale(sign);
        }
        for (force, out) in self.forces[..self.force_count].iter().zip(out) {
            *out += force.dot(v).scale(sign);
        }
    }

    /// The derivatives of every row along a platform's twist (ω; v/L) about its origin, from which
    /// `arm` leads to the side's velocity point: a force f there has the moment arm × f. `put` is
    /// given the number of each row with its six derivatives.
    #[inline(always)]
    pub(crate) fn twist_rows(
        &self,
        side: Side,
        arm: &Vector3<T>,
        length: f64,
        mut put: impl FnMut(usize, [T; 6]),
    ) {
        let sign = side.sign();
        let force_row = |force: &Vector3<T>| {
            let [a, b, c] = arm.cross(force).scaled(sign).0;
            let [x, y, z] = force.scaled(sign * length).0;
            [a, b, c, x, y, z]
        };
        let mut next = 0..MOST_ROWS;
        if self.point {
            for (i, row) in next.by_ref().take(3).enumerate() {
                let force = Vector3::unit(i).times(T::from_f64(self.inverse_length));
                put(row, force_row(&force));
            }
        }
        for (moment, row) in self.moments[..self.moment_count].iter().zip(next.by_ref()) {
            let [a, b, c] = moment.scaled(sign).0;
            put(row, [a, b, c, T::zero(), T::zero(), T::zero()]);
        }
        for (force, row) in self.forces[..self.force_count].iter().zip(next) {
            put(row, force_row(force));
        }
    }

    /// Where the velocity of a side is to be taken.
    #[inline(always)]
    pub(crate) fn velocity_point(&self, side: Side) -> &Vector3<T> {
        &self.points[side as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Axis, Quaternion};
    use crate::mechanism::{ChainDimensions, Frame, PlatformPose, RowDimensions};

    #[test]
    fn frames_placed_as_far_as_needed_give_the_rows_of_frames_placed_in_full() {
        let twist = Pose::rotation(Axis::X, 0.7) * Pose::translation(Vector3([0.3, -0.2, 0.5]));
        let row = |turn: &[usize], slide: &[usize]| RowDimensions {
            before: twist,
            turn: LinearForm(turn.iter().map(|&j| (j, 0.9)).collect()),
            slide: LinearForm(slide.iter().map(|&j| (j, 1.1)).collect()),
            after: Pose::identity(),
        };
        let mut dimensions = Dimensions {
            characteristic_length: 1.5,
            joint_scales: vec![1.0, 1.5, 1.0, 1.0],
            chains: [Pose::identity(), twist]
                .map(|tip| ChainDimensions {
                    on: Frame::Ground,
                    base: twist,
                    rows: vec![row(&[0], &[]), row(&[], &[1]), row(&[2], &[3])],
                    tip,
                })
                .to_vec(),
            platforms: vec![vec![twist * twist]],
            closures: vec![],
        };
        let at = Configuration {
            joints: vec![0.4, -0.3, 0.8, 0.2],
            platforms: vec![PlatformPose {
                orientation: Quaternion([0.8, 0.0, 0.6, 0.0]),
                position: Vector3([0.1, 0.2, 0.3]),
            }],
        };
        let on_platform = Frame::OnPlatform {
            platform: 0,
            frame: 0,
        };
        let tips = [0, 1].map(|chain| Frame::Tip { chain });
        for kind in ClosureKind::ALL {
            for frames in [tips, [tips[0], on_platform], [on_platform, tips[1]]] {
                dimensions.closures = vec![ClosureDimensions {
                    kind,
                    frames,
                    length: 0.5,
                    extension: LinearForm(vec![]),
                }];
                let evaluate = |kinematics: Kinematics<f64>| {
                    let closure = Closure::new(&dimensions, &dimensions.closures[0], &kinematics);
                    let mut placement = kinematics.placement();
                    kinematics.place(&at, &mut placement);
                    let rows = closure.rows(&placement, &at);
                    let mut columns = vec![rows.residual];
                    for (side, movers) in [Side::A, Side::B].into_iter().zip(&closure.movers) {
                        for mover in movers {
                            let (omega, v) = placement.twist(mover, rows.velocity_point(side));
                            let mut column = [0.0; MOST_ROWS];
                            rows.rates(side, &omega, &v, &mut column);
                            columns.push(column);
                        }
                    }
                    let mut residual = [0.0; MOST_ROWS];
                    closure.residual(&placement, &at, &mut residual[..kind.equations()]);
                    assert_eq!(residual, rows.residual);
                    columns
                };
                let needs = frames.into_iter().zip(needs(kind));
                assert_eq!(
                    evaluate(Kinematics::needing(&dimensions, needs)),
                    evaluate(Kinematics::new(&dimensions, frames)),
                    "{kind:?}"
                );
            }
        }
    }
}
