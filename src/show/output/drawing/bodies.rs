//! Links and platforms: plates, bars, and legs that telescope.

use super::{COLOURS, GROUND, Layer, Painted, StagedScene, symbols};
use crate::geometry::Vector3;
use crate::output::canvas::OutlineStyle;
use crate::scene::BodyShape;

/// The shapes of a body.
pub(super) fn body(stage: &StagedScene, index: usize, body: &BodyShape) -> Vec<Painted> {
    let mut pieces = Vec::new();
    let colour = match body.ground {
        true => GROUND,
        false => COLOURS[index % COLOURS.len()],
    };
    let corners: Vec<Vector3<f64>> = body.corners.iter().map(|corner| Vector3(*corner)).collect();
    let outline = stage.camera.hull(&corners);
    // in space the base is a body too; a plane shows ground where it is
    let plate = !(body.ground && stage.flat) && outline.len() > 2;
    if plate {
        let (fill, edge) = if body.ground { (0.12, 1.0) } else { (0.3, 2.0) };
        let style = OutlineStyle {
            fill: Some((colour, fill)),
            ..OutlineStyle::line(colour, edge)
        };
        pieces.push(stage.face(Layer::Body, &outline, style));
    }
    // a leg that telescopes: its cylinder, and its piston rod
    let [barrel, piston] = [0, 1].map(|end| {
        let mut joints = stage.scene.joints.iter();
        joints.any(|joint| joint.bodies[end] == index && symbols::telescopes(stage, joint))
    });
    let width = match (body.ground, barrel, piston) {
        (true, ..) => 2.0,
        (_, true, _) => 8.0,
        (_, _, true) => 3.0,
        _ => 4.0,
    };
    let style = OutlineStyle::line(colour, width);
    let lines = body.lines.iter();
    pieces.extend(lines.flat_map(|points| stage.line(points, Layer::Body, style)));
    // a platform has no lines of a table, and a base on two bearings no plate: their corners are all that is known of them
    if !(plate || body.ground && stage.flat) && body.lines.is_empty() {
        pieces.extend(stage.line(&body.corners, Layer::Body, style));
    }
    pieces
}
