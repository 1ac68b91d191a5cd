//! A scene as a picture: bodies as lines and plates, joints by the symbols of the field, in orthographic projection.
//!
//! A planar mechanism is seen along the normal of its plane and drawn as a kinematic diagram: pins, sliders in guides,
//! ground hatched. A spatial one is drawn from the back to the front, with joints as small solids.

mod beside;
mod bodies;
mod camera;
mod labels;
mod symbols;

pub use beside::movement;
pub(crate) use camera::Camera;
pub use camera::Viewpoint;

use super::canvas::{Anchor, Canvas, Colour, INK, LETTERS, OutlineStyle, Pixel, Shape};
use crate::geometry::Vector3;
use crate::number::{real, sorting::sort_by};
use crate::scene::{Scene, Triple};
use labels::Labels;

/// Settings of a drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawingSettings {
    /// View of the scene.
    pub view: Viewpoint,
    /// True if joints, rods and platforms are named.
    pub labels: bool,
}

/// A scene with further scenes drawn faintly behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Title above it.
    pub title: String,
    /// The scene.
    pub scene: Scene,
    /// Further configurations of the mechanism, drawn faintly.
    pub ghosts: Vec<Scene>,
}

impl Panel {
    /// A scene of a mechanism, in one of its modes if that has a number.
    pub fn new(mechanism: &str, mode: Option<usize>, scene: Scene) -> Self {
        Panel {
            title: match mode {
                Some(mode) => format!("{mechanism}: mode {mode}"),
                None => mechanism.to_owned(),
            },
            scene,
            ghosts: Vec::new(),
        }
    }
}

/// Width and height of a picture in pixels.
const SIZE: (f64, f64) = (640.0, 520.0);
/// Pictures side by side, where there are several.
const COLUMNS: usize = 3;
/// Opacity of parts that lie behind.
const FAINT: f64 = 0.3;

/// Colours that people with any colour vision distinguish, from M. Okabe and K. Ito 2008.
pub(crate) const COLOURS: [Colour; 6] = [
    Colour(0x0072B2),
    Colour(0x009E73),
    Colour(0xCC79A7),
    Colour(0x56B4E9),
    Colour(0xD55E00),
    Colour(0x8a7a2a),
];
pub(crate) const GROUND: Colour = Colour(0x666666);
pub(crate) const DRIVEN: Colour = Colour(0xE69F00);
pub(crate) const PATH: Colour = Colour(0xD55E00);

/// A place in ground, in m.
type Position = Vector3<f64>;

/// Something drawn. In the plane what is of a higher layer covers what is of a lower one; in space what is nearer to the
/// viewer, in m, covers what is farther.
struct Painted {
    layer: Layer,
    near: f64,
    shape: Shape,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Layer {
    Under,
    Body,
    Path,
    Ground,
    Slide,
    Pin,
}

/// Scenes with their titles as one picture, all to the same scale.
pub fn sheet(panels: &[Panel], settings: &DrawingSettings) -> Canvas {
    let columns = panels.len().clamp(1, COLUMNS);
    let rows = panels.len().div_ceil(columns);
    let mut canvas = Canvas {
        width: columns as f64 * SIZE.0,
        height: rows as f64 * SIZE.1,
        shapes: Vec::new(),
    };
    let fits = panels.iter().map(|panel| {
        let camera = Camera::new(settings.view, panel.scene.normal);
        Framing::of(&camera, std::iter::once(&panel.scene).chain(&panel.ghosts))
    });
    let fits: Vec<Framing> = fits.collect();
    let scale = fits.iter().map(|fit| fit.scale);
    let scale = scale.fold(f64::INFINITY, f64::min);
    for (i, (panel, fit)) in panels.iter().zip(fits).enumerate() {
        let corner = ((i % columns) as f64 * SIZE.0, (i / columns) as f64 * SIZE.1);
        let fit = Framing { scale, ..fit };
        canvas
            .shapes
            .extend(draw(panel, settings, corner, fit, None));
    }
    canvas
}

/// One mechanism in several configurations, seen from one place.
pub fn frames(panels: &[Panel], settings: &DrawingSettings) -> Vec<Canvas> {
    let Some(Panel { scene: first, .. }) = panels.first() else {
        return Vec::new();
    };
    let camera = Camera::new(settings.view, first.normal);
    let fit = Framing::of(&camera, panels.iter().map(|panel| &panel.scene));
    let size = StagedScene::new(first, settings.view, fit, (0.0, 0.0)).size;
    let frame = |panel: &Panel| Canvas {
        width: SIZE.0,
        height: SIZE.1,
        shapes: draw(panel, settings, (0.0, 0.0), fit, Some(size)),
    };
    panels.iter().map(frame).collect()
}

/// The middle of the view, in m across and up, and the number of pixels for a metre.
#[derive(Clone, Copy)]
pub(crate) struct Framing {
    pub middle: (f64, f64),
    pub scale: f64,
}

impl Framing {
    fn of<'s>(camera: &Camera, scenes: impl IntoIterator<Item = &'s Scene>) -> Self {
        let points: Vec<Triple> = scenes.into_iter().flat_map(Scene::points).collect();
        let [across, up] = camera.bounds(&points);
        if points.is_empty() {
            return Framing {
                middle: (0.0, 0.0),
                scale: 1.0,
            };
        }
        // a margin of 60 pixels on either side
        let room = |(low, high): (f64, f64), pixels: f64| (pixels - 120.0) / (high - low);
        let scale = room(across, SIZE.0).min(room(up, SIZE.1));
        Framing {
            middle: (0.5 * (across.0 + across.1), 0.5 * (up.0 + up.1)),
            scale: if scale.is_finite() { scale } else { 1.0 },
        }
    }
}

/// A scene with its part of the picture.
struct StagedScene<'s> {
    scene: &'s Scene,
    camera: Camera,
    flat: bool,
    fit: Framing,
    centre: Pixel,
    /// Half the size of a joint in pixels.
    size: f64,
}

impl<'s> StagedScene<'s> {
    fn new(scene: &'s Scene, view: Viewpoint, fit: Framing, centre: Pixel) -> Self {
        let mut stage = StagedScene {
            scene,
            camera: Camera::new(view, scene.normal),
            flat: view == Viewpoint::Natural && scene.normal.is_some(),
            fit,
            centre,
            size: 0.0,
        };
        stage.size = symbol_size(&stage);
        stage
    }

    fn pixel(&self, point: &Vector3<f64>) -> Pixel {
        let (x, y, _) = self.camera.project(&point.0);
        (
            self.centre.0 + (x - self.fit.middle.0) * self.fit.scale,
            self.centre.1 + (self.fit.middle.1 - y) * self.fit.scale,
        )
    }

    fn near(&self, points: &[Vector3<f64>]) -> f64 {
        let depth = points.iter().map(|point| self.camera.project(&point.0).2);
        depth.sum::<f64>() / points.len().max(1) as f64
    }

    /// A line in pieces so short that joints stand before it here and behind it there.
    fn line(&self, points: &[Triple], layer: Layer, style: OutlineStyle) -> Vec<Painted> {
        let pairs = points.windows(2);
        let parts = pairs.flat_map(|pair| self.parts(Vector3(pair[0]), Vector3(pair[1])));
        let pieces = parts.map(|part| Painted {
            layer,
            near: self.near(&part),
            shape: self.open(&part, style),
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
        self.size / self.fit.scale
    }

    /// A face as far from the viewer as its corners are on the mean.
    fn face(&self, layer: Layer, corners: &[Vector3<f64>], style: OutlineStyle) -> Painted {
        Painted {
            layer,
            near: self.near(corners),
            shape: self.polygon(corners, style),
        }
    }

    fn polygon(&self, points: &[Vector3<f64>], style: OutlineStyle) -> Shape {
        Shape::polygon(points.iter().map(|point| self.pixel(point)), style)
    }

    fn open(&self, points: &[Vector3<f64>], style: OutlineStyle) -> Shape {
        Shape::line(points.iter().map(|point| self.pixel(point)), style)
    }

    /// The mechanism, what covers the other last.
    fn shapes(&self) -> impl Iterator<Item = Shape> + use<> {
        let mut pieces: Vec<Painted> = beside::under(self);
        for (i, of) in self.scene.bodies.iter().enumerate() {
            pieces.extend(bodies::body(self, i, of));
        }
        for rod in &self.scene.rods {
            pieces.extend(self.line(&rod.ends, Layer::Body, OutlineStyle::line(INK, 3.0)));
            if rod.driven {
                // a cylinder about its piston rod
                let [from, to] = rod.ends.map(Vector3);
                let barrel = [0.12, 0.58].map(|part| (from + (to - from).times(part)).0);
                let style = OutlineStyle::line(DRIVEN, 8.0);
                pieces.extend(
                    (self.line(&barrel, Layer::Slide, style).into_iter()).map(|piece| Painted {
                        near: piece.near + 0.5 * self.metres(),
                        ..piece
                    }),
                );
            }
            let [a, b] = rod.ends.map(Vector3);
            for ((end, other), body) in [(a, b), (b, a)].into_iter().zip(rod.bodies) {
                let on_ground = self.scene.bodies[body].ground;
                pieces.extend(symbols::rod_end(self, &end, &other, on_ground));
            }
        }
        for joint in &self.scene.joints {
            pieces.extend(symbols::joint(self, joint));
        }
        for path in self.scene.paths.iter().filter(|path| path.points.len() > 1) {
            pieces.extend(match self.flat {
                true => vec![Painted {
                    layer: Layer::Path,
                    near: 0.0,
                    shape: Shape::line(
                        path.points.iter().map(|point| self.pixel(&Vector3(*point))),
                        OutlineStyle::line(PATH, 1.6),
                    ),
                }],
                false => self.line(&path.points, Layer::Path, OutlineStyle::line(PATH, 1.6)),
            });
        }
        sort_by(&mut pieces, |a, b| match self.flat {
            true => a.layer.cmp(&b.layer),
            false => a.near.total_cmp(&b.near),
        });
        pieces.into_iter().map(|piece| piece.shape)
    }
}

/// A mechanism in several places in the axes of a chart, the last of them in full.
pub(crate) fn strobe(scenes: &[Scene], view: Viewpoint, fit: Framing, centre: Pixel) -> Vec<Shape> {
    let mut shapes = Vec::new();
    for (i, scene) in scenes.iter().enumerate() {
        let stage = StagedScene::new(scene, view, fit, centre);
        let part = if i + 1 < scenes.len() { FAINT } else { 1.0 };
        shapes.extend(stage.shapes().map(|shape| shape.faint(part)));
    }
    shapes
}

fn draw(
    panel: &Panel,
    settings: &DrawingSettings,
    corner: Pixel,
    fit: Framing,
    size: Option<f64>,
) -> Vec<Shape> {
    let centre = (corner.0 + SIZE.0 / 2.0, corner.1 + SIZE.1 / 2.0);
    let mut stage = StagedScene::new(&panel.scene, settings.view, fit, centre);
    stage.size = size.unwrap_or(stage.size);
    let mut shapes = Vec::new();
    for scene in &panel.ghosts {
        let ghost = StagedScene {
            size: stage.size,
            ..StagedScene::new(scene, settings.view, fit, centre)
        };
        shapes.extend(ghost.shapes().map(|shape| shape.faint(FAINT)));
    }
    shapes.extend(stage.shapes());
    let title = (corner.0 + SIZE.0 / 2.0, corner.1 + 28.0);
    shapes.push(Shape::words(&panel.title, title, 15.0, Anchor::Middle));
    // below and beside what the margin leaves to the mechanism
    let from = (corner.0 + 20.0, corner.1 + SIZE.1 - 18.0);
    for (name, end) in stage.camera.triad() {
        let to = |part: f64| (from.0 + part * end.0, from.1 - part * end.1);
        let letter = to(27.0);
        shapes.push(Shape::line(
            [from, to(19.0)],
            OutlineStyle::line(GROUND, 1.5),
        ));
        let at = (letter.0, letter.1 + 4.0);
        shapes.push(Shape::words(name, at, 11.0, Anchor::Middle));
    }
    let (over, named) = beside::over(&stage);
    shapes.extend(over);
    for (name, place) in Labels::of(&stage, settings.labels, named) {
        shapes.push(Shape::words(name, place, LETTERS, Anchor::Start));
    }
    shapes
}

/// A joint is as large as its neighbours leave room for, within what can be seen and what does not hide the links.
fn symbol_size(stage: &StagedScene) -> f64 {
    let places: Vec<Pixel> = (stage.scene.joints.iter())
        .map(|joint| stage.pixel(&Vector3(joint.at)))
        .collect();
    let mut room: f64 = f64::INFINITY;
    for (i, a) in places.iter().enumerate() {
        for b in &places[i + 1..] {
            let apart = real::hypot(a.0 - b.0, a.1 - b.1);
            if apart > 4.0 {
                room = room.min(apart);
            }
        }
    }
    (0.3 * room).clamp(5.0, 11.0)
}

/// Half the size of a joint in m, as the first view of a scene has it.
pub(crate) fn joint_size(scene: &Scene) -> f64 {
    let fit = Framing::of(&Camera::new(Viewpoint::Natural, scene.normal), [scene]);
    StagedScene::new(scene, Viewpoint::Natural, fit, (0.0, 0.0)).metres()
}
