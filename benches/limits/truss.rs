//! All 126 assemblies of the 13-link truss (`tests/data/truss_13.ron`) from nothing: unknown the directions z = e^{iθ} of six
//! ternary links, with their conjugates 1/z. Monodromy over random complex dimensions, the method of Runge and Kutta of
//! order four along each way, Newton, and the Jacobian, which couples each link with the next, in one pass.

use std::f64::consts::TAU;

use linkwork::number::Complex;

type C = Complex<f64>;

/// Number of its solutions.
pub const COUNT: usize = 126;

/// Ground pivots with their conjugates, sides, third corners with their conjugates, squared lengths of bars.
#[derive(Clone, Copy)]
struct Member([[C; 6]; 6]);

type Point = [C; 6];

/// Pivots, sides and the two other sides of each triangle, bars.
const PIVOTS: [[f64; 2]; 6] = [
    [0.0, 0.0],
    [3.1, -2.2],
    [6.4, -1.3],
    [7.2, 2.1],
    [4.6, 4.4],
    [0.9, 3.4],
];
const SIDES: [[f64; 3]; 6] = [
    [4.1, 5.2, 6.0],
    [3.9, 5.6, 5.1],
    [4.4, 4.8, 6.3],
    [4.0, 6.1, 5.0],
    [4.7, 5.0, 5.5],
    [4.2, 5.9, 5.8],
];
const BARS: [f64; 6] = [5.3, 4.9, 5.6, 5.1, 5.8, 4.7];

impl Member {
    fn own() -> Self {
        let mut own = [[C::new(0.0, 0.0); 6]; 6];
        for j in 0..6 {
            let p = C::new(PIVOTS[j][0], PIVOTS[j][1]);
            let [a, q, s] = SIDES[j];
            let u = (a * a + s * s - q * q) / (2.0 * a);
            let c = C::new(u, (s * s - u * u).sqrt());
            let column = [
                p,
                p.conj(),
                C::new(a, 0.0),
                c,
                c.conj(),
                C::new(BARS[j] * BARS[j], 0.0),
            ];
            (0..6).for_each(|k| own[k][j] = column[k]);
        }
        Member(own)
    }

    /// With random factors about 1.
    fn random(random: &mut impl FnMut() -> f64) -> Self {
        let mut other = Member::own();
        for x in other.0.iter_mut().flatten() {
            *x += C::new(random() - 0.5, random() - 0.5) * (0.8 * x.norm().max(1.0));
        }
        other
    }

    fn at(&self, to: &Member, s: f64) -> Member {
        let mut at = *self;
        for (x, to) in at.0.iter_mut().flatten().zip(to.0.iter().flatten()) {
            *x += (*to - *x) * s;
        }
        at
    }
}

/// Residuals, their slopes by the angles of the link and of the next, and their rates while dimensions change.
fn linearise(m: &Member, change: &Member, z: &Point) -> [[C; 6]; 4] {
    let [p, pc, a, c, cc, b] = &m.0;
    let [dp, dpc, da, dc, dcc, db] = &change.0;
    let i = C::new(0.0, 1.0);
    let w = z.map(|z| z.inv());
    let mut out = [[C::new(0.0, 0.0); 6]; 4];
    for j in 0..6 {
        let k = (j + 1) % 6;
        let d = p[j] + a[j] * z[j] - p[k] - c[k] * z[k];
        let e = pc[j] + a[j] * w[j] - pc[k] - cc[k] * w[k];
        let dd = dp[j] + da[j] * z[j] - dp[k] - dc[k] * z[k];
        let de = dpc[j] + da[j] * w[j] - dpc[k] - dcc[k] * w[k];
        out[0][j] = d * e - b[j];
        out[1][j] = i * a[j] * (z[j] * e - w[j] * d);
        out[2][j] = i * (cc[k] * w[k] * d - c[k] * z[k] * e);
        out[3][j] = d * de + dd * e - db[j];
    }
    out
}

/// x with α x + β x_next = r, link by link round the ring.
fn solve([alpha, beta, r]: [&[C; 6]; 3]) -> Point {
    let (mut a, mut b) = ([C::new(0.0, 0.0); 7], [C::new(1.0, 0.0); 7]);
    for j in 0..6 {
        let inverse = beta[j].inv();
        a[j + 1] = (r[j] - alpha[j] * a[j]) * inverse;
        b[j + 1] = -alpha[j] * b[j] * inverse;
    }
    let first = a[6] / (C::new(1.0, 0.0) - b[6]);
    std::array::from_fn(|j| a[j] + b[j] * first)
}

fn turned(z: &Point, angles: &Point, factor: f64) -> Point {
    let i = C::new(0.0, factor);
    std::array::from_fn(|j| z[j] * (i * angles[j]).exp())
}

fn largest(x: &Point) -> f64 {
    x.iter().map(|x| x.norm_sqr()).fold(0.0, f64::max).sqrt()
}

/// One path, with the steps it took; `None` if it is lost.
fn track(from: &Member, to: &Member, z: &Point, steps: &mut usize) -> Option<Point> {
    let still = Member([[C::new(0.0, 0.0); 6]; 6]);
    let mut change = *to;
    for (x, from) in change.0.iter_mut().flatten().zip(from.0.iter().flatten()) {
        *x -= *from;
    }
    let velocity = |s: f64, z: &Point| {
        let [_, alpha, beta, rate] = linearise(&from.at(to, s), &change, z);
        solve([&alpha, &beta, &rate.map(|x| -x)])
    };
    let (mut s, mut length, mut z) = (0.0f64, 0.05f64, *z);
    while s < 1.0 {
        let h = length.min(1.0 - s);
        let k1 = velocity(s, &z);
        let k2 = velocity(s + 0.5 * h, &turned(&z, &k1, 0.5 * h));
        let k3 = velocity(s + 0.5 * h, &turned(&z, &k2, 0.5 * h));
        let k4 = velocity(s + h, &turned(&z, &k3, h));
        let sum = std::array::from_fn(|j| k1[j] + (k2[j] + k3[j]) * 2.0 + k4[j]);
        let mut next = turned(&z, &sum, h / 6.0);
        let member = from.at(to, s + h);
        let newton = |next: &mut Point| {
            let [residual, alpha, beta, _] = linearise(&member, &still, next);
            let step = solve([&alpha, &beta, &residual]);
            *next = turned(next, &step, -1.0);
            largest(&step)
        };
        let first = newton(&mut next);
        let second = newton(&mut next);
        *steps += 1;
        if first < 1e-3 && second < 0.01 * first.max(1e-10) {
            (s, z) = (s + h, next);
            length = h * if first < 1e-5 { 2.0 } else { 1.0 };
        } else {
            length = 0.4 * h;
        }
        if length < 1e-7 {
            return None;
        }
    }
    Some(z)
}

/// All solutions of the truss itself, real and complex, with the paths and steps that took.
pub fn all(seed: u64) -> (Vec<Point>, usize, usize) {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    // any directions are a solution for bars of some lengths
    let mut base = Member::random(&mut random);
    let z: Point = std::array::from_fn(|_| C::from_polar(0.5 + random(), TAU * random()));
    let [gaps, ..] = linearise(&base, &base, &z);
    (0..6).for_each(|j| base.0[5][j] += gaps[j]);
    let (mut known, mut paths, mut steps) = (vec![z], 0, 0);
    while known.len() < COUNT {
        let corners = [
            base,
            Member::random(&mut random),
            Member::random(&mut random),
            base,
        ];
        for start in known.clone() {
            let mut at = Some(start);
            for way in corners.windows(2) {
                at = at.and_then(|z| track(&way[0], &way[1], &z, &mut steps));
                paths += 1;
            }
            let near = |z: &Point, y: &Point| {
                z.iter()
                    .zip(y)
                    .all(|(z, y)| (z - y).norm() < 1e-6 * z.norm())
            };
            if let Some(z) = at.filter(|z| !known.iter().any(|y| near(z, y))) {
                known.push(z);
            }
        }
    }
    paths += known.len();
    let own = Member::own();
    let ends = known
        .iter()
        .filter_map(|z| track(&base, &own, z, &mut steps));
    (ends.collect(), paths, steps)
}
