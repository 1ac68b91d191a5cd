//! Values of quantities over those of the names in them.

use crate::algebra::{Expression, Function, Node, SiUnit};
use crate::mechanism::{Measured, Order, Quantity};
use crate::number::{Dual, Number};

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

/// So that differences of names are off too.
const UNEVEN: [f64; 4] = [1.0, -0.73, 0.87, -0.61];

/// Whether a value is large beside how far it may be off.
#[inline(always)]
pub(super) fn is_clear([value, noise]: [f64; 2]) -> bool {
    4.0 * noise.abs() <= value.abs()
}

/// The value of a quantity, if it has one, and how far it may be off, over values of names that may be. A value that
/// only rounding keeps finite, as that of 1/x where x is nothing but rounding, is none: away from it, it shrinks.
pub(super) fn evaluated(program: &Expression<usize>, known: &[[f64; 2]]) -> (Option<f64>, f64) {
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

/// Whether a quantity is what one name stands for.
pub(super) fn is_name(program: &Expression<usize>) -> bool {
    matches!(program.node, Node::Name(_))
}

/// Whether a quantity is an angle that is known but for whole turns.
pub(super) fn turns(quantity: &Quantity) -> bool {
    fn has_atan2(expression: &Expression<Measured>) -> bool {
        matches!(expression.node, Node::Call(Function::Atan2, _))
            || expression.operands().any(has_atan2)
    }
    let angle = |of: &Measured| matches!(of, Measured::Place(_, c, Order::Value) if c.is_angle());
    quantity.unit == SiUnit::RADIAN
        && (quantity.measured().any(angle) || has_atan2(&quantity.expression))
}
