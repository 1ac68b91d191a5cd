//! Cusps: configurations of a locus where three solutions meet.

use super::extents::SingularPlace;
use crate::linear::{dot, norm};
use crate::number::tolerance::{DOUBLE, ROUNDING, STILL};
use crate::system::{ConfigurationCurve, LocusCurve, Region, Singular, Traced};

/// Cusps of a curve: places at which the gained motion v is possible to second order too, with M(x) v = 0 and (∂M/∂v) v
/// in the image of M.
///
/// Elsewhere two solutions meet on the locus, there three: in the plane of two inputs its image has a
/// cusp, round which one solution turns into another without a singularity between them.
/// Sources: McAree and Daniel 1999; Zein, Wenger and Chablat 2008.
pub(super) fn cusps(
    curve: &mut LocusCurve,
    region: &Region,
    traced: &Traced<Singular>,
) -> Vec<SingularPlace> {
    let bends: Vec<Vec<f64>> = (traced.places.iter())
        .map(|place| curve.bend(&place.at))
        .collect();
    let mut found: Vec<SingularPlace> = Vec::new();
    let mut take = |curve: &mut LocusCurve,
                    from: (&SingularPlace, &[f64]),
                    to: (&SingularPlace, &[f64])| {
        let turned = dot(from.1, to.1) < 0.0;
        // without a bend v leads on along a whole motion
        if !turned || norm(from.1).max(norm(to.1)) < STILL {
            return turned;
        }
        // places of a traced curve are kept without what steps need
        let ends = [from.0, to.0].map(|place| region.method.restored(curve, place));
        let [Some(start), Some(end)] = ends else {
            return turned;
        };
        let along = from.1.to_vec();
        let mut test = |curve: &mut LocusCurve, p: &SingularPlace| dot(&curve.bend(&p.at), &along);
        let place = region.method.root(curve, &start, &end, &mut test);
        let one = |curve: &LocusCurve, other: &SingularPlace| {
            norm(&curve.apart(&other.at, &place.at)) < DOUBLE
        };
        let known = found.iter().chain(&traced.crossings);
        if norm(&curve.bend(&place.at)) < ROUNDING && !known.into_iter().any(|at| one(curve, at)) {
            found.push(place);
        }
        true
    };
    for i in 1..traced.places.len() {
        let [from, to] = [i - 1, i].map(|k| (&traced.places[k], &bends[k][..]));
        if take(curve, from, to) {
            continue;
        }
        // two within a step: towards the lesser end of three or four the bend grows less
        let size = |k: usize| bends.get(k).map_or(0.0, |bend| norm(bend));
        let falls = size(i - 1) < size(i.wrapping_sub(2)) && size(i) < size(i + 1);
        let way = dot(&curve.apart(&from.0.at, &to.0.at), &from.0.tangent);
        let middle = falls.then(|| {
            let from = region.method.restored(curve, from.0)?;
            region.method.across(curve, &from, 0.5 * way)
        });
        if let Some(middle) = middle.flatten() {
            let bend = curve.bend(&middle.at);
            take(curve, from, (&middle, &bend));
            take(curve, (&middle, &bend), to);
        }
    }
    found
}
