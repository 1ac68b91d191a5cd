//! The energy of a mechanism in parts with parameters of their own.

use super::{NotAlgebraic, Term};
use crate::mechanism::{Along, GivenEffort, GivenValue, Measured, Mechanism, Point};
use crate::number::{C, Number};
use crate::system::Load;

/// The parts of the energy with the parameters of the mechanism, which are forces over the largest, lengths over the
/// characteristic length.
pub(super) fn terms(
    mechanism: &Mechanism,
    load: &Load,
    points: &[Point],
) -> Result<(Vec<Term>, Vec<C>), NotAlgebraic> {
    let own = &load.own;
    let length = mechanism.characteristic_length();
    let mut terms: Vec<(Term, Vec<f64>)> = Vec::new();
    let number = |point: &Point| {
        let place = points.iter().position(|known| known == point);
        place.expect("every point is among those of the load")
    };
    let constant = |name: &str, given: &GivenValue| {
        let fixed = |of: &Measured| match of {
            Measured::Parameter(i) => mechanism.parameters()[*i].value,
            _ => f64::NAN,
        };
        let is_fixed = given
            .measured()
            .all(|of| matches!(of, Measured::Parameter(_)));
        let value = given.at(&fixed);
        let known = is_fixed && value.is_finite();
        known
            .then_some(value)
            .ok_or_else(|| NotAlgebraic::Force(name.to_owned()))
    };
    let force = |name: &str, point: &Point, force: [f64; 3], moment: [f64; 3]| match moment {
        [0.0, 0.0, 0.0] => Ok((Term::Force(number(point)), force.to_vec())),
        _ => Err(NotAlgebraic::Force(name.to_owned())),
    };
    // k and b of what pulls by k·x + b
    let along = |along: &Along, stiffness: f64, constant: f64| match along {
        Along::Points([a, b]) if constant == 0.0 => (
            Term::Line([number(a), number(b)], false),
            vec![stiffness * length],
        ),
        Along::Points([a, b]) => {
            let both = vec![stiffness * length, constant];
            (Term::Line([number(a), number(b)], true), both)
        }
        Along::Joint(joint) if mechanism.joints()[*joint].kind.is_angle() => {
            (Term::Hinge(*joint), vec![constant / length])
        }
        Along::Joint(joint) => (Term::Slide(*joint), vec![stiffness * length, constant]),
    };
    for mass in own.masses.iter().filter(|_| own.gravity != [0.0; 3]) {
        let weight = own.gravity.map(|g| mass.mass * g);
        terms.push((Term::Force(number(&mass.centre)), weight.to_vec()));
    }
    for (point, given, moment) in &load.wrenches {
        terms.push(force("", point, *given, *moment)?);
    }
    for (joint, effort) in &load.joints {
        terms.push(along(&Along::Joint(*joint), 0.0, -effort));
    }
    for spring in &own.springs {
        let torsion = match spring.along {
            Along::Joint(joint) => mechanism.joints()[joint].kind.is_angle(),
            Along::Points(_) => false,
        };
        if torsion && spring.stiffness > 0.0 {
            return Err(NotAlgebraic::TorsionSpring(spring.name.clone()));
        }
        if spring.only.is_some() {
            return Err(NotAlgebraic::OneWay(spring.name.clone()));
        }
        let constant = spring.preload - spring.stiffness * spring.rest;
        terms.push(along(&spring.along, spring.stiffness, constant));
    }
    for given in &own.forces {
        terms.push(match &given.on {
            GivenEffort::Along(on, value) => {
                let sign = if let Along::Joint(_) = on { -1.0 } else { 1.0 };
                along(on, 0.0, sign * constant(&given.name, value)?)
            }
            GivenEffort::At { follows: true, .. } => {
                return Err(NotAlgebraic::Force(given.name.clone()));
            }
            GivenEffort::At { point, wrench, .. } => {
                let values = wrench.iter().map(|of| constant(&given.name, of));
                let values: Vec<f64> = values.collect::<Result<_, _>>()?;
                let part = |from: usize| std::array::from_fn(|i| values[from + i]);
                force(&given.name, point, part(0), part(3))?
            }
        });
    }
    let all = terms.iter().flat_map(|(_, of)| of);
    let size = all.fold(0.0, |most: f64, x| most.max(x.abs()));
    let parameters = terms.iter().flat_map(|(_, of)| of);
    let parameters = parameters.map(|x| C::from_f64(x / size)).collect();
    Ok((
        terms.into_iter().map(|(term, _)| term).collect(),
        parameters,
    ))
}
