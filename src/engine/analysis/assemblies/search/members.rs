//! The search of a family, with rods for parts that are no more than that.

use super::super::AssembliesSettings;
use super::monodromy::search_one;
use super::solutions::GenericSolutions;
use crate::analysis::assemblies::family::{Family, learn, points};
use crate::analysis::assemblies::track::Lift;
use crate::solve::Watch;

/// All solutions of a generic member. `None` if a dimension has no value anywhere near.
pub(crate) fn search(
    family: &Family,
    question: String,
    bound: Option<usize>,
    settings: &AssembliesSettings,
    watch: &Watch,
) -> Option<GenericSolutions> {
    let parts = family.reduced.as_ref().and_then(|reduced| {
        let bound = bound.map(|bound| bound / family.ways());
        let found = search(reduced, question.clone(), bound, settings, watch)?;
        completed(family, found)
    });
    parts.or_else(|| search_one(family, &question, bound, settings, watch))
}

/// Solutions found with rods, with what the rods stand for. `None` if that is not all that there is to find.
fn completed(family: &Family, mut found: GenericSolutions) -> Option<GenericSolutions> {
    let finite = found.freedom == 0 && found.search.multiple == 0 && !found.endless;
    let reduced = family
        .reduced
        .as_ref()
        .filter(|_| finite && found.count() > 0)?;
    let lift = Lift::new(family, &found.member())?;
    let points = points(&found.legwise, &reduced.coordinates);
    let parts = crate::solve::each(points.len(), &lift, |lift, k| lift.of(&points[k]));
    found.legwise.clear();
    for part in parts {
        for x in part?.spanning_points(&family.coordinates) {
            learn(&mut found.legwise, &family.coordinates, &x);
        }
    }
    Some(found)
}
