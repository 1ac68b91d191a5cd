//! Symbols of joints: in the plane those of a kinematic diagram, in space small solids.

use super::{Camera, DRIVEN, GROUND, Layer, Painted, Position, StagedScene};
use crate::geometry::Vector3;
use crate::number::real;
use crate::output::canvas::{Colour, INK, OutlineStyle, WHITE};
use crate::scene::{JointShape, JointSymbol, across};

/// Corners of a square, in order round it.
const CORNERS: [(f64, f64); 4] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];

/// The pieces of a joint.
pub(super) fn joint(stage: &StagedScene, joint: &JointShape) -> Vec<Painted> {
    let at = Vector3(joint.at);
    let fill = if joint.driven { DRIVEN } else { WHITE };
    let mut bodies = joint.bodies.iter();
    let on_ground = bodies.any(|&body| stage.scene.bodies[body].ground);
    let towards = stage.camera.towards;
    let axis = |k: usize| joint.axes.get(k).map_or(towards, |axis| Vector3(*axis));
    let flat = |k: usize| stage.camera.facing(&axis(k)).abs() > 1.0 - 1e-9;
    // what it stands on or slides along
    let mut pieces = match joint.kind {
        _ if telescopes(stage, joint) => Vec::new(),
        JointSymbol::Cylindrical | JointSymbol::Prismatic => guide(stage, &at, &axis(0), on_ground),
        _ if !on_ground => Vec::new(),
        JointSymbol::Revolute | JointSymbol::Helical if flat(0) => {
            support(stage, &at, carried(stage, joint))
        }
        JointSymbol::Revolute | JointSymbol::Helical | JointSymbol::Universal => {
            bearing(stage, joint, &axis(0))
        }
        JointSymbol::Spherical => plate(stage, &at, &Vector3::unit(2)),
        JointSymbol::Planar | JointSymbol::Rigid => Vec::new(),
    };
    pieces.extend(match joint.kind {
        JointSymbol::Revolute | JointSymbol::Helical if flat(0) => ball(stage, &at, 0.75, fill),
        JointSymbol::Revolute | JointSymbol::Helical => {
            cylinder(stage, &at, &axis(0), 0.75, 1.1, fill)
        }
        JointSymbol::Cylindrical => cylinder(stage, &at, &axis(0), 0.75, 1.4, fill),
        JointSymbol::Prismatic if telescopes(stage, joint) => {
            cylinder(stage, &at, &axis(0), 0.85, 0.5, fill)
        }
        JointSymbol::Prismatic => block(stage, &at, &axis(0), [1.4, 0.8, 0.8], fill),
        JointSymbol::Universal => {
            let halves = [0, 1].map(|k| cylinder(stage, &at, &axis(k), 0.35, 1.2, fill));
            halves.into_iter().flatten().collect()
        }
        JointSymbol::Spherical => ball(stage, &at, 0.9, fill),
        JointSymbol::Planar => block(stage, &at, &axis(0), [0.3, 1.5, 1.5], fill),
        JointSymbol::Rigid => Vec::new(),
    });
    pieces
}

/// A slide in space between two bodies that both move, as in a leg.
pub(super) fn telescopes(stage: &StagedScene, joint: &JointShape) -> bool {
    let mut bodies = joint.bodies.iter();
    let moves = bodies.all(|&body| !stage.scene.bodies[body].ground);
    joint.kind == JointSymbol::Prismatic && !stage.flat && moves
}

/// The middle of what a joint on ground carries, with others that stand in its place; none if that is nothing that is drawn.
fn carried(stage: &StagedScene, joint: &JointShape) -> Option<Position> {
    let at = Vector3(joint.at);
    let here = |of: &&JointShape| (Vector3(of.at) - at).norm() < 0.1 * stage.metres();
    let bodies = stage.scene.joints.iter().filter(here);
    let bodies = bodies.flat_map(|of| of.bodies.map(|body| &stage.scene.bodies[body]));
    let moved = bodies.filter(|body| !body.ground);
    let points = moved.flat_map(|body| body.lines.iter().flatten().chain(&body.corners));
    let points: Vec<Position> = points.map(|point| Vector3(*point)).collect();
    let sum = points
        .iter()
        .fold(Vector3::zero(), |sum, point| sum + *point);
    (!points.is_empty()).then(|| sum.times(1.0 / points.len() as f64))
}

/// A bearing block: under a level axis, with a cheek at either end, on the side away from the link; a plate under an
/// upright one.
fn bearing(stage: &StagedScene, joint: &JointShape, axis: &Position) -> Vec<Painted> {
    let (at, metres) = (Vector3(joint.at), stage.metres());
    let across = |way: Position| way - axis.times(way.dot(axis));
    let unit = |way: Position| way.times(1.0 / way.norm().max(f64::MIN_POSITIVE));
    let down = across(Vector3([0.0, 0.0, -1.0]));
    let away = at - carried(stage, joint).unwrap_or(at);
    let side = down + unit(across(away)).times(0.8);
    if down.norm() < 0.4 || side.norm() < 0.2 {
        return plate(stage, &at, axis);
    }
    let side = unit(side);
    let third = axis.cross(&side);
    let place = |along: f64, over: f64, below: f64| {
        at + axis.times(along * metres) + third.times(over * metres) + side.times(below * metres)
    };
    let style = OutlineStyle::filled(Colour(0xcccccc)).edged(GROUND, 1.0);
    let face = |corners: [Position; 4]| stage.face(Layer::Ground, &corners, style);
    let square = |x: f64, y: f64| place(1.75 * x, 1.2 * y, 1.35);
    let mut faces = vec![face(CORNERS.map(|(x, y)| square(x, y)))];
    for end in [-1.4, 1.4] {
        faces.push(face([
            place(end, -0.7, 1.35),
            place(end, 0.7, 1.35),
            place(end, 0.7, -0.3),
            place(end, -0.7, -0.3),
        ]));
    }
    faces
}

/// The ball at the end of a rod, with its base.
pub(super) fn rod_end(
    stage: &StagedScene,
    at: &Position,
    other: &Position,
    on_ground: bool,
) -> Vec<Painted> {
    let under = match stage.flat {
        _ if !on_ground => Vec::new(),
        true => support(stage, at, Some(*other)),
        false => plate(stage, at, &Vector3::unit(2)),
    };
    let ball = ball(stage, at, 0.7, INK);
    under.into_iter().chain(ball).collect()
}

/// A round joint.
fn ball(stage: &StagedScene, at: &Position, size: f64, fill: Colour) -> Vec<Painted> {
    let Camera { right, up, .. } = stage.camera;
    let outline = ring(at, &right, &up, size * stage.metres());
    vec![Painted {
        layer: Layer::Pin,
        ..solid(stage, &outline, fill, 0.5)
    }]
}

fn cylinder(
    stage: &StagedScene,
    at: &Position,
    axis: &Position,
    radius: f64,
    half: f64,
    fill: Colour,
) -> Vec<Painted> {
    let [right, up] = across(axis);
    let towards = match stage.camera.facing(axis) < 0.0 {
        true => axis.times(-1.0),
        false => *axis,
    };
    let end = |sign: f64| {
        let middle = *at + towards.times(sign * half * stage.metres());
        ring(&middle, &right, &up, radius * stage.metres())
    };
    let (far, front) = (end(-1.0), end(1.0));
    let whole = stage.camera.hull(&[far, front.clone()].concat());
    vec![
        solid(stage, &whole, fill, 0.5),
        solid(stage, &front, fill, 0.6),
    ]
}

/// A box with its first edge along the axis.
fn block(
    stage: &StagedScene,
    at: &Position,
    axis: &Position,
    halves: [f64; 3],
    fill: Colour,
) -> Vec<Painted> {
    // in the plane of the picture where the axis is, so that the box does not stand askew
    let side = axis.cross(&stage.camera.towards);
    let [right, up] = match side.norm() > 1e-6 && stage.scene.normal.is_some() {
        true => [side.times(1.0 / side.norm()), stage.camera.towards],
        false => across(axis),
    };
    let edges = [*axis, right, up];
    let metres = stage.metres();
    let mut faces = Vec::new();
    for k in 0..3 {
        let (u, v) = ((k + 1) % 3, (k + 2) % 3);
        let out = match stage.camera.facing(&edges[k]) {
            facing if facing.abs() < 1e-9 => continue,
            facing => facing.signum(),
        };
        let middle = *at + edges[k].times(out * halves[k] * metres);
        let corner = |a: f64, b: f64| {
            middle + edges[u].times(a * halves[u] * metres) + edges[v].times(b * halves[v] * metres)
        };
        let face = CORNERS.map(|(a, b)| corner(a, b));
        faces.push(solid(stage, &face, fill, 0.5));
    }
    faces
}

/// The line along which a slide moves, hatched where it is fixed to ground.
fn guide(stage: &StagedScene, at: &Position, axis: &Position, on_ground: bool) -> Vec<Painted> {
    let metres = stage.metres();
    let ends = [-3.5, 3.5].map(|part| *at + axis.times(part * metres));
    let colour = if on_ground { GROUND } else { INK };
    let mut pieces = vec![line(stage, &ends, colour, 1.5)];
    if on_ground && stage.scene.normal.is_some() {
        let side = axis.cross(&stage.camera.towards);
        pieces.extend(hatch(stage, at, axis, &side, 3.5));
    }
    pieces
}

/// A pin on ground: a triangle on a hatched line, below the pin, or above it where what it carries hangs down.
fn support(stage: &StagedScene, at: &Position, carried: Option<Position>) -> Vec<Painted> {
    let metres = stage.metres();
    let Camera { right, up, .. } = stage.camera;
    let way = carried.map_or(up, |middle| middle - *at);
    // it hangs where it goes down by more than 20°
    let up = match way.dot(&up) < -0.35 * way.norm() {
        true => up.times(-1.0),
        false => up,
    };
    let foot = |x: f64| *at + right.times(x * metres) - up.times(1.9 * metres);
    let triangle = [*at, foot(-1.1), foot(1.1)];
    let style = OutlineStyle::filled(Colour(0xdddddd)).edged(GROUND, 1.2);
    let mut pieces = vec![Painted {
        near: stage.near(&[*at]) - 0.2 * metres,
        ..stage.face(Layer::Ground, &triangle, style)
    }];
    let base = *at - up.times(1.9 * metres);
    pieces.push(line(stage, &[foot(-1.6), foot(1.6)], GROUND, 1.5));
    pieces.extend(hatch(stage, &base, &right, &up.times(-1.0), 1.6));
    pieces
}

/// Short strokes along a line, on the side of the ground.
fn hatch(
    stage: &StagedScene,
    at: &Position,
    along: &Position,
    into: &Position,
    half: f64,
) -> Vec<Painted> {
    let metres = stage.metres();
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
        .map(|k| line(stage, &stroke(k), GROUND, 0.8))
        .collect()
}

/// A square of ground under a spatial joint.
fn plate(stage: &StagedScene, at: &Position, axis: &Position) -> Vec<Painted> {
    let metres = stage.metres();
    let [right, up] = across(axis);
    let down = match axis.0[2] < -0.5 {
        true => axis.times(1.3 * metres),
        false => axis.times(-1.3 * metres),
    };
    let side = 1.6 * metres;
    let corner = |(x, y): (f64, f64)| *at + down + right.times(x * side) + up.times(y * side);
    let corners = CORNERS.map(corner);
    let style = OutlineStyle::filled(Colour(0xcccccc)).edged(GROUND, 1.0);
    vec![stage.face(Layer::Ground, &corners, style)]
}

fn line(stage: &StagedScene, points: &[Position], colour: Colour, width: f64) -> Painted {
    Painted {
        layer: Layer::Ground,
        // under the joint that stands on it
        near: stage.near(points) - 0.1 * stage.metres(),
        shape: stage.open(points, OutlineStyle::line(colour, width)),
    }
}

/// A filled outline, a little nearer than its base.
fn solid(stage: &StagedScene, points: &[Position], fill: Colour, nearer: f64) -> Painted {
    let mut face = stage.face(
        Layer::Slide,
        points,
        OutlineStyle::filled(fill).edged(INK, 1.3),
    );
    face.near += nearer * stage.metres();
    face
}

fn ring(middle: &Position, right: &Position, up: &Position, radius: f64) -> Vec<Position> {
    let places = (0..24).map(|k| {
        let (sin, cos) = real::sin_cos(f64::from(k) * std::f64::consts::TAU / 24.0);
        *middle + right.times(radius * cos) + up.times(radius * sin)
    });
    places.collect()
}
