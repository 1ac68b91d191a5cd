//! All solutions of generic members of the family: Newton's method from random complex points, spread by monodromy.
//!
//! Members are the nodes of a graph, and along each edge every solution is tracked once, from the end at which it is
//! known (Duff et al. 2019). The equations have real coefficients, so that the solutions of a member with conjugate
//! numbers are the conjugates: edges lead to the conjugates of members too, also from a member to its own.
//!
//! A closed way permutes the solutions within each irreducible component (Sommese, Verschelde and Wampler 2001). If a
//! component is known in part, a random element of its monodromy group keeps the known solutions among themselves with
//! probability ½ at most (those that do are a proper subgroup); what is known at the end is kept by all closed ways on
//! which no path was lost. Other components are reached by seeds only, as the two operation modes of a 3-RPS.

mod begin;
mod graph;
mod seeds;

pub(super) use begin::search_one;

use std::cell::Cell;

use begin::smaller;
use graph::{GraphEdge, GraphNode};
use rand::SeedableRng;
use rand_pcg::Pcg64;

use super::super::AssembliesSettings;
use super::rod_trace::{Random, Smaller, Traces};
use super::solutions::GenericSolutions;
use crate::analysis::assemblies::family::{C, Family, Member};
use crate::analysis::assemblies::track::{START, stands_alone, tracked};
use crate::solve::{Progress, Stage, Watch};

fn generator(seed: u64, stream: u64) -> Pcg64 {
    Pcg64::seed_from_u64(
        seed.wrapping_mul(0x9E37_79B9_7F4A_7C15)
            .wrapping_add(stream),
    )
}

struct MemberSearch<'a> {
    watch: &'a Watch<'a>,
    bound: Option<usize>,
    family: &'a Family,
    settings: &'a AssembliesSettings,
    /// True if the solutions of the first node are asked for, false if those of any will do.
    given: bool,
    nodes: Vec<GraphNode<'a>>,
    edges: Vec<GraphEdge>,
    found: GenericSolutions,
    traces: Traces<'a>,
    /// Smaller problems that may still be searched for trace tests.
    budget: &'a Cell<usize>,
    /// Number of solutions from which on it is doubted that they are finite in number.
    doubtful: usize,
}

/// Seeds after which a search that found nothing gives up.
const HOPELESS: usize = 600;

/// Number of known solutions from which on it is asked whether they are finite in number: more than the platforms and
/// single loops that are studied have.
const DOUBTFUL: usize = 200;

/// Of so many nodes of a family that inputs make, one has other dimensions too: at special ones the inputs alone may not
/// exchange all solutions.
const RESIZED: usize = 3;

impl<'a> MemberSearch<'a> {
    /// Searches until nothing more is found; true if it ended at its limits, or was stopped, before.
    fn run(&mut self) -> bool {
        while self.nodes[0].shown.is_empty() {
            let seeds = [self.found.search.seeds, self.found.search.quiet_seeds];
            if seeds[0] >= HOPELESS || seeds[1] >= self.settings.quiet_seeds {
                return false;
            }
            if self.is_stopped_in_seeds() {
                return true;
            }
            self.newton_seeds(0);
        }
        loop {
            if self.is_endless() || self.is_complete() {
                return false;
            }
            if self.watch.at(self.in_loops()).is_break() {
                return true;
            }
            // loops through a family of one member say nothing
            let quiet = self.found.search.quiet_loops >= self.settings.quiet_loops.max(1);
            // where the trace test failed, seeds are to find what it misses
            let patience = 1 + 3 * usize::from(self.traces.fail_for(self.count()));
            let quiet_seeds = patience * self.settings.quiet_seeds;
            match quiet || !self.family.varies() {
                true if self.found.search.quiet_seeds >= quiet_seeds => {
                    if self.close_legs() {
                        self.spread();
                    } else if !self.traces.doubt_the_cut(self.count()) {
                        return false;
                    }
                }
                true if self.found.search.seeds >= self.settings.most_seeds => return true,
                true => {
                    self.newton_seeds(0);
                    self.spread();
                }
                false if self.found.search.loops >= self.settings.most_loops || !self.grow() => {
                    return true;
                }
                false => {}
            }
            (
                self.found.search.quiet_loops,
                self.found.search.lost_in_loops,
            ) = self.quiet();
        }
    }

    /// True if no more are possible.
    fn is_complete(&mut self) -> bool {
        let count = self.count();
        // where paths to the first node were lost a test would say nothing
        if self.bound != Some(count) && self.nodes[0].count() == count {
            let (settings, now) = (self.settings, (self.watch, self.in_loops()));
            let random = |number: u64| generator(settings.seed, (1 << 45) + number);
            let smaller = smaller(settings, self.watch, self.budget);
            let how = (&smaller as &Smaller<'_>, &random as &Random<'_>);
            let node = &self.nodes[0];
            let known = (&node.member, &node.legwise[..]);
            self.found.search.traced = self.traces.hold(self.family, known, how, now);
        }
        self.bound == Some(count) || self.found.search.traced
    }

    /// The node with most solutions among those that will do.
    fn best(&self) -> usize {
        let own = |k: &usize| *k == 0 || !self.given && self.is_own(*k);
        let places = (0..self.nodes.len()).rev().filter(own);
        places.max_by_key(|k| self.nodes[*k].count()).unwrap_or(0)
    }

    /// True if a node has the mechanism's own dimensions, or these make the family.
    fn is_own(&self, node: usize) -> bool {
        let same = self.nodes[node].member.parameters == self.nodes[0].member.parameters;
        self.family.by_dimensions || same
    }

    fn count(&self) -> usize {
        self.nodes[self.best()].count()
    }

    fn result(mut self) -> GenericSolutions {
        let best = self.best();
        self.found.search.refuted = self.traces.fail_for(self.count());
        let node = self.nodes.swap_remove(best);
        let mut found = self.found;
        if self.bound == Some(node.count()) {
            // no more are possible, so that what seemed to be others were these
            found.search.multiple = 0;
        }
        if !found.endless {
            found.legwise = node.legwise;
        }
        found.parameters = node.member.parameters;
        found.inputs = node.member.inputs;
        found
    }

    /// Adds a node, with edges to all nodes and their conjugates.
    fn add(&mut self, member: Member, reach: f64) -> Option<()> {
        let still = self.family.homotopy(&member, &member)?;
        let resized = member.parameters != self.family.parameters;
        self.found.search.related |= resized && !self.family.is_free;
        let new = self.nodes.len();
        self.nodes.push(GraphNode {
            member,
            reach,
            still,
            legwise: Vec::new(),
            shown: Vec::new(),
        });
        let plain = (0..new).map(|k| (k, false));
        for (k, mirrored) in plain.chain((0..=new).map(|k| (k, true))) {
            self.edges.push(GraphEdge {
                ends: [k, new],
                mirrored,
                matched: [Vec::new(), Vec::new()],
                tried: [0; 2],
            });
        }
        Some(())
    }

    /// Another node, to which all that is known is tracked; then what seeds find there is tracked everywhere. False if the
    /// dimensions have no value there.
    fn grow(&mut self) -> bool {
        let new = self.nodes.len();
        let mut rng = generator(self.settings.seed, (new as u64) << 1);
        // solutions far out meet at inputs far out
        let reach = [1.0, 2.0, 8.0, 4.0, 16.0][new % 5];
        let resize = self.family.by_dimensions || new.is_multiple_of(RESIZED);
        let member = Member {
            inputs: self.family.random_inputs(&mut rng, reach),
            parameters: match resize {
                true => self.family.random_parameters(&mut rng, reach),
                false => self.nodes[0].member.parameters.clone(),
            },
        };
        if self.add(member, reach).is_none() {
            return false;
        }
        self.spread();
        if self.bound != Some(self.count()) && !self.is_stopped_in_seeds() {
            self.newton_seeds(new);
            self.spread();
        }
        self.found.search.loops = self.edges.len() + 1 - self.nodes.len();
        true
    }

    /// Tracks along all edges what was not.
    fn spread(&mut self) {
        loop {
            let mut quiet = true;
            for edge in 0..self.edges.len() {
                for side in 0..self.edges[edge].sides() {
                    if self.bound == Some(self.count()) || self.watch.is_stopped() {
                        return;
                    }
                    quiet &= !self.follow(edge, side);
                }
            }
            if quiet {
                return;
            }
        }
    }

    /// Tracks what is shown at one end of an edge, and no path has come from, to the other end; true if there was any.
    fn follow(&mut self, edge: usize, side: usize) -> bool {
        let now = self.in_loops();
        let edge = &mut self.edges[edge];
        let other = if edge.sides() == 1 { 0 } else { 1 - side };
        let [from, to] = [edge.ends[side], edge.ends[1 - side]];
        let node = &self.nodes[from];
        edge.matched[side].resize(node.shown.len(), false);
        let waiting = (edge.tried[side]..node.shown.len()).filter(|k| !edge.matched[side][*k]);
        let waiting: Vec<usize> = waiting.collect();
        edge.tried[side] = node.shown.len();
        let starts: Vec<Vec<C>> = waiting.iter().map(|k| node.shown[*k].clone()).collect();
        let conjugate = |of: &[C]| -> Vec<C> { of.iter().map(|z| z.conj()).collect() };
        let mut end = self.nodes[to].member.clone();
        if edge.mirrored {
            end.parameters = conjugate(&end.parameters);
            end.inputs = conjugate(&end.inputs);
        }
        let Some(way) = self.family.homotopy(&node.member, &end) else {
            return false;
        };
        let ends = tracked(&way, &starts, (self.watch, now));
        let resized = node.member.parameters != self.nodes[to].member.parameters;
        let node = &mut self.nodes[to];
        for (start, x) in waiting.iter().zip(ends) {
            let Some(mut x) = x else { continue };
            if edge.mirrored {
                x = conjugate(&x);
            }
            if !stands_alone(&mut node.still, START, &x) {
                // other dimensions may have solutions that meet, or go away, at the mechanism's own
                if resized && !self.family.by_dimensions {
                    edge.mark(side, *start);
                }
                continue;
            }
            let (place, new) = node.learn(x);
            if new {
                self.found.search.quiet_seeds = 0;
            }
            edge.mark(side, *start);
            if let Some(place) = place {
                edge.mark(other, place);
            }
        }
        !waiting.is_empty()
    }

    /// Number of independent closed ways on which no path was lost, or few of hundreds, and how many at most.
    fn quiet(&self) -> (usize, usize) {
        let mut within = vec![false; self.nodes.len()];
        within[self.best()] = true;
        let whole = || self.edges.iter().filter(|edge| edge.lost().is_some());
        for _ in 0..self.nodes.len() {
            for edge in whole() {
                if edge.ends.iter().any(|k| within[*k]) {
                    edge.ends.iter().for_each(|k| within[*k] = true);
                }
            }
        }
        let edges = whole().filter(|edge| within[edge.ends[0]]);
        let lost = edges.clone().filter_map(GraphEdge::lost).max().unwrap_or(0);
        let nodes = within.iter().filter(|within| **within).count();
        (edges.count() + 1 - nodes, lost)
    }

    fn is_stopped_in_seeds(&self) -> bool {
        let found = self.count();
        (self.watch).stops(Stage::Seeds { found }, self.found.search.seeds, None)
    }

    fn in_loops(&self) -> Progress {
        Progress {
            stage: Stage::Loops {
                found: self.count(),
            },
            done: self.found.search.loops,
            of: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::rod_trace::{Cut, RodTrace};
    use super::*;
    use crate::analysis::assemblies::family::points;
    use crate::description::Description;
    use crate::mechanism::Mechanism;
    use crate::system::Question;

    /// The truss of 13 links has 126 solutions (`tests/data/truss_13.ron`), of which none can be left out.
    #[test]
    fn a_truss_is_complete_and_no_solution_can_be_left_out() {
        let text = include_str!("../../../../../tests/data/truss_13.ron");
        let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
        let family = Family::new(&mechanism, &Question::new(&mechanism).held());
        let (settings, watch) = (AssembliesSettings::default(), Watch::none());
        let found = search_one(&family, "", None, &settings, &watch).unwrap();
        let all = points(&found.legwise, &family.coordinates);
        assert_eq!((all.len(), found.search.traced), (126, true));
        for left_out in [0, 125] {
            let mut rest = all.clone();
            rest.remove(left_out);
            let budget = Cell::new(9);
            let smaller = smaller(&settings, &watch, &budget);
            let how = (&smaller as &Smaller<'_>, &mut generator(7, 0));
            let cut = Cut::all(&family, false).pop().unwrap();
            let mut test = RodTrace::new(&family, &found.member(), cut, how).unwrap();
            let now = Progress::of(Stage::Paths);
            assert_eq!(test.holds(&rest, (&watch, now)), Some(false));
        }
    }
}
