//! Boundary curves through the points found on edges, cut where the mode changes.

use super::kinds::{BoundaryCurve, EdgeCrossing, KindByNumber, Piece, named};
use crate::analysis::workspace::problem::MapProblem;
use crate::linear::dot;
use crate::mechanism::Configuration;
use crate::number::sorting::sort_by;
use crate::solve::CurvePoint;
use crate::system::{ConfigurationCurve, Curve, Held, Locked, LocusEnd, Region, Traced, met_at};

/// A curve with the places along it where modes meet it.
struct KnownCurve<P> {
    traced: Traced<P>,
    /// The mapped coordinates of its places.
    points: Vec<[f64; 2]>,
    /// The steps from each place to the next.
    chords: Vec<Vec<f64>>,
    met: Vec<(f64, usize)>,
}

/// Curves of one kind.
pub(crate) struct BoundaryTracer<'a> {
    /// For each solution the number of its mode, from 0; none if it is not listed.
    pub mode: &'a [Option<usize>],
    pub problem: &'a MapProblem<'a>,
    pub kind: KindByNumber,
    pub third: Option<f64>,
}

impl BoundaryTracer<'_> {
    pub fn all<C: ConfigurationCurve>(
        &self,
        curve: &mut C,
        region: &Region,
        crossings: &[&EdgeCrossing],
        place: impl Fn(&mut C, &Configuration<f64>) -> Option<CurvePoint<C::Point>>,
    ) -> Vec<BoundaryCurve> {
        let mut known: Vec<KnownCurve<C::Point>> = Vec::new();
        let scale = [0, 1].map(|i| {
            let coordinate = self.problem.axes[i].coordinate;
            coordinate.scale(self.problem.mechanism)
        });
        let all = Curve::new(
            self.problem.mechanism,
            &Held::nothing(self.problem.mechanism),
        );
        for crossing in crossings {
            let mut at = crossing.at.clone();
            self.problem.mechanism.turn_to_limits(&mut at.joints);
            let Some(mode) = self.mode[crossing.solution] else {
                continue;
            };
            let point = self.point(region, &at);
            let near = |known: &KnownCurve<C::Point>| {
                let to = |i: usize| {
                    all.difference_but_turns(C::configuration(&known.traced.places[i].at), &at)
                };
                place_along(known, |k, i| (known.points[i][k] - point[k]) / scale[k], to)
            };
            let mut beside = known
                .iter()
                .enumerate()
                .filter_map(|(k, known)| Some((k, near(known)?)));
            // where curves are near one another a point is followed to the one that it is on
            if let (Some((k, Some(along))), None) = (beside.next(), beside.next()) {
                known[k].met.push((along, mode));
                continue;
            }
            // a point that lies on no regular curve is reported as a single point
            let Some(place) = place(curve, &at) else {
                continue;
            };
            if !region.inside(C::configuration(&place.at)) {
                continue;
            }
            let mut met = known.iter_mut();
            let found = met.find_map(|known| {
                let along = met_at(curve, &known.traced, &place, region.method)?;
                Some((along, &mut known.met))
            });
            match found {
                Some((along, met)) => met.push((along, mode)),
                None => {
                    let mut traced = region.traced(curve, place.clone());
                    let along = met_at(curve, &traced, &place, region.method).unwrap_or(0.0);
                    if traced.places.len() > 1 {
                        traced.places =
                            traced.places.into_iter().map(CurvePoint::thinned).collect();
                        let places = traced.places.iter();
                        let at: Vec<_> = places.map(|p| C::configuration(&p.at)).collect();
                        known.push(KnownCurve {
                            points: at.iter().map(|at| self.point(region, at)).collect(),
                            chords: (at.windows(2))
                                .map(|pair| all.difference_but_turns(pair[0], pair[1]))
                                .collect(),
                            traced,
                            met: vec![(along, mode)],
                        });
                    }
                }
            }
        }
        let curves = known.into_iter().map(|known| {
            let at = |p: &CurvePoint<C::Point>| C::configuration(&p.at).clone();
            let path: Vec<Configuration<f64>> = known.traced.places.iter().map(at).collect();
            self.curve(path, known.points, known.traced.ends, known.met)
        });
        curves.collect()
    }

    fn point(&self, region: &Region, at: &Configuration<f64>) -> [f64; 2] {
        [0, 1].map(|i| region.side(at, &self.problem.axes[i]))
    }

    fn curve(
        &self,
        path: Vec<Configuration<f64>>,
        points: Vec<[f64; 2]>,
        ends: [LocusEnd; 2],
        mut met: Vec<(f64, usize)>,
    ) -> BoundaryCurve {
        sort_by(&mut met, |a, b| a.0.total_cmp(&b.0));
        let closed = ends[1] == LocusEnd::Closed;
        let mut pieces: Vec<Piece> = Vec::new();
        for (range, points) in parts(&points, &self.cuts(&path, &points), closed) {
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

    /// Points of a curve at which the mode changes: solutions meet there, and on a fold the curve turns back.
    fn cuts(&self, path: &[Configuration<f64>], points: &[[f64; 2]]) -> Vec<usize> {
        if self.kind == KindByNumber::Fold {
            let way = |i: usize| [0, 1].map(|k| points[i + 1][k] - points[i][k]);
            let turns = (1..points.len().saturating_sub(1)).filter(|&i| {
                let (a, b) = (way(i - 1), way(i));
                a[0] * b[0] + a[1] * b[1] < 0.0
            });
            return turns.collect();
        }
        let held = self.problem.question.held();
        let locks = self.problem.locks(&self.problem.held);
        let mut locked = Locked::without_spins(self.problem.mechanism, &held, &locks);
        let changes = (1..path.len()).filter(|&i| {
            let near = locked.decomposition(&path[i - 1]);
            locked.orientation(&near, &path[i]) < 0.0
        });
        changes.collect()
    }
}

/// Position of a configuration along a curve, if it is near; `Some(None)` if uncertain. Given are the differences of
/// the mapped coordinates from those of a place, and the step from a place.
///
/// The tangent turns by less than a quarter of a radian from one place to the next, so that the curve
/// is off the chord by less than a thirtieth of its length.
fn place_along<P>(
    known: &KnownCurve<P>,
    mapped: impl Fn(usize, usize) -> f64,
    step: impl Fn(usize) -> Vec<f64>,
) -> Option<Option<f64>> {
    /// Pieces that are near one another because they follow one another.
    const NEXT: usize = 4;
    let pieces = known.chords.len();
    let mut beside: Vec<(usize, f64, f64)> = Vec::new();
    for (i, chord) in known.chords.iter().enumerate() {
        let square = dot(chord, chord);
        // not near: more than three chords away in a mapped coordinate
        if (0..2).any(|k| mapped(k, i).powi(2) > 9.0 * square) {
            continue;
        }
        let to = step(i);
        let part = (dot(chord, &to) / square).clamp(0.0, 1.0);
        let off = chord.iter().zip(&to).map(|(c, x)| (x - part * c).powi(2));
        let off = (off.sum::<f64>() / square).sqrt();
        // within a chord of it
        if off <= 1.0 {
            beside.push((i, part, off));
        }
    }
    let &(i, part, off) = beside.iter().min_by(|a, b| a.2.total_cmp(&b.2))?;
    let round = known.traced.ends[1] == LocusEnd::Closed;
    let next = |j: usize| {
        let between = i.abs_diff(j);
        between <= NEXT || (round && pieces - between <= NEXT)
    };
    let alone = beside.iter().all(|&(j, ..)| next(j));
    // on it: within a tenth of a chord
    Some((alone && off <= 0.1).then_some(i as f64 + part))
}

/// A part of a curve: where it is along the curve, and its points.
type CurvePart = (Vec<std::ops::RangeInclusive<f64>>, Vec<[f64; 2]>);

/// The parts of a curve between cuts, which are at points or just before them.
fn parts(points: &[[f64; 2]], cuts: &[usize], closed: bool) -> Vec<CurvePart> {
    let last = points.len() - 1;
    let mut bounds = vec![0];
    bounds.extend(cuts.iter().copied().filter(|cut| *cut > 0 && *cut < last));
    bounds.push(last);
    let mut parts: Vec<CurvePart> = (bounds.windows(2))
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
