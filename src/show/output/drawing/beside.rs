//! Marks beside the mechanism: limits, gears, frames, axes of freedoms gained, instant centres, forces.

use std::f64::consts::TAU;

use super::{GROUND, Layer, Painted, Position, StagedScene};
use crate::algebra::SiUnit;
use crate::geometry::Vector3;
use crate::number::real;
use crate::output::canvas::{Colour, INK, OutlineStyle, Pixel, Shape};
use crate::output::quantity::three_digits;
use crate::scene::{ForceArrow, ScrewAxis, Travel, Triple, across};

const LIMIT: Colour = Colour(0x8a7a2a);
const LOAD: Colour = Colour(0xD55E00);
const REACTION: Colour = Colour(0x009E73);
const GAINED: Colour = Colour(0xCC79A7);
const AXES: [Colour; 3] = [Colour(0xD55E00), Colour(0x009E73), Colour(0x0072B2)];

/// Marks that the mechanism covers.
pub(super) fn under(stage: &StagedScene) -> Vec<Painted> {
    let mut pieces = Vec::new();
    for wheel in &stage.scene.wheels {
        let dashed = OutlineStyle::line(GROUND, 1.2).dashed(7.0, 4.0);
        pieces.extend(stage.line(&wheel.points(), Layer::Under, dashed));
    }
    for travel in &stage.scene.travels {
        let style = OutlineStyle::line(LIMIT, 1.5);
        for line in travelled(stage, travel) {
            pieces.extend(stage.line(&line, Layer::Under, style));
        }
    }
    pieces
}

/// The way of a joint from limit to limit, with a stroke across each end.
fn travelled(stage: &StagedScene, travel: &Travel) -> [Vec<Triple>; 3] {
    let metres = stage.metres();
    let (at, axis) = (Vector3(travel.at), Vector3(travel.axis));
    let [low, high] = travel.ends;
    let stroke = |ends: [Position; 2]| ends.map(|end| end.0).to_vec();
    match travel.arm {
        Some(arm) => {
            let (radius, arm) = (3.4 * metres, Vector3(arm));
            // no more than once round
            let high = high.min(low + TAU);
            let side = axis.cross(&arm);
            let out = |angle: f64, far: f64| {
                let (sin, cos) = real::sin_cos(angle);
                at + (arm.times(cos) + side.times(sin)).times(far * radius)
            };
            let parts = ((high - low) / 0.08).ceil().max(1.0) as usize;
            let place = |k: usize| out(low + (high - low) * k as f64 / parts as f64, 1.0).0;
            let end = |angle: f64| stroke([out(angle, 0.8), out(angle, 1.2)]);
            [(0..=parts).map(place).collect(), end(low), end(high)]
        }
        None => {
            let side = match axis.cross(&stage.camera.towards) {
                side if side.norm() > 1e-6 => side.times(1.0 / side.norm()),
                _ => across(&axis)[0],
            };
            // beside the guide
            let place = |far: f64, out: f64| at + axis.times(far) + side.times(out * metres);
            let end = |far: f64| stroke([place(far, -1.2), place(far, -2.4)]);
            let line = stroke([place(low, -1.8), place(high, -1.8)]);
            [line, end(low), end(high)]
        }
    }
}

/// Marks that cover the mechanism, and the names beside it.
pub(super) fn over(stage: &StagedScene) -> (Vec<Shape>, Vec<(String, Position)>) {
    let (mut shapes, mut named) = (Vec::new(), Vec::new());
    let scene = stage.scene;
    let metres = stage.metres();
    for frame in &scene.frames {
        let at = Vector3(frame.at);
        for (axis, colour) in frame.axes.iter().zip(AXES) {
            let tip = at + Vector3(*axis).times(2.5 * metres);
            shapes.push(stage.open(&[at, tip], OutlineStyle::line(colour, 1.6)));
        }
        named.push((frame.name.clone(), at));
    }
    for screw in &scene.screws {
        let (at, along) = (Vector3(screw.at), Vector3(screw.along));
        let half = along.times(7.0 * metres);
        let dashed = OutlineStyle::line(GAINED, 2.0).dashed(9.0, 4.0);
        shapes.push(stage.open(&[at - half, at + half], dashed));
        shapes.extend(head(stage.pixel(&at), stage.pixel(&(at + half)), GAINED));
        if screw.pitch.is_some() {
            shapes.extend(turning(stage, at, along, 2.2 * metres, GAINED).0);
        }
        named.push((movement(screw), at + half));
    }
    for centre in &scene.centres {
        let (x, y) = stage.pixel(&Vector3(centre.at));
        let (far, style) = (4.0, OutlineStyle::line(INK, 1.5));
        shapes.push(Shape::line([(x - far, y - far), (x + far, y + far)], style));
        shapes.push(Shape::line([(x - far, y + far), (x + far, y - far)], style));
        named.push((centre.name.clone(), Vector3(centre.at)));
    }
    let sizes = |of: fn(&ForceArrow) -> Triple| {
        let sizes = scene.arrows.iter().map(|arrow| Vector3(of(arrow)).norm());
        sizes.fold(0.0, f64::max)
    };
    let largest = [sizes(|arrow| arrow.force), sizes(|arrow| arrow.moment)];
    for arrow in &scene.arrows {
        force(stage, arrow, largest, &mut shapes, &mut named);
    }
    (shapes, named)
}

/// Motion of a body about and along a screw, in words.
pub fn movement(screw: &ScrewAxis) -> String {
    match screw.pitch {
        None => format!("{} slides", screw.name),
        Some(0.0) => format!("{} turns", screw.name),
        Some(pitch) => {
            let pitch = three_digits(pitch, SiUnit::METRE);
            format!("{} screws, {pitch}/rad", screw.name)
        }
    }
}

/// A force as an arrow that begins, or if it is applied ends, at its point; a moment as an arc about its axis.
fn force(
    stage: &StagedScene,
    arrow: &ForceArrow,
    largest: [f64; 2],
    shapes: &mut Vec<Shape>,
    named: &mut Vec<(String, Position)>,
) {
    /// A smaller part of the largest is not seen.
    const UNSEEN: f64 = 1e-6;
    let colour = if arrow.applied { LOAD } else { REACTION };
    let at = Vector3(arrow.at);
    let force = Vector3(arrow.force);
    let size = force.norm();
    if size > UNSEEN * largest[0] {
        // the largest is 50 pixels long
        let step = force.times(50.0 / largest[0] / stage.fit.scale);
        let (tail, tip) = match arrow.applied {
            true => (at - step, at),
            false => (at, at + step),
        };
        shapes.push(stage.open(&[tail, tip], OutlineStyle::line(colour, 2.4)));
        shapes.extend(head(stage.pixel(&tail), stage.pixel(&tip), colour));
        let end = if arrow.applied { tail } else { tip };
        named.push((three_digits(size, SiUnit::NEWTON), end));
    }
    let moment = Vector3(arrow.moment);
    let size = moment.norm();
    if size > UNSEEN * largest[1] {
        let radius = (1.6 + 1.2 * size / largest[1]) * stage.metres();
        let (arc, place) = turning(stage, at, moment.times(1.0 / size), radius, colour);
        shapes.extend(arc);
        named.push((three_digits(size, SiUnit::NEWTON_METRE), place));
    }
}

/// An arc about an axis as an arrow, and a place beside it.
fn turning(
    stage: &StagedScene,
    at: Position,
    axis: Position,
    radius: f64,
    colour: Colour,
) -> (Vec<Shape>, Position) {
    let [right, up] = across(&axis);
    let place = |k: u32| {
        let (sin, cos) = real::sin_cos(0.75 * TAU * f64::from(k) / 24.0);
        at + (right.times(cos) + up.times(sin)).times(radius)
    };
    let arc: Vec<Position> = (0..=24).map(place).collect();
    let line = stage.open(&arc, OutlineStyle::line(colour, 2.0));
    let head = head(stage.pixel(&arc[22]), stage.pixel(&arc[24]), colour);
    (std::iter::once(line).chain(head).collect(), arc[8])
}

/// The head of an arrow; none if it points to the viewer.
fn head(from: Pixel, to: Pixel, colour: Colour) -> Option<Shape> {
    let length = real::hypot(to.0 - from.0, to.1 - from.1);
    let (x, y) = ((to.0 - from.0) / length, (to.1 - from.1) / length);
    let (long, wide) = (9.0, 3.5);
    let foot = |side: f64| {
        (
            to.0 - long * x - side * wide * y,
            to.1 - long * y + side * wide * x,
        )
    };
    (length > 3.0)
        .then(|| Shape::polygon([to, foot(1.0), foot(-1.0)], OutlineStyle::filled(colour)))
}
