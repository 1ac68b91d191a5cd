//! Free directions of motion: those along which a finite step is possible.

use super::walk::MOVED_ON_A_BRANCH;
use super::{FiniteSearch, IndependentPart, LocalBranch, see};
use crate::number::tolerance::ROUNDING;
use crate::system::{FINITE_STEP, FiniteStep, Tangent, combination};

/// Directions of motion that are tried; all must be free for the mechanism to be regular.
const DIRECTIONS: usize = 3;

/// Least change of a joint that moves in a finite step: at a dead point it moves to second order only.
const MOVED: f64 = 1e-7;

/// For each unknown true if it moves, with the largest gap after the steps (`None` if none were made); as the error,
/// the gap of a step that leaves the closures open.
type Free = Result<(Vec<bool>, Option<f64>), Option<f64>>;

impl FiniteSearch<'_, '_> {
    /// A regular configuration beside one in gimbal lock, where nothing is locked: of three the one with the fewest
    /// motions. Angles that turn without moving anything make branches that are none of the bodies.
    pub fn regular_beside(&mut self, at: &Tangent) -> Option<Tangent> {
        let beside = (1..4).filter_map(|k| {
            let lasting = self.near.beside(&at.at, k)?.lasting(self.near);
            let regular =
                lasting.locked.is_empty() && self.is_regular(&lasting.tangent, FINITE_STEP, 3);
            regular.then_some(lasting.tangent)
        });
        beside.min_by_key(|tangent| tangent.motions.len())
    }

    /// Tests if all motions of an independent part are finite. Where its equations are independent they are, however
    /// near a singular configuration is: steps that do not lead back are repeated shorter.
    pub(super) fn finite(&mut self, own: &[bool], tangent: &Tangent) -> Free {
        /// Steps, each a tenth of the one before.
        const TIMES: usize = 4;
        let steps = self.free(tangent, FINITE_STEP);
        if steps.is_ok() || self.near.system().is_large() || !self.near.is_regular(&tangent.at, own)
        {
            return steps;
        }
        let shorter =
            (1..=TIMES).find_map(|k| self.free(tangent, FINITE_STEP * 0.1f64.powi(k as i32)).ok());
        Ok(shorter.unwrap_or_else(|| {
            let mut moved = vec![false; tangent.columns()];
            for motion in &tangent.motions {
                see(&mut moved, motion, MOVED);
            }
            (moved, None)
        }))
    }

    /// Tests motions by steps of one length along random directions.
    fn free(&mut self, tangent: &Tangent, length: f64) -> Free {
        let mut moved = vec![false; tangent.columns()];
        let mut gap: f64 = 0.0;
        let directions = match tangent.motions.is_empty() {
            true => 0,
            false => DIRECTIONS,
        };
        for _ in 0..directions {
            let direction = combination(&tangent.motions, &mut self.rng);
            let step = match self.near.free_step(tangent, &direction, length) {
                Err(None) if self.is_independent(tangent) => {
                    for motion in &tangent.motions {
                        // along a row motions die away to less than rounding of the largest
                        see(&mut moved, motion, 0.0);
                    }
                    return Ok((moved, None));
                }
                Err(None) if tangent.motions.len() == 1 => {
                    self.settled(tangent, &direction).ok_or(None)?
                }
                step => step?,
            };
            gap = gap.max(step.gap);
            let way = self.near.system().difference(&tangent.at, &step.at);
            see(&mut moved, &way, MOVED);
        }
        Ok((moved, Some(gap)))
    }

    /// The branch of a singular part where all motions but one are free whatever that one does. What is left of the
    /// equations is then a function of one variable, and if steps either way leave them open it vanishes nowhere nearby.
    pub(super) fn all_but_one(&mut self, tangent: &Tangent) -> Option<IndependentPart> {
        if self.near.system().is_large() {
            return None;
        }
        let directions: Vec<Vec<f64>> = (0..DIRECTIONS)
            .map(|_| combination(&tangent.motions, &mut self.rng))
            .collect();
        let (one, others) = self
            .near
            .hindered_alone(tangent, &directions, FINITE_STEP)?;
        let is_open = [1.0, -1.0].into_iter().all(|sign| {
            let direction: Vec<f64> = one.iter().map(|x| sign * x).collect();
            let step = self.near.free_step(tangent, &direction, FINITE_STEP);
            matches!(step, Err(Some(gap)) if gap > ROUNDING)
        });
        let others = Tangent {
            motions: others,
            ..tangent.clone()
        };
        let all_free =
            others.motions.is_empty() || self.is_regular(&others, FINITE_STEP, DIRECTIONS);
        (is_open && all_free).then(|| {
            let mut moved = vec![false; tangent.columns()];
            for motion in &others.motions {
                see(&mut moved, motion, MOVED_ON_A_BRANCH);
            }
            let branch = LocalBranch {
                freedoms: others.motions.len(),
                motions: others.motions,
                moved,
                ..LocalBranch::default()
            };
            IndependentPart {
                branches: Some(branch)
                    .filter(|branch| branch.freedoms > 0)
                    .into_iter()
                    .collect(),
                regular: false,
                complete: true,
            }
        })
    }

    /// True if all equations of a large mechanism that do not vanish everywhere are independent: by the implicit
    /// function theorem its motions are finite, even if it is too ill-conditioned for steps.
    fn is_independent(&self, tangent: &Tangent) -> bool {
        let system = self.near.system();
        let equations = self.near.mechanism().equations_that_vary() + system.hold_rows().len();
        system.is_large() && tangent.decomposition.rank() == equations
    }

    /// A finite step along the only motion, by steps each with its own Jacobian: where the Jacobian is ill-conditioned, as
    /// in long rows of loops, a fixed one does not lead back at any length.
    fn settled(&mut self, tangent: &Tangent, direction: &[f64]) -> Option<FiniteStep> {
        let at = self.near.ahead(tangent, direction, FINITE_STEP)?;
        let gap = self.near.residual(&at);
        Some(FiniteStep { at, gap })
    }

    /// True if several random directions of motion are all free; then, almost surely, every direction is.
    pub fn is_regular(&mut self, tangent: &Tangent, distance: f64, directions: usize) -> bool {
        (0..directions).all(|_| {
            let direction = combination(&tangent.motions, &mut self.rng);
            self.near.free_step(tangent, &direction, distance).is_ok()
        })
    }
}
