//! Between which values a quantity stays over a whole curve.

use super::SENSES;
use crate::analysis::quantities::course::{Course, Sought};
use crate::number::sorting::sort_by;
use crate::number::tolerance::NOT_PRINTED;

/// Bounds of a quantity over the whole curve.
pub(super) struct Bounds {
    /// The least and the greatest value, and where they are: a piece and a place on it.
    pub best: [Option<(f64, usize, f64)>; 2],
    /// The values that all places examined allow.
    pub allowed: [f64; 2],
    /// The usual size of the values, and how far one may be off.
    usual: [f64; 2],
    /// Best values among those that rounding may have made, near 0/0 or without bound.
    murky: [Option<f64>; 2],
    /// Places where no bound was found.
    pub suspects: Vec<(usize, f64)>,
    /// True if there may be values beyond.
    pub cut: bool,
}

impl Bounds {
    /// Distance beyond the best value within which values cannot be distinguished from it.
    pub fn slack(&self, best: f64) -> f64 {
        NOT_PRINTED * (best.abs() + self.usual[0]) + 2.0 * self.usual[1]
    }

    /// Takes in a value.
    fn take(&mut self, value: f64, piece: usize, s: f64) {
        for (best, sense) in self.best.iter_mut().zip(SENSES) {
            if best.is_none_or(|(known, ..)| sense * value > sense * known) {
                *best = Some((value, piece, s));
            }
        }
    }

    /// True if values between two numbers may be beyond those known, or among murky ones beyond these.
    fn may_grow(&self, [low, high]: [f64; 2], murky: bool) -> bool {
        let beyond = |k: usize, end: f64| {
            let best = self.best[k].map(|(value, ..)| value);
            let known = match murky {
                true => [best, self.murky[k]]
                    .into_iter()
                    .flatten()
                    .reduce(|a: f64, b: f64| if SENSES[k] * a < SENSES[k] * b { b } else { a }),
                false => best,
            };
            known.is_none_or(|known| {
                let most = SENSES[k] * known + self.slack(known);
                let end = SENSES[k] * end;
                // what is not a number may be anything
                end > most || end.is_nan() || most.is_nan()
            })
        };
        beyond(0, low) || beyond(1, high)
    }
}

/// Branch and bound: pieces of the curve are halved until what the quantity may be on them is not beyond a value that it
/// has.
pub(super) fn bounds(course: &Course, of: &Sought) -> Bounds {
    /// The number of parts examined, beside the pieces themselves.
    const PATIENCE: usize = 400_000;
    let mut bounds = Bounds {
        best: [None; 2],
        murky: [None; 2],
        allowed: [f64::NEG_INFINITY, f64::INFINITY],
        usual: [0.0; 2],
        suspects: Vec::new(),
        cut: !course.whole,
    };
    let mut sizes: [Vec<f64>; 2] = Default::default();
    let mut seen = Vec::new();
    for piece in 0..course.pieces.len() {
        for s in [-1.0, -0.5, 0.0, 0.5, 1.0] {
            let (Some(value), noise) = course.value(of, piece, s) else {
                continue;
            };
            seen.push((value, noise, piece, s));
            sizes[0].push(value.abs());
            sizes[1].push(noise);
            let off = 4.0 * noise.max(f64::EPSILON * value.abs());
            let [low, high] = bounds.allowed;
            bounds.allowed = [low.max(value - off), high.min(value + off)];
        }
        bounds.cut |= course.hides(of, piece);
    }
    bounds.usual = sizes.map(|mut sizes| {
        sort_by(&mut sizes, f64::total_cmp);
        sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)
    });
    let [usual, usually_off] = bounds.usual;
    let clear = |value: f64, noise: f64| {
        // values that may be off by more, and more than is usual, are near 0/0
        noise <= f64::max(1e-7 * (value.abs() + usual), 10.0 * usually_off)
    };
    // an angle without jumps is known only along the way
    for (value, noise, piece, s) in seen.into_iter().filter(|_| !of.jumps) {
        if clear(value, noise) {
            bounds.take(value, piece, s);
        }
    }
    let patience = PATIENCE + 8 * course.pieces.len();
    let whole = course.walk(of, patience, &mut |part, model| {
        let Some(model) = model else {
            if course.is_rough(of, part.piece) {
                bounds.suspects.push((part.piece, part.middle));
            }
            return false;
        };
        if !bounds.may_grow(model.range(), false) {
            return false;
        }
        if course.is_narrow(part) && !model.rest.is_finite() {
            bounds.suspects.push((part.piece, part.middle));
            return false;
        }
        let mut murky = false;
        for (k, sense) in SENSES.into_iter().enumerate() {
            let s = part.middle + part.radius * model.top(sense);
            let (Some(value), noise) = course.value(of, part.piece, s) else {
                continue;
            };
            let here = if of.jumps {
                model.at(model.top(sense))
            } else {
                value
            };
            if clear(value, noise) {
                bounds.take(here, part.piece, s);
            } else {
                murky = true;
                let known = bounds.murky[k].filter(|known| sense * known > sense * here);
                bounds.murky[k] = known.or(Some(here));
            }
        }
        bounds.may_grow(model.range(), murky)
    });
    bounds.cut |= !whole;
    bounds
}
