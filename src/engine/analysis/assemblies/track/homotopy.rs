//! Straight-line homotopy between two members of a family.

pub(crate) use super::member::{END, START};
use super::member::{MemberEquations, MemberSegment};
use crate::analysis::assemblies::family::{C, Family, Member, size};
use crate::geometry::{Quaternion, Vector3};
use crate::number::tolerance::ROUNDING;
use crate::number::{Number, complex};
use crate::solve::{Equations, Homotopy};
use crate::system::System;

impl Family {
    /// The homotopy from one member to another. `None` if an expression has no value at the start.
    pub fn homotopy(&self, from: &Member, to: &Member) -> Option<ParameterHomotopy<'_>> {
        let course = MemberSegment::new(from, to);
        let here = MemberEquations::start(self, &course)?;
        Some(ParameterHomotopy::new(self, here, course))
    }
}

/// A straight-line homotopy, s from 0 to 1, with storage for tracking.
#[derive(Clone, Debug)]
pub(crate) struct ParameterHomotopy<'f> {
    pub family: &'f Family,
    /// The equations at the parameter value last evaluated.
    pub here: MemberEquations,
    residual: Vec<C>,
    /// Factors by which the equations last factorised were multiplied.
    factors: Vec<f64>,
    course: MemberSegment,
    /// The least that [`reach`](Self::reach) is.
    reach: f64,
}

impl<'f> ParameterHomotopy<'f> {
    /// The way with a row that is to be `more` at its end.
    pub fn raising(mut self, row: usize, more: C) -> Self {
        self.course.raised = Some((row, more));
        self
    }

    /// From one system to another of the same structure, at the inputs of a member.
    pub fn between(
        family: &'f Family,
        (from, to): (&System<C>, &System<C>),
        member: &Member,
    ) -> Option<Self> {
        let course = MemberSegment {
            resized: true,
            ..MemberSegment::new(member, member)
        };
        let here = MemberEquations::between(family, &course, (from, to))?;
        Some(ParameterHomotopy {
            reach: 1e3,
            ..ParameterHomotopy::new(family, here, course)
        })
    }

    fn new(family: &'f Family, here: MemberEquations, course: MemberSegment) -> Self {
        let rows = vec![C::from_f64(0.0); here.system.rows()];
        ParameterHomotopy {
            family,
            factors: vec![1.0; rows.len()],
            residual: rows,
            here,
            course,
            reach: 1.0,
        }
    }
}

impl ParameterHomotopy<'_> {
    fn load(&mut self, s: C, x: &[C]) {
        self.here.go(self.family, &self.course, s);
        self.family.coordinates.unflatten(x, &mut self.here.at);
    }

    /// Evaluates and factorises at a point; returns the largest residual.
    ///
    /// Complex rotations and positions have no bound, and rows grow with them: they are made no longer than 1.
    pub fn linearise(&mut self, s: C, x: &[C]) -> f64 {
        self.load(s, x);
        let largest = self.here.linearise();
        let here = &mut self.here;
        (self.residual).copy_from_slice(here.system.residual_of(&here.work));
        here.system.shorten_rows(&mut here.work, &mut self.factors);
        // a solution far out may be simple although its pivots differ by the square of its size
        here.system.factorise_isolated(&mut here.work);
        largest
    }

    /// Rates of the unknowns at a solution while one residual changes.
    pub fn rate(&mut self, s: C, x: &[C], row: usize) -> Option<&[C]> {
        self.linearise(s, x);
        let mut residual = vec![C::from_f64(0.0); self.factors.len()];
        residual[row] = C::from_f64(-1.0);
        let longest = self.step_for(&mut residual);
        longest
            .is_finite()
            .then(|| self.here.system.step_of(&self.here.work))
    }

    /// The step −J⁺r for a residual r and the factors last made.
    fn step_for(&mut self, residual: &mut [C]) -> f64 {
        for (row, factor) in residual.iter_mut().zip(&self.factors) {
            *row *= *factor;
        }
        self.here.system.step_for(residual, &mut self.here.work)
    }

    /// Quotient of the smallest and the largest pivot of the Jacobian at a point, or the smallest where none reaches 1: all
    /// of them may be rounding.
    pub fn regularity(&mut self, s: C, x: &[C]) -> f64 {
        self.load(s, x);
        self.here.linearise();
        let (largest, smallest) = self.here.system.pivots(&self.here.work);
        smallest / largest.max(1.0)
    }

    /// Length of the way: the largest change of an input, in rad or characteristic lengths.
    pub fn length(&self) -> f64 {
        self.measured(&self.course.change.inputs)
            .fold(0.0, f64::max)
    }

    /// The largest length held at the end, in characteristic lengths, and no less than 1, or than 1000 between systems,
    /// where solutions of one are far out of the other.
    pub fn reach(&self) -> f64 {
        let (from, change) = (&self.course.from.inputs, &self.course.change.inputs);
        let end: Vec<C> = from.iter().zip(change).map(|(a, d)| a + d).collect();
        let lengths = self.family.lengths_among_inputs();
        let sizes = self.measured(&end).zip(lengths);
        sizes.fold(
            self.reach,
            |most, (size, length)| if length { size.max(most) } else { most },
        )
    }

    /// Size of a point: its largest coordinate, or what an angle makes of lengths, for a rotation by φ grows as e^|Im φ|.
    pub fn extent(&self, x: &[C]) -> f64 {
        let c = &self.family.coordinates;
        let angles = c.free_joints.iter().zip(x);
        let angles = angles.filter(|(j, _)| c.turns[**j].is_some());
        let turned = angles.map(|(_, z)| z.im.abs()).fold(0.0, f64::max);
        size(x).max(Number::exp(C::from_f64(turned)).re)
    }

    /// Absolute values of inputs, in rad or characteristic lengths.
    fn measured(&self, inputs: &[C]) -> impl Iterator<Item = f64> {
        let lengths = self.family.lengths_among_inputs().into_iter();
        let unit = |length| {
            if length {
                self.family.coordinates.length
            } else {
                1.0
            }
        };
        let sizes = inputs.iter().zip(lengths);
        sizes.map(move |(x, length)| complex::norm(x / unit(length)))
    }

    /// Number of dimensionless steps that move a point.
    pub fn unknowns(&self) -> usize {
        self.here.system.unknowns().len()
    }

    /// Number of equations that do not vanish everywhere.
    pub fn varying_rows(&self) -> usize {
        self.family.varying_equations + self.here.system.hold_rows().len()
    }

    /// Residual and dense Jacobian at a point, column-major.
    pub fn evaluated(&mut self, s: C, x: &[C]) -> (Vec<C>, Vec<C>) {
        self.load(s, x);
        self.here.linearise();
        let jacobian = self.here.system.dense_jacobian(&self.here.work);
        let residual = self.here.system.residual_of(&self.here.work);
        (residual.to_vec(), jacobian)
    }

    /// A point moved by dimensionless steps of the unknowns.
    pub fn moved(&mut self, s: C, x: &[C], step: &[C]) -> Vec<C> {
        self.load(s, x);
        let moved = self.here.system.displaced(&self.here.at, step);
        let mut moved = self.family.coordinates.flatten(&moved);
        self.settle(&mut moved);
        moved
    }

    /// The step that leads from one point to another.
    pub fn step_between(&mut self, s: C, x: &[C], y: &[C]) -> Vec<C> {
        self.load(s, x);
        let from = self.here.at.clone();
        self.load(s, y);
        self.here.system.difference(&from, &self.here.at)
    }

    /// |J (y − x)| at the first point, each row relative to its norm where that exceeds 1: rounding for
    /// two approximations of one solution, however ill-conditioned it is.
    pub fn seen_apart(&mut self, s: C, x: &[C], y: &[C]) -> f64 {
        let y = self.family.coordinates.nearest_form(x, y);
        let step = self.step_between(s, x, &y);
        let (residual, jacobian) = self.evaluated(s, x);
        let rows = residual.len();
        let columns = || jacobian.chunks_exact(rows.max(1));
        let seen = (0..rows).map(|r| {
            let along: C = columns().zip(&step).map(|(column, d)| column[r] * d).sum();
            let slopes: f64 = columns().map(|column| column[r].norm_sqr()).sum();
            complex::norm(along) / slopes.sqrt().max(1.0)
        });
        seen.fold(0.0, f64::max) / (1.0 + size(x))
    }

    /// A solution moved by J⁺ e, where e is an error of every closure of size `noise` relative to its
    /// row norm and the size of the point. None if J loses rank.
    pub fn jolted(&mut self, s: C, x: &[C], noise: f64, stream: usize) -> Option<Vec<C>> {
        let (residual, jacobian) = self.evaluated(s, x);
        let rows = residual.len();
        let mut error: Vec<C> = (0..rows)
            .map(|r| {
                let slopes = jacobian
                    .chunks_exact(rows)
                    .map(|column| column[r].norm_sqr());
                let size = slopes.sum::<f64>().sqrt().max(1.0) * (1.0 + size(x));
                // directions without symmetry, the same in every run
                complex::polar(
                    noise * size,
                    1.0 + 2.3 * r as f64 + 1.7 * (stream * (r + 1)) as f64,
                )
            })
            .collect();
        self.linearise(s, x);
        // singular values that Newton's method cuts off it does not recover
        if self.here.system.undetermined(&self.here.work) > 0 {
            return None;
        }
        let longest = self.step_for(&mut error);
        let step = self.here.system.step_of(&self.here.work).to_vec();
        longest.is_finite().then(|| self.moved(s, x, &step))
    }

    /// True if a solution is one of infinitely many, because a joint never comes back to the same place.
    pub fn is_endless(&mut self, s: C, x: &[C]) -> bool {
        self.load(s, x);
        self.here.is_endless(self.family, &self.course)
    }

    /// Number of free directions at a point.
    pub fn freedom(&mut self, s: C, x: &[C], tolerance: f64) -> usize {
        self.load(s, x);
        self.here.linearise();
        self.here.system.nullity(tolerance, &self.here.work)
    }

    /// dx/ds = −J⁺ ∂h/∂s by the factors last made, where frames were last placed.
    fn velocity_here(&mut self, x: &[C], out: &mut [C]) -> bool {
        let moves = self.here.drift(self.family, &self.course);
        let here = &mut self.here;
        let rates = here.system.residual_mut(&mut here.work);
        for (rate, factor) in rates.iter_mut().zip(&self.factors) {
            *rate *= *factor;
        }
        let longest = here.system.step(&mut here.work);
        if !longest.is_finite() || !moves {
            return false;
        }
        let step = self.here.system.step_of(&self.here.work);
        let joints = self.family.coordinates.free_joints.len();
        out[..joints].copy_from_slice(&step[..joints]);
        let poses = x[joints..]
            .chunks_exact(7)
            .zip(out[joints..].chunks_exact_mut(7));
        for ((x, out), twist) in poses.zip(step[joints..].chunks_exact(6)) {
            // q̇ = ½ ω q
            let half = [0, 1, 2].map(|i| twist[i] * 0.5);
            let omega = Quaternion([C::from_f64(0.0), half[0], half[1], half[2]]);
            let rate = omega.then_left(&Quaternion([x[0], x[1], x[2], x[3]]));
            out[..4].copy_from_slice(&rate.0);
            out[4..].copy_from_slice(&twist[3..]);
        }
        true
    }
}

impl Homotopy for ParameterHomotopy<'_> {
    fn settle(&self, x: &mut [C]) {
        self.family.coordinates.settle(x);
    }

    fn velocity(&mut self, s: C, x: &[C], out: &mut [C]) -> bool {
        self.linearise(s, x).is_finite() && self.here.sound && self.velocity_here(x, out)
    }

    fn velocity_again(&mut self, s: C, x: &[C], out: &mut [C]) -> bool {
        self.load(s, x);
        let here = &mut self.here;
        here.system.place(&here.at, &mut here.work);
        here.sound && self.velocity_here(x, out)
    }

    fn correct(&mut self, s: C, x: &mut [C]) -> f64 {
        let gap = self.linearise(s, x);
        let reach = 1.0 + size(x);
        // an angle so far out that its sine has no number gives no pivots, and steps of zero
        if !gap.is_finite() {
            return f64::NAN;
        }
        let shortened = self.residual.iter().zip(&self.factors);
        let gap = shortened.fold(0.0f64, |most, (row, factor)| {
            most.max(complex::norm(*row) * factor)
        });
        let longest = self.here.system.step(&mut self.here.work);
        if !longest.is_finite() || !self.here.sound {
            return f64::NAN;
        }
        let step = self.here.system.step_of(&self.here.work);
        let joints = self.family.coordinates.free_joints.len();
        // in squares: roots are taken once
        let mut largest = 0.0f64;
        for (x, step) in x[..joints].iter_mut().zip(step) {
            *x += *step;
            largest = largest.max(step.norm_sqr());
        }
        for (x, twist) in x[joints..]
            .chunks_exact_mut(7)
            .zip(step[joints..].chunks_exact(6))
        {
            let q = Quaternion([x[0], x[1], x[2], x[3]]);
            let turned = q.turned_by(&Vector3([twist[0], twist[1], twist[2]]));
            let (mut moved, mut size) = (0.0f64, 1.0f64);
            for (x, to) in x[..4].iter_mut().zip(turned.0) {
                moved = moved.max(4.0 * (to - *x).norm_sqr());
                size = size.max(to.norm_sqr());
                *x = to;
            }
            // complex rotations and positions have no bound: on the way to infinity only what a
            // step is beside them counts
            largest = largest.max(moved / size);
            let (mut moved, mut size) = (0.0f64, 1.0f64);
            for (x, shift) in x[4..].iter_mut().zip(&twist[3..]) {
                *x += *shift;
                moved = moved.max(shift.norm_sqr());
                size = size.max(x.norm_sqr());
            }
            largest = largest.max(moved / size);
        }
        let step = largest.sqrt();
        // where the Jacobian is singular the least-squares step takes no notice of the gap that is left; slopes are 1 at most
        match gap > ROUNDING * reach && gap > 1e3 * step * reach {
            true => f64::NAN,
            false => step,
        }
    }

    fn residual(&mut self, s: C, x: &[C]) -> f64 {
        self.load(s, x);
        self.here.residual()
    }
}

/// Solutions larger than this, times the largest held length, count as infinite: rounding of the
/// dimensions by ε brings one that is m-fold at infinity back to ε^(−1/m), some 1e4 for m = 4.
pub(super) const FAR: f64 = 1e3;

impl crate::solve::Turning for ParameterHomotopy<'_> {
    fn is_far(&self, x: &[C]) -> bool {
        let c = &self.family.coordinates;
        let mut joints = c.free_joints.iter().zip(x);
        // a rotation by φ grows as e^|Im φ|, here to 1e6
        let turned = joints.any(|(&j, z)| c.turns[j].is_some() && z.im.abs() > 14.0);
        turned || size(x) > FAR * self.reach()
    }

    fn apart(&self, x: &[C], y: &[C]) -> (f64, bool) {
        let c = &self.family.coordinates;
        let mut turned = false;
        let mut largest = 0.0f64;
        for (k, (x, y)) in x.iter().zip(y).enumerate() {
            let mut gap = x - y;
            if let Some(&j) = c.free_joints.get(k) {
                let within = c.principal(j, gap.re, 0.0);
                turned |= (within - gap.re).abs() > std::f64::consts::PI;
                gap.re = within;
            }
            largest = largest.max(complex::norm(gap));
        }
        (largest, turned)
    }
}
