//! Values of quantities over those of the names in them.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::Metered;
use crate::algebra::{Expression, Function, Node, SiUnit};
use crate::analysis::sweep::Law;
use crate::mechanism::{Measured, Order, Quantity};
use crate::number::tolerance::ROUNDING;
use crate::number::{Dual, Number};

/// A name in a quantity, and true if it is read at a constant pace: a quantity that does not depend on the law has a
/// value where the law rests, too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Name {
    pub of: Measured,
    pub geometric: bool,
}

impl Metered<'_> {
    /// The names in the quantities, each once, and the quantities over the numbers of these.
    pub(crate) fn programs(&self) -> (Vec<Name>, Vec<Expression<usize>>) {
        let mut names: Vec<Name> = Vec::new();
        let mut number = |name: Name| {
            let known = names.iter().position(|of| *of == name);
            known.unwrap_or_else(|| {
                names.push(name);
                names.len() - 1
            })
        };
        // of a constant law all are at a constant pace
        let paced = self.schedule.is_some() || self.pace.law != Law::Constant;
        let programs = self.quantities.iter().map(|quantity| {
            let geometric = paced && is_geometric(&quantity.expression);
            let program = (quantity.expression)
                .try_resolve(|&of, _| Ok::<_, ()>(number(Name { of, geometric })));
            program.expect("every name has a number")
        });
        let programs = programs.collect();
        (names, programs)
    }
}

/// True if the law of a motion does not matter to a quantity: velocity ratios, curvatures and what else depends on the
/// curve alone.
///
/// At a pace r times that of a constant law, which grows by c, velocities are r v and accelerations r² a + c v. That
/// the quantity changes with neither r nor c is seen from its derivatives by them at random values of its names: those of
/// an analytic function that vanish there vanish everywhere.
fn is_geometric(expression: &Expression<Measured>) -> bool {
    /// Random draws: more than one, since kinks divide the ranges of names.
    const DRAWS: u64 = 24;
    let mut all: Vec<Measured> = Vec::new();
    for (name, _) in expression.names() {
        if !all.contains(name) {
            all.push(*name);
        }
    }
    let order = |of: &Measured| match of {
        Measured::Joint(_, order) | Measured::Place(_, _, order) | Measured::Size(_, order) => {
            *order
        }
        _ => Order::Value,
    };
    // accelerations with the velocities they are of
    let velocity = |of: &Measured| match *of {
        Measured::Joint(joint, _) => Measured::Joint(joint, Order::Velocity),
        Measured::Place(point, c, _) => Measured::Place(point, c, Order::Velocity),
        of => of,
    };
    if all.iter().all(|of| order(of) == Order::Value) {
        return all
            .iter()
            .any(|of| matches!(of, Measured::Curvature(_) | Measured::Screw(..)));
    }
    // the size of an acceleration changes with more than its own velocity
    if (all.iter()).any(|of| matches!(of, Measured::Size(_, Order::Acceleration))) {
        return false;
    }
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    let mut random = || 2.0 * rng.random::<f64>() - 1.0;
    let mut decided = false;
    for _ in 0..DRAWS {
        let mut values: Vec<(Measured, f64)> = Vec::new();
        for of in all.iter().flat_map(|of| [*of, velocity(of)]) {
            let value = match of {
                Measured::Size(..) => random().abs(),
                _ => random(),
            };
            if values.iter().all(|(known, _)| *known != of) {
                values.push((of, value));
            }
        }
        let value = |of: &Measured| {
            let known = values.iter().find(|(known, _)| known == of);
            known.map_or(0.0, |(_, value)| *value)
        };
        for slope in [
            |order: Order, value: f64, _: f64| f64::from(order as u8) * value,
            |order: Order, _: f64, velocity: f64| match order {
                Order::Acceleration => velocity,
                _ => 0.0,
            },
        ] {
            let along = expression.evaluate(&|of: &Measured| Dual {
                value: value(of),
                slope: slope(order(of), value(of), value(&velocity(of))),
            });
            let Ok(found) = along else { continue };
            // beside what one name alone would change
            let most = all.iter().map(|name| {
                let alone = expression.evaluate(&|of: &Measured| Dual {
                    value: value(of),
                    slope: if of == name { 1.0 } else { 0.0 },
                });
                alone.map_or(0.0, |of| of.slope.abs())
            });
            if found.slope.abs() > ROUNDING * most.fold(0.0, f64::max) {
                return false;
            }
            decided = true;
        }
    }
    decided
}

/// The value of a quantity and how far it may be off, over those of names, as long as it is large beside that.
pub(super) fn estimated<T: Number>(
    program: &Expression<usize>,
    known: &[[T; 2]],
) -> Option<[T; 2]> {
    if let Node::Name(name) = program.node {
        return Some(known[name]);
    }
    let along = program.evaluate(&|&name| {
        let [value, noise] = known[name];
        Dual {
            value,
            slope: noise.scale(UNEVEN[name % 4]),
        }
    });
    let Dual { value, slope } = along.ok()?;
    Some([value, slope])
}

/// Uneven errors of names, so that their differences are off too.
const UNEVEN: [f64; 4] = [1.0, -0.73, 0.87, -0.61];

/// True if a value is large relative to its uncertainty.
#[inline(always)]
pub(super) fn is_clear([value, noise]: [f64; 2]) -> bool {
    4.0 * noise.abs() <= value.abs()
}

/// The value of a quantity, if it has one, and how far it may be off, over values of names that may be. A value that
/// only rounding keeps finite, as that of 1/x where x is nothing but rounding, is none: away from it, it shrinks.
pub(crate) fn evaluated(program: &Expression<usize>, known: &[[f64; 2]]) -> (Option<f64>, f64) {
    match estimated(program, known) {
        Some([value, noise]) if is_name(program) => {
            return (value.is_finite().then_some(value), noise);
        }
        Some(both) if is_clear(both) => return (Some(both[0]), both[1].abs()),
        _ => {}
    }
    let off = |name: usize| UNEVEN[name % 4] * known[name][1];
    let Ok(value) = program.evaluate(&|&name| known[name][0]) else {
        return (None, 0.0);
    };
    let beside = [1.0, -1.0].map(|side| {
        let value = program.evaluate(&|&name| known[name][0] + side * off(name));
        value.ok()
    });
    let shrinks = |of: &Option<f64>| of.is_some_and(|x| 2.0 * x.abs() < value.abs());
    let off = beside.iter().flatten();
    let noise = off.fold(0.0, |most: f64, x| most.max((x - value).abs()));
    ((!beside.iter().all(shrinks)).then_some(value), noise)
}

/// True if a quantity is a single name.
pub(super) fn is_name(program: &Expression<usize>) -> bool {
    matches!(program.node, Node::Name(_))
}

/// True if a quantity is an angle known only up to whole turns.
pub(crate) fn turns(quantity: &Quantity) -> bool {
    quantity.unit == SiUnit::RADIAN
        && (quantity.measured().any(is_turned) || has_atan2(&quantity.expression))
}

/// True if an expression has an angle in it that jumps by a turn.
pub(crate) fn has_atan2(expression: &Expression<Measured>) -> bool {
    matches!(expression.node, Node::Call(Function::Atan2, _))
        || expression.operands().any(has_atan2)
}

/// True if a name stands for an angle that is known but for whole turns.
fn is_turned(of: &Measured) -> bool {
    matches!(of, Measured::Place(_, c, Order::Value) if c.is_angle())
}

impl Name {
    /// A name at the pace of the motion's law.
    pub fn of(of: Measured) -> Self {
        Name {
            of,
            geometric: false,
        }
    }

    /// True if it is an angle that is known but for whole turns.
    pub fn turns(&self) -> bool {
        is_turned(&self.of)
    }
}
