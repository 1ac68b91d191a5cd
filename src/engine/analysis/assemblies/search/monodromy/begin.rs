//! Searches of members from nothing, and of those that trace tests ask for.

use std::cell::Cell;

use super::{DOUBTFUL, MemberSearch, generator};
use crate::analysis::assemblies::AssembliesSettings;
use crate::analysis::assemblies::family::{Family, Member};
use crate::analysis::assemblies::report::GenericSearch;
use crate::analysis::assemblies::search::rod_trace::Traces;
use crate::analysis::assemblies::search::six_rods;
use crate::analysis::assemblies::search::solutions::GenericSolutions;
use crate::solve::Watch;

/// Members at which it is tried to reach the solutions of a platform on six rods.
const BASES: u64 = 5;

/// Searches a generic member. `None` if a dimension has no value.
pub(crate) fn search_one(
    family: &Family,
    question: &str,
    bound: Option<usize>,
    settings: &AssembliesSettings,
    watch: &Watch,
) -> Option<GenericSolutions> {
    const SMALLER: usize = 24;
    let budget = Cell::new(SMALLER);
    search_at(family, question, bound, (settings, watch, &budget), None)
}

/// Searches a given member, or a generic one.
fn search_at(
    family: &Family,
    question: &str,
    bound: Option<usize>,
    (settings, watch, budget): (&AssembliesSettings, &Watch, &Cell<usize>),
    base: Option<Member>,
) -> Option<GenericSolutions> {
    let generic = |stream| family.generic_member(&mut generator(settings.seed, stream << 44));
    let given = base.is_some();
    let mut bases: Vec<Member> = match base {
        Some(base) => vec![base],
        None => (0..BASES).map(generic).collect(),
    };
    let begun = |base| {
        let mut search = MemberSearch {
            watch,
            bound,
            family,
            settings,
            given,
            nodes: Vec::new(),
            edges: Vec::new(),
            found: GenericSolutions {
                question: question.to_owned(),
                search: GenericSearch {
                    seed: settings.seed,
                    ..GenericSearch::default()
                },
                ..GenericSolutions::default()
            },
            traces: Traces::new(given),
            budget,
            doubtful: DOUBTFUL,
        };
        search.add(base, 1.0)?;
        Some(search)
    };
    if let Some((place, (legwise, infinite))) = six_rods::solved(family, &bases, watch) {
        let mut search = begun(bases.swap_remove(place))?;
        search.nodes[0].legwise = legwise;
        search.found.search.general = Some(infinite);
        return Some(search.result());
    }
    let mut search = begun(bases.swap_remove(0))?;
    search.found.search.exhausted = search.run();
    // some are missing, or points of the cut are: another member tells
    if search.traces.fail_for(search.count())
        && !given
        && !watch.is_stopped()
        && let Some(mut other) = begun(generic(BASES))
    {
        other.found.search.exhausted = other.run();
        if other.found.search.traced || other.count() > search.count() {
            search = other;
        }
    }
    Some(search.result())
}

/// The search for the smaller problem of a trace test.
pub(super) fn smaller<'a>(
    settings: &AssembliesSettings,
    watch: &'a Watch<'a>,
    budget: &'a Cell<usize>,
) -> impl Fn(&Family, Option<usize>, Member) -> Option<GenericSolutions> + 'a {
    const FEW: usize = 32;
    let few = AssembliesSettings {
        quiet_seeds: FEW,
        quiet_loops: 2,
        most_loops: FEW,
        ..settings.clone()
    };
    move |family, bound, member| {
        budget.set(budget.get().checked_sub(1)?);
        search_at(family, "", bound, (&few, watch, budget), Some(member))
    }
}
