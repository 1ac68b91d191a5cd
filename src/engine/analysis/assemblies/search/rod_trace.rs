//! A trace test with a cut that is a smaller problem, which shows that no solution is missing.
//!
//! While t, half the square of a rod's length, changes by itself, or in a smaller problem one distance of two points that a pin
//! joins, solutions run over a curve. For f = e^{iθ} of any joint,
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
use crate::analysis::assemblies::family::{
    C, Family, LegwiseSolutions, Member, count, known_bound, points,
};
use crate::analysis::assemblies::track::{ParameterHomotopy, START, tracked};
use crate::mechanism::ClosureKind;
use crate::number::tolerance::ROUNDING;
use crate::number::{Number, complex::norm};
use crate::solve::{Progress, Watch};

/// Pairs of rod and joint that are looked at.
const PAIRS: usize = 40;
/// Cuts that are kept.
const CUTS: usize = 8;
/// Unknowns of a problem from which it is worth while to descend to smaller ones without a known number.
const SMALL: usize = 10;

/// Finds the solutions of a member of another family, which has so many at most.
pub(super) type Smaller<'a> =
    dyn Fn(&Family, Option<usize>, Member) -> Option<GenericSolutions> + 'a;

/// Generators of random numbers.
pub(super) type Random<'a> = dyn Fn(u64) -> Pcg64 + 'a;

/// A rod that is left out and a joint that is held instead.
pub(super) struct Cut {
    /// The row of the rod.
    row: usize,
    /// The place of the joint among the unknowns.
    place: usize,
    /// i times the scale of the joint over its turns.
    turning: C,
    /// The smaller problem.
    less: Family,
    /// The number of solutions that it has at most, if that is known.
    most: Option<usize>,
}

impl Cut {
    /// Cuts in the order in which they are to be taken from the end: those with the fewest points last, before them those
    /// for which the same test must tell whether they are complete. In place of a rod, points may be let go `of_points` that
    /// joints bring together, in one direction.
    pub fn all(family: &Family, of_points: bool) -> Vec<Cut> {
        let coordinates = &family.coordinates;
        // the curve is algebraic only where every angle comes back
        let returns = |j: &usize| family.turns(*j).is_none_or(|turns| turns.is_some());
        let closures = family.mechanism.closures();
        let related = closures.iter().any(|c| c.kind == ClosureKind::Coupling);
        if related || !family.is_square || !coordinates.free_joints.iter().all(returns) {
            return Vec::new();
        }
        let joints = 0..coordinates.free_joints.len();
        let rows = family.rows(of_points).into_iter();
        let pairs = rows.flat_map(|row| joints.clone().map(move |j| (row, j)));
        let cuts = pairs.take(PAIRS).filter_map(|((own, row), place)| {
            let joint = coordinates.free_joints[place];
            let turning = C::new(0.0, coordinates.joint_scales[joint] / family.turns(joint)??);
            let less = family.without(own, joint)?;
            let most = known_bound(&less.mechanism, &less).map(|bound| bound.count);
            let cut = Cut {
                row,
                place,
                turning,
                less,
                most,
            };
            (most.is_some() || coordinates.count() <= SMALL).then_some(cut)
        });
        let mut cuts: Vec<Cut> = cuts.collect();
        cuts.sort_by_key(|cut| cut.most.unwrap_or(usize::MAX));
        cuts.truncate(CUTS);
        cuts.reverse();
        cuts
    }

    /// True if it has no more points than that, as far as is known.
    pub fn has_at_most(&self, points: usize) -> bool {
        self.most.is_none_or(|most| most <= points)
    }
}

/// The trace tests of the solutions of one member, by one cut after the other.
#[derive(Default)]
pub(super) struct Traces<'f> {
    /// True if a cut need not be a rod.
    of_points: bool,
    /// The cuts that are left, once they were looked for.
    cuts: Option<Vec<Cut>>,
    test: Option<RodTrace<'f>>,
    /// Numbers of solutions that were tested last, and for which a test failed last.
    tested: usize,
    failed: usize,
}

impl<'f> Traces<'f> {
    pub fn new(of_points: bool) -> Self {
        Traces {
            of_points,
            ..Traces::default()
        }
    }

    /// True if these solutions of a member are shown to be all. So many of them are tested once.
    pub fn hold(
        &mut self,
        family: &'f Family,
        (member, legwise): (&Member, &[LegwiseSolutions]),
        (smaller, random): (&Smaller<'_>, &Random<'_>),
        watch: (&Watch, Progress),
    ) -> bool {
        const MOST: usize = 5000;
        let count = count(legwise);
        if self.tested == count || count > MOST {
            return false;
        }
        self.tested = count;
        let cuts = self
            .cuts
            .get_or_insert_with(|| Cut::all(family, self.of_points));
        while self.test.is_none()
            && let Some(cut) = cuts.pop_if(|cut| cut.has_at_most(64 + 2 * count))
        {
            let how = (smaller, &mut random(cuts.len() as u64));
            self.test = RodTrace::new(family, member, cut, how);
        }
        let solutions = || points(legwise, &family.coordinates);
        let holds = (self.test.as_mut()).map(|test| test.holds(&solutions(), watch));
        match holds.flatten() {
            Some(true) => return true,
            Some(false) => self.failed = count,
            None => self.test = None,
        }
        false
    }

    /// True if a test failed for so many solutions.
    pub fn fail_for(&self, count: usize) -> bool {
        count > 0 && self.failed == count
    }

    /// Tests so many solutions again with another cut if they failed with this one, of which points may be missing. False if
    /// there is none.
    pub fn doubt_the_cut(&mut self, count: usize) -> bool {
        let others = self.cuts.as_ref().is_some_and(|cuts| !cuts.is_empty());
        let again = self.fail_for(count) && others;
        if again {
            (self.test, self.tested) = (None, 0);
        }
        again
    }
}

/// The trace test with one cut, and how the solutions known so far contribute.
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
    /// `None` where it is not known that all points of the cut are found.
    pub fn new(
        family: &'f Family,
        base: &Member,
        cut: Cut,
        (smaller, rng): (&Smaller<'_>, &mut Pcg64),
    ) -> Option<Self> {
        let Cut {
            row,
            place,
            turning,
            less,
            most,
        } = cut;
        let coordinates = &family.coordinates;
        let angle = C::new(rng.random_range(-3.1..3.1), rng.random_range(-0.7..0.7));
        let held = Member {
            parameters: base.parameters.clone(),
            inputs: [base.inputs.as_slice(), &[angle]].concat(),
        };
        let all = smaller(&less, most, held)?;
        if all.count() == 0 || !(all.search.traced || most == Some(all.count())) {
            return None;
        }
        let scale = coordinates.joint_scales[coordinates.free_joints[place]];
        let level = Number::exp(turning * angle / scale);
        let other = C::new(rng.random_range(-0.5..0.5), rng.random_range(0.2..0.7));
        let mut way = family.homotopy(base, base)?.raising(row, other);
        let mut cut = (C::from_f64(0.0), 0.0);
        for mut x in points(&all.legwise, &less.coordinates) {
            x.insert(place, angle / scale);
            let t = way.evaluated(START, &x).0[row];
            let rate = turning * level * way.rate(START, &x, row)?[place];
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
        let ends = tracked(&self.way, &new, watch);
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
        // one like the known solution whose term changes least would be missed
        Some(norm(sum) <= ROUNDING * all && norm(sum) <= 1e-3 * least)
    }
}
