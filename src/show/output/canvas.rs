//! Pictures as plain shapes in pixels, written as SVG or painted as PNG and GIF.

#[cfg(feature = "paint")]
mod paint;

#[cfg(feature = "paint")]
pub use paint::gif;

use std::fmt::Write;

/// A place in pixels, to the right and down from the upper left corner.
pub type Pixel = (f64, f64);

/// Red, green and blue as in `0xRRGGBB`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub u32);

pub(crate) const WHITE: Colour = Colour(0xff_ff_ff);
/// Height of small letters in pixels.
pub(crate) const LETTERS: f64 = 12.0;
pub(crate) const INK: Colour = Colour(0x22_22_22);

impl Colour {
    pub(crate) fn parts(self) -> [u8; 3] {
        let [_, red, green, blue] = self.0.to_be_bytes();
        [red, green, blue]
    }

    /// Mixed with white: of 0 nothing is left.
    pub(crate) fn faint(self, part: f64) -> Colour {
        let mixed = self.parts().map(|x| 255.0 - part * (255.0 - f64::from(x)));
        let [red, green, blue] = mixed.map(|x| x.round() as u8);
        Colour(u32::from_be_bytes([0, red, green, blue]))
    }
}

/// Style of an outline.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OutlineStyle {
    /// Fill colour, and its opacity from 0 to 1.
    pub fill: Option<(Colour, f64)>,
    /// The line round it, and how wide that is.
    pub stroke: Option<(Colour, f64)>,
    /// Dashes and the gaps between them.
    pub dash: Option<[f64; 2]>,
}

impl OutlineStyle {
    pub(crate) fn filled(colour: Colour) -> Self {
        OutlineStyle {
            fill: Some((colour, 1.0)),
            ..OutlineStyle::default()
        }
    }

    pub(crate) fn line(colour: Colour, width: f64) -> Self {
        OutlineStyle {
            stroke: Some((colour, width)),
            ..OutlineStyle::default()
        }
    }

    /// Adds a line round it.
    pub(crate) fn edged(self, colour: Colour, width: f64) -> Self {
        OutlineStyle {
            stroke: Some((colour, width)),
            ..self
        }
    }

    pub(crate) fn dashed(self, dash: f64, gap: f64) -> Self {
        OutlineStyle {
            dash: Some([dash, gap]),
            ..self
        }
    }
}

/// Part of a text that is at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its beginning.
    Start,
    /// Their middle.
    Middle,
    /// Its end.
    End,
}

/// Something in a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Straight lines from point to point.
    Outline {
        /// The points.
        points: Vec<Pixel>,
        /// True if a line leads back to the first point.
        closed: bool,
        /// Its style.
        style: OutlineStyle,
    },
    /// Words on one line.
    Words {
        /// The words.
        text: String,
        /// Their place on the line on which they stand.
        at: Pixel,
        /// Height of the letters.
        size: f64,
        /// Part of the text that is at this place.
        anchor: Anchor,
        /// True if it runs upwards.
        upwards: bool,
    },
}

impl Shape {
    pub(crate) fn polygon(points: impl IntoIterator<Item = Pixel>, style: OutlineStyle) -> Self {
        Shape::Outline {
            points: points.into_iter().collect(),
            closed: true,
            style,
        }
    }

    pub(crate) fn line(points: impl IntoIterator<Item = Pixel>, style: OutlineStyle) -> Self {
        Shape::Outline {
            points: points.into_iter().collect(),
            closed: false,
            style,
        }
    }

    pub(crate) fn rectangle(
        (left, top): Pixel,
        (right, bottom): Pixel,
        style: OutlineStyle,
    ) -> Self {
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
        Shape::polygon(corners, style)
    }

    pub(crate) fn words(text: impl Into<String>, at: Pixel, size: f64, anchor: Anchor) -> Self {
        Shape::Words {
            text: text.into(),
            at,
            size,
            anchor,
            upwards: false,
        }
    }

    /// The shape with its colours mixed with white.
    pub(crate) fn faint(mut self, part: f64) -> Self {
        if let Shape::Outline { style, .. } = &mut self {
            for (colour, _) in style.fill.iter_mut().chain(&mut style.stroke) {
                *colour = colour.faint(part);
            }
        }
        self
    }
}

/// A picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Canvas {
    /// Pixels across.
    pub width: f64,
    /// Pixels down.
    pub height: f64,
    /// Its shapes, the lowest first, on white.
    pub shapes: Vec<Shape>,
}

impl Canvas {
    /// The picture as SVG.
    pub fn svg(&self) -> String {
        let Canvas { width, height, .. } = self;
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" fill=\"none\" \
             stroke-linejoin=\"round\" stroke-linecap=\"round\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
        );
        for shape in &self.shapes {
            element(&mut text, shape).expect("text takes everything in");
        }
        text + "</svg>\n"
    }
}

fn element(text: &mut String, shape: &Shape) -> std::fmt::Result {
    // a rectangle that stands upright, its corners in order
    if let Shape::Outline { points, style, .. } = shape
        && style.stroke.is_none()
        && let [a, b, c, d] = points[..]
        && (a.1, b.0, c.1, d.0) == (b.1, c.0, d.1, a.0)
    {
        let (x, y) = (tenth(a.0.min(c.0)), tenth(a.1.min(c.1)));
        let (width, height) = (tenth((a.0 - c.0).abs()), tenth((a.1 - c.1).abs()));
        let fill = style.fill.map_or(0, |(colour, _)| colour.0);
        return writeln!(
            text,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"#{fill:06x}\"/>"
        );
    }
    match shape {
        Shape::Outline {
            points,
            closed,
            style,
        } => {
            let name = if *closed { "polygon" } else { "polyline" };
            write!(text, "<{name} points=\"")?;
            for (i, (x, y)) in points.iter().enumerate() {
                let space = if i > 0 { " " } else { "" };
                write!(text, "{space}{},{}", tenth(*x), tenth(*y))?;
            }
            write!(text, "\"")?;
            if let Some((Colour(colour), opacity)) = style.fill {
                write!(text, " fill=\"#{colour:06x}\"")?;
                if opacity < 1.0 {
                    write!(text, " fill-opacity=\"{opacity}\"")?;
                }
            }
            if let Some((Colour(colour), width)) = style.stroke {
                write!(text, " stroke=\"#{colour:06x}\" stroke-width=\"{width}\"")?;
            }
            if let Some([dash, gap]) = style.dash {
                write!(text, " stroke-dasharray=\"{dash} {gap}\"")?;
            }
            writeln!(text, "/>")
        }
        Shape::Words {
            text: words,
            at: (x, y),
            size,
            anchor,
            upwards,
        } => {
            let (x, y) = (tenth(*x), tenth(*y));
            write!(
                text,
                "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"#{:06x}\"",
                INK.0
            )?;
            match anchor {
                Anchor::Start => {}
                Anchor::Middle => write!(text, " text-anchor=\"middle\"")?,
                Anchor::End => write!(text, " text-anchor=\"end\"")?,
            }
            if *upwards {
                write!(text, " transform=\"rotate(-90 {x} {y})\"")?;
            }
            writeln!(text, ">{}</text>", escaped(words))
        }
    }
}

/// Tenths of a pixel keep curves smooth.
fn tenth(pixels: f64) -> f64 {
    // no minus before zero
    (pixels * 10.0).round() / 10.0 + 0.0
}

fn escaped(words: &str) -> String {
    words
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        // what XML cannot hold
        .replace(char::is_control, "\u{fffd}")
}
