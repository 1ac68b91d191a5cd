//! A place on every circuit, by following complex configurations.
//!
//! At one value of a joint all configurations are known, real and complex. Followed along the real values of the joint,
//! a conjugate pair becomes real where a circuit begins, that is where the joint turns back on it, and the real
//! configurations become such a pair where it ends. So circuits that do not reach the value are met by the pairs, and
//! those hidden behind others by the pairs that leave these.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::tracing::{SAME, Tracing};
use crate::algebra::SiUnit;
use crate::linear::norm;
use crate::mechanism::{Configuration, turn_near};
use crate::number::{Complex, Number};
use crate::solve::{Continuation, Place, SolutionCurve, Watch};
use crate::system::{ComplexCurve, Curve, Held};

type C = Complex<f64>;

/// All assembled configurations at one value of a joint, real and complex.
#[derive(Clone, Debug, PartialEq)]
pub struct Slice {
    /// The joint.
    pub joint: usize,
    /// Its value, rad or m.
    pub value: f64,
    /// How far from it the others are followed on either side, if the joint does not come back to it: rad or m.
    pub reach: f64,
    /// The real ones.
    pub real: Vec<Configuration<f64>>,
    /// The others.
    pub complex: Vec<Configuration<C>>,
    /// Whether the search for them ended with no sign that one was missed.
    pub whole: bool,
}

/// How circuits were looked for beside those that seeds lie on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Swept {
    /// The joint along whose values complex configurations were followed.
    pub joint: String,
    /// rad or m.
    pub unit: SiUnit,
    /// The value at which all configurations were known.
    pub value: f64,
    /// How many there are, real or complex.
    pub configurations: usize,
    /// How many of them are real.
    pub real: usize,
    /// The values between which they were followed; `None` if the joint came back to where it was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    /// Paths that were lost, and dead points that none of them led to.
    pub lost: usize,
    /// Whether the search for the configurations may have missed some.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub doubtful: bool,
}

impl Swept {
    /// Whether every circuit on which the joint moves was met, if all configurations at the one value were known.
    pub fn is_whole(&self) -> bool {
        self.lost == 0 && !self.doubtful
    }
}

/// Where a path of complex configurations ended.
enum End {
    /// At a real configuration.
    Real(Configuration<f64>),
    /// Where the joint has gone all its way.
    Through,
    Lost,
}

/// Follows all curves that the slice leads to.
pub(super) fn sweep(
    slice: &Slice,
    held: &Held<f64>,
    tracing: &mut Tracing,
    watch: &Watch,
) -> Swept {
    let mechanism = tracing.mechanism;
    let of = &mechanism.joints()[slice.joint];
    let cycle = mechanism.turns_to_repeat(slice.joint);
    let mut swept = Swept {
        joint: of.name.clone(),
        unit: SiUnit::of_coordinate(of.kind.is_angle()),
        value: slice.value,
        configurations: slice.real.len() + slice.complex.len(),
        real: slice.real.len(),
        range: (cycle.is_none()).then(|| [slice.value - slice.reach, slice.value + slice.reach]),
        lost: 0,
        doubtful: !slice.whole,
    };
    slice.real.iter().for_each(|seed| tracing.take(seed));
    let Some(complex) = ComplexCurve::new(mechanism, held, slice.joint) else {
        swept.doubtful = true;
        return swept;
    };
    let mut paths = Paths {
        // far from the real ones cosines and sines are large
        method: Continuation {
            tolerance: 1e-10,
            ..tracing.method().clone()
        },
        value: slice.value,
        reach: cycle.map_or(slice.reach, |turns| turns * PI),
        complex,
        watch,
    };
    let mut waiting = Vec::new();
    let mut pairs: Vec<&Configuration<C>> = Vec::new();
    for at in &slice.complex {
        let conjugate = at.map(|z| z.conj());
        if (pairs.iter()).any(|known| paths.complex.apart(known, &conjugate) < SAME) {
            continue;
        }
        pairs.push(at);
        match paths.method.settle(&mut paths.complex, at.clone()) {
            Ok(place) => {
                for up in [false, true] {
                    waiting.push((paths.complex.going(place.clone(), up), up));
                }
            }
            Err(_) => swept.lost += 1,
        }
    }
    // dead points that a path is to end at, and those that one did
    let (mut wanted, mut reached) = (Vec::new(), Vec::new());
    let mut seen = 0;
    loop {
        for found in &tracing.traced[seen..] {
            for (fold, greatest) in &found.folds {
                let from = fold.at.joints[slice.joint] - slice.value;
                let from = cycle.map_or(from, |turns| turns * turn_near(from / turns, 0.0));
                if from.abs() >= paths.reach {
                } else if (from > 0.0) != *greatest {
                    wanted.push(fold.at.clone());
                } else {
                    let mut at = fold.at.map(C::from_f64);
                    at.joints[slice.joint] = C::from_f64(slice.value + from);
                    match paths.leaving(&at, &fold.tangent, *greatest) {
                        Some(place) => waiting.push((place, *greatest)),
                        None => swept.lost += 1,
                    }
                }
            }
        }
        seen = tracing.traced.len();
        let Some((place, up)) = waiting.pop() else {
            break;
        };
        if watch.is_stopped() || tracing.is_exhausted() {
            swept.lost += 1;
            break;
        }
        match paths.follow(&mut tracing.curve, place, (up, slice.joint)) {
            End::Real(at) => {
                tracing.take(&at);
                reached.push(at);
            }
            End::Through => {}
            End::Lost => swept.lost += 1,
        }
    }
    // of the sets of angles of balls one is followed, and paths may end at another
    let one_set = |at: &Configuration<f64>| mechanism.sets_of_angles(at).len() == 1;
    let near = |a: &Configuration<f64>, b: &Configuration<f64>| {
        norm(&tracing.curve.difference_but_turns(a, b)) < ARRIVED
    };
    let missed = wanted.iter().filter(|fold| one_set(fold));
    swept.lost += missed
        .filter(|fold| !reached.iter().any(|at| near(fold, at)))
        .count();
    swept
}

/// A path this near to real configurations has come to one, if it is a dead point.
const ARRIVED: f64 = 1e-3;

struct Paths<'a> {
    complex: ComplexCurve,
    method: Continuation,
    value: f64,
    reach: f64,
    watch: &'a Watch<'a>,
}

impl Paths<'_> {
    /// A place on the pair that leaves a real curve at a dead point, where the joint has gone beyond it.
    fn leaving(
        &mut self,
        fold: &Configuration<C>,
        tangent: &[f64],
        up: bool,
    ) -> Option<Place<Configuration<C>>> {
        let direction = self.complex.off_real(tangent);
        let (place, _) = self.method.leave(&mut self.complex, fold, &direction)?;
        let beyond = (self.complex.value(&place.at) > self.complex.value(fold)) == up;
        beyond.then(|| self.complex.going(place, up))
    }

    /// Follows a path until it is real, or the joint has gone all its way.
    fn follow(
        &mut self,
        real: &mut Curve,
        mut place: Place<Configuration<C>>,
        (up, joint): (bool, usize),
    ) -> End {
        const STEPS: usize = 20_000;
        let mut length = 0.1 * self.method.longest;
        let mut before = 0.0;
        let mut none_ahead = false;
        for _ in 0..STEPS {
            if self.watch.is_stopped() {
                break;
            }
            let gone = self.complex.value(&place.at) - self.value;
            if gone.abs() >= self.reach && (gone > 0.0) == up {
                return End::Through;
            }
            match self.method.step(&mut self.complex, &place, length) {
                Ok((to, changed)) => {
                    length = self.method.next_length(length, changed, &to);
                    place = to;
                    none_ahead = false;
                }
                Err(_) if !none_ahead && length < 1e-3 * self.method.longest => {
                    none_ahead = true;
                    match self.beyond(real, &place, up) {
                        Some(Ok(to)) => (place, length) = (to, 0.1 * self.method.longest),
                        Some(Err(real)) => return End::Real(real),
                        None => {}
                    }
                    continue;
                }
                Err(_) => {
                    length *= 0.5;
                    if length < self.method.shortest {
                        break;
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
                return End::Real(dead.at);
            }
            before = imaginary;
        }
        End::Lost
    }

    /// What is beyond a crossing just ahead: a place straight on, or the dead point that it is.
    fn beyond(
        &mut self,
        real: &mut Curve,
        place: &Place<Configuration<C>>,
        up: bool,
    ) -> Option<Result<Place<Configuration<C>>, Configuration<f64>>> {
        let (method, complex) = (&self.method, &mut self.complex);
        let reach = 0.2 * method.longest;
        let point = method.branch_point(complex, &place.at, reach)?;
        let (imaginary, beside) = complex.split(&point.at);
        if imaginary < SAME
            && let Ok(dead) = method.settle(real, beside)
        {
            return Some(Err(dead.at));
        }
        let way = complex.difference(&place.at, &point.at);
        let straight = point.straight_on(&way, &place.tangent)?;
        let (to, _) = method.leave(complex, &point.at, &straight)?;
        let on = (complex.value(&to.at) > complex.value(&point.at)) == up;
        on.then_some(Ok(to))
    }
}
