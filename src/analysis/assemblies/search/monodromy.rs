//! All solutions of one generic member of the family: random complex Newton seeds, spread by
//! monodromy.
//!
//! A loop through the family permutes the solutions within each irreducible component (Sommese,
//! Verschelde and Wampler 2001; Duff et al. 2019). Other components are reached by seeds only, as the
//! two operation modes of a 3-RPS. Seeds are started at every corner of every loop, and what they find
//! is tracked home by the rest of it, until neither seeds nor loops find anything.
//!
//! If a component is known in part, a random element of its monodromy group keeps the known solutions
//! among themselves with probability ½ at most (those that do are a proper subgroup). A loop that lost
//! a path does not count, unless there are hundreds: some of so many pass where double precision fails. Where the trace
//! test holds, fewer loops are enough.

mod seeds;

use rand::SeedableRng;
use rand_pcg::Pcg64;

use super::super::AssembliesSettings;
use super::rod_trace::RodTrace;
use super::solutions::GenericSolutions;
use super::{six_rods, trace};
use crate::analysis::assemblies::family::{C, Coordinates, Family, Member, learn};
use crate::analysis::assemblies::track::{ParameterHomotopy, stands_alone, tracked};
use crate::number::Number;
use crate::solve::{Progress, Stage, Watch};

fn generator(seed: u64, stream: u64) -> Pcg64 {
    Pcg64::seed_from_u64(
        seed.wrapping_mul(0x9E37_79B9_7F4A_7C15)
            .wrapping_add(stream),
    )
}

struct Search<'a> {
    watch: &'a Watch<'a>,
    bound: Option<usize>,
    family: &'a Family,
    settings: &'a AssembliesSettings,
    base: Member,
    found: GenericSolutions,
    /// Number of solutions for which the trace test holds.
    traced: Option<usize>,
    /// The trace test over the length of a rod, and how often it was begun.
    cut: Option<RodTrace<'a>>,
    cuts: usize,
    /// Number of solutions from which on it is doubted that they are finite in number.
    doubtful: usize,
}

/// Searches a given member, or a generic one.
pub(super) fn search_one(
    family: &Family,
    question: &str,
    bound: Option<usize>,
    settings: &AssembliesSettings,
    watch: &Watch,
    base: Option<Member>,
) -> Option<GenericSolutions> {
    let mut rng = generator(settings.seed, 0);
    let base = base.unwrap_or_else(|| family.generic_member(&mut rng));
    let found = GenericSolutions {
        question: question.to_owned(),
        parameters: base.parameters.clone(),
        inputs: base.inputs.clone(),
        seed: settings.seed,
        ..GenericSolutions::default()
    };
    let mut search = Search {
        watch,
        bound,
        family,
        settings,
        base,
        found,
        traced: None,
        cut: None,
        cuts: 0,
        doubtful: DOUBTFUL,
    };
    match six_rods::solved(family, &search.base, watch) {
        Some((legwise, infinite)) => {
            search.found.legwise = legwise;
            search.found.general = Some(infinite);
        }
        None => {
            search.found.exhausted = search.run()?;
            search.found.traced = search.is_traced();
        }
    }
    if bound == Some(search.found.count()) {
        // no more are possible, so that what seemed to be others were these
        search.found.multiple = 0;
    }
    if search.found.endless {
        search.found.legwise.clear();
    }
    Some(search.found)
}

/// The search for the smaller problem of a trace test.
fn smaller<'a>(
    settings: &AssembliesSettings,
    watch: &'a Watch<'a>,
) -> impl Fn(&Family, Option<usize>, Member) -> Option<GenericSolutions> + 'a {
    const FEW: usize = 32;
    let few = AssembliesSettings {
        quiet_seeds: FEW,
        quiet_loops: 2,
        most_loops: FEW,
        ..settings.clone()
    };
    move |family, bound, member| search_one(family, "", bound, &few, watch, Some(member))
}

/// Seeds started at once at the generic member, and at most at a corner of a loop.
const BATCH: usize = 32;

/// Seeds after which a search that found nothing gives up.
const HOPELESS: usize = 600;

/// Number of known solutions from which on it is asked whether they are finite in number: more than the platforms and
/// single
/// loops that are studied have.
const DOUBTFUL: usize = 200;

/// Loops for each one that goes through other dimensions.
const RESIZED: usize = 6;

/// Paths for each one that may be lost in a loop of hundreds that counts.
const LOST_ONE_IN: usize = 4;

impl Search<'_> {
    /// Searches until nothing more is found; true if it ended at its limits, or was stopped, before. `None` if a
    /// dimension has no value.
    fn run(&mut self) -> Option<bool> {
        let still = self.family.homotopy(&self.base, &self.base)?;
        while self.found.legwise.is_empty() {
            if self.found.seeds >= HOPELESS || self.found.quiet_seeds >= self.settings.quiet_seeds {
                return Some(false);
            }
            if self.is_stopped_in_seeds() {
                return Some(true);
            }
            self.newton_seeds(&still);
        }
        loop {
            while self.found.quiet_loops < self.enough_loops() {
                if self.found.loops >= self.settings.most_loops || self.is_stopped_in_loops() {
                    return Some(true);
                }
                self.spread();
                if self.is_endless(&still) {
                    return Some(false);
                }
                self.trace();
                if self.found.complete {
                    return Some(false);
                }
            }
            if self.bound == Some(self.found.count()) {
                return Some(false);
            }
            while self.found.quiet_loops > 0 && self.found.quiet_seeds < self.settings.quiet_seeds {
                if self.found.seeds >= self.settings.most_seeds || self.is_stopped_in_seeds() {
                    return Some(true);
                }
                self.newton_seeds(&still);
            }
            if self.found.quiet_loops > 0
                && !self.mirror(&still)
                && !self.close_legs(&still)
                && (self.is_traced() || !self.look_far_out(&still))
            {
                return Some(false);
            }
        }
    }

    /// True if the solutions are not finite in number: with joints that never come back, or if seeds end at none that
    /// is known already. Were there N in all and known a part m/N of them, n seeds that end at a solution would miss
    /// all known ones with a probability of (1 − m/N)ⁿ: 1 % at 5000 solutions.
    fn is_endless(&mut self, still: &ParameterHomotopy<'_>) -> bool {
        const BATCHES: usize = 4;
        const ENDS: usize = 64;
        let zero = C::from_f64(0.0);
        let Coordinates {
            screws,
            incommensurate,
            ..
        } = &self.family.coordinates;
        if !(screws.is_empty() && incommensurate.is_empty()) {
            let mut still = still.clone();
            let mut known = self.spanning().into_iter();
            self.found.endless = known.any(|x| still.is_endless(zero, &x));
        }
        if self.found.endless || self.found.legwise.len() < self.doubtful {
            return self.found.endless;
        }
        self.doubtful = 2 * self.found.legwise.len();
        let (mut ends, mut known) = (0, 0);
        for _ in 0..BATCHES {
            for x in self.seeds(still, 1.0, None) {
                ends += 1;
                known += usize::from(!learn(
                    &mut self.found.legwise,
                    &self.family.coordinates,
                    &x,
                ));
            }
        }
        self.found.endless = ends >= ENDS && known <= ends / ENDS;
        self.found.endless
    }

    /// Every known solution tracked to the member with conjugate inputs: its solutions are the conjugates of those here,
    /// for the equations have real coefficients. True if one of them has a conjugate that is new.
    ///
    /// So a solution for real inputs and its conjugate are found both or not at all.
    fn mirror(&mut self, still: &ParameterHomotopy<'_>) -> bool {
        let conjugate = |of: &[C]| -> Vec<C> { of.iter().map(|z| z.conj()).collect() };
        let mirrored = Member {
            parameters: conjugate(&self.base.parameters),
            inputs: conjugate(&self.base.inputs),
        };
        let Some(way) = self.family.homotopy(&self.base, &mirrored) else {
            return false;
        };
        let mut points: Vec<Option<Vec<C>>> = self.spanning().into_iter().map(Some).collect();
        tracked(&way, &mut points, (self.watch, self.in_loops()));
        let (mut still, mut new) = (still.clone(), false);
        for x in points.into_iter().flatten().map(|x| conjugate(&x)) {
            if stands_alone(&mut still, C::from_f64(0.0), &x) {
                new |= learn(&mut self.found.legwise, &self.family.coordinates, &x);
            }
        }
        if new {
            self.found.quiet_loops = 0;
        }
        new
    }

    fn is_traced(&self) -> bool {
        self.traced == Some(self.found.count())
    }

    /// Runs the trace test where loops begin to bring nothing new.
    fn trace(&mut self) {
        const MOST: usize = 5000;
        const CUTS: usize = 3;
        let count = self.found.count();
        let (expected, watch) = (self.bound != Some(count), (self.watch, self.in_loops()));
        if expected && self.cut.is_none() && self.cuts < CUTS {
            self.cuts += 1;
            let mut rng = generator(self.settings.seed, (1 << 45) + self.cuts as u64);
            self.cut = RodTrace::new(
                self.family,
                &self.base,
                (&smaller(self.settings, self.watch), &mut rng),
                64 + 2 * count,
            );
        }
        if let Some(cut) = self.cut.as_mut().filter(|_| expected && count <= MOST) {
            let points = self.found.legwise.iter();
            let points = points.flat_map(|s| s.points(&self.family.coordinates));
            match cut.holds(&points.collect::<Vec<_>>(), watch) {
                Some(true) => {
                    self.found.complete = true;
                    self.traced = Some(count);
                    return;
                }
                Some(false) => {}
                None => self.cut = None,
            }
        }
        // where a bound is known more are expected
        let quiet = if self.bound.is_some() { [3, 6] } else { [1, 4] };
        // combinations of ways of legs would be followed one by one
        let combined = self.found.legwise.iter().any(|s| s.count() > s.spanning());
        let most = if combined { MOST / 16 } else { MOST };
        if quiet.contains(&self.found.quiet_loops)
            && !self.is_traced()
            && self.bound != Some(count)
            && count <= most
        {
            let points = self.found.legwise.iter();
            let points = points.flat_map(|s| s.points(&self.family.coordinates));
            let points: Vec<Vec<C>> = points.collect();
            let stream = (1 << 46) + self.found.loops as u64;
            let mut rng = generator(self.settings.seed, stream);
            let holds = trace::holds(self.family, &self.base, &points, &mut rng, watch);
            self.traced = holds.then_some(count);
        }
    }

    /// Number of loops without a discovery that end the search: one where the known bound is reached, half as many
    /// again below it. If the trace test holds, only loops through other dimensions may bring more, every sixth one if
    /// there are any.
    fn enough_loops(&self) -> usize {
        let quiet = self.settings.quiet_loops.max(1);
        if self.is_traced() {
            let resizes = !(self.family.by_dimensions || self.family.parameters.is_empty());
            return quiet.min(if resizes { RESIZED } else { 1 });
        }
        match self.bound.map(|bound| self.found.count().cmp(&bound)) {
            Some(std::cmp::Ordering::Equal) => 1,
            Some(_) => quiet + quiet / 2,
            None => quiet,
        }
    }

    fn is_stopped_in_seeds(&self) -> bool {
        let found = self.found.count();
        (self.watch).stops(Stage::Seeds { found }, self.found.seeds, None)
    }

    fn is_stopped_in_loops(&self) -> bool {
        self.watch.at(self.in_loops()).is_break()
    }

    fn in_loops(&self) -> Progress {
        Progress {
            stage: Stage::Loops {
                found: self.found.count(),
            },
            done: self.found.loops,
            of: None,
        }
    }

    /// One loop through two other random members, followed by every known solution and by what
    /// seeds find there.
    fn spread(&mut self) {
        self.found.loops += 1;
        let mut rng = generator(self.settings.seed, (self.found.loops as u64) << 1);
        // at special dimensions the inputs alone may not exchange all solutions
        let resize = self.found.loops.is_multiple_of(RESIZED) || self.family.by_dimensions;
        // small loops go round few branch points, and solutions far out meet at inputs far out
        let reach = [1.0, 2.0, 8.0, 4.0, 16.0][self.found.loops % 5];
        let mut member = || Member {
            inputs: self.family.random_inputs(&mut rng, reach),
            parameters: match resize {
                true => self.family.random_parameters(&mut rng, reach),
                false => self.base.parameters.clone(),
            },
        };
        let corners = [self.base.clone(), member(), member(), self.base.clone()];
        let coordinates = &self.family.coordinates;
        let mut points: Vec<Option<Vec<C>>> = self.spanning().into_iter().map(Some).collect();
        for pair in corners.windows(2) {
            let Some(homotopy) = self.family.homotopy(&pair[0], &pair[1]) else {
                return;
            };
            if pair[0] != self.base {
                let own = pair[0].parameters == self.base.parameters;
                self.newton_seeds_beside(&homotopy, (reach, own), &mut points);
            }
            tracked(&homotopy, &mut points, (self.watch, self.in_loops()));
        }
        let Some(mut still) = self.family.homotopy(&self.base, &self.base) else {
            return;
        };
        let all = points.len();
        let mut lost = points.iter().filter(|x| x.is_none()).count();
        let mut new = false;
        for x in points.into_iter().flatten() {
            match stands_alone(&mut still, C::from_f64(0.0), &x) {
                true => new |= learn(&mut self.found.legwise, coordinates, &x),
                // other dimensions may have solutions that meet, or go away, at the mechanism's own
                false => lost += usize::from(!resize),
            }
        }
        let whole = lost == 0 || all >= DOUBTFUL && lost <= all / LOST_ONE_IN;
        match (new, whole) {
            (true, _) => self.found.quiet_loops = 0,
            (false, true) => {
                self.found.quiet_loops += 1;
                self.found.lost_in_loops = self.found.lost_in_loops.max(lost);
            }
            (false, false) => {}
        }
    }

    /// Points that show every solution known.
    fn spanning(&self) -> Vec<Vec<C>> {
        let coordinates = &self.family.coordinates;
        let points = self.found.legwise.iter();
        points
            .flat_map(|s| s.spanning_points(coordinates))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::rod_trace::Smaller;
    use super::*;
    use crate::description::Description;
    use crate::mechanism::Mechanism;
    use crate::system::Question;

    /// The truss of 13 links has 126 solutions (`tests/data/truss_13.ron`), of which none can be left out.
    #[test]
    fn a_truss_is_complete_and_no_solution_can_be_left_out() {
        let text = include_str!("../../../../tests/data/truss_13.ron");
        let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
        let family = Family::new(&mechanism, &Question::new(&mechanism).held());
        let (settings, watch) = (AssembliesSettings::default(), Watch::none());
        let found = search_one(&family, "", None, &settings, &watch, None).unwrap();
        let points = found.legwise.iter();
        let all: Vec<Vec<C>> = points.flat_map(|s| s.points(&family.coordinates)).collect();
        assert_eq!((all.len(), found.complete), (126, true));
        for left_out in [0, 125] {
            let mut rest = all.clone();
            rest.remove(left_out);
            let how = (
                &smaller(&settings, &watch) as &Smaller<'_>,
                &mut generator(7, 0),
            );
            let mut test = RodTrace::new(&family, &found.member(), how, 64).unwrap();
            let now = Progress::of(Stage::Paths);
            assert_eq!(test.holds(&rest, (&watch, now)), Some(false));
        }
    }
}
