//! Loops that neither joints nor numbers of the file couple.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::mechanism::Mechanism;
use crate::system::{Bundle, Bundled, Held, HeldPlatform};

/// Closures that are looked at together, with what they depend on.
#[derive(Default)]
pub(super) struct LinkedLoops {
    pub closures: Vec<usize>,
    joints: BTreeSet<usize>,
    platforms: BTreeSet<usize>,
    /// The numbers of the file, among those that may be rounded.
    pub numbers: BTreeSet<usize>,
}

impl LinkedLoops {
    /// The parts of a mechanism with numbers of these indices among its parameters.
    pub fn of(mechanism: &Mechanism, numbers: &[(usize, f64)]) -> Option<Vec<LinkedLoops>> {
        let bundle = Bundle::new(mechanism, Held::nothing(mechanism), numbers);
        let file = bundle.file();
        let system = bundle.equations::<f64>(&file)?;
        let home = mechanism.home();
        // a drawing closes whatever its numbers are: there they matter beside it
        let at = match mechanism.coordinates() {
            Some(_) => system.displaced(&home, &vec![0.3; system.unknowns().len()]),
            None => home,
        };
        let at = Bundled {
            numbers: file,
            configurations: vec![at],
        };
        let columns = bundle.by_numbers(&at)?.pop()?;
        let rows: Vec<Range<usize>> = system.closure_rows().collect();
        let mut parts: Vec<LinkedLoops> = Vec::new();
        for (i, closure) in mechanism.closures().iter().enumerate() {
            let (joints, platforms) = mechanism.within_loop(closure);
            let touches = |(k, (_, size)): (usize, &(usize, f64))| {
                let column = &columns[k * system.rows()..][rows[i].clone()];
                // less, beside the size of the number, comes from loops that are not quite closed
                column.iter().any(|x| x.abs() > 1e-3 * size).then_some(k)
            };
            let mut part = LinkedLoops {
                closures: vec![i],
                joints: joints.into_iter().collect(),
                platforms: platforms.into_iter().collect(),
                numbers: numbers.iter().enumerate().filter_map(touches).collect(),
            };
            let (coupled, others): (Vec<LinkedLoops>, _) =
                parts.into_iter().partition(|other| part.is_coupled(other));
            parts = others;
            coupled.into_iter().for_each(|other| part.join(other));
            parts.push(part);
        }
        Some(parts)
    }

    fn is_coupled(&self, other: &LinkedLoops) -> bool {
        !(self.joints.is_disjoint(&other.joints)
            && self.platforms.is_disjoint(&other.platforms)
            && self.numbers.is_disjoint(&other.numbers))
    }

    fn join(&mut self, other: LinkedLoops) {
        self.closures.extend(other.closures);
        self.joints.extend(other.joints);
        self.platforms.extend(other.platforms);
        self.numbers.extend(other.numbers);
    }

    pub fn unknowns(&self) -> usize {
        self.joints.len() + 6 * self.platforms.len()
    }

    /// Everything else at rest.
    pub fn held(&self, mechanism: &Mechanism) -> Held<f64> {
        let joints = 0..mechanism.joints().len();
        let platforms = 0..mechanism.platforms().len();
        Held {
            joints: joints.map(|i| !self.joints.contains(&i)).collect(),
            platforms: platforms
                .map(|i| match self.platforms.contains(&i) {
                    true => HeldPlatform::Free,
                    false => HeldPlatform::Pose,
                })
                .collect(),
        }
    }
}
