//! All four-bars whose coupler point passes through nine points, in the numbers of a mechanism, and the cognates of designs.

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_pcg::Pcg64;

use super::coupler_curve::{FourBar, Z, classes};
use super::exact::{Exact, Triples};
use super::pinned::PinnedFourBar;
use super::report::Cognate;
use super::search::{FoundEnd, MET, SearchedEnds, Task};
use crate::mechanism::Configuration;
use crate::number::sorting::sort_by;
use crate::number::tolerance::SAME;
use crate::number::{C, real};
use crate::solve::{LeastSquares, LevenbergMarquardt, Watch, each};
use crate::system::{Bundle, Bundled};

/// By how much a part of a four-bar has turned where its point has moved by δ and its coupler by T.
fn turned(of: &FourBar, (d, turn): (Z, C), part: usize) -> f64 {
    let angle = |z: C| real::atan2(z.im, z.re);
    let link = |i: usize| {
        let far = of.pins[i][0] - of.pivots[i][0];
        let now = d[0] + turn * of.pins[i][0] - of.pivots[i][0];
        angle(now / far)
    };
    match part {
        1 => link(0),
        2 => angle(turn),
        3 => link(1),
        _ => 0.0,
    }
}

fn is_real(of: &FourBar) -> bool {
    let vectors = of.pivots.iter().chain(&of.pins);
    let size = vectors
        .clone()
        .flatten()
        .map(|z| z.norm_sqr())
        .fold(0.0, f64::max)
        .sqrt();
    vectors
        .into_iter()
        .all(|z| (z[0] - z[1].conj()).norm_sqr().sqrt() <= SAME * size)
}

impl Task<'_> {
    /// All four-bars whose coupler point passes through nine points; `None` for other tasks.
    pub(super) fn nine_points(&self, watch: &Watch) -> Option<(Exact, SearchedEnds)> {
        let path = self.path.as_ref()?;
        let points: &[[f64; 2]; 9] = path.points.as_slice().try_into().ok()?;
        if self.ranges.len() != 9 || self.bundle.surplus(self.positions) != Some(0) {
            return None;
        }
        let found = classes(points, watch);
        // both orders of the links of a linkage one after another
        let mut jobs = Vec::new();
        let mut triples = Triples {
            generic: found.generic,
            different: found.different.len(),
            real: 0,
        };
        let mut class = 0;
        for four_bar in &found.different {
            let all = four_bar.all();
            triples.real += usize::from(all.iter().any(is_real));
            for pair in all.chunks_exact(2).filter(|pair| is_real(&pair[0])) {
                class += 1;
                jobs.extend(pair.iter().map(|of| (class, *of)));
            }
        }
        let single = path.single(&self.bundle).written(1);
        let ends = each(jobs.len(), &(), |(), i| {
            let (class, of) = jobs[i];
            let at = (!watch.is_stopped()).then(|| self.placed(path, &single, &of))??;
            Some(FoundEnd {
                squares: self.bundle.misfit(&at).squares,
                at,
                reached: 1,
                finished: true,
                class,
            })
        });
        let mut ends: Vec<FoundEnd> = ends.into_iter().flatten().collect();
        let mut inside: Vec<usize> = ends.iter().map(|end| end.class).collect();
        inside.dedup();
        sort_by(&mut ends, |a, b| {
            let pairs = a.at.numbers.iter().zip(&b.at.numbers);
            let mut orders = pairs.map(|(a, b)| a.total_cmp(b));
            orders
                .find(|order| order.is_ne())
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        let exact = Exact {
            generic: 6 * found.generic,
            classes: 3 * found.generic,
            arrived: found.arrived,
            at_infinity: found.at_infinity,
            lost: found
                .generic
                .saturating_sub(found.arrived + found.at_infinity),
            different: 3 * found.different.len(),
            real: class,
            outside: class - inside.len(),
            triples: Some(triples),
            ..Exact::default()
        };
        let searched = SearchedEnds {
            found: ends,
            interrupted: watch.is_stopped(),
            ..SearchedEnds::default()
        };
        Some((exact, searched))
    }

    /// The numbers and configurations for a real four-bar; `None` if none in the ranges were found.
    fn placed(&self, path: &PinnedFourBar, single: &Bundle, of: &FourBar) -> Option<Bundled> {
        /// Random numbers from which the pins are sought at most.
        const TRIES: u64 = 60;
        let zero = MET * self.size * self.size;
        let points = &path.points;
        let pins = of
            .pivots
            .iter()
            .chain(&of.pins)
            .flat_map(|z| [points[0][0] + z[0].re, points[0][1] + z[0].im]);
        let values: Vec<f64> = pins.chain(points[0]).collect();
        let mut single = single.clone();
        single.aim(&values);
        let method = LevenbergMarquardt {
            damping: 1e-2,
            tolerance: 1e-13,
            steps: 100,
        };
        let first = (0..TRIES).find_map(|number| {
            let mut rng = Pcg64::seed_from_u64(self.seed.wrapping_add(number));
            let numbers = self.numbers(&mut rng);
            let start = single.closer(&numbers)?.closed(0, self.random(&mut rng))?;
            let start = Bundled {
                numbers,
                configurations: vec![start],
            };
            let end = method.solve(&single, start);
            (end.misfit.squares + end.misfit.equations <= 1e4 * zero).then_some(end.point)
        })?;
        let configurations = points.iter().map(|p| {
            let [x, y] = [p[0] - points[0][0], p[1] - points[0][1]];
            self.moved(
                path,
                of,
                &first.configurations[0],
                [C::new(x, y), C::new(x, -y)],
            )
        });
        let at = Bundled {
            configurations: configurations.collect::<Option<_>>()?,
            numbers: first.numbers,
        };
        let polish = LevenbergMarquardt {
            damping: 0.0,
            tolerance: 1e-13,
            steps: 10,
        };
        let end = polish.solve(&self.bundle, at);
        (end.misfit.squares + end.misfit.equations <= zero).then_some(end.point)
    }

    /// The configuration where the point has moved by δ, from the first one: each pin turns by the difference of its parts.
    fn moved(
        &self,
        path: &PinnedFourBar,
        of: &FourBar,
        first: &Configuration<f64>,
        d: Z,
    ) -> Option<Configuration<f64>> {
        let turn = match d[0].norm_sqr() > 0.0 {
            true => of.turn(d)?,
            false => C::new(1.0, 0.0),
        };
        let count = first.joints.len();
        let (mut rows, mut by) = (DMatrix::zeros(count, count), DVector::zeros(count));
        for (i, row) in path.turns.iter().enumerate() {
            let [before, behind] = row.parts.map(|part| turned(of, (d, turn), part));
            by[i] = row.sense * (behind - before);
            for (joint, factor) in &row.joints {
                rows[(i, *joint)] = *factor;
            }
        }
        let by = rows.lu().solve(&by)?;
        let mut at = first.clone();
        at.joints
            .iter_mut()
            .zip(by.iter())
            .for_each(|(x, by)| *x += by);
        Some(at)
    }

    /// For each of some designs its two cognates (Roberts 1875), where the point of a four-bar passes through points.
    pub fn cognates(&self, designs: &[&Bundled]) -> Vec<Vec<Cognate>> {
        let Some(path) = &self.path else {
            return vec![Vec::new(); designs.len()];
        };
        let drawn = designs.iter().map(|at| path.four_bar(&self.bundle, at));
        let drawn: Vec<Option<(FourBar, Z)>> = drawn.collect();
        let near = |a: &FourBar, b: &FourBar| {
            let pairs = a
                .pivots
                .iter()
                .chain(&a.pins)
                .zip(b.pivots.iter().chain(&b.pins));
            let mut apart = pairs.map(|(a, b)| (a[0] - b[0]).norm_sqr().sqrt());
            apart.all(|apart| apart < SAME * self.size)
        };
        let listed = |of: &FourBar| {
            let same = |drawn: &Option<(FourBar, Z)>| {
                drawn
                    .as_ref()
                    .is_some_and(|(known, _)| near(known, of) || near(known, &of.exchanged()))
            };
            drawn.iter().position(same).map(|i| i + 1)
        };
        let both = |(of, point): &(FourBar, Z)| {
            let all = of.all();
            [all[2], all[4]].map(|of| {
                let place = |z: &Z| [point[0].re + z[0].re, point[0].im + z[0].im];
                let far = |a: Z, b: Z| (a[0] - b[0]).norm_sqr().sqrt();
                let ([a, b], [x, y]) = (of.pivots, of.pins);
                Cognate {
                    pivots: of.pivots.each_ref().map(place),
                    pins: of.pins.each_ref().map(place),
                    lengths: [far(a, b), far(a, x), far(x, y), far(y, b)],
                    design: listed(&of),
                }
            })
        };
        let each = drawn.iter();
        each.map(|of| of.as_ref().map_or_else(Vec::new, |of| both(of).to_vec()))
            .collect()
    }
}
