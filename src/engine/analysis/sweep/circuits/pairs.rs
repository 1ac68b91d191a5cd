//! Pairs of conjugate configurations followed until they are real.

use crate::linear::norm;
use crate::mechanism::Configuration;
use crate::number::C;
use crate::number::tolerance::SAME;
use crate::solve::{Continuation, CurvePoint, Watch};
use crate::system::{ComplexCurve, Curve};

/// The end of a path of complex configurations.
pub(super) enum PairEnd {
    /// At a real configuration.
    Real(Configuration<f64>),
    /// At the end of the joint's range, or at a crossing that another path came to.
    Through,
    /// At infinity, where the joint has this value.
    Pole(f64),
    /// At a crossing of paths, with the places from which all others go on.
    Crossing(Vec<CurvePoint<Configuration<C>>>),
    /// The place at which no step leads on.
    Lost(Configuration<C>),
    /// After so many steps that it was not followed further.
    GivenUp,
}

/// A path this near to real configurations has come to one, if it is a dead point.
pub(super) const ARRIVED: f64 = 1e-3;

pub(super) struct PairPaths<'a> {
    pub complex: ComplexCurve,
    pub method: Continuation,
    pub value: f64,
    pub reach: f64,
    /// Crossings that a path came to, each with the sense in which it went.
    pub crossings: Vec<(Configuration<C>, bool)>,
    /// Steps made so far, with those from other values.
    pub steps: usize,
    pub watch: &'a Watch<'a>,
}

impl PairPaths<'_> {
    /// Steps after which a path is given up, and after which all are.
    const STEPS: usize = 10_000;
    const ALL_STEPS: usize = 40_000;

    /// True if cosines are so large, 74 and more, that rounding may keep paths from being followed.
    pub fn is_far(&self, at: &Configuration<C>) -> bool {
        self.complex.depth(at) > 5.0
    }

    /// A place on the pair that leaves a real curve at a dead point, where the joint has gone beyond it.
    pub fn leaving(
        &mut self,
        fold: &Configuration<C>,
        tangent: &[f64],
        up: bool,
    ) -> Option<CurvePoint<Configuration<C>>> {
        let direction = self.complex.off_real(tangent);
        let (place, _) = self.method.leave(&mut self.complex, fold, &direction)?;
        let beyond = (self.complex.value(&place.at) > self.complex.value(fold)) == up;
        beyond.then(|| self.complex.going(place, up))
    }

    /// Follows a path until it is real, or the joint has gone all its way.
    pub fn follow(
        &mut self,
        real: &mut Curve,
        mut place: CurvePoint<Configuration<C>>,
        (up, joint): (bool, usize),
    ) -> PairEnd {
        let mut length = 0.1 * self.method.longest;
        let mut before = 0.0;
        let mut none_ahead = false;
        for _ in 0..Self::STEPS {
            self.steps += 1;
            if self.watch.is_stopped() || self.steps > Self::ALL_STEPS {
                break;
            }
            let gone = self.complex.value(&place.at) - self.value;
            if gone.abs() >= self.reach && (gone > 0.0) == up {
                return PairEnd::Through;
            }
            match self.method.step(&mut self.complex, &place, length) {
                Ok((to, changed)) => {
                    // of what is far out the change of the Jacobian alone says how long steps may be
                    let method = Continuation {
                        longest: self.method.longest * (1.0 + self.complex.extent(&to.at)),
                        ..self.method.clone()
                    };
                    length = method.next_length(length, changed, &to);
                    place = to;
                    none_ahead = false;
                }
                Err(_) if !none_ahead && length < 1e-3 * self.method.longest => {
                    none_ahead = true;
                    match self.beyond(real, &place, up) {
                        Some(end) => return end,
                        None => continue,
                    }
                }
                Err(_) => {
                    length *= 0.5;
                    if length < self.method.shortest {
                        return match self.is_far(&place.at) {
                            true => PairEnd::Pole(self.complex.value(&place.at)),
                            false => PairEnd::Lost(place.at),
                        };
                    }
                    continue;
                }
            }
            let (imaginary, beside) = self.complex.split(&place.at);
            if imaginary < ARRIVED
                && imaginary < before
                && let Ok(dead) = self.method.settle(real, beside.clone())
                && let column = real.column(joint).expect("the joint moves")
                && dead.tangent[column].abs() < 0.1
                && norm(&real.difference_but_turns(&beside, &dead.at)) < 0.1 * imaginary
            {
                return PairEnd::Real(dead.at);
            }
            // cosines of some thousands: with others rounding tells nothing
            if self.complex.depth(&place.at) > 9.0 {
                return PairEnd::Pole(self.complex.value(&place.at));
            }
            before = imaginary;
        }
        PairEnd::GivenUp
    }

    /// The paths beyond a crossing just ahead, or the dead point that it is. Pairs cross where a loop becomes real while
    /// another one does not; they leave with every loop turned by i that met its conjugate.
    fn beyond(
        &mut self,
        real: &mut Curve,
        place: &CurvePoint<Configuration<C>>,
        up: bool,
    ) -> Option<PairEnd> {
        let (method, complex) = (&self.method, &mut self.complex);
        let reach = 0.2 * method.longest;
        let point = method.branch_point(complex, &place.at, reach)?;
        let (imaginary, beside) = complex.split(&point.at);
        if imaginary < SAME
            && let Ok(dead) = method.settle(real, beside)
        {
            return Some(PairEnd::Real(dead.at));
        }
        let conjugate = point.at.map(|z| z.conj());
        let same = |known: &Configuration<C>| {
            complex
                .apart(known, &point.at)
                .min(complex.apart(known, &conjugate))
                < SAME
        };
        if (self.crossings.iter()).any(|(known, sense)| *sense == up && same(known)) {
            return Some(PairEnd::Through);
        }
        self.crossings.push((point.at.clone(), up));
        let at = complex.value(&point.at);
        let mut places = Vec::new();
        for direction in &point.directions {
            for sign in [1.0, -1.0] {
                let direction: Vec<f64> = direction.iter().map(|x| sign * x).collect();
                let left = method.leave(complex, &point.at, &direction);
                let on = left.filter(|(to, _)| (complex.value(&to.at) > at) == up);
                places.extend(on.map(|(to, _)| complex.going(to, up)));
            }
        }
        (!places.is_empty()).then_some(PairEnd::Crossing(places))
    }
}
