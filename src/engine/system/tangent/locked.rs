//! The closure Jacobian with rows for the rates of inputs or outputs.

use super::twists::FrameTwists;
use crate::linear::{Decomposition, product};
use crate::mechanism::{Configuration, Frame, Mechanism, Point};
use crate::solve::Equations;
use crate::system::{Coordinate, Held, System, SystemWork};

/// A coordinate or frame whose rate is an input or an output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lock {
    /// A joint or a platform coordinate.
    Coordinate(Coordinate),
    /// A frame: it neither turns nor moves.
    Frame(Frame),
    /// A point of a frame: the frame may turn about it.
    Point(Point),
}

/// M = [J; A]: the closure Jacobian J with nothing held, above the rates A of inputs or outputs. Its
/// null space are the motions that leave these at rest.
///
/// Rows and columns are dimensionless; the columns are the unknowns of [`Locked::system`].
#[derive(Clone, Debug)]
pub struct Locked {
    system: System<f64>,
    work: SystemWork<f64>,
    locks: Vec<Lock>,
    /// Twists of the frames and points among the locks, in their order.
    twists: FrameTwists<f64>,
    length: f64,
}

impl Lock {
    /// Number of its rates.
    pub fn rows(self) -> usize {
        match self {
            Lock::Coordinate(_) => 1,
            Lock::Frame(_) => 6,
            Lock::Point(_) => 3,
        }
    }

    /// The point on whose twist its rate depends; none for a joint.
    pub fn point(self) -> Option<Point> {
        match self {
            Lock::Frame(frame) => Some(frame.into()),
            Lock::Point(point) => Some(point),
            Lock::Coordinate(Coordinate::Pose(platform, _) | Coordinate::Turn(platform, _)) => {
                Some(Frame::Platform { platform }.into())
            }
            Lock::Coordinate(Coordinate::Joint(_)) => None,
        }
    }

    /// Name of the coordinate, frame or point.
    pub fn name(self, mechanism: &Mechanism) -> String {
        match self {
            Lock::Coordinate(coordinate) => coordinate.name(mechanism),
            Lock::Frame(frame) => mechanism.frame_name(frame),
            Lock::Point(point) => format!("point {}", point.name(mechanism)),
        }
    }
}

impl Locked {
    /// For these inputs or outputs.
    pub fn new(mechanism: &Mechanism, locks: &[Lock]) -> Self {
        Locked::without_spins(mechanism, &Held::nothing(mechanism), locks)
    }

    /// M with platforms kept from spinning about the lines about which they do not spin in `held`.
    pub fn without_spins(mechanism: &Mechanism, held: &Held<f64>, locks: &[Lock]) -> Self {
        let mut still = Held::nothing(mechanism);
        for (still, held) in still.platforms.iter_mut().zip(&held.platforms) {
            still.stop(held.spins());
        }
        let system = System::new(mechanism.dimensions(), &still);
        let placed = (locks.iter()).filter(|lock| !matches!(lock, Lock::Coordinate(_)));
        let points: Vec<Point> = placed.filter_map(|lock| lock.point()).collect();
        Locked {
            twists: FrameTwists::new(mechanism.dimensions(), system.unknowns(), &points),
            work: system.work(),
            system,
            locks: locks.to_vec(),
            length: mechanism.characteristic_length(),
        }
    }

    /// The closure equations with nothing held.
    pub fn system(&self) -> &System<f64> {
        &self.system
    }

    /// Rows of M.
    pub fn rows(&self) -> usize {
        self.system.rows() + self.locks.iter().map(|lock| lock.rows()).sum::<usize>()
    }

    /// Columns of M.
    pub fn columns(&self) -> usize {
        self.system.unknowns().len()
    }

    /// M at a configuration, column-major.
    pub fn jacobian(&mut self, at: &Configuration<f64>) -> Vec<f64> {
        self.system.linearise(at, &mut self.work);
        let closures = self.system.dense_jacobian(&self.work);
        let (first, rows) = (self.system.rows(), self.rows());
        let mut entries = vec![0.0; rows * self.columns()];
        for (to, from) in
            (entries.chunks_exact_mut(rows.max(1))).zip(closures.chunks_exact(first.max(1)))
        {
            to[..first].copy_from_slice(from);
        }
        let placement = self.twists.placed(at);
        let (mut row, mut frame) = (first, 0);
        let mut rates = vec![0.0; self.columns()];
        for lock in &self.locks {
            if let Lock::Coordinate(coordinate) = *lock {
                for (column, slope) in coordinate.slope_in(&self.system, at) {
                    entries[column * rows + row] = slope;
                }
            } else {
                for column in 0..rates.len() {
                    rates[column] = 1.0;
                    let twist = self.twists.twist(frame, &placement, &rates);
                    rates[column] = 0.0;
                    let velocity = twist.velocity.times(1.0 / self.length);
                    let to = &mut entries[column * rows + row..][..lock.rows()];
                    match lock {
                        Lock::Frame(_) => {
                            to[..3].copy_from_slice(&twist.omega.0);
                            to[3..].copy_from_slice(&velocity.0);
                        }
                        _ => to.copy_from_slice(&velocity.0),
                    }
                }
                frame += 1;
            }
            row += lock.rows();
        }
        entries
    }

    /// The rates of the inputs or outputs in motions at a configuration: A ξ for each ξ.
    pub fn rates(&mut self, at: &Configuration<f64>, motions: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let entries = self.jacobian(at);
        let (rows, first) = (self.rows(), self.system.rows());
        let rates = |motion: &Vec<f64>| product(&entries, rows, motion).split_off(first);
        motions.iter().map(rates).collect()
    }

    /// M decomposed at a configuration, cut at the rank tolerance.
    pub fn decomposition(&mut self, at: &Configuration<f64>) -> Decomposition {
        let entries = self.jacobian(at);
        Decomposition::of(self.rows(), self.columns(), &entries)
    }

    /// M decomposed at a configuration, cut at a rank that is known.
    pub fn of_rank(&mut self, at: &Configuration<f64>, rank: usize) -> Decomposition {
        let entries = self.jacobian(at);
        Decomposition::of_rank(self.rows(), self.columns(), &entries, rank)
    }

    /// det(Uᵀ M V Σ⁻¹) with the decomposition U Σ Vᵀ of M at a configuration nearby: 1 there, and of
    /// the other sign beyond a loss of an odd number of ranks. It is smooth, also with redundant rows.
    pub fn orientation(&mut self, near: &Decomposition, at: &Configuration<f64>) -> f64 {
        let entries = self.jacobian(at);
        near.determinant_beside(&entries)
    }
}
