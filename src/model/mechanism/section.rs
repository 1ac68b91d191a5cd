//! Points of a mechanism as its joints: on a plane, or with their coordinates.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use super::model::{
    Chain, ChainRow, Closure, FixedStep, Formula, Joint, JointKind, Platform, Symbol,
};
use super::{Body, ClosureKind, Convention, Frame, Mechanism, NamedPoint, Point, Role};
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
        let origin = ORIGIN.map(|part| Formula::number(part * self.characteristic_length()));
        let turns = TURNS.map(|(axis, angle)| FixedStep::Rotate(axis, Formula::number(angle)));
        let base = std::iter::once(FixedStep::TranslateBy(origin)).chain(turns);
        let slides = [("u", [0.0, 0.0]), ("v", [FRAC_PI_2, 0.0])];
        let slides = slides.map(|(name, turns)| (self.free_name(name), 0.0, turns));
        self.with_slides("point", Point { frame, offset }, base.collect(), &slides)
    }

    /// The mechanism with the coordinates of a point in ground as joints, called after it: they are its last ones, and
    /// a ball that closes the point to the end of three slides takes no freedom away.
    pub fn with_coordinates_of(&self, point: &NamedPoint) -> Mechanism {
        let [x, y, z] = point.point.at(self, &self.home()).0;
        let turn = FRAC_PI_2;
        // the slide along x is turned to y, and that to z
        let slides = [
            ("x", x, [0.0, 0.0]),
            ("y", y, [-turn, turn]),
            ("z", z, [-turn, 0.0]),
        ];
        let slides =
            slides.map(|(axis, home, turns)| (format!("{}.{axis}", point.name), home, turns));
        let base = FixedStep::Rotate(Axis::Y, Formula::number(turn));
        let mut with = self.with_slides(&point.name, point.point, vec![base], &slides);
        with.added_unknowns += 3;
        with
    }

    /// True if a joint is a coordinate of a point ([`Mechanism::with_coordinates_of`]): no other name has a dot.
    pub fn is_of_point(&self, joint: usize) -> bool {
        self.joints[joint].name.contains('.')
    }

    /// Numbers of chains and closures of the file: those that make points, frames and closures joints come after them.
    pub fn own_parts(&self) -> [usize; 2] {
        self.own
    }

    /// Number of unknowns, and of independent equations, that make points, frames and closures joints.
    pub fn added_unknowns(&self) -> usize {
        self.added_unknowns
    }

    /// True for a body that the file does not have: a slide of a point, or a link in front of a closure.
    pub fn is_added(&self, body: Body) -> bool {
        matches!(body, Body::Link { chain, .. } if chain >= self.own[0])
    }

    /// The mechanism with a frame as a platform of its own, called as the frame is, so that its position and its angles are
    /// coordinates; `None` for ground and for a platform.
    pub fn with_frame_as_platform(&self, name: &str) -> Option<Mechanism> {
        let frame = self.frame(name)?;
        if self.platform(name).is_some() || self.body(frame) == Body::Ground {
            return None;
        }
        let mut more = self.clone();
        let platform = more.platforms.len();
        more.platforms.push(Platform {
            name: name.to_owned(),
            home: self.transform(Frame::Ground, frame, &self.home()),
            frames: Arc::default(),
        });
        let called = self.free_name(&format!("frame {name}"));
        let frames = [frame, Frame::Platform { platform }];
        let closure = Closure::new(called, ClosureKind::Rigid, frames);
        Arc::make_mut(&mut more.closures).push(closure);
        more.added_unknowns += 6;
        Some(more.remeasured(self.characteristic_length()))
    }

    /// The mechanism with a point closed by a ball to the end of a chain of slides, each with its home value and α and
    /// θ of its row; the parts added are called after the point.
    fn with_slides(
        &self,
        called: &str,
        point: Point,
        base: Vec<FixedStep>,
        slides: &[(String, f64, [f64; 2])],
    ) -> Mechanism {
        let mut cut = self.clone();
        let rows = slides.iter().map(|(name, home, [alpha, theta])| {
            cut.joints.push(Joint {
                name: name.clone(),
                role: Role::Passive,
                kind: JointKind::Prismatic,
                home: *home,
                limits: None,
            });
            let joint = Symbol::Joint(cut.joints.len() - 1);
            let affine = |constant: f64, terms| Affine {
                constant: Formula::number(constant),
                terms,
            };
            ChainRow {
                alpha: Formula::number(*alpha),
                a: Formula::number(0.0),
                d: affine(0.0, vec![(joint, Formula::number(1.0))]),
                theta: affine(*theta, Vec::new()),
                beta: Formula::number(0.0),
                written: Default::default(),
                link: None,
            }
        });
        let rows: Vec<ChainRow> = rows.collect();
        let offset = vec![FixedStep::TranslateBy(point.offset.map(Formula::number))];
        let chains = [
            (Frame::Ground, base, rows),
            (point.frame, offset, Vec::new()),
        ];
        let tips = chains.map(|(on, base, rows)| {
            let name = match cut.chains.len() == self.chains.len() {
                true => cut.free_name(&format!("slides of {called}")),
                false => cut.free_name(called),
            };
            Arc::make_mut(&mut cut.chains).push(Chain {
                name,
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
        let name = cut.free_name(&format!("coordinates of {called}"));
        let closure = Closure::new(name, ClosureKind::Spherical, tips);
        Arc::make_mut(&mut cut.closures).push(closure);
        cut.remeasured(self.characteristic_length())
    }

    pub(super) fn free_name(&self, name: &str) -> String {
        let joints = self.joints.iter().map(|joint| &joint.name);
        let chains = self.chains.iter().map(|chain| &chain.name);
        let others = self.platforms.iter().map(|platform| &platform.name);
        let closures = self.closures.iter().map(|closure| &closure.name);
        let all: Vec<&String> = joints.chain(chains).chain(others).chain(closures).collect();
        first_free(name, |name| all.iter().all(|known| *known != name))
    }
}
