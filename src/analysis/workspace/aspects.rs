//! Aspects: regions of one mode without singularities, within limits; and how large regions are.

use super::filled::{Filled, Link, Sheet, join, root};
use super::grid::Grid;
use crate::solve::each;

/// For each sheet the first of its aspect; none outside limits and on singularities.
pub(super) fn aspects(filled: &Filled) -> Vec<Option<usize>> {
    let mut roots: Vec<usize> = (0..filled.len()).collect();
    let inside = |sheet: &Sheet| {
        let told = &sheet.told;
        sheet.within && told.direct != 0.0 && told.inverse != 0.0
    };
    for (s, sheet) in filled.sheets().filter(|(_, s)| inside(s)) {
        for link in &sheet.links {
            let Link::To(name) = *link else {
                continue;
            };
            let t = filled.number(name);
            let other = filled.sheet(t);
            let [a, b] = [sheet, other].map(|s| &s.told);
            let alike = |x: f64, y: f64| (x < 0.0) == (y < 0.0);
            if inside(other) && alike(a.direct, b.direct) && alike(a.inverse, b.inverse) {
                join(&mut roots, s, t);
            }
        }
    }
    let all = filled.sheets();
    all.map(|(s, sheet)| inside(sheet).then(|| root(&mut roots, s)))
        .collect()
}

/// How large a set of nodes is, in the units of the mapped coordinates: a length, an area of
/// polygons, or the volume between parallel areas (trapezoidal rule).
///
/// `inside` tells whether a node belongs to it; `cut` how far it reaches from a node that does
/// towards its neighbour in a direction that does not, as a part of the way.
pub(super) fn size(
    grid: &Grid,
    inside: &(dyn Fn(usize) -> bool + Sync),
    cut: &(dyn Fn(usize, usize) -> f64 + Sync),
) -> f64 {
    let scale: f64 = (0..grid.dimensions())
        .map(|axis| grid.spacing(axis))
        .product();
    let parts = match grid.dimensions() {
        1 => (0..grid.count(0) - 1)
            .map(|i| match (inside(i), inside(i + 1)) {
                (true, true) => 1.0,
                (true, false) => cut(i, 1),
                (false, true) => cut(i + 1, 0),
                (false, false) => 0.0,
            })
            .sum(),
        2 => slice(grid, 0, inside, cut),
        _ => {
            let plane = grid.count(0) * grid.count(1);
            let last = grid.count(2) - 1;
            let weight = |k: usize| if k == 0 || k == last { 0.5 } else { 1.0 };
            let slices = 0..=last;
            slices
                .map(|k| weight(k) * slice(grid, k * plane, inside, cut))
                .sum()
        }
    };
    parts * scale
}

/// The area of a slice in cells.
fn slice(
    grid: &Grid,
    first: usize,
    inside: &(dyn Fn(usize) -> bool + Sync),
    cut: &(dyn Fn(usize, usize) -> f64 + Sync),
) -> f64 {
    let n = grid.count(0);
    let rows = each(grid.count(1) - 1, &(), |(), j| {
        let cells = (0..n - 1).map(|i| first + i + j * n);
        cells
            .map(|corner| {
                // corners and the directions to the next, counterclockwise
                let corners = [corner, corner + 1, corner + 1 + n, corner + n];
                let is = corners.map(inside);
                if is == [false; 4] {
                    return 0.0;
                }
                if is == [true; 4] {
                    return 1.0;
                }
                let ahead = [1, 3, 0, 2];
                let to = |k: usize| {
                    let (a, b) = (corners[k], corners[(k + 1) % 4]);
                    match (is[k], is[(k + 1) % 4]) {
                        (true, false) => Some(cut(a, ahead[k])),
                        (false, true) => Some(1.0 - cut(b, ahead[k] ^ 1)),
                        _ => None,
                    }
                };
                let place = |k: usize, part: f64| match k {
                    0 => [part, 0.0],
                    1 => [1.0, part],
                    2 => [1.0 - part, 1.0],
                    _ => [0.0, 1.0 - part],
                };
                if is[0] == is[2] && is[1] == is[3] {
                    // opposite corners, each by itself
                    let corner = |k: usize| {
                        let before = to((k + 3) % 4).map_or(0.0, |part| 1.0 - part);
                        0.5 * before * to(k).unwrap_or(0.0)
                    };
                    return (0..4).filter(|&k| is[k]).map(corner).sum();
                }
                let mut polygon: Vec<[f64; 2]> = Vec::new();
                for (k, is) in is.into_iter().enumerate() {
                    if is {
                        polygon.push(place(k, 0.0));
                    }
                    polygon.extend(to(k).map(|part| place(k, part)));
                }
                let next = polygon.iter().cycle().skip(1);
                let cross = polygon.iter().zip(next);
                0.5 * cross.map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>()
            })
            .sum::<f64>()
    });
    rows.into_iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Driven, Holdable};

    #[test]
    fn the_area_of_a_disc_converges_to_second_order() {
        let area = |n: usize| {
            let axis = Driven {
                coordinate: Holdable::Joint(0),
                from: -1.5,
                to: 1.5,
            };
            let grid = Grid::new(&[axis, axis], &[n, n]);
            let inside = |node: usize| grid.values(node).iter().map(|x| x * x).sum::<f64>() <= 1.0;
            let cut = |node: usize, direction: usize| {
                let values = grid.values(node);
                let (along, across) = (values[direction / 2], values[1 - direction / 2]);
                let sign = if direction.is_multiple_of(2) {
                    -1.0
                } else {
                    1.0
                };
                ((1.0 - across * across).sqrt() - sign * along) / grid.spacing(0)
            };
            size(&grid, &inside, &cut)
        };
        let error = |n| (area(n) - std::f64::consts::PI).abs();
        assert!(error(41) < 1e-2 && error(81) < 0.35 * error(41));
    }
}
