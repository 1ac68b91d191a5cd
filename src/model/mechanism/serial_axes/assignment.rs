use super::normal::{Normal, angle_about, link, nearly_parallel, perpendicular, turned};
use super::prismatic;
use super::{DhTable, JointAxis, SerialAxes, TableRow};
use crate::description::Convention;
use crate::geometry::{Line, Pose, Relation, Rotation, Vector3};
use crate::linear::RANK_TOLERANCE;
use crate::number::real;
use crate::number::tolerance::SUMMED;

/// Frames placed on joint axes, and the table read off them.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameAssignment {
    /// The table.
    pub table: DhTable,
    /// The axes as the table has them; those of prismatic joints have a place now.
    pub axes: Vec<Line>,
    /// N₀ … N_n: from the base to axis 1, between consecutive axes, from axis n to the tool.
    pub normals: Vec<Normal>,
    /// True if the table starts in the base frame given.
    pub starts_at_base: bool,
    /// True if the table ends in the tool frame given, without a tip.
    pub ends_at_tool: bool,
    /// Largest angle in rad by which an axis or the tool of the table differs from the one given:
    /// rounding, or the offset of axes taken as parallel or meeting within the tolerance.
    pub turned: f64,
    /// Largest distance in m by which an axis or the tool of the table differs from the one given.
    pub moved: f64,
}

fn without_rounding(x: f64, size: f64) -> f64 {
    if x.abs() <= SUMMED * size { 0.0 } else { x }
}

impl SerialAxes {
    /// Places the frames and reads the table off them. Any number of axes, also none.
    pub fn assign(&self, convention: Convention) -> FrameAssignment {
        let length = self.length();
        let mut axes: Vec<Line> = self.joints.iter().map(|joint| joint.line).collect();
        let start = self.base.map_or(Vector3::zero(), |base| base.position);
        let start = prismatic::place(self, &mut axes, 0, start, length).unwrap_or(start);
        let first = self.first(convention, &mut axes, start, length);
        let starts_at_base = first.relation.is_some();
        let mut normals = vec![first];
        for k in 0..axes.len() {
            if !self.joints[k].is_prismatic() {
                let (_, unmoved) = self.unmoved(k, &normals[k], &axes[k]);
                prismatic::place(self, &mut axes, k + 1, unmoved, length);
            }
            let normal = match axes.get(k + 1).copied() {
                Some(_) => self.between(k, &normals[k], &mut axes, length),
                None => self.last(convention, &normals[k], &axes[k], length),
            };
            normals.push(normal);
        }
        if !starts_at_base && let [first, second, ..] = &mut normals[..] {
            // frame 0 is frame 1 where the variable is zero
            let (turn, slide) = self.joints[0].home_motion();
            let z = axes[0].direction;
            let x = turned(&second.x, &z, -turn);
            *first = Normal::nothing(x, z, second.feet[0] - z.times(slide));
        }
        self.read_off(convention, axes, normals, starts_at_base, length)
    }

    /// Normal from the base to the first axis; without a relation where frame 0 is free. Then `x` and the
    /// place are the reference of the choices.
    fn first(
        &self,
        convention: Convention,
        axes: &mut [Line],
        start: Vector3<f64>,
        length: f64,
    ) -> Normal {
        let base = self.base.unwrap_or_else(Pose::identity);
        let [x, _, z] = base.rotation.0;
        let origin = base.position;
        let Some(axis) = axes.first_mut() else {
            return Normal {
                relation: Some(Relation::Coincident),
                ..Normal::nothing(x, z, origin)
            };
        };
        if self.base.is_some()
            && let Some(normal) = link(&x, &z, &origin, axis, length)
            && (convention == Convention::Modified || normal.relation == Some(Relation::Coincident))
        {
            axis.direction = normal.z[1];
            axis.point = normal.feet[1];
            return normal;
        }
        let x = perpendicular(&axis.direction, [Vector3::unit(0), Vector3::unit(1)]);
        Normal::nothing(x, axis.direction, axis.foot(&start))
    }

    /// Direction x and foot on axis k that make θ_k = 0 and d_k = 0: those of the last normal, moved on by the joint's
    /// own variable.
    fn unmoved(&self, k: usize, last: &Normal, axis: &Line) -> (Vector3<f64>, Vector3<f64>) {
        let (turn, slide) = self.joints[k].home_motion();
        let x = turned(&last.end(), &axis.direction, turn);
        (x, last.feet[1] + axis.direction.times(slide))
    }

    /// N_k between the axes of index k and k + 1, the second of which is moved to where the relation holds exactly.
    fn between(&self, k: usize, last: &Normal, axes: &mut [Line], length: f64) -> Normal {
        let (axis, next) = (axes[k], axes[k + 1]);
        let (x, start) = self.unmoved(k, last, &axis);
        let common = axis.common_normal(&next, length);
        let z = axis.direction;
        if let Some(normal) = nearly_parallel(x, start, &next, &common, (z, length)) {
            return normal;
        }
        let relation = common.relation;
        // the product of nearly parallel directions is at right angles to them up to rounding divided by its size
        let normal = (common.direction).map(|n| match n.dot(&z) {
            off if off.abs() > SUMMED => perpendicular(&z, [n]),
            _ => n,
        });
        let (x, feet) = match (relation, normal) {
            (Relation::Skew, Some(n)) => (n, common.feet),
            (Relation::Intersecting, Some(n)) => {
                // at a right angle either way along the vector product
                let against = n.dot(&x) < -RANK_TOLERANCE;
                let at = common.feet[0];
                (if against { -n } else { n }, [at, at])
            }
            (_, Some(n)) => (n, [start, start + n.times(common.distance)]),
            (_, None) => (x, [start, start]),
        };
        let direction = match relation {
            Relation::Skew | Relation::Intersecting | Relation::NearlyParallel => next.direction,
            Relation::Parallel | Relation::Coincident => z,
            Relation::AntiParallel | Relation::AntiCoincident => -z,
        };
        axes[k + 1] = Line {
            point: feet[1],
            direction,
        };
        Normal {
            relation: Some(relation),
            angle: common.angle,
            distance: common.distance,
            x,
            z: [z, direction],
            feet,
        }
    }

    /// Normal from the last axis to the tool where a row of the standard convention can lead there.
    fn last(&self, convention: Convention, last: &Normal, axis: &Line, length: f64) -> Normal {
        if let (Convention::Standard, Some(tool)) = (convention, self.tool) {
            let [x, _, z] = tool.rotation.0;
            // from the tool back to the axis the link is as long the other way
            if let Some(back) = link(&-x, &z, &tool.position, axis, length) {
                return Normal {
                    x: -back.x,
                    z: [back.z[1], back.z[0]],
                    feet: [back.feet[1], back.feet[0]],
                    ..back
                };
            }
        }
        let (x, at) = self.unmoved(self.joints.len() - 1, last, axis);
        Normal::nothing(x, axis.direction, at)
    }

    fn read_off(
        &self,
        convention: Convention,
        axes: Vec<Line>,
        normals: Vec<Normal>,
        starts_at_base: bool,
        length: f64,
    ) -> FrameAssignment {
        let row = |(k, joint): (usize, &JointAxis)| {
            let (before, after) = (&normals[k], &normals[k + 1]);
            let z = &axes[k].direction;
            let link = match convention {
                Convention::Modified => before,
                Convention::Standard => after,
            };
            let theta = angle_about(z, &before.end(), &after.x) - joint.turn * joint.home;
            let d = (after.feet[0] - before.feet[1]).dot(z) - joint.slide * joint.home;
            let reach = length + before.feet[1].norm() + after.feet[0].norm();
            TableRow {
                alpha: without_rounding(link.alpha(), 1.0),
                a: without_rounding(link.a().max(0.0), reach),
                d: without_rounding(d, reach),
                theta: wrapped(theta),
                beta: link.beta(),
                turn: joint.turn,
                slide: joint.slide,
                home: joint.home,
            }
        };
        let rows: Vec<TableRow> = self.joints.iter().enumerate().map(row).collect();
        let base = match (self.base, starts_at_base) {
            (Some(base), true) => base,
            _ => normals[0].frame(0),
        };
        let mut table = DhTable {
            convention,
            base,
            rows,
            tip: Pose::identity(),
        };
        let ended = normals.len() > 1 && normals[normals.len() - 1].relation.is_some();
        if let Some(tool) = self.tool
            && !ended
        {
            table.tip = tidy(&(table.tool().inverse() * tool), length);
        }
        let (turned, moved) = self.difference(&table);
        FrameAssignment {
            table,
            axes,
            normals,
            starts_at_base,
            ends_at_tool: ended,
            turned,
            moved,
        }
    }

    /// The largest angle (rad) and distance (m) between the axes and tool given and those of a table with as many rows.
    pub fn difference(&self, table: &DhTable) -> (f64, f64) {
        let made = table.axes();
        let mut turned = 0.0_f64;
        let mut moved = 0.0_f64;
        for (given, made) in self.joints.iter().zip(&made.joints) {
            let (u, v) = (given.line.direction, made.line.direction);
            turned = turned.max(real::atan2(u.cross(&v).norm(), u.dot(&v)));
            if !given.is_prismatic() {
                moved = moved.max(made.line.distance(&given.line.point));
            }
        }
        if let (Some(given), Some(made)) = (self.tool, made.tool) {
            for (u, v) in given.rotation.0.iter().zip(&made.rotation.0) {
                turned = turned.max(real::atan2(u.cross(v).norm(), u.dot(v)));
            }
            moved = moved.max((given.position - made.position).norm());
        }
        (turned, moved)
    }
}

/// An angle in (−π, π], without rounding.
fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let within = angle - TAU * (angle / TAU).round();
    let turn = if within < -PI + SUMMED { TAU } else { 0.0 };
    without_rounding(within + turn, 1.0 + angle.abs())
}

/// A pose whose entries that are zero or one but for rounding are so.
fn tidy(pose: &Pose<f64>, length: f64) -> Pose<f64> {
    let entry = |x: f64| match x {
        _ if (x.abs() - 1.0).abs() <= SUMMED => x.signum(),
        _ => without_rounding(x, 1.0),
    };
    Pose {
        rotation: Rotation(pose.rotation.0.map(|column| column.map(entry))),
        position: pose.position.map(|x| without_rounding(x, length)),
    }
}
