//! Rest positions as solutions of algebraic equations.

mod terms;

use nalgebra::{DMatrix, DVector};

use super::{Coordinate, FrameTwists, Held, Load, System};
use crate::algebra::{Operation, OperationIndex, Recorded, needed, record, run};
use crate::mechanism::{Configuration, JointKind, Mechanism, Point};
use crate::number::tolerance::{RANK_TOLERANCE, ROUNDING};
use crate::number::{C, Dual, Gradient, Number};
use crate::solve::{Equations, Homotopy};
use terms::terms;

type G = Gradient<Dual<Recorded>>;

/// Stationary points of the Lagrangian
///
/// 𝓛 = Σ −w·c(x) + Σ (½ k ℓ² + b ℓ + μ (|d(x)|² − ℓ²)) + Σ (½ k xⱼ² + b xⱼ) + Σ (α cos xⱼ + β sin xⱼ) + λ·r(x)
///
/// of weights w at points c, springs over the lengths ℓ of lines d and at slides xⱼ, terms of hinges that vanish for the
/// mechanism, and the closures r: as many equations as unknowns x, ℓ, μ and λ. They are linear in the parameters w, k, b, α
/// and β, and all lengths are unknowns of their own, so that they are algebraic in slides and in the sines and cosines of
/// hinges. Written down as a program with their derivatives.
#[derive(Clone, Debug)]
pub struct RestEquations {
    operations: Vec<Operation>,
    /// The gradient, its change with the parameters, and the Hessian row by row.
    places: Vec<OperationIndex>,
    terms: Vec<Term>,
    /// The joints that are free.
    pub joints: Vec<usize>,
    /// Number of lengths among the unknowns.
    pub lengths: usize,
    closures: usize,
    /// The parameters of the mechanism.
    pub parameters: Vec<C>,
}

/// A part of the energy, with as many parameters of its own.
#[derive(Clone, Copy, Debug)]
enum Term {
    /// A force at a point, given by its number: three parameters.
    Force(usize),
    /// A spring over the distance of two points, with its length among the unknowns or, where b is zero, without: k, and b.
    Line([usize; 2], bool),
    /// A spring at a slide: k and b.
    Slide(usize),
    /// A moment at a hinge: b.
    Hinge(usize),
    /// α cos x + β sin x of a hinge that repeats after so many turns.
    Turn(usize, f64),
}

/// Reasons for which equations of rest are not algebraic.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum NotAlgebraic {
    /// A torsion spring, by its name.
    TorsionSpring(String),
    /// A spring that only pulls or only pushes.
    OneWay(String),
    /// A force that is not constant, or a moment in space.
    Force(String),
    /// A joint that belongs to a gear, or slides as it turns.
    Joint(String),
    /// Platforms with coordinates of their own, or local spins.
    Platforms,
    /// The closures depend on one another, so that reactions are not unique.
    Overconstrained,
    /// More unknowns than are followed.
    Large,
}

/// The most unknowns.
const MOST: usize = 24;

impl RestEquations {
    /// The equations with these coordinates locked where they are.
    ///
    /// # Errors
    /// If they are not algebraic.
    pub fn new(
        mechanism: &Mechanism,
        load: &Load,
        locked: &[Coordinate],
        at: &Configuration<f64>,
    ) -> Result<Self, NotAlgebraic> {
        if !mechanism.platforms().is_empty() {
            return Err(NotAlgebraic::Platforms);
        }
        let mut held = Held::nothing(mechanism);
        for of in locked {
            if let Coordinate::Joint(joint) = of {
                held.joints[*joint] = true;
            }
        }
        let joints = (0..held.joints.len()).filter(|joint| !held.joints[*joint]);
        let joints: Vec<usize> = joints.collect();
        for joint in &joints {
            let of = &mechanism.joints()[*joint];
            let turns =
                of.kind == JointKind::Prismatic || mechanism.turns_to_repeat(*joint).is_some();
            if !turns {
                return Err(NotAlgebraic::Joint(of.name.clone()));
            }
        }
        let points = load.points();
        let (mut terms, mut parameters) = terms(mechanism, load, &points)?;
        // nothing of these acts; with them the parameters change the balance along every joint wherever it is, so that all
        // solutions over one component of the closures belong together
        for joint in &joints {
            terms.push(match mechanism.turns_to_repeat(*joint) {
                Some(turns) => Term::Turn(*joint, turns),
                None => Term::Slide(*joint),
            });
            parameters.extend([C::zero(); 2]);
        }
        let lengths = terms
            .iter()
            .filter(|of| matches!(of, Term::Line(_, true)))
            .count();
        let mut equations = RestEquations {
            operations: Vec::new(),
            places: Vec::new(),
            terms,
            joints,
            lengths,
            closures: 0,
            parameters,
        };
        let plain = System::reduced(mechanism, mechanism.dimensions(), &held);
        equations.closures = plain.rows();
        if equations.count() > MOST {
            return Err(NotAlgebraic::Large);
        }
        let parameters = equations.parameters.len();
        let mut sample: Vec<f64> = equations.parameters.iter().map(|p| p.re).collect();
        sample.resize(2 * parameters + equations.count(), 1.0);
        let inputs = sample.len();
        let (places, operations) = record(sample, || {
            let inputs: Vec<Recorded> = (0..inputs).map(Recorded::input).collect();
            let places = equations.written(mechanism, (&held, &points), at, &inputs);
            Recorded::decisions().is_empty().then_some(places)
        });
        let mut places = places.ok_or(NotAlgebraic::Large)?;
        equations.operations = needed(&operations, &mut places);
        equations.places = places;
        Ok(equations)
    }

    /// The number of unknowns: dimensionless joints, lengths, and multipliers.
    pub fn count(&self) -> usize {
        self.joints.len() + 2 * self.lengths + self.closures
    }

    fn written(
        &self,
        mechanism: &Mechanism,
        (held, points): (&Held<f64>, &[Point]),
        at: &Configuration<f64>,
        inputs: &[Recorded],
    ) -> Vec<OperationIndex> {
        const LANES: usize = Gradient::LANES;
        let constant = |x: Recorded| G::constant(Dual::constant(x));
        let dimensions = mechanism.dimensions().map(G::from_f64);
        let frames: Vec<_> = points.iter().map(|point| point.frame).collect();
        let held = held.map(G::from_f64);
        let system = System::placing(mechanism, &dimensions, &held, &frames);
        let mut work = system.work();
        let twists =
            FrameTwists::sharing(system.kinematics(), &dimensions, system.unknowns(), points);
        let length = 1.0 / mechanism.characteristic_length();
        let count = self.count();
        let (parameters, unknowns) = inputs.split_at(2 * self.parameters.len());
        let parameters: Vec<G> = parameters.iter().map(|x| constant(*x)).collect();
        let (given, change) = parameters.split_at(self.parameters.len());
        let mut gradient = vec![[Recorded::zero(); 2]; count];
        let mut hessian = vec![Recorded::zero(); count * count];
        // eight directions at once, and one after another
        let blocks = (0..count).step_by(LANES);
        for (first, second) in blocks.flat_map(|i| (0..count).map(move |j| (i, j))) {
            let variable = |(i, x): (usize, &Recorded)| {
                let slope = Recorded::from_f64(f64::from(u8::from(i == second)));
                let outer = G::constant(Dual { value: *x, slope });
                match i.checked_sub(first).filter(|lane| *lane < LANES) {
                    Some(lane) => outer + G::variable(Dual::zero(), lane),
                    None => outer,
                }
            };
            let all: Vec<G> = unknowns.iter().enumerate().map(variable).collect();
            let (x, rest) = all.split_at(self.joints.len());
            let (lines, closures) = rest.split_at(2 * self.lengths);
            let mut here = at.map(G::from_f64);
            for (joint, x) in self.joints.iter().zip(x) {
                here.joints[*joint] = x.scale(mechanism.dimensions().joint_scales[*joint]);
            }
            system.residual(&here, &mut work);
            let place = |i: usize| twists.origin(i, system.placement(&work)).scaled(length);
            // with the equations of lengths, or without
            let value = |parameters: &[G], tied: bool| {
                let (mut sum, mut next, mut line) = (G::zero(), 0, 0);
                let mut take = || {
                    next += 1;
                    parameters[next - 1]
                };
                for term in &self.terms {
                    match *term {
                        Term::Force(i) => {
                            let force = [take(), take(), take()];
                            let all = force.into_iter().zip(place(i).0);
                            sum = all.fold(sum, |sum, (w, c)| sum - w * c);
                        }
                        Term::Line([a, b], is_unknown) => {
                            let apart = place(b) - place(a);
                            let square = apart.dot(&apart);
                            if !is_unknown {
                                sum += (take() * square).scale(0.5);
                                continue;
                            }
                            let [size, multiplier] = [lines[line], lines[line + 1]];
                            line += 2;
                            sum += (take() * size * size).scale(0.5) + take() * size;
                            if tied {
                                sum += multiplier * (square - size * size);
                            }
                        }
                        Term::Slide(joint) => {
                            let scale = mechanism.dimensions().joint_scales[joint];
                            let x = here.joints[joint].scale(1.0 / scale);
                            sum += (take() * x * x).scale(0.5) + take() * x;
                        }
                        Term::Hinge(joint) => sum += take() * here.joints[joint],
                        Term::Turn(joint, turns) => {
                            let (sin, cos) = here.joints[joint].scale(1.0 / turns).sin_cos();
                            sum += take() * cos + take() * sin;
                        }
                    }
                }
                sum
            };
            let residual = system.residual_of(&work).iter().zip(closures);
            let tied = residual.fold(G::zero(), |sum, (r, multiplier)| sum + *multiplier * *r);
            let [value, change] = [value(given, true) + tied, value(change, false)];
            for i in first..count.min(first + LANES) {
                gradient[i] = [value, change].map(|of| of.slopes[i - first].value);
                hessian[i * count + second] = value.slopes[i - first].slope;
            }
        }
        let values = gradient.iter().map(|of| of[0]);
        let rates = gradient.iter().map(|of| of[1]);
        let all = values.chain(rates).chain(hessian);
        all.map(Recorded::place).collect()
    }

    /// The equations, their change, and the Hessian at a point, for parameters and a change of these.
    fn at(
        &self,
        [parameters, change]: [&[C]; 2],
        x: &[C],
        values: &mut Vec<C>,
    ) -> ([DVector<C>; 2], DMatrix<C>) {
        let inputs: Vec<C> = [parameters, change, x].concat();
        run(&self.operations, &inputs, values);
        let n = self.count();
        let entry = |i: usize| values[self.places[i] as usize];
        let vector = |from: usize| DVector::from_fn(n, |i, _| entry(from + i));
        let hessian = DMatrix::from_fn(n, n, |i, j| entry(2 * n + i * n + j));
        ([vector(0), vector(n)], hessian)
    }

    /// A point on the closures near one, with parameters and multipliers near others for which it is a rest position; `None`
    /// if it is not reached, or if reactions or parameters are not independent there.
    pub fn resting(&self, mut x: Vec<C>, near: &[C]) -> Option<(Vec<C>, Vec<C>)> {
        let (n, joints, p) = (self.count(), self.joints.len(), self.parameters.len());
        let first = joints + 2 * self.lengths;
        let none = vec![C::zero(); p];
        let mut values = Vec::new();
        // shortest solutions of underdetermined equations
        let shortest = |rows: &DMatrix<C>, right: &DVector<C>| {
            let square = rows * rows.adjoint();
            Some(rows.adjoint() * square.lu().solve(right)?)
        };
        let mut closed = self.closures == 0;
        for _ in 0..40 {
            if closed {
                break;
            }
            let ([residual, _], hessian) = self.at([&none, &none], &x, &mut values);
            let rows = hessian.view((first, 0), (n - first, joints)).into_owned();
            let step = shortest(&rows, &residual.rows(first, n - first).into_owned())?;
            x.iter_mut().zip(step.iter()).for_each(|(x, d)| *x -= *d);
            closed = largest(&step) < 1e-12;
        }
        if !closed {
            return None;
        }
        x[joints..].fill(C::zero());
        let ([squares, _], _) = self.at([&none, &none], &x, &mut values);
        for line in (joints..first).step_by(2) {
            x[line] = Number::sqrt(squares[line + 1]);
        }
        // the rest is linear in multipliers and parameters
        let (_, hessian) = self.at([&none, &none], &x, &mut values);
        let multipliers = (joints..first).skip(1).step_by(2).chain(first..n);
        let multipliers: Vec<usize> = multipliers.collect();
        let rows = (0..joints).chain((joints..first).step_by(2));
        let rows: Vec<usize> = rows.collect();
        let mut columns = DMatrix::zeros(rows.len(), multipliers.len() + p);
        for (c, multiplier) in multipliers.iter().enumerate() {
            let column = rows.iter().map(|row| hessian[(*row, *multiplier)]);
            column.enumerate().for_each(|(r, x)| columns[(r, c)] = x);
        }
        for i in 0..p {
            let mut unit = none.clone();
            unit[i] = C::one();
            let ([_, rates], _) = self.at([&none, &unit], &x, &mut values);
            let column = rows.iter().map(|row| rates[*row]);
            column
                .enumerate()
                .for_each(|(r, x)| columns[(r, multipliers.len() + i)] = x);
        }
        let start = vec![C::one(); multipliers.len()];
        let start = DVector::from_vec([&start[..], near].concat());
        let off = &columns * &start;
        let found = start - shortest(&columns, &off)?;
        for (multiplier, value) in multipliers.iter().zip(found.iter()) {
            x[*multiplier] = *value;
        }
        let parameters: Vec<C> = found.iter().skip(multipliers.len()).copied().collect();
        let ([left, _], hessian) = self.at([&parameters, &none], &x, &mut values);
        // singular values of what is not a number would be sought without end
        let solved = largest(&left) < ROUNDING && hessian.iter().all(|x| Number::is_finite(*x));
        let regular = solved.then(|| hessian.singular_values())?;
        (regular.min() > RANK_TOLERANCE * regular.max()).then_some((parameters, x))
    }

    /// The way from some parameters to others.
    pub fn way(&self, from: &[C], to: &[C]) -> RestWay<'_> {
        RestWay {
            of: self,
            from: from.to_vec(),
            change: to.iter().zip(from).map(|(b, a)| b - a).collect(),
            values: Vec::new(),
        }
    }
}

/// The largest size of a number, or what is none.
fn largest(of: &DVector<C>) -> f64 {
    let sizes = of.iter().map(|x| x.norm_sqr().sqrt());
    sizes.fold(0.0, |most, size| if size <= most { most } else { size })
}

/// A straight way through the parameters.
pub struct RestWay<'a> {
    of: &'a RestEquations,
    from: Vec<C>,
    change: Vec<C>,
    values: Vec<C>,
}

impl RestWay<'_> {
    fn evaluated(&mut self, s: C, x: &[C]) -> ([DVector<C>; 2], DMatrix<C>) {
        let here = self.from.iter().zip(&self.change).map(|(p, d)| p + s * d);
        let here: Vec<C> = here.collect();
        self.of.at([&here, &self.change], x, &mut self.values)
    }
}

impl Homotopy for RestWay<'_> {
    fn settle(&self, _: &mut [C]) {}

    fn velocity(&mut self, s: C, x: &[C], out: &mut [C]) -> bool {
        let ([_, rate], hessian) = self.evaluated(s, x);
        let Some(found) = hessian.lu().solve(&rate) else {
            return false;
        };
        out.iter_mut()
            .zip(found.iter())
            .for_each(|(out, x)| *out = -x);
        out.iter().all(|x| Number::is_finite(*x))
    }

    fn correct(&mut self, s: C, x: &mut [C]) -> f64 {
        let ([value, _], hessian) = self.evaluated(s, x);
        let Some(step) = hessian.lu().solve(&value) else {
            return f64::NAN;
        };
        x.iter_mut().zip(step.iter()).for_each(|(x, d)| *x -= *d);
        largest(&step)
    }

    fn residual(&mut self, s: C, x: &[C]) -> f64 {
        largest(&self.evaluated(s, x).0[0])
    }
}
