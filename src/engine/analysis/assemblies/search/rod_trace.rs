//! A trace test with a cut that is a smaller problem, which shows that no solution is missing.
//!
//! While t, half the square of a rod's length, changes by itself, solutions run over a curve. For f = e^{iθ} of any joint,
//! a level c and two places a and b of t the residues of dt/((t − a)(t − b)(f − c)) add up to zero, those at infinity being zero:
//!
//! Σ_{t=a} 1/(f − c) − Σ_{t=b} 1/(f − c) + (a − b) Σ_{f=c} 1/((t − a)(t − b) df/dt) = 0.
//!
//! Where f = c, the rod has whatever length it must have:
//! these are the solutions without it and with the joint held, fewer than all and often of a known number. If all of them
//! are in the sum, no solution can be missing from it, be there a loop that leads to it or not, whose f changes with t
//! (the cut of Brysiewicz and Burr 2023, a sparse one, for the test of Leykin, Rodriguez and Sottile 2018).

use rand::Rng;
use rand_pcg::Pcg64;

use super::solutions::GenericSolutions;
use crate::analysis::assemblies::family::{C, Family, Member, known_bound};
use crate::analysis::assemblies::track::{ParameterHomotopy, tracked};
use crate::mechanism::ClosureKind;
use crate::number::tolerance::ROUNDING;
use crate::number::{Number, complex::norm};
use crate::solve::{Progress, Watch};

/// And relative to the least change of a known solution's term, so that one like it would be missed.
const SEEN: f64 = 1e-3;
/// Choices of rod and joint that are looked at.
const CHOICES: usize = 40;

/// Unknowns of a problem from which it is worth while to descend to smaller ones without a known number.
const SMALL: usize = 10;

/// Finds the solutions of a member of another family, which has so many at most.
pub(super) type Smaller<'a> =
    dyn Fn(&Family, Option<usize>, Member) -> Option<GenericSolutions> + 'a;

/// A rod with its row and length, a joint among the unknowns, i times its scale over its turns, the smaller problem, and how
/// many solutions that has at most.
type Choice = ((usize, usize, C), usize, C, Family, Option<usize>);

/// The cut, and how the solutions known so far contribute.
pub(super) struct RodTrace<'f> {
    /// From the member to where t is `other` more.
    way: ParameterHomotopy<'f>,
    /// The joint among the unknowns, i times its scale over its turns, and c.
    joint: (usize, C, C),
    /// The part of the cut in the identity, and of absolute values.
    cut: (C, f64),
    /// Solutions with 1/(f − c) at both ends.
    known: Vec<(Vec<C>, [C; 2])>,
}

impl<'f> RodTrace<'f> {
    /// `None` where no choice of a rod and a joint leaves a problem that has no more solutions than `most` and is known to have
    /// no others. Further attempts begin with other rods and joints.
    pub fn new(
        family: &'f Family,
        base: &Member,
        (smaller, rng): (&Smaller<'_>, &mut Pcg64),
        (most, attempt): (usize, usize),
    ) -> Option<Self> {
        let coordinates = &family.coordinates;
        let system = family
            .system(&base.parameters)
            .filter(|_| family.is_square)?;
        // the curve is algebraic only where every angle comes back
        let returns = |j: &usize| family.turns(*j).is_none_or(|turns| turns.is_some());
        let closures = family.mechanism.closures();
        let related = closures.iter().any(|c| c.kind == ClosureKind::Coupling);
        if related || !coordinates.free_joints.iter().all(returns) {
            return None;
        }
        let rods = system.fixed_rods();
        let pairs = rods.flat_map(|rod| (0..coordinates.free_joints.len()).map(move |j| (rod, j)));
        let pairs = pairs.skip(attempt * (1 + coordinates.free_joints.len()));
        let mut choices = pairs.take(CHOICES).filter_map(|(rod, place)| {
            let joint = coordinates.free_joints[place];
            let turning = C::new(0.0, coordinates.joint_scales[joint] / family.turns(joint)??);
            let less = family.without(rod.0, joint)?;
            let bound = known_bound(&less.mechanism, &less).map(|bound| bound.count);
            Some((rod, place, turning, less, bound))
        });
        // without a known number the same test tells of the smaller problem whether it is complete
        let first = choices.next()?;
        let few = |choice: &Choice| choice.4.is_some_and(|bound| bound <= most);
        let known = match few(&first) {
            false => choices.find(few),
            true => None,
        };
        let small = |choice: &Choice| choice.4.is_none() && coordinates.count() <= SMALL;
        let first = Some(first).filter(|first| few(first) || small(first));
        let ((closure, row, length), place, turning, less, bound) = known.or(first)?;
        let angle = C::new(rng.random_range(-3.1..3.1), rng.random_range(-0.7..0.7));
        let held = Member {
            parameters: base.parameters.clone(),
            inputs: [base.inputs.as_slice(), &[angle]].concat(),
        };
        let all = smaller(&less, bound, held)?;
        if !(all.complete || bound == Some(all.count())) {
            return None;
        }
        let scale = coordinates.joint_scales[coordinates.free_joints[place]];
        let level = Number::exp(turning * angle / scale);
        let size = system.characteristic_length();
        let longer = length * C::new(rng.random_range(0.6..1.4), rng.random_range(0.2..0.7));
        let other = (longer * longer - length * length) * (0.5 / (size * size));
        let to = system.with_length(closure, longer);
        let mut way = ParameterHomotopy::between(family, (&system, &to), base)?;
        let mut cut = (C::from_f64(0.0), 0.0);
        for mut x in all.legwise.iter().flat_map(|s| s.points(&less.coordinates)) {
            x.insert(place, angle / scale);
            let t = way.evaluated(C::from_f64(0.0), &x).0[row];
            let rate = turning * level * way.rate(C::from_f64(0.0), &x, row)?[place];
            let term = -other / (t * (t - other) * rate);
            cut = (cut.0 + term, cut.1 + norm(term));
        }
        Some(RodTrace {
            way,
            joint: (place, turning, level),
            cut,
            known: Vec::new(),
        })
    }

    /// True if these are all solutions; `None` if a path is lost.
    pub fn holds(&mut self, solutions: &[Vec<C>], watch: (&Watch, Progress)) -> Option<bool> {
        let coordinates = &self.way.family.coordinates;
        let is_known = |x: &&Vec<C>| self.known.iter().any(|(y, _)| coordinates.same(x, y));
        let new: Vec<Vec<C>> = solutions.iter().filter(|x| !is_known(x)).cloned().collect();
        let mut ends: Vec<Option<Vec<C>>> = new.iter().cloned().map(Some).collect();
        tracked(&self.way, &mut ends, watch);
        let (place, turning, level) = self.joint;
        let term = |x: &[C]| C::from_f64(1.0) / (Number::exp(turning * x[place]) - level);
        for (x, end) in new.into_iter().zip(ends) {
            let both = [term(&x), term(&end?)];
            self.known.push((x, both));
        }
        let ((mut sum, mut all), mut least) = (self.cut, f64::INFINITY);
        for (_, [a, b]) in &self.known {
            sum += a - b;
            all += norm(*a) + norm(*b);
            least = least.min(norm(a - b));
        }
        Some(norm(sum) <= ROUNDING * all && norm(sum) <= SEEN * least)
    }
}
