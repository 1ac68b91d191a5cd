//! Four-bars whose coupler point passes through nine points: all of them.
//!
//! A vector (x, y) is written as the pair z = x + iy, z̄ = x − iy, which are independent over the complex numbers; all positions are
//! from the first of the points. A pin at x on the coupler keeps its distance from a pivot at a when the coupler has turned by T = exp iθ
//! and its point has moved by δ if αT + β/T + γ = 0 with α = x(δ̄ − ā), β = x̄(δ − a), γ = δδ̄ − δā − δ̄a + xā + x̄a. With those of the
//! second link, T is eliminated: (βγ' − β'γ)(γα' − γ'α) = (αβ' − α'β)², one equation for each further point (Wampler, Morgan and
//! Sommese 1992). Generic points have 8,652 solutions in 1,442 classes of six: three cognates (Roberts 1875), each with its links
//! exchanged. One of each class is stored for generic points and followed to any others.

use rand_pcg::Pcg64;

use crate::number::tolerance::ROUNDING;
use crate::number::{C, Number};
use crate::solve::monodromy::{ParametricSystem, followed, place, random};
use crate::solve::{Homotopy, Stage, Tracker, Watch, each};
use crate::system::SideRows;

/// A vector of the plane: x + iy and x − iy.
pub(super) type Z = [C; 2];

/// Equations, and coordinates of a four-bar.
const SIZE: usize = 8;

/// Points after the first.
type PointDisplacements = [Z; SIZE];

/// A four-bar by its coupler curve, in the first of its positions; all vectors are from the point on its coupler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FourBar {
    /// The pivot of each link on ground.
    pub pivots: [Z; 2],
    /// The pin of each link on the coupler.
    pub pins: [Z; 2],
}

fn of(f: impl Fn(usize) -> C) -> Z {
    [f(0), f(1)]
}

impl FourBar {
    fn read(x: &[C]) -> Self {
        let z = |i: usize| [x[i], x[i + 1]];
        FourBar {
            pivots: [z(0), z(4)],
            pins: [z(2), z(6)],
        }
    }

    /// With its links exchanged.
    pub fn exchanged(&self) -> Self {
        let ([a, b], [x, y]) = (self.pivots, self.pins);
        FourBar {
            pivots: [b, a],
            pins: [y, x],
        }
    }

    /// The cognate that shares the first pivot: its first link is parallel to the line from the first pin to the point, and its
    /// coupler and the third pivot are similar to this coupler (Roberts 1875).
    pub fn cognate(&self) -> Self {
        let ([a, b], [x, y]) = (self.pivots, self.pins);
        let ratio = of(|i| -x[i] / (y[i] - x[i]));
        FourBar {
            pivots: [a, of(|i| a[i] + (b[i] - a[i]) * ratio[i])],
            pins: [
                of(|i| a[i] - x[i]),
                of(|i| (a[i] - x[i]) * (C::from_f64(1.0) - ratio[i])),
            ],
        }
    }

    /// It and its cognates, each with its links in both orders.
    pub fn all(&self) -> [Self; 6] {
        let other = self.exchanged();
        let [first, second] = [self.cognate(), other.cognate()];
        let pairs = [self, &first, &second].map(|of| [*of, of.exchanged()]);
        [
            pairs[0][0],
            pairs[0][1],
            pairs[1][0],
            pairs[1][1],
            pairs[2][0],
            pairs[2][1],
        ]
    }

    /// The sum of the three pivots of all cognates: a number of the class.
    fn key(x: &[C]) -> Vec<C> {
        let of = Self::read(x);
        let third = of.cognate().pivots[1];
        let [a, b] = of.pivots;
        (0..2).map(|i| a[i] + b[i] + third[i]).collect()
    }

    /// T of the coupler where its point has moved by δ; `None` where it does not follow.
    pub fn turn(&self, move_: Z) -> Option<C> {
        let sides = self.sides(move_);
        let turn = LinkCoefficients::turn(&sides);
        turn.is_finite().then_some(turn)
    }

    fn sides(&self, d: Z) -> [LinkCoefficients; 2] {
        [0, 1].map(|i| LinkCoefficients::of(self.pivots[i], self.pins[i], d))
    }
}

/// α, β, γ of one link.
#[derive(Clone, Copy)]
struct LinkCoefficients([C; 3]);

impl LinkCoefficients {
    fn of(a: Z, x: Z, d: Z) -> Self {
        LinkCoefficients([
            x[0] * (d[1] - a[1]),
            x[1] * (d[0] - a[0]),
            d[0] * d[1] - d[0] * a[1] - d[1] * a[0] + x[0] * a[1] + x[1] * a[0],
        ])
    }

    /// N₁ = βγ' − β'γ, N₂ = γα' − γ'α, D = αβ' − α'β: T = N₁/D.
    fn parts([LinkCoefficients([a, b, c]), LinkCoefficients([e, f, g])]: &[Self; 2]) -> [C; 3] {
        [*b * *g - *f * *c, *c * *e - *g * *a, *a * *f - *e * *b]
    }

    fn turn(both: &[Self; 2]) -> C {
        let [first, _, det] = Self::parts(both);
        first / det
    }
}

/// True if D = 0, as where both links are one or both x or both x̄ vanish: such links meet the equations for any points.
fn alike(both: &[LinkCoefficients; 2]) -> bool {
    let size = |of: &LinkCoefficients| of.0.iter().map(|x| x.norm_sqr()).sum::<f64>();
    let det = LinkCoefficients::parts(both)[2];
    det.norm_sqr() <= ROUNDING * ROUNDING * size(&both[0]) * size(&both[1])
}

/// N₁N₂ − D² for one point, with its derivatives by the coordinates of the four-bar and by δ and δ̄.
fn row(x: &FourBar, d: Z) -> (C, [C; SIZE], Z) {
    let both = x.sides(d);
    let [n, m, det] = LinkCoefficients::parts(&both);
    let twice = det + det;
    let [LinkCoefficients([a, b, c]), LinkCoefficients([e, f, g])] = both;
    let by = [
        [-(n * g) - twice * f, g * m + twice * e, n * e - f * m],
        [n * c + twice * b, -(c * m) - twice * a, b * m - n * a],
    ];
    let mut row = [C::new(0.0, 0.0); SIZE];
    let mut moved = [C::new(0.0, 0.0); 2];
    for (i, [alpha, beta, gamma]) in by.into_iter().enumerate() {
        let ([a, abar], [x, xbar]) = (x.pivots[i], x.pins[i]);
        let [far, farbar] = [d[0] - a, d[1] - abar];
        row[4 * i] = gamma * (xbar - d[1]) - beta * xbar;
        row[4 * i + 1] = gamma * (x - d[0]) - alpha * x;
        row[4 * i + 2] = alpha * farbar + gamma * abar;
        row[4 * i + 3] = beta * far + gamma * a;
        moved[0] = moved[0] + beta * xbar + gamma * farbar;
        moved[1] = moved[1] + alpha * x + gamma * far;
    }
    (n * m - det * det, row, moved)
}

/// The straight way between the moves of two sets of points.
pub(super) struct PointsWay {
    from: PointDisplacements,
    rates: PointDisplacements,
    rows: SideRows<C>,
    /// The step that cancels the residual, and dx/ds.
    steps: [[C; SIZE]; 2],
}

impl PointsWay {
    fn linear(&mut self, s: C, x: &[C]) -> bool {
        let x = FourBar::read(x);
        self.rows.entries.clear();
        let mut all_alike = true;
        for (from, rate) in self.from.iter().zip(&self.rates) {
            let d = of(|i| from[i] + s * rate[i]);
            all_alike &= alike(&x.sides(d));
            let (value, row, moved) = row(&x, d);
            let size: f64 = row.iter().map(|x| x.norm_sqr()).sum();
            let scale = 1.0 / size.sqrt();
            let sides = [-value, -(moved[0] * rate[0] + moved[1] * rate[1])];
            let entries = row.into_iter().chain(sides).map(|x| x * scale);
            self.rows.entries.extend(entries);
        }
        if all_alike || !self.rows.eliminate(SIZE) {
            return false;
        }
        for (side, step) in self.steps.iter_mut().enumerate() {
            self.rows.back(SIZE, &[], SIZE + side, step);
        }
        self.steps.iter().flatten().all(|x| x.is_finite())
    }
}

impl Homotopy for PointsWay {
    fn settle(&self, _: &mut [C]) {}

    fn velocity(&mut self, s: C, x: &[C], out: &mut [C]) -> bool {
        let fine = self.linear(s, x);
        out.copy_from_slice(&self.steps[1]);
        fine
    }

    fn correct(&mut self, s: C, x: &mut [C]) -> f64 {
        if !self.linear(s, x) {
            return f64::NAN;
        }
        // relative to the largest coordinate, whose rounding is in all others
        let (mut largest, mut size) = (0.0f64, 1.0f64);
        for (x, step) in x.iter_mut().zip(&self.steps[0]) {
            *x += *step;
            largest = largest.max(step.norm_sqr());
            size = size.max(x.norm_sqr());
        }
        (largest / size).sqrt()
    }

    fn residual(&mut self, s: C, x: &[C]) -> f64 {
        match self.linear(s, x) {
            true => self.steps[0]
                .iter()
                .map(|x| x.norm_sqr())
                .fold(0.0, f64::max)
                .sqrt(),
            false => f64::NAN,
        }
    }

    fn velocity_again(&mut self, _: C, _: &[C], out: &mut [C]) -> bool {
        out.copy_from_slice(&self.steps[1]);
        true
    }
}

/// All sets of nine points; solutions are classes of six.
pub(super) struct NinePoints;

fn moves(values: &[C]) -> PointDisplacements {
    std::array::from_fn(|k| [values[2 * k], values[2 * k + 1]])
}

impl ParametricSystem for NinePoints {
    type Way<'f> = PointsWay;

    fn count(&self) -> usize {
        SIZE
    }

    fn way(&self, from: &[C], to: &[C]) -> PointsWay {
        let rates: Vec<C> = from.iter().zip(to).map(|(a, b)| b - a).collect();
        PointsWay {
            from: moves(from),
            rates: moves(&rates),
            rows: SideRows {
                width: SIZE + 2,
                entries: Vec::new(),
            },
            steps: [[C::new(0.0, 0.0); SIZE]; 2],
        }
    }

    fn member(&self, rng: &mut Pcg64) -> Vec<C> {
        (0..2 * SIZE).map(|_| random(rng)).collect()
    }

    fn key(&self, x: &[C]) -> Vec<C> {
        FourBar::key(x)
    }
}

/// Classes of four-bars for nine points.
#[derive(Clone, Debug, Default)]
pub(super) struct Classes {
    /// Those for generic points.
    pub generic: usize,
    /// Paths that arrived at these points.
    pub arrived: usize,
    /// Paths that went to infinity.
    pub at_infinity: usize,
    /// One of each class that was reached.
    pub different: Vec<FourBar>,
}

/// Points of generic nine, as δ and δ̄ of eight, and one four-bar of each class for them: 16 bytes for each number of the first, three
/// for each of the others.
const STORED: &[u8] = include_bytes!("nine_points.bin");

/// The stored points and classes.
fn stored() -> (Vec<C>, Vec<Vec<C>>) {
    const MEMBER: usize = 2 * SIZE * 16;
    let pairs =
        |all: Vec<f64>| -> Vec<C> { all.chunks_exact(2).map(|x| C::new(x[0], x[1])).collect() };
    let double = |bytes: &[u8]| bytes.try_into().map_or(0.0, f64::from_le_bytes);
    let short = |bytes: &[u8]| f64::from(f32::from_le_bytes([0, bytes[0], bytes[1], bytes[2]]));
    let (member, rest) = STORED.split_at(MEMBER.min(STORED.len()));
    let rest = pairs(rest.chunks_exact(3).map(short).collect());
    (
        pairs(member.chunks_exact(8).map(double).collect()),
        rest.chunks_exact(SIZE).map(<[C]>::to_vec).collect(),
    )
}

/// All classes for nine points, as far as paths arrive.
pub(super) fn classes(points: &[[f64; 2]; SIZE + 1], watch: &Watch) -> Classes {
    /// Ways from the stored points that are tried.
    const WAYS: usize = 5;
    let family = NinePoints;
    let (member, starts) = stored();
    let from_first = |p: &[f64; 2]| [p[0] - points[0][0], p[1] - points[0][1]];
    let squares = points.iter().map(from_first).map(|[x, y]| x * x + y * y);
    let size = (squares.sum::<f64>() / SIZE as f64).sqrt();
    let values = points[1..]
        .iter()
        .map(from_first)
        .flat_map(|[x, y]| [C::new(x, y), C::new(x, -y)].map(|z| z / size));
    let values: Vec<C> = values.collect();
    let tracker = Tracker {
        largest: 1e6,
        ..Tracker::default()
    };
    let mut rng = <Pcg64 as rand::SeedableRng>::seed_from_u64(9);
    let (mut known, mut different) = (Vec::new(), Vec::new());
    let mut all = Classes {
        generic: starts.len(),
        ..Classes::default()
    };
    let mut middle;
    let mut members = vec![&member[..], &values[..]];
    for way in 0..WAYS {
        let ends = each(starts.len(), &(), |(), i| {
            if watch.stops(Stage::Paths, i, Some(starts.len())) {
                return Err(false);
            }
            let start = followed(&family, &[&member], &starts[i], &tracker, watch)?;
            let first = followed(&family, &members, &start, &tracker, watch);
            first.or_else(|_| followed(&family, &members, &start, &tracker.tightened(0.03), watch))
        });
        let (mut arrived, mut at_infinity) = (0, 0);
        for end in ends {
            match end {
                Ok(x) => {
                    arrived += 1;
                    let key = family.key(&x);
                    if place(&known, &key).is_none() {
                        known.push(key);
                        different.push(x);
                    }
                }
                Err(infinite) => at_infinity += usize::from(infinite),
            }
        }
        // what one way loses another one may bring
        all.arrived = all.arrived.max(arrived).max(known.len());
        // a path that seems to go to infinity on one way may arrive on another one
        all.at_infinity = if way == 0 {
            at_infinity
        } else {
            at_infinity.min(all.at_infinity)
        };
        let infinite = if way == 0 { 0 } else { all.at_infinity };
        if known.len() + infinite >= all.generic || watch.is_stopped() {
            break;
        }
        middle = family.member(&mut rng);
        members = vec![&member, &middle, &values];
    }
    let scaled = |x: Vec<C>| FourBar::read(&x.iter().map(|x| x * size).collect::<Vec<C>>());
    all.different = different.into_iter().map(scaled).collect();
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::monodromy::Monodromy;

    /// A random four-bar with its point moved along its curve.
    fn random_member(rng: &mut Pcg64) -> (Vec<C>, Vec<C>) {
        let x: Vec<C> = (0..SIZE).map(|_| random(rng) * 1.5).collect();
        let four_bar = FourBar::read(&x);
        let mut values = Vec::new();
        for _ in 0..SIZE {
            let turn = Number::exp(random(rng) * C::new(0.5, 2.0));
            let turned = |x: Z| [turn * x[0], x[1] / turn];
            // the point lies on two circles: w w̄ = r and (w + e)(w̄ + ē) = t
            let [(u, r), (v, t)] = [0, 1].map(|i| {
                let (a, x) = (four_bar.pivots[i], four_bar.pins[i]);
                let far = of(|j| turned(x)[j] - a[j]);
                (far, (x[0] - a[0]) * (x[1] - a[1]))
            });
            let e = of(|i| v[i] - u[i]);
            let p = t - r - e[0] * e[1];
            let root = Number::sqrt(p * p - e[0] * e[1] * r * 4.0);
            let w = (p + root) / (e[1] * 2.0);
            values.extend([w - u[0], r / w - u[1]]);
        }
        (values, x)
    }

    fn flat(of: &FourBar) -> [C; SIZE] {
        let [[a, b], [x, y]] = [of.pivots, of.pins];
        [a[0], a[1], x[0], x[1], b[0], b[1], y[0], y[1]]
    }

    fn rng() -> Pcg64 {
        rand::SeedableRng::seed_from_u64(1)
    }

    /// Rows vanish along the curves of a four-bar and all its cognates, which have one key, and not beside it.
    #[test]
    fn cognates_have_one_curve() {
        let (values, x) = random_member(&mut rng());
        let others = FourBar::read(&x).all();
        for other in others {
            let apart = FourBar::key(&flat(&other));
            assert!(place(&[FourBar::key(&x)], &apart).is_some());
            for d in moves(&values) {
                let (value, slope, _) = row(&other, d);
                let size: f64 = slope.iter().map(|x| x.norm_sqr()).sum();
                assert!(value.norm_sqr() < 1e-24 * (1.0 + size));
                let beside = row(&other, [d[0] + 0.01, d[1]]).0;
                assert!(beside.norm_sqr() > 1e-12);
            }
        }
        for (i, a) in others.iter().map(flat).enumerate() {
            let near =
                |b: [C; SIZE]| (a[0] - b[0]).norm_sqr() < 1e-9 && (a[2] - b[2]).norm_sqr() < 1e-9;
            assert!(!others[..i].iter().map(flat).any(near));
        }
    }

    /// 1,442 (Wampler, Morgan and Sommese 1992). With `WRITE_NINE_POINTS` naming a file what is found is written there.
    #[test]
    #[ignore = "a minute of computing; run to make the stored file anew"]
    fn monodromy_finds_all_classes() {
        let (member, x) = random_member(&mut rng());
        let settings = Monodromy::default();
        let found = settings.spread(&NinePoints, &member, x, &Watch::none());
        assert_eq!((found.solutions.len(), found.quiet), (1442, 6), "{found:?}");
        if let Ok(path) = std::env::var("WRITE_NINE_POINTS") {
            let parts = |x: &C| [x.re, x.im];
            let doubles = member.iter().flat_map(parts).flat_map(f64::to_le_bytes);
            let numbers = found.solutions.iter().flatten().flat_map(parts);
            let short = numbers.flat_map(|x| {
                let bits = (x as f32).to_bits() + 0x80;
                let [_, bytes @ ..] = bits.to_le_bytes();
                bytes
            });
            std::fs::write(path, doubles.chain(short).collect::<Vec<u8>>()).unwrap();
        }
    }

    /// Each stored class lies within the rounding of its numbers of a solution, and no two of them are one.
    #[test]
    fn the_stored_classes_are_solutions() {
        let (member, starts) = stored();
        let mut known = Vec::new();
        for start in &starts {
            let end = followed(
                &NinePoints,
                &[&member],
                start,
                &Tracker::default(),
                &Watch::none(),
            );
            let end = end.unwrap();
            let mut pairs = end.iter().zip(start);
            assert!(pairs.all(|(a, b)| (a - b).norm_sqr() < 1e-6 * (1.0 + b.norm_sqr())));
            let key = FourBar::key(&end);
            assert!(place(&known, &key).is_none());
            known.push(key);
        }
        assert_eq!(known.len(), 1442);
    }
}
