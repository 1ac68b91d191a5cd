//! Quantities of a moving mechanism: expressions over joints, coordinates of points, rates and forces.

mod words;

use std::f64::consts::FRAC_PI_2;

use thiserror::Error;

use super::value::split_at_commas;
use super::{ClosureKind, Frame, Mechanism, Point, PointError, PoseCoordinate};
use crate::algebra::{Expression, LARGEST, MeasureError, ParseError, SiUnit};
use crate::description::nearest;
use crate::number::Interval;

pub use words::{Carrier, Effort, Energy, Figure, Order, ScrewPart, Worker};

/// A quantity with its unit, which is known before it is evaluated anywhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// Its name.
    pub name: String,
    /// Its value in SI units and rad.
    pub expression: Expression<Measured>,
    /// Its unit; [`SiUnit::ONE`] if it has none, or where a parameter without unit or use hides it.
    pub unit: SiUnit,
}

/// Meaning of a name in a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measured {
    /// The parameter of that index.
    Parameter(usize),
    /// The variable of the joint of that index, or its rate.
    Joint(usize, Order),
    /// A coordinate of a point, or of the orientation of its frame, in ground, or its rate.
    Place(Point, PoseCoordinate, Order),
    /// The size of the velocity or acceleration of a point.
    Size(Point, Order),
    /// The curvature of the path of a point.
    Curvature(Point),
    /// A number of the instant screw of the body that carries a frame.
    Screw(Frame, ScrewPart),
    /// The force or moment that holds a joint.
    Force(usize),
    /// The force or moment that holds a coordinate of a platform.
    PlatformForce(usize, PoseCoordinate),
    /// The least transmission angle: of all loops, or of that of a closure.
    Transmission(Option<usize>),
    /// The time since the beginning of a motion, in s.
    Time,
    /// The power of drives or loads.
    Power(Worker),
    /// The work that they have done since the beginning of a motion.
    Work(Worker),
    /// Energy of weights, springs and motion.
    Energy(Energy),
    /// The inertia that a held joint feels where the other held coordinates are at rest.
    Inertia(usize),
    /// The reaction of a joint or a closure, on the body behind it.
    Reaction(Carrier, Effort),
    /// The force that the moving bodies exert on ground, and its moment about the origin of ground.
    Shaking(Effort),
    /// A figure of the Jacobian between inputs and outputs, or of how near a singularity is.
    Figure(Figure),
}

/// Reasons for which a text is not a quantity.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)]
pub enum QuantityError {
    /// It is no expression.
    #[error("{0}")]
    Parse(ParseError),
    /// A name in it stands for nothing.
    #[error("`{name}` is neither a joint, a parameter, a coordinate of a point nor a quantity")]
    Unknown {
        name: String,
        suggestion: Option<String>,
    },
    /// A point in it is wrong.
    #[error("{error}")]
    Point { name: String, error: PointError },
    /// Its units do not fit.
    #[error("{0}")]
    Unit(MeasureError),
}

const TRANSMISSION: &str = "transmission";
const CURVATURE: &str = "curvature";
const SCREW: &str = "screw";
const TIME: &str = "time";
const POWER: &str = "power";
const WORK: &str = "work";
/// The drives, where a parameter has the name of their power or work, and loads together.
const WORKERS: [(&str, Worker); 2] = [("drives", Worker::Drives), ("loads", Worker::Loads)];
const SHAKING: &str = "shaking";

impl Quantity {
    /// An expression as in the file in which names also stand for quantities ([`Measured::read`]). A velocity or an
    /// acceleration alone may be that of a point beside the origin of a frame: `velocity:left+0.5,0.2`.
    ///
    /// # Errors
    /// If it is no expression, a name stands for nothing, or units do not fit.
    pub fn read(mechanism: &Mechanism, name: &str, text: &str) -> Result<Self, QuantityError> {
        let text = text.trim();
        let beside = text.split_once(':').and_then(|(kind, of)| {
            (of.contains('+') && !of.contains('[')).then_some(())?;
            moving(mechanism, kind, of)?.ok()
        });
        let expression = match beside {
            Some(measured) => Expression::name(measured),
            None => {
                let parsed = Expression::parse_quantity(text).map_err(QuantityError::Parse)?;
                let named = parsed.try_resolve(|name, _| Measured::read(mechanism, name));
                named.map_err(|errors| errors.into_iter().next().expect("there is an error"))?
            }
        };
        Quantity::new(mechanism, name, expression).map_err(QuantityError::Unit)
    }

    /// The quantity of an expression.
    ///
    /// # Errors
    /// If units do not fit.
    pub fn new(
        mechanism: &Mechanism,
        name: &str,
        expression: Expression<Measured>,
    ) -> Result<Self, MeasureError> {
        let unit = expression.unit(&|of| of.unit(mechanism))?;
        // a parameter without unit has that of its use, where the units fit then
        let in_use = |of: &Measured| match *of {
            Measured::Parameter(parameter) => mechanism.measure_in_use(parameter).si_unit(),
            _ => of.unit(mechanism),
        };
        let unit = expression.unit(&in_use).ok().flatten().or(unit);
        Ok(Quantity {
            name: name.trim().to_owned(),
            expression,
            unit: unit.unwrap_or(SiUnit::ONE),
        })
    }

    /// Meanings of its names.
    pub fn measured(&self) -> impl Iterator<Item = &Measured> {
        self.expression.names().map(|(measured, _)| measured)
    }

    /// The parts of a list between commas outside brackets. A number after a point belongs to its offsets:
    /// `velocity:left+0.5,0.2, transmission` are two.
    pub fn split(list: &str) -> Vec<String> {
        let mut parts: Vec<String> = Vec::new();
        for part in split_at_commas(list).into_iter().map(str::trim) {
            match parts.last_mut() {
                Some(last) if last.contains('+') && part.parse::<f64>().is_ok() => {
                    *last += &format!(",{part}");
                }
                _ => parts.push(part.to_owned()),
            }
        }
        parts.retain(|part| !part.is_empty());
        parts
    }
}

impl Measured {
    /// Resolves a name: a joint, a parameter, a coordinate of a point, `left.x`, `top.yaw` or
    /// `[left+0.5,0.2].y`, of the only platform also by its word alone; a rate, `velocity:l1`, `velocity:top.x`,
    /// `acceleration:left`; the curvature of a path, `curvature:left`; the instant screw of a body, `screw:top.x`, `screw:top.dx`,
    /// `screw:top.pitch`; a force, `force:l1`; `transmission`, or `transmission:B` of the loop of closure B; a
    /// [`Figure`]; `power` and `work` of the drives, `power:loads` and `work:spring` of loads.
    ///
    /// # Errors
    /// If it stands for nothing.
    pub fn read(mechanism: &Mechanism, name: &str) -> Result<Self, QuantityError> {
        let parameters = mechanism.parameters();
        if let Some(parameter) = parameters.iter().position(|known| *known.name == *name) {
            return Ok(Measured::Parameter(parameter));
        }
        if let Some(joint) = mechanism.joint(name) {
            return Ok(Measured::Joint(joint, Order::Value));
        }
        if let Some(figure) = Figure::from_word(name) {
            return Ok(Measured::Figure(figure));
        }
        if name == TRANSMISSION {
            return Ok(Measured::Transmission(None));
        }
        match (name, Energy::from_word(name), Effort::of(name)) {
            (TIME, ..) => return Ok(Measured::Time),
            (POWER, ..) => return Ok(Measured::Power(Worker::Drives)),
            (WORK, ..) => return Ok(Measured::Work(Worker::Drives)),
            (_, Some(energy), _) => return Ok(Measured::Energy(energy)),
            (.., (SHAKING, part)) => return Ok(Measured::Shaking(part)),
            _ => {}
        }
        if let ([_], Some(coordinate)) = (mechanism.platforms(), PoseCoordinate::from_word(name)) {
            let platform = Frame::Platform { platform: 0 };
            return Ok(Measured::Place(platform.into(), coordinate, Order::Value));
        }
        let unknown = || QuantityError::Unknown {
            name: name.into(),
            suggestion: suggestion(mechanism, name),
        };
        let Some((kind, of)) = name.split_once(':') else {
            // a point alone is no number
            return match coordinate(mechanism, name, Order::Value) {
                Some(Ok(measured)) => Ok(measured),
                Some(Err(error @ PointError::NoFrame(_)))
                    if suggestion(mechanism, name).is_none() =>
                {
                    let name = name.into();
                    Err(QuantityError::Point { name, error })
                }
                _ => Err(unknown()),
            };
        };
        if let Some(measured) = moving(mechanism, kind, of) {
            return measured.map_err(|error| QuantityError::Point {
                name: name.into(),
                error,
            });
        }
        let measured = match kind {
            "force" => {
                let (platform, part) = of.rsplit_once('.').unwrap_or((of, ""));
                let joint = mechanism.joint(of).map(Measured::Force);
                let mut closures = mechanism.closures().iter();
                let rod =
                    closures.position(|rod| rod.name == of && rod.kind == ClosureKind::Distance);
                let rod = rod.map(|rod| Measured::Reaction(Carrier::Closure(rod), Effort::Axial));
                joint.or(rod).or_else(|| {
                    let platform = mechanism.platform(platform)?;
                    let coordinate = PoseCoordinate::from_word(part)?;
                    Some(Measured::PlatformForce(platform, coordinate))
                })
            }
            "inertia" => mechanism.joint(of).map(Measured::Inertia),
            POWER | WORK => {
                let load = mechanism.loads().names().position(|name| name == of);
                let all = WORKERS.iter().find(|(name, _)| *name == of);
                let worker = load.map(Worker::Load).or(all.map(|(_, worker)| *worker));
                worker.map(match kind {
                    POWER => Measured::Power,
                    _ => Measured::Work,
                })
            }
            "reaction" => {
                let (of, part) = Effort::of(of);
                let joint = mechanism.joint(of).map(Carrier::Joint);
                let closures = mechanism.closures();
                let carrier = joint.or_else(|| {
                    let closure = closures.iter().position(|closure| closure.name == of);
                    closure.map(Carrier::Closure)
                });
                carrier.map(|carrier| Measured::Reaction(carrier, part))
            }
            TRANSMISSION => {
                let closure = mechanism
                    .closures()
                    .iter()
                    .position(|closure| closure.name == of);
                closure.map(|closure| Measured::Transmission(Some(closure)))
            }
            _ => None,
        };
        measured.ok_or_else(unknown)
    }

    /// Its unit, if it has one: parameters may have none.
    pub fn unit(&self, mechanism: &Mechanism) -> Option<SiUnit> {
        let turns = |joint: usize| mechanism.joints()[joint].kind.is_angle();
        Some(match *self {
            Measured::Parameter(parameter) => {
                return mechanism.parameters()[parameter].measure.si_unit();
            }
            Measured::Joint(joint, order) => order.of(SiUnit::of_coordinate(turns(joint))),
            Measured::Place(_, c, order) => order.of(SiUnit::of_coordinate(c.is_angle())),
            Measured::Size(_, order) => order.of(SiUnit::METRE),
            Measured::Curvature(_) => SiUnit::PER_METRE,
            Measured::Screw(_, part) => part.unit(),
            Measured::Force(joint) => SiUnit::of_effort(turns(joint)),
            Measured::PlatformForce(_, c) => SiUnit::of_effort(c.is_angle()),
            Measured::Time => SiUnit::SECOND,
            Measured::Power(_) => SiUnit::WATT,
            Measured::Work(_) | Measured::Energy(_) => SiUnit::JOULE,
            Measured::Inertia(joint) => {
                let square = SiUnit::METRE.times(SiUnit::METRE);
                match turns(joint) {
                    true => SiUnit::KILOGRAM.times(square),
                    false => SiUnit::KILOGRAM,
                }
            }
            Measured::Reaction(_, part) | Measured::Shaking(part) => {
                SiUnit::of_effort(part.is_moment())
            }
            Measured::Transmission(_) => SiUnit::RADIAN,
            Measured::Figure(_) => SiUnit::ONE,
        })
    }
}

impl Measured {
    /// Values beyond which it never is, whatever the dimensions.
    pub fn possible(&self) -> Interval {
        let (low, high) = match *self {
            Measured::Transmission(_) => (0.0, FRAC_PI_2),
            Measured::Figure(Figure::Condition) => (1.0, LARGEST),
            Measured::Figure(Figure::Determinant) => (-LARGEST, LARGEST),
            Measured::Figure(_) | Measured::Size(..) | Measured::Curvature(_) | Measured::Time => {
                (0.0, LARGEST)
            }
            _ => (-LARGEST, LARGEST),
        };
        Interval { low, high }
    }
}

/// The point of a name, with or without brackets.
fn point(mechanism: &Mechanism, name: &str) -> Result<Point, PointError> {
    let inside = name
        .strip_prefix('[')
        .and_then(|rest| rest.strip_suffix(']'));
    Point::read(mechanism, inside.unwrap_or(name))
}

/// The coordinate of a name that ends as one.
fn coordinate(
    mechanism: &Mechanism,
    name: &str,
    order: Order,
) -> Option<Result<Measured, PointError>> {
    let (of, word) = name.rsplit_once('.')?;
    let coordinate = PoseCoordinate::from_word(word)?;
    Some(point(mechanism, of).map(|point| Measured::Place(point, coordinate, order)))
}

/// Resolves a rate or a curvature of a kind, of a joint, a coordinate or a point.
fn moving(mechanism: &Mechanism, kind: &str, name: &str) -> Option<Result<Measured, PointError>> {
    if kind == CURVATURE {
        return Some(point(mechanism, name).map(Measured::Curvature));
    }
    if kind == SCREW {
        let (of, word) = name.rsplit_once('.')?;
        let part = ScrewPart::from_word(word)?;
        return Some(point(mechanism, of).map(|point| Measured::Screw(point.frame, part)));
    }
    let order = Order::of_kind(kind)?;
    if let Some(joint) = mechanism.joint(name) {
        return Some(Ok(Measured::Joint(joint, order)));
    }
    Some(match coordinate(mechanism, name, order) {
        Some(Ok(coordinate)) => Ok(coordinate),
        _ => point(mechanism, name).map(|point| Measured::Size(point, order)),
    })
}

fn suggestion(mechanism: &Mechanism, name: &str) -> Option<String> {
    let mut known: Vec<String> = mechanism
        .parameters()
        .iter()
        .map(|p| p.name.to_string())
        .collect();
    known.extend([TRANSMISSION, TIME, POWER, WORK, SHAKING].map(str::to_owned));
    let loads = || {
        mechanism
            .loads()
            .names()
            .chain(WORKERS.map(|(name, _)| name))
    };
    known.extend(
        [POWER, WORK]
            .into_iter()
            .flat_map(|kind| loads().map(move |of| format!("{kind}:{of}"))),
    );
    known.extend(Energy::ALL.map(|energy| energy.word().to_owned()));
    known.extend(Figure::ALL.map(|figure| figure.word().to_owned()));
    for joint in mechanism.joints() {
        let kinds = [
            "",
            "velocity:",
            "acceleration:",
            "force:",
            "reaction:",
            "inertia:",
        ];
        known.extend(kinds.map(|kind| format!("{kind}{}", joint.name)));
    }
    for closure in mechanism.closures() {
        known.push(format!("{TRANSMISSION}:{}", closure.name));
    }
    for frame in mechanism.frames() {
        let frame = mechanism.frame_name(frame);
        known.extend(PoseCoordinate::ALL.map(|c| format!("{frame}.{}", c.word())));
        known.extend(["velocity", "acceleration", CURVATURE].map(|kind| format!("{kind}:{frame}")));
        known.extend(ScrewPart::ALL.map(|part| format!("{SCREW}:{frame}.{}", part.word())));
    }
    nearest(name, known.iter().map(String::as_str)).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_cut_at_commas_outside_brackets_and_points() {
        let split = |text| Quantity::split(text);
        assert_eq!(
            split("transmission, velocity:left+1,0.5 ,atan2(a, b),[left+1,2].x"),
            [
                "transmission",
                "velocity:left+1,0.5",
                "atan2(a, b)",
                "[left+1,2].x"
            ]
        );
        assert_eq!(split("a"), ["a"]);
        assert_eq!(split(""), [""; 0]);
    }
}
