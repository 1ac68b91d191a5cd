//! Accuracy of rates, and the test for rates that exist to first order only.

use super::{Accuracy, FirstOrderOnly};
use crate::linear::norm;
use crate::mechanism::Configuration;
use crate::number::tolerance::{EXACT, STILL};
use crate::system::{Drive, FINITE_STEP, Motion, Neighbourhood, Places, Tangent};

fn is_still(values: &[f64]) -> bool {
    values.iter().all(|x| *x == 0.0)
}

/// The rates given, or if there are none, of every input at once, as for the Jacobian.
fn rates_or_all(drive: &Drive) -> Vec<f64> {
    match is_still(&drive.rates) {
        true => vec![1.0; drive.rates.len()],
        false => drive.rates.clone(),
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// The change of rates and accelerations for a shift of the configuration by its uncertainty: r/σ along the direction of
/// the smallest singular value σ, with r the residual of the closure equations.
pub(super) fn of(
    motion: &mut Motion,
    held: &mut Neighbourhood,
    rest: &Tangent,
    drive: &Drive,
) -> Accuracy {
    let Some((_, direction)) = rest.decomposition.weakest() else {
        return Accuracy::default();
    };
    let smallest = rest.decomposition.smallest();
    let off = held.residual(&rest.at).max(EXACT) / smallest;
    let given = rates_or_all(drive);
    let changes = &drive.accelerations;
    let mut at = |place: &Configuration<f64>| {
        motion.at(place);
        let rates = motion.rates(&given).to_vec();
        (rates, motion.accelerations(changes).to_vec())
    };
    let (rates, accelerations) = at(&rest.at);
    let (mut by_rates, mut by_accelerations) = (0.0_f64, 0.0_f64);
    for side in [off, -off] {
        let step: Vec<f64> = direction.iter().map(|x| x * side).collect();
        let beside = at(&held.system().displaced(&rest.at, &step));
        let change = |a: &[f64], b: &[f64]| {
            let pairs = a.iter().zip(b);
            largest(&pairs.map(|(a, b)| a - b).collect::<Vec<f64>>())
        };
        by_rates = by_rates.max(change(&rates, &beside.0));
        by_accelerations = by_accelerations.max(change(&accelerations, &beside.1));
    }
    let fastest = largest(&rates);
    let strongest = largest(&accelerations).max(fastest * fastest);
    let beside = |change: f64, size: f64| if change == 0.0 { 0.0 } else { change / size };
    Accuracy {
        smallest_singular_value: Some(smallest),
        configuration: off,
        rates: beside(by_rates, fastest),
        accelerations: beside(by_accelerations, strongest),
    }
}

/// Finds out if the given rates exist to first order only.
///
/// One infinitesimal freedom is decided by a finite step, several by second order: no accelerations meet the closure
/// equations. `motion` must be factorised at the configuration.
pub(super) fn first_order_only(
    near: &mut Neighbourhood,
    motion: &mut Motion,
    at: &Configuration<f64>,
    drive: &Drive,
) -> Option<FirstOrderOnly> {
    // from rest the accelerations are what a motion begins with
    let given = match is_still(&drive.rates) && !is_still(&drive.accelerations) {
        true => drive.accelerations.clone(),
        false => rates_or_all(drive),
    };
    let changes = match is_still(&drive.rates) {
        true => vec![0.0; given.len()],
        false => drive.accelerations.clone(),
    };
    let rates = motion.rates(&given).to_vec();
    let strongest = largest(motion.accelerations(&changes));
    let mismatch = motion.mismatch_of_accelerations();
    let fastest = largest(&rates);
    let opens = mismatch > STILL * strongest.max(fastest * fastest);
    let tangent = near.tangent(at.clone());
    let places = Places::new(motion.unknowns());
    let places = (near.system().unknowns().iter())
        .map(|unknown| places.of(*unknown).expect("the motion has every unknown"));
    let mut direction: Vec<f64> = places.map(|place| rates[place]).collect();
    let length = norm(&direction);
    let alone = tangent.motions.len() == 1;
    let gap = match alone && length > 0.0 {
        true => {
            direction.iter_mut().for_each(|x| *x /= length);
            near.free_step(&tangent, &direction, FINITE_STEP)
                .err()
                .flatten()
        }
        false => None,
    };
    (opens || gap.is_some()).then_some(FirstOrderOnly {
        shaky: alone && gap.is_some(),
        gap_after_step: gap,
        mismatch,
    })
}
