use super::Vector3;
use crate::linear::RANK_TOLERANCE;
use crate::number::real;

/// A directed line: a joint axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// A point on it, in m.
    pub point: Vector3<f64>,
    /// Its direction, of length one.
    pub direction: Vector3<f64>,
}

/// The relative position of two directed lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Relation {
    /// They do not meet and are not parallel: one common normal.
    Skew,
    /// They meet in one point.
    Intersecting,
    /// They have one direction and do not meet: infinitely many common normals.
    Parallel,
    /// They have opposite directions and do not meet.
    AntiParallel,
    /// They are one line with one direction.
    Coincident,
    /// They are one line with opposite directions.
    AntiCoincident,
    /// They are parallel but for the digits of a file: their common normal is far away, and none is used.
    NearlyParallel,
}

impl Relation {
    /// True if the directions are equal or opposite; the common normal may then lie anywhere along the lines.
    pub fn is_parallel(self) -> bool {
        !matches!(
            self,
            Relation::Skew | Relation::Intersecting | Relation::NearlyParallel
        )
    }

    /// True if the lines meet, so that the common normal has length zero.
    pub fn meets(self) -> bool {
        !matches!(
            self,
            Relation::Skew | Relation::Parallel | Relation::AntiParallel | Relation::NearlyParallel
        )
    }
}

/// The common normal of two directed lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommonNormal {
    /// The relative position, decided at the rank tolerance.
    pub relation: Relation,
    /// Angle between the directions in rad, in [0, π].
    pub angle: f64,
    /// Shortest distance in m, not negative.
    pub distance: f64,
    /// Unit vector from the first line to the second along the normal; z₁ × z₂ where the lines
    /// meet in a point, `None` where they are one line.
    pub direction: Option<Vector3<f64>>,
    /// The foot of the normal on each line. For parallel lines, the normal at the first line's point.
    pub feet: [Vector3<f64>; 2],
}

impl Line {
    /// The line through a point along a vector; `None` if the vector has no direction.
    pub fn new(point: Vector3<f64>, along: Vector3<f64>) -> Option<Self> {
        // scaled first, so that squares neither overflow nor vanish
        let largest = along.0.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let finite = (point.0.iter().chain(&along.0)).all(|x| x.is_finite());
        if !finite || largest == 0.0 {
            return None;
        }
        let along = along.map(|x| x / largest);
        let direction = along.times(1.0 / along.norm());
        Some(Line { point, direction })
    }

    /// The line through two points, from the first to the second; `None` if they coincide.
    pub fn through(first: Vector3<f64>, second: Vector3<f64>) -> Option<Self> {
        Line::new(first, second - first)
    }

    /// The point of the line nearest to a point.
    pub fn foot(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let along = (*point - self.point).dot(&self.direction);
        self.point + self.direction.times(along)
    }

    /// Distance of a point from the line, in m.
    pub fn distance(&self, point: &Vector3<f64>) -> f64 {
        (*point - self.foot(point)).norm()
    }

    /// The common normal from this line to another.
    ///
    /// With w = p₂ − p₁ and n = z₁ × z₂: the feet lie at t₁ = (w × z₂)·n/n² and t₂ = (w × z₁)·n/n² along the lines, the
    /// distance is |w·n|/|n|. Lines are parallel where |n| = sin ∠ is within [`RANK_TOLERANCE`], and meet where their
    /// distance is within that times `length` (m), a length that is typical of the mechanism.
    pub fn common_normal(&self, other: &Line, length: f64) -> CommonNormal {
        let (z1, z2) = (self.direction, other.direction);
        let between = other.point - self.point;
        let normal = z1.cross(&z2);
        let (sine, cosine) = (normal.norm(), z1.dot(&z2));
        let angle = real::atan2(sine, cosine);
        if sine <= RANK_TOLERANCE {
            let apart = between - z1.times(between.dot(&z1));
            let distance = apart.norm();
            let meets = distance <= RANK_TOLERANCE * length;
            let relation = match (meets, cosine > 0.0) {
                (false, true) => Relation::Parallel,
                (false, false) => Relation::AntiParallel,
                (true, true) => Relation::Coincident,
                (true, false) => Relation::AntiCoincident,
            };
            return CommonNormal {
                relation,
                angle,
                distance,
                direction: (!meets).then(|| apart.times(1.0 / distance)),
                feet: [self.point, self.point + apart],
            };
        }
        let unit = normal.times(1.0 / sine);
        let along = |z: &Vector3<f64>| between.cross(z).dot(&unit) / sine;
        let signed = between.dot(&unit);
        let meets = signed.abs() <= RANK_TOLERANCE * length;
        CommonNormal {
            relation: match meets {
                true => Relation::Intersecting,
                false => Relation::Skew,
            },
            angle,
            distance: signed.abs(),
            direction: Some(match !meets && signed < 0.0 {
                true => -unit,
                false => unit,
            }),
            feet: [
                self.point + z1.times(along(&z2)),
                other.point + z2.times(along(&z1)),
            ],
        }
    }
}
