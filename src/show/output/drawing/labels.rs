//! Labels beside the things they name, where there is room.

use super::super::canvas::LETTERS;
use super::{Pixel, SIZE, StagedScene};
use crate::geometry::Vector3;
use crate::number::real;
use crate::scene::JointShape;

/// A rectangle in pixels: left, top, right, bottom.
type Area = [f64; 4];

/// Names with the lower left corners of their places.
pub(super) struct Labels {
    sheet: Area,
    taken: Vec<Area>,
}

impl Labels {
    /// Labels of everything that has a name beside it anyhow and, if all are wanted, of everything named in a scene.
    pub fn of(
        stage: &StagedScene,
        all: bool,
        beside: Vec<(String, Vector3<f64>)>,
    ) -> Vec<(String, Pixel)> {
        let scene = stage.scene;
        // a hinge on two bearings has one label
        let is_same = |of: &JointShape, joint: &JointShape| {
            of.names == joint.names && of.bodies == joint.bodies
        };
        let joints = scene.joints.iter().enumerate();
        let joints = joints
            .filter(|(i, joint)| !scene.joints[..*i].iter().any(|of| is_same(of, joint)))
            .map(|(_, joint)| (joint.names.join(", "), Vector3(joint.at)));
        let rods = scene.rods.iter().map(|rod| {
            let [a, b] = rod.ends.map(Vector3);
            (rod.name.clone(), (a + b).times(0.5))
        });
        let bodies = scene.bodies.iter();
        let platforms = bodies.filter(|body| body.platform && !body.corners.is_empty());
        let platforms = platforms.map(|body| {
            let corners = body.corners.iter();
            let sum = corners.fold(Vector3::zero(), |sum, corner| sum + Vector3(*corner));
            let middle = sum.times(1.0 / body.corners.len() as f64);
            (body.name.clone(), middle)
        });
        let reach = 1.4 * stage.size;
        let joints_taken = scene.joints.iter().map(|joint| {
            let (x, y) = stage.pixel(&Vector3(joint.at));
            // what a joint on ground stands on
            let grounded = joint.bodies.iter().any(|&body| scene.bodies[body].ground);
            let foot = if grounded { 2.7 * stage.size } else { reach };
            [x - reach, y - reach, x + reach, y + foot]
        });
        let lines = scene.bodies.iter().flat_map(|body| &body.lines);
        let lines = lines.flat_map(|line| line.windows(2).map(|pair| [pair[0], pair[1]]));
        let lines = lines.chain(scene.rods.iter().map(|rod| rod.ends));
        let lines_taken = lines.flat_map(|ends| {
            let [a, b] = ends.map(|end| stage.pixel(&Vector3(end)));
            let steps = (real::hypot(a.0 - b.0, a.1 - b.1) / 6.0).ceil().max(1.0);
            (0..=steps as usize).map(move |k| {
                let part = k as f64 / steps;
                let (x, y) = (a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1));
                [x - 3.0, y - 3.0, x + 3.0, y + 3.0]
            })
        });
        // no label covers the title, 34 pixels high
        let mut labels = Labels {
            sheet: [
                stage.centre.0 - SIZE.0 / 2.0,
                stage.centre.1 - SIZE.1 / 2.0 + 34.0,
                stage.centre.0 + SIZE.0 / 2.0,
                stage.centre.1 + SIZE.1 / 2.0,
            ],
            taken: joints_taken.chain(lines_taken).collect(),
        };
        let traced = scene.paths.iter();
        let traced =
            traced.filter_map(|path| Some((path.name.clone(), Vector3(*path.points.first()?))));
        let named = joints.chain(rods).chain(platforms).chain(traced);
        (beside.into_iter())
            .chain(named.filter(|_| all))
            .map(|(name, at)| labels.place(name, stage.pixel(&at), reach))
            .collect()
    }

    fn place(&mut self, name: String, (x, y): Pixel, reach: f64) -> (String, Pixel) {
        let width = 0.58 * LETTERS * name.chars().count() as f64;
        let area = |(dx, dy): (f64, f64), far: f64| {
            let left = x + dx * far + 0.5 * (dx - 1.0) * width;
            let bottom = y + dy * far + 0.5 * (dy + 1.0) * LETTERS;
            [left, bottom - LETTERS, left + width, bottom]
        };
        let ways = [
            (1.0, -1.0),
            (1.0, 1.0),
            (-1.0, -1.0),
            (-1.0, 1.0),
            (1.0, 0.0),
            (-1.0, 0.0),
            (0.0, -1.0),
            (0.0, 1.0),
        ];
        let distances = [1.0, 1.6, 2.4].map(|far| far * reach).into_iter();
        let places = distances.flat_map(|far| ways.map(|way| area(way, far)));
        let covered = |place: &Area| -> f64 {
            let of = |taken: &Area| {
                let across = place[2].min(taken[2]) - place[0].max(taken[0]);
                let down = place[3].min(taken[3]) - place[1].max(taken[1]);
                across.max(0.0) * down.max(0.0)
            };
            let whole = (place[2] - place[0]) * (place[3] - place[1]);
            self.taken.iter().map(of).sum::<f64>() + 10.0 * (whole - of(&self.sheet))
        };
        let best = places.min_by(|a, b| covered(a).total_cmp(&covered(b)));
        let best = best.unwrap_or_else(|| area((1.0, -1.0), reach));
        self.taken.push(best);
        (name, (best[0], best[3] - 2.0))
    }
}
