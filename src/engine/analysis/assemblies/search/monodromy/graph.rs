//! Members of a family as nodes, and ways between them as edges.

use super::DOUBTFUL;
use crate::analysis::assemblies::family::{C, LegwiseSolutions, Member, count, learn};
use crate::analysis::assemblies::track::ParameterHomotopy;

/// A member with what is known of its solutions.
pub(super) struct GraphNode<'a> {
    pub member: Member,
    /// Distance of its inputs from the origin.
    pub reach: f64,
    pub still: ParameterHomotopy<'a>,
    pub legwise: Vec<LegwiseSolutions>,
    /// Solutions that brought something new, which show all that is known.
    pub shown: Vec<Vec<C>>,
}

impl GraphNode<'_> {
    /// Adds a solution; its place among those shown, if it is one, and true if it brought something new.
    pub fn learn(&mut self, x: Vec<C>) -> (Option<usize>, bool) {
        let coordinates = &self.still.family.coordinates;
        if learn(&mut self.legwise, coordinates, &x) {
            self.shown.push(x);
            return (Some(self.shown.len() - 1), true);
        }
        let mut shown = self.shown.iter();
        (shown.position(|y| coordinates.same(&x, y)), false)
    }

    pub fn count(&self) -> usize {
        count(&self.legwise)
    }
}

/// A way between two nodes, or from one to the conjugate of another or of itself.
pub(super) struct GraphEdge {
    pub ends: [usize; 2],
    pub mirrored: bool,
    /// For what is shown at each end, true if it belongs to a path that arrived.
    pub matched: [Vec<bool>; 2],
    /// Numbers of those at each end that were tracked if they did not.
    pub tried: [usize; 2],
}

impl GraphEdge {
    pub fn sides(&self) -> usize {
        if self.ends[0] == self.ends[1] { 1 } else { 2 }
    }

    /// Number of paths lost, if that is none, or few of hundreds: some of so many pass where double precision fails.
    pub fn lost(&self) -> Option<usize> {
        const LOST_ONE_IN: usize = 4;
        let lost = |matched: &Vec<bool>| matched.iter().filter(|done| !**done).count();
        let lost = self.matched.iter().map(lost).max().unwrap_or(0);
        let all = self.matched[0].len();
        (lost == 0 || all >= DOUBTFUL && lost <= all / LOST_ONE_IN).then_some(lost)
    }

    pub fn mark(&mut self, side: usize, place: usize) {
        let matched = &mut self.matched[side];
        matched.resize(matched.len().max(place + 1), false);
        matched[place] = true;
    }
}
