//! Design questions.

mod drawn;
mod figure;
mod judge;
mod read;
mod targets;
mod weights;

use std::sync::Arc;

use crate::analysis::design::{self, DesignReport, FoundEnd, PinnedFourBar, SearchedEnds, Task};
use crate::description::{
    Description, DesignDescription, DesignError, DesignGoal, DesignPart, DesignProblem, Entry,
    MissedTarget, Named,
};
use crate::mechanism::Mechanism;
use crate::number::sorting::sort_by;
use crate::solve::{LeastSquares, Watch};
use crate::system::{Bound, Bundled};
pub use drawn::DrawnDesign;
use judge::Judge;
use read::Read;

/// Designs that meet the targets of which the best are improved.
const COMPARED: usize = 32;

/// Designs that are improved at most.
const IMPROVED: usize = 6;

/// A design question: a mechanism, what it shall do, and which of its numbers may vary.
#[derive(Clone, Debug)]
pub struct Design {
    /// The mechanism.
    pub mechanism: Description,
    /// Its targets and requirements.
    pub asked: DesignDescription,
    /// Seed of the search.
    pub seed: u64,
    /// Starts at most.
    pub starts: usize,
    /// True if the first start is at the dimensions of the mechanism, so that a design is followed as its targets move; otherwise all
    /// are random.
    pub own: bool,
    /// True for a search from random starts where all solutions could be found too.
    pub approximate: bool,
    /// Generic solutions of an exact synthesis at most; where there are more it is searched from random starts.
    pub solutions: usize,
    /// Designs listed at most.
    pub most: usize,
}

impl Default for Design {
    fn default() -> Self {
        Design {
            mechanism: Description::default(),
            asked: DesignDescription::default(),
            seed: 1,
            starts: 400,
            own: false,
            approximate: false,
            solutions: 100,
            most: 10,
        }
    }
}

impl Design {
    /// Searches for designs, and judges each along its whole motion.
    ///
    /// # Errors
    /// If the question is wrong, or no mechanism in the ranges can be assembled.
    pub fn report(&self, watch: &Watch) -> Result<DesignReport, DesignError> {
        let (asked, boxed) = (self.asked.clone().with_box(), self.asked.positions.len());
        let with_box = Design {
            asked,
            ..self.clone()
        };
        with_box.answer(boxed, watch)
    }

    /// The answer where the positions from one on, those of a box, are equations.
    fn answer(&self, boxed: usize, watch: &Watch) -> Result<DesignReport, DesignError> {
        let made = |known: Option<&Mechanism>| {
            let description = self.tied(self.extended(known))?;
            let mechanism = Mechanism::new(&description).map_err(DesignError::Mechanism)?;
            let mechanism = Arc::new(mechanism);
            let read = Read::new(&self.asked, boxed, &mechanism)?;
            Ok((description, mechanism, read))
        };
        // units that do not fit are left out
        let plain: Result<_, DesignError> = made(None);
        let known = plain
            .as_ref()
            .ok()
            .and_then(|(_, plain, _)| made(Some(plain)).ok());
        let (description, mechanism, read) = known.map_or(plain, Ok)?;
        let mut judge = Judge::new(&self.asked, &read, (&description, &mechanism), watch)?;
        let again = match (&self.asked.goals[..], judge.improves()) {
            ([_, ..], _) => COMPARED,
            ([], true) => IMPROVED,
            ([], false) => 3,
        };
        let task = self.task(&mechanism, &read, again);
        let lists = read
            .varied
            .iter()
            .filter(|of| !of.listed.is_empty())
            .count();
        let exact = match self.approximate || lists > 0 {
            true => Ok(None),
            false => task.exact(self.solutions, watch),
        };
        let (exact, not_all) = match exact {
            Ok(exact) => (exact, None),
            Err(why) => (None, Some(why)),
        };
        let (exact, mut searched) = match exact {
            Some((exact, searched)) => (Some(exact), searched),
            None => {
                let good = |found: &FoundEnd| {
                    let targets = read.missed(&task.bundle, found).unwrap_or_default();
                    !targets.iter().any(design::Deviation::is_missed)
                        && judge.estimates(found).is_some()
                };
                (None, task.search(&good, watch))
            }
        };
        let improve = |task: &Task, searched: &mut SearchedEnds| {
            let front = |of: &FoundEnd| judge.estimates(of)?.try_into().ok();
            let estimate = |of: &FoundEnd| judge.estimates(of)?.first().copied();
            let cost = |of: &FoundEnd| judge.costs(of)?.first().copied();
            match exact.is_none() && judge.improves() {
                true if self.asked.goals.len() > 1 => {
                    task.front(searched, (self.most, IMPROVED / 2), &front, watch)
                }
                true => task.improve(searched, IMPROVED, (&estimate, &cost), watch),
                false => 0,
            }
        };
        let mut improved = improve(&task, &mut searched);
        let listed = (lists > 0).then(|| {
            let task = Task {
                listed: read.varied.iter().map(|of| of.listed.clone()).collect(),
                ..task.clone()
            };
            let listed = task.take_listed(&mut searched, watch);
            improved = improve(&task, &mut searched);
            listed
        });
        searched.interrupted |= watch.is_stopped();
        if exact.is_none() && searched.found.is_empty() && !searched.interrupted {
            return Err(self.nothing_assembles(&mechanism, read, searched.not_assembled, watch));
        }
        let none = exact.as_ref().filter(|of| of.real == of.outside);
        let nearest = none.and_then(|_| task.nearest(watch));
        // all of a complete list
        let most = if exact.is_some() {
            usize::MAX
        } else {
            self.most
        };
        /// Designs that are judged after an interruption.
        const FEW: usize = 3;
        let found = searched.found.iter().take(most.saturating_mul(4));
        let none = Watch::none();
        if searched.interrupted {
            judge.watch = &none;
        }
        // of a linkage with links exchanged the one that drives without defects
        let mut classes: Vec<(&FoundEnd, design::FoundDesign)> = Vec::new();
        for found in found {
            if searched.interrupted && classes.len() >= FEW {
                break;
            }
            let mut judged = self.design(&task, &judge, found);
            // what was being judged when it was stopped is judged again
            if watch.is_stopped() && !searched.interrupted {
                searched.interrupted = true;
                judge.watch = &none;
                judged = self.design(&task, &judge, found);
            }
            let Some(design) = judged else { continue };
            match classes.iter_mut().find(|(of, _)| of.class == found.class) {
                Some(known) if design.defects.len() < known.1.defects.len() => {
                    *known = (found, design);
                }
                Some(_) => {}
                None => classes.push((found, design)),
            }
        }
        let mut distinct: Vec<usize> = searched.found.iter().map(|of| of.class).collect();
        distinct.sort_unstable();
        distinct.dedup();
        let rank = |of: &design::FoundDesign, i: usize| {
            let goal = self.asked.goals.get(i).map(DesignGoal::sign);
            let value = [of.goal, of.second_goal][i];
            goal.zip(value).map_or(f64::INFINITY, |(sign, x)| sign * x)
        };
        sort_by(&mut classes, |(_, a), (_, b)| {
            let defects = |of: &design::FoundDesign| !of.defects.is_empty();
            let goals = [0, 1].map(|i| rank(a, i).total_cmp(&rank(b, i)));
            defects(a).cmp(&defects(b)).then(goals[0]).then(goals[1])
        });
        if let (2, None) = (self.asked.goals.len(), &exact) {
            let mut least = f64::INFINITY;
            classes.retain(|(_, of)| {
                let beaten = rank(of, 1) >= least;
                least = least.min(rank(of, 1));
                !beaten
            });
        }
        classes.truncate(most);
        let points: Vec<&Bundled> = classes.iter().map(|(of, _)| &of.at).collect();
        let cognates = task.cognates(&points);
        let mut designs: Vec<design::FoundDesign> = classes.into_iter().map(|(_, of)| of).collect();
        for (design, cognates) in designs.iter_mut().zip(cognates) {
            design.cognates = cognates;
        }
        let best = searched.found.first();
        let best = best.and_then(|found| task.bundle.model(&found.at));
        let still = (0..read.varied.len()).filter(|i| !read.varied[*i].listed.is_empty());
        let (undetermined, repeated) =
            best.map_or((0, 0), |of| (of.open(still).len(), of.repeated()));
        let surplus = task.bundle.surplus(task.positions).unwrap_or(0) - repeated as i64;
        let surplus = surplus + lists as i64;
        let parameters = mechanism.parameters();
        let units = judge.units_of_goals().zip(&self.asked.goals);
        let mut goals = units.map(|(unit, goal)| design::Goal {
            figure: goal.figure.value.clone(),
            unit,
            greatest: goal.greatest,
            improved,
        });
        Ok(DesignReport {
            mechanism: mechanism.name().to_owned(),
            varied: (read.varied.iter())
                .map(|of| Bound {
                    name: parameters[of.parameter].name.to_string(),
                    unit: of.unit,
                    from: of.range.0,
                    to: of.range.1,
                })
                .collect(),
            positions: task.positions,
            surplus: surplus.max(0) as usize,
            targets: read.targets.iter().filter(|of| !of.exact).count(),
            undetermined,
            driver: read.driver.map(|i| mechanism.joints()[i].name.clone()),
            straight_moves: !judge.one_freedom,
            more: distinct.len() - designs.len(),
            designs,
            goal: goals.next(),
            second_goal: goals.next(),
            listed,
            exact,
            nearest,
            not_all,
            starts: searched.starts,
            not_assembled: searched.not_assembled,
            seed: self.seed,
            interrupted: searched.interrupted,
        })
    }

    /// The search for what was read.
    fn task<'m>(&self, mechanism: &'m Mechanism, read: &Read, again: usize) -> Task<'m> {
        let bundle = read.bundle(mechanism, self.asked.positions.len());
        let free_driver = read.driver.filter(|_| !read.driven);
        let positions = self.asked.positions.len();
        let plain =
            |of: &Vec<Named<Vec<Entry>>>| matches!(&of[..], [point] if point.value.len() == 2);
        let path = self.asked.positions.iter().all(plain);
        Task {
            path: path
                .then(|| PinnedFourBar::of(mechanism, &read.targets, positions))
                .flatten(),
            mechanism,
            plain: free_driver.map(|driver| {
                let mut held = read.held.clone();
                held.joints[driver] = true;
                bundle.alone(held)
            }),
            bundle,
            ranges: read.ranges(),
            listed: vec![Vec::new(); read.varied.len()],
            angles: read.varied.iter().map(|of| of.angle).collect(),
            size: read.size,
            positions: self.asked.positions.len(),
            free_driver,
            seed: self.seed,
            // without unknowns one start finds every position
            starts: if read.varied.is_empty() {
                1
            } else {
                self.starts.max(1)
            },
            own: self.own,
            again,
        }
    }

    /// The error where nothing can be assembled in all positions, at what is missed most where all that is given is met as nearly
    /// as possible.
    fn nothing_assembles(
        &self,
        mechanism: &Mechanism,
        mut read: Read,
        tried: usize,
        watch: &Watch,
    ) -> DesignError {
        read.targets.iter_mut().for_each(|of| of.exact = false);
        read.driven = false;
        let nearest = self.task(mechanism, &read, 3).nearest(watch);
        let nearest = nearest.map(|of| MissedTarget {
            position: of.largest.position,
            quantity: of.largest.quantity,
            unit: of.largest.unit,
            by: of.largest.deviation,
        });
        let part = nearest.as_ref().and_then(|of| {
            let named = self.asked.positions[of.position - 1].iter();
            let place = named.map(|named| &named.name.value);
            let place = place
                .enumerate()
                .find(|(_, name)| of.quantity.starts_with(*name));
            Some(DesignPart::Position(of.position - 1, place?.0))
        });
        let problem = DesignProblem::NothingAssembles { tried, nearest };
        problem.at(part.unwrap_or(DesignPart::Whole))
    }

    fn design(&self, task: &Task, judge: &Judge, found: &FoundEnd) -> Option<design::FoundDesign> {
        let mut verdict = judge.verdict(found);
        let deviations = judge.read.missed(&task.bundle, found)?;
        let beyond = deviations.iter().filter(|of| of.is_missed()).cloned();
        let targets: Vec<design::Deviation> = beyond.collect();
        if !targets.is_empty() {
            verdict.defects.push(design::Defect::Tolerance { targets });
        }
        let model = task.bundle.model(&found.at)?;
        Some(design::FoundDesign {
            values: found.at.numbers.clone(),
            sum_of_squares: found.squares,
            deviations,
            sensitivities: model.sensitivities(),
            defects: verdict.defects,
            driver: verdict.moves,
            goal: verdict.goals.first().copied().flatten(),
            second_goal: verdict.goals.get(1).copied().flatten(),
            reached: found.reached,
            cognates: Vec::new(),
            file: judge.file(found),
        })
    }
}
