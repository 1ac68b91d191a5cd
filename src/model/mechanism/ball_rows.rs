//! Ball joints written as three rows of a table.
//!
//! Three passive hinges whose axes z₁, z₂, z₃ meet in one point bring what they carry into each orientation with two
//! sets of angles. The sets differ in nothing but where the two inner links stand, which are rings of no extent: z₂ is
//! reflected in the plane of z₁ and z₃.

use super::{Body, Configuration, Frame, JointKind, Mechanism};
use crate::description::Role;
use crate::geometry::{Axis, Line, Relation, Vector3};
use crate::linear::RANK_TOLERANCE;
use crate::number::real;
use crate::number::tolerance::SAME;

/// A chain, and the first of three rows in it, from 0.
type Ball = (usize, usize);

/// The joints of a ball in gimbal lock.
#[derive(Clone, Copy, Debug)]
pub struct LockedBall {
    /// The joint of the second row.
    pub middle: usize,
    /// Joints of the outer rows with what each changes by, in rad, while z₂ turns by 1 rad and no body moves.
    turned: [(usize, f64); 2],
}

impl LockedBall {
    /// Turns z₂ by an angle; all bodies but rings keep their poses.
    pub fn turn(&self, at: &mut Configuration<f64>, angle: f64) {
        for (joint, rate) in self.turned {
            at.joints[joint] += rate * angle;
        }
    }
}

impl Mechanism {
    /// The configuration, then those with every other combination of the two sets of angles of balls: all bodies but
    /// rings keep their poses.
    pub fn sets_of_angles(&self, at: &Configuration<f64>) -> Vec<Configuration<f64>> {
        let mut sets = vec![at.clone()];
        for ball in self.balls() {
            let others = sets.iter().filter_map(|at| self.other_set(ball, at));
            let others: Vec<_> = others.collect();
            sets.extend(others);
        }
        sets
    }

    /// For each ball the side of the plane of z₁ and z₃ on which its second axis lies, which distinguishes its two sets
    /// of angles.
    pub fn sides_of_rings(&self, at: &Configuration<f64>) -> Vec<bool> {
        let axis = |(chain, first): Ball, row: usize| {
            self.hinge((chain, first + row), at)
                .map(|line| line.direction)
        };
        let side = |ball: Ball| {
            let [z1, z2, z3] = [axis(ball, 0)?, axis(ball, 1)?, axis(ball, 2)?];
            Some(z1.cross(&z3).dot(&z2) > 0.0)
        };
        let balls = self.balls().into_iter();
        balls.map(|ball| side(ball) == Some(true)).collect()
    }

    /// The balls in gimbal lock: z₁ and z₃ are one line, and both turn about it against each other moves no body.
    pub fn locked_balls(&self, at: &Configuration<f64>) -> Vec<LockedBall> {
        let balls = self.balls().into_iter().filter_map(|(chain, first)| {
            let axis = |row| Some(self.hinge((chain, first + row), at)?.direction);
            let [z1, z3] = [axis(0)?, axis(2)?];
            let [(outer, one), (middle, _), (inner, other)] = [
                self.turned((chain, first))?,
                self.turned((chain, first + 1))?,
                self.turned((chain, first + 2))?,
            ];
            // known to half the digits where solutions meet
            (z1.cross(&z3).norm() <= SAME).then_some(LockedBall {
                middle,
                turned: [(outer, 1.0 / one), (inner, -z1.dot(&z3).signum() / other)],
            })
        });
        balls.collect()
    }

    /// The axis of a row.
    fn hinge(&self, (chain, row): (usize, usize), at: &Configuration<f64>) -> Option<Line> {
        let link = self.poses_about_centre(&[Frame::Link { chain, row }], at);
        let hinge = link[0] * self.dimensions.chains[chain].rows[row].before;
        Line::new(hinge.position, hinge.rotation.column(Axis::Z))
    }

    /// The passive joint without limits that a row turns by, and its factor, if neither does anything else.
    fn turned(&self, (chain, row): (usize, usize)) -> Option<(usize, f64)> {
        let row = &self.dimensions.chains[chain].rows[row];
        let [(joint, factor)] = row.turn.0[..] else {
            return None;
        };
        let of = &self.joints[joint];
        let passive = of.role == Role::Passive && of.kind == JointKind::Revolute;
        let rows = self.dimensions.chains.iter().flat_map(|chain| &chain.rows);
        let turned = rows
            .flat_map(|row| &row.turn.0)
            .filter(|(j, _)| *j == joint);
        let free = passive && of.limits.is_none() && turned.count() == 1;
        (free && row.slide.0.is_empty()).then_some((joint, factor))
    }

    /// The balls of which nothing else is fixed to a ring, and through whose centre no axis of a neighbouring row passes,
    /// as the axes of a spherical linkage do, whose links are no rings.
    fn balls(&self) -> Vec<Ball> {
        let (home, length) = (self.home(), self.characteristic_length());
        let meet = |chain: usize, row: usize| {
            let second = self.hinge((chain, row + 1), &home)?;
            let normal = self
                .hinge((chain, row), &home)?
                .common_normal(&second, length);
            (normal.relation == Relation::Intersecting).then_some(normal.feet)
        };
        let concurrent = |chain: usize, first: usize| {
            let centres = [meet(chain, first)?[1], meet(chain, first + 1)?[0]];
            let passes = |row: usize| {
                let line = self.hinge((chain, row), &home);
                line.is_some_and(|line| line.distance(&centres[0]) <= RANK_TOLERANCE * length)
            };
            let rows = self.dimensions.chains[chain].rows.len();
            let neighbours = first.checked_sub(1).into_iter().chain([first + 3]);
            let mut neighbours = neighbours.filter(|&row| row < rows);
            let met = (centres[0] - centres[1]).norm() <= RANK_TOLERANCE * length;
            Some(met && !neighbours.any(passes))
        };
        let carried = self.chains.iter().map(|chain| chain.on);
        let carried = carried.chain(self.closures.iter().flat_map(|closure| closure.frames));
        let carried: Vec<Body> = carried.map(|frame| self.body(frame)).collect();
        let is_ball = |&(chain, first): &Ball| {
            (first..first + 3).all(|row| self.turned((chain, row)).is_some())
                && concurrent(chain, first) == Some(true)
                && rings((chain, first))
                    .iter()
                    .all(|ring| !carried.contains(ring))
        };
        let chains = self.chains.iter().enumerate();
        let places = chains.flat_map(|(i, chain)| {
            let firsts = 0..chain.rows.len().saturating_sub(2);
            firsts.map(move |first| (i, first))
        });
        places.filter(is_ball).collect()
    }

    /// A configuration with the other angles of a ball; `None` where z₁ and z₃ are one line, so that there are infinitely
    /// many.
    fn other_set(
        &self,
        (chain, first): Ball,
        at: &Configuration<f64>,
    ) -> Option<Configuration<f64>> {
        let axis = |row: usize| Some(self.hinge((chain, first + row), at)?.direction);
        let [z1, z2, z3] = [axis(0)?, axis(1)?, axis(2)?];
        let normal = z1.cross(&z3);
        let normal = normal.times(1.0 / Some(normal.norm()).filter(|n| *n > RANK_TOLERANCE)?);
        let mirrored = z2 - normal.times(2.0 * z2.dot(&normal));
        let by = [
            angle(&z1, &z1.cross(&z2), &z1.cross(&mirrored)),
            -2.0 * angle(&z2, &z1.cross(&z2), &z2.cross(&z3)),
            -angle(&z3, &z3.cross(&z2), &z3.cross(&mirrored)),
        ];
        let mut other = at.clone();
        for (row, by) in (first..).zip(by) {
            let (joint, factor) = self.turned((chain, row))?;
            other.joints[joint] += by / factor;
        }
        Some(other)
    }
}

fn rings((chain, first): Ball) -> [Body; 2] {
    [1, 2].map(|k| Body::Link {
        chain,
        row: first + k,
    })
}

/// Angle from one vector to another about an axis that both are normal to.
fn angle(about: &Vector3<f64>, from: &Vector3<f64>, to: &Vector3<f64>) -> f64 {
    real::atan2(about.dot(&from.cross(to)), from.dot(to))
}
