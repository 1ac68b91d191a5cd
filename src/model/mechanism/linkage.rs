//! Bodies and the joints between them, however these are written: rows that move, and closures.

use super::{Body, ClosureKind, Frame, Mechanism};
use crate::linear::{join, root};

/// The place of a joint in the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Connector {
    /// A row that moves, from 0.
    Row { chain: usize, row: usize },
    /// The closure of that index.
    Closure(usize),
}

/// A joint between two bodies.
#[derive(Clone, Copy, Debug)]
pub struct Connection {
    /// The bodies: in a chain the one nearer to its base first, of a closure those of its frames.
    pub bodies: [Body; 2],
    /// The joint.
    pub by: Connector,
}

/// The graph of a mechanism.
#[derive(Clone, Debug)]
pub struct Linkage {
    /// The bodies, ground first.
    pub bodies: Vec<Body>,
    /// The rows that move, then the closures that join bodies.
    pub connections: Vec<Connection>,
}

/// A loop: a closure, and the two ways from it to the body where they meet.
#[derive(Clone, Debug)]
pub struct FundamentalLoop {
    /// The closure that completes it.
    pub closure: usize,
    /// Its bodies in order, from the one where the two ways meet, the first frame of the closure before the second.
    pub bodies: Vec<Body>,
    /// The connection between each body and the next, and between the last and the first.
    pub connections: Vec<usize>,
}

impl Mechanism {
    /// Its bodies, and the joints between them.
    pub fn linkage(&self) -> Linkage {
        let mut connections = Vec::new();
        for (chain, part) in self.chains.iter().enumerate() {
            let body = |row| self.body(Frame::Link { chain, row });
            for row in (0..part.rows.len()).filter(|&row| part.rows[row].moves()) {
                connections.push(Connection {
                    bodies: [row, row + 1].map(body),
                    by: Connector::Row { chain, row },
                });
            }
        }
        let closures = self.closures.iter().enumerate();
        let joining = closures.filter(|(_, closure)| closure.kind != ClosureKind::Coupling);
        connections.extend(joining.map(|(index, closure)| Connection {
            bodies: closure.frames.map(|frame| self.body(frame)),
            by: Connector::Closure(index),
        }));
        Linkage {
            bodies: self.bodies(),
            connections,
        }
    }
}

impl Linkage {
    /// The fundamental loops over the spanning tree of rows and first closures: each closure between bodies that are
    /// already connected completes one, and none is a combination of the others.
    pub fn loops(&self) -> Vec<FundamentalLoop> {
        let number = |body: &Body| {
            let found = self.bodies.binary_search(body);
            found.expect("connections are between bodies of the mechanism")
        };
        let ends: Vec<[usize; 2]> = (self.connections.iter())
            .map(|connection| connection.bodies.each_ref().map(number))
            .collect();
        let mut roots: Vec<usize> = (0..self.bodies.len()).collect();
        let mut tree: Vec<Vec<(usize, usize)>> = vec![Vec::new(); self.bodies.len()];
        let mut closing = Vec::new();
        for (index, &[a, b]) in ends.iter().enumerate() {
            match self.connections[index].by {
                Connector::Closure(closure) if root(&mut roots, a) == root(&mut roots, b) => {
                    closing.push((closure, index));
                }
                _ => {
                    tree[a].push((b, index));
                    tree[b].push((a, index));
                    join(&mut roots, a, b);
                }
            }
        }
        // for each body the next one on the way to the first of its component, and the connection to it
        let mut ahead: Vec<Option<(usize, usize)>> = vec![None; self.bodies.len()];
        let mut waiting: Vec<usize> = (0..self.bodies.len())
            .filter(|&body| root(&mut roots, body) == body)
            .collect();
        while let Some(at) = waiting.pop() {
            let before = ahead[at].map(|(_, connection)| connection);
            for &(next, connection) in &tree[at] {
                if before != Some(connection) {
                    ahead[next] = Some((at, connection));
                    waiting.push(next);
                }
            }
        }
        let way = |from: usize| {
            let steps = std::iter::successors(Some((from, None)), |&(at, _)| {
                ahead[at].map(|(next, connection)| (next, Some(connection)))
            });
            steps.collect::<Vec<_>>()
        };
        let fundamental = |(closure, index): (usize, usize)| {
            let [mut first, mut second] = ends[index].map(way);
            while let ([.., a, _], [.., b, _]) = (&first[..], &second[..])
                && a.0 == b.0
            {
                first.pop();
                second.pop();
            }
            let bodies = first.iter().rev().chain(&second[..second.len() - 1]);
            let down = first.iter().rev().filter_map(|(_, connection)| *connection);
            let up = second.iter().filter_map(|(_, connection)| *connection);
            FundamentalLoop {
                closure,
                bodies: bodies.map(|&(body, _)| self.bodies[body]).collect(),
                connections: down.chain([index]).chain(up).collect(),
            }
        };
        closing.into_iter().map(fundamental).collect()
    }
}
