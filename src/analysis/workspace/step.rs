//! From a node to its neighbour: several such steps side by side.

use super::asked::{Asked, Targets};
use super::grid::MOST_AXES;
use super::rates::{Rates, Told};
use crate::linear::Factorable;
use crate::mechanism::Configuration;
use crate::number::Packed;
use crate::solve::Equations;
use crate::system::{System, Work};

/// Where a step begins.
#[derive(Clone, Debug)]
pub(super) struct Start<'a> {
    pub from: &'a Configuration<f64>,
    /// A motion and how far along it what is looked for may be near.
    pub along: Option<(&'a [f64], f64)>,
    /// How far that may be, dimensionless; infinite if anything is as good.
    pub reach: f64,
    /// The mapped coordinates there, and zeros.
    pub values: [f64; MOST_AXES],
}

/// An assembled configuration at a node.
#[derive(Clone, Debug)]
pub(super) struct Arrival {
    pub at: Configuration<f64>,
    /// The motions for unit rates of the held coordinates one after another, the mapped ones first,
    /// dimensionless.
    pub motions: Vec<f64>,
    pub told: Told,
}

/// A configuration with its motions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving<'a> {
    pub at: &'a Configuration<f64>,
    pub motions: &'a [f64],
}

impl Arrival {
    pub fn moving(&self) -> Moving<'_> {
        Moving {
            at: &self.at,
            motions: &self.motions,
        }
    }
}

/// Newton's method in several places at once. A place whose steps are too long stands still from
/// there on and does no harm to the others.
#[derive(Clone, Debug)]
pub(super) struct Steps<T: Factorable> {
    targets: Targets,
    system: System<T>,
    work: Work<T>,
    point: Configuration<T>,
    spare: Configuration<T>,
    /// From where steps begin to near where they are to arrive.
    ahead: Vec<T>,
    rates: Rates<T>,
}

/// The part of a step that its first correction may be, and of a correction that the next may be:
/// beyond it another solution may be as near.
pub(super) const SURE: f64 = 0.3;

/// What came of a start.
enum Outcome {
    Arrived(Arrival),
    /// The steps are too long.
    Unsure,
    /// Rank is lost, which places side by side cannot lose one by one.
    Spoiled,
}

impl<T: Factorable + Packed> Steps<T> {
    pub fn new(asked: &Asked) -> Self {
        let system: System<T> = asked.question.system_over();
        Steps {
            targets: Targets::new(asked),
            work: system.work(),
            point: asked.question.start().map(T::from_f64),
            spare: asked.question.start().map(T::from_f64),
            ahead: Vec::new(),
            rates: Rates::new(asked, &system),
            system,
        }
    }

    /// The configurations that are surely meant; at most as many starts as places.
    pub fn settle(&mut self, starts: &[Start]) -> Vec<Option<Arrival>> {
        let ends = self.together(starts);
        let spoiled = ends.iter().any(|end| matches!(end, Outcome::Spoiled));
        let ends = ends.into_iter().zip(starts);
        let settled = ends.map(|(end, start)| match end {
            Outcome::Arrived(arrival) => Some(arrival),
            _ if !spoiled || starts.len() == 1 => None,
            // the same in all places
            _ => match self.together(std::slice::from_ref(start)).pop() {
                Some(Outcome::Arrived(arrival)) => Some(arrival),
                _ => None,
            },
        });
        settled.collect()
    }

    fn together(&mut self, starts: &[Start]) -> Vec<Outcome> {
        /// Corrections, and those from anywhere.
        const STEPS: [usize; 2] = [8, 20];
        const TOLERANCE: f64 = 1e-12;
        /// Corrections this small are rounding.
        const SMALL: f64 = 1e-9;
        let start = |place: usize| &starts[place.min(starts.len() - 1)];
        self.begin(&start);
        (self.targets).ask(&mut self.system, &mut self.point, |p| &start(p).values);
        let mut sure = vec![true; T::WIDTH];
        let mut solved = vec![false; T::WIDTH];
        let mut bounds: Vec<f64> = (0..T::WIDTH).map(|place| start(place).reach).collect();
        let most = STEPS[usize::from(bounds.iter().any(|bound| bound.is_infinite()))];
        for step in 0..=most {
            self.system.linearise(&self.point, &mut self.work);
            for (place, solved) in solved.iter_mut().enumerate() {
                let rows = self.system.residual_of(&self.work).iter();
                // a NaN is not small
                *solved = rows
                    .map(|row| row.part(place).abs())
                    .all(|row| row <= TOLERANCE);
            }
            let mut settled = solved.iter().zip(&sure);
            if step == most || settled.all(|(solved, sure)| *solved || !sure) {
                break;
            }
            self.system.factorise(0.0, &mut self.work);
            self.system.step(&mut self.work);
            let steps = self.system.step_mut(&mut self.work);
            let square = |place: usize| steps.iter().map(|x| x.part(place) * x.part(place)).sum();
            let sizes: Vec<f64> = (0..T::WIDTH).map(|p| f64::sqrt(square(p))).collect();
            let mut moves = vec![0.0; T::WIDTH];
            for place in 0..T::WIDTH {
                if solved[place] || !sure[place] {
                    continue;
                }
                let bound = &mut bounds[place];
                // what is not finite is not sure either
                sure[place] = sizes[place].is_finite() && sizes[place] <= bound.max(SMALL);
                if bound.is_finite() {
                    *bound = SURE * sizes[place];
                }
                moves[place] = f64::from(u8::from(sure[place]));
            }
            for x in steps.iter_mut() {
                let old = *x;
                // not a product: what is not finite is to stay behind
                *x = T::of_parts(|p| if moves[p] > 0.0 { old.part(p) } else { 0.0 });
            }
            let (from, to) = (&self.point, &mut self.spare);
            self.system.advance(from, 1.0, &self.work, to);
            std::mem::swap(&mut self.point, &mut self.spare);
        }
        if !solved
            .iter()
            .zip(&sure)
            .any(|(solved, sure)| *solved && *sure)
        {
            return starts.iter().map(|_| Outcome::Unsure).collect();
        }
        let told = (self.rates).at(&self.point, &self.system, &mut self.work);
        let outcomes = told.into_iter().take(starts.len()).enumerate();
        let outcomes = outcomes.map(|(place, told)| match told.regular {
            _ if !sure[place] || !solved[place] => Outcome::Unsure,
            false => Outcome::Spoiled,
            true => Outcome::Arrived(Arrival {
                at: self.point.map(|x| x.part(place)),
                motions: self.rates.motions(place),
                told,
            }),
        });
        outcomes.collect()
    }

    /// What is told of a configuration that solves the equations for its mapped coordinates.
    pub fn told(&mut self, at: &Configuration<f64>, values: &[f64]) -> Option<Told> {
        let mut point = at.map(T::from_f64);
        (self.targets).ask(&mut self.system, &mut point, |_| values);
        self.system.linearise(&point, &mut self.work);
        let told = self.rates.at(&point, &self.system, &mut self.work);
        told.into_iter().next()
    }

    /// Puts the point near where each place is to arrive.
    fn begin<'s, 'a: 's>(&mut self, start: &impl Fn(usize) -> &'s Start<'a>) {
        let at = |place: usize| start(place).from;
        for (joint, to) in self.point.joints.iter_mut().enumerate() {
            *to = T::of_parts(|place| at(place).joints[joint]);
        }
        for (platform, to) in self.point.platforms.iter_mut().enumerate() {
            let pose = |place: usize| &at(place).platforms[platform];
            for (k, to) in to.orientation.0.iter_mut().enumerate() {
                *to = T::of_parts(|place| pose(place).orientation.0[k]);
            }
            for (k, to) in to.position.0.iter_mut().enumerate() {
                *to = T::of_parts(|place| pose(place).position.0[k]);
            }
        }
        if (0..T::WIDTH).all(|place| start(place).along.is_none()) {
            return;
        }
        let part = |place: usize, k: usize| match start(place).along {
            Some((motion, factor)) => motion[k] * factor,
            None => 0.0,
        };
        let steps = (0..self.rates.unknowns()).map(|k| T::of_parts(|place| part(place, k)));
        self.ahead.clear();
        self.ahead.extend(steps);
        self.rates.displace(&mut self.point, &self.ahead);
    }
}
