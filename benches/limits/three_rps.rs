//! B: the 3-RPS. Unknown the three leg angles for given leg lengths; the spherical joints
//! S_i = ((1 - l_i cos α_i) e_i, l_i sin α_i) stand pairwise √(3/4) apart.

use std::array::from_fn;

use super::{Circle, MAX_STEPS, Report, TOLERANCE, Tally, Trig, turn};

/// Square of the platform's side.
pub const SIDE2: f64 = 0.75;
/// Leg angles where all legs are 0.8 long.
pub const HOME: [f64; 3] = [0.895_664_793_857_864_9; 3];
pub const HOME_LEGS: [f64; 3] = [0.8; 3];

/// Leg angles, and how far the last solve moved them.
#[derive(Clone, Copy, Debug)]
pub struct State {
    pub angles: [f64; 3],
    pub rate: [f64; 3],
}

impl State {
    pub fn at(angles: [f64; 3]) -> Self {
        State {
            angles,
            rate: [0.0; 3],
        }
    }

    /// From home to the given legs in a hundred warm starts.
    pub fn ramped_to(legs: [f64; 3]) -> Self {
        let mut state = State::at(HOME);
        for k in 1..=100 {
            let s = f64::from(k) / 100.0;
            let report = solve::<super::Std>(
                &mut state,
                from_fn(|i| HOME_LEGS[i] + s * (legs[i] - HOME_LEGS[i])),
            );
            assert!(report.converged);
        }
        state.rate = [0.0; 3];
        state
    }
}

/// State with the angles carried as points of the circle from solve to solve: no trigonometry at all.
#[derive(Clone, Copy, Debug)]
pub struct Carried {
    pub angles: [Circle; 3],
    pub rate: [f64; 3],
}

impl From<State> for Carried {
    fn from(state: State) -> Self {
        Carried {
            angles: state.angles.map(Circle::at::<super::Std>),
            rate: state.rate,
        }
    }
}

/// Newton from the state; inputs: the leg lengths.
#[inline]
pub fn solve<T: Trig>(state: &mut State, legs: [f64; 3]) -> Report {
    let (report, _, moved) = newton(state.angles.map(Circle::at::<T>), legs);
    *state = State {
        angles: from_fn(|i| state.angles[i] + moved[i]),
        rate: moved,
    };
    report
}

/// Newton from where the last move, made once more, leads.
#[inline]
pub fn solve_predicted<T: Trig>(state: &mut State, legs: [f64; 3]) -> Report {
    let angles: [f64; 3] = from_fn(|i| state.angles[i] + state.rate[i]);
    let (report, _, moved) = newton(angles.map(Circle::at::<T>), legs);
    *state = State {
        angles: from_fn(|i| angles[i] + moved[i]),
        rate: from_fn(|i| state.rate[i] + moved[i]),
    };
    report
}

/// [`solve`] on carried circles.
#[inline]
pub fn track(state: &mut Carried, legs: [f64; 3]) -> Report {
    let (report, angles, moved) = newton(state.angles, legs);
    *state = Carried {
        angles: angles.map(Circle::renormalised),
        rate: moved,
    };
    report
}

/// [`solve_predicted`] on carried circles.
#[inline]
pub fn track_predicted(state: &mut Carried, legs: [f64; 3]) -> Report {
    let (predicted, _) = turn(state.angles, state.rate);
    let (report, angles, moved) = newton(predicted, legs);
    *state = Carried {
        angles: angles.map(Circle::renormalised),
        rate: from_fn(|i| state.rate[i] + moved[i]),
    };
    report
}

#[inline(always)]
fn newton(mut angles: [Circle; 3], legs: [f64; 3]) -> (Report, [Circle; 3], [f64; 3]) {
    let mut moved = [0.0; 3];
    let mut steps = 0;
    loop {
        // S_i = (u e_i, z); the derivatives by α are u' = z and z' = 1 - u
        let x: [f64; 3] = from_fn(|i| legs[i] * angles[i].cos);
        let z: [f64; 3] = from_fn(|i| legs[i] * angles[i].sin);
        let u = x.map(|x| 1.0 - x);
        // pair i is (i, i + 1); e_i·e_j = -1/2, so |S_i - S_j|² = u_i² + u_j² + u_i u_j + (z_i - z_j)²
        let next = [1, 2, 0];
        let f: [f64; 3] = from_fn(|i| {
            let (j, d) = (next[i], z[i] - z[next[i]]);
            u[i] * u[i] + u[j] * u[j] + u[i] * u[j] + d * d - SIDE2
        });
        let mut residual = f[0].abs();
        for f in &f[1..] {
            residual = if residual > f.abs() {
                residual
            } else {
                f.abs()
            };
        }
        // the maximum may pass over a leg that is not a number, the sum does not
        let converged = residual <= TOLERANCE && !(f[0] + f[1] + f[2]).is_nan();
        if converged || steps == MAX_STEPS {
            return (
                Report {
                    steps,
                    residual,
                    converged,
                },
                angles,
                moved,
            );
        }
        // row i holds p_i at column i and q_i at column i + 1 and nothing else: Cramer's rule costs
        // twelve products and one division
        let p: [f64; 3] = from_fn(|i| {
            let j = next[i];
            (2.0 * u[i] + u[j]) * z[i] + 2.0 * (z[i] - z[j]) * x[i]
        });
        let q: [f64; 3] = from_fn(|i| {
            let j = next[i];
            (2.0 * u[j] + u[i]) * z[j] - 2.0 * (z[i] - z[j]) * x[j]
        });
        let (pp, qq) = (p[1] * p[2], q[0] * q[1]);
        let inverse = -1.0 / (p[0] * pp + qq * q[2]);
        let step = [
            (f[0] * pp - q[0] * p[2] * f[1] + qq * f[2]) * inverse,
            (f[1] * p[2] * p[0] - q[1] * p[0] * f[2] + q[1] * q[2] * f[0]) * inverse,
            (f[2] * p[0] * p[1] - q[2] * p[1] * f[0] + q[2] * q[0] * f[1]) * inverse,
        ];
        let (turned, turns) = turn(angles, step);
        angles = turned;
        moved = from_fn(|i| moved[i] + turns[i]);
        steps += 1;
    }
}

/// One cold start: the legs, and the angles to start from.
pub type Cold = ([f64; 3], [f64; 3]);

pub fn cold_starts(starts: &[Cold]) -> Tally {
    Tally::of(
        starts
            .iter()
            .map(|&(legs, angles)| solve::<super::Std>(&mut State::at(angles), legs)),
    )
}
