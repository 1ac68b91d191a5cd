//! A scene as SVG: bodies as lines and plates, joints by the symbols of the field, in orthographic projection.
//!
//! A planar mechanism is seen along the normal of its plane and drawn as a kinematic diagram: pins, sliders in guides,
//! ground hatched. A spatial one is drawn from the back to the front, with joints as small solids.

mod camera;
mod labels;
mod symbols;

pub use camera::View;

use svg::Document;
use svg::node::element::{Line, Polygon, Polyline, Rectangle, Text};

use crate::geometry::Vector3;
use crate::scene::{BodyShape, Scene, Triple};
use camera::Camera;
use labels::Labels;

/// How a scene is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawingSettings {
    /// From where.
    pub view: View,
    /// Whether joints, rods and platforms are named.
    pub labels: bool,
}

/// Size of a picture in pixels, and the room around what is drawn.
const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 520.0;
const MARGIN: f64 = 60.0;
/// Pictures side by side, where there are several.
const COLUMNS: usize = 3;

/// Colours that people with any colour vision tell apart, from M. Okabe and K. Ito 2008.
const COLOURS: [&str; 6] = [
    "#0072B2", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#8a7a2a",
];
const GROUND: &str = "#666666";
const INK: &str = "#222222";
const DRIVEN: &str = "#E69F00";

type Pixel = (f64, f64);

/// Something drawn. In the plane what is of a higher layer covers what is of a lower one; in space what is nearer to the
/// viewer, in m, covers what is farther.
struct Piece {
    layer: Layer,
    near: f64,
    element: Element,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Layer {
    Body,
    Ground,
    Slide,
    Pin,
}

enum Element {
    Polygon(Polygon),
    Polyline(Polyline),
}

/// Scenes with their titles as one picture, all to the same scale.
pub fn svg(scenes: &[(String, Scene)], settings: &DrawingSettings) -> String {
    let columns = scenes.len().clamp(1, COLUMNS);
    let rows = scenes.len().div_ceil(columns);
    let (width, height) = (columns as f64 * WIDTH, rows as f64 * HEIGHT);
    let mut document = Document::new()
        .set("width", width)
        .set("height", height)
        .set("viewBox", (0, 0, width, height))
        .set("font-family", "sans-serif")
        .set("stroke-linejoin", "round")
        .set("stroke-linecap", "round")
        .add(
            Rectangle::new()
                .set("width", width)
                .set("height", height)
                .set("fill", "#ffffff"),
        );
    let scale = scenes.iter().map(|(_, scene)| {
        let camera = Camera::new(settings.view, scene.normal);
        fit(&camera, scene).1
    });
    let scale = scale.fold(f64::INFINITY, f64::min);
    for (i, (title, scene)) in scenes.iter().enumerate() {
        let corner = ((i % columns) as f64 * WIDTH, (i / columns) as f64 * HEIGHT);
        document = draw(document, scene, title, settings, corner, scale);
    }
    document.to_string()
}

/// The middle of what is seen, in m across and up, and how many pixels a metre may take.
fn fit(camera: &Camera, scene: &Scene) -> (Pixel, f64) {
    let points = scene.points();
    let bounds = |of: fn(&(f64, f64, f64)) -> f64| {
        let seen = points.iter().map(|point| of(&camera.project(point)));
        seen.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        })
    };
    let (across, up) = (bounds(|p| p.0), bounds(|p| p.1));
    if points.is_empty() {
        return ((0.0, 0.0), 1.0);
    }
    let room = |(low, high): (f64, f64), pixels: f64| (pixels - 2.0 * MARGIN) / (high - low);
    let scale = room(across, WIDTH).min(room(up, HEIGHT));
    let middle = (0.5 * (across.0 + across.1), 0.5 * (up.0 + up.1));
    (middle, if scale.is_finite() { scale } else { 1.0 })
}

/// What is drawn and where: a scene on its part of the sheet.
struct Sheet<'s> {
    scene: &'s Scene,
    camera: Camera,
    middle: Pixel,
    centre: Pixel,
    scale: f64,
    /// Half the size of a joint in pixels.
    size: f64,
}

impl Sheet<'_> {
    fn pixel(&self, point: &Vector3<f64>) -> Pixel {
        let (x, y, _) = self.camera.project(&point.0);
        let place = |centre: f64, x: f64| ((centre + x * self.scale) * 10.0).round() / 10.0;
        (
            place(self.centre.0, x - self.middle.0),
            place(self.centre.1, self.middle.1 - y),
        )
    }

    fn near(&self, points: &[Vector3<f64>]) -> f64 {
        let depth = points.iter().map(|point| self.camera.project(&point.0).2);
        depth.sum::<f64>() / points.len().max(1) as f64
    }

    /// A line of a body, in pieces so short that joints stand before it here and behind it there.
    fn line(&self, points: &[Triple], colour: &str, width: f64) -> Vec<Piece> {
        let pairs = points.windows(2);
        let parts = pairs.flat_map(|pair| self.parts(Vector3(pair[0]), Vector3(pair[1])));
        let pieces = parts.map(|part| {
            let line = self.polyline(&part).set("stroke", colour);
            Piece {
                layer: Layer::Body,
                near: self.near(&part),
                element: Element::Polyline(line.set("stroke-width", width)),
            }
        });
        pieces.collect()
    }

    /// A line cut where it changes its depth by the size of a joint.
    fn parts(&self, from: Vector3<f64>, to: Vector3<f64>) -> Vec<[Vector3<f64>; 2]> {
        let step = to - from;
        let number = (self.camera.facing(&step).abs() / self.metres())
            .ceil()
            .clamp(1.0, 100.0);
        let at = |k: usize| from + step.times(k as f64 / number);
        (0..number as usize).map(|k| [at(k), at(k + 1)]).collect()
    }

    /// The size of a joint in m.
    fn metres(&self) -> f64 {
        self.size / self.scale
    }

    fn polygon(&self, points: &[Vector3<f64>]) -> Polygon {
        Polygon::new().set(
            "points",
            written(points.iter().map(|point| self.pixel(point))),
        )
    }

    fn polyline(&self, points: &[Vector3<f64>]) -> Polyline {
        let places = written(points.iter().map(|point| self.pixel(point)));
        Polyline::new().set("points", places).set("fill", "none")
    }
}

fn written(pixels: impl Iterator<Item = Pixel>) -> String {
    let places: Vec<String> = pixels.map(|(x, y)| format!("{x},{y}")).collect();
    places.join(" ")
}

fn draw(
    document: Document,
    scene: &Scene,
    title: &str,
    settings: &DrawingSettings,
    corner: Pixel,
    scale: f64,
) -> Document {
    let camera = Camera::new(settings.view, scene.normal);
    let (middle, _) = fit(&camera, scene);
    let mut sheet = Sheet {
        scene,
        camera,
        middle,
        centre: (corner.0 + WIDTH / 2.0, corner.1 + HEIGHT / 2.0 + 10.0),
        scale,
        size: 0.0,
    };
    sheet.size = symbol_size(&sheet);
    let mut pieces: Vec<Piece> = Vec::new();
    for (i, body) in scene.bodies.iter().enumerate() {
        pieces.extend(self::body(&sheet, i, body));
    }
    for rod in &scene.rods {
        let colour = if rod.driven { DRIVEN } else { INK };
        pieces.extend(sheet.line(&rod.ends, colour, 3.0));
        pieces.extend(
            rod.ends
                .iter()
                .flat_map(|end| symbols::ball(&sheet, &Vector3(*end), 0.7, INK)),
        );
    }
    for joint in &scene.joints {
        pieces.extend(symbols::joint(&sheet, joint));
    }
    let flat = settings.view == View::Natural && scene.normal.is_some();
    let place = |piece: &Piece| {
        (
            flat.then_some(piece.layer),
            if flat { 0.0 } else { piece.near },
        )
    };
    pieces.sort_by(|a, b| {
        let ((a, before), (b, after)) = (place(a), place(b));
        a.cmp(&b).then(before.total_cmp(&after))
    });
    let mut document = pieces
        .into_iter()
        .fold(document, |document, piece| match piece.element {
            Element::Polygon(polygon) => document.add(polygon),
            Element::Polyline(line) => document.add(line),
        });
    document = document.add(
        text(title, (corner.0 + WIDTH / 2.0, corner.1 + 28.0), 15.0).set("text-anchor", "middle"),
    );
    for (name, end) in sheet.camera.triad() {
        let from = (corner.0 + 36.0, corner.1 + HEIGHT - 36.0);
        let to = |part: f64| (from.0 + part * end.0, from.1 - part * end.1);
        let (tip, letter) = (to(26.0), to(36.0));
        document = document
            .add(
                Line::new()
                    .set("x1", from.0)
                    .set("y1", from.1)
                    .set("x2", tip.0)
                    .set("y2", tip.1)
                    .set("stroke", GROUND)
                    .set("stroke-width", 1.5),
            )
            .add(text(name, (letter.0, letter.1 + 4.0), 11.0).set("text-anchor", "middle"));
    }
    if settings.labels {
        for (name, place) in Labels::of(&sheet) {
            document = document.add(text(&name, place, labels::LETTERS));
        }
    }
    document
}

fn text(words: &str, at: Pixel, size: f64) -> Text {
    let round = |x: f64| (x * 10.0).round() / 10.0;
    Text::new(words)
        .set("x", round(at.0))
        .set("y", round(at.1))
        .set("font-size", size)
        .set("fill", INK)
}

/// A joint is as large as its neighbours leave room for, within what can be seen and what does not hide the links.
fn symbol_size(sheet: &Sheet) -> f64 {
    let places: Vec<Pixel> = (sheet.scene.joints.iter())
        .map(|joint| sheet.pixel(&Vector3(joint.at)))
        .collect();
    let mut room: f64 = f64::INFINITY;
    for (i, a) in places.iter().enumerate() {
        for b in &places[i + 1..] {
            let apart = (a.0 - b.0).hypot(a.1 - b.1);
            if apart > 4.0 {
                room = room.min(apart);
            }
        }
    }
    (0.3 * room).clamp(5.0, 11.0)
}

fn body(sheet: &Sheet, index: usize, body: &BodyShape) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let colour = match body.ground {
        true => GROUND,
        false => COLOURS[index % COLOURS.len()],
    };
    let corners: Vec<Vector3<f64>> = body.corners.iter().map(|corner| Vector3(*corner)).collect();
    let outline = sheet.camera.hull(&corners);
    let plate = !body.ground && outline.len() > 2;
    if plate {
        let polygon = sheet
            .polygon(&outline)
            .set("fill", colour)
            .set("fill-opacity", 0.3);
        let polygon = polygon.set("stroke", colour).set("stroke-width", 2);
        pieces.push(Piece {
            layer: Layer::Body,
            near: sheet.near(&outline),
            element: Element::Polygon(polygon),
        });
    }
    let width = if body.ground { 2.0 } else { 4.0 };
    let lines = body.lines.iter();
    pieces.extend(lines.flat_map(|points| sheet.line(points, colour, width)));
    // a platform has no lines of a table: its corners are all that is known of it
    if !body.ground && !plate && body.lines.is_empty() {
        pieces.extend(sheet.line(&body.corners, colour, width));
    }
    pieces
}
