//! Complex assembled configurations at real values of a joint, as a curve.

use super::Curve;
use crate::mechanism::{Configuration, Mechanism, turn_near};
use crate::number::{C, Number, complex::norm, real};
use crate::solve::{CurvePoint, Equations, SolutionCurve};
use crate::system::equations::{System, SystemWork};
use crate::system::{Held, Unknown};

/// The complex assembled configurations of a mechanism with one freedom at which one joint is real.
///
/// Their equations are polynomials in cosines and sines with real coefficients, so that configurations which are not
/// real come in conjugate pairs. Along the real values of the joint a pair becomes real only where its two meet: there
/// a real curve turns back. Unknowns are the real parts of those of [`System`], then the imaginary parts but that of
/// the joint.
#[derive(Clone, Debug)]
pub struct ComplexCurve {
    system: System<C>,
    work: SystemWork<C>,
    joint: usize,
    column: usize,
    cycles: Vec<Option<f64>>,
    /// For each unknown, true if it is a length.
    lengths: Vec<bool>,
}

impl ComplexCurve {
    /// `held` leaves one freedom and not the joint. `None` where it does not move.
    pub fn new(mechanism: &Mechanism, held: &Held<f64>, joint: usize) -> Option<Self> {
        let dimensions = mechanism.dimensions().map(C::from_f64);
        let system = System::reduced(mechanism, &dimensions, &held.map(C::from_f64));
        let is_length = |unknown: &Unknown| match *unknown {
            Unknown::Joint(joint) => !mechanism.joints()[joint].kind.is_angle(),
            Unknown::Twist(_, component) => component >= 3,
        };
        Some(ComplexCurve {
            lengths: system.unknowns().iter().map(is_length).collect(),
            work: system.work(),
            joint,
            column: system.place_of(Unknown::Joint(joint))?,
            cycles: Curve::cycles_of(mechanism),
            system,
        })
    }

    /// The value of the real joint, rad or m.
    pub fn value(&self, at: &Configuration<C>) -> f64 {
        at.joints[self.joint].re
    }

    /// A place followed so that the real joint grows, or falls.
    pub fn going(
        &self,
        place: CurvePoint<Configuration<C>>,
        up: bool,
    ) -> CurvePoint<Configuration<C>> {
        match (place.tangent[self.column] > 0.0) == up {
            true => place,
            false => place.reversed(),
        }
    }

    /// The direction in which conjugate configurations leave a real one where the joint turns back: i times the tangent
    /// of the real curve, for the equations are linear to first order.
    pub fn off_real(&self, tangent: &[f64]) -> Vec<f64> {
        let still = vec![0.0; tangent.len()];
        let beside = (tangent.iter().enumerate()).filter(|(i, _)| *i != self.column);
        let mut direction: Vec<f64> = still.into_iter().chain(beside.map(|(_, x)| *x)).collect();
        let size = crate::linear::norm(&direction);
        direction.iter_mut().for_each(|x| *x /= size);
        direction
    }

    /// The largest imaginary part of an unknown, and the configuration of the real parts.
    pub fn split(&self, at: &Configuration<C>) -> (f64, Configuration<f64>) {
        let mut real = at.map(|z| z.re);
        for platform in &mut real.platforms {
            platform.orientation = platform.orientation.normalised();
        }
        let step = self.system.difference(&real.map(C::from_f64), at);
        let imaginary = step.iter().map(|z| z.im.abs());
        (imaginary.fold(0.0, f64::max), real)
    }

    /// The largest length among the unknowns, in characteristic lengths.
    pub fn extent(&self, at: &Configuration<C>) -> f64 {
        let slides = self.system.unknowns().iter().zip(&self.lengths);
        let slides = slides.filter_map(|(unknown, is_length)| match *unknown {
            Unknown::Joint(joint) if *is_length => {
                Some(norm(at.joints[joint]) / self.system.joint_scale(joint))
            }
            _ => None,
        });
        let places = at.platforms.iter().flat_map(|of| of.position.0);
        let places = places.map(|x| norm(x) / self.system.characteristic_length());
        slides.chain(places).fold(0.0, f64::max)
    }

    /// The largest imaginary angle, or the imaginary angle with a cosine as large as the largest length.
    pub fn depth(&self, at: &Configuration<C>) -> f64 {
        let (_, real) = self.split(at);
        let step = self.system.difference(&real.map(C::from_f64), at);
        let angles = step.iter().zip(&self.lengths).filter(|(_, is)| !**is);
        let angles = angles.map(|(z, _)| z.im.abs()).fold(0.0, f64::max);
        angles.max(real::ln(2.0 * self.extent(at).max(0.5)))
    }

    /// The distance between two configurations, whole turns left out.
    pub fn apart(&self, from: &Configuration<C>, to: &Configuration<C>) -> f64 {
        let step = self.system.difference(from, to);
        let squares = step.iter().zip(self.system.unknowns()).map(|(z, unknown)| {
            let mut z = *z;
            if let Unknown::Joint(joint) = *unknown
                && let Some(turns) = self.cycles[joint]
            {
                z.re = turns * turn_near(z.re / turns, 0.0);
            }
            z.norm_sqr()
        });
        squares.sum::<f64>().sqrt()
    }

    /// Numbers of unknowns with an imaginary part, in their order.
    fn with_imaginary(&self) -> impl Iterator<Item = usize> + use<> {
        let column = self.column;
        (0..self.system.unknowns().len()).filter(move |i| *i != column)
    }

    fn parts(&self, of: &[C]) -> Vec<f64> {
        let real = of.iter().map(|z| z.re);
        real.chain(self.with_imaginary().map(|i| of[i].im))
            .collect()
    }
}

impl SolutionCurve for ComplexCurve {
    type Point = Configuration<C>;

    fn unknowns(&self) -> usize {
        2 * self.system.unknowns().len() - 1
    }

    fn residual(&mut self, at: &Configuration<C>) -> Vec<f64> {
        self.system.residual(at, &mut self.work);
        stacked(self.system.residual_of(&self.work))
    }

    fn linearise(&mut self, at: &Configuration<C>) -> (Vec<f64>, Vec<f64>) {
        self.system.linearise(at, &mut self.work);
        let residual = stacked(self.system.residual_of(&self.work));
        let jacobian = self.system.dense_jacobian(&self.work);
        let rows = self.system.rows().max(1);
        let column = |i: usize| &jacobian[i * rows..(i + 1) * rows];
        let real = (0..self.system.unknowns().len()).flat_map(|i| stacked(column(i)));
        // d/d(Im x) = i d/dx
        let imaginary = self.with_imaginary().flat_map(|i| {
            let turned: Vec<C> = column(i).iter().map(|z| C::new(-z.im, z.re)).collect();
            stacked(&turned)
        });
        (residual, real.chain(imaginary).collect())
    }

    fn displaced(&self, at: &Configuration<C>, step: &[f64]) -> Configuration<C> {
        let (real, imaginary) = step.split_at(self.system.unknowns().len());
        let mut step: Vec<C> = real.iter().map(|x| C::from_f64(*x)).collect();
        for (i, y) in self.with_imaginary().zip(imaginary) {
            step[i].im = *y;
        }
        self.system.displaced(at, &step)
    }

    fn difference(&self, from: &Configuration<C>, to: &Configuration<C>) -> Vec<f64> {
        self.parts(&self.system.difference(from, to))
    }
}

/// Real parts, then imaginary ones.
fn stacked(of: &[C]) -> Vec<f64> {
    let real = of.iter().map(|z| z.re);
    real.chain(of.iter().map(|z| z.im)).collect()
}
