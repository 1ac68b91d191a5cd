//! Where the frames are and how far closures are open, multiplied out from the tables of a mechanism over nalgebra:
//! nothing of the library is used but values of entries.

use linkwork::algebra::Affine;
use linkwork::description::{ClosureKind, Convention};
use linkwork::geometry::Axis;
use linkwork::mechanism::{Configuration, FixedStep, Formula, Frame, Mechanism, Symbol};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};

/// A mechanism in a configuration.
#[derive(Clone, Copy)]
pub struct Placed<'a> {
    pub mechanism: &'a Mechanism,
    pub at: &'a Configuration<f64>,
}

impl Placed<'_> {
    fn value(&self, formula: &Formula) -> f64 {
        let value_of = |symbol: &Symbol| match *symbol {
            Symbol::Parameter(i) => self.mechanism.parameters()[i].value,
            Symbol::Joint(j) => self.at.joints[j],
            Symbol::Local(_) => unreachable!("only closed forms have local names"),
        };
        formula.evaluate(&value_of).unwrap()
    }

    fn affine(&self, affine: &Affine<Symbol>) -> f64 {
        let terms = affine.terms.iter().map(|(symbol, factor)| match *symbol {
            Symbol::Joint(j) => self.at.joints[j] * self.value(factor),
            _ => unreachable!("constants are no variables"),
        });
        self.value(&affine.constant) + terms.sum::<f64>()
    }

    fn fixed(&self, steps: &[FixedStep]) -> Isometry3<f64> {
        let step = |step: &FixedStep| match step {
            FixedStep::Translate(axis, by) => shift(unit(*axis) * self.value(by)),
            FixedStep::Rotate(axis, by) => turn(*axis, self.value(by)),
            FixedStep::TranslateBy(by) => {
                shift(Vector3::from(by.each_ref().map(|x| self.value(x))))
            }
        };
        (steps.iter().map(step)).fold(Isometry3::identity(), |at, step| at * step)
    }

    /// The pose of a frame in ground.
    pub fn pose(&self, frame: Frame) -> Isometry3<f64> {
        let platform = |p: usize| {
            let pose = &self.at.platforms[p];
            let [w, x, y, z] = pose.orientation.0;
            let turned = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
            Isometry3::from_parts(Translation3::from(Vector3::from(pose.position.0)), turned)
        };
        match frame {
            Frame::Ground => Isometry3::identity(),
            Frame::Platform { platform: p } => platform(p),
            Frame::OnPlatform { platform: p, frame } => {
                platform(p) * self.fixed(&self.mechanism.platforms()[p].frames[frame].1)
            }
            Frame::Link { chain, row } => self.link(chain, row),
            Frame::Tip { chain } => {
                let part = &self.mechanism.chains()[chain];
                self.link(chain, part.rows.len()) * self.fixed(&part.tip)
            }
        }
    }

    fn link(&self, chain: usize, row: usize) -> Isometry3<f64> {
        let part = &self.mechanism.chains()[chain];
        let start = self.pose(part.on) * self.fixed(&part.base);
        part.rows[..row].iter().fold(start, |at, row| {
            let link =
                turn(Axis::X, self.value(&row.alpha)) * shift(Vector3::x() * self.value(&row.a));
            let joint =
                turn(Axis::Z, self.affine(&row.theta)) * shift(Vector3::z() * self.affine(&row.d));
            at * match part.convention {
                Convention::Modified => link * joint,
                Convention::Standard => joint * link,
            }
        })
    }

    /// How far the closures are open: the largest distance over the characteristic length, or angle.
    pub fn gap(&self) -> f64 {
        let length = self.mechanism.characteristic_length();
        let gaps = self.mechanism.closures().iter().map(|closure| {
            let [a, b] = closure.frames.map(|frame| self.pose(frame));
            let between = a.inverse() * b;
            let apart = between.translation.vector;
            // how far the z axis leans, also where it points backwards
            let axis = between.rotation * Vector3::z();
            let leaning = axis.xy().norm().atan2(axis.z);
            let turned = between.rotation.angle();
            let (distance, angle) = match closure.kind {
                ClosureKind::Spherical => (apart.norm(), 0.0),
                ClosureKind::Revolute => (apart.norm(), leaning),
                ClosureKind::Prismatic => (apart.xy().norm(), turned),
                ClosureKind::Universal => (apart.norm(), axis.z.abs().asin()),
                ClosureKind::Cylindrical => (apart.xy().norm(), leaning),
                ClosureKind::Planar => (apart.z.abs(), leaning),
                ClosureKind::Rigid => (apart.norm(), turned),
                ClosureKind::Coupling => (0.0, 0.0),
                ClosureKind::Distance => {
                    let rod = closure.length.as_ref().expect("a rod has a length");
                    ((apart.norm() - self.affine(rod).abs()).abs(), 0.0)
                }
            };
            (distance / length).max(angle)
        });
        gaps.fold(0.0, f64::max)
    }

    /// After how many turns of a joint everything is where it was.
    fn turns(&self, joint: usize) -> Option<f64> {
        let rows = self.mechanism.chains().iter().flat_map(|chain| &chain.rows);
        let factor = |of: &Affine<Symbol>| -> f64 {
            let terms = of
                .terms
                .iter()
                .filter(|(symbol, _)| *symbol == Symbol::Joint(joint));
            terms.map(|(_, factor)| self.value(factor)).sum()
        };
        let factors: Vec<(f64, f64)> = rows
            .map(|row| (factor(&row.theta), factor(&row.d)))
            .collect();
        let whole = |x: f64| (x - x.round()).abs() < 1e-12;
        (1..9).map(f64::from).find(|n| {
            factors
                .iter()
                .all(|(turn, slide)| whole(n * turn) && *slide == 0.0)
        })
    }

    /// How far another configuration is away: the largest difference of joints, whole turns left out, of positions and
    /// of rotations, in rad and characteristic lengths.
    pub fn apart(&self, other: &Configuration<f64>) -> f64 {
        let length = self.mechanism.characteristic_length();
        let joints = self
            .mechanism
            .joints()
            .iter()
            .enumerate()
            .map(|(j, joint)| {
                let between = self.at.joints[j] - other.joints[j];
                match joint.kind.is_angle() {
                    true => within_turns(between, self.turns(j)).abs(),
                    false => between.abs() / length,
                }
            });
        let there = Placed { at: other, ..*self };
        let platforms = (0..self.mechanism.platforms().len()).map(|platform| {
            let frame = Frame::Platform { platform };
            let between = self.pose(frame).inverse() * there.pose(frame);
            between
                .rotation
                .angle()
                .max(between.translation.vector.norm() / length)
        });
        joints.chain(platforms).fold(0.0, f64::max)
    }
}

pub fn unit(axis: Axis) -> Vector3<f64> {
    match axis {
        Axis::X => Vector3::x(),
        Axis::Y => Vector3::y(),
        Axis::Z => Vector3::z(),
    }
}

pub fn shift(by: Vector3<f64>) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::from(by), UnitQuaternion::identity())
}

pub fn turn(axis: Axis, angle: f64) -> Isometry3<f64> {
    let by = UnitQuaternion::from_axis_angle(&nalgebra::Unit::new_normalize(unit(axis)), angle);
    Isometry3::from_parts(Translation3::identity(), by)
}

fn within_turns(angle: f64, turns: Option<f64>) -> f64 {
    match turns.map(|n| n * std::f64::consts::TAU) {
        Some(turn) => angle - turn * (angle / turn).round(),
        None => angle,
    }
}
