use super::Equations;

/// Newton's method from a guess that is nearly right, as when following a motion: one Jacobian
/// serves all steps for as long as each gains enough digits (Shamanskii 1967).
///
/// After a first step that leaves an error e₁, a step with the same factors leaves about e₀e₁.
#[derive(Clone, Debug, PartialEq)]
pub struct Warm {
    /// A point is a solution when no dimensionless row exceeds this.
    pub tolerance: f64,
    /// Steps after which to give up.
    pub max_steps: usize,
    /// A step must multiply the residual by less than this, or the Jacobian is renewed.
    pub contraction: f64,
}

impl Default for Warm {
    fn default() -> Self {
        Warm {
            tolerance: 1e-12,
            max_steps: 20,
            contraction: 1e-3,
        }
    }
}

/// What a warm solve came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WarmReport {
    /// Whether the residual is below the tolerance.
    pub solved: bool,
    /// Steps taken.
    pub steps: usize,
    /// The largest residual row at the end, dimensionless.
    pub residual: f64,
}

impl Warm {
    /// Iterates from `point`. `trial` is storage. On failure `point` is where it got to.
    #[inline]
    pub fn solve<E: Equations>(
        &self,
        equations: &E,
        point: &mut E::Point,
        trial: &mut E::Point,
        work: &mut E::Work,
    ) -> WarmReport {
        let mut residual = equations.linearise(point, work).largest;
        let mut fresh = false;
        for steps in 0..self.max_steps {
            if residual <= self.tolerance {
                return WarmReport {
                    solved: true,
                    steps,
                    residual,
                };
            }
            if !fresh {
                equations.factorise(0.0, work);
            }
            equations.step(work);
            equations.advance(point, 1.0, work, trial);
            std::mem::swap(point, trial);
            let next = equations.residual(point, work).largest;
            fresh = next <= self.contraction * residual || next <= self.tolerance;
            residual = next;
            if !fresh {
                equations.linearise(point, work);
            }
        }
        WarmReport {
            solved: residual <= self.tolerance,
            steps: self.max_steps,
            residual,
        }
    }
}
