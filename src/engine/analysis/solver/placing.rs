//! Platforms that stand on three balls leave the iteration.
//!
//! Three points of a body that are not in line can be brought to three points of space exactly if the mutual distances
//! agree, and then in one way only: a triangle and its mirror image are one triangle turned over. So the nine rows of
//! three spherical closures hold for one pose exactly if three distances between the points they are joined to hold,
//! in which the pose does not occur; it follows from the points in closed form.

use super::LEAST_PIVOT;
use crate::algebra::Pivot;
use crate::algebra::Recorded;
use crate::geometry::{Quaternion, Rotation, Vector3};
use crate::linear::Factorable;
use crate::mechanism::{
    Body, ClosureDimensions, ClosureKind, Configuration, Dimensions, Frame, Kinematics, LinearForm,
    Mechanism, PlatformPose,
};
use crate::number::Number;
use crate::system::{Held, HeldPlatform};

/// A platform that three spherical closures place.
pub(super) struct Placing {
    pub platform: usize,
    /// Its closures; the distance of the first two balls takes the place of the first, and so on.
    pub closures: [usize; 3],
    /// The frames that the balls are joined to.
    tips: [Frame; 3],
    /// The balls in the platform.
    balls: [Vector3<f64>; 3],
}

/// All platforms that nothing but three spherical closures holds, each joined to what none of the others carries.
pub(super) fn placings(mechanism: &Mechanism, held: &Held<f64>) -> Vec<Placing> {
    let mut found: Vec<Placing> = Vec::new();
    for platform in 0..held.platforms.len() {
        let placing = Placing::of(mechanism, held, platform);
        found.extend(placing.filter(|placing| {
            let carriers = placing.tips.map(|tip| mechanism.carrier(tip));
            (found.iter()).all(|other| !carriers.contains(&Some(other.platform)))
        }));
    }
    found
}

impl Placing {
    fn of(mechanism: &Mechanism, held: &Held<f64>, platform: usize) -> Option<Self> {
        let carries = |frame| mechanism.carrier(frame) == Some(platform);
        let all = mechanism.closures().iter().enumerate();
        let own: Vec<_> = all
            .filter(|(_, c)| c.frames.into_iter().any(carries))
            .collect();
        let [first, second, third] = own[..] else {
            return None;
        };
        let own = [first, second, third];
        let closures = own.map(|(place, _)| place);
        let ends = own.map(|(_, closure)| match closure.frames {
            [ball, tip] if carries(ball) => [ball, tip],
            [tip, ball] => [ball, tip],
        });
        let stands = |[ball, tip]: [Frame; 2]| {
            mechanism.body(ball) == Body::Platform(platform) && !carries(tip)
        };
        let spherical = own.iter().all(|(_, c)| c.kind == ClosureKind::Spherical);
        if held.platforms[platform] != HeldPlatform::Free
            || !spherical
            || !ends.into_iter().all(stands)
        {
            return None;
        }
        let (balls, tips) = (ends.map(|[ball, _]| ball), ends.map(|[_, tip]| tip));
        let mut at = mechanism.home();
        at.platforms[platform] = PlatformPose {
            orientation: Quaternion::identity(),
            position: Vector3::zero(),
        };
        let balls = points(mechanism.dimensions(), balls, &at);
        let placing = Placing {
            platform,
            closures,
            tips,
            balls,
        };
        let [_, _, normal] = edges(&balls);
        // the triangle of balls is at least a tenth of its longest side high
        (normal.norm() > 0.1 * placing.longest().powi(2)).then_some(placing)
    }

    fn side(&self, i: usize) -> f64 {
        (self.balls[(i + 1) % 3] - self.balls[i]).norm()
    }

    fn longest(&self) -> f64 {
        (0..3).map(|i| self.side(i)).fold(0.0, f64::max)
    }

    /// Puts the distances in place of the closures, and takes the pose out of the unknowns.
    pub fn leave<T: Factorable>(&self, dimensions: &mut Dimensions<T>, held: &mut Held<T>) {
        for (i, &closure) in self.closures.iter().enumerate() {
            dimensions.closures[closure] = ClosureDimensions {
                kind: ClosureKind::Distance,
                frames: [self.tips[i], self.tips[(i + 1) % 3]],
                length: T::from_f64(self.side(i)),
                extension: LinearForm(Vec::new()),
                relation: None,
            };
        }
        held.platforms[self.platform] = HeldPlatform::Pose;
    }

    /// Largest ratio of a gap of a closure to the rows r = (g·g − s²)/2L² of the distances, to first order: the
    /// strain of the triangle is less than 5 L² r/h² with its height h over the longest side, and a turn from `at` of up
    /// to 90° adds as much across.
    pub fn stretch(&self, length: f64) -> f64 {
        let [_, _, normal] = edges(&self.balls);
        let height = normal.norm() / self.longest();
        5.0 * 2f64.sqrt() * length * self.longest() / (height * height)
    }

    /// The pose in which the balls are where they are joined. The orientation in `at` chooses the sign of the quaternion;
    /// what is divided by is small where it is more than 90° away.
    pub fn pose(
        &self,
        dimensions: &Dimensions<Recorded>,
        at: &Configuration<Recorded>,
    ) -> (PlatformPose<Recorded>, Pivot) {
        let tips = points(dimensions, self.tips, at);
        let body = edges(&self.balls);
        let [a, b, c] = body;
        // R (a b n) = (a' b' n'); the rows of the inverse are the dual vectors
        let volume = a.cross(&b).dot(&c);
        let dual = [b.cross(&c), c.cross(&a), a.cross(&b)].map(|v| v.scaled(1.0 / volume));
        let seen = edges(&tips);
        let column = |k: usize| {
            let parts = seen.iter().zip(&dual);
            parts.fold(Vector3::zero(), |sum, (edge, dual)| {
                sum + edge.scaled(dual.0[k])
            })
        };
        let rotation = Rotation([0, 1, 2].map(column));
        let origin = rotation * self.balls[0].map(Recorded::from_f64);
        let (orientation, square) = at.platforms[self.platform].orientation.near(&rotation);
        let position = tips[0] - origin;
        let pivot = Pivot {
            number: square,
            inverse: orientation.0[0],
            scale: 0.5 / LEAST_PIVOT,
        };
        let pose = PlatformPose {
            orientation,
            position,
        };
        (pose, pivot)
    }
}

/// Origins of frames in ground, in m.
fn points<T: Number>(
    dimensions: &Dimensions<T>,
    frames: [Frame; 3],
    at: &Configuration<T>,
) -> [Vector3<T>; 3] {
    let kinematics = Kinematics::new(dimensions, frames);
    let mut placement = kinematics.placement();
    kinematics.place(at, &mut placement);
    frames.map(|frame| {
        let pose = kinematics.pose(frame, &placement);
        pose.expect("the plan has the frame").position
    })
}

/// Two sides of a triangle and their cross product.
fn edges<T: Number>(points: &[Vector3<T>; 3]) -> [Vector3<T>; 3] {
    let (a, b) = (points[1] - points[0], points[2] - points[0]);
    [a, b, a.cross(&b)]
}
