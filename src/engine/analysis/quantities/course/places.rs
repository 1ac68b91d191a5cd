//! Places along the curve of a motion.

use super::*;

impl Course<'_> {
    /// A place of a piece among all, where 2.5 is half way along the third stretch.
    pub fn place(&self, piece: usize, s: f64) -> (usize, f64) {
        let of = &self.pieces[piece];
        (of.stretch, within(of.span, s))
    }

    /// The number of stretches.
    pub fn stretches(&self) -> usize {
        self.stretches.len()
    }

    /// The number of the piece on which a part of a stretch is.
    pub fn piece(&self, stretch: usize, part: f64) -> Option<usize> {
        let after = (self.pieces).partition_point(|of| {
            of.stretch < stretch || of.stretch == stretch && of.span[0] <= part
        });
        after.checked_sub(1)
    }

    /// The work done at a part of a stretch, of each such name in order.
    pub fn works(&self, stretch: usize, part: f64) -> Vec<f64> {
        let piece = self.piece(stretch, part).map(|piece| &self.pieces[piece]);
        let piece = piece.filter(|of| of.stretch == stretch);
        let works = piece.into_iter().flat_map(|of| {
            let [begin, end] = of.span;
            let s = 2.0 * (part - begin) / (end - begin) - 1.0;
            of.works.iter().map(move |terms| polynomial(terms, s))
        });
        works.collect()
    }

    /// The stretch on which a place reached between its ends is, with the part of it.
    pub fn place_of(&self, stretch: usize, at: &Configuration<f64>, time: f64) -> (usize, f64) {
        let part = self
            .stretches
            .get(stretch)
            .map(|of| self.passage.part(of, at, time));
        (stretch, part.unwrap_or(0.0))
    }

    /// The configuration at a part of a stretch, and the part of the time that is gone there.
    pub fn at(&mut self, stretch: usize, part: f64) -> Option<(&Configuration<f64>, f64)> {
        let piece = &self.pieces[self.piece(stretch, part)?];
        let near = usize::from(part - piece.span[0] > piece.span[1] - part);
        let from = (piece.span[near], &piece.ends[near]);
        self.passage.at(&self.stretches[stretch], part, from)
    }

    /// Values of a meter at a part of a stretch, with the part of the time that is gone there.
    pub fn read<'a>(
        &mut self,
        meter: &'a mut Meter,
        (stretch, part): (usize, f64),
    ) -> Option<(&'a [Option<f64>], f64)> {
        meter.gathered(&self.works(stretch, part));
        let (at, time) = self.at(stretch, part)?;
        Some((meter.read(at, time), time))
    }

    /// A place given by one number, stretch plus part.
    pub fn divided(&self, place: f64) -> (usize, f64) {
        let stretch = (place.floor() as usize).min(self.stretches.len() - 1);
        (stretch, place - stretch as f64)
    }

    /// As [`Course::at`], at such a place.
    pub fn at_place(&mut self, place: f64) -> Option<(&Configuration<f64>, f64)> {
        let (stretch, part) = self.divided(place);
        self.at(stretch, part)
    }
}
