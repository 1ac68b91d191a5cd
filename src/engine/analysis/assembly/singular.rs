//! Diagnosis of a configuration that is singular for the held inputs.

use super::Outcome;
use crate::linear::{Svd, dot};
use crate::mechanism::{Configuration, Mechanism};
use crate::number::tolerance::STILL;
use crate::solve::Equations;
use crate::system::{Freedoms, Held, HeldPlatform, System, Unknown};

/// Names the joints and platforms that move although the inputs are held, the closure with dependent equations
/// there, and the held joints that cannot drive the mechanism.
///
/// With J over the free and H over the held unknowns, w with wᵀJ = 0 and wᵀH ≠ 0 is a combination
/// of closure rows that only the inputs enter: it belongs to a closure, and the inputs in it are
/// locked. Combinations with wᵀH = 0 as well are the redundancy of an overconstrained mechanism.
pub(super) fn causes(
    mechanism: &Mechanism,
    held: &Held<f64>,
    at: &Configuration<f64>,
    freedoms: &Freedoms,
) -> Outcome {
    let system = System::new(mechanism.dimensions(), &Held::nothing(mechanism));
    let mut work = system.work();
    system.linearise(at, &mut work);
    let jacobian = system.dense_jacobian(&work);
    let rows = system.rows();
    let (mut free, mut inputs) = (Vec::new(), Vec::new());
    let columns = jacobian.chunks_exact(rows.max(1));
    for (unknown, column) in system.unknowns().iter().zip(columns) {
        match *unknown {
            Unknown::Joint(joint) if held.joints[joint] => inputs.push((joint, column)),
            Unknown::Twist(platform, _) if held.platforms[platform] == HeldPlatform::Pose => {}
            _ => free.push(column),
        }
    }
    let transposed: Vec<f64> = (0..rows)
        .flat_map(|i| free.iter().map(move |c| c[i]))
        .collect();
    let mut strongest = (0.0, 0, Vec::new());
    for w in Svd::of(free.len(), rows, &transposed).null_space() {
        let drives: Vec<(usize, f64)> = (inputs.iter())
            .map(|(joint, column)| (*joint, dot(column, w).abs()))
            .collect();
        let most = drives.iter().fold(0.0, |m: f64, (_, d)| m.max(*d));
        if most >= strongest.0 {
            let shares: Vec<f64> = (system.closure_rows())
                .map(|range| dot(&w[range.clone()], &w[range]))
                .collect();
            let more = |best, i| if shares[i] > shares[best] { i } else { best };
            let closure = (0..shares.len()).fold(0, more);
            let powerless = (drives.iter()).filter(|(_, d)| most > STILL && *d > 0.1 * most);
            strongest = (most, closure, powerless.map(|(joint, _)| *joint).collect());
        }
    }
    let (_, closure, powerless) = strongest;
    let closure = mechanism.closures().get(closure);
    Outcome::Singular {
        moving: freedoms.moving(mechanism),
        closure: closure.map(|closure| closure.name.clone()),
        powerless: (powerless.into_iter())
            .map(|joint: usize| mechanism.joints()[joint].name.clone())
            .collect(),
    }
}
