//! Closure equations that vanish identically.

use std::sync::OnceLock;

use super::Mechanism;
use super::closure::{ClosureEquations, EVERY_ROW, Kept, needs};
use super::configuration::{Configuration, PlatformPose};
use super::dimensions::Dimensions;
use super::kinematics::Kinematics;
use crate::geometry::{Pose, Quaternion, Vector3};
use crate::number::{Folded, tolerance::CANCELLED};

/// For each closure the rows that do not vanish whatever joints and platforms do.
///
/// The kinematics is multiplied out over constants and unknowns; right angles have exact sines, so that the equations
/// across the plane of a planar loop, those of the centre of a spherical one and the angles between bodies that are only
/// shifted come out as zero, but for rounding. No rank is computed: a row that vanishes for another reason is kept.
fn rows_that_vary(dimensions: &Dimensions<f64>) -> Vec<Kept> {
    let dimensions = &without_rounding(dimensions);
    let constant = |x| Folded(Some(x));
    let frames = dimensions.closures.iter();
    let frames = frames.flat_map(|closure| {
        closure
            .frames
            .into_iter()
            .zip(needs(closure.kind, &EVERY_ROW))
    });
    // constants are multiplied out as such, which is done sooner
    let kinematics = Kinematics::needing(dimensions, frames).map(constant);
    let folded = dimensions.map(constant);
    let varies = Folded(None);
    let at = Configuration {
        joints: vec![varies; dimensions.joint_scales.len()],
        platforms: vec![
            PlatformPose {
                orientation: Quaternion([varies; 4]),
                position: Vector3([varies; 3]),
            };
            dimensions.platforms.len()
        ],
    };
    let mut placement = kinematics.placement();
    kinematics.place(&at, &mut placement);
    let closures = folded.closures.iter();
    let rows = closures.map(|closure| {
        let closure = ClosureEquations::new(&folded, closure, &kinematics, EVERY_ROW);
        let rows = closure.rows(&placement, &at);
        rows.residual
            .map(|row| !row.0.is_some_and(|constant| constant.abs() <= CANCELLED))
    });
    rows.collect()
}

/// The dimensions with zero where the angles and lengths of a base on ground cancel but for rounding.
fn without_rounding(dimensions: &Dimensions<f64>) -> Dimensions<f64> {
    let mut rounded = dimensions.clone();
    for Pose { rotation, position } in rounded.chains.iter_mut().map(|chain| &mut chain.base) {
        let lengths = position
            .0
            .iter_mut()
            .map(|x| (x, dimensions.characteristic_length));
        let entries = rotation.0.iter_mut().flat_map(|axis| &mut axis.0);
        let small = |(x, size): &(&mut f64, f64)| x.abs() <= CANCELLED * size;
        let all = entries.map(|x| (x, 1.0)).chain(lengths);
        all.filter(small).for_each(|(x, _)| *x = 0.0);
    }
    rounded
}

impl Mechanism {
    pub(super) fn set_dimensions(&mut self, dimensions: Dimensions<f64>) {
        self.rows_that_vary = OnceLock::new();
        self.dimensions = dimensions.into();
        self.infer_cycles();
    }

    /// For each closure the rows that do not vanish whatever joints and platforms do.
    pub fn rows_that_vary(&self) -> &[Kept] {
        (self.rows_that_vary).get_or_init(|| rows_that_vary(&self.dimensions))
    }

    /// Number of equations that vary.
    pub fn equations_that_vary(&self) -> usize {
        let rows = self.rows_that_vary().iter().zip(self.closures.iter());
        let rows = rows.flat_map(|(kept, closure)| &kept[..closure.kind.equations()]);
        rows.filter(|varies| **varies).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Axis;
    use crate::mechanism::{
        ChainDimensions, ClosureDimensions, ClosureKind, Frame, LinearForm, RowDimensions,
    };

    /// Two turns against one, closed by a revolute joint; `between` leads from the first axis to the second.
    fn loop_with(between: Pose<f64>, tip: Pose<f64>, other: Pose<f64>) -> Dimensions<f64> {
        let turn = |joint, before| RowDimensions {
            before,
            turn: LinearForm(vec![(joint, 1.0)]),
            slide: LinearForm(vec![]),
            after: Pose::identity(),
        };
        let chain = |base, rows, tip| ChainDimensions {
            on: Frame::Ground,
            base,
            rows,
            tip,
        };
        let first = vec![turn(0, Pose::identity()), turn(1, between)];
        Dimensions {
            characteristic_length: 1.0,
            centre: [0.0; 3],
            axes: None,
            joint_scales: vec![1.0; 3],
            chains: vec![
                chain(Pose::identity(), first, tip),
                chain(other, vec![turn(2, Pose::identity())], tip),
            ],
            platforms: vec![],
            closures: vec![ClosureDimensions {
                kind: ClosureKind::Revolute,
                frames: [Frame::Tip { chain: 0 }, Frame::Tip { chain: 1 }],
                length: 0.0,
                extension: LinearForm(vec![]),
                relation: None,
            }],
        }
    }

    fn kept(dimensions: &Dimensions<f64>) -> [bool; 5] {
        let [a, b, c, d, e, _] = rows_that_vary(dimensions)[0];
        [a, b, c, d, e]
    }

    fn along_x(x: f64) -> Pose<f64> {
        Pose::translation(Vector3([x, 0.0, 0.0]))
    }

    #[test]
    fn a_planar_loop_has_two_equations_and_a_spherical_one_those_of_its_axes() {
        let planar = loop_with(along_x(1.0), along_x(2.0), along_x(3.0));
        assert_eq!(kept(&planar), [true, true, false, false, false]);
        let turn = |angle| Pose::rotation(Axis::X, angle);
        let spherical = loop_with(turn(0.5), turn(0.7), turn(0.9));
        assert_eq!(kept(&spherical), [false, false, false, true, true]);
    }

    #[test]
    fn a_loop_a_little_out_of_its_plane_keeps_every_equation_that_is_not_met() {
        let twisted = along_x(1.0) * Pose::rotation(Axis::X, 1e-9);
        let planar = loop_with(along_x(1.0), along_x(2.0), along_x(3.0));
        assert_eq!(
            kept(&loop_with(twisted, along_x(2.0), along_x(3.0))),
            [true; 5]
        );
        let mut lifted = planar.clone();
        lifted.chains[1].base = Pose::translation(Vector3([3.0, 0.0, 1e-12]));
        assert_eq!(kept(&lifted), [true, true, true, false, false]);
        // joined the wrong way round it never closes, and must not seem to
        let mut flipped = planar;
        flipped.chains[1].base = along_x(3.0) * Pose::rotation(Axis::X, std::f64::consts::PI);
        assert_eq!(kept(&flipped), [true, true, false, true, true]);
    }
}
