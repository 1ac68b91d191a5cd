//! The closest approach of a mechanism that cannot be assembled.

use super::TargetProblem;
use super::real::{named_joints, named_poses, tidied};
use crate::analysis::assemblies::family::C;
use crate::analysis::assemblies::report::{ByName, ClosestApproach};
use crate::mechanism::Configuration;
use crate::solve::{Newton, Stop};
use crate::system::{Gap, SystemWork, approach, solve};

impl TargetProblem<'_> {
    /// The smallest gaps that Newton's method leaves from the target configuration and from the
    /// real parts of complex solutions; true if nothing is left.
    pub(crate) fn nearest(
        &self,
        starts: &[&Vec<C>],
        work: &mut SystemWork<f64>,
    ) -> Option<(Configuration<f64>, bool)> {
        let newton = Newton::default();
        let mut best: Option<(f64, bool, Configuration<f64>)> = None;
        let lifted = starts
            .iter()
            .map(|x| self.coordinates.real_part(x, self.asked));
        for mut point in std::iter::once(self.asked.clone()).chain(lifted) {
            let report = solve(&newton, &self.system, &mut point, work);
            // ties are settled by the order of starts; a clearly smaller gap wins
            if report.size.squares.is_finite()
                && best
                    .as_ref()
                    .is_none_or(|(least, ..)| report.size.squares < least * (1.0 - 1e-6))
            {
                best = Some((report.size.squares, report.stop == Stop::Solved, point));
            }
        }
        best.map(|(_, solved, point)| (point, solved))
    }

    /// The closest approach to assembly near a configuration.
    pub(crate) fn closest(&self, near: &Configuration<f64>) -> Option<ClosestApproach> {
        let (point, local_minimum) = approach(&self.system, near);
        let point = tidied(point, self.coordinates, true);
        let gaps = Gap::of(self.mechanism, &point);
        let width = |gap: &Gap| gap.size(self.mechanism);
        let names = self.mechanism.closures().iter().map(|c| c.name.clone());
        let gaps: Vec<(String, Gap)> = names.zip(gaps).collect();
        let worst = gaps
            .iter()
            .max_by(|a, b| width(&a.1).total_cmp(&width(&b.1)))?;
        let worst = worst.0.clone();
        Some(ClosestApproach {
            gaps: ByName(gaps),
            worst,
            local_minimum,
            squared_lengths: self.mechanism.has_rods(),
            joints: named_joints(self.mechanism, &point),
            platforms: named_poses(self.mechanism, &point, true),
        })
    }
}
