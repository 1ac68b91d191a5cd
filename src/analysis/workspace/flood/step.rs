//! From a node to its neighbour: several such steps side by side.

use super::arrivals::Arrivals;
use crate::analysis::workspace::problem::{
    Indicators, MOST_AXES, MapProblem, Rates, Targets, side_by_side,
};
use crate::linear::Factorable;
use crate::mechanism::{Configuration, ConfigurationRef};
use crate::number::{LANES, Packed};
use crate::solve::Equations;
use crate::system::{System, Work};

/// Where a step begins.
#[derive(Clone, Debug)]
pub(crate) struct Start<'a> {
    pub from: ConfigurationRef<'a, f64>,
    /// A tangent and how far along it the solution is expected.
    pub along: Option<(&'a [f64], f64)>,
    /// How far that may be, dimensionless; infinite if anything is as good.
    pub reach: f64,
    /// The mapped coordinates there, and zeros.
    pub values: [f64; MOST_AXES],
}

/// Newton's method in several places at once. One whose steps are too long stands still from there on.
#[derive(Clone, Debug)]
pub(crate) struct Steps<T: Factorable> {
    targets: Targets,
    system: System<T>,
    work: Work<T>,
    point: Configuration<T>,
    spare: Configuration<T>,
    /// Starting points and predicted end points of steps.
    ahead: Vec<T>,
    rates: Rates<T>,
}

/// Part of a step that its first correction may be, and so on: beyond it others may be as near.
pub(crate) const SURE: f64 = 0.3;

impl<T: Factorable + Packed> Steps<T> {
    pub fn new(problem: &MapProblem) -> Self {
        let system: System<T> = problem.question.system_over();
        Steps {
            targets: Targets::new(problem),
            work: system.work(),
            point: problem.question.start().map(T::from_f64),
            spare: problem.question.start().map(T::from_f64),
            ahead: Vec::new(),
            rates: Rates::new(problem, &system),
            system,
        }
    }

    /// The solutions the starts certainly lead to; at most as many starts as lanes.
    pub fn settle(&mut self, starts: &[Start], arrivals: &mut Arrivals) {
        arrivals.begin(starts.len());
        let spoiled = self.together(starts, 0, arrivals);
        if !spoiled || starts.len() == 1 {
            return;
        }
        for (i, start) in starts.iter().enumerate() {
            if arrivals.get(i).is_none() {
                // the same in all places
                self.together(std::slice::from_ref(start), i, arrivals);
            }
        }
    }

    /// The same side by side, the first with this number; whether rank is lost, which spoils them all.
    fn together(&mut self, starts: &[Start], first: usize, arrivals: &mut Arrivals) -> bool {
        /// Corrections, and those from anywhere.
        const STEPS: [usize; 2] = [8, 20];
        const TOLERANCE: f64 = 1e-12;
        /// Corrections this small are rounding.
        const SMALL: f64 = 1e-9;
        let start = |place: usize| &starts[place.min(starts.len() - 1)];
        self.begin(&start);
        (self.targets).ask(&mut self.system, &mut self.point, |p| &start(p).values);
        let places = 0..T::WIDTH;
        let mut sure = [true; LANES];
        let mut solved = [false; LANES];
        let mut bounds = [0.0; LANES];
        for place in places.clone() {
            bounds[place] = start(place).reach;
        }
        let far = bounds.iter().any(|bound| bound.is_infinite());
        let most = STEPS[usize::from(far)];
        for step in 0..=most {
            self.system.linearise(&self.point, &mut self.work);
            solved = [true; LANES];
            for row in self.system.residual_of(&self.work) {
                for place in places.clone() {
                    // a NaN is not small
                    solved[place] &= row.part(place).abs() <= TOLERANCE;
                }
            }
            if step == most || places.clone().all(|p| solved[p] || !sure[p]) {
                break;
            }
            self.system.factorise(0.0, &mut self.work);
            self.system.step(&mut self.work);
            let steps = self.system.step_mut(&mut self.work);
            let squares = steps.iter().fold(T::zero(), |sum, x| sum + *x * *x);
            let sizes = squares.sqrt();
            let mut moves = [false; LANES];
            for place in places.clone() {
                if solved[place] || !sure[place] {
                    continue;
                }
                let (size, bound) = (sizes.part(place), &mut bounds[place]);
                // values that are not finite are rejected too
                sure[place] = size.is_finite() && size <= bound.max(SMALL);
                if bound.is_finite() {
                    *bound = SURE * size;
                }
                moves[place] = sure[place];
            }
            if places.clone().any(|place| !moves[place]) {
                for x in steps.iter_mut() {
                    let old = *x;
                    // a selection and not a product, so that values that are not finite are dropped
                    *x = T::of_parts(|p| if moves[p] { old.part(p) } else { 0.0 });
                }
            }
            let (from, to) = (&self.point, &mut self.spare);
            self.system.advance(from, 1.0, &self.work, to);
            std::mem::swap(&mut self.point, &mut self.spare);
        }
        if !places.clone().any(|place| solved[place] && sure[place]) {
            return false;
        }
        let indicators = (self.rates).at(&self.point, &self.system, &mut self.work);
        let mut spoiled = false;
        let mut arrived: [Option<Indicators>; LANES] = Default::default();
        let places = places.take(starts.len());
        for place in places.clone().filter(|p| solved[*p] && sure[*p]) {
            spoiled |= !indicators[place].regular;
            arrived[place] = indicators[place].regular.then(|| indicators[place].clone());
        }
        let motions = self.rates.motions();
        arrivals.put(first, &self.point, motions, &arrived[..places.len()]);
        spoiled
    }

    /// The indicators of a configuration that solves the equations for its mapped coordinates.
    pub fn indicators(&mut self, at: &Configuration<f64>, values: &[f64]) -> Indicators {
        let mut point = at.map(T::from_f64);
        (self.targets).ask(&mut self.system, &mut point, |_| values);
        self.system.linearise(&point, &mut self.work);
        let [indicators, ..] = self.rates.at(&point, &self.system, &mut self.work);
        indicators
    }

    /// Puts the point near where each place is to arrive.
    fn begin<'s, 'a: 's>(&mut self, start: &impl Fn(usize) -> &'s Start<'a>) {
        let at = |place: usize| start(place).from;
        for (joint, to) in self.point.joints.iter_mut().enumerate() {
            *to = T::of_parts(|place| at(place).joints[joint]);
        }
        for (platform, to) in self.point.platforms.iter_mut().enumerate() {
            *to = side_by_side(|place| at(place).platforms[platform]);
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
