//! Boundary curves through the points found on edges, cut where the mode changes.

use super::kinds::{BoundaryCurve, Crossing, Kind, Piece, named};
use crate::analysis::workspace::problem::MapProblem;
use crate::mechanism::Configuration;
use crate::solve::Place;
use crate::system::{ConfigurationCurve, Locked, LocusEnd, Region, Traced, met_at};

/// A curve with the places along it where modes meet it.
type Known<P> = (Traced<P>, Vec<(f64, usize)>);

/// Curves of one kind.
pub(crate) struct Tracer<'a> {
    /// For each solution the number of its mode, from 0; none if it is not listed.
    pub mode: &'a [Option<usize>],
    pub problem: &'a MapProblem<'a>,
    pub kind: Kind,
    pub third: Option<f64>,
}

impl Tracer<'_> {
    pub fn all<C: ConfigurationCurve>(
        &self,
        curve: &mut C,
        region: &Region,
        crossings: &[&Crossing],
        place: impl Fn(&mut C, &Configuration<f64>) -> Option<Place<C::Point>>,
    ) -> Vec<BoundaryCurve> {
        let mut known: Vec<Known<C::Point>> = Vec::new();
        for crossing in crossings {
            let mut at = crossing.at.clone();
            self.problem.mechanism.turn_to_limits(&mut at.joints);
            // a point that lies on no regular curve is reported as a single point
            let Some(place) = place(curve, &at) else {
                continue;
            };
            if !region.inside(C::configuration(&place.at)) {
                continue;
            }
            let Some(mode) = self.mode[crossing.solution] else {
                continue;
            };
            let mut met = known.iter_mut();
            let found = met.find_map(|(traced, met)| {
                Some((met_at(curve, traced, &place, region.method)?, met))
            });
            match found {
                Some((along, met)) => met.push((along, mode)),
                None => {
                    let traced = region.traced(curve, place.clone());
                    let along = met_at(curve, &traced, &place, region.method).unwrap_or(0.0);
                    if traced.places.len() > 1 {
                        known.push((traced, vec![(along, mode)]));
                    }
                }
            }
        }
        let told = known.into_iter().map(|(traced, met)| {
            let at = |p: &Place<C::Point>| C::configuration(&p.at).clone();
            let path: Vec<Configuration<f64>> = traced.places.iter().map(at).collect();
            self.curve(region, &path, traced.ends, met)
        });
        told.collect()
    }

    fn curve(
        &self,
        region: &Region,
        path: &[Configuration<f64>],
        ends: [LocusEnd; 2],
        mut met: Vec<(f64, usize)>,
    ) -> BoundaryCurve {
        let problem = self.problem;
        let point = |at: &Configuration<f64>| -> [f64; 2] {
            [0, 1].map(|i| region.side(at, &problem.axes[i]))
        };
        let points: Vec<[f64; 2]> = path.iter().map(point).collect();
        met.sort_by(|a, b| a.0.total_cmp(&b.0));
        let closed = ends[1] == LocusEnd::Closed;
        let mut pieces: Vec<Piece> = Vec::new();
        for (range, points) in parts(&points, &self.cuts(path, &points), closed) {
            let here = met
                .iter()
                .filter(|(along, _)| range.iter().any(|r| r.contains(along)));
            let mut modes: Vec<usize> = here.map(|m| m.1).collect();
            modes.sort_unstable();
            modes.dedup();
            pieces.extend(modes.into_iter().map(|mode| Piece {
                mode: mode + 1,
                points: points.clone(),
            }));
        }
        BoundaryCurve {
            kind: named(self.problem, self.kind),
            ends_reach: self.kind.ends_reach(),
            slice: self.third,
            ends,
            pieces,
            joints: path.iter().map(|at| at.joints.clone()).collect(),
            points,
        }
    }

    /// Where along a curve the mode changes: at places where solutions of the mapped problem
    /// meet. On a fold such a place is where the mapped coordinates turn back.
    fn cuts(&self, path: &[Configuration<f64>], points: &[[f64; 2]]) -> Vec<usize> {
        if self.kind == Kind::Fold {
            let way = |i: usize| [0, 1].map(|k| points[i + 1][k] - points[i][k]);
            let turns = (1..points.len().saturating_sub(1)).filter(|&i| {
                let (a, b) = (way(i - 1), way(i));
                a[0] * b[0] + a[1] * b[1] < 0.0
            });
            return turns.collect();
        }
        let mut locked = Locked::new(
            self.problem.mechanism,
            &MapProblem::locks(&self.problem.held),
        );
        let changes = (1..path.len()).filter(|&i| {
            let near = locked.decomposition(&path[i - 1]);
            locked.orientation(&near, &path[i]) < 0.0
        });
        changes.collect()
    }
}

/// A part of a curve: where it is along the curve, and its points.
type Part = (Vec<std::ops::RangeInclusive<f64>>, Vec<[f64; 2]>);

/// The parts of a curve between cuts, which are at points or just before them.
fn parts(points: &[[f64; 2]], cuts: &[usize], closed: bool) -> Vec<Part> {
    let last = points.len() - 1;
    let mut bounds = vec![0];
    bounds.extend(cuts.iter().copied().filter(|cut| *cut > 0 && *cut < last));
    bounds.push(last);
    let mut parts: Vec<Part> = (bounds.windows(2))
        .map(|pair| {
            let range = pair[0] as f64..=pair[1] as f64;
            (vec![range], points[pair[0]..=pair[1]].to_vec())
        })
        .collect();
    if closed && parts.len() > 1 {
        // the last goes on in the first
        let (ranges, tail) = parts.remove(0);
        if let Some((range, points)) = parts.last_mut() {
            range.extend(ranges);
            points.extend(tail.into_iter().skip(1));
        }
    }
    parts
}
