//! Motions of random mechanisms: what is said of the whole does not depend on the rows.

use linkwork::analysis::sweep::{Law, MotionReport, Pace, SweepSettings};
use linkwork::mechanism::{Configuration, Mechanism};

use crate::generator::Dice;
use crate::invariants::{Broken, Budget, near};
use crate::questions::Asked;

/// Beside the largest values of a quantity.
const SAME: f64 = 1e-6;

/// A joint that is held moves on, with quantities, a dwell and the straightness of a path.
pub fn motions(
    asked: &Asked,
    mechanism: &Mechanism,
    at: &Configuration<f64>,
    budget: &Budget,
    dice: &mut Dice,
) -> Broken {
    let Some(joint) = (asked.hold.iter()).find_map(|(name, _)| mechanism.joint(name)) else {
        return Ok(());
    };
    let names: Vec<&str> = mechanism
        .joints()
        .iter()
        .map(|of| of.name.as_str())
        .collect();
    let of = |index: usize| names[index % names.len()];
    let driven = of(joint);
    let other = of(dice.below(names.len()));
    let way = dice.signed()
        * if mechanism.joints()[joint].kind.is_angle() {
            1.0
        } else {
            0.2
        };
    let from = at.joints[joint];
    let mut rest = asked.clone();
    rest.hold.retain(|(name, _)| name != driven);
    let question = near(rest.of(mechanism), mechanism, at)
        .input(driven, from, from + way)
        .report(format!(
            "a={other}, b=sin(200*{other}), c=velocity:{other}/velocity:{driven}"
        ))
        .dwell("a", 0.05);
    let law = dice.pick(&Law::ALL);
    let counts = [1, 2 + dice.below(9), 11 + dice.below(990)];
    let mut known: Option<(usize, MotionReport)> = None;
    for steps in counts {
        let settings = SweepSettings {
            steps,
            pace: Pace { law, duration: 1.0 },
            ..SweepSettings::default()
        };
        let (answer, left) = budget.spend(|watch| {
            let motions = question.motions(&settings, watch).ok()?;
            Some(
                motions
                    .report(2, &mut |_, _| {}, watch)
                    .motions
                    .swap_remove(0),
            )
        });
        let Some(motion) = answer.filter(|_| !left) else {
            return Ok(());
        };
        match &known {
            None => known = Some((steps, motion)),
            Some((before, known)) => same(known, &motion).map_err(|broken| {
                format!("{driven} by {way} at {before} and {steps} steps, {law:?}: {broken}")
            })?,
        }
    }
    Ok(())
}

fn same(a: &MotionReport, b: &MotionReport) -> Broken {
    if a.sweep.ending != b.sweep.ending {
        return Err(format!("{:?} and {:?}", a.sweep.ending, b.sweep.ending));
    }
    for (a, b) in a.extremes.iter().zip(&b.extremes) {
        let values = |of: &linkwork::analysis::sweep::Extremum| {
            let side =
                |of: &Option<linkwork::analysis::sweep::Extreme>| of.as_ref().map(|of| of.value);
            [
                of.constant.or(side(&of.least)),
                of.constant.or(side(&of.greatest)),
            ]
        };
        for (x, y) in values(a).into_iter().zip(values(b)) {
            let equal = match (x, y) {
                (Some(x), Some(y)) => (x - y).abs() <= SAME * (1.0 + x.abs()),
                (None, None) => true,
                _ => false,
            };
            if !equal {
                return Err(format!("{}: {x:?} and {y:?}", a.name));
            }
        }
    }
    for (a, b) in a.dwells.iter().zip(&b.dwells) {
        let [x, y] = [a, b].map(|of| of.times[1] - of.times[0]);
        if (x - y).abs() > SAME {
            return Err(format!("dwells of {}: {x} and {y}", a.name));
        }
    }
    Ok(())
}
