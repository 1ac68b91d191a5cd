//! The question posed at each node of a map.

use crate::geometry::{Pose, Rotation, Vector3};
use crate::linear::Factorable;
use crate::mechanism::{Configuration, Mechanism, PlatformPose, PoseCoordinate};
use crate::number::tolerance::ROUNDING;
use crate::system::{
    Coordinate, Driven, HeldPlatform, Lock, Question, System, actuated, coordinate_outputs,
    with_coordinates,
};

/// A question with some of its held coordinates mapped.
pub(crate) struct MapProblem<'m> {
    pub mechanism: &'m Mechanism,
    pub question: Question<'m>,
    pub axes: Vec<Driven>,
    /// All held coordinates, the mapped ones first. A whole orientation that is not mapped turns
    /// about the axes of ground.
    pub held: Vec<Coordinate>,
    /// The actuated joints, if there are as many as freedoms.
    pub inputs: Vec<Coordinate>,
    /// As many coordinates of platforms, if there are so many that are independent.
    pub outputs: Vec<Coordinate>,
    /// For each joint, true if whole turns of it change nothing that is held.
    pub turns: Vec<bool>,
}

impl<'m> MapProblem<'m> {
    /// `question` holds the mapped coordinates too.
    pub fn new(question: &Question<'m>, axes: &[Driven]) -> Self {
        let mechanism = question.mechanism();
        let mapped = |of: &Coordinate| axes.iter().any(|axis| axis.coordinate == *of);
        // roll, pitch and yaw of a platform stay what they are where one of them is mapped
        let turned = |platform: usize| {
            let of = |c: &Coordinate| matches!(c, Coordinate::Pose(p, c) if *p == platform && c.is_angle());
            axes.iter().any(|axis| of(&axis.coordinate))
        };
        let mut held: Vec<Coordinate> = axes.iter().map(|axis| axis.coordinate).collect();
        let asked = question.held_coordinates().into_iter();
        let asked = asked.zip(question.driven_coordinates());
        held.extend(
            asked
                .filter(|(of, _)| !mapped(of))
                .map(|(of, driven)| match driven {
                    Coordinate::Turn(platform, _) if turned(platform) => of,
                    driven => driven,
                }),
        );
        let outputs = coordinate_outputs(question, &held);
        let whole = |set: Vec<Coordinate>| match set.len() == held.len() {
            true => set,
            false => Vec::new(),
        };
        MapProblem {
            mechanism,
            question: question.clone(),
            axes: axes.to_vec(),
            inputs: whole(actuated(mechanism)),
            outputs: whole(outputs),
            held,
            turns: (question.held().joints.iter().enumerate())
                .map(|(joint, held)| !held && mechanism.repeats(joint))
                .collect(),
        }
    }

    /// The question at values of the mapped coordinates.
    pub fn at(&self, values: &[f64]) -> Question<'m> {
        let axes = self.axes.iter().map(|axis| axis.coordinate);
        self.question
            .clone()
            .at_values(axes.zip(values.iter().copied()))
    }

    /// True if direct singularities are other configurations than ends of modes, which they are where inputs are held.
    pub fn tells_direct(&self) -> bool {
        !self.inputs.is_empty() && !self.holds(&self.inputs)
    }

    /// True if inverse singularities are other configurations than ends of modes, which they are where outputs are
    /// held.
    pub fn tells_inverse(&self) -> bool {
        !self.outputs.is_empty() && !self.holds(&self.outputs)
    }

    /// The value of a joint in the turn of home and within limits; half a turn is positive.
    pub fn by_home(&self, joint: usize, value: f64) -> f64 {
        let home = self.mechanism.home_turn(joint);
        self.mechanism.turned_near(joint, value, home + ROUNDING)
    }

    pub fn allows(&self, joints: &[f64]) -> bool {
        self.mechanism.outside_limits(joints).next().is_none()
    }

    /// Locks of a motion with these coordinates at rest, and with the joints that stop local spins.
    pub fn locks(&self, of: &[Coordinate]) -> Vec<Lock> {
        let still = self.question.still().iter();
        let joints = still
            .filter_map(|still| still.joint())
            .map(Coordinate::Joint);
        (of.iter().copied().chain(joints).map(Lock::Coordinate)).collect()
    }

    /// True if exactly these coordinates are held.
    pub fn holds(&self, set: &[Coordinate]) -> bool {
        set.len() == self.held.len() && self.held.iter().all(|held| set.contains(held))
    }

    /// A configuration with the mapped and held values put in, whatever can be put in.
    pub fn put(&self, at: &Configuration<f64>, values: &[f64]) -> Configuration<f64> {
        let (mut to, start) = (at.clone(), self.at(values).start());
        let held = self.question.held();
        for (joint, value) in to.joints.iter_mut().enumerate() {
            if held.joints[joint] {
                *value = start.joints[joint];
            }
        }
        for (platform, held) in held.platforms.iter().enumerate() {
            if *held == HeldPlatform::Pose {
                to.platforms[platform] = start.platforms[platform];
            }
        }
        to
    }
}

/// Held values of the equations at a node.
#[derive(Clone, Debug)]
pub(crate) struct Targets {
    /// Mapped joints with the number of their axis.
    joints: Vec<(usize, usize)>,
    /// Mapped coordinates of platforms that are not held whole.
    single: Vec<(usize, PoseCoordinate, usize)>,
    /// Platforms of which an angle or the pose is mapped.
    whole: Vec<Whole>,
    /// The place in ground from which positions are measured, in m.
    centre: [f64; 3],
}

#[derive(Clone, Debug)]
struct Whole {
    platform: usize,
    pose: bool,
    /// Each coordinate with its axis, or else its value.
    sources: [(PoseCoordinate, Option<usize>, f64); 6],
}

impl Targets {
    pub fn new(problem: &MapProblem) -> Self {
        let held = problem.question.held();
        let start = problem.question.start();
        let mut targets = Targets {
            joints: Vec::new(),
            single: Vec::new(),
            whole: Vec::new(),
            centre: problem.mechanism.dimensions().centre,
        };
        for (i, axis) in problem.axes.iter().enumerate() {
            match axis.coordinate {
                Coordinate::Joint(joint) => targets.joints.push((joint, i)),
                Coordinate::Pose(platform, c) => {
                    let (pose, turned) = match &held.platforms[platform] {
                        HeldPlatform::Pose => (true, true),
                        HeldPlatform::Partly(parts) => {
                            (false, parts.orientation.is_some() && c.is_angle())
                        }
                        HeldPlatform::Free => (false, false),
                    };
                    if !turned {
                        targets.single.push((platform, c, i));
                    } else if targets.whole.iter().all(|w| w.platform != platform) {
                        let at = problem.mechanism.in_ground(&start.platforms[platform]);
                        let source = |c: PoseCoordinate| {
                            let of = Coordinate::Pose(platform, c);
                            let axis = problem.axes.iter().position(|a| a.coordinate == of);
                            (c, axis, c.of(&at))
                        };
                        targets.whole.push(Whole {
                            platform,
                            pose,
                            sources: PoseCoordinate::ALL.map(source),
                        });
                    }
                }
                Coordinate::Turn(..) => {}
            }
        }
        targets
    }

    /// Puts the values of mapped coordinates into a configuration, as far as it holds them.
    pub fn put(&self, at: &mut Configuration<f64>, values: &[f64]) {
        for &(joint, axis) in &self.joints {
            at.joints[joint] = values[axis];
        }
        for whole in self.whole.iter().filter(|whole| whole.pose) {
            at.platforms[whole.platform] = PlatformPose::from_pose(&whole.at(values, &self.centre));
        }
    }

    /// Numbers that the equations hold by rows, in the order of [`set`](Self::set).
    pub fn numbers(&self, values: &[f64]) -> impl Iterator<Item = f64> {
        let single = self.single.iter().map(|&(_, _, axis)| values[axis]);
        let turned = self.turned();
        let turned = turned.flat_map(|whole| {
            whole
                .at(values, &self.centre)
                .rotation
                .0
                .map(|column| column.0)
        });
        single.chain(turned.flatten())
    }

    /// Has the equations hold these numbers.
    pub fn set<T: Factorable>(&self, system: &mut System<T>, mut numbers: impl Iterator<Item = T>) {
        let mut next = || numbers.next().expect("as many as there are targets");
        for &(platform, c, _) in &self.single {
            system.set_target(platform, c, next());
        }
        for whole in self.turned() {
            let wanted = [(); 3].map(|()| Vector3([(); 3].map(|()| next())));
            system.set_orientation(whole.platform, Rotation(wanted));
        }
    }

    /// Puts the values of a node into the configuration and the equations.
    pub fn ask(&self, system: &mut System<f64>, at: &mut Configuration<f64>, values: &[f64]) {
        self.put(at, values);
        self.set(system, self.numbers(values));
    }

    fn turned(&self) -> impl Iterator<Item = &Whole> {
        self.whole.iter().filter(|whole| !whole.pose)
    }
}

impl Whole {
    /// Its pose, with its position from the centre.
    fn at(&self, values: &[f64], centre: &[f64; 3]) -> Pose<f64> {
        let sources = (self.sources.iter())
            .map(|&(c, axis, value)| (c, axis.map_or(value, |axis| values[axis])))
            .map(|(c, value)| (c, c.about_centre(value, centre)));
        with_coordinates(&Pose::identity(), sources)
    }
}
