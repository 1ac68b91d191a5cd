//! Files of joint axes.

use super::*;
use crate::description::axes::{
    AxesDescription, AxesProblem, AxisDescription, AxisKind, AxisPlace,
};

impl Reader {
    pub(super) fn axes(&mut self, piece: Piece) -> Option<AxesDescription> {
        let mut fields = self.fields(piece, Structure::Axes)?;
        if !self.known_version(&mut fields) {
            return None;
        }
        if !fields.gives(&["joints"]) {
            self.require(&mut fields, "joints");
        }
        let f = &mut fields;
        Some(AxesDescription {
            name: self.required_text(f, "name"),
            source: self.optional_text(f, "source", Expected::Text),
            convention: self.convention_field(f),
            parameters: self.named(f, "parameters", Noun::Parameter, Self::entry),
            joints: self.named(f, "joints", Noun::Axis, Self::axis),
            base: f.take("base").map(|piece| self.transform(piece)),
            tool: f.take("tool").map(|piece| self.transform(piece)),
            cut: f.take("cut").map_or_else(Vec::new, |piece| {
                self.list(piece, Expected::Cuts, |reader, name| {
                    reader.text(name, Expected::NameOf(Noun::Axis))
                })
            }),
        })
    }

    fn axis(&mut self, piece: Piece) -> Option<AxisDescription> {
        let (known, word) = (&AxisKind::ALL, AxisKind::word);
        let (kind, _) = self.word(piece, Expected::Axis, known, word)?;
        let structure = match kind {
            AxisKind::Revolute => Structure::RevoluteAxis,
            AxisKind::Prismatic => Structure::PrismaticAxis,
            AxisKind::Spherical => Structure::SphericalCentre,
        };
        let mut fields = self.fields(piece, structure)?;
        let place = self.axis_place(kind, &mut fields);
        let role = fields.take("role").and_then(|piece| {
            let known = [Role::Passive, Role::Actuated];
            self.bare_word(piece, Expected::Role, &known, Role::word)
        });
        let home = self.entry_or_zero(&mut fields, "home");
        let limits = self.limits(&mut fields);
        let between = fields.take("between").and_then(|piece| {
            let bodies = self.tuple(piece, Expected::Bodies)?;
            let [first, second] = bodies.map(|body| self.text(body, Expected::Body));
            Some([first?, second?])
        });
        Some(AxisDescription {
            kind,
            place: place?,
            role,
            home,
            limits,
            between,
            span: fields.span,
        })
    }

    fn axis_place(&mut self, kind: AxisKind, fields: &mut Fields) -> Option<AxisPlace> {
        if kind == AxisKind::Spherical {
            let centre = self.require(fields, "point")?;
            let centre = self.vector(centre, Expected::Vector);
            return centre.map(AxisPlace::Centre);
        }
        if let Some(through) = fields.take("through") {
            if fields.gives(&["point", "direction"]) {
                let joint = kind.word();
                let kind = ProblemKind::Axes(Box::new(AxesProblem::TwoPlaces { joint }));
                self.note(kind, through.span());
            }
            let points = self.tuple(through, Expected::TwoPoints)?;
            let [first, second] = points.map(|point| self.vector(point, Expected::Vector));
            return Some(AxisPlace::Through(first?, second?));
        }
        let point = match kind {
            AxisKind::Revolute => Some(self.require(fields, "point")),
            _ => fields.take("point").map(Some),
        };
        let direction = self.require(fields, "direction");
        let point = match point {
            Some(piece) => Some(self.vector(piece?, Expected::Vector)?),
            None => None,
        };
        let direction = self.vector(direction?, Expected::Vector)?;
        Some(AxisPlace::Along(point, direction))
    }
}
