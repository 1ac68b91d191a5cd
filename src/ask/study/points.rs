//! Points of a study: each by its number alone, so that any machine finds any of them.

use std::f64::consts::SQRT_2;

/// Points at which quantities are evaluated.
#[derive(Clone, Debug, PartialEq)]
pub enum Points {
    /// Every combination of so many equally spaced values along each range, ends included; the last varies fastest. A
    /// range with one value has it in its middle.
    Grid(Vec<usize>),
    /// Points of a Latin hypercube: each of as many equal parts of each range has one, at random within it (McKay,
    /// Beckman and
    /// Conover 1979).
    LatinHypercube(usize),
    /// Points of Sobol's sequence, without its first, the corner. They fill the box evenly whatever their number.
    Sobol(usize),
    /// The values themselves.
    Given(Vec<Vec<f64>>),
}

/// Distribution of a varied value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spread {
    /// Evenly from one value to another.
    Even(f64, f64),
    /// Normally about a value, with a standard deviation.
    Normal(f64, f64),
}

impl Spread {
    /// The value below which this part of all lies.
    fn at(self, part: f64) -> f64 {
        match self {
            Spread::Even(_, to) if part == 1.0 => to,
            Spread::Even(from, to) => from + part * (to - from),
            // Φ⁻¹(p) = -√2 erfc⁻¹(2p); a hypercube may begin in its corner
            Spread::Normal(mean, deviation) => {
                let part = part.max(2.0_f64.powi(-54));
                mean - deviation * SQRT_2 * pxfm::f_erfcinv(2.0 * part)
            }
        }
    }
}

/// Primitive polynomials (degree, inner coefficients) and first direction numbers of the dimensions after the first, from
/// Joe and Kuo, SIAM J. Sci. Comput. 30 (2008), table `new-joe-kuo-6`.
const JOE_KUO: [(u32, u32, &[u32]); 9] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
    (5, 4, &[1, 1, 5, 5, 5]),
    (5, 7, &[1, 1, 7, 11, 19]),
];

impl Points {
    /// Coordinates that Sobol's points have at most.
    pub const MOST_SOBOL: usize = JOE_KUO.len() + 1;

    /// Number of points; none if that cannot be counted.
    pub fn count(&self) -> Option<usize> {
        match self {
            Points::Grid(nodes) => nodes
                .iter()
                .try_fold(1, |all: usize, n| all.checked_mul(*n)),
            Points::LatinHypercube(count) | Points::Sobol(count) => Some(*count),
            Points::Given(rows) => Some(rows.len()),
        }
    }

    /// The point of a number, with a coordinate in each range.
    pub fn at(&self, index: usize, ranges: &[Spread], seed: u64) -> Vec<f64> {
        let ranges = ranges.iter().copied().enumerate();
        match self {
            Points::Given(rows) => rows[index].clone(),
            Points::Grid(nodes) => {
                let mut rest = index;
                let mut point: Vec<f64> = ranges
                    .rev()
                    .map(|(axis, range)| {
                        let node = rest % nodes[axis];
                        rest /= nodes[axis];
                        match nodes[axis] {
                            1 => range.at(0.5),
                            n => range.at(node as f64 / (n - 1) as f64),
                        }
                    })
                    .collect();
                point.reverse();
                point
            }
            Points::LatinHypercube(count) => ranges
                .map(|(axis, range)| {
                    let key = mixed(seed ^ mixed(axis as u64 + 1));
                    let cell = permuted(index as u64, *count as u64, key) as f64;
                    let within = mixed(key ^ mixed(index as u64)) >> 11;
                    range.at((cell + within as f64 * 2.0_f64.powi(-53)) / *count as f64)
                })
                .collect(),
            Points::Sobol(_) => ranges
                .map(|(axis, range)| range.at(sobol(axis, index as u64 + 1)))
                .collect(),
        }
    }
}

/// The part of the range of an axis at a number of the sequence, below 2³²; in the order of Gray's code (Antonov and Saleev).
fn sobol(axis: usize, index: u64) -> f64 {
    let gray = index ^ (index >> 1);
    let directions = directions(axis);
    let bits = (0..32).filter(|bit| gray >> bit & 1 == 1);
    let found = bits.fold(0, |all, bit| all ^ directions[bit]);
    f64::from(found) * 2.0_f64.powi(-32)
}

/// vₖ = mₖ 2³²⁻ᵏ, where mₖ = 2a₁mₖ₋₁ ⊕ 4a₂mₖ₋₂ ⊕ … ⊕ 2ˢmₖ₋ₛ ⊕ mₖ₋ₛ.
fn directions(axis: usize) -> [u32; 32] {
    let mut v = [0; 32];
    let Some((degree, inner, first)) = axis.checked_sub(1).map(|axis| JOE_KUO[axis]) else {
        return std::array::from_fn(|k| 1 << (31 - k));
    };
    let s = degree as usize;
    for k in 0..32 {
        v[k] = match first.get(k) {
            Some(m) => m << (31 - k),
            None => {
                let whole = v[k - s] ^ (v[k - s] >> s);
                (1..s).fold(whole, |all, i| {
                    all ^ ((inner >> (s - 1 - i) & 1) * v[k - i])
                })
            }
        };
    }
    v
}

/// A number that depends on all bits of another (Steele, Lea and Flood 2014, `splitmix64`).
fn mixed(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Image of a number below `count` in a permutation: rounds of Feistel over as many bits as are needed, repeated until
/// the result is below `count` (Black and Rogaway 2002).
fn permuted(index: u64, count: u64, key: u64) -> u64 {
    let half = (64 - count.saturating_sub(1).leading_zeros())
        .div_ceil(2)
        .max(1);
    let mask = (1 << half) - 1;
    let mut x = index;
    loop {
        let (mut left, mut right) = (x >> half, x & mask);
        for round in 0..4 {
            let turned = mixed(key ^ mixed(right ^ (round << 56))) & mask;
            (left, right) = (right, left ^ turned);
        }
        x = (left << half) | right;
        if x < count {
            return x;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: [Spread; 10] = [Spread::Even(0.0, 1.0); 10];

    #[test]
    fn each_part_of_each_range_has_one_point_of_a_latin_hypercube() {
        for count in [1, 2, 7, 100, 1000] {
            let points = Points::LatinHypercube(count);
            for axis in 0..3 {
                let part = |i| (points.at(i, &UNIT[..3], 5)[axis] * count as f64) as usize;
                let mut parts: Vec<usize> = (0..count).map(part).collect();
                assert!(count < 100 || !parts.is_sorted());
                parts.sort_unstable();
                assert_eq!(parts, (0..count).collect::<Vec<_>>());
            }
        }
        let (a, b) = (Points::LatinHypercube(9), Points::LatinHypercube(9));
        assert_eq!(a.at(4, &UNIT[..2], 5), b.at(4, &UNIT[..2], 5));
        assert_ne!(a.at(4, &UNIT[..2], 5), b.at(4, &UNIT[..2], 6));
    }

    /// Every box of the binary kind with the right volume has one point: a (0, m, 2)-net in the first two dimensions, and
    /// each dimension alone is one.
    #[test]
    fn sobols_points_are_evenly_spread() {
        let count = 256;
        let points = Points::Sobol(count);
        // with the corner that is left out
        let all = |i: usize| match i {
            0 => vec![0.0; 10],
            _ => points.at(i - 1, &UNIT, 1),
        };
        let all: Vec<Vec<f64>> = (0..count).map(all).collect();
        for axis in 0..10 {
            let mut parts: Vec<usize> = all.iter().map(|p| (p[axis] * 256.0) as usize).collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..count).collect::<Vec<_>>(), "axis {axis}");
        }
        for bits in 0..=8 {
            let (a, b) = (f64::from(1 << bits), f64::from(1 << (8 - bits)));
            let mut boxes: Vec<usize> = (all.iter())
                .map(|p| (p[0] * a) as usize * b as usize + (p[1] * b) as usize)
                .collect();
            boxes.sort_unstable();
            assert_eq!(boxes, (0..count).collect::<Vec<_>>());
        }
    }

    /// The values that Joe and Kuo print for their first dimensions.
    #[test]
    fn sobols_first_points_are_those_published() {
        let expected = [
            [0.5, 0.5, 0.5],
            [0.75, 0.25, 0.25],
            [0.25, 0.75, 0.75],
            [0.375, 0.375, 0.625],
            [0.875, 0.875, 0.125],
        ];
        for (i, expected) in expected.iter().enumerate() {
            assert_eq!(Points::Sobol(9).at(i, &UNIT[..3], 1), expected);
        }
    }

    #[test]
    fn a_grid_has_every_combination_with_the_ends() {
        let points = Points::Grid(vec![3, 1, 2]);
        let ranges = [(0.0, 0.3), (1.0, 3.0), (-1.0, 1.0)].map(|(from, to)| Spread::Even(from, to));
        let all: Vec<Vec<f64>> = (0..6).map(|i| points.at(i, &ranges, 1)).collect();
        let (middle, end) = (0.5 * 0.3, 0.3);
        let expected = [
            [0.0, 2.0, -1.0],
            [0.0, 2.0, 1.0],
            [middle, 2.0, -1.0],
            [middle, 2.0, 1.0],
            [end, 2.0, -1.0],
            [end, 2.0, 1.0],
        ];
        assert_eq!(all, expected);
        assert_eq!(Points::Grid(vec![usize::MAX, 3]).count(), None);
    }

    /// Quantiles of the standard normal distribution: Abramowitz and Stegun, table 26.5, and its symmetry.
    #[test]
    fn normal_deviations_have_the_quantiles_of_the_tables() {
        let normal = Spread::Normal(0.0, 1.0);
        for (part, expected) in [
            (0.5, 0.0),
            (0.25, -0.674_489_750_196_08),
            (0.975, 1.959_963_984_540_05),
            (0.999, 3.090_232_306_167_81),
        ] {
            assert!((normal.at(part) - expected).abs() < 1e-13, "{part}");
        }
        assert!(normal.at(0.0) < -8.0 && normal.at(0.0).is_finite());
        assert_eq!(Spread::Normal(3.0, 0.0).at(0.1), 3.0);
        let count = 4096;
        let squares = (0..count).map(|i| Points::Sobol(count).at(i, &[normal], 1)[0].powi(2));
        assert!((squares.sum::<f64>() / count as f64 - 1.0).abs() < 0.01);
    }
}
