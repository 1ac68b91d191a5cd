//! Loci as they appear in the box: curves that coincide there, and single points.

use serde::{Deserialize, Serialize};

use super::classify::Singularity;
use crate::linear::norm;
use crate::number::tolerance::SAME;
use crate::number::{real, sorting::sort_by};
use crate::solve::CurvePoint;
use crate::system::{ConfigurationCurve, LocusCurve, Region, Singular, Traced};

/// Image of a curve of configurations in the box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ImageShape {
    /// A curve.
    Curve,
    /// A single point: only coordinates outside the box move along it, or none does.
    Point,
}

/// A curve of configurations with its points in the box, in rad and characteristic lengths.
pub(super) struct Projection<'t> {
    traced: &'t Traced<Singular>,
    kind: Option<u8>,
    points: Vec<[f64; 2]>,
    length: f64,
    scales: [f64; 2],
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    real::hypot(a[0] - b[0], a[1] - b[1])
}

fn scaled(region: &Region, scales: [f64; 2], place: &CurvePoint<Singular>) -> [f64; 2] {
    [0, 1].map(|k| region.side(&place.at.at, &region.sides[k]) / scales[k])
}

impl<'t> Projection<'t> {
    pub fn new(
        region: &Region,
        traced: &'t Traced<Singular>,
        singularity: &Singularity,
    ) -> Projection<'t> {
        let mechanism = region.mechanism;
        let scales = [0, 1].map(|k| region.sides[k].coordinate.scale(mechanism));
        let points = traced.places.iter();
        let points: Vec<[f64; 2]> = points.map(|p| scaled(region, scales, p)).collect();
        Projection {
            length: points.windows(2).map(|pair| apart(pair[0], pair[1])).sum(),
            kind: singularity.gosselin_angeles,
            traced,
            points,
            scales,
        }
    }

    pub fn shape(&self) -> ImageShape {
        let first = self.points.first().copied().unwrap_or_default();
        match self.points.iter().all(|point| apart(first, *point) < SAME) {
            true => ImageShape::Point,
            false => ImageShape::Curve,
        }
    }

    /// True if all its configurations are one.
    fn stands_still(&self, curve: &LocusCurve) -> bool {
        let mut places = self.traced.places.iter();
        let Some(first) = places.next() else {
            return true;
        };
        places.all(|place| norm(&curve.apart(&first.at, &place.at)) < SAME)
    }

    /// Points of the box without those that come again.
    pub fn distinct(&self, points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
        let mut distinct: Vec<[f64; 2]> = Vec::new();
        let scaled = |point: [f64; 2]| [0, 1].map(|k| point[k] / self.scales[k]);
        for point in points {
            let known = |other: &[f64; 2]| apart(scaled(*other), scaled(point)) < SAME;
            if !distinct.iter().any(known) {
                distinct.push(point);
            }
        }
        distinct
    }

    /// True if the curve passes over a point of the box, which is located on it to rounding.
    fn passes(&self, curve: &mut LocusCurve, region: &Region, point: [f64; 2]) -> bool {
        if self.points.iter().any(|own| apart(*own, point) < SAME) {
            return true;
        }
        for (i, ends) in self.points.windows(2).enumerate() {
            let way = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
            let size = real::hypot(way[0], way[1]);
            let along = |p: [f64; 2]| (p[0] - point[0]) * way[0] + (p[1] - point[1]) * way[1];
            let off = (point[0] - ends[0][0]) * way[1] - (point[1] - ends[0][1]) * way[0];
            // a piece bends less than that
            let beside = along(ends[0]) < 0.0 && along(ends[1]) > 0.0;
            if size < SAME || !beside || off.abs() > 0.5 * size * size {
                continue;
            }
            let places = &self.traced.places[i..i + 2];
            let mut ahead = |_: &mut LocusCurve, p: &CurvePoint<Singular>| {
                along(scaled(region, self.scales, p))
            };
            let foot = (region.method).root(curve, &places[0], &places[1], &mut ahead);
            if apart(scaled(region, self.scales, &foot), point) < SAME {
                return true;
            }
        }
        false
    }

    /// True if the curve passes over points spread over all of another: algebraic curves share a component or few
    /// points.
    ///
    /// Near a crossing of curves a point may be lost to rounding, so that one of three neighbours suffices.
    fn covers(&self, other: &Projection, curve: &mut LocusCurve, region: &Region) -> bool {
        /// Points that are tested.
        const TRIED: usize = 12;
        if self.kind != other.kind || self.shape() != other.shape() {
            return false;
        }
        (0..=TRIED).all(|k| {
            let place = k as f64;
            let near = [0.0_f64, 0.1, -0.1].map(|aside| match k {
                TRIED => place - aside.abs(),
                _ => (place + aside).abs(),
            });
            near.into_iter().any(|place| {
                let point = other.point(place / TRIED as f64 * other.length);
                self.passes(curve, region, point)
            })
        })
    }

    /// The point at this arc length of the curve.
    fn point(&self, way: f64) -> [f64; 2] {
        let mut gone = 0.0;
        for pair in self.points.windows(2) {
            gone += apart(pair[0], pair[1]);
            if gone >= way {
                return pair[1];
            }
        }
        self.points.last().copied().unwrap_or_default()
    }
}

/// Curves that lie over one another in the box, by their numbers: the first of each group passes over
/// all the others, and is the shortest that does. One that stands still where others cross is left out.
pub(super) fn groups(
    curve: &mut LocusCurve,
    region: &Region,
    projections: &[Projection],
) -> Vec<Vec<usize>> {
    let mut longest: Vec<usize> = (0..projections.len()).collect();
    sort_by(&mut longest, |a, b| {
        projections[*b].length.total_cmp(&projections[*a].length)
    });
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for number in longest {
        let own = &projections[number];
        let known = groups
            .iter()
            .position(|group| projections[group[0]].covers(own, curve, region));
        match known {
            Some(group) => groups[group].push(number),
            None => groups.push(vec![number]),
        }
    }
    for group in &mut groups {
        // a curve that goes round once stands for one that goes round twice
        let whole = (1..group.len()).rev().find(|member| {
            projections[group[*member]].covers(&projections[group[0]], curve, region)
        });
        if let Some(whole) = whole {
            group.swap(0, whole);
        }
    }
    let mut crossed = |group: &Vec<usize>| {
        let own = &projections[group[0]];
        own.stands_still(curve)
            && projections.iter().any(|other| {
                other.shape() == ImageShape::Curve && other.passes(curve, region, own.points[0])
            })
    };
    groups.retain(|group| !crossed(group));
    groups
}
