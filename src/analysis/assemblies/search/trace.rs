//! Trace test: no loop of the inputs leads from the known solutions to others.
//!
//! While an input t moves, the solutions (x, t) run over an algebraic curve. For a function f that is regular on it, a
//! level c and two places a and b of t the residues of dt/((t − a)(t − b)(f − c)) add up to zero, those at infinity being zero:
//!
//! Σ_{t=a} 1/(f − c) − Σ_{t=b} 1/(f − c) + (a − b) Σ_{f=c} 1/((t − a)(t − b) df/dt) = 0.
//!
//! This is the test of Leykin, Rodriguez and Sottile (Trace test, 2018) for the two cuts t = a and f = c, read off
//! at two places of t instead of a pencil of cuts. If a loop of t leads from the known solutions to others, the first
//! sum goes to another value on it, but the last does not: the identity fails, whatever is known of f = c.
//!
//! Each part of the branch locus is met by some input that moves alone, at general values of the others; loops round
//! these parts, and what they become when they are carried elsewhere, make up all loops.

use rand::Rng;
use rand_pcg::Pcg64;

use crate::analysis::assemblies::family::{C, Direction, Family, Member};
use crate::analysis::assemblies::track::{Cut, Form, tracked};
use crate::number::{Number, complex};
use crate::solve::{Progress, Watch};

/// Sums that are zero but for rounding, relative to the sum of absolute values.
const ROUNDING: f64 = 1e-9;
/// Largest sum relative to the least that a known solution contributes, so that one like it would be missed.
const SEEN: f64 = 1e-3;
/// Starting points for each level, unless there are more solutions.
const STARTS: usize = 8;
/// Paths for each solution, and some more, after which loops are faster: those that are saved take about as many.
const PATHS: usize = 30;
const MORE: usize = 20;

/// True if the identity holds for every direction of the family; false where it does not, or where that is not found
/// out at a reasonable cost.
pub(crate) fn holds(
    family: &Family,
    base: &Member,
    solutions: &[Vec<C>],
    rng: &mut Pcg64,
    watch: (&Watch, Progress),
) -> bool {
    let mut paths = PATHS * (solutions.len() + MORE);
    let directions = family.directions().unwrap_or_default();
    let along = |direction: &Direction| {
        holds_along(
            family,
            base,
            direction,
            solutions,
            (&mut *rng, &mut paths),
            watch,
        )
        .is_some()
    };
    !directions.is_empty() && directions.iter().all(along)
}

/// `None` if the identity does not hold before paths are lost, or too many.
fn holds_along(
    family: &Family,
    base: &Member,
    direction: &Direction,
    solutions: &[Vec<C>],
    (rng, paths): (&mut Pcg64, &mut usize),
    watch: (&Watch, Progress),
) -> Option<()> {
    let (zero, one) = (C::from_f64(0.0), C::from_f64(1.0));
    let other = family.moved(base, direction, rng);
    let way = family.homotopy(base, &other)?;
    let form = Form::random(family, rng)?;
    let value = |x: &[C]| form.at(x, x).0;
    let mut ends: Vec<Option<Vec<C>>> = solutions.iter().cloned().map(Some).collect();
    tracked(&way, &mut ends, watch);
    let ends: Vec<Vec<C>> = ends.into_iter().collect::<Option<_>>()?;

    // t and dt/ds where the way is at s
    let turn = direction.turning(base, &other);
    let place = |s: C| match turn {
        Some(rate) => Number::exp(rate * s),
        None => s,
    };
    let speed = |s: C| turn.map_or(one, |rate| rate * place(s));
    let (a, b) = (place(zero), place(one));
    let same = |y: &[C], z: &[C]| {
        let ((s, x), (r, w)) = (y.split_last()?, z.split_last()?);
        let apart = complex::norm(place(*s) - place(*r));
        Some(apart <= 1e-6 * complex::norm(place(*s)).max(1.0) && family.coordinates.same(x, w))
    };

    let mut cut = Cut::new(way, form.clone());
    let mut known: Vec<Vec<C>> = Vec::new();
    loop {
        // from other places of the curve each time, where other points are near
        let mut starts = Vec::new();
        for _ in 0..STARTS.div_ceil(solutions.len()) {
            let far = C::new(rng.random_range(-3.0..3.0), rng.random_range(-3.1..3.1));
            let elsewhere = turn.map_or_else(|| Number::exp(far), |rate| far / rate);
            starts.extend(cut.spread(solutions, elsewhere, watch));
        }
        let there = value(starts.first()?);
        let beside = C::new(rng.random_range(-0.7..0.7), rng.random_range(-0.7..0.7));
        cut.to = there + beside * complex::norm(there);
        let before = known.len();
        starts.append(&mut known);
        *paths = paths.checked_sub(starts.len())?;
        for y in cut.carried(&starts, watch) {
            if !known.iter().any(|z| same(&y, z) == Some(true)) {
                known.push(y);
            }
        }
        // while more are found some are missing
        if known.len() > before {
            continue;
        }
        *paths = paths.checked_sub(known.len())?;
        let of = |points: &[Vec<C>]| -> Vec<C> {
            points.iter().map(|x| one / (value(x) - cut.to)).collect()
        };
        let mut terms = [of(solutions), of(&ends).iter().map(|z| -z).collect()].concat();
        for y in &known {
            let s = *y.last()?;
            let rate = cut.rate(y)?;
            terms.push((a - b) * speed(s) / ((place(s) - a) * (place(s) - b) * rate));
        }
        let sum: C = terms.iter().sum();
        let all: f64 = terms.iter().map(|z| complex::norm(*z)).sum();
        let sizes = terms[..solutions.len()].iter().map(|z| complex::norm(*z));
        let least = sizes.fold(f64::INFINITY, f64::min);
        if complex::norm(sum) <= ROUNDING * all && complex::norm(sum) <= SEEN * least {
            return Some(());
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;
    use crate::analysis::assemblies::AssembliesSettings;
    use crate::analysis::assemblies::search::{GenericSolutions, search};
    use crate::description::Description;
    use crate::mechanism::Mechanism;
    use crate::solve::Stage;
    use crate::system::Question;

    /// A shipped mechanism whose solutions are known to be so many.
    fn known(text: &str, count: usize) -> (Family, GenericSolutions) {
        let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
        let family = Family::new(&mechanism, &Question::new(&mechanism).held());
        let settings = AssembliesSettings::default();
        let found = search(
            &family,
            String::new(),
            Some(count),
            &settings,
            &Watch::none(),
        );
        let found = found.unwrap();
        assert_eq!(found.count(), count);
        (family, found)
    }

    fn is_complete(family: &Family, base: &Member, solutions: &[Vec<C>]) -> bool {
        let watch = (&Watch::none(), Progress::of(Stage::Paths));
        let mut tries = (1..=3).map(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed);
            holds(family, base, solutions, &mut rng, watch)
        });
        tries.any(|holds| holds)
    }

    /// Freudenstein 1955, Hunt 1983, Primrose, Freudenstein and Roth 1967; the triangle has no inputs, only lengths.
    #[test]
    fn published_counts_hold_and_no_solution_can_be_left_out() {
        for (text, count) in [
            (include_str!("../../../../mechanisms/four_bar.ron"), 2),
            (include_str!("../../../../mechanisms/five_bar.ron"), 2),
            (include_str!("../../../../mechanisms/triangle.ron"), 2),
            (include_str!("../../../../mechanisms/planar_3rpr.ron"), 6),
            (
                include_str!("../../../../mechanisms/stephenson_six_bar.ron"),
                6,
            ),
        ] {
            let (family, found) = known(text, count);
            let points = found.legwise.iter();
            let all: Vec<Vec<C>> = points.flat_map(|s| s.points(&family.coordinates)).collect();
            assert!(is_complete(&family, &found.member(), &all), "{count}");
            for left_out in 0..all.len() {
                let mut rest = all.clone();
                rest.remove(left_out);
                assert!(!is_complete(&family, &found.member(), &rest), "{count}");
            }
        }
    }

    /// A parallelogram and the same bars crossed are exchanged by no motion of the crank (each is a rational curve):
    /// either is complete by itself, unlike those of a general four-bar.
    #[test]
    fn solutions_that_no_loop_leads_to_are_not_missed() {
        let text = include_str!("../../../../mechanisms/parallelogram.ron");
        let (family, found) = known(text, 2);
        let points = found.legwise.iter();
        for x in points.flat_map(|s| s.points(&family.coordinates)) {
            assert!(is_complete(&family, &found.member(), &[x]));
        }
    }
}
