//! What bounds modes and separates aspects: points on the edges of the grid, and curves through
//! them.

use serde::{Deserialize, Serialize};

use super::asked::Asked;
use super::curves::Tracer;
use super::edge::{Edge, Met, Until, walk};
use super::filled::{Filled, Link};
use super::grid::Grid;
use super::measure::Measure;
use crate::mechanism::Configuration;
use crate::solve::{Continuation, each};
use crate::system::{
    Curve, Driven, Holdable, Lock, LocusCurve, LocusEnd, Region, Singular, settled,
};

/// What a boundary is.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BoundaryKind {
    /// An inverse singularity (type 1 of Gosselin and Angeles): modes of the inverse problem meet.
    Inverse,
    /// A direct singularity (type 2): assemblies meet.
    Direct,
    /// Solutions meet that are neither, as both joints and coordinates of platforms are held.
    Fold,
    /// A joint is at its limit.
    Limit {
        /// Its name.
        joint: String,
        /// Whether it is the upper one.
        upper: bool,
    },
}

/// A boundary point on an edge of the grid, located to rounding.
#[derive(Clone, Debug)]
pub(super) struct Crossing {
    pub sheet: usize,
    pub direction: usize,
    pub kind: Kind,
    pub at: Configuration<f64>,
    /// The part of the way from the sheet to its neighbour.
    pub part: f64,
    /// Whether the same point was met on another edge, at a node that they share.
    pub again: bool,
}

/// A kind by numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Kind {
    Fold,
    Direct,
    Inverse,
    Limit(usize, bool),
}

impl Kind {
    /// Whether modes end there, or only aspects are parted.
    pub fn ends_reach(self) -> bool {
        matches!(self, Kind::Fold | Kind::Limit(..))
    }
}

/// A boundary curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BoundaryCurve {
    /// What it is.
    pub kind: BoundaryKind,
    /// Whether modes end there, or only aspects are parted.
    pub ends_reach: bool,
    /// The third mapped coordinate, rad or m, if there is one.
    pub slice: Option<f64>,
    /// How its first and its last point end it.
    pub ends: [LocusEnd; 2],
    /// Points: the first two mapped coordinates, rad or m.
    pub points: Vec<[f64; 2]>,
    /// The joints at its points, rad or m, in the order of the file.
    pub joints: Vec<Vec<f64>>,
    /// Which of its pieces bound which mode.
    pub pieces: Vec<Piece>,
}

/// A piece of a curve on the boundary of a mode.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Piece {
    /// The mode.
    pub mode: usize,
    /// Its points: the first two mapped coordinates, rad or m.
    pub points: Vec<[f64; 2]>,
}

pub(super) struct Boundary<'a> {
    pub asked: &'a Asked<'a>,
    pub grid: &'a Grid,
    pub measure: &'a Measure,
    pub filled: &'a Filled,
    /// For each sheet the number of its mode, from 0; none if it is not listed.
    pub mode: &'a [Option<usize>],
}

impl Boundary<'_> {
    /// Where sheets within limits end on the edges of the grid, and where signs change.
    pub fn crossings(&self) -> Vec<Crossing> {
        let inputs = Asked::locks(&self.asked.inputs);
        let outputs = Asked::locks(&self.asked.outputs);
        let joints = self.asked.mechanism.joints();
        let limited = joints.iter().any(|joint| joint.limits.is_some());
        let mut wanted: Vec<(usize, usize, Until)> = Vec::new();
        let mut found: Vec<Crossing> = Vec::new();
        let sheets = self.filled.sheets();
        for (s, sheet) in sheets.filter(|(_, sheet)| sheet.within) {
            let links = sheet.links[..2 * self.grid.dimensions()].iter();
            for (d, link) in links.enumerate() {
                match *link {
                    Link::Fold if limited => wanted.push((s, d, Until::Limit)),
                    Link::Fold => wanted.push((s, d, Until::End)),
                    Link::To(t) if !self.filled.named(t).within => {
                        wanted.push((s, d, Until::Limit));
                    }
                    Link::To(t) if d % 2 == 1 => {
                        let t = self.filled.number(t);
                        let [a, b] = [s, t].map(|s| &self.filled.sheet(s).told);
                        let mut parted = |x: f64, y: f64, kind: Kind, until| match (x, y) {
                            (0.0, 0.0) => {}
                            (0.0, _) => found.push(self.at_node((s, d), s, 0.0, kind)),
                            (_, 0.0) => found.push(self.at_node((s, d), t, 1.0, kind)),
                            _ if (x < 0.0) != (y < 0.0) => wanted.push((s, d, until)),
                            _ => {}
                        };
                        let until = Until::Singular(&inputs);
                        parted(a.direct, b.direct, Kind::Direct, until);
                        let until = Until::Singular(&outputs);
                        parted(a.inverse, b.inverse, Kind::Inverse, until);
                    }
                    _ => {}
                }
            }
        }
        let mut at_nodes = std::collections::HashSet::new();
        for crossing in &mut found {
            let links = &self.filled.sheet(crossing.sheet).links;
            let Link::To(t) = links[crossing.direction] else {
                continue;
            };
            let node = if crossing.part > 0.0 {
                self.filled.number(t)
            } else {
                crossing.sheet
            };
            crossing.again = !at_nodes.insert((node, crossing.kind));
        }
        let walked = each(wanted.len(), &(), |(), i| {
            let (s, d, until) = wanted[i];
            let (sheet, at) = (self.filled.sheet(s), self.filled.configuration(s).owned());
            let node = self.grid.neighbour(sheet.node, d)?;
            let edge = Edge {
                axis: d / 2,
                values: self.grid.values(sheet.node),
                to: self.grid.values(node)[d / 2],
            };
            let met = walk(self.asked, self.measure, &edge, &at, until);
            let kind = |locks: &[Lock]| match locks == &inputs[..] {
                true => Kind::Direct,
                false => Kind::Inverse,
            };
            let (kind, at, part) = match (met, until) {
                (Met::Limit(at, part, joint, upper), _) => (Kind::Limit(joint, upper), at, part),
                (Met::Fold(at, part), Until::Limit | Until::End) => (Kind::Fold, at, part),
                (Met::Singular(at, part), Until::Singular(locks)) => (kind(locks), at, part),
                _ => return None,
            };
            Some(Crossing {
                sheet: s,
                direction: d,
                kind,
                at,
                part,
                again: false,
            })
        });
        found.extend(walked.into_iter().flatten());
        found
    }

    /// A singularity at a node, an end of an edge.
    fn at_node(
        &self,
        (sheet, direction): (usize, usize),
        singular: usize,
        part: f64,
        kind: Kind,
    ) -> Crossing {
        Crossing {
            sheet,
            direction,
            kind,
            at: self.filled.configuration(singular).owned(),
            part,
            again: false,
        }
    }

    /// The curves through crossings, of the slices of the first two coordinates one after another.
    pub fn curves(&self, crossings: &[Crossing]) -> Vec<BoundaryCurve> {
        let slices = match self.grid.dimensions() {
            2 => 1,
            3 => self.grid.count(2),
            _ => return Vec::new(),
        };
        let traced = each(slices, &(), |(), slice| self.slice(crossings, slice));
        traced.into_iter().flatten().collect()
    }

    fn slice(&self, crossings: &[Crossing], slice: usize) -> Vec<BoundaryCurve> {
        let third = (self.grid.dimensions() == 3).then(|| self.grid.coordinate(2, slice));
        let question = match third {
            Some(value) => {
                let axis = self.asked.axes[2].coordinate;
                self.asked.question.clone().at_values([(axis, value)])
            }
            None => self.asked.question.clone(),
        };
        let asked = Asked::new(&question, &self.asked.axes[..2], &self.asked.newton);
        let here = |crossing: &&Crossing| {
            let node = self.filled.sheet(crossing.sheet).node;
            crossing.direction < 4 && (third.is_none() || self.grid.place(node, 2) == slice)
        };
        let here: Vec<&Crossing> = crossings.iter().filter(here).collect();
        let mut kinds: Vec<Kind> = Vec::new();
        for crossing in &here {
            if !kinds.contains(&crossing.kind) {
                kinds.push(crossing.kind);
            }
        }
        let mut curves = Vec::new();
        for kind in kinds {
            let of: Vec<&Crossing> = (here.iter().copied())
                .filter(|crossing| crossing.kind == kind)
                .collect();
            self.of_kind(&asked, kind, &of, third, &mut curves);
        }
        curves
    }

    fn of_kind(
        &self,
        asked: &Asked,
        kind: Kind,
        crossings: &[&Crossing],
        third: Option<f64>,
        curves: &mut Vec<BoundaryCurve>,
    ) {
        let mechanism = asked.mechanism;
        let mapped = asked.axes.iter();
        let still = mapped.fold(asked.question.clone(), |q, axis| q.without(axis.coordinate));
        let tracer = Tracer {
            boundary: self,
            asked,
            kind,
            third,
        };
        match kind {
            Kind::Limit(joint, upper) => {
                let limits = mechanism.joints()[joint].limits;
                let Some(limit) = limits.map(|(low, high)| if upper { high } else { low }) else {
                    return;
                };
                let held = still.at_values([(Holdable::Joint(joint), limit)]).held();
                // a mapped joint at its limit is a side of the box
                let free: Vec<Driven> = (asked.axes.iter().copied())
                    .filter(|axis| axis.coordinate != Holdable::Joint(joint))
                    .collect();
                let mut curve = Curve::new(mechanism, &held);
                let method = Continuation::default();
                let place = |curve: &mut Curve, at: &Configuration<f64>| {
                    let mut at = at.clone();
                    at.joints[joint] = limit;
                    method.settle(curve, at).ok()
                };
                let region = Region {
                    mechanism,
                    held: &held,
                    sides: &free,
                    method: &method,
                };
                tracer.all(&mut curve, &region, crossings, place, curves);
            }
            _ => {
                let held = still.held();
                let locks = match kind {
                    Kind::Direct => Asked::locks(&asked.inputs),
                    Kind::Inverse => Asked::locks(&asked.outputs),
                    _ => Asked::locks(&asked.held),
                };
                let mut curve = LocusCurve::new(mechanism, &held, &asked.inputs, &locks);
                let method = Continuation::default();
                let place = |curve: &mut LocusCurve, at: &Configuration<f64>| {
                    let columns = curve.locked().columns();
                    let decomposition = curve.locked().of_rank(at, columns);
                    let motion = decomposition.weakest()?.1.to_vec();
                    let at = at.clone();
                    settled(curve, Singular { at, motion }, &method)
                };
                let region = Region {
                    mechanism,
                    held: &held,
                    sides: &asked.axes,
                    method: &method,
                };
                tracer.all(&mut curve, &region, crossings, place, curves);
            }
        }
    }
}

/// A kind by name.
pub(super) fn named(asked: &Asked, kind: Kind) -> BoundaryKind {
    let of_platforms = asked.held.iter().all(|h| !matches!(h, Holdable::Joint(_)));
    match kind {
        Kind::Direct => BoundaryKind::Direct,
        Kind::Inverse => BoundaryKind::Inverse,
        Kind::Fold if of_platforms => BoundaryKind::Inverse,
        Kind::Fold if asked.holds(&asked.inputs) => BoundaryKind::Direct,
        Kind::Fold => BoundaryKind::Fold,
        Kind::Limit(joint, upper) => BoundaryKind::Limit {
            joint: asked.mechanism.joints()[joint].name.clone(),
            upper,
        },
    }
}
