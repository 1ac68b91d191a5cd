//! The solver of one question as a straight-line program: closure equations, Jacobian, elimination and the move along
//! the step, with nothing left in it that does not depend on inputs or unknowns.
//!
//! The one kinematics runs over recorded operations; nothing is derived a second time.

mod closed;
mod curvature;
mod follower;
mod forces;
mod iteration;
mod placing;
mod report;
mod variable;

pub use follower::{Follower, FollowerState};
pub use forces::forces;
pub use report::{
    ClosedProgram, Component, Divisor, ForceComponent, ForceProgram, FrameProgram, Radicand, Solver,
};

pub use crate::algebra::LEAST_PIVOT;
use crate::algebra::{Function, Recorded, eliminate, record};
use crate::geometry::{Quaternion, RollPitchYaw, Vector3};
use crate::linear::Factorable;
use crate::mechanism::{
    Configuration, Dimensions, Frame, Kinematics, Mechanism, PlatformPose, PoseCoordinate,
};
use crate::number::{Dual, Number};
use crate::solve::Equations;
use crate::system::{ClosedSolution, Coordinate, Held, HeldPlatform, Load, Question, System};
use iteration::{Iteration, OpenRows, negated, numbered, places};
use variable::StateVariable;

/// Reasons for which there is no solver.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoSolver {
    /// Nothing is unknown: the held coordinates determine every frame.
    #[error("there is nothing to solve: the held coordinates determine every frame")]
    NothingUnknown,
    /// Nothing is held, so that there is one configuration only.
    #[error("the mechanism cannot move, so that a solver would have no inputs")]
    NothingHeld,
    /// The configuration is singular, so that no order of elimination can be chosen there.
    #[error("the configuration is singular: {rank} of {unknowns} unknowns are determined there")]
    Singular {
        /// Unknowns that could be eliminated.
        rank: usize,
        /// All of them.
        unknowns: usize,
    },
    /// Forces are wanted where joints have friction.
    #[error("friction is in proportion to reactions, which no straight-line program finds")]
    Friction,
    /// Forces are wanted that follow from a function which needs a library.
    #[error("a force follows from `{}`, which needs a library of functions", _0.word())]
    Function(Function),
    /// Forces are wanted that the motion of the inputs does not determine.
    #[error("the forces at the inputs are not determined")]
    Undetermined,
}

/// Writes the solver of a question as a program.
///
/// Inputs are the held coordinates, the state is the value of every free joint and the pose of every free platform. `at`
/// is an assembled configuration; there the order of elimination is chosen: among entries of at least a tenth of the
/// largest in their column the one with the fewest others in its row and column (Markowitz 1957). For each of `frames`
/// the pose and the twists for unit rates of the inputs are written too, and with a load the forces that drive the inputs
/// against it, inertia included.
///
/// # Errors
/// If nothing is unknown or nothing held, the configuration is singular, or forces cannot be written.
pub fn solver(
    question: &Question,
    at: &Configuration<f64>,
    frames: &[(String, Frame)],
    load: Option<&Load>,
) -> Result<Solver, NoSolver> {
    let plan = VariablePlan::new(question);
    plan.check()?;
    let mechanism = question.mechanism();
    let (inputs, state) = plan.values(at);
    let start = [inputs.clone(), state.clone()].concat();
    let mut sample = start.clone();
    // steps of the unknowns, then rates, accelerations and time
    let system = System::new(mechanism.dimensions(), &plan.held);
    let first_rate = sample.len() + system.unknowns().len();
    sample.resize(first_rate, 0.0);
    sample.resize(first_rate + 2 * inputs.len() + 1, 0.1);
    // a platform to be found is not solved for in closed form
    let joints = plan
        .state
        .iter()
        .all(|of| matches!(of, StateVariable::Joint(_)));
    let solution = joints
        .then(|| ClosedSolution::of(question, at).ok())
        .flatten();
    let solution = solution.filter(|solution| solution.solves(question, at));
    let (written, operations) = record(sample, || {
        plan.write(question, solution.as_ref(), frames, load)
    });
    let written = written?;
    let missing = written
        .forces
        .as_ref()
        .and_then(|of| of.missing(&operations));
    if let Some(function) = missing {
        return Err(NoSolver::Function(function));
    }
    let components = |variables: &[StateVariable], values: &[f64]| -> Vec<Component> {
        let all = variables.iter().zip(values);
        all.map(|(variable, &value)| Component {
            name: variable.name(mechanism),
            unit: variable.unit(mechanism),
            value,
            limits: variable.limits(mechanism),
        })
        .collect()
    };
    let variables = [plan.inputs.clone(), plan.state.clone()].concat();
    let curvature = plan.curvature(&operations, &written.slopes.concat(), &variables, &start);
    Ok(Solver {
        curvature: curvature.largest,
        weights: curvature.weights,
        mechanism: mechanism.name().into(),
        inputs: components(&plan.inputs, &inputs),
        state: components(&plan.state, &state),
        centre: mechanism.dimensions().centre,
        operations,
        ..written
    })
}

/// The inputs and the state of a configuration.
pub fn values(question: &Question, at: &Configuration<f64>) -> (Vec<f64>, Vec<f64>) {
    VariablePlan::new(question).values(at)
}

/// The held and the unknown variables of a question.
#[derive(Clone, Debug)]
struct VariablePlan<'a> {
    mechanism: &'a Mechanism,
    held: Held<f64>,
    inputs: Vec<StateVariable>,
    state: Vec<StateVariable>,
}

impl<'a> VariablePlan<'a> {
    fn new(question: &Question<'a>) -> Self {
        let mechanism = question.mechanism();
        let held = question.held();
        let (mut inputs, mut state) = (Vec::new(), Vec::new());
        for (joint, held) in held.joints.iter().enumerate() {
            match held {
                true => inputs.push(StateVariable::Held(Coordinate::Joint(joint))),
                false => state.push(StateVariable::Joint(joint)),
            }
        }
        for (platform, part) in held.platforms.iter().enumerate() {
            for (c, _) in question.held_values(platform) {
                inputs.push(StateVariable::Held(Coordinate::Pose(platform, c)));
            }
            if *part != HeldPlatform::Pose {
                state.extend((0..4).map(|i| StateVariable::Orientation(platform, i)));
                state.extend((0..3).map(|i| StateVariable::Position(platform, i)));
            }
        }
        VariablePlan {
            mechanism,
            held,
            inputs,
            state,
        }
    }

    fn check(&self) -> Result<(), NoSolver> {
        match (self.state.is_empty(), self.inputs.is_empty()) {
            (true, _) => Err(NoSolver::NothingUnknown),
            (_, true) => Err(NoSolver::NothingHeld),
            _ => Ok(()),
        }
    }

    fn values(&self, at: &Configuration<f64>) -> (Vec<f64>, Vec<f64>) {
        let of = |variables: &[StateVariable]| {
            let values = variables.iter().map(|v| v.of(self.mechanism, at));
            values.collect()
        };
        (of(&self.inputs), of(&self.state))
    }

    /// The held coordinates and the configuration for given inputs and state.
    fn posed<T: Factorable>(&self, inputs: &[T], state: &[T]) -> (Held<T>, Configuration<T>) {
        let value = |variable: StateVariable| {
            let among = |of: &[StateVariable]| of.iter().position(|v| *v == variable);
            match among(&self.inputs) {
                Some(i) => inputs[i],
                None => state[among(&self.state).expect("every variable is held or unknown")],
            }
        };
        let held = |platform: usize, c: PoseCoordinate| {
            value(StateVariable::Held(Coordinate::Pose(platform, c)))
        };
        let angles = |platform: usize| RollPitchYaw {
            roll: held(platform, PoseCoordinate::Roll),
            pitch: held(platform, PoseCoordinate::Pitch),
            yaw: held(platform, PoseCoordinate::Yaw),
        };
        let mut holding = self.held.map(T::from_f64);
        for (platform, part) in holding.platforms.iter_mut().enumerate() {
            if let HeldPlatform::Partly(parts) = part {
                (parts.coordinates.iter_mut()).for_each(|(c, target)| *target = held(platform, *c));
                if let Some(orientation) = &mut parts.orientation {
                    *orientation = angles(platform).rotation();
                }
            }
        }
        let joints = self.held.joints.iter().enumerate();
        let joints = joints.map(|(joint, held)| match held {
            true => value(StateVariable::Held(Coordinate::Joint(joint))),
            false => value(StateVariable::Joint(joint)),
        });
        let platforms = holding.platforms.iter().enumerate();
        let platforms = platforms.map(|(platform, part)| match part {
            HeldPlatform::Pose => {
                let [x, y, z, ..] = PoseCoordinate::ALL;
                let place = Vector3([x, y, z].map(|c| held(platform, c)));
                PlatformPose {
                    orientation: angles(platform).quaternion(),
                    position: self.mechanism.to_centre(place),
                }
            }
            _ => {
                let q = [0, 1, 2, 3].map(|i| value(StateVariable::Orientation(platform, i)));
                PlatformPose {
                    orientation: Quaternion(q),
                    position: Vector3(
                        [0, 1, 2].map(|i| value(StateVariable::Position(platform, i))),
                    ),
                }
            }
        });
        let at = Configuration {
            joints: joints.collect(),
            platforms: platforms.collect(),
        };
        (holding, at)
    }

    fn dimensions<T: Number>(&self) -> Dimensions<T> {
        self.mechanism.dimensions().map(T::from_f64)
    }

    /// Writes everything; names, values and operations are filled in afterwards.
    fn write(
        &self,
        question: &Question,
        solution: Option<&ClosedSolution>,
        frames: &[(String, Frame)],
        load: Option<&Load>,
    ) -> Result<Solver, NoSolver> {
        let (given, kept) = (self.inputs.len(), self.state.len());
        let [inputs, state] = [0..given, given..given + kept]
            .map(|of| of.map(Recorded::input).collect::<Vec<Recorded>>());
        let (held, at) = self.posed(&inputs, &state);
        let dimensions = self.dimensions();
        let system = System::new(&dimensions, &held);
        let rows = OpenRows::of(&system, &at);
        let unknowns = system.unknowns().len();
        let mut sides = vec![rows.residual.clone()];
        sides.extend((0..given).map(|input| rows.among(&self.slope(input, &inputs, &state))));
        let (solutions, pivots) = eliminate(rows.jacobian.clone(), sides, unknowns)
            .map_err(|rank| NoSolver::Singular { rank, unknowns })?;
        let mut solutions = solutions.into_iter().map(negated);
        let step = solutions.next().expect("one for each side");
        let rates: Vec<Vec<Recorded>> = solutions.collect();
        let all = Iteration::of(&rows, step, pivots);
        let few = self.placing(&system, held, &dimensions, &at);
        let pivots = [Some(&all), few.as_ref()].into_iter().flatten();
        let pivots = pivots.flat_map(|of| of.placing.iter().chain(&of.pivots));
        let iteration = few.as_ref().unwrap_or(&all);
        let first_step = given + kept;
        let step: Vec<Recorded> = (first_step..first_step + unknowns)
            .map(Recorded::input)
            .collect();
        let moved = system.displaced(&at, &step);
        let moving: Vec<Configuration<Dual<Recorded>>> = (rates.iter().enumerate())
            .map(|(input, rates)| self.moving(input, (&inputs, &state), rates))
            .collect();
        let frames = frames.iter();
        let frames = frames.map(|(name, frame)| self.frame(name, *frame, &moving));
        Ok(Solver {
            unknowns,
            residual: places(&rows.residual),
            jacobian: rows.jacobian.iter().map(|row| places(row)).collect(),
            iterated: (iteration.rows.iter())
                .map(|(row, factor)| (row.place(), *factor))
                .collect(),
            pivots: pivots.filter_map(Divisor::of).collect(),
            slopes: iteration.jacobian.iter().map(|row| places(row)).collect(),
            rates: (moving.iter())
                .map(|at| {
                    let rate = |of: &StateVariable| of.of(self.mechanism, at).slope.place();
                    self.state.iter().map(rate).collect()
                })
                .collect(),
            step: numbered(&iteration.step),
            moved: (self.state.iter())
                .map(|variable| variable.of(self.mechanism, &moved).place())
                .collect(),
            placed: numbered(&iteration.placed),
            closed: solution.and_then(|solution| self.closed(solution, &at)),
            frames: frames.collect(),
            forces: load
                .map(|load| self.forces(question, load, &at, first_step + unknowns))
                .transpose()?,
            ..Solver::default()
        })
    }

    /// The derivatives of all rows by an input.
    fn slope(&self, input: usize, inputs: &[Recorded], state: &[Recorded]) -> Vec<Recorded> {
        let (inputs, state) = (varied(inputs, Some(input)), varied(state, None));
        let (held, at) = self.posed(&inputs, &state);
        let system = System::new(&self.dimensions(), &held);
        let mut work = system.work();
        system.residual(&at, &mut work);
        let rows = system.residual_of(&work).iter();
        rows.map(|row| row.slope).collect()
    }

    /// The configuration in motion at a unit rate of an input, from the rates of the unknowns.
    fn moving(
        &self,
        input: usize,
        (inputs, state): (&[Recorded], &[Recorded]),
        rates: &[Recorded],
    ) -> Configuration<Dual<Recorded>> {
        let (held, at) = self.posed(&varied(inputs, Some(input)), &varied(state, None));
        let rate = |&slope: &Recorded| Dual {
            value: Recorded::zero(),
            slope,
        };
        let step: Vec<Dual<Recorded>> = rates.iter().map(rate).collect();
        System::new(&self.dimensions(), &held).displaced(&at, &step)
    }

    /// The pose of a frame and its twists, from the configurations in motion at unit rates of the inputs.
    fn frame(
        &self,
        name: &str,
        frame: Frame,
        moving: &[Configuration<Dual<Recorded>>],
    ) -> FrameProgram {
        let kinematics = Kinematics::new(&self.dimensions(), [frame]);
        let mut placement = kinematics.placement();
        let mut pose = Vec::new();
        let mut twists = Vec::new();
        for at in moving {
            kinematics.place(at, &mut placement);
            let placed = kinematics.pose(frame, &placement);
            let placed = placed.expect("the plan has the frame");
            let axes = placed.rotation.0;
            // ω = ½ Σ aᵢ × ȧᵢ over the axes aᵢ of the frame
            let mut omega = Vector3::zero();
            for axis in axes {
                let (a, rate) = (axis.map(|x| x.value), axis.map(|x| x.slope));
                omega += a.cross(&rate).scaled(0.5);
            }
            let position = self.mechanism.to_ground(placed.position);
            let velocity = position.map(|x| x.slope);
            let twist = [velocity.0, omega.0].concat();
            twists.push(twist.iter().map(|x| x.place()).collect());
            pose = (axes.iter().chain([&position]))
                .flat_map(|column| column.0.map(|x| x.value.place()))
                .collect();
        }
        FrameProgram {
            name: name.into(),
            pose,
            twists,
        }
    }
}

/// Constants, but for the one that is the variable of differentiation.
fn varied(of: &[Recorded], variable: Option<usize>) -> Vec<Dual<Recorded>> {
    let numbers = of.iter().enumerate();
    numbers
        .map(|(i, &x)| match Some(i) == variable {
            true => Dual::variable(x),
            false => Dual::constant(x),
        })
        .collect()
}
