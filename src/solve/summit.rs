//! The highest point of a function of one variable.

/// The maximum between two places, and its height: by golden section, accurate to √ε, then by the zero of the slope
/// (central differences of fourth order), accurate to about 10⁻¹⁰ of the interval, unless that is lower.
///
/// Source: Brent, Algorithms for Minimization without Derivatives, 1973, chapter 5.
pub fn summit(
    from: f64,
    to: f64,
    mut height: impl FnMut(f64) -> Option<f64>,
) -> Option<(f64, f64)> {
    const GOLDEN: f64 = 0.381_966_011_250_105_1;
    let (mut low, mut high) = (from.min(to), from.max(to));
    let way = high - low;
    let (mut a, mut b) = (low + GOLDEN * way, high - GOLDEN * way);
    let (mut at_a, mut at_b) = (height(a)?, height(b)?);
    while high - low > 1e-7 * way {
        match at_a < at_b {
            true => {
                low = a;
                (a, at_a) = (b, at_b);
                b = high - GOLDEN * (high - low);
                at_b = height(b)?;
            }
            false => {
                high = b;
                (b, at_b) = (a, at_a);
                a = low + GOLDEN * (high - low);
                at_a = height(a)?;
            }
        }
    }
    let rough = if at_a < at_b { (b, at_b) } else { (a, at_a) };
    let h = 1e-2 * way;
    let mut slope = |x: f64| {
        let [far, near] = [2.0 * h, h].map(|h| Some(height(x + h)? - height(x - h)?));
        Some((8.0 * near? - far?) / (12.0 * h))
    };
    let (mut x, mut next) = (rough.0 - 1e-4 * way, rough.0 + 1e-4 * way);
    let mut before = slope(x);
    for _ in 0..12 {
        let (Some(last), Some(here)) = (before, slope(next)) else {
            return Some(rough);
        };
        let step = here * (next - x) / (here - last);
        if !step.is_finite() {
            break;
        }
        (x, before) = (next, Some(here));
        next -= step;
        if (next - rough.0).abs() > 1e-2 * way {
            return Some(rough);
        }
        if step.abs() <= 1e-15 * way {
            break;
        }
    }
    let rounding = 1e-13 * rough.1.abs();
    match height(next) {
        Some(value) if value >= rough.1 - rounding => Some((next, value)),
        _ => Some(rough),
    }
}

#[cfg(test)]
mod tests {
    use super::summit;

    #[test]
    fn a_smooth_summit_is_placed_to_rounding() {
        let (x, height) = summit(0.1, 2.5, |x: f64| Some(x.sin())).unwrap();
        assert!((x - std::f64::consts::FRAC_PI_2).abs() < 1e-8, "{x}");
        assert_eq!(height, 1.0);
    }

    #[test]
    fn an_edge_and_a_gap_are_told_too() {
        let (x, height) = summit(0.0, 1.0, |x: f64| Some(-(x - 0.3).abs())).unwrap();
        assert!((x - 0.3).abs() < 1e-6 && height > -1e-6, "{x} {height}");
        assert_eq!(summit(0.0, 1.0, |x: f64| (x > 0.5).then_some(x)), None);
    }
}
