//! Places along a curve with what quantities are there.

use super::{Course, Sought, polynomial};
use crate::analysis::sweep::Sample;

impl Course<'_> {
    /// Places between which an expression is off a straight line by far less than a tolerance, or changes by more than
    /// twice that; and whether that is so everywhere.
    pub fn samples(&self, of: &Sought, tolerance: f64) -> (Vec<Sample>, bool) {
        /// The number of parts examined, beside the pieces themselves.
        const PATIENCE: usize = 1_000_000;
        let mut samples: Vec<Sample> = Vec::new();
        let patience = PATIENCE + 8 * self.pieces.len();
        let whole = self.walk(of, patience, &mut |part, model| {
            let place = |t: f64| {
                let s = part.middle + t * part.radius;
                let (stretch, gone) = self.place(part.piece, s);
                (stretch as f64 + gone, self.time_at(part.piece, s))
            };
            let Some(model) = model.filter(|model| model.rest.is_finite()) else {
                let wanted = model.is_some() && !self.is_narrow(part);
                if !wanted {
                    samples.push((place(0.0).0, None));
                }
                return wanted;
            };
            let bend = model.bend();
            let leaves = model.terms[1].abs() - bend > 2.0 * tolerance;
            // far less than the tolerance off a straight line
            if bend > 1e-3 * tolerance && !leaves && !self.is_narrow(part) {
                return true;
            }
            for t in [-1.0, 1.0] {
                let (place, time) = place(t);
                if samples
                    .last()
                    .is_none_or(|(last, of)| *last < place || of.is_none())
                {
                    samples.push((place, Some([time, model.at(t)])));
                }
            }
            false
        });
        let hidden = (0..self.pieces.len()).any(|piece| self.hides(of, piece));
        (samples, whole && self.whole && !hidden)
    }

    /// The places of a point, of which the coordinates have these numbers, along the curve.
    pub fn path(&self, axes: [usize; 3]) -> Vec<(f64, [f64; 3])> {
        /// Parts examined on each piece.
        const COUNT: u32 = 32;
        let pieces = 0..self.pieces.len();
        let all = pieces.flat_map(|piece| {
            (0..=COUNT).map(move |k| {
                let s = 2.0 * f64::from(k) / f64::from(COUNT) - 1.0;
                let (stretch, part) = self.place(piece, s);
                let at = axes.map(|axis| polynomial(&self.pieces[piece].terms[axis], s));
                (stretch as f64 + part, at)
            })
        });
        let known = all.filter(|(_, at)| at.iter().all(|x| x.is_finite()));
        let mut known: Vec<(f64, [f64; 3])> = known.collect();
        // where one piece ends the next begins
        known.dedup_by(|after, before| after.0 == before.0);
        known
    }
}
