//! Necessary and sufficient conditions of assembly of a mechanism without platforms, over boxes of joint values.
//!
//! The residuals of closures have denominators that keep flipped joints away; over a wide box these hold zero. Here
//! differences of points and axes stand for them, which vanish in the same places and nowhere else:
//!
//! | condition | rows | derivative along the motion (ω, v) of one side |
//! |---|---|---|
//! | points p_A, p_B coincide | (p_B − p_A)/L | ±v/L |
//! | axes coincide | b − a | ±ω × axis |
//! | axes are perpendicular | a·b | (ω × axis)·other |
//! | no offset along a | a·(p_B − p_A)/L | ±a·v/L at p_B |
//! | distance s | (g·g − s²)/2L² | ±g·v/L² |

use super::equations::HoldRow;
use crate::description::AxisCondition;
use crate::geometry::Rotation;
use crate::mechanism::{
    ClosureKind, Dimensions, Frame, JointRelation, Kinematics, LinearForm, Mover, Placement,
    PoseCoordinate,
};
use crate::number::{Interval, Number};
use crate::solve::Conditions;

/// The conditions of assembly. Unknowns are dimensionless: rad, or characteristic lengths.
#[derive(Clone, Debug)]
pub(crate) struct Enclosure {
    kinematics: Kinematics<Interval>,
    conditions: Vec<Condition>,
    unknowns: Vec<usize>,
    scales: Vec<f64>,
    held: Vec<Interval>,
    rows: usize,
    inverse_length: f64,
}

#[derive(Clone, Debug)]
struct Condition {
    what: What,
    slots: [usize; 2],
    /// Side, joint on its path, and its unknown.
    movers: Vec<(usize, Mover<Interval>, usize)>,
    row: usize,
}

#[derive(Clone, Debug)]
enum What {
    Closure(ClosureKind, Interval, LinearForm<Interval>),
    Coordinate(PoseCoordinate, Interval),
    Orientation(Rotation<Interval>),
    /// An expression of joints, and one over its natural size.
    Relation(JointRelation<Interval>, f64),
}

impl What {
    fn rows(&self) -> usize {
        match self {
            What::Closure(kind, ..) => {
                let conditions = kind.conditions();
                let axes = match conditions.axes {
                    AxisCondition::Free => 0,
                    AxisCondition::Perpendicular => 1,
                    AxisCondition::Aligned => 3,
                    AxisCondition::Oriented => 6,
                };
                let points = if conditions.origins { 3 } else { 0 };
                points + axes + conditions.offsets.len() + usize::from(kind.has_length())
            }
            What::Coordinate(..) | What::Relation(..) => 1,
            What::Orientation(_) => 6,
        }
    }
}

/// Storage of an [`Enclosure`].
#[derive(Clone, Debug)]
pub(crate) struct EnclosureStorage {
    placement: Placement<Interval>,
    joints: Vec<Interval>,
    values: Vec<Interval>,
    slopes: Vec<Interval>,
    possible: bool,
}

impl Enclosure {
    /// Conditions of a mechanism without platforms, with the held coordinates of its frames and the values of known
    /// joints.
    pub fn new(
        dimensions: &Dimensions<Interval>,
        holds: &[(Frame, HoldRow<Interval>)],
        held: &[Option<f64>],
    ) -> Self {
        let closures = dimensions.closures.iter();
        let frames = closures.clone().flat_map(|closure| closure.frames);
        let frames = frames.chain(holds.iter().map(|(frame, _)| *frame));
        let kinematics = Kinematics::new(dimensions, frames);
        let slot = |frame: Frame| {
            (kinematics.slot(frame)).expect("the kinematics was planned for these frames")
        };
        let closures = closures.map(|closure| {
            let (length, extension) = (closure.length, closure.extension.clone());
            let what = match &closure.relation {
                Some(relation) => {
                    let size = dimensions.joint_scales[relation.joints[0]];
                    What::Relation(relation.clone(), 1.0 / size)
                }
                None => What::Closure(closure.kind, length, extension),
            };
            (what, closure.frames.map(slot))
        });
        let holds = holds.iter().filter_map(|(frame, hold)| {
            let what = match hold {
                HoldRow::Coordinate(_, coordinate, value, _) => {
                    What::Coordinate(*coordinate, *value)
                }
                HoldRow::Orientation(_, wanted) => What::Orientation(*wanted),
                HoldRow::Spin(_) => return None,
            };
            Some((what, [0, slot(*frame)]))
        });
        let all: Vec<(What, [usize; 2])> = closures.chain(holds).collect();
        let scales = &dimensions.joint_scales;
        let moving = |slots: &[usize; 2]| slots.map(|slot| kinematics.movers(slot, scales).0);
        let mut unknowns: Vec<usize> = Vec::new();
        for (what, slots) in &all {
            unknowns.extend(moving(slots).iter().flatten().map(|mover| mover.joint));
            if let What::Closure(_, _, extension) = what {
                unknowns.extend(extension.0.iter().map(|(joint, _)| *joint));
            }
            if let What::Relation(relation, _) = what {
                unknowns.extend(relation.joints.iter());
            }
        }
        unknowns.retain(|&joint| held.get(joint).copied().flatten().is_none());
        unknowns.sort_unstable();
        unknowns.dedup();
        let mut rows = 0;
        let conditions = all.into_iter().map(|(what, slots)| {
            let row = rows;
            rows += what.rows();
            let sides = moving(&slots).into_iter().enumerate();
            let movers =
                sides.flat_map(|(side, movers)| movers.into_iter().map(move |m| (side, m)));
            let movers = movers.filter_map(|(side, mover)| {
                Some((side, mover, unknowns.binary_search(&mover.joint).ok()?))
            });
            Condition {
                movers: movers.collect(),
                what,
                slots,
                row,
            }
        });
        let conditions = conditions.collect();
        let known = |joint| held.get(joint).copied().flatten().unwrap_or(0.0);
        Enclosure {
            conditions,
            scales: unknowns.iter().map(|&joint| scales[joint]).collect(),
            held: (0..scales.len())
                .map(|j| Interval::point(known(j)))
                .collect(),
            rows,
            inverse_length: 1.0 / dimensions.characteristic_length,
            unknowns,
            kinematics,
        }
    }

    /// Holds a coordinate of a frame, already held, between two values, in rad or m.
    pub fn hold_coordinate(&mut self, frame: Frame, coordinate: PoseCoordinate, value: Interval) {
        let slot = self.kinematics.slot(frame);
        for condition in &mut self.conditions {
            if let What::Coordinate(held, known) = &mut condition.what
                && *held == coordinate
                && Some(condition.slots[1]) == slot
            {
                *known = value;
            }
        }
    }

    /// The unknown joints.
    pub fn unknowns(&self) -> &[usize] {
        &self.unknowns
    }

    /// For each unknown the size of a unit, rad or m.
    pub fn scales(&self) -> &[f64] {
        &self.scales
    }

    /// For each closure that joins two points: the sum of fixed lengths between them, and slides with lengths per unit.
    pub fn reaches(&self) -> impl Iterator<Item = (f64, Vec<(usize, f64)>)> {
        self.conditions.iter().filter_map(|condition| {
            let What::Closure(kind, length, extension) = &condition.what else {
                return None;
            };
            let joined = kind.conditions().origins || kind.has_length();
            joined.then(|| {
                let [(a, mut slides), (b, others)] =
                    condition.slots.map(|slot| self.kinematics.reach(slot));
                let extending = extension.0.iter();
                slides.extend(others);
                slides.extend(extending.map(|(joint, factor)| (*joint, factor.magnitude())));
                (a + b + length.magnitude(), slides)
            })
        })
    }
}

fn square(x: Interval) -> Interval {
    let x = x.abs();
    x * x
}

impl Conditions for Enclosure {
    type Work = EnclosureStorage;

    fn work(&self) -> EnclosureStorage {
        let zero = Interval::point(0.0);
        EnclosureStorage {
            placement: self.kinematics.placement(),
            joints: self.held.clone(),
            values: vec![zero; self.rows],
            slopes: vec![zero; self.rows * self.unknowns.len()],
            possible: true,
        }
    }

    fn evaluate(&self, at: &[Interval], slopes: bool, work: &mut EnclosureStorage) {
        for ((x, &joint), scale) in at.iter().zip(&self.unknowns).zip(&self.scales) {
            work.joints[joint] = *x * Interval::point(*scale);
        }
        self.kinematics
            .place_on(&[], &work.joints, &mut work.placement);
        work.possible = true;
        if slopes {
            work.slopes.fill(Interval::point(0.0));
        }
        for condition in &self.conditions {
            self.condition(condition, slopes, work);
        }
    }

    fn possible(&self, work: &EnclosureStorage) -> bool {
        work.possible
    }

    fn values<'a>(&self, work: &'a EnclosureStorage) -> &'a [Interval] {
        &work.values
    }

    fn slopes<'a>(&self, work: &'a EnclosureStorage) -> &'a [Interval] {
        &work.slopes
    }
}

impl Enclosure {
    fn condition(&self, condition: &Condition, slopes: bool, work: &mut EnclosureStorage) {
        let inverse = Interval::point(self.inverse_length);
        let EnclosureStorage {
            placement,
            joints,
            values,
            slopes: entries,
            possible,
        } = work;
        let poses = condition.slots.map(|slot| *placement.pose(slot));
        let [a, b] = &poses;
        let gap = (b.position - a.position).times(inverse);
        let first = condition.row;
        let mut row = first;
        let mut put = |value: Interval| {
            values[row] = value;
            row += 1;
        };
        // axes of the two sides that coincide, and those that are perpendicular
        let mut same: &[usize] = &[];
        let (mut points, mut crossed, mut offsets, mut length) = (false, false, 0..0, None);
        match &condition.what {
            What::Closure(kind, constant, extension) => {
                let conditions = kind.conditions();
                points = conditions.origins;
                crossed = conditions.axes == AxisCondition::Perpendicular;
                same = match conditions.axes {
                    AxisCondition::Aligned => &[2],
                    AxisCondition::Oriented => &[0, 2],
                    _ => same,
                };
                offsets = conditions.offsets;
                length = (kind.has_length())
                    .then(|| ((*constant + extension.at(joints)) * inverse, extension));
            }
            What::Orientation(_) => same = &[0, 2],
            What::Coordinate(..) => {}
            What::Relation(relation, inverse) => {
                let inverse = Interval::point(*inverse);
                put(relation.at(joints) * inverse);
                if slopes {
                    for joint in relation.joints.iter() {
                        if let Ok(column) = self.unknowns.binary_search(joint) {
                            let scale = Interval::point(self.scales[column]);
                            entries[column * self.rows + first] +=
                                relation.slope(joints, *joint) * scale * inverse;
                        }
                    }
                }
                return;
            }
        }
        if points {
            gap.0.iter().for_each(|x| put(*x));
        }
        let wanted = match &condition.what {
            What::Orientation(wanted) => wanted,
            _ => &a.rotation,
        };
        for &axis in same {
            (b.rotation.0[axis] - wanted.0[axis])
                .0
                .iter()
                .for_each(|x| put(*x));
        }
        if crossed {
            put(a.rotation.0[2].dot(&b.rotation.0[2]));
        }
        for axis in offsets.clone() {
            put(a.rotation.0[axis].dot(&gap));
        }
        if let Some((length, _)) = &length {
            let squares = gap.0.map(square);
            let half = Interval::point(0.5);
            put((squares[0] + squares[1] + squares[2] - square(*length)) * half);
        }
        let mut turning = None;
        if let What::Coordinate(coordinate, value) = &condition.what {
            match coordinate.is_angle() {
                false => put((coordinate.of(b) - *value) * inverse),
                true => {
                    let (gap, slope) = coordinate.entire_row(b, *value);
                    let along = coordinate.along(&b.rotation, *value);
                    *possible &= along.is_none_or(|x| x.high > 0.0);
                    put(gap);
                    turning = Some(slope);
                }
            }
        }
        if !slopes {
            return;
        }
        for (side, mover, column) in &condition.movers {
            let sign = Interval::point(if *side == 0 { -1.0 } else { 1.0 });
            let (own, other) = (&poses[*side], &poses[1 - *side]);
            let point = if offsets.is_empty() { own } else { b };
            let (omega, v) = placement.twist(mover, &point.position);
            let v = v.times(inverse * sign);
            let mut row = column * self.rows + first;
            let mut add = |slope: Interval| {
                entries[row] += slope;
                row += 1;
            };
            if points {
                v.0.iter().for_each(|x| add(*x));
            }
            for &axis in same {
                let change = omega.cross(&own.rotation.0[axis]).times(sign);
                change.0.iter().for_each(|x| add(*x));
            }
            if crossed {
                add(omega.cross(&own.rotation.0[2]).dot(&other.rotation.0[2]));
            }
            for axis in offsets.clone() {
                add(a.rotation.0[axis].dot(&v));
            }
            if length.is_some() {
                add(gap.dot(&v));
            }
            match (&condition.what, &turning) {
                (_, Some(slope)) => add(slope.dot(&omega)),
                (What::Coordinate(coordinate, _), None) => add(v.0[*coordinate as usize]),
                _ => {}
            }
        }
        if let Some((length, extension)) = &length {
            for (joint, factor) in &extension.0 {
                if let Ok(column) = self.unknowns.binary_search(joint) {
                    let scale = Interval::point(self.scales[column]);
                    entries[column * self.rows + first] -= *length * *factor * scale * inverse;
                }
            }
        }
    }
}
