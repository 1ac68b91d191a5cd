//! The extents of a locus in the coordinates of the box.

use crate::number::tolerance::STILL;
use crate::solve::CurvePoint;
use crate::system::{ConfigurationCurve, Driven, LocusCurve, Region, Singular, Traced};

/// A place of a singularity locus.
pub(super) type SingularPlace = CurvePoint<Singular>;

/// Least and greatest value of each coordinate on a curve, rad or m: at ends, crossings and turns.
pub(super) fn extents(
    curve: &mut LocusCurve,
    region: &Region,
    traced: &Traced<Singular>,
) -> [[f64; 2]; 2] {
    [0, 1].map(|k| {
        let side = region.sides[k];
        let value = |place: &SingularPlace| region.side(&place.at.at, &side);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut take = |x: f64| (low, high) = (low.min(x), high.max(x));
        traced.places.iter().for_each(|place| take(value(place)));
        traced.crossings.iter().for_each(|place| take(value(place)));
        for ends in traced.places.windows(2) {
            if let Some(place) = turning(curve, region, &side, &ends[0], &ends[1]) {
                take(value(&place));
            }
        }
        [low, high]
    })
}

/// The place between two others where the curve turns back in a coordinate, if it does.
fn turning(
    curve: &mut LocusCurve,
    region: &Region,
    side: &Driven,
    from: &SingularPlace,
    to: &SingularPlace,
) -> Option<SingularPlace> {
    let mut rate = |curve: &mut LocusCurve, place: &SingularPlace| {
        curve
            .closed()
            .rate(&place.at.at, &place.tangent, side.coordinate)
    };
    let (before, after) = (rate(curve, from), rate(curve, to));
    if (before < 0.0) == (after < 0.0) || before.abs().max(after.abs()) <= STILL {
        return None;
    }
    let found = region.method.root(curve, from, to, &mut rate);
    if rate(curve, &found).abs() < STILL {
        return Some(found);
    }
    // where others cross between them, only one of both leads to the turn by sure steps
    let (from, to) = (to.clone().reversed(), from.clone().reversed());
    let found = region.method.root(curve, &from, &to, &mut rate);
    (rate(curve, &found).abs() < STILL).then_some(found)
}
