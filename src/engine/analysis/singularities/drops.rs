//! Locating every place along a curve where a matrix loses one or several ranks.

use crate::linear::{Decomposition, RANK_TOLERANCE};
use crate::mechanism::Configuration;
use crate::number::tolerance::SOLVED;
use crate::solve::{Continuation, CurvePoint, edge};
use crate::system::{Curve, Locked};

type DropPlace = CurvePoint<Configuration<f64>>;

struct RankSample {
    place: DropPlace,
    matrix: Vec<f64>,
    decomposition: Decomposition,
}

impl RankSample {
    fn largest(&self) -> f64 {
        let values = self.decomposition.singular_values();
        values.first().copied().unwrap_or(0.0)
    }

    /// The last singular value within the rank.
    fn least(&self) -> f64 {
        let values = self.decomposition.singular_values();
        let last = self.decomposition.rank().checked_sub(1);
        last.and_then(|last| values.get(last)).map_or(0.0, |v| *v)
    }

    /// True if the last singular value is zero to rounding.
    fn vanishes(&self) -> bool {
        self.least() <= SOLVED * self.largest()
    }
}

/// A stretch of a curve, with the matrix that may lose rank on it.
pub(super) struct Drops<'a> {
    pub curve: &'a mut Curve,
    pub locked: &'a mut Locked,
    /// The rank of the matrix at a regular configuration.
    pub rank: usize,
    pub method: &'a Continuation,
}

impl Drops<'_> {
    /// The places after `from` up to `to`, reached from it by one step, where the last singular
    /// value σ within the rank vanishes.
    ///
    /// Between places with the matrices A and B it cannot vanish while σ(A) + σ(B) > 1.5 ‖B − A‖ (Weyl: σ changes no more
    /// than the matrix; a half more allows for a path that is not straight). Otherwise the stretch is halved until it is
    /// short; there the determinant of [`Locked::orientation`] changes sign, or σ falls from both ends to a minimum.
    pub fn between(&mut self, from: &DropPlace, to: &DropPlace) -> Vec<DropPlace> {
        let from = self.sample(from.clone());
        let to = self.sample(to.clone());
        let mut found = Vec::new();
        self.search(&from, &to, 0, &mut found);
        found
    }

    fn sample(&mut self, place: DropPlace) -> RankSample {
        let matrix = self.locked.jacobian(&place.at);
        let (rows, columns) = (self.locked.rows(), self.locked.columns());
        RankSample {
            decomposition: Decomposition::of_rank(rows, columns, &matrix, self.rank),
            place,
            matrix,
        }
    }

    /// Sample at a distance along the tangent of a place.
    fn ahead(&mut self, of: &RankSample, along: f64) -> Option<RankSample> {
        let place = self.method.across(self.curve, &of.place, along)?;
        Some(self.sample(place))
    }

    fn search(&mut self, a: &RankSample, b: &RankSample, depth: usize, found: &mut Vec<DropPlace>) {
        /// Stretches are not halved more often: 1/32 of a step is short.
        const DEPTH: usize = 5;
        let moved = a.matrix.iter().zip(&b.matrix);
        let moved = moved.map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
        if a.least() + b.least() > 1.5 * moved {
            return;
        }
        let length = self.curve.offset(&a.place, &b.place.at).0;
        if depth < DEPTH
            && let Some(middle) = self.ahead(a, 0.5 * length)
        {
            self.search(a, &middle, depth + 1, found);
            self.search(&middle, b, depth + 1, found);
        } else {
            found.extend(self.last(a, b, length));
        }
    }

    /// The place on a short stretch.
    fn last(&mut self, a: &RankSample, b: &RankSample, length: f64) -> Option<DropPlace> {
        match (a.vanishes(), b.vanishes()) {
            // found on the stretch before, or at the start
            (true, _) => return None,
            (false, true) => return Some(b.place.clone()),
            (false, false) => {}
        }
        let near = match a.least() >= b.least() {
            true => &a.decomposition,
            false => &b.decomposition,
        };
        let turned = |sample: &RankSample| near.determinant_beside(&sample.matrix) < 0.0;
        let place = if turned(a) != turned(b) {
            let locked = &mut *self.locked;
            let mut test = |_: &mut Curve, place: &DropPlace| locked.orientation(near, &place.at);
            (self.method).root(self.curve, &a.place, &b.place, &mut test)
        } else {
            self.lowest(a, b, length)?
        };
        // where the smallest singular values turn without vanishing, a sign means nothing
        let sample = self.sample(place);
        (sample.least() <= RANK_TOLERANCE * sample.largest()).then_some(sample.place)
    }

    /// The place between two where σ is least, if it falls from both ends. Where two singular
    /// values vanish at once each does so linearly, and golden sections find the place to rounding.
    fn lowest(&mut self, a: &RankSample, b: &RankSample, length: f64) -> Option<DropPlace> {
        for (end, part) in [(a, 1e-3), (b, 1.0 - 1e-3)] {
            if self.ahead(a, part * length)?.least() >= end.least() {
                return None;
            }
        }
        let least = |along| Some(-self.ahead(a, along)?.least());
        let (along, _) = edge(0.0, length, least)?;
        Some(self.ahead(a, along)?.place)
    }
}
