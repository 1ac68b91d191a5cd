//! Chains while their fixed displacements change.

use super::step::{FixedShape, PlacedStep, RotationColumn};
use super::{Kinematics, Placement};
use crate::geometry::{Quaternion, Vector3};
use crate::number::Number;

/// The straight way of fixed displacements from those of one mechanism to those of another: positions and quaternions
/// with their changes, where there are any.
#[derive(Clone, Debug)]
pub struct KinematicsCourse<T> {
    shifts: Vec<(usize, Vector3<T>, Vector3<T>)>,
    turns: Vec<(usize, Quaternion<T>, Quaternion<T>)>,
}

impl<T: Number> KinematicsCourse<T> {
    /// Multiplies all changes.
    pub fn stretch(&mut self, factor: f64) {
        let shifts = self.shifts.iter_mut().flat_map(|shift| &mut shift.2.0);
        let turns = self.turns.iter_mut().flat_map(|turn| &mut turn.2.0);
        shifts.chain(turns).for_each(|x| *x = x.scale(factor));
    }
}

impl<T: Number> PlacedStep<T> {
    /// With products left out only if they are for the other too; `None` if more than the fixed displacement differs.
    fn change_to(&self, other: &Self) -> Option<Self> {
        let alike = self.parent == other.parent
            && self.still == other.still
            && self.need == other.need
            && (self.shape == FixedShape::Grounded) == (other.shape == FixedShape::Grounded)
            && (&self.turn, &self.slide) == (&other.turn, &other.slide);
        let columns = self.columns.iter().zip(other.columns);
        let mut columns = columns.map(|(a, b)| if *a == b { b } else { RotationColumn::Any });
        alike.then(|| PlacedStep {
            shape: match self.shape == other.shape {
                true => self.shape,
                false => FixedShape::General,
            },
            columns: std::array::from_fn(|_| columns.next().unwrap_or(RotationColumn::Any)),
            level: self.level && other.level,
            ..self.clone()
        })
    }
}

impl<T: Number> Kinematics<T> {
    /// The plan by which all displacements between those of two mechanisms of one structure are evaluated, and the way
    /// from one to the other. `None` if more than fixed displacements differs.
    pub fn towards(&self, other: &Self) -> Option<(Self, KinematicsCourse<T>)> {
        let alike = self.frames == other.frames && self.steps.len() == other.steps.len();
        let pairs = || self.steps.iter().zip(&other.steps).filter(|_| alike);
        let steps = pairs().map(|(from, to)| from.change_to(to));
        let steps: Vec<PlacedStep<T>> = steps.collect::<Option<_>>().filter(|_| alike)?;
        let (mut shifts, mut turns) = (Vec::new(), Vec::new());
        for (i, (from, to)) in pairs().enumerate() {
            let (from, to) = (&from.fixed, &to.fixed);
            if from.position != to.position {
                shifts.push((i, from.position, to.position - from.position));
            }
            if from.rotation != to.rotation {
                let [a, b] = [from, to].map(|pose| Quaternion::from_rotation(&pose.rotation).0);
                let along = a.iter().zip(b).map(|(a, b)| (*a * b).real()).sum::<f64>();
                let sign = T::from_f64(if along < 0.0 { -1.0 } else { 1.0 });
                let change = std::array::from_fn(|k| sign * b[k] - a[k]);
                turns.push((i, Quaternion(a), Quaternion(change)));
            }
        }
        let plan = Kinematics {
            platforms: self.platforms,
            steps,
            frames: self.frames.clone(),
            moving: self.moving.clone(),
        };
        Some((plan, KinematicsCourse { shifts, turns }))
    }

    /// The displacements at another place of the way. Nothing allocates.
    pub fn go(&mut self, course: &KinematicsCourse<T>, s: T, placement: &mut Placement<T>) {
        for (i, from, change) in &course.shifts {
            self.steps[*i].fixed.position = *from + change.times(s);
            self.ground(*i, placement);
        }
        for (i, from, change) in &course.turns {
            let at = std::array::from_fn(|k| from.0[k] + change.0[k] * s);
            self.steps[*i].fixed.rotation = Quaternion(at).normalised().rotation();
            self.ground(*i, placement);
        }
    }

    /// Rotation rate and velocity of the origin in every slot, by those of the platforms, which are there, by the rates of
    /// joints and by the way at s.
    pub fn drift(
        &self,
        (joints, rates): (&[T], &[T]),
        way: Option<(&KinematicsCourse<T>, T)>,
        placement: &Placement<T>,
        slots: &mut [(Vector3<T>, Vector3<T>)],
    ) {
        let mut shifts = way.map_or(&[][..], |(course, _)| &course.shifts).iter();
        let mut turns = way.map_or(&[][..], |(course, _)| &course.turns).iter();
        let s = way.map_or(T::zero(), |(_, s)| s);
        let (mut shift, mut turn) = (shifts.next(), turns.next());
        for (i, step) in self.steps.iter().enumerate() {
            let slot = 1 + self.platforms + i;
            let (parent, pose) = (placement.pose(step.parent), placement.pose(slot));
            let z = pose.rotation.0[2];
            let (mut omega, mut v) = slots[step.parent];
            v += omega.cross(&(pose.position - parent.position));
            if let Some((_, _, change)) = shift.filter(|shift| shift.0 == i) {
                v += parent.rotation * *change;
                shift = shifts.next();
            }
            if let Some((_, from, change)) = turn.filter(|turn| turn.0 == i) {
                let at = std::array::from_fn(|k| from.0[k] + change.0[k] * s);
                let turned = parent.rotation * Quaternion(at).turning(change);
                omega += turned;
                if !step.slide.0.is_empty() {
                    v += turned.cross(&z.times(step.slide.at(joints)));
                }
                turn = turns.next();
            }
            if !step.turn.0.is_empty() {
                omega += z.times(step.turn.at(rates));
            }
            if !step.slide.0.is_empty() {
                v += z.times(step.slide.at(rates));
            }
            slots[slot] = (omega, v);
        }
    }

    fn ground(&self, step: usize, placement: &mut Placement<T>) {
        if self.steps[step].shape == FixedShape::Grounded {
            placement.0[1 + self.platforms + step] = self.steps[step].fixed;
        }
    }
}
