//! Newton's method from random complex points at one member of the family.

use rand::SeedableRng;
use rand_pcg::Pcg64;

use crate::analysis::assemblies::family::{C, Family, Member, size};
use crate::analysis::assemblies::track::{ParameterHomotopy, START, polish, stands_alone};
use crate::number::tolerance::SUSPECT;
use crate::solve::{Newton, Stop};
use crate::system::{System, SystemWork};

/// End of one seed.
pub(crate) enum Seed {
    Nothing,
    /// A simple isolated solution.
    Isolated(Vec<C>),
    /// Solutions that coincide, or that rounding does not distinguish.
    Multiple(Vec<C>),
    /// A set of solutions with so much freedom.
    Free(usize),
}

/// The solution that Newton's method reaches from a point at the start of a way, by all equations or some of them. Far out
/// rounding keeps residuals above its tolerance; there the last digits tell.
pub(crate) fn reached(
    homotopy: &mut ParameterHomotopy<'_>,
    some: Option<(&System<C>, &mut SystemWork<C>)>,
    x: &[C],
) -> Option<Vec<C>> {
    // what takes longer rarely ends at a solution
    let newton = Newton {
        max_steps: 60,
        ..Newton::default()
    };
    homotopy.linearise(START, x);
    let mut at = homotopy.here.at.clone();
    let mut trial = at.clone();
    let here = &mut homotopy.here;
    let (system, work) = some.unwrap_or((&here.system, &mut here.work));
    let report = newton.solve(system, &mut at, &mut trial, work);
    let mut x = homotopy.family.coordinates.flatten(&at);
    // farther out rounding decides where ends are
    if size(&x).is_nan() || size(&x) > 1e5 {
        return None;
    }
    match report.stop {
        Stop::Solved => Some(x),
        Stop::Minimum if report.size.largest <= 1e-8 * (1.0 + size(&x).powi(2)) => {
            polish(homotopy, START, &mut x).then_some(x)
        }
        Stop::Minimum | Stop::StepLimit => None,
    }
}

/// One Newton iteration from a random complex point. `reach` says how far out.
pub(crate) fn newton_seeds(
    homotopy: &mut ParameterHomotopy<'_>,
    reach: f64,
    rng: &mut Pcg64,
) -> Seed {
    let family = homotopy.family;
    let Some(x) = reached(homotopy, None, &family.random_point(rng, reach)) else {
        return Seed::Nothing;
    };
    if stands_alone(homotopy, START, &x) {
        return Seed::Isolated(x);
    }
    // Newton's method from beside a set of solutions ends elsewhere on it, but from beside
    // solutions that coincide at the same point again
    let beside = reached(homotopy, None, &family.shaken(&x, 0.03, rng));
    match beside.map(|beside| family.coordinates.difference(&x, &beside)) {
        Some(1e-3..1.0) => Seed::Free(homotopy.freedom(START, &x, SUSPECT)),
        Some(..1e-3) => Seed::Multiple(x),
        _ => Seed::Nothing,
    }
}

impl Family {
    /// True if nothing is held and a complex solution is isolated at the mechanism's own dimensions.
    pub fn is_isolated(&self) -> bool {
        const SEEDS: u64 = 100;
        let own = Member {
            parameters: self.parameters.clone(),
            inputs: Vec::new(),
        };
        let is_free = self.coordinates.inputs.is_empty();
        let still = is_free.then(|| self.homotopy(&own, &own)).flatten();
        still.is_some_and(|mut still| {
            let mut seeds = (0..SEEDS).map(Pcg64::seed_from_u64);
            seeds
                .any(|mut rng| matches!(newton_seeds(&mut still, 1.0, &mut rng), Seed::Isolated(_)))
        })
    }
}
