//! Inverse dynamics: the forces that drive the inputs, from the one balance that all analyses of forces use.

use super::{NoSolver, StateVariable, VariablePlan};
use crate::algebra::{Function, Operation, OperationIndex, Recorded, needed};
use crate::linear::Factorable;
use crate::mechanism::Configuration;
use crate::system::{Balance, Coordinate, Instant, Load, Motion, Question};

use super::report::{ForceComponent, ForceProgram};

/// The forces at the inputs over any numbers.
struct DrivingForces<T: Factorable> {
    motion: Motion<T>,
    balance: Balance<T>,
}

impl<T: Factorable> DrivingForces<T> {
    fn new(question: &Question, coordinates: &[Coordinate], load: &Load) -> Self {
        let mechanism = question.mechanism();
        let frames = Balance::<T>::frames(mechanism, load, false);
        let motion = Motion::placing(mechanism, coordinates, &frames, |held| {
            question.with_still(held)
        });
        let kinematics = motion.kinematics().clone();
        DrivingForces {
            balance: Balance::new(mechanism, load, &motion, &kinematics, false),
            motion,
        }
    }

    /// The force or moment at each input for its rates and accelerations; `None` at a singular configuration.
    fn forces(
        &mut self,
        at: &Configuration<T>,
        [rates, changes]: [&[T]; 2],
        time: T,
    ) -> Option<Vec<T>> {
        let motion = &mut self.motion;
        motion.at(at);
        if !motion.is_determined() {
            return None;
        }
        let responses = motion.responses();
        motion.set_rates(&responses, rates);
        motion.accelerations(changes);
        let responses: Vec<(&[T], bool)> = responses.iter().map(|of| (&of[..], true)).collect();
        let instant = Instant {
            pace: [T::one(), T::zero()],
            time,
            impending: None,
        };
        self.balance.at(motion, at, &responses, instant);
        Some(self.balance.forces.clone())
    }
}

/// The force or moment that drives each input of a solver at given inputs and state, for rates and accelerations of the
/// inputs at a time in s; `None` at a singular configuration.
pub fn forces(
    question: &Question,
    load: &Load,
    (inputs, state): (&[f64], &[f64]),
    driven: [&[f64]; 2],
    time: f64,
) -> Option<Vec<f64>> {
    let plan = VariablePlan::new(question);
    let (_, at) = plan.posed(inputs, state);
    DrivingForces::new(question, &plan.coordinates(), load).forces(&at, driven, time)
}

impl VariablePlan<'_> {
    /// The held coordinates in the order of the inputs.
    fn coordinates(&self) -> Vec<Coordinate> {
        let coordinate = |of: &StateVariable| match of {
            StateVariable::Held(coordinate) => Some(*coordinate),
            _ => None,
        };
        self.inputs.iter().filter_map(coordinate).collect()
    }

    /// The program of the forces. Its further inputs are numbered from `first`: rates of the inputs, their accelerations,
    /// the time.
    pub(super) fn forces(
        &self,
        question: &Question,
        load: &Load,
        at: &Configuration<Recorded>,
        first: usize,
    ) -> Result<ForceProgram, NoSolver> {
        if load.has_friction() {
            return Err(NoSolver::Friction);
        }
        let coordinates = self.coordinates();
        let count = coordinates.len();
        let inputs = |from: usize| -> Vec<Recorded> {
            (first + from..first + from + count)
                .map(Recorded::input)
                .collect()
        };
        let (rates, changes) = (inputs(0), inputs(count));
        let time = Recorded::input(first + 2 * count);
        let before = Recorded::decisions().len();
        let found =
            DrivingForces::new(question, &coordinates, load).forces(at, [&rates, &changes], time);
        let found = found.ok_or(NoSolver::Undetermined)?;
        let component = |(of, force): (&Coordinate, &Recorded)| ForceComponent {
            unit: of.force_unit(self.mechanism),
            place: force.place(),
        };
        Ok(ForceProgram {
            forces: coordinates.iter().zip(&found).map(component).collect(),
            decisions: Recorded::decisions().split_off(before),
        })
    }
}

impl ForceProgram {
    /// A function that follows from no operation of the generated languages, if the forces call one.
    pub(super) fn missing(&self, operations: &[Operation]) -> Option<Function> {
        let mut places: Vec<OperationIndex> = self.forces.iter().map(|of| of.place).collect();
        let needed = needed(operations, &mut places);
        needed.into_iter().find_map(|of| match of {
            Operation::Call(function @ (Function::Exp | Function::Ln), _) => Some(function),
            _ => None,
        })
    }
}
