//! The highest point of a function of one variable.

use crate::number::tolerance::{EXACT, SUMMED};

/// The maximum between two places, and its height: by golden section, accurate to √ε, then by the zero of the slope
/// (central differences of fourth order), accurate to about 10⁻¹⁰ of the interval, unless that is lower.
///
/// Source: Brent, Algorithms for Minimization without Derivatives, 1973, chapter 5.
pub fn summit(
    from: f64,
    to: f64,
    mut height: impl FnMut(f64) -> Option<f64>,
) -> Option<(f64, f64)> {
    let way = (to - from).abs();
    let mut section = GoldenSection::of(from, to, &mut height)?;
    section.narrow(1e-7 * way, &mut height)?;
    let rough = section.best();
    if let Some(smooth) = stationary(rough, way, &mut height) {
        return Some(smooth);
    }
    section.narrow(EXACT * way, &mut height)?;
    Some(section.best())
}

/// The maximum between two places of a function that has an edge there, and its height: an edge, which has no slope, is
/// located to rounding by golden section alone (Kiefer 1953).
pub fn edge(from: f64, to: f64, mut height: impl FnMut(f64) -> Option<f64>) -> Option<(f64, f64)> {
    let mut section = GoldenSection::of(from, to, &mut height)?;
    section.narrow(EXACT * (to - from).abs(), &mut height)?;
    Some(section.best())
}

/// The two neighbouring places between which a condition that holds at the first of two places and not at the second ceases
/// to hold, by sixty halvings.
pub fn halved([mut from, mut to]: [f64; 2], mut holds: impl FnMut(f64) -> bool) -> [f64; 2] {
    for _ in 0..60 {
        let middle = 0.5 * (from + to);
        match holds(middle) {
            true => from = middle,
            false => to = middle,
        }
    }
    [from, to]
}

/// A golden section: the maximum lies between the ends, and two heights between them are known.
struct GoldenSection {
    low: f64,
    high: f64,
    a: f64,
    b: f64,
    heights: [f64; 2],
}

/// The smaller part of the golden section, (3 − √5)/2.
pub const GOLDEN: f64 = 0.381_966_011_250_105_1;

impl GoldenSection {
    fn of(from: f64, to: f64, height: &mut impl FnMut(f64) -> Option<f64>) -> Option<Self> {
        let (low, high) = (from.min(to), from.max(to));
        let part = GOLDEN * (high - low);
        let (a, b) = (low + part, high - part);
        let heights = [height(a)?, height(b)?];
        Some(GoldenSection {
            low,
            high,
            a,
            b,
            heights,
        })
    }

    /// Narrows the section to a width.
    fn narrow(&mut self, width: f64, height: &mut impl FnMut(f64) -> Option<f64>) -> Option<()> {
        while self.high - self.low > width.max(4.0 * f64::EPSILON * self.high.abs()) {
            let [at_a, at_b] = self.heights;
            if at_a < at_b {
                self.low = self.a;
                self.a = self.b;
                self.b = self.high - GOLDEN * (self.high - self.low);
                self.heights = [at_b, height(self.b)?];
            } else {
                self.high = self.b;
                self.b = self.a;
                self.a = self.low + GOLDEN * (self.high - self.low);
                self.heights = [height(self.a)?, at_a];
            }
        }
        Some(())
    }

    fn best(&self) -> (f64, f64) {
        match self.heights[0] < self.heights[1] {
            true => (self.b, self.heights[1]),
            false => (self.a, self.heights[0]),
        }
    }
}

/// Zero of the slope near a place, with the height there, if that is not lower.
fn stationary(
    rough: (f64, f64),
    way: f64,
    height: &mut impl FnMut(f64) -> Option<f64>,
) -> Option<(f64, f64)> {
    let h = 1e-2 * way;
    let mut slope = |x: f64| {
        let [far, near] = [2.0 * h, h].map(|h| Some(height(x + h)? - height(x - h)?));
        Some((8.0 * near? - far?) / (12.0 * h))
    };
    let (mut x, mut next) = (rough.0 - 1e-4 * way, rough.0 + 1e-4 * way);
    let mut before = slope(x);
    for _ in 0..12 {
        let (Some(last), Some(here)) = (before, slope(next)) else {
            return None;
        };
        let step = here * (next - x) / (here - last);
        if !step.is_finite() {
            break;
        }
        (x, before) = (next, Some(here));
        next -= step;
        if (next - rough.0).abs() > 1e-2 * way {
            return None;
        }
        if step.abs() <= 1e-15 * way {
            break;
        }
    }
    let rounding = SUMMED * rough.1.abs();
    match height(next) {
        Some(value) if value >= rough.1 - rounding => Some((next, value)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{edge, summit};

    #[test]
    fn a_smooth_summit_is_placed_to_rounding() {
        let (x, height) = summit(0.1, 2.5, |x: f64| Some(x.sin())).unwrap();
        assert!((x - std::f64::consts::FRAC_PI_2).abs() < 1e-8, "{x}");
        assert_eq!(height, 1.0);
    }

    #[test]
    fn an_edge_and_a_gap_are_told_too() {
        let (x, height) = summit(0.0, 1.0, |x: f64| Some(-(x - 0.3).abs())).unwrap();
        assert!((x - 0.3).abs() < 1e-15 && height > -1e-15, "{x} {height}");
        let (from_above, _) = edge(1.0, 0.0, |x: f64| Some(-(x - 0.3).abs())).unwrap();
        assert!((from_above - 0.3).abs() < 1e-15, "{from_above}");
        assert_eq!(summit(0.0, 1.0, |x: f64| (x > 0.5).then_some(x)), None);
    }
}
