//! Reactions: what joints and closures transmit from body to body.

use std::collections::HashMap;

use super::{Acting, ClosureWrenches, FrameTwists, Loaded, Unknown};
use crate::geometry::Vector3;
use crate::mechanism::{Body, Frame, Kinematics, Mechanism, Placement};
use crate::number::Number;

/// The wrench that a joint or a closure exerts on the second of two bodies.
#[derive(Clone, Copy, Debug)]
pub struct Carried<T = f64> {
    /// The point it acts at: the origin of the second frame of a closure, of the frame after the row of a joint; from the
    /// centre, in m.
    pub point: Vector3<T>,
    /// Force, in N.
    pub force: Vector3<T>,
    /// Moment about the point, in N·m.
    pub moment: Vector3<T>,
    /// The axis of a joint, z of the frame after its row in the modified convention; from the first to the second end of a
    /// closure.
    pub axis: Vector3<T>,
}

/// The bodies of a mechanism and what joins them. Built once.
#[derive(Clone, Debug)]
pub struct Bearings<T = f64> {
    /// The links, each after the one that carries it where that is a link.
    links: Vec<(Body, usize, usize)>,
    /// For each link the number of the link that carries it.
    carriers: Vec<Option<usize>>,
    twists: FrameTwists<T>,
    /// For each closure the numbers of the links it joins.
    closures: Vec<[Option<usize>; 2]>,
    /// For each point of the load the number of its link.
    points: Vec<Option<usize>>,
    length: f64,
}

/// Force, and moment about the centre.
type Wrench<T> = [Vector3<T>; 2];

fn at_centre<T: Number>(point: &Vector3<T>, force: Vector3<T>, moment: Vector3<T>) -> Wrench<T> {
    [force, moment + point.cross(&force)]
}

impl<T: Number> Carried<T> {
    /// The force along the axis; tension is positive.
    pub fn axial(&self) -> T {
        -(self.force.dot(&self.axis) / self.axis.norm())
    }
}

impl<T: Number> Bearings<T> {
    /// Frames that must be placed.
    pub fn frames(mechanism: &Mechanism) -> impl Iterator<Item = Frame> {
        links(mechanism)
            .into_iter()
            .map(|(_, chain, row)| Frame::Link { chain, row })
    }

    /// For what acts in a mechanism.
    pub fn new(
        mechanism: &Mechanism,
        unknowns: &[Unknown],
        loaded: &Loaded<T>,
        kinematics: &Kinematics<T>,
    ) -> Self {
        let links = links(mechanism);
        let bodies = links.iter().enumerate();
        let numbers: HashMap<Body, usize> = bodies.map(|(i, (body, ..))| (*body, i)).collect();
        let number = |frame: Frame| numbers.get(&mechanism.body(frame)).copied();
        let frames: Vec<Frame> = Bearings::<T>::frames(mechanism).collect();
        let dimensions = mechanism.dimensions().map(T::from_f64);
        let carrier = |&(_, chain, row): &(Body, usize, usize)| {
            number(Frame::Link {
                chain,
                row: row - 1,
            })
        };
        Bearings {
            carriers: links.iter().map(carrier).collect(),
            twists: FrameTwists::sharing(kinematics, &dimensions, unknowns, &frames),
            closures: (mechanism.closures().iter())
                .map(|closure| closure.frames.map(number))
                .collect(),
            points: loaded.points().iter().map(|of| number(of.frame)).collect(),
            length: mechanism.characteristic_length(),
            links,
        }
    }

    /// The number of closures, whose reactions come before those of joints.
    pub fn closures(&self) -> usize {
        self.closures.len()
    }

    /// The links behind joints, as body, chain and row.
    pub fn links(&self) -> &[(Body, usize, usize)] {
        &self.links
    }

    /// The reactions of closures, then of the joints that carry links, for multipliers λ of the closure rows, in N·m.
    ///
    /// A closure exerts Σ λ·row on its second body and the opposite on its first. A joint balances all that acts on the
    /// bodies beyond it.
    pub fn carried(
        &self,
        (loaded, acting): (&Loaded<T>, &Acting<T>),
        wrenches: &[ClosureWrenches<T>],
        multipliers: &[T],
        placement: &Placement<T>,
        carried: &mut Vec<Carried<T>>,
    ) {
        let nothing = [Vector3::zero(); 2];
        let mut sums: Vec<Wrench<T>> = vec![nothing; self.links.len()];
        let mut add = |mut link: Option<usize>, wrench: Wrench<T>| {
            // a joint carries what acts on its link and on all that stands on it
            while let Some(i) = link {
                sums[i][0] += -wrench[0];
                sums[i][1] += -wrench[1];
                link = self.carriers[i];
            }
        };
        for (i, [force, moment]) in acting.wrenches.iter().enumerate() {
            let point = loaded.origin(i, placement);
            add(self.points[i], at_centre(&point, *force, *moment));
        }
        carried.clear();
        for (wrenches, links) in wrenches.iter().zip(&self.closures) {
            let (mut force, mut moment) = (Vector3::zero(), Vector3::zero());
            for (row, &factor) in wrenches.rows.iter().zip(&multipliers[wrenches.first_row..]) {
                let [a, b, c, x, y, z] = *row;
                moment += Vector3([a, b, c]).times(factor);
                force += Vector3([x, y, z]).times(factor.scale(1.0 / self.length));
            }
            let [start, end] = wrenches.points;
            add(links[1], at_centre(&end, force, moment));
            add(links[0], at_centre(&start, -force, -moment));
            carried.push(Carried {
                point: end,
                force,
                moment,
                axis: end - start,
            });
        }
        carried.extend(sums.into_iter().enumerate().map(|(i, [force, moment])| {
            let point = self.twists.origin(i, placement);
            Carried {
                point,
                force,
                moment: moment - point.cross(&force),
                axis: self.twists.axis(i, placement),
            }
        }));
    }
}

fn links(mechanism: &Mechanism) -> Vec<(Body, usize, usize)> {
    let bodies = mechanism.bodies().into_iter();
    let links = bodies.filter_map(|body| match body {
        Body::Link { chain, row } => Some((body, chain, row)),
        _ => None,
    });
    links.collect()
}
