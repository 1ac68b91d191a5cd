//! Finite and infinitesimal freedoms told apart, and branches of the configuration space.

mod free;
mod walk;

use std::cmp::Reverse;

use rand_pcg::Pcg64Mcg;

use super::Character;
use crate::linear::orthonormal;
use crate::number::sorting::sort_by_key;
use crate::solve::{Stage, Watch};
use crate::system::{Cone, Neighbourhood, SET_STEP, Tangent, independent_parts};
use walk::{BranchWalk, MOVED_ON_A_BRANCH, Seen, WalkDirections, contains, same};

/// Steps per infinitesimal freedom by which branches are sought.
const BRANCH_TRIALS: usize = 8;

/// Branches whose tangents at the meeting point differ by less than this are one.
const SAME_THERE: f64 = 0.02;

/// Branches listed at most; more are counted.
const LISTED: usize = 256;

/// The finite motions through a configuration.
pub(super) struct Finite {
    pub freedoms: usize,
    pub character: Character,
    pub branches: Vec<LocalBranch>,
    /// Number of branches, of which no more than [`LISTED`] are listed.
    pub count: usize,
    /// True if there are certainly no others.
    pub complete: bool,
    /// For each unknown, true if it was seen to move.
    pub moved: Vec<bool>,
    /// Residual of the equations after a finite step.
    pub gap: Option<f64>,
}

/// A branch through a singular configuration.
#[derive(Clone, Default)]
pub(super) struct LocalBranch {
    pub freedoms: usize,
    /// Basis of its motions at the configuration.
    pub motions: Vec<Vec<f64>>,
    /// True if its motions are a cone that is no linear space; the basis then spans it.
    pub cone: bool,
    /// True if the motions are known to about the length of a step only.
    pub approximate: bool,
    pub moved: Vec<bool>,
}

impl LocalBranch {
    /// Branches in this order do not depend on random directions: the largest first, then by what the projection onto
    /// their motions, which is the same for every basis, makes of a fixed direction.
    fn order(&self) -> (Reverse<usize>, Vec<Reverse<i64>>) {
        // uneven, so that it is not the same to branches that mirror one another
        let fixed = |i: usize| 1.0 + (0.618 * i as f64).fract();
        let mut made = vec![0.0; self.moved.len()];
        for motion in &self.motions {
            let along: f64 = (motion.iter().enumerate()).map(|(i, x)| fixed(i) * x).sum();
            (made.iter_mut().zip(motion)).for_each(|(made, x)| *made += along * x);
        }
        // tangents are known better than to a hundredth
        let key = made.iter().map(|x| Reverse((x / 1e-2).round() as i64));
        (Reverse(self.freedoms), key.collect())
    }
}

/// The branches of one independent part of a mechanism.
struct IndependentPart {
    branches: Vec<LocalBranch>,
    regular: bool,
    complete: bool,
}

/// The search for the finite motions through configurations of a mechanism.
pub(super) struct FiniteSearch<'s, 'm> {
    pub near: &'s mut Neighbourhood<'m>,
    pub watch: &'s Watch<'s>,
    pub rng: Pcg64Mcg,
}

impl FiniteSearch<'_, '_> {
    pub fn find(&mut self, tangent: &Tangent) -> Finite {
        let freedoms = tangent.motions.len();
        let whole = self.finite(&vec![true; tangent.columns()], tangent);
        let gap = match &whole {
            Ok((_, gap)) | Err(gap) => *gap,
        };
        if let Ok((moved, _)) = whole {
            return Finite {
                freedoms,
                character: match freedoms {
                    0 => Character::Structure,
                    _ => Character::Regular,
                },
                branches: vec![],
                count: freedoms.min(1),
                complete: true,
                moved,
                gap,
            };
        }
        let owns = independent_parts(self.near.mechanism(), self.near.system().unknowns());
        let one = owns.len() == 1;
        let parts = owns.iter().filter_map(|own| {
            let tangent = tangent.within(own);
            (!tangent.motions.is_empty()).then(|| self.part(own, &tangent, one))
        });
        let parts: Vec<IndependentPart> = parts.collect();
        let gains = |branch: &LocalBranch| branch.freedoms;
        let most = |part: &IndependentPart| part.branches.iter().map(gains).max().unwrap_or(0);
        let least = |part: &IndependentPart| part.branches.iter().map(gains).min().unwrap_or(0);
        let count = (parts.iter()).fold(1usize, |product, part| {
            product.saturating_mul(part.branches.len().max(1))
        });
        let branches = products(&parts, tangent);
        let mut moved = vec![false; tangent.columns()];
        for branch in parts.iter().flat_map(|part| &part.branches) {
            let all = moved.iter_mut().zip(&branch.moved);
            all.for_each(|(any, moved)| *any |= moved);
        }
        let character = match () {
            () if parts.iter().all(|part| part.regular) => Character::Regular,
            () if branches.is_empty() && !self.watch.is_stopped() => Character::Shaky,
            () if parts.iter().any(|part| most(part) != least(part)) => Character::Kinematotropic,
            () if count > 1 => Character::Bifurcation,
            () => Character::Singular,
        };
        Finite {
            freedoms: parts.iter().map(most).sum(),
            complete: parts.iter().all(|part| part.complete),
            count: match branches.len() {
                0 => 0,
                _ => count,
            },
            branches: match character {
                Character::Regular => vec![],
                _ => branches,
            },
            character,
            moved,
            gap,
        }
    }

    /// The branches of an independent part, which is known to be singular if it is the `only` one.
    fn part(&mut self, own: &[bool], tangent: &Tangent, only: bool) -> IndependentPart {
        if !only && let Ok((moved, _)) = self.finite(own, tangent) {
            let branch = LocalBranch {
                freedoms: tangent.motions.len(),
                motions: tangent.motions.clone(),
                moved,
                ..LocalBranch::default()
            };
            return IndependentPart {
                branches: vec![branch],
                regular: true,
                complete: true,
            };
        }
        self.singular(own, tangent)
    }

    /// The branches of a singular part that small steps settle on: until these find nothing new.
    fn singular(&mut self, own: &[bool], tangent: &Tangent) -> IndependentPart {
        /// Most steps, per infinitesimal freedom and [`BRANCH_TRIALS`].
        const LONGEST: usize = 12;
        if let Some(part) = self.all_but_one(tangent) {
            return part;
        }
        let n = tangent.motions.len();
        let watch = self.watch;
        let cone = Cone::of(self.near, tangent);
        if let Some(set) = cone.set(self.near, tangent, SET_STEP, &mut self.rng) {
            let mut moved = vec![false; tangent.columns()];
            for at in &set.beside {
                let way = self.near.system().difference(&tangent.at, at);
                see(&mut moved, &way, MOVED_ON_A_BRANCH * SET_STEP);
            }
            let branch = LocalBranch {
                freedoms: set.motions.len(),
                motions: set.motions,
                moved,
                ..LocalBranch::default()
            };
            let finite = Some(branch).filter(|branch| branch.freedoms > 0);
            return IndependentPart {
                branches: finite.into_iter().collect(),
                regular: false,
                complete: true,
            };
        }
        let mut walk = BranchWalk {
            search: self,
            own,
            from: tangent,
            seen: Vec::new(),
        };
        let mut limits: Vec<Limit> = Vec::new();
        let mut share = 0.0;
        let (mut tried, mut fruitless) = (0, 0);
        'rounds: while share < 1.0 {
            let mut ahead = match tried == 0 || cone.is_all() {
                true => WalkDirections::new(&cone, tangent),
                false => WalkDirections::on_cone(&cone, tangent),
            };
            let before = tried;
            while let Some(direction) = ahead.next(&cone, tangent, &mut walk.search.rng) {
                if watch.stops(Stage::Branches, tried, None) {
                    break 'rounds;
                }
                tried += 1;
                fruitless += 1;
                // on the cone a step along a branch that is known leads onto that
                let known = |limit: &Limit| {
                    let direction = std::slice::from_ref(&direction);
                    !limit.curved && contains(&limit.motions, direction, SAME_THERE)
                };
                if !cone.is_all() && limits.iter().any(known) {
                    continue;
                }
                walk.explore(&direction);
                if walk.seen.len() > limits.len() {
                    fruitless = 0;
                    for number in limits.len()..walk.seen.len() {
                        let motions = walk.limit(number);
                        let curved =
                            walk.seen[number].regular && is_curved(&mut walk, &cone, &motions);
                        limits.push(Limit { motions, curved });
                    }
                    share = branches(&cone, n, &walk.seen, &limits).1;
                    if share >= 1.0 {
                        break;
                    }
                }
            }
            if tried == before {
                break;
            }
            // where most of what is possible was found, the rest is probably real too
            let patience = if share >= 0.5 { 4 } else { 1 };
            let rounds = if cone.is_all() { 2 } else { 1 };
            let enough = patience * (rounds * BRANCH_TRIALS * n).max(4 * walk.seen.len());
            if n < 2 || fruitless >= enough || tried >= LONGEST * BRANCH_TRIALS * n {
                break;
            }
        }
        // joints that were seen to move since
        let (mut branches, share) = branches(&cone, n, &walk.seen, &limits);
        let seen = branches.len();
        // what has more freedoms than there are infinitesimal ones here does not pass through here
        branches.retain(|branch| branch.freedoms <= n);
        let single = matches!(&branches[..], [one] if one.freedoms == n && !one.cone);
        IndependentPart {
            regular: branches.len() < seen && single,
            // a function of one variable that vanishes nowhere nearby has no zero there
            complete: share >= 1.0 || (n == 1 && branches.is_empty() && !watch.is_stopped()),
            branches,
        }
    }
}

fn see(moved: &mut [bool], step: &[f64], clearly: f64) {
    for (moved, step) in moved.iter_mut().zip(step) {
        *moved |= step.abs() > clearly;
    }
}

/// The motions of a branch at the meeting point.
struct Limit {
    motions: Vec<Vec<f64>>,
    /// True if the limit depends on the direction of approach: the tangent is a curved cone.
    curved: bool,
}

/// True if the tangent of a branch at the meeting point is a curved cone: steps leave its span.
fn is_curved(walk: &mut BranchWalk, cone: &Cone, motions: &[Vec<f64>]) -> bool {
    if !cone.is_all() {
        return !cone.contains_all(motions);
    }
    let along = Tangent {
        motions: motions.to_vec(),
        ..walk.from.clone()
    };
    !walk.fills(&along, SET_STEP)
}

/// The branches that were seen, and their share of all that can be: 1 if there are certainly no others, 0 if not known.
///
/// The reduction of Lyapunov and Schmidt leaves k equations with independent quadratic parts. If each branch has n − k
/// freedoms, the tangent cone is a complete intersection of k quadrics, whose components have degrees that add up to 2ᵏ at
/// most (Bézout): 1 for a linear space, 2 for a single curved quadric.
fn branches(cone: &Cone, n: usize, seen: &[Seen], limits: &[Limit]) -> (Vec<LocalBranch>, f64) {
    let mut branches: Vec<(bool, LocalBranch)> = Vec::new();
    for (seen, Limit { motions, curved }) in seen.iter().zip(limits) {
        let one = |known: &&mut (bool, LocalBranch)| match *curved {
            true => known.1.cone && known.1.freedoms == motions.len(),
            false => !known.1.cone && same(&known.1.motions, motions, SAME_THERE),
        };
        if let Some((regular, branch)) = branches.iter_mut().find(one) {
            *regular |= seen.regular;
            let all = branch.moved.iter_mut().zip(&seen.moved);
            all.for_each(|(any, moved)| *any |= moved);
            if *curved {
                branch.motions = orthonormal(&[&branch.motions[..], motions].concat(), SAME_THERE);
            }
            continue;
        }
        let branch = LocalBranch {
            freedoms: motions.len(),
            motions: motions.clone(),
            cone: *curved,
            approximate: !seen.regular && motions.len() > 1,
            moved: seen.moved.clone(),
        };
        branches.push((seen.regular, branch));
    }
    sort_by_key(&mut branches, |(_, branch)| branch.order());
    // what was seen from a singular point of a larger branch is part of that
    let within = |i: usize| {
        let (regular, branch) = &branches[i];
        !regular
            && (branches[..i].iter()).any(|(_, larger)| {
                larger.freedoms > branch.freedoms
                    && contains(&larger.motions, &branch.motions, SAME_THERE)
            })
    };
    let parts: Vec<bool> = (0..branches.len()).map(within).collect();
    let whole = branches.into_iter().zip(parts).filter(|(_, part)| !part);
    let branches: Vec<LocalBranch> = whole.map(|((_, branch), _)| branch).collect();
    let forms = cone.forms();
    let degree = |branch: &LocalBranch| 1 + usize::from(branch.cone);
    let degrees: usize = branches.iter().map(degree).sum();
    let even = branches.iter().all(|b| b.freedoms + forms == n);
    let single = forms == 1 || branches.iter().all(|branch| !branch.cone);
    let most = 1usize.checked_shl(forms as u32).unwrap_or(usize::MAX);
    let known = (1..16).contains(&forms) && even && single;
    let share = degrees as f64 / most as f64;
    (branches, if known { share } else { 0.0 })
}

/// The branches of the whole: each part is on one of its own. The first of them.
fn products(parts: &[IndependentPart], tangent: &Tangent) -> Vec<LocalBranch> {
    let mut products: Vec<LocalBranch> = vec![LocalBranch {
        moved: vec![false; tangent.columns()],
        ..LocalBranch::default()
    }];
    for part in parts.iter().filter(|part| !part.branches.is_empty()) {
        let all = products.iter().flat_map(|known| {
            part.branches.iter().map(|branch| LocalBranch {
                freedoms: known.freedoms + branch.freedoms,
                motions: [&known.motions[..], &branch.motions].concat(),
                cone: known.cone || branch.cone,
                approximate: known.approximate || branch.approximate,
                moved: (known.moved.iter().zip(&branch.moved))
                    .map(|(a, b)| *a || *b)
                    .collect(),
            })
        });
        products = all.take(LISTED).collect();
    }
    products.retain(|branch| branch.freedoms > 0);
    sort_by_key(&mut products, LocalBranch::order);
    products
}
