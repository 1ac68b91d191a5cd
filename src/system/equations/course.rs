//! The same equations while the dimensions change.

use super::{System, Work};
use crate::linear::Factorable;
use crate::mechanism::KinematicsCourse;

/// The straight way of all constants from those of one system to those of another.
#[derive(Clone, Debug)]
pub(crate) struct Course<T> {
    kinematics: KinematicsCourse<T>,
    /// Of closures whose length changes, the length and its change.
    lengths: Vec<(usize, T, T)>,
}

impl<T: Factorable> System<T> {
    /// A system whose dimensions go from these to those of another of the same structure, with the way. `None` if more
    /// differs than fixed displacements and lengths.
    pub(crate) fn towards(&self, other: &Self) -> Option<(Self, Course<T>)> {
        let (kinematics, course) = self.kinematics.towards(&other.kinematics)?;
        let pairs = || self.closures.iter().zip(&other.closures);
        if pairs().any(|(from, to)| from.extension != to.extension) {
            return None;
        }
        let lengths = pairs().enumerate();
        let lengths = lengths.filter(|(_, (from, to))| from.length != to.length);
        let lengths = lengths.map(|(i, (from, to))| (i, from.length, to.length - from.length));
        let course = Course {
            kinematics: course,
            lengths: lengths.collect(),
        };
        let system = System {
            kinematics,
            ..self.clone()
        };
        Some((system, course))
    }

    /// The dimensions at another place of the way. Nothing allocates.
    pub(crate) fn go(&mut self, course: &Course<T>, s: T, work: &mut Work<T>) {
        (self.kinematics).go(&course.kinematics, s, &mut work.placement);
        for (closure, from, change) in &course.lengths {
            self.closures[*closure].length = *from + *change * s;
        }
    }
}
