//! A: the 4-bar. Unknown the coupler and rocker angles t2, t3 for a given crank angle t1:
//! l1 e^{i t1} + l2 e^{i t2} = l0 + l3 e^{i t3}.

use std::array::from_fn;

use super::{Circle, MAX_STEPS, Report, TOLERANCE, Trig, turn};

pub const L0: f64 = 4.5;
pub const L1: f64 = 2.0;
pub const L2: f64 = 4.0;
pub const L3: f64 = 3.5;

/// Coupler and rocker angle, and how far the last solve moved them.
#[derive(Clone, Copy, Debug)]
pub struct State {
    pub t: [f64; 2],
    pub rate: [f64; 2],
}

impl State {
    /// The open branch, t3 in (0, pi), at t1 = 0.
    pub fn open() -> Self {
        let d = L0 - L1;
        let t2 = ((L2 * L2 + d * d - L3 * L3) / (2.0 * L2 * d)).acos();
        let t3 = (L2 * t2.sin()).atan2(L2 * t2.cos() - d);
        State {
            t: [t2, t3],
            rate: [0.0; 2],
        }
    }
}

/// State with the angles carried as points of the circle from solve to solve: no trigonometry but the crank's.
#[derive(Clone, Copy, Debug)]
pub struct Carried {
    pub t: [Circle; 2],
    pub rate: [f64; 2],
}

impl From<State> for Carried {
    fn from(state: State) -> Self {
        Carried {
            t: state.t.map(Circle::at::<super::Std>),
            rate: state.rate,
        }
    }
}

/// Newton from the state; inputs: the crank angle.
#[inline]
pub fn solve<T: Trig>(state: &mut State, t1: f64) -> Report {
    let (report, _, moved) = newton(state.t.map(Circle::at::<T>), Circle::at::<T>(t1));
    *state = State {
        t: from_fn(|i| state.t[i] + moved[i]),
        rate: moved,
    };
    report
}

/// Newton from where the last move, made once more, leads.
#[inline]
pub fn solve_predicted<T: Trig>(state: &mut State, t1: f64) -> Report {
    let t: [f64; 2] = from_fn(|i| state.t[i] + state.rate[i]);
    let (report, _, moved) = newton(t.map(Circle::at::<T>), Circle::at::<T>(t1));
    *state = State {
        t: from_fn(|i| t[i] + moved[i]),
        rate: from_fn(|i| state.rate[i] + moved[i]),
    };
    report
}

/// [`solve`] on carried circles.
#[inline]
pub fn track<T: Trig>(state: &mut Carried, t1: f64) -> Report {
    let (report, t, moved) = newton(state.t, Circle::at::<T>(t1));
    *state = Carried {
        t: t.map(Circle::renormalised),
        rate: moved,
    };
    report
}

/// [`solve_predicted`] on carried circles.
#[inline]
pub fn track_predicted<T: Trig>(state: &mut Carried, t1: f64) -> Report {
    let (predicted, _) = turn(state.t, state.rate);
    let (report, t, moved) = newton(predicted, Circle::at::<T>(t1));
    *state = Carried {
        t: t.map(Circle::renormalised),
        rate: from_fn(|i| state.rate[i] + moved[i]),
    };
    report
}

#[inline(always)]
fn newton(mut t: [Circle; 2], crank: Circle) -> (Report, [Circle; 2], [f64; 2]) {
    let reach = [L1 * crank.cos - L0, L1 * crank.sin];
    let mut moved = [0.0; 2];
    let mut steps = 0;
    loop {
        let (a, b) = (
            [L2 * t[0].cos, L2 * t[0].sin],
            [L3 * t[1].cos, L3 * t[1].sin],
        );
        let f = [reach[0] + a[0] - b[0], reach[1] + a[1] - b[1]];
        let residual = if f[0].abs() > f[1].abs() {
            f[0].abs()
        } else {
            f[1].abs()
        };
        let converged = residual <= TOLERANCE;
        if converged || steps == MAX_STEPS {
            return (
                Report {
                    steps,
                    residual,
                    converged,
                },
                t,
                moved,
            );
        }
        // J = [-a₁ b₁; a₀ -b₀] by Cramer's rule: one division, and no pivot to look for
        let inverse = 1.0 / (a[1] * b[0] - b[1] * a[0]);
        let step = [
            (f[0] * b[0] + f[1] * b[1]) * inverse,
            (f[0] * a[0] + f[1] * a[1]) * inverse,
        ];
        let (turned, turns) = turn(t, step);
        t = turned;
        moved = from_fn(|i| moved[i] + turns[i]);
        steps += 1;
    }
}
