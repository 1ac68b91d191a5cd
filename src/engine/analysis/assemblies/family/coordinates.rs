//! Configurations as flat complex coordinates, and tests for equal ones.

use std::f64::consts::PI;

use crate::geometry::{Quaternion, Vector3};
use crate::linear::Factorable;
use crate::mechanism::{
    Configuration, Dimensions, Mechanism, PlatformPose, PoseCoordinate, principal, turns_to_repeat,
};
use crate::number::Number;
use crate::number::tolerance::SAME;
use crate::system::{Held, HeldPlatform, System};

pub(crate) use crate::number::C;

/// A given coordinate, or several that belong together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Input {
    /// The variable of a joint.
    Joint(usize),
    /// The pose of a platform: quaternion, then position.
    Pose(usize),
    /// One coordinate of a platform.
    Target(usize, PoseCoordinate),
    /// The orientation of a platform, as a quaternion.
    Orientation(usize),
}

impl Input {
    /// Number of its flat inputs.
    pub fn width(self) -> usize {
        match self {
            Input::Joint(_) | Input::Target(..) => 1,
            Input::Pose(_) => 7,
            Input::Orientation(_) => 4,
        }
    }
}

/// Unknown and given coordinates, and their order in flat vectors.
///
/// Flat unknowns are dimensionless: free joints over their scale, then for each platform to be found
/// a quaternion and a position over the characteristic length. Flat inputs keep their units.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Coordinates {
    pub free_joints: Vec<usize>,
    pub free_platforms: Vec<usize>,
    /// Held joints, then held poses, single coordinates of platforms, held orientations.
    pub inputs: Vec<Input>,
    pub joint_scales: Vec<f64>,
    pub length: f64,
    /// Position in ground, in m, from which positions are measured.
    centre: [f64; 3],
    /// For each joint after how many turns everything is where it was: more than one where a gear turns something by a
    /// fraction, `None` for slides and screws and for a ratio that is no fraction.
    pub turns: Vec<Option<f64>>,
    /// Free joints that turn something and never come back to the same place: those that travel as they turn, and those
    /// whose ratio to what they turn is no fraction.
    pub screws: Vec<usize>,
    pub incommensurate: Vec<usize>,
    /// Free joints, as places among the flat unknowns, by the closures that they affect: two legs meet
    /// in the poses of platforms only.
    pub legs: Vec<Vec<usize>>,
}

impl Coordinates {
    pub fn new(mechanism: &Mechanism, held: &Held<f64>) -> Self {
        let (held_joints, free_joints): (Vec<usize>, Vec<usize>) =
            (0..held.joints.len()).partition(|&j| held.joints[j]);
        let (held_poses, free_platforms): (Vec<usize>, Vec<usize>) =
            (0..held.platforms.len()).partition(|&p| held.platforms[p] == HeldPlatform::Pose);
        let (mut targets, mut orientations) = (Vec::new(), Vec::new());
        for (p, held) in held.platforms.iter().enumerate() {
            let coordinates = held.coordinates().iter();
            targets.extend(coordinates.map(|(c, _)| Input::Target(p, *c)));
            orientations.extend(held.orientation().map(|_| Input::Orientation(p)));
        }
        let joints = held_joints.into_iter().map(Input::Joint);
        let poses = held_poses.into_iter().map(Input::Pose);
        let dimensions = mechanism.dimensions();
        let repeating = turns_to_repeat(dimensions, mechanism.joints().len());
        let turns = repeating.iter().enumerate();
        let turns: Vec<Option<f64>> = turns
            .map(|(j, turns)| turns.filter(|_| !slides(dimensions, j)))
            .collect();
        let winding = free_joints.iter().copied();
        let winding = winding.filter(|&j| !is_algebraic(mechanism, j));
        let (screws, incommensurate) = winding
            .filter(|&j| mechanism.joints()[j].kind.is_angle() && turns[j].is_none())
            .partition(|&j| repeating[j].is_some());
        Coordinates {
            legs: legs(&free_joints, &System::new(dimensions, held)),
            free_joints,
            free_platforms,
            inputs: (joints.chain(poses).chain(targets).chain(orientations)).collect(),
            joint_scales: dimensions.joint_scales.clone(),
            length: dimensions.characteristic_length,
            centre: dimensions.centre,
            screws,
            incommensurate,
            turns,
        }
    }

    /// The coordinates without those held besides, in a system where none of these is.
    pub fn without(&self, held: &Held<C>, system: &System<C>) -> Self {
        let mut rest = self.clone();
        rest.free_joints.retain(|j| !held.joints[*j]);
        (rest.free_platforms).retain(|p| held.platforms[*p] != HeldPlatform::Pose);
        rest.legs = legs(&rest.free_joints, system);
        rest
    }

    /// True if a joint is free, turns something and never comes back to the same place.
    pub fn winds(&self, joint: usize) -> bool {
        self.screws.contains(&joint) || self.incommensurate.contains(&joint)
    }

    /// Number of flat unknowns.
    pub fn count(&self) -> usize {
        self.free_joints.len() + 7 * self.free_platforms.len()
    }

    /// Number of flat inputs.
    pub fn input_count(&self) -> usize {
        self.inputs.iter().map(|input| input.width()).sum()
    }

    /// Each input with its part of the flat inputs.
    pub fn split<'a, T>(&'a self, mut flat: &'a [T]) -> impl Iterator<Item = (Input, &'a [T])> {
        self.inputs.iter().map(move |&input| {
            let (own, rest) = flat.split_at(input.width());
            flat = rest;
            (input, own)
        })
    }

    pub fn flatten(&self, at: &Configuration<C>) -> Vec<C> {
        let joints = self
            .free_joints
            .iter()
            .map(|&j| at.joints[j] / self.joint_scales[j]);
        let poses = self.free_platforms.iter().flat_map(|&p| {
            let pose = &at.platforms[p];
            let position = pose.position.0.map(|x| x / self.length);
            pose.orientation.0.into_iter().chain(position)
        });
        joints.chain(poses).collect()
    }

    /// The flat unknowns of a real configuration.
    pub fn flat(&self, at: &Configuration<f64>) -> Vec<C> {
        self.flatten(&at.map(C::from_f64))
    }

    /// The configuration with these unknowns; held coordinates are as in `like`.
    pub fn placed(&self, x: &[C], like: &Configuration<f64>) -> Configuration<C> {
        let mut at = like.map(C::from_f64);
        self.unflatten(x, &mut at);
        at
    }

    /// The real configuration at the real parts of unknowns; held coordinates are as in `like`.
    pub fn real_part(&self, x: &[C], like: &Configuration<f64>) -> Configuration<f64> {
        let mut at = self.placed(x, like).map(|z| z.re);
        for &p in &self.free_platforms {
            let orientation = at.platforms[p].orientation.normalised();
            if orientation.0.iter().all(|x| x.is_finite()) {
                at.platforms[p].orientation = orientation;
            }
        }
        at
    }

    /// Writes the unknowns into a configuration; its held coordinates stay.
    #[inline]
    pub fn unflatten(&self, x: &[C], at: &mut Configuration<C>) {
        let (joints, poses) = x.split_at(self.free_joints.len());
        for (&j, x) in self.free_joints.iter().zip(joints) {
            at.joints[j] = *x * self.joint_scales[j];
        }
        for (&p, x) in self.free_platforms.iter().zip(poses.chunks_exact(7)) {
            at.platforms[p] = PlatformPose {
                orientation: Quaternion([x[0], x[1], x[2], x[3]]),
                position: Vector3([x[4], x[5], x[6]].map(|x| x * self.length)),
            };
        }
    }

    #[inline]
    pub fn settle(&self, x: &mut [C]) {
        for pose in x[self.free_joints.len()..].chunks_exact_mut(7) {
            let unit = Quaternion([pose[0], pose[1], pose[2], pose[3]]).normalised();
            pose[..4].copy_from_slice(&unit.0);
        }
    }

    /// The equivalent value of a joint nearest to zero; an angle this near to the lower end becomes that near the upper.
    pub fn principal(&self, joint: usize, value: f64, rounding: f64) -> f64 {
        match self.turns[joint] {
            Some(turns) => turns * principal(value / turns, rounding),
            None => value,
        }
    }

    /// The inputs of a question: held values of a configuration, and targets of platforms.
    pub fn inputs_of<T: Number>(&self, at: &Configuration<T>, held: &Held<T>) -> Vec<T> {
        let mut inputs = Vec::with_capacity(self.input_count());
        for &input in &self.inputs {
            match input {
                Input::Joint(j) => inputs.push(at.joints[j]),
                Input::Pose(p) => {
                    inputs.extend(at.platforms[p].orientation.0);
                    inputs.extend(at.platforms[p].position.0);
                }
                Input::Target(p, c) => {
                    let target = held.platforms[p].target(c);
                    inputs.extend(target.map(|x| c.about_centre(x, &self.centre)));
                }
                Input::Orientation(p) => {
                    let wanted = held.platforms[p].orientation();
                    inputs.extend(wanted.iter().flat_map(|r| Quaternion::from_rotation(r).0));
                }
            }
        }
        inputs
    }

    /// The coordinates of the platforms.
    pub fn pose_of<'a>(&self, x: &'a [C]) -> &'a [C] {
        &x[self.free_joints.len()..]
    }

    /// Squares of the differences of joints at these places: angles modulo a turn.
    fn joint_gaps<'a>(
        &'a self,
        places: impl Iterator<Item = usize> + 'a,
        x: &'a [C],
        y: &'a [C],
    ) -> impl Iterator<Item = f64> + 'a {
        places.zip(x.iter().zip(y)).map(|(place, (x, y))| {
            let mut gap = x - y;
            if gap.re.abs() > PI {
                gap.re = self.principal(self.free_joints[place], gap.re, 0.0);
            }
            gap.norm_sqr()
        })
    }

    /// Squares of the differences of two solutions: angles modulo a turn, q and −q alike.
    fn gaps<'a>(&'a self, x: &'a [C], y: &'a [C]) -> impl Iterator<Item = f64> + 'a {
        let joints = 0..self.free_joints.len();
        let poses = pose_gaps(self.pose_of(x), self.pose_of(y));
        self.joint_gaps(joints, x, y).chain(poses)
    }

    /// The largest difference of two solutions: angles modulo a turn, q and −q alike.
    pub fn difference(&self, x: &[C], y: &[C]) -> f64 {
        self.gaps(x, y).fold(0.0, f64::max).sqrt()
    }

    /// The solution `y` with the turns of its angles and the signs of its quaternions that
    /// bring it nearest to `x`.
    pub fn nearest_form(&self, x: &[C], y: &[C]) -> Vec<C> {
        let mut y = y.to_vec();
        let joints = self.free_joints.len();
        for ((x, y), &j) in x.iter().zip(&mut y).zip(&self.free_joints) {
            y.re = x.re + self.principal(j, y.re - x.re, 0.0);
        }
        let poses = x[joints..].chunks_exact(7);
        for (x, y) in poses.zip(y[joints..].chunks_exact_mut(7)) {
            let apart = |sign: f64| {
                let pairs = x[..4].iter().zip(&y[..4]);
                pairs.map(|(x, y)| (x - y * sign).norm_sqr()).sum::<f64>()
            };
            if apart(-1.0) < apart(1.0) {
                y[..4].iter_mut().for_each(|y| *y = -*y);
            }
        }
        y
    }

    /// True if two solutions differ by no more than `limit` in any coordinate.
    pub fn within(&self, limit: f64, x: &[C], y: &[C]) -> bool {
        self.gaps(x, y).all(|gap| gap <= limit * limit)
    }

    /// True if two solutions of a generic member are the same: their difference is small relative to their
    /// size. [`Coordinates::same_pose`] and [`Coordinates::same_way`] look at a part. At the inputs
    /// asked solutions may be nearer to each other: there the closures tell
    /// ([`are_one`](super::simple::are_one)).
    pub fn same(&self, x: &[C], y: &[C]) -> bool {
        all_small(self.gaps(x, y), x)
    }

    /// True if the platforms of two solutions have the same poses.
    pub fn same_pose(&self, x: &[C], y: &[C]) -> bool {
        all_small(pose_gaps(x, y), x)
    }

    /// True if joints at these places of the unknowns have the same values.
    pub fn same_way(&self, places: &[usize], x: &[C], y: &[C]) -> bool {
        all_small(self.joint_gaps(places.iter().copied(), x, y), x)
    }
}

fn all_small(mut gaps: impl Iterator<Item = f64>, x: &[C]) -> bool {
    let limit = SAME * (1.0 + size(x));
    gaps.all(|gap| gap <= limit * limit)
}

/// Squares of the differences of poses, q and −q alike.
fn pose_gaps<'a>(x: &'a [C], y: &'a [C]) -> impl Iterator<Item = f64> + 'a {
    let poses = x.chunks_exact(7).zip(y.chunks_exact(7));
    poses.flat_map(|(x, y)| {
        let turned = |sign: f64| {
            let gaps = x[..4].iter().zip(&y[..4]);
            gaps.map(|(x, y)| (*x - *y * sign).norm_sqr())
                .fold(0.0, f64::max)
        };
        let moved = x[4..].iter().zip(&y[4..]).map(|(x, y)| (x - y).norm_sqr());
        std::iter::once(turned(1.0).min(turned(-1.0))).chain(moved)
    })
}

/// Places of free joints that stand in one leg: those that affect one closure, or by closures that such
/// joints join.
fn legs<T: Factorable>(free_joints: &[usize], system: &System<T>) -> Vec<Vec<usize>> {
    let mut legs: Vec<Vec<usize>> = (0..free_joints.len()).map(|place| vec![place]).collect();
    for joints in system.joints_of_closures() {
        let touched = |leg: &Vec<usize>| {
            leg.iter()
                .any(|&place| joints.contains(&free_joints[place]))
        };
        let (joined, apart): (Vec<_>, Vec<_>) = legs.into_iter().partition(touched);
        legs = apart;
        if !joined.is_empty() {
            let mut joined = joined.concat();
            joined.sort_unstable();
            legs.push(joined);
        }
    }
    legs.sort();
    legs
}

/// The largest coordinate.
pub(crate) fn size(x: &[C]) -> f64 {
    x.iter().map(|z| z.norm_sqr()).fold(0.0, f64::max).sqrt()
}

/// True if a joint's own value is in polynomials, and its sine and cosine are in no equation.
fn is_algebraic(mechanism: &Mechanism, joint: usize) -> bool {
    let closures = mechanism.closures().iter();
    let closures = closures.zip(&mechanism.dimensions().closures);
    let mut own = closures
        .filter(|(named, _)| mechanism.joints_moving(named).contains(&joint))
        .peekable();
    own.peek().is_some()
        && own.all(|(_, of)| (of.relation.as_ref()).is_some_and(|of| of.is_polynomial()))
}

/// True if a joint makes something slide.
fn slides(dimensions: &Dimensions<f64>, joint: usize) -> bool {
    let rows = dimensions.chains.iter().flat_map(|chain| &chain.rows);
    let lengths = dimensions.closures.iter().map(|c| &c.extension);
    let mut forms = rows.map(|row| &row.slide).chain(lengths);
    forms.any(|form| form.coefficient(joint) != 0.0)
}
