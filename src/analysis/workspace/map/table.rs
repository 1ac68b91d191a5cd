//! The nodes of a map as a table.

use super::cells::{Cells, INDICATORS, Part};
use super::{Map, bring};
use crate::algebra::SiUnit;
use crate::analysis::workspace::flood::Band;
use crate::mechanism::{PoseCoordinate, Variable};
use crate::number::sorting::sort_by_key;
use crate::solve::each;
use crate::system::Coordinate;

impl Map<'_> {
    /// The table, given for the first solution of each aspect its number.
    pub fn cells(&self, numbers: &[Option<usize>]) -> Cells {
        let following: Vec<(usize, PoseCoordinate)> = self.following().collect();
        let (direct, inverse) = (self.problem.tells_direct(), self.problem.tells_inverse());
        let known = |x: f64, known: bool| if known { x } else { f64::INFINITY };
        let axes = self.grid.dimensions();
        let widths = [axes, self.problem.mechanism.joints().len(), following.len()];
        let width = widths.iter().sum::<usize>() + INDICATORS;
        let bands = &self.reached_set.bands;
        let parts = each(bands.len(), &(), |(), i| {
            let first = bands[i].numbers.start;
            let rows = self.rows(&bands[i]);
            let mut places = vec![None; bands[i].numbers.len()];
            for (row, (s, mode)) in rows.iter().enumerate() {
                places[s - first] = Some((row, *mode));
            }
            let mut part = Part {
                nodes: vec![0; rows.len()],
                values: vec![0.0; rows.len() * width],
            };
            // in the order in which they are kept: reading from everywhere takes longer than writing
            for (s, solution, at) in self.reached_set.kept(&bands[i]) {
                let Some((row, mode)) = places[s - first] else {
                    continue;
                };
                let of = &solution.indicators;
                let values = &mut part.values[row * width..][..width];
                let (mapped, values) = values.split_at_mut(axes);
                let (indicators, values) = values.split_at_mut(INDICATORS);
                let (joints, values) = values.split_at_mut(widths[1]);
                part.nodes[row] = solution.node;
                let aspect = self.aspect[s].and_then(|first| numbers[first]);
                indicators.copy_from_slice(&[
                    (mode + 1) as f64,
                    aspect.map_or(f64::INFINITY, |aspect| aspect as f64),
                    known(of.condition, of.condition.is_finite()),
                    known(of.direct, direct),
                    known(of.inverse, inverse),
                ]);
                mapped.copy_from_slice(&self.grid.point(solution.node)[..axes]);
                joints.copy_from_slice(at.joints);
                bring(self.problem, joints, false);
                let mut values = values.iter_mut();
                for of_platform in following.chunk_by(|(a, _), (b, _)| a == b) {
                    let pose = at.platforms[of_platform[0].0].pose();
                    let all = PoseCoordinate::all_of(&pose);
                    for ((_, c), value) in of_platform.iter().zip(&mut values) {
                        *value = all[*c as usize];
                    }
                }
            }
            part
        });
        let mechanism = self.problem.mechanism;
        let variable = |of: &Coordinate| {
            let unit = SiUnit::of_coordinate(of.is_angle(mechanism));
            Variable::new(of.name(mechanism), unit)
        };
        let indicators = ["mode", "aspect", "condition", "direct", "inverse"];
        let mut columns: Vec<Variable> = (self.problem.axes.iter())
            .map(|axis| variable(&axis.coordinate))
            .collect();
        columns.extend(indicators.map(Variable::plain));
        columns.extend(Variable::joints(mechanism));
        columns.extend((following.iter()).map(|&(p, c)| variable(&Coordinate::Pose(p, c))));
        Cells {
            columns,
            widths,
            parts,
        }
    }

    /// The solutions of a band that are in modes, in the order of their nodes and then of modes.
    fn rows(&self, band: &Band) -> Vec<(usize, usize)> {
        let all = band.numbers.clone();
        let mut rows: Vec<(usize, usize)> = all.filter_map(|s| Some((s, self.mode[s]?))).collect();
        let node = |s: usize| self.reached_set.nodes[s];
        for of_node in rows.chunk_by_mut(|(a, _), (b, _)| node(*a) == node(*b)) {
            sort_by_key(of_node, |(s, mode)| (*mode, *s));
        }
        rows
    }
}
