//! Ways through the family along which the trace test goes.

use rand_pcg::Pcg64;

use super::coordinates::{C, Input};
use super::{Family, Length, Member};
use crate::analysis::assemblies::report::Traced;

/// A way through the family along which solutions are algebraic in one variable t.
#[derive(Clone, Debug, Default)]
pub(crate) struct Direction {
    /// Places of the parameters that move.
    parameters: Vec<usize>,
    /// Places of the flat inputs that move.
    inputs: Vec<usize>,
    /// Turns after which the one angle that moves repeats: t is the exponential of i times the angle over them. Without
    /// an angle t is the way itself.
    turns: Option<f64>,
}

impl Direction {
    /// The rate of log t on the way from one member to another, if t is an exponential.
    pub fn turning(&self, from: &Member, to: &Member) -> Option<C> {
        let place = *self.inputs.first()?;
        let turns = self.turns?;
        Some((to.inputs[place] - from.inputs[place]) * C::new(0.0, 1.0 / turns))
    }
}

impl Family {
    /// Directions that make up all motions of the inputs: lengths and poses together, each angle by itself; the
    /// rods, or without any all dimensions, where these make the family; none if nothing moves. `None` if an angle never
    /// comes back to the same place.
    pub fn directions(&self) -> Option<Vec<Direction>> {
        let (mut straight, mut directions) = (Vec::new(), Vec::new());
        if self.by_dimensions {
            let rods = self.moved_by_trace() == Traced::Rods;
            let mut parameters: Vec<usize> = (0..self.parameters.len()).collect();
            parameters.retain(|place| !rods || self.is_rod(*place));
            let moves = !parameters.is_empty();
            directions.extend(moves.then(|| Direction {
                parameters,
                ..Direction::default()
            }));
            return Some(directions);
        }
        let mut places = 0..;
        for &input in &self.coordinates.inputs {
            let turns = match input {
                Input::Joint(j) => self.turns(j),
                Input::Target(_, coordinate) => coordinate.is_angle().then_some(Some(1.0)),
                Input::Pose(_) | Input::Orientation(_) => None,
            };
            let own = places.by_ref().take(input.width());
            match turns {
                None => straight.extend(own),
                Some(turns) => directions.push(Direction {
                    inputs: own.collect(),
                    turns: Some(turns?),
                    ..Direction::default()
                }),
            }
        }
        if !straight.is_empty() {
            directions.push(Direction {
                inputs: straight,
                ..Direction::default()
            });
        }
        Some(directions)
    }

    /// True if a parameter is the factor of a rod.
    fn is_rod(&self, place: usize) -> bool {
        let named = self.parameters.len() - self.lengths.len();
        let factor = place.checked_sub(named).map(|i| self.lengths[i]);
        matches!(factor, Some(Length::Rod { .. }))
    }

    /// The family that the trace test moves.
    pub fn moved_by_trace(&self) -> Traced {
        let mut places = 0..self.parameters.len();
        match self.by_dimensions {
            false => Traced::Inputs,
            true if places.any(|place| self.is_rod(place)) => Traced::Rods,
            true => Traced::Parameters,
        }
    }

    /// Another member in a direction.
    pub fn moved(&self, from: &Member, direction: &Direction, rng: &mut Pcg64) -> Member {
        let mut to = from.clone();
        let inputs = self.random_inputs(rng, 1.0);
        (direction.inputs.iter()).for_each(|&place| to.inputs[place] = inputs[place]);
        let parameters = self.random_parameters(rng, 1.0);
        (direction.parameters.iter()).for_each(|&place| to.parameters[place] = parameters[place]);
        to
    }
}
