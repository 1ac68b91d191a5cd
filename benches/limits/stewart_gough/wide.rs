//! Newton's method with the six legs side by side in vector registers (AVX2 and FMA, detected at run time),
//! and Gauss–Jordan elimination in the legs' own order: it needs no back substitution.

use std::arch::x86_64::*;

use super::{BASE, MAX_STEPS, PLATFORM, Report, State, TOLERANCE};

pub fn available() -> bool {
    is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")
}

/// Coordinate k of the six points, in eight lanes: the last two repeat the first leg and change nothing.
const fn lanes(points: &[[f64; 3]; 6], k: usize) -> [f64; 8] {
    [
        points[0][k],
        points[1][k],
        points[2][k],
        points[3][k],
        points[4][k],
        points[5][k],
        points[0][k],
        points[0][k],
    ]
}

const B: [[f64; 8]; 3] = [
    lanes(&PLATFORM, 0),
    lanes(&PLATFORM, 1),
    lanes(&PLATFORM, 2),
];
const A: [[f64; 8]; 3] = [lanes(&BASE, 0), lanes(&BASE, 1), lanes(&BASE, 2)];

type Lanes = [__m256d; 2];

#[inline]
#[target_feature(enable = "avx2,fma")]
fn load(x: &[f64; 8]) -> Lanes {
    // SAFETY: both halves lie in x, and the load asks for no alignment
    unsafe {
        [
            _mm256_loadu_pd(x.as_ptr()),
            _mm256_loadu_pd(x.as_ptr().add(4)),
        ]
    }
}

/// Newton from the state; inputs: the leg lengths.
#[inline]
#[target_feature(enable = "avx2,fma")]
pub fn solve(state: &mut State, legs: [f64; 6]) -> Report {
    let [l0, l1, l2, l3, l4, l5] = legs;
    let l: Lanes = [_mm256_set_pd(l3, l2, l1, l0), _mm256_set_pd(l0, l0, l5, l4)];
    let half = _mm256_set1_pd(0.5);
    // | |v| - l | = |l² - |v|²| / (|v| + l) < 2 |f| / l
    let admitted = l.map(|l| _mm256_mul_pd(l, _mm256_set1_pd(0.5 * TOLERANCE)));
    let sign = _mm256_set1_pd(-0.0);
    let mut pose = state.pose;
    let mut rate = [0.0; 6];
    let mut steps = 0;
    loop {
        let r = pose.rotation();
        let s: [Lanes; 3] = std::array::from_fn(|k| {
            let (x, y, z) = (load(&B[0]), load(&B[1]), load(&B[2]));
            let [rx, ry, rz] = r[k].map(|r| _mm256_set1_pd(r));
            std::array::from_fn(|h| {
                _mm256_fmadd_pd(rx, x[h], _mm256_fmadd_pd(ry, y[h], _mm256_mul_pd(rz, z[h])))
            })
        });
        let v: [Lanes; 3] = std::array::from_fn(|k| {
            let (a, p) = (load(&A[k]), _mm256_set1_pd(pose.p[k]));
            std::array::from_fn(|h| _mm256_add_pd(s[k][h], _mm256_sub_pd(p, a[h])))
        });
        let f: Lanes = std::array::from_fn(|h| {
            let g = _mm256_fnmadd_pd(v[0][h], v[0][h], _mm256_mul_pd(l[h], l[h]));
            let g = _mm256_fnmadd_pd(v[1][h], v[1][h], g);
            _mm256_mul_pd(half, _mm256_fnmadd_pd(v[2][h], v[2][h], g))
        });
        // a leg that is not a number compares false
        let within =
            |h: usize| _mm256_cmp_pd::<_CMP_LE_OQ>(_mm256_andnot_pd(sign, f[h]), admitted[h]);
        let converged = _mm256_movemask_pd(_mm256_and_pd(within(0), within(1))) == 0b1111;
        if converged || steps == MAX_STEPS {
            *state = State { pose, rate };
            let bound =
                |h: usize| _mm256_div_pd(_mm256_andnot_pd(sign, f[h]), _mm256_mul_pd(l[h], half));
            let m = _mm256_max_pd(bound(0), bound(1));
            let m = _mm_max_pd(_mm256_castpd256_pd128(m), _mm256_extractf128_pd::<1>(m));
            let residual = _mm_cvtsd_f64(_mm_max_sd(m, _mm_unpackhi_pd(m, m)));
            return Report {
                steps,
                residual,
                converged,
            };
        }
        let cross = |i: usize, j: usize| -> Lanes {
            std::array::from_fn(|h| {
                _mm256_fmsub_pd(s[i][h], v[j][h], _mm256_mul_pd(s[j][h], v[i][h]))
            })
        };
        let step = eliminate([v[0], v[1], v[2], cross(1, 2), cross(2, 0), cross(0, 1), f]);
        pose.retract(&step);
        for i in 0..6 {
            rate[i] += step[i];
        }
        steps += 1;
    }
}

/// Newton from where the last move, made once more, leads.
#[inline]
#[target_feature(enable = "avx2,fma")]
pub fn solve_predicted(state: &mut State, legs: [f64; 6]) -> Report {
    let rate = state.rate;
    state.pose.retract(&rate);
    let report = solve(state, legs);
    for i in 0..6 {
        state.rate[i] += rate[i];
    }
    report
}

/// Columns 0 to 5 are the matrix, 6 the right-hand side; a row is a lane.
#[inline]
#[target_feature(enable = "avx2,fma")]
fn eliminate(mut c: [Lanes; 7]) -> [f64; 6] {
    // Column k becomes unit vector k: the factor (a_ik - δ_ik) / a_kk also scales row k itself.
    macro_rules! column {
        ($k:literal, $half:literal, $lane:literal, $e:expr) => {
            let inverse = _mm256_div_pd(
                _mm256_set1_pd(1.0),
                _mm256_permute4x64_pd::<{ $lane * 0x55 }>(c[$k][$half]),
            );
            let e: Lanes = $e;
            let factor: Lanes =
                std::array::from_fn(|h| _mm256_mul_pd(_mm256_sub_pd(c[$k][h], e[h]), inverse));
            for j in $k + 1..7 {
                let row = _mm256_permute4x64_pd::<{ $lane * 0x55 }>(c[j][$half]);
                for h in 0..2 {
                    c[j][h] = _mm256_fnmadd_pd(factor[h], row, c[j][h]);
                }
            }
        };
    }
    let o = _mm256_setzero_pd();
    column!(0, 0, 0, [_mm256_set_pd(0.0, 0.0, 0.0, 1.0), o]);
    column!(1, 0, 1, [_mm256_set_pd(0.0, 0.0, 1.0, 0.0), o]);
    column!(2, 0, 2, [_mm256_set_pd(0.0, 1.0, 0.0, 0.0), o]);
    column!(3, 0, 3, [_mm256_set_pd(1.0, 0.0, 0.0, 0.0), o]);
    column!(4, 1, 0, [o, _mm256_set_pd(0.0, 0.0, 0.0, 1.0)]);
    column!(5, 1, 1, [o, _mm256_set_pd(0.0, 0.0, 1.0, 0.0)]);
    let mut x = [0.0; 8];
    // SAFETY: both halves lie in x, and the store asks for no alignment
    unsafe {
        _mm256_storeu_pd(x.as_mut_ptr(), c[6][0]);
        _mm256_storeu_pd(x.as_mut_ptr().add(4), c[6][1]);
    }
    [x[0], x[1], x[2], x[3], x[4], x[5]]
}
