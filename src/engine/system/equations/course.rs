//! Equations while the dimensions change.

use super::{System, SystemWork};
use crate::geometry::{Rotation, Vector3};
use crate::linear::Factorable;
use crate::mechanism::{Configuration, KinematicsCourse, PoseCoordinate, Side, orientation_rows};
use crate::number::Dual;

/// The straight way of all constants from those of one system to those of another.
#[derive(Clone, Debug)]
pub(crate) struct ConstantsCourse<T> {
    kinematics: KinematicsCourse<T>,
    /// For rods whose length changes, its square and the change of that, as nothing else of it is in the equations; the
    /// length itself where joints are in it too.
    lengths: Vec<(usize, bool, T, T)>,
}

impl<T: Factorable> ConstantsCourse<T> {
    /// With all changes multiplied.
    pub(crate) fn stretched(mut self, factor: f64) -> Self {
        self.kinematics.stretch(factor);
        (self.lengths.iter_mut()).for_each(|length| length.3 = length.3.scale(factor));
        self
    }
}

impl<T: Factorable> System<T> {
    /// A system whose dimensions go from these to those of another of the same structure, with the way. `None` if more
    /// differs than fixed displacements and lengths.
    pub(crate) fn towards(&self, other: &Self) -> Option<(Self, ConstantsCourse<T>)> {
        let (kinematics, course) = self.kinematics.towards(&other.kinematics)?;
        let pairs = || self.closures.iter().zip(&other.closures);
        if pairs().any(|(from, to)| from.bends_unlike(to)) {
            return None;
        }
        let lengths = pairs().enumerate();
        let lengths = lengths.filter(|(_, (from, to))| from.length != to.length);
        let lengths = lengths.map(|(i, (from, to))| {
            let squared = from.extension.0.is_empty();
            let power = |length: T| if squared { length * length } else { length };
            let (from, to) = (power(from.length), power(to.length));
            (i, squared, from, to - from)
        });
        let course = ConstantsCourse {
            kinematics: course,
            lengths: lengths.collect(),
        };
        let system = System {
            kinematics,
            ..self.clone()
        };
        Some((system, course))
    }

    /// The rates of all rows where frames were last placed, in place of the residual, for rates of all joints and the
    /// rotation rate and velocity of each platform, which are in the first of `slots`, at s of a way. Nothing allocates.
    pub(crate) fn drift(
        &self,
        at: &Configuration<T>,
        rates: &[T],
        way: Option<(&ConstantsCourse<T>, T)>,
        slots: &mut [(Vector3<T>, Vector3<T>)],
        work: &mut SystemWork<T>,
    ) {
        let chains = way.map(|(course, s)| (&course.kinematics, s));
        (self.kinematics).drift((&at.joints, rates), chains, &work.placement, slots);
        work.residual.fill(T::zero());
        let over = 1.0 / (self.length * self.length);
        for (plan, closure) in self.plans.iter().zip(&self.closures) {
            let rows = closure.rows(&work.placement, at);
            let out = &mut work.residual[plan.row..plan.row + plan.rows];
            for (side, slot) in [Side::A, Side::B].into_iter().zip(closure.slots) {
                let (omega, v) = &slots[slot];
                let arm = *rows.velocity_point(side) - work.placement.pose(slot).position;
                rows.rates(side, omega, &(*v + omega.cross(&arm)), out);
            }
            if !plan.extending.is_empty() {
                out[0] += closure.length_rate(&at.joints, rates);
            }
        }
        let lengths = way.map_or(&[][..], |(course, _)| &course.lengths);
        for (closure, squared, _, change) in lengths {
            let half = match squared {
                true => change.scale(0.5),
                false => self.closures[*closure].length(&at.joints) * *change,
            };
            let row = &mut work.residual[self.plans[*closure].row];
            *row -= half.scale(over);
        }
    }

    /// Adds the rate of the rows for a rate of the value at which a platform coordinate is held.
    pub(crate) fn add_target_rate(
        &self,
        (platform, coordinate): (usize, PoseCoordinate),
        value: Dual<T>,
        at: &Configuration<T>,
        work: &mut SystemWork<T>,
    ) {
        if let Some(row) = self.coordinate_row(platform, coordinate) {
            let pose = at.platforms[platform].pose().map(Dual::constant);
            work.residual[row] += coordinate.row(&pose, value, self.length).0.slope;
        }
    }

    /// Adds the rate of the rows for a rate of the orientation at which a platform is held.
    pub(crate) fn add_orientation_rate(
        &self,
        platform: usize,
        wanted: &Rotation<Dual<T>>,
        at: &Configuration<T>,
        work: &mut SystemWork<T>,
    ) {
        if let Some(row) = self.orientation_row(platform) {
            let pose = at.platforms[platform].pose().map(Dual::constant);
            let gaps = orientation_rows(&pose.rotation, wanted).0;
            for (row, gap) in work.residual[row..].iter_mut().zip(gaps) {
                *row += gap.slope;
            }
        }
    }

    /// The dimensions at another place of the way. Nothing allocates.
    pub(crate) fn go(&mut self, course: &ConstantsCourse<T>, s: T, work: &mut SystemWork<T>) {
        (self.kinematics).go(&course.kinematics, s, &mut work.placement);
        for (closure, squared, from, change) in &course.lengths {
            let power = *from + *change * s;
            self.closures[*closure].length = if *squared { power.sqrt() } else { power };
        }
    }
}
