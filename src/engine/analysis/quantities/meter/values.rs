//! Values of names in quantities at one configuration.

use super::Meter;
use super::probe::{FoundHere, Probe};
use crate::geometry::Vector3;
use crate::linear::Factorable;
use crate::mechanism::{
    Carrier, Configuration, Effort, Energy, Figure, Measured, Order, Point, PoseCoordinate,
    ScrewPart,
};
use crate::number::Number;
use crate::number::tolerance::{SOLVED, STILL};
use crate::system::{Balance, Coordinate};

/// A configuration with the known rates and figures.
pub(super) struct KnownHere<'a, T: Factorable> {
    pub at: &'a Configuration<T>,
    pub found: &'a FoundHere<T>,
    pub figures: &'a [(Figure, Option<T>)],
    /// The pace relative to that of `found`, and its change per s.
    pace: [T; 2],
    /// The time in s.
    time: T,
    /// The works that are told.
    works: &'a [T],
    balance: Option<&'a Balance<T>>,
    shaking: [Vector3<T>; 2],
    /// The largest rate and acceleration, in rad and characteristic lengths.
    largest: [T; 2],
}

impl<'a, T: Factorable> KnownHere<'a, T> {
    /// The configuration with its motion by the law, and with the motion of `found`.
    pub fn both(
        at: &'a Configuration<T>,
        found: &'a FoundHere<T>,
        figures: &'a [(Figure, Option<T>)],
        (pace, time, works): ([T; 2], T, &'a [T]),
        probe: &'a Probe<T>,
    ) -> [Self; 2]
    where
        T: Factorable,
    {
        let largest = [0, 1].map(|order| largest(&found.rates[order]));
        let shaking = probe.shaking();
        [pace, [T::one(), T::zero()]].map(|pace| {
            let [rate, change] = pace;
            let accelerated = largest[1] * rate * rate + largest[0] * change.abs();
            KnownHere {
                at,
                found,
                figures,
                pace,
                time,
                works,
                balance: probe.balance.as_ref(),
                shaking,
                largest: [largest[0] * rate.abs(), accelerated],
            }
        })
    }

    /// A velocity at the pace.
    fn fast(&self, velocity: T) -> T {
        velocity * self.pace[0]
    }

    /// An acceleration at the pace: r² a + c v.
    fn changing(&self, velocity: T, acceleration: T) -> T {
        let [rate, change] = self.pace;
        acceleration * rate * rate + velocity * change
    }

    fn tells(&self, order: Order) -> bool {
        self.found.moves || order == Order::Value
    }

    /// Position, velocity or acceleration of the point of that number.
    fn moved(&self, i: usize, order: Order) -> Option<Vector3<T>> {
        let found = |order: Order| self.found.points[order as usize].get(i).copied();
        Some(match order {
            Order::Value => found(order)?,
            Order::Velocity => found(order)?.map(|v| self.fast(v)),
            Order::Acceleration => {
                let (v, a) = (found(Order::Velocity)?, found(order)?);
                Vector3(std::array::from_fn(|k| self.changing(v.0[k], a.0[k])))
            }
        })
    }
}

/// A part of a force and a moment.
fn part_of<T: Number>(part: Effort, [force, moment]: &[Vector3<T>; 2]) -> T {
    match part {
        Effort::Force => force.norm(),
        Effort::Moment => moment.norm(),
        Effort::Axial => T::from_f64(f64::NAN),
        part if part.is_moment() => moment.0[part as usize - 3],
        part => force.0[part as usize],
    }
}

/// The largest size of some numbers, but for those that are not known.
fn largest<T: Number>(of: &[T]) -> T {
    let sizes = of.iter().filter(|x| x.is_finite()).map(|x| x.abs());
    sizes.fold(T::zero(), T::greater)
}

impl Meter<'_> {
    /// The value of a name, not a number where it is not determined, and how far it may be off; with the number of the
    /// point or of the work, if it is of one.
    pub(super) fn value<T: Factorable>(
        &self,
        here: &KnownHere<T>,
        of: &Measured,
        i: usize,
    ) -> [T; 2] {
        let value = (self.known(here, of, i)).unwrap_or_else(|| T::from_f64(f64::NAN));
        [value, self.off(here, of, i, value)]
    }

    /// Uncertainty of the value of a name: configurations are closed to 1e-12.
    fn off<T: Factorable>(&self, here: &KnownHere<T>, of: &Measured, i: usize, value: T) -> T {
        let [rate, change] = here.largest;
        let most = |order: Order| match order {
            Order::Value => T::one(),
            Order::Velocity => rate,
            Order::Acceleration => change.greater(rate * rate),
        };
        let mechanism = self.of.question.mechanism();
        let length = mechanism.characteristic_length();
        let scale = |is_angle: bool| if is_angle { 1.0 } else { length };
        let size = match *of {
            Measured::Parameter(_) | Measured::Time => T::zero(),
            Measured::Joint(joint, order) => {
                most(order).scale(mechanism.dimensions().joint_scales[joint])
            }
            Measured::Place(_, c, order) => most(order).scale(scale(c.is_angle())),
            Measured::Size(_, order) => most(order).scale(length),
            Measured::Transmission(_) => T::from_f64(10.0),
            Measured::Force(_) | Measured::PlatformForce(..) => {
                here.balance.map_or(T::zero(), |of| largest(&of.forces))
            }
            Measured::Reaction(_, part) | Measured::Shaking(part) => {
                let size = here.balance.map_or(T::zero(), |of| of.size);
                size.scale(if part.is_moment() { length } else { 1.0 })
            }
            Measured::Energy(_) => {
                let size = here.balance.map_or(T::zero(), |of| of.size);
                size.scale(length)
            }
            Measured::Power(_) => {
                let size = here.balance.map_or(T::zero(), |of| of.size);
                (size * rate).scale(length)
            }
            Measured::Inertia(_) | Measured::Work(_) if !value.is_finite() => T::zero(),
            Measured::Inertia(_) | Measured::Work(_) => value.abs(),
            // κ = |v × a| / |v|³ by δv and δa
            Measured::Curvature(point) => {
                let [v, a] = [Order::Velocity, Order::Acceleration].map(|order| {
                    let vector = self.vector(here, point, i, order);
                    vector.map_or(T::zero(), |v| v.norm())
                });
                let both = change.greater(rate * rate) + rate * a / v;
                both.scale(length) / (v * v)
            }
            Measured::Screw(_, part) => {
                let turn = self.twist(here, i).map(|[turn, _]| turn.norm());
                let off = most(Order::Velocity) / turn.unwrap_or(T::one());
                let far = value.abs().greater(T::from_f64(length));
                match part {
                    ScrewPart::Dx | ScrewPart::Dy | ScrewPart::Dz => off,
                    _ => off * far,
                }
            }
            Measured::Figure(_) if !value.is_finite() => T::zero(),
            Measured::Figure(_) => value.abs(),
        };
        size.scale(SOLVED)
    }

    fn known<T: Factorable>(&self, here: &KnownHere<T>, of: &Measured, i: usize) -> Option<T> {
        let mechanism = self.of.question.mechanism();
        match *of {
            Measured::Time => Some(here.time),
            Measured::Parameter(parameter) => {
                Some(T::from_f64(mechanism.parameters()[parameter].value))
            }
            Measured::Joint(joint, Order::Value) => Some(here.at.joints[joint]),
            Measured::Joint(joint, order) => {
                let known = |k: usize| here.found.rates[k].get(joint).filter(|_| here.found.moves);
                let rate = match order {
                    Order::Acceleration => here.changing(*known(0)?, *known(1)?),
                    _ => here.fast(*known(0)?),
                };
                Some(rate.scale(mechanism.dimensions().joint_scales[joint]))
            }
            Measured::Place(point, coordinate, order) => {
                let loose = order > Order::Value
                    && (coordinate.is_angle() || !point.is_origin())
                    && self.loose.contains(&point.frame);
                let known = here.tells(order) && !loose;
                known.then(|| self.coordinate(here, i, coordinate, order))?
            }
            Measured::Size(point, order) => Some(self.vector(here, point, i, order)?.norm()),
            // κ = |v × a| / |v|³
            Measured::Curvature(point) => {
                let velocity = self.vector(here, point, i, Order::Velocity)?;
                let size = velocity.norm();
                if !(self.off(here, &Measured::Size(point, Order::Velocity), i, size)).less(size) {
                    return None;
                }
                let across = velocity.cross(&self.vector(here, point, i, Order::Acceleration)?);
                Some(across.norm() / size.powi(3))
            }
            Measured::Screw(_, part) => {
                let [turn, shift] = self.twist(here, i)?;
                let size = turn.norm();
                // what hardly turns beside its fastest joints is shifted
                if !here.largest[0].scale(STILL).less(size) {
                    return None;
                }
                let square = size * size;
                Some(match part {
                    ScrewPart::Pitch => turn.dot(&shift) / square,
                    ScrewPart::Dx | ScrewPart::Dy | ScrewPart::Dz => {
                        turn.0[part as usize - ScrewPart::Dx as usize] / size
                    }
                    _ => turn.cross(&shift).0[part as usize] / square,
                })
            }
            Measured::Force(joint) => {
                self.driving(here, Coordinate::Joint(joint), &here.balance?.forces)
            }
            Measured::PlatformForce(platform, c) => {
                self.driving(here, Coordinate::Pose(platform, c), &here.balance?.forces)
            }
            Measured::Power(worker) => here.balance.map(|of| of.power_of(worker)),
            Measured::Work(_) => here.works.get(i).copied(),
            Measured::Energy(energy) => {
                let acting = &here.balance?.acting;
                Some(match energy {
                    Energy::Total => acting.kinetic + acting.potential,
                    Energy::Kinetic => acting.kinetic,
                    Energy::Potential => acting.potential,
                })
            }
            Measured::Inertia(joint) => {
                self.driving(here, Coordinate::Joint(joint), &here.balance?.inertias)
            }
            Measured::Reaction(of, part) => self.reaction(here, of, part),
            Measured::Shaking(part) => Some(part_of(part, &here.shaking)),
            Measured::Transmission(closure) => {
                let name = closure.map(|closure| &*mechanism.closures()[closure].name);
                let loops = self.plan.transmission.as_ref()?.loops();
                let loops = loops.zip(&here.found.transmission);
                let of_it = loops.filter(|(closure, _)| name.is_none_or(|name| name == *closure));
                let angles = of_it.map(|(_, angle)| *angle);
                angles.filter(|angle| angle.is_finite()).reduce(T::lesser)
            }
            Measured::Figure(figure) => {
                let mut known = here.figures.iter();
                known.find(|(of, _)| *of == figure)?.1
            }
        }
    }

    /// Place, velocity or acceleration of a point, by its number.
    fn vector<T: Factorable>(
        &self,
        here: &KnownHere<T>,
        point: Point,
        i: usize,
        order: Order,
    ) -> Option<Vector3<T>> {
        let loose = order > Order::Value && !point.is_origin() && self.loose.contains(&point.frame);
        let known = here.tells(order) && !loose;
        known.then(|| here.moved(i, order))?
    }

    /// The rates of a body: its turning, and its velocity at the origin of ground, from points on the axes of a frame,
    /// ω = ½ Σ eₖ × (ω × eₖ).
    fn twist<T: Factorable>(&self, here: &KnownHere<T>, i: usize) -> Option<[Vector3<T>; 2]> {
        let mechanism = self.of.question.mechanism();
        if !here.tells(Order::Velocity) || self.loose.contains(&self.plan.points[i].frame) {
            return None;
        }
        let all = |order: Order| {
            let points = (0..4).map(|k| here.moved(i + k, order));
            points.collect::<Option<Vec<Vector3<T>>>>()
        };
        let (place, velocity) = (all(Order::Value)?, all(Order::Velocity)?);
        let square = mechanism.characteristic_length().powi(2);
        let turn = (1..4).fold(Vector3::zero(), |sum, k| {
            sum + (place[k] - place[0]).cross(&(velocity[k] - velocity[0]))
        });
        let turn = turn.map(|x| x.scale(0.5 / square));
        let shift = velocity[0] - turn.cross(&mechanism.to_ground(place[0]));
        Some([turn, shift])
    }

    /// A coordinate of the point of that number, or of the orientation of its frame.
    fn coordinate<T: Factorable>(
        &self,
        here: &KnownHere<T>,
        i: usize,
        c: PoseCoordinate,
        order: Order,
    ) -> Option<T> {
        if !c.is_angle() {
            let of = here.moved(i, order)?;
            let mechanism = self.of.question.mechanism();
            return Some(match order {
                Order::Value => mechanism.to_ground(of).0[c as usize],
                _ => of.0[c as usize],
            });
        }
        let found = |order: Order| {
            let mut angles = self.plan.angles.iter();
            let place = angles.position(|of| *of == (i, c, order))?;
            here.found.angles.get(place).copied()
        };
        Some(match order {
            Order::Value => found(order)?,
            Order::Velocity => here.fast(found(order)?),
            Order::Acceleration => here.changing(found(Order::Velocity)?, found(order)?),
        })
    }

    /// The part of a held coordinate, of those in their order.
    fn driving<T: Factorable>(&self, here: &KnownHere<T>, of: Coordinate, all: &[T]) -> Option<T> {
        let place = self.coordinates.iter().position(|known| *known == of)?;
        let own = *all.get(place)?;
        (here.found.moves && own.is_finite()).then_some(own)
    }

    /// A part of a reaction that equilibrium determines. The size of a force across the plane of a planar mechanism is that
    /// in the plane.
    fn reaction<T: Factorable>(&self, here: &KnownHere<T>, of: Carrier, part: Effort) -> Option<T> {
        let place = here.balance?.place(of)?;
        let unique = self.determined.get(place)?;
        let carried = here.balance?.reactions.get(place)?;
        let planar = self.planar;
        let known = |from: usize| {
            let parts = from..from + 3;
            parts.clone().all(|i| unique[i]) || planar && parts.clone().any(|i| unique[i])
        };
        let determined = match part {
            Effort::Force | Effort::Axial => known(0),
            Effort::Moment => known(3),
            part => unique[part as usize],
        };
        let value = match part {
            Effort::Axial => carried.axial(),
            part => part_of(part, &[carried.force, carried.moment]),
        };
        (determined && here.found.moves && value.is_finite()).then_some(value)
    }
}
