//! Newton for eight motions side by side, in the vector registers that the caller is compiled for: each solve begins
//! where differences of the last moves up to the third lead, and the steps that one motion needs are made by all.

use std::array::from_fn;
use std::ops::{Add, AddAssign, Mul, Sub};

use super::four_bar::{L0, L1, L2, L3};
use super::stewart_gough::{BASE, PLATFORM, Pose};
use super::{Inline, TOLERANCE, Trig};

pub const LANES: usize = 8;

/// A number for each motion.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Lanes(pub [f64; LANES]);

macro_rules! operator {
    ($trait:ident $name:ident $sign:tt) => {
        impl $trait for Lanes {
            type Output = Lanes;
            #[inline(always)]
            fn $name(self, other: Lanes) -> Lanes {
                Lanes(from_fn(|i| self.0[i] $sign other.0[i]))
            }
        }
    };
}

operator!(Add add +);
operator!(Sub sub -);
operator!(Mul mul *);

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Lanes) {
        *self = *self + other;
    }
}

impl Lanes {
    #[inline(always)]
    pub fn all(x: f64) -> Self {
        Lanes([x; LANES])
    }

    #[inline(always)]
    fn inverse(self) -> Self {
        Lanes(self.0.map(|x| 1.0 / x))
    }

    #[inline(always)]
    fn root(self) -> Self {
        Lanes(self.0.map(f64::sqrt))
    }

    #[inline(always)]
    fn size(self) -> Self {
        Lanes(self.0.map(f64::abs))
    }

    #[inline(always)]
    fn within(self, bound: f64) -> bool {
        let mut all = true;
        for x in self.0 {
            all &= x <= bound;
        }
        all
    }
}

/// Defines a function that follows rows in the widest registers of the processor.
macro_rules! follow {
    ($row:ty) => {
        /// Newton for row after row. False if a motion is lost.
        pub fn follow(&mut self, rows: &[$row]) -> bool {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
                fn avx512(of: &mut impl Solve<$row>, rows: &[$row]) -> bool {
                    rows.iter()
                        .fold(true, |solved, row| solved & of.solve(*row))
                }
                #[target_feature(enable = "avx2")]
                fn avx2(of: &mut impl Solve<$row>, rows: &[$row]) -> bool {
                    rows.iter()
                        .fold(true, |solved, row| solved & of.solve(*row))
                }
                // SAFETY: the processor has these instructions
                unsafe {
                    if is_x86_feature_detected!("avx512dq") && is_x86_feature_detected!("avx512vl")
                    {
                        return avx512(self, rows);
                    }
                    if is_x86_feature_detected!("avx2") {
                        return avx2(self, rows);
                    }
                }
            }
            rows.iter()
                .fold(true, |solved, row| solved & self.solve(*row))
        }
    };
}

trait Solve<R> {
    fn solve(&mut self, row: R) -> bool;
}

/// The differences of the latest moves.
#[derive(Clone, Copy, Debug)]
struct Moves([Lanes; 3]);

impl Moves {
    const NONE: Moves = Moves([Lanes([0.0; LANES]); 3]);

    #[inline(always)]
    fn next(&self) -> Lanes {
        self.0[0] + self.0[1] + self.0[2]
    }

    #[inline(always)]
    fn learn(&mut self, latest: Lanes) {
        let Moves([first, second, _]) = *self;
        let change = latest - first;
        *self = Moves([latest, change, change - second]);
    }
}

#[derive(Clone, Copy, Debug)]
struct Circles {
    cos: Lanes,
    sin: Lanes,
}

impl Circles {
    #[inline(always)]
    fn at(angle: Lanes) -> Self {
        let (mut cos, mut sin) = (angle, angle);
        for i in 0..LANES {
            (sin.0[i], cos.0[i]) = Inline::sin_cos(angle.0[i]);
        }
        Circles { cos, sin }
    }

    /// Turned by less than 1/64.
    #[inline(always)]
    fn turned(self, by: Lanes) -> Self {
        let all = Lanes::all;
        let z = by * by;
        let s = by - by * z * (all(1.0 / 6.0) - z * all(1.0 / 120.0));
        let c = z * (all(0.5) - z * (all(1.0 / 24.0) - z * all(1.0 / 720.0)));
        Circles {
            cos: self.cos - (self.cos * c + self.sin * s),
            sin: self.sin - (self.sin * c - self.cos * s),
        }
    }

    #[inline(always)]
    fn renormalised(self) -> Self {
        let k = Lanes::all(1.5) - Lanes::all(0.5) * (self.cos * self.cos + self.sin * self.sin);
        Circles {
            cos: self.cos * k,
            sin: self.sin * k,
        }
    }
}

/// A: coupler and rocker of eight 4-bars.
#[derive(Clone, Copy, Debug)]
pub struct FourBars {
    t: [Circles; 2],
    moves: [Moves; 2],
    begun: usize,
}

impl FourBars {
    pub fn at(t: [[f64; LANES]; 2]) -> Self {
        FourBars {
            t: t.map(|t| Circles::at(Lanes(t))),
            moves: [Moves::NONE; 2],
            begun: 0,
        }
    }

    follow!([f64; LANES]);

    /// Sines of coupler and rocker angles.
    pub fn sines(&self) -> [[f64; LANES]; 2] {
        self.t.map(|t| t.sin.0)
    }
}

impl Solve<[f64; LANES]> for FourBars {
    #[inline(always)]
    fn solve(&mut self, crank: [f64; LANES]) -> bool {
        let crank = Circles::at(Lanes(crank));
        let all = Lanes::all;
        let reach = [all(L1) * crank.cos - all(L0), all(L1) * crank.sin];
        let mut moved = match self.begun < 4 {
            true => [all(0.0); 2],
            false => self.moves.map(|moves| moves.next()),
        };
        let mut t: [Circles; 2] = from_fn(|i| self.t[i].turned(moved[i]));
        for _ in 0..8 {
            let a = [all(L2) * t[0].cos, all(L2) * t[0].sin];
            let b = [all(L3) * t[1].cos, all(L3) * t[1].sin];
            let f = [reach[0] + a[0] - b[0], reach[1] + a[1] - b[1]];
            if f[0].size().within(TOLERANCE) & f[1].size().within(TOLERANCE) {
                self.t = t.map(Circles::renormalised);
                for (moves, moved) in self.moves.iter_mut().zip(moved) {
                    moves.learn(moved);
                }
                self.begun += 1;
                return true;
            }
            let inverse = (a[1] * b[0] - b[1] * a[0]).inverse();
            let step = [
                (f[0] * b[0] + f[1] * b[1]) * inverse,
                (f[0] * a[0] + f[1] * a[1]) * inverse,
            ];
            t = from_fn(|i| t[i].turned(step[i]));
            moved = from_fn(|i| moved[i] + step[i]);
        }
        false
    }
}

/// C: eight Stewart–Gough platforms.
#[derive(Clone, Copy, Debug)]
pub struct Platforms {
    /// Position, then quaternion.
    x: [Lanes; 7],
    moves: [Moves; 7],
    begun: usize,
}

impl Platforms {
    pub fn at(poses: [Pose; LANES]) -> Self {
        let number = |i: usize| {
            Lanes(from_fn(|lane| match i {
                0..3 => poses[lane].p[i],
                _ => poses[lane].q[i - 3],
            }))
        };
        Platforms {
            x: from_fn(number),
            moves: [Moves::NONE; 7],
            begun: 0,
        }
    }

    pub fn pose(&self, lane: usize) -> Pose {
        Pose {
            p: from_fn(|i| self.x[i].0[lane]),
            q: from_fn(|i| self.x[i + 3].0[lane]),
        }
    }

    follow!([[f64; LANES]; 6]);
}

impl Solve<[[f64; LANES]; 6]> for Platforms {
    /// By elimination in the order of the legs.
    #[inline(always)]
    fn solve(&mut self, legs: [[f64; LANES]; 6]) -> bool {
        let all = Lanes::all;
        let mut x = self.x;
        if self.begun >= 4 {
            for i in 0..7 {
                x[i] += self.moves[i].next();
            }
            normalise(&mut x);
        }
        let squares: [Lanes; 6] = from_fn(|i| Lanes(legs[i]) * Lanes(legs[i]));
        let mut bounds = [all(0.0); 6];
        for (bound, legs) in bounds.iter_mut().zip(legs) {
            *bound = all(0.5 * TOLERANCE) * Lanes(legs);
        }
        for _ in 0..8 {
            let [px, py, pz, w, qx, qy, qz] = x;
            let p = [px, py, pz];
            let (x2, y2, z2) = (qx + qx, qy + qy, qz + qz);
            let one = all(1.0);
            let r = [
                [
                    one - (qy * y2 + qz * z2),
                    qx * y2 - w * z2,
                    qx * z2 + w * y2,
                ],
                [
                    qx * y2 + w * z2,
                    one - (qx * x2 + qz * z2),
                    qy * z2 - w * x2,
                ],
                [
                    qx * z2 - w * y2,
                    qy * z2 + w * x2,
                    one - (qx * x2 + qy * y2),
                ],
            ];
            let mut a = [[all(0.0); 6]; 6];
            let mut f = [all(0.0); 6];
            let mut closed = true;
            for i in 0..6 {
                let b = PLATFORM[i];
                let s: [Lanes; 3] =
                    from_fn(|k| r[k][0] * all(b[0]) + r[k][1] * all(b[1]) + r[k][2] * all(b[2]));
                let v: [Lanes; 3] = from_fn(|k| s[k] + (p[k] - all(BASE[i][k])));
                f[i] = all(0.5) * (squares[i] - (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
                for lane in 0..LANES {
                    closed &= f[i].0[lane].abs() <= bounds[i].0[lane];
                }
                a[i] = [
                    v[0],
                    v[1],
                    v[2],
                    s[1] * v[2] - s[2] * v[1],
                    s[2] * v[0] - s[0] * v[2],
                    s[0] * v[1] - s[1] * v[0],
                ];
            }
            if closed {
                for i in 0..7 {
                    self.moves[i].learn(x[i] - self.x[i]);
                }
                self.x = x;
                self.begun += 1;
                return true;
            }
            eliminate(&mut a, &mut f);
            for i in 0..3 {
                x[i] += f[i];
            }
            let h: [Lanes; 3] = from_fn(|i| all(0.5) * f[3 + i]);
            x[3] = w - (h[0] * qx + h[1] * qy + h[2] * qz);
            x[4] = qx + h[0] * w + h[1] * qz - h[2] * qy;
            x[5] = qy + h[1] * w + h[2] * qx - h[0] * qz;
            x[6] = qz + h[2] * w + h[0] * qy - h[1] * qx;
            normalise(&mut x);
        }
        false
    }
}

#[inline(always)]
fn normalise(x: &mut [Lanes; 7]) {
    let square = x[3] * x[3] + x[4] * x[4] + x[5] * x[5] + x[6] * x[6];
    let k = square.root().inverse();
    for q in &mut x[3..] {
        *q = *q * k;
    }
}

#[inline(always)]
fn eliminate(a: &mut [[Lanes; 6]; 6], b: &mut [Lanes; 6]) {
    let mut inverse = [Lanes::all(0.0); 6];
    for k in 0..6 {
        inverse[k] = a[k][k].inverse();
        for i in k + 1..6 {
            let factor = a[i][k] * inverse[k];
            for j in k + 1..6 {
                a[i][j] = a[i][j] - factor * a[k][j];
            }
            b[i] = b[i] - factor * b[k];
        }
    }
    for k in (0..6).rev() {
        let mut sum = b[k];
        for j in k + 1..6 {
            sum = sum - a[k][j] * b[j];
        }
        b[k] = sum * inverse[k];
    }
}
