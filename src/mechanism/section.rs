//! A mechanism with one of its points held on a plane.

use std::f64::consts::FRAC_PI_2;

use super::model::{Chain, Closure, FixedStep, Formula, Joint, JointKind, Row, Symbol};
use super::{ClosureKind, Convention, Frame, Mechanism, Role};
use crate::algebra::Affine;
use crate::description::first_free;
use crate::geometry::Axis;

impl Mechanism {
    /// The mechanism with a point of a frame, at an offset in m, held on a plane in general position by a ball at the
    /// end of two slides. The slides are its last joints.
    ///
    /// A curve of order n has n points in such a plane, real or complex.
    pub fn with_point_on_a_plane(&self, frame: Frame, offset: [f64; 3]) -> Mechanism {
        /// The plane, in characteristic lengths and rad: numbers that no drawing has.
        const ORIGIN: [f64; 3] = [0.137_035, -0.291_549, 0.083_144];
        const TURNS: [(Axis, f64); 2] = [(Axis::Z, 0.729_735), (Axis::X, 1.054_571)];
        let mut cut = self.clone();
        let length = self.characteristic_length();
        let slides = ["u", "v"].map(|name| {
            cut.joints.push(Joint {
                name: self.free_name(name),
                role: Role::Passive,
                kind: JointKind::Prismatic,
                home: 0.0,
                limits: None,
            });
            cut.joints.len() - 1
        });
        let rows = slides.into_iter().zip([0.0, FRAC_PI_2]);
        let rows = rows.map(|(joint, twist)| Row {
            alpha: Formula::number(twist),
            a: Formula::number(0.0),
            d: Affine {
                constant: Formula::number(0.0),
                terms: vec![(Symbol::Joint(joint), Formula::number(1.0))],
            },
            theta: Affine {
                constant: Formula::number(0.0),
                terms: Vec::new(),
            },
            written: Default::default(),
        });
        let origin = ORIGIN.map(|part| Formula::number(part * length));
        let turns = TURNS.map(|(axis, angle)| FixedStep::Rotate(axis, Formula::number(angle)));
        let base = std::iter::once(FixedStep::TranslateBy(origin)).chain(turns);
        let chains = [
            (Frame::Ground, base.collect(), rows.collect()),
            (
                frame,
                vec![FixedStep::TranslateBy(offset.map(Formula::number))],
                Vec::new(),
            ),
        ];
        let tips = chains.map(|(on, base, rows)| {
            cut.chains.push(Chain {
                name: self.free_name(["plane", "point"][cut.chains.len() - self.chains.len()]),
                on,
                convention: Convention::Modified,
                base,
                rows,
                tip: Vec::new(),
            });
            Frame::Tip {
                chain: cut.chains.len() - 1,
            }
        });
        cut.closures.push(Closure {
            name: self.free_name("section"),
            kind: ClosureKind::Spherical,
            frames: tips,
            length: None,
        });
        let values: Vec<f64> = self.parameters.iter().map(|of| of.value).collect();
        let dimensions = cut.dimensions_over(&values);
        cut.dimensions = dimensions.expect("expressions had values before, and these are numbers");
        cut.measured(length)
    }

    /// A name that nothing has.
    fn free_name(&self, name: &str) -> String {
        let joints = self.joints.iter().map(|joint| &joint.name);
        let chains = self.chains.iter().map(|chain| &chain.name);
        let others = self.platforms.iter().map(|platform| &platform.name);
        let closures = self.closures.iter().map(|closure| &closure.name);
        let all: Vec<&String> = joints.chain(chains).chain(others).chain(closures).collect();
        first_free(name, "_", |name| all.iter().all(|known| *known != name))
    }
}
