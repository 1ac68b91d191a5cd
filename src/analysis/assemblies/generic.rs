//! All solutions of one generic member of the family: random complex Newton seeds, spread by
//! monodromy.
//!
//! A loop through the family permutes the solutions within each irreducible component (Sommese,
//! Verschelde and Wampler 2001; Duff et al. 2019). Components are reached by seeds only: the two
//! operation modes of a 3-RPS never exchange solutions. Both are therefore repeated until neither
//! finds anything.

use rand::SeedableRng;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::coordinates::{C, size};
use super::family::{Family, Member};
use super::way::Way;
use super::{AssembliesSettings, threads};
use crate::number::Number;
use crate::solve::{Arrival, Homotopy, Newton, Stages, Stop, Tracker};

/// The quotient of pivots below which a solution of a generic member counts as one of infinitely
/// many (or of several that always coincide).
const REGULAR: f64 = 1e-7;

/// All solutions of a generic member, kept to be carried to any inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GenericSolutions {
    /// Names of the mechanism and its joints, values of its parameters and what is held: the
    /// solutions serve no other question.
    pub(super) question: String,
    pub(super) parameters: Vec<[f64; 2]>,
    pub(super) inputs: Vec<[f64; 2]>,
    pub(super) solutions: Vec<Vec<[f64; 2]>>,
    /// Freedom left when the inputs are held: the least dimension of a set of solutions that was
    /// met, 0 if there was none. There may be isolated solutions beside it.
    pub freedom: usize,
    /// Newton seeds tried.
    pub seeds: usize,
    /// Seeds that met a set of solutions which is not isolated.
    pub not_isolated: usize,
    /// Monodromy loops, each followed by every solution known.
    pub loops: usize,
    /// Seeds since the last discovery.
    pub quiet_seeds: usize,
    /// Loops since the last discovery.
    pub quiet_loops: usize,
    /// The random seed.
    pub seed: u64,
}

fn pairs(x: &[C]) -> Vec<[f64; 2]> {
    x.iter().map(|z| [z.re, z.im]).collect()
}

pub(super) fn numbers(x: &[[f64; 2]]) -> Vec<C> {
    x.iter().map(|z| C::new(z[0], z[1])).collect()
}

impl GenericSolutions {
    /// How many isolated complex solutions a generic member has.
    pub fn count(&self) -> usize {
        self.solutions.len()
    }

    pub(super) fn member(&self) -> Member {
        Member {
            parameters: numbers(&self.parameters),
            inputs: numbers(&self.inputs),
        }
    }
}

fn generator(seed: u64, stream: u64) -> Pcg64 {
    Pcg64::seed_from_u64(
        seed.wrapping_mul(0x9E37_79B9_7F4A_7C15)
            .wrapping_add(stream),
    )
}

/// How far a search is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Generic solutions found.
    pub found: usize,
    /// Newton seeds tried.
    pub seeds: usize,
    /// Monodromy loops gone.
    pub loops: usize,
}

struct Search<'a> {
    watch: &'a dyn Fn(Progress),
    bound: Option<usize>,
    family: &'a Family,
    settings: &'a AssembliesSettings,
    base: Member,
    found: Vec<Vec<C>>,
    freedom: Option<usize>,
    seeds: usize,
    not_isolated: usize,
    loops: usize,
    quiet_seeds: usize,
    quiet_loops: usize,
}

enum Seed {
    Nothing,
    Isolated(Vec<C>),
    Free(usize),
}

/// Searches a generic member. `None` if a dimension has no value anywhere near.
pub(super) fn search(
    family: &Family,
    question: String,
    bound: Option<usize>,
    settings: &AssembliesSettings,
    watch: &dyn Fn(Progress),
) -> Option<GenericSolutions> {
    let mut rng = generator(settings.seed, 0);
    let inputs = family.random_inputs(&mut rng, 1.0);
    // without inputs to vary, the dimensions themselves make the family
    let parameters = match inputs.is_empty() {
        true => family.random_parameters(&mut rng),
        false => family.parameters.clone(),
    };
    let mut search = Search {
        watch,
        bound,
        family,
        settings,
        base: Member { parameters, inputs },
        found: Vec::new(),
        freedom: None,
        seeds: 0,
        not_isolated: 0,
        loops: 0,
        quiet_seeds: 0,
        quiet_loops: 0,
    };
    search.run()?;
    Some(GenericSolutions {
        question,
        parameters: pairs(&search.base.parameters),
        inputs: pairs(&search.base.inputs),
        solutions: search.found.iter().map(|x| pairs(x)).collect(),
        freedom: search.freedom.unwrap_or(0),
        seeds: search.seeds,
        not_isolated: search.not_isolated,
        loops: search.loops,
        quiet_seeds: search.quiet_seeds,
        quiet_loops: search.quiet_loops,
        seed: settings.seed,
    })
}

impl Search<'_> {
    fn run(&mut self) -> Option<()> {
        let still = self.family.way(&self.base, &self.base)?;
        loop {
            let known = self.found.len();
            if self.loops > 0 && self.bound == Some(known) {
                return Some(());
            }
            while self.quiet_seeds < self.settings.quiet_seeds {
                self.sow(&still);
                self.tell();
                let enough = self.loops == 0 && !self.found.is_empty();
                let hopeless = self.found.is_empty() && self.seeds >= self.settings.hopeless_seeds;
                if enough || hopeless || self.seeds >= self.settings.most_seeds {
                    break;
                }
            }
            let quiet = self.loops > 0 && self.found.len() == known;
            let short = self.bound.is_some_and(|bound| self.found.len() < bound);
            if self.found.is_empty() || (quiet && !short) {
                return Some(());
            }
            self.quiet_loops = 0;
            // below a known bound the end is doubted once
            let wanted = match quiet {
                true => 3 * self.settings.quiet_loops,
                false => self.settings.quiet_loops,
            };
            let before = self.found.len();
            while self.quiet_loops < self.enough_loops(wanted)
                && self.loops < self.settings.most_loops
            {
                self.spread();
                self.tell();
            }
            if quiet && self.found.len() == before {
                return Some(());
            }
            self.quiet_seeds = 0;
        }
    }

    /// Where the known bound is reached, two loops that bring nothing are enough.
    fn enough_loops(&self, wanted: usize) -> usize {
        match self.bound == Some(self.found.len()) {
            true => wanted.min(2),
            false => wanted,
        }
    }

    fn add(&mut self, x: Vec<C>) -> bool {
        let coordinates = &self.family.coordinates;
        let new = !self.found.iter().any(|known| coordinates.same(known, &x));
        if new {
            self.found.push(x);
        }
        new
    }

    fn tell(&self) {
        (self.watch)(Progress {
            found: self.found.len(),
            seeds: self.seeds,
            loops: self.loops,
        });
    }

    /// A batch of Newton iterations from random complex points.
    fn sow(&mut self, still: &Way<'_>) {
        const BATCH: usize = 32;
        let (first, seed) = (self.seeds as u64, self.settings.seed);
        let ends = threads::each(BATCH, still, |way, i| {
            let mut rng = generator(seed, 1 + ((first + i as u64) << 1));
            sow_one(way, &mut rng)
        });
        for end in ends {
            self.seeds += 1;
            match end {
                Seed::Nothing => {}
                Seed::Isolated(x) => {
                    let new = self.add(x);
                    self.quiet_seeds = if new { 0 } else { self.quiet_seeds + 1 };
                }
                Seed::Free(freedom) => {
                    self.not_isolated += 1;
                    self.quiet_seeds += 1;
                    self.freedom = Some(self.freedom.map_or(freedom, |f| f.min(freedom)));
                }
            }
        }
    }

    /// One loop through two other random members, followed by every known solution.
    fn spread(&mut self) {
        self.loops += 1;
        let mut rng = generator(self.settings.seed, (self.loops as u64) << 1);
        // every fourth loop changes dimensions too: at special dimensions the inputs alone may not
        // exchange all solutions
        let resize = self.loops.is_multiple_of(4) || self.base.inputs.is_empty();
        // small loops go round few of the places where solutions meet
        let reach = [1.0, 2.0, 4.0][self.loops % 3];
        let mut member = || Member {
            inputs: self.family.random_inputs(&mut rng, reach),
            parameters: match resize {
                true => self.family.random_parameters(&mut rng),
                false => self.base.parameters.clone(),
            },
        };
        let corners = [self.base.clone(), member(), member(), self.base.clone()];
        let mut points: Vec<Option<Vec<C>>> = self.found.iter().cloned().map(Some).collect();
        for pair in corners.windows(2) {
            let Some(way) = self.family.way(&pair[0], &pair[1]) else {
                return;
            };
            points = threads::each(points.len(), &way, |way, i| {
                follow(way, points[i].as_ref()?)
            });
        }
        let known = self.found.len();
        let Some(mut still) = self.family.way(&self.base, &self.base) else {
            return;
        };
        for x in points.into_iter().flatten() {
            if still.regularity(C::from_f64(1.0), &x) > REGULAR {
                self.add(x);
            }
        }
        self.quiet_loops = if self.found.len() > known {
            0
        } else {
            self.quiet_loops + 1
        };
    }
}

fn follow(way: &mut Way<'_>, from: &[C]) -> Option<Vec<C>> {
    let mut x = from.to_vec();
    let whole = (C::from_f64(0.0), C::from_f64(1.0));
    let track = Tracker::default().track(way, whole, &mut x, &mut Stages::new(from.len()));
    let end = whole.1;
    (track.arrival == Arrival::There && polish(way, end, &mut x)).then_some(x)
}

/// Newton steps until the last digits; whether the point is a solution then.
pub(super) fn polish(way: &mut Way<'_>, s: C, x: &mut [C]) -> bool {
    for _ in 0..4 {
        let step = way.correct(s, x);
        if !step.is_finite() {
            return false;
        }
        if step < 1e-13 * (1.0 + size(x)) {
            break;
        }
    }
    way.residual(s, x) <= 1e-10 * (1.0 + size(x).powi(2))
}

fn sow_one(way: &mut Way<'_>, rng: &mut Pcg64) -> Seed {
    let start = way.family.random_point(rng);
    let zero = C::from_f64(0.0);
    way.linearise(zero, &start);
    let newton = Newton {
        max_steps: 60,
        ..Newton::default()
    };
    let mut point = way.at.clone();
    let mut trial = point.clone();
    let report = newton.solve(&way.system, &mut point, &mut trial, &mut way.work);
    if report.stop != Stop::Solved {
        return Seed::Nothing;
    }
    let x = way.family.coordinates.flatten(&point);
    if size(&x).is_nan() || size(&x) > 1e3 {
        return Seed::Nothing;
    }
    if way.regularity(zero, &x) > REGULAR {
        return Seed::Isolated(x);
    }
    // Newton's method from beside a set of solutions ends elsewhere on it, but from beside solutions
    // that coincide at the same point again
    way.linearise(zero, &way.family.shaken(&x, rng));
    let mut beside = way.at.clone();
    let report = newton.solve(&way.system, &mut beside, &mut trial, &mut way.work);
    let beside = way.family.coordinates.flatten(&beside);
    let apart = way.family.coordinates.difference(&x, &beside);
    match report.stop == Stop::Solved && apart > 1e-3 && apart < 1.0 {
        true => Seed::Free(way.freedom(zero, &x, 1e-5)),
        false => Seed::Nothing,
    }
}
