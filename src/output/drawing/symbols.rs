//! Symbols of joints: in the plane those of a kinematic diagram, in space small solids.

use super::{DRIVEN, Element, GROUND, INK, Layer, Piece, Sheet};
use crate::geometry::Vector3;
use crate::scene::{JointShape, Symbol};

type Point = Vector3<f64>;

/// The pieces of a joint.
pub(super) fn joint(sheet: &Sheet, joint: &JointShape) -> Vec<Piece> {
    let at = Vector3(joint.at);
    let fill = if joint.driven { DRIVEN } else { "#ffffff" };
    let on_ground = joint
        .bodies
        .iter()
        .any(|&body| sheet.scene.bodies[body].ground);
    let axis = |k: usize| {
        joint
            .axes
            .get(k)
            .map_or(sheet.camera.towards(), |axis| Vector3(*axis))
    };
    let flat = |k: usize| sheet.camera.facing(&axis(k)).abs() > 1.0 - 1e-9;
    let mut pieces = Vec::new();
    match joint.kind {
        Symbol::Revolute | Symbol::Helical if flat(0) => {
            if on_ground {
                pieces.extend(support(sheet, &at));
            }
            pieces.extend(ball(sheet, &at, 0.75, fill));
        }
        Symbol::Revolute | Symbol::Helical => {
            if on_ground {
                pieces.extend(plate(sheet, &at, &axis(0)));
            }
            pieces.extend(cylinder(sheet, &at, &axis(0), 0.75, 1.1, fill));
        }
        Symbol::Cylindrical => {
            pieces.extend(guide(sheet, &at, &axis(0), on_ground));
            pieces.extend(cylinder(sheet, &at, &axis(0), 0.75, 1.4, fill));
        }
        Symbol::Prismatic => {
            pieces.extend(guide(sheet, &at, &axis(0), on_ground));
            pieces.extend(block(sheet, &at, &axis(0), [1.4, 0.8, 0.8], fill));
        }
        Symbol::Universal => {
            if on_ground {
                pieces.extend(plate(sheet, &at, &axis(0)));
            }
            for k in 0..2 {
                pieces.extend(cylinder(sheet, &at, &axis(k), 0.35, 1.2, fill));
            }
        }
        Symbol::Spherical => {
            if on_ground {
                pieces.extend(plate(sheet, &at, &Vector3::unit(2)));
            }
            pieces.extend(ball(sheet, &at, 0.9, fill));
        }
        Symbol::Planar => pieces.extend(block(sheet, &at, &axis(0), [0.3, 1.5, 1.5], fill)),
        Symbol::Rigid => {}
    }
    pieces
}

/// A round joint.
pub(super) fn ball(sheet: &Sheet, at: &Point, size: f64, fill: &str) -> Vec<Piece> {
    let (right, up) = sheet.camera.screen();
    let outline = ring(at, &right, &up, size * sheet.metres());
    vec![Piece {
        layer: Layer::Pin,
        ..solid(sheet, &outline, fill, 0.5)
    }]
}

fn cylinder(
    sheet: &Sheet,
    at: &Point,
    axis: &Point,
    radius: f64,
    half: f64,
    fill: &str,
) -> Vec<Piece> {
    let (right, up) = across(axis);
    let towards = match sheet.camera.facing(axis) < 0.0 {
        true => axis.times(-1.0),
        false => *axis,
    };
    let end = |sign: f64| {
        let middle = *at + towards.times(sign * half * sheet.metres());
        ring(&middle, &right, &up, radius * sheet.metres())
    };
    let (far, front) = (end(-1.0), end(1.0));
    let whole = sheet.camera.hull(&[far, front.clone()].concat());
    vec![
        solid(sheet, &whole, fill, 0.5),
        solid(sheet, &front, fill, 0.6),
    ]
}

/// A box with its first edge along the axis.
fn block(sheet: &Sheet, at: &Point, axis: &Point, halves: [f64; 3], fill: &str) -> Vec<Piece> {
    // in the plane of the picture where the axis is, so that the box does not stand askew
    let side = axis.cross(&sheet.camera.towards());
    let (right, up) = match side.norm() > 1e-6 && sheet.scene.normal.is_some() {
        true => (side.times(1.0 / side.norm()), sheet.camera.towards()),
        false => across(axis),
    };
    let edges = [*axis, right, up];
    let metres = sheet.metres();
    let mut faces = Vec::new();
    for k in 0..3 {
        let (u, v) = ((k + 1) % 3, (k + 2) % 3);
        let out = match sheet.camera.facing(&edges[k]) {
            facing if facing.abs() < 1e-9 => continue,
            facing => facing.signum(),
        };
        let middle = *at + edges[k].times(out * halves[k] * metres);
        let corner = |a: f64, b: f64| {
            middle + edges[u].times(a * halves[u] * metres) + edges[v].times(b * halves[v] * metres)
        };
        let face = [
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ];
        faces.push(solid(sheet, &face, fill, 0.5));
    }
    faces
}

/// The line along which a slide moves, hatched where it is fixed to ground.
fn guide(sheet: &Sheet, at: &Point, axis: &Point, on_ground: bool) -> Vec<Piece> {
    let metres = sheet.metres();
    let ends = [-3.5, 3.5].map(|part| *at + axis.times(part * metres));
    let colour = if on_ground { GROUND } else { INK };
    let mut pieces = vec![line(sheet, &ends, colour, 1.5)];
    if on_ground && sheet.scene.normal.is_some() {
        let side = axis.cross(&sheet.camera.towards());
        pieces.extend(hatch(sheet, at, axis, &side, 3.5));
    }
    pieces
}

/// A pin on ground: a triangle on a hatched line.
fn support(sheet: &Sheet, at: &Point) -> Vec<Piece> {
    let metres = sheet.metres();
    let (right, up) = sheet.camera.screen();
    let foot = |x: f64| *at + right.times(x * metres) - up.times(1.9 * metres);
    let triangle = [*at, foot(-1.1), foot(1.1)];
    let polygon = sheet.polygon(&triangle).set("fill", "#dddddd");
    let polygon = polygon.set("stroke", GROUND).set("stroke-width", 1.2);
    let mut pieces = vec![Piece {
        layer: Layer::Ground,
        near: sheet.near(&[*at]) - 0.2 * metres,
        element: Element::Polygon(polygon),
    }];
    let base = *at - up.times(1.9 * metres);
    pieces.push(line(sheet, &[foot(-1.6), foot(1.6)], GROUND, 1.5));
    pieces.extend(hatch(sheet, &base, &right, &up.times(-1.0), 1.6));
    pieces
}

/// Short strokes along a line, on the side of the ground.
fn hatch(sheet: &Sheet, at: &Point, along: &Point, into: &Point, half: f64) -> Vec<Piece> {
    let metres = sheet.metres();
    let strokes = (2.0 * half / 0.6).round() as i32;
    let stroke = |k: i32| {
        let x = -half + 0.6 * f64::from(k);
        let from = *at + along.times((x + 0.5) * metres);
        [
            from,
            *at + along.times(x * metres) + into.times(0.6 * metres),
        ]
    };
    (0..strokes)
        .map(|k| line(sheet, &stroke(k), GROUND, 0.8))
        .collect()
}

/// A square of ground under a spatial joint.
fn plate(sheet: &Sheet, at: &Point, axis: &Point) -> Vec<Piece> {
    let metres = sheet.metres();
    let (right, up) = across(axis);
    let down = match axis.0[2] < -0.5 {
        true => axis.times(1.3 * metres),
        false => axis.times(-1.3 * metres),
    };
    let corner = |x: f64, y: f64| *at + down + right.times(x * metres) + up.times(y * metres);
    let corners = [
        corner(-1.6, -1.6),
        corner(1.6, -1.6),
        corner(1.6, 1.6),
        corner(-1.6, 1.6),
    ];
    let polygon = sheet.polygon(&corners).set("fill", "#cccccc");
    let polygon = polygon.set("stroke", GROUND).set("stroke-width", 1);
    vec![Piece {
        layer: Layer::Ground,
        near: sheet.near(&corners),
        element: Element::Polygon(polygon),
    }]
}

fn line(sheet: &Sheet, points: &[Point], colour: &str, width: f64) -> Piece {
    let line = sheet
        .polyline(points)
        .set("stroke", colour)
        .set("stroke-width", width);
    Piece {
        layer: Layer::Ground,
        // under the joint that stands on it
        near: sheet.near(points) - 0.1 * sheet.metres(),
        element: Element::Polyline(line),
    }
}

/// A filled outline, a little nearer than what it stands on.
fn solid(sheet: &Sheet, points: &[Point], fill: &str, nearer: f64) -> Piece {
    let polygon = sheet.polygon(points).set("fill", fill);
    Piece {
        layer: Layer::Slide,
        near: sheet.near(points) + nearer * sheet.metres(),
        element: Element::Polygon(polygon.set("stroke", INK).set("stroke-width", 1.3)),
    }
}

fn ring(middle: &Point, right: &Point, up: &Point, radius: f64) -> Vec<Point> {
    let places = (0..24).map(|k| {
        let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 24.0).sin_cos();
        *middle + right.times(radius * cos) + up.times(radius * sin)
    });
    places.collect()
}

/// Two unit vectors perpendicular to one and to one another.
fn across(axis: &Point) -> (Point, Point) {
    let least = (0..3).min_by(|&i, &k| axis.0[i].abs().total_cmp(&axis.0[k].abs()));
    let right = axis.cross(&Vector3::unit(least.unwrap_or(0)));
    let right = right.times(1.0 / right.norm());
    (right, axis.cross(&right))
}
