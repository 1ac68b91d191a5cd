//! The curve of all solutions over a straight way through the family, cut by a function of them.

use rand::Rng;
use rand_pcg::Pcg64;

use super::along::polish;
use super::homotopy::ParameterHomotopy;
use crate::analysis::assemblies::family::{C, Family};
use crate::number::{Number, complex};
use crate::solve::{Arrival, Homotopy, Progress, Stages, Tracker, Watch};

/// A random function of flat unknowns, regular on the solutions: linear in the exponentials of angles, in travels and
/// positions and bilinear in quaternions, so that neither whole turns nor their signs matter.
#[derive(Clone, Debug)]
pub(crate) struct Form {
    /// With each joint i/n for an angle that repeats after n turns.
    joints: Vec<(C, Option<C>)>,
    /// Coefficients for each platform: two for the quaternion, one for the position.
    platforms: Vec<([C; 4], [C; 4], [C; 3])>,
}

impl Form {
    /// `None` if an angle never comes back to the same place.
    pub fn random(family: &Family, rng: &mut Pcg64) -> Option<Self> {
        let coordinates = &family.coordinates;
        let mut factor = || complex::polar(rng.random_range(0.5..1.0), rng.random_range(-3.1..3.1));
        let joints = coordinates.free_joints.iter().map(|&j| {
            let turning = match family.turns(j) {
                Some(turns) => Some(C::new(0.0, coordinates.joint_scales[j] / turns?)),
                None => None,
            };
            Some((factor(), turning))
        });
        let joints = joints.collect::<Option<_>>()?;
        let platforms = coordinates.free_platforms.iter();
        let platforms = platforms.map(|_| {
            let [a, b] = [(); 2].map(|()| [(); 4].map(|()| factor()));
            (a, b, [(); 3].map(|()| factor()))
        });
        Some(Form {
            joints,
            platforms: platforms.collect(),
        })
    }

    /// Its value at `x`, and its rate along `v`.
    pub fn at(&self, x: &[C], v: &[C]) -> (C, C) {
        let zero = C::from_f64(0.0);
        let (mut value, mut rate) = (zero, zero);
        for (((a, turning), x), v) in self.joints.iter().zip(x).zip(v) {
            let (now, slope) = match turning {
                Some(i) => (Number::exp(i * x), i * Number::exp(i * x)),
                None => (*x, C::from_f64(1.0)),
            };
            value += a * now;
            rate += a * slope * v;
        }
        let joints = self.joints.len();
        let poses = x[joints..].chunks_exact(7).zip(v[joints..].chunks_exact(7));
        let along = |a: &[C], x: &[C]| a.iter().zip(x).map(|(a, x)| a * x).sum::<C>();
        for ((a, b, c), (x, v)) in self.platforms.iter().zip(poses) {
            let [ax, bx] = [along(a, x), along(b, x)];
            value += ax * bx + along(c, &x[4..]);
            rate += along(a, v) * bx + ax * along(b, v) + along(c, &v[4..]);
        }
        (value, rate)
    }
}

/// Points (x, s) of the curve where the form has a value that moves from one to another.
#[derive(Clone, Debug)]
pub(crate) struct Cut<'f> {
    way: ParameterHomotopy<'f>,
    form: Form,
    from: C,
    pub to: C,
    /// dx/ds where it was last asked for.
    along: Vec<C>,
}

impl<'f> Cut<'f> {
    pub fn new(way: ParameterHomotopy<'f>, form: Form) -> Self {
        let zero = C::from_f64(0.0);
        Cut {
            along: vec![zero; way.family.coordinates.count()],
            way,
            form,
            from: zero,
            to: zero,
        }
    }

    /// df/ds along the curve.
    pub fn rate(&mut self, y: &[C]) -> Option<C> {
        let (s, x) = y.split_last()?;
        let moving = self.way.velocity(*s, x, &mut self.along);
        moving.then(|| self.form.at(x, &self.along).1)
    }

    fn level(&self, sigma: C) -> C {
        self.from + (self.to - self.from) * sigma
    }

    /// Points of the curve at s, from solutions at its start.
    pub fn spread(&self, solutions: &[Vec<C>], s: C, watch: (&Watch, Progress)) -> Vec<Vec<C>> {
        let start = C::from_f64(0.0);
        let ends = crate::solve::each(solutions.len(), &self.way, |way, k| {
            let mut x = solutions[k].clone();
            let arrived = arrives(way, (start, s), &mut x, watch);
            arrived.then(|| [x, vec![s]].concat())
        });
        ends.into_iter().flatten().collect()
    }

    /// Points carried each from its own level to the common one; those that are lost on the way are left out.
    pub fn carried(&self, points: &[Vec<C>], watch: (&Watch, Progress)) -> Vec<Vec<C>> {
        let way = (C::from_f64(0.0), C::from_f64(1.0));
        let ends = crate::solve::each(points.len(), self, |cut, k| {
            let mut y = points[k].clone();
            cut.from = cut.form.at(&y, &y).0;
            arrives(cut, way, &mut y, watch).then_some(y)
        });
        ends.into_iter().flatten().collect()
    }
}

fn arrives(
    homotopy: &mut impl Homotopy,
    way: (C, C),
    y: &mut [C],
    watch: (&Watch, Progress),
) -> bool {
    let mut stages = Stages::new(y.len(), watch);
    let track = Tracker::default().track(homotopy, way, y, &mut stages);
    track.arrival == Arrival::There && polish(homotopy, way.1, y)
}

impl Homotopy for Cut<'_> {
    fn settle(&self, y: &mut [C]) {
        let last = y.len() - 1;
        self.way.settle(&mut y[..last]);
    }

    fn velocity(&mut self, _: C, y: &[C], out: &mut [C]) -> bool {
        let Some(rate) = self.rate(y) else {
            return false;
        };
        let ds = (self.to - self.from) / rate;
        let (last, out) = out.split_last_mut().expect("one for s");
        *last = ds;
        out.iter_mut()
            .zip(&self.along)
            .for_each(|(out, v)| *out = v * ds);
        ds.is_finite()
    }

    fn correct(&mut self, sigma: C, y: &mut [C]) -> f64 {
        let (s, x) = y.split_last_mut().expect("one for s");
        let step = self.way.correct(*s, x);
        if !step.is_finite() || !self.way.velocity_again(*s, x, &mut self.along) {
            return f64::NAN;
        }
        let (value, rate) = self.form.at(x, &self.along);
        let ds = (self.level(sigma) - value) / rate;
        *s += ds;
        let mut moved = complex::norm(ds);
        for (x, v) in x.iter_mut().zip(&self.along) {
            let dx = v * ds;
            moved = moved.max(complex::norm(dx) / complex::norm(*x).max(1.0));
            *x += dx;
        }
        self.way.settle(x);
        step.max(moved)
    }

    fn residual(&mut self, sigma: C, y: &[C]) -> f64 {
        let (s, x) = y.split_last().expect("one for s");
        let value = self.form.at(x, x).0;
        let gap = self.level(sigma) - value;
        self.way
            .residual(*s, x)
            .max(complex::norm(gap) / complex::norm(value).max(1.0))
    }
}
