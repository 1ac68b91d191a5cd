//! The limits: for each of three mechanisms the fastest Newton solver we can write by hand for that
//! one mechanism, in its fewest unknowns, on the stack, and all assemblies of a truss. The general engine is measured against these.
//!
//! Every solver counts a step as one linear solve, and reports the residual *at the state it returns*.

// not every bench uses every limit; indices read like the formulas; fdlibm's constants as fdlibm prints them
#![allow(dead_code, clippy::needless_range_loop, clippy::excessive_precision)]

use std::array::from_fn;

pub mod four_bar;
pub mod lanes;
pub mod stewart_gough;
pub mod three_rps;
pub mod trajectories;
pub mod truss;

/// Largest admitted residual: lengths for the 4-bar and the Stewart–Gough platform, squared lengths for the 3-RPS.
pub const TOLERANCE: f64 = 1e-12;
pub const MAX_STEPS: u32 = 50;

/// Outcome of one solve.
#[derive(Clone, Copy, Debug)]
pub struct Report {
    pub steps: u32,
    pub residual: f64,
    pub converged: bool,
}

/// Outcome of a set of solves.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    pub solves: usize,
    pub converged: usize,
    /// Steps summed over the solves that converged.
    pub steps: u64,
    /// Largest residual among the solves that converged.
    pub worst: f64,
}

impl Tally {
    pub fn of(reports: impl IntoIterator<Item = Report>) -> Self {
        let mut tally = Tally::default();
        for report in reports {
            tally.solves += 1;
            if report.converged {
                tally.converged += 1;
                tally.steps += u64::from(report.steps);
                tally.worst = tally.worst.max(report.residual);
            }
        }
        tally
    }

    /// Mean steps of the solves that converged.
    pub fn mean_steps(&self) -> f64 {
        self.steps as f64 / self.converged as f64
    }

    /// Share of solves that converged, in [0, 1].
    pub fn rate(&self) -> f64 {
        self.converged as f64 / self.solves as f64
    }
}

/// Source of sines and cosines. An angle enters each solve through one call.
pub trait Trig {
    /// (sin x, cos x)
    fn sin_cos(x: f64) -> (f64, f64);
}

/// The standard library (the platform's libm).
pub struct Std;
/// pxfm, correctly rounded.
pub struct Pxfm;
/// Written out here so that it inlines: Cody–Waite reduction and fdlibm's kernel polynomials.
pub struct Inline;

impl Trig for Std {
    #[inline(always)]
    fn sin_cos(x: f64) -> (f64, f64) {
        x.sin_cos()
    }
}

impl Trig for Pxfm {
    #[inline(always)]
    fn sin_cos(x: f64) -> (f64, f64) {
        pxfm::f_sincos(x)
    }
}

impl Trig for Inline {
    /// Within 2.3e-16 of the standard library on four million points of |x| < 1e5; no branch.
    #[inline(always)]
    fn sin_cos(x: f64) -> (f64, f64) {
        // adding 1.5·2⁵² rounds to the nearest integer and leaves it in the low bits
        const ROUND: f64 = 6_755_399_441_055_744.0;
        const PIO2_1: f64 = f64::from_bits(0x3ff9_21fb_5440_0000);
        const PIO2_2: f64 = f64::from_bits(0x3dd0_b461_1a60_0000);
        const PIO2_3: f64 = f64::from_bits(0x3ba3_198a_2e03_7073);
        let shifted = x * std::f64::consts::FRAC_2_PI + ROUND;
        let quadrant = shifted.to_bits();
        let k = shifted - ROUND;
        let r = ((x - k * PIO2_1) - k * PIO2_2) - k * PIO2_3;
        let z = r * r;
        let w = z * z;
        let s = r + r
            * z
            * (-0.166_666_666_666_666_324_348
                + z * 8.333_333_333_322_489_461_24e-3
                + w * ((-1.984_126_982_985_794_931_34e-4 + z * 2.755_731_370_707_006_767_89e-6)
                    + w * (-2.505_076_025_340_686_341_95e-8
                        + z * 1.589_690_995_211_550_102_21e-10)));
        let c = 1.0 - 0.5 * z
            + w * ((4.166_666_666_666_660_190_37e-2 - z * 1.388_888_888_887_410_957_49e-3)
                + w * ((2.480_158_728_947_672_941_78e-5 - z * 2.755_731_435_139_066_330_35e-7)
                    + w * (2.087_572_321_298_174_827_90e-9
                        - z * 1.135_964_755_778_819_482_65e-11)));
        // odd quadrants exchange the two; by masks, so that several angles share vector registers
        let (s, c) = (s.to_bits(), c.to_bits());
        let exchange = (s ^ c) & (quadrant & 1).wrapping_neg();
        let (s, c) = (s ^ exchange, c ^ exchange);
        let sin_sign = (quadrant & 2) << 62;
        let cos_sign = (quadrant.wrapping_add(1) & 2) << 62;
        (f64::from_bits(s ^ sin_sign), f64::from_bits(c ^ cos_sign))
    }
}

/// An angle as a point of the unit circle. Within a solve angles move by small turns, which need no trigonometry.
#[derive(Clone, Copy, Debug)]
pub struct Circle {
    pub cos: f64,
    pub sin: f64,
}

impl Circle {
    #[inline(always)]
    pub fn at<T: Trig>(angle: f64) -> Self {
        let (sin, cos) = T::sin_cos(angle);
        Circle { cos, sin }
    }

    /// Turned by `delta`, |delta| < 1/64.
    #[inline(always)]
    fn turned_near(self, delta: f64) -> Self {
        let z = delta * delta;
        let s = delta - delta * z * (1.0 / 6.0 - z * (1.0 / 120.0));
        let c = z * (0.5 - z * (1.0 / 24.0 - z * (1.0 / 720.0))); // 1 - cos
        Circle {
            cos: self.cos - (self.cos * c + self.sin * s),
            sin: self.sin - (self.sin * c - self.cos * s),
        }
    }

    // out of line and by value: taking a pointer here would keep every circle in memory on the near path too
    #[cold]
    #[inline(never)]
    fn turned_far(self, delta: f64) -> (Self, f64) {
        use std::f64::consts::TAU;
        let delta = delta - TAU * (delta / TAU).round();
        let (s, c) = Inline::sin_cos(delta);
        (
            Circle {
                cos: self.cos * c - self.sin * s,
                sin: self.sin * c + self.cos * s,
            },
            delta,
        )
    }

    /// One Newton step of 1/√x back to the circle: a carried point does not drift off it.
    #[inline(always)]
    #[must_use]
    pub fn renormalised(self) -> Self {
        let k = 1.5 - 0.5 * (self.cos * self.cos + self.sin * self.sin);
        Circle {
            cos: self.cos * k,
            sin: self.sin * k,
        }
    }

    pub fn angle(&self) -> f64 {
        self.sin.atan2(self.cos)
    }
}

/// Turns all angles by their `deltas`. Returns the turns made too: the deltas less their whole revolutions.
#[inline(always)]
pub fn turn<const N: usize>(angles: [Circle; N], deltas: [f64; N]) -> ([Circle; N], [f64; N]) {
    if deltas.iter().all(|delta| delta.abs() < 1.0 / 64.0) {
        (from_fn(|i| angles[i].turned_near(deltas[i])), deltas)
    } else {
        let far: [_; N] = from_fn(|i| angles[i].turned_far(deltas[i]));
        (far.map(|(angle, _)| angle), far.map(|(_, delta)| delta))
    }
}

/// Solves a·x = b in place by Gaussian elimination with partial pivoting; x replaces b. False if a pivot is zero.
#[inline(always)]
pub fn eliminate<const N: usize>(a: &mut [[f64; N]; N], b: &mut [f64; N]) -> bool {
    let mut inverse = [0.0; N];
    for k in 0..N {
        for i in k + 1..N {
            if a[i][k].abs() > a[k][k].abs() {
                a.swap(k, i);
                b.swap(k, i);
            }
        }
        if a[k][k] == 0.0 {
            return false;
        }
        eliminate_column(a, b, &mut inverse, k);
    }
    substitute_back(a, b, &inverse);
    true
}

/// Gaussian elimination without pivoting, for a system whose row order is known to be good, and whose result is
/// checked.
#[inline(always)]
pub fn eliminate_in_order<const N: usize>(a: &mut [[f64; N]; N], b: &mut [f64; N]) {
    let mut inverse = [0.0; N];
    for k in 0..N {
        eliminate_column(a, b, &mut inverse, k);
    }
    substitute_back(a, b, &inverse);
}

#[inline(always)]
fn eliminate_column<const N: usize>(
    a: &mut [[f64; N]; N],
    b: &mut [f64; N],
    inverse: &mut [f64; N],
    k: usize,
) {
    inverse[k] = 1.0 / a[k][k];
    for i in k + 1..N {
        let factor = a[i][k] * inverse[k];
        for j in k + 1..N {
            a[i][j] -= factor * a[k][j];
        }
        b[i] -= factor * b[k];
    }
}

#[inline(always)]
fn substitute_back<const N: usize>(a: &[[f64; N]; N], b: &mut [f64; N], inverse: &[f64; N]) {
    for k in (0..N).rev() {
        let mut sum = b[k];
        for j in k + 1..N {
            sum -= a[k][j] * b[j];
        }
        b[k] = sum * inverse[k];
    }
}
