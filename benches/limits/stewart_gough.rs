//! C: the 6-SPS Stewart–Gough platform. Unknown the platform's pose for given leg lengths, as a
//! translation and a small turn of a unit quaternion: |p + R b_i - a_i| = l_i.

#[cfg(target_arch = "x86_64")]
pub mod wide;

use super::{MAX_STEPS, Report, TOLERANCE, Tally, eliminate, eliminate_in_order};

pub const BASE: [[f64; 3]; 6] = [
    [0.9272, -0.3746, 0.05],
    [0.9356, 0.4767, -0.04],
    [-0.1182, 0.9628, 0.08],
    [-0.8456, 0.5704, -0.06],
    [-0.7782, -0.5449, 0.03],
    [-0.1267, -1.0322, -0.07],
];
pub const PLATFORM: [[f64; 3]; 6] = [
    [0.4413, -0.3448, -0.03],
    [0.4334, 0.3386, 0.03],
    [0.0907, 0.5729, -0.05],
    [-0.4821, 0.1948, 0.04],
    [-0.5247, -0.2227, -0.02],
    [0.0658, -0.536, 0.06],
];

/// The platform's pose in the base.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    pub p: [f64; 3],
    /// Unit quaternion, scalar first.
    pub q: [f64; 4],
}

impl Pose {
    pub const HOME: Pose = Pose {
        p: [0.0, 0.0, 0.9],
        q: [1.0, 0.0, 0.0, 0.0],
    };

    /// From a translation and a rotation vector.
    pub fn new(p: [f64; 3], r: [f64; 3]) -> Self {
        let angle = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
        let k = if angle > 0.0 {
            (0.5 * angle).sin() / angle
        } else {
            0.5
        };
        Pose {
            p,
            q: [(0.5 * angle).cos(), k * r[0], k * r[1], k * r[2]],
        }
    }

    #[inline(always)]
    pub fn rotation(&self) -> [[f64; 3]; 3] {
        let [w, x, y, z] = self.q;
        let (x2, y2, z2) = (x + x, y + y, z + z);
        [
            [1.0 - (y * y2 + z * z2), x * y2 - w * z2, x * z2 + w * y2],
            [x * y2 + w * z2, 1.0 - (x * x2 + z * z2), y * z2 - w * x2],
            [x * z2 - w * y2, y * z2 + w * x2, 1.0 - (x * x2 + y * y2)],
        ]
    }

    /// Inverse kinematics: the leg lengths of this pose.
    pub fn legs(&self) -> [f64; 6] {
        let r = self.rotation();
        std::array::from_fn(|i| {
            let b = PLATFORM[i];
            let v: [f64; 3] = std::array::from_fn(|k| {
                self.p[k] + r[k][0] * b[0] + r[k][1] * b[1] + r[k][2] * b[2] - BASE[i][k]
            });
            (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
        })
    }

    /// Largest difference from another pose, over the translation and the rotation matrix.
    pub fn distance(&self, other: &Pose) -> f64 {
        let (r, s) = (self.rotation(), other.rotation());
        let turn = r.as_flattened().iter().zip(s.as_flattened());
        turn.chain(self.p.iter().zip(&other.p))
            .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
    }

    /// Moves by a translation and turns by a vector, through Cayley's map: (1 + t/2) q, normalised.
    #[inline(always)]
    fn retract(&mut self, step: &[f64; 6]) {
        for i in 0..3 {
            self.p[i] += step[i];
        }
        let [w, x, y, z] = self.q;
        let h = [0.5 * step[3], 0.5 * step[4], 0.5 * step[5]];
        let q = [
            w - (h[0] * x + h[1] * y + h[2] * z),
            x + h[0] * w + h[1] * z - h[2] * y,
            y + h[1] * w + h[2] * x - h[0] * z,
            z + h[2] * w + h[0] * y - h[1] * x,
        ];
        let k = 1.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
        self.q = q.map(|q| q * k);
    }
}

/// The pose, and the twist by which the last solve moved it.
#[derive(Clone, Copy, Debug)]
pub struct State {
    pub pose: Pose,
    pub rate: [f64; 6],
}

impl State {
    pub fn at(pose: Pose) -> Self {
        State {
            pose,
            rate: [0.0; 6],
        }
    }
}

/// Newton from the state; inputs: the leg lengths. Each step by elimination with partial pivoting.
#[inline]
pub fn solve(state: &mut State, legs: [f64; 6]) -> Report {
    newton::<true>(state, legs)
}

/// Newton from where the last move, made once more, leads.
#[inline]
pub fn solve_predicted(state: &mut State, legs: [f64; 6]) -> Report {
    predicted::<true>(state, legs)
}

/// [`solve`] without pivoting: the legs' order happens to be good along the trajectory.
#[inline]
pub fn solve_in_order(state: &mut State, legs: [f64; 6]) -> Report {
    newton::<false>(state, legs)
}

/// [`solve_predicted`] without pivoting.
#[inline]
pub fn solve_in_order_predicted(state: &mut State, legs: [f64; 6]) -> Report {
    predicted::<false>(state, legs)
}

#[inline(always)]
fn predicted<const PIVOT: bool>(state: &mut State, legs: [f64; 6]) -> Report {
    let rate = state.rate;
    state.pose.retract(&rate);
    let report = newton::<PIVOT>(state, legs);
    for i in 0..6 {
        state.rate[i] += rate[i];
    }
    report
}

#[inline(always)]
fn newton<const PIVOT: bool>(state: &mut State, legs: [f64; 6]) -> Report {
    state.rate = [0.0; 6];
    let mut steps = 0;
    loop {
        let r = state.pose.rotation();
        let p = state.pose.p;
        // half of l² - |v|²: rows v·δp + (Rb × v)·ω, and no square root
        let mut a = [[0.0; 6]; 6];
        let mut f = [0.0; 6];
        let (mut residual, mut sum) = (0.0, 0.0);
        for i in 0..6 {
            let b = PLATFORM[i];
            let s: [f64; 3] =
                std::array::from_fn(|k| r[k][0] * b[0] + r[k][1] * b[1] + r[k][2] * b[2]);
            let v: [f64; 3] = std::array::from_fn(|k| s[k] + (p[k] - BASE[i][k]));
            f[i] = 0.5 * (legs[i] * legs[i] - (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
            // | |v| - l | = |l² - |v|²| / (|v| + l) < 2 |f| / l
            let bound = 2.0 * f[i].abs() / legs[i];
            residual = if residual > bound { residual } else { bound };
            sum += f[i];
            a[i] = [
                v[0],
                v[1],
                v[2],
                s[1] * v[2] - s[2] * v[1],
                s[2] * v[0] - s[0] * v[2],
                s[0] * v[1] - s[1] * v[0],
            ];
        }
        // the maximum may pass over a leg that is not a number, the sum does not
        let converged = residual <= TOLERANCE && !sum.is_nan();
        if converged || steps == MAX_STEPS {
            return Report {
                steps,
                residual,
                converged,
            };
        }
        if !PIVOT {
            eliminate_in_order(&mut a, &mut f);
        } else if !eliminate(&mut a, &mut f) {
            return Report {
                steps,
                residual,
                converged,
            };
        }
        state.pose.retract(&f);
        for i in 0..6 {
            state.rate[i] += f[i];
        }
        steps += 1;
    }
}

/// One cold start: the pose that made the legs, its legs, and the pose to start from.
pub type Cold = (Pose, [f64; 6], Pose);

pub fn cold_starts(starts: &[Cold]) -> Tally {
    Tally::of(
        starts
            .iter()
            .map(|&(_, legs, start)| solve(&mut State::at(start), legs)),
    )
}

/// Number of cold starts that end in the pose that made the legs: another assembly is as good an answer.
pub fn cold_starts_at_truth(starts: &[Cold]) -> usize {
    let lands = |&&(truth, legs, start): &&Cold| {
        let mut state = State::at(start);
        solve(&mut state, legs).converged && state.pose.distance(&truth) < 1e-6
    };
    starts.iter().filter(lands).count()
}
