//! Pictures as bitmaps: shapes filled and stroked, letters from the outlines of a font that comes with the program, so that
//! a picture is the same on every machine.

use std::io;

use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, StrokeDash, Transform,
};
use ttf_parser::{Face, OutlineBuilder};

use super::{Anchor, Canvas, Colour, INK, Shape};

/// Letters of Latin, Greek and Cyrillic, and signs of mathematics, from DejaVu Sans 2.37.
static FONT: &[u8] = include_bytes!("DejaVuSans.ttf");

impl Canvas {
    /// The picture as PNG, with two dots for a pixel both ways.
    pub fn png(&self) -> Vec<u8> {
        let dots = self.painted(2.0).encode_png();
        dots.expect("a picture in memory can be packed")
    }

    fn painted(&self, finer: f64) -> Pixmap {
        // a sheet of a thousand modes is painted smaller: 64 million dots at most
        let finer = finer.min((64e6 / (self.width * self.height)).sqrt());
        let dots = |pixels: f64| ((pixels * finer).round() as u32).max(1);
        let map = Pixmap::new(dots(self.width), dots(self.height));
        let mut map = map.expect("the picture has as many dots as memory has room for");
        map.fill(Color::WHITE);
        let whole = Transform::from_scale(finer as f32, finer as f32);
        let face = Face::parse(FONT, 0).expect("the font is part of the program");
        for shape in &self.shapes {
            draw(&mut map, whole, &face, shape);
        }
        map
    }
}

fn paint(Colour(colour): Colour, opacity: f64) -> Paint<'static> {
    let [_, red, green, blue] = colour.to_be_bytes();
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (opacity * 255.0).round() as u8);
    paint
}

fn draw(map: &mut Pixmap, whole: Transform, face: &Face, shape: &Shape) {
    let (path, fill, at) = match shape {
        Shape::Outline {
            points,
            closed,
            style,
        } => {
            let mut builder = PathBuilder::new();
            for (i, (x, y)) in points.iter().enumerate() {
                let (x, y) = (*x as f32, *y as f32);
                match i {
                    0 => builder.move_to(x, y),
                    _ => builder.line_to(x, y),
                }
            }
            if *closed {
                builder.close();
            }
            let Some(path) = builder.finish() else { return };
            if let Some((colour, opacity)) = style.fill {
                let rule = FillRule::Winding;
                map.fill_path(&path, &paint(colour, opacity), rule, whole, None);
            }
            let Some((colour, width)) = style.stroke else {
                return;
            };
            let dash = style.dash.map(|dash| dash.map(|x| x as f32).to_vec());
            let stroke = Stroke {
                width: width as f32,
                line_cap: LineCap::Round,
                line_join: LineJoin::Round,
                dash: dash.and_then(|dash| StrokeDash::new(dash, 0.0)),
                ..Stroke::default()
            };
            map.stroke_path(&path, &paint(colour, 1.0), &stroke, whole, None);
            return;
        }
        Shape::Words {
            text,
            at,
            size,
            anchor,
            upwards,
        } => {
            let mut letters = LetterOutlines {
                path: PathBuilder::new(),
                scale: *size as f32 / f32::from(face.units_per_em()),
                across: 0.0,
            };
            for letter in text.chars() {
                let glyph = face.glyph_index(letter).unwrap_or_default();
                face.outline_glyph(glyph, &mut letters);
                let wide = face.glyph_hor_advance(glyph).unwrap_or_default();
                letters.across += letters.scale * f32::from(wide);
            }
            let back = match anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => 0.5 * letters.across,
                Anchor::End => letters.across,
            };
            let turn = if *upwards { -90.0 } else { 0.0 };
            let place = whole
                .pre_translate(at.0 as f32, at.1 as f32)
                .pre_concat(Transform::from_rotate(turn))
                .pre_translate(-back, 0.0);
            (letters.path.finish(), INK, place)
        }
    };
    if let Some(path) = path {
        map.fill_path(&path, &paint(fill, 1.0), FillRule::Winding, at, None);
    }
}

/// Outlines of letters beside one another, y downwards.
struct LetterOutlines {
    path: PathBuilder,
    scale: f32,
    across: f32,
}

impl LetterOutlines {
    fn place(&self, x: f32, y: f32) -> (f32, f32) {
        (self.across + self.scale * x, -self.scale * y)
    }
}

impl OutlineBuilder for LetterOutlines {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.place(x1, y1), self.place(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2)) = (self.place(x1, y1), self.place(x2, y2));
        let (x, y) = self.place(x, y);
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

/// Pictures of one size, one after the other for so many hundredths of a second each, again and again.
///
/// # Errors
/// If there is none, or they are larger than the format allows.
pub fn gif(pictures: &[Canvas], hundredths: u16) -> io::Result<Vec<u8>> {
    let too_large = || io::Error::other("a GIF has at most 65535 pixels either way");
    let mut bytes = Vec::new();
    let Some(first) = pictures.first() else {
        return Err(io::Error::other("there is nothing to animate"));
    };
    let [width, height] = [first.width, first.height].map(|x| x.round() as u64);
    let width = u16::try_from(width).map_err(|_| too_large())?;
    let height = u16::try_from(height).map_err(|_| too_large())?;
    let packed = |error: gif::EncodingError| io::Error::other(error.to_string());
    let mut encoder = gif::Encoder::new(&mut bytes, width, height, &[]).map_err(packed)?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(packed)?;
    for picture in pictures {
        let mut dots = picture.painted(1.0).take();
        let mut frame = gif::Frame::from_rgba_speed(width, height, &mut dots, 10);
        frame.delay = hundredths;
        encoder.write_frame(&frame).map_err(packed)?;
    }
    drop(encoder);
    Ok(bytes)
}
