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
        let name = self
            .require(&mut fields, "name")
            .and_then(|piece| self.text(piece, Expected::Text));
        let source = self.optional_text(&mut fields, "source", Expected::Text);
        let convention = fields
            .take("convention")
            .and_then(|piece| self.convention(piece));
        let parameters = self.named(&mut fields, "parameters", Noun::Parameter, Self::entry);
        let joints = match fields.gives(&["joints"]) {
            true => self.named(&mut fields, "joints", Noun::Axis, Self::axis),
            false => {
                self.require(&mut fields, "joints");
                Vec::new()
            }
        };
        Some(AxesDescription {
            name: name.unwrap_or_else(|| Spanned::new(String::new(), 0..0)),
            source,
            convention,
            parameters,
            joints,
            base: fields.take("base").map(|piece| self.transform(piece)),
            tool: fields.take("tool").map(|piece| self.transform(piece)),
            cut: fields.take("cut").map_or_else(Vec::new, |piece| {
                self.list(piece, Expected::Cuts, |reader, name| {
                    reader.text(name, Expected::NameOf(Noun::Axis))
                })
            }),
        })
    }

    fn axis(&mut self, piece: Piece) -> Option<AxisDescription> {
        let Shape::Word { word, .. } = piece.shape() else {
            self.wrong_type(piece, Expected::Axis);
            return None;
        };
        let Some(kind) = AxisKind::ALL.into_iter().find(|kind| kind.word() == word) else {
            let known = AxisKind::ALL.map(AxisKind::word).to_vec();
            self.unknown_word(piece, Expected::Axis, word, known);
            return None;
        };
        let structure = match kind {
            AxisKind::Revolute => Structure::RevoluteAxis,
            AxisKind::Prismatic => Structure::PrismaticAxis,
            AxisKind::Spherical => Structure::SphericalCentre,
        };
        let mut fields = self.fields(piece, structure)?;
        let place = self.axis_place(kind, &mut fields);
        let role = fields.take("role").and_then(|piece| self.role(piece));
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
            return self.vector(centre).map(AxisPlace::Centre);
        }
        if let Some(through) = fields.take("through") {
            if fields.gives(&["point", "direction"]) {
                let joint = kind.word();
                let kind = ProblemKind::Axes(Box::new(AxesProblem::TwoPlaces { joint }));
                self.problems.push(kind.at(through.span()));
            }
            let points = self.tuple(through, Expected::TwoPoints)?;
            let [first, second] = points.map(|point| self.vector(point));
            return Some(AxisPlace::Through(first?, second?));
        }
        let point = match kind {
            AxisKind::Revolute => Some(self.require(fields, "point")),
            _ => fields.take("point").map(Some),
        };
        let direction = self.require(fields, "direction");
        let point = match point {
            Some(piece) => Some(self.vector(piece?)?),
            None => None,
        };
        let direction = self.vector(direction?)?;
        Some(AxisPlace::Along(point, direction))
    }

    fn vector(&mut self, piece: Piece) -> Option<[Entry; 3]> {
        let vector = self.tuple(piece, Expected::Vector)?;
        self.entries(vector)
    }

    fn role(&mut self, piece: Piece) -> Option<Role> {
        let known = [Role::Passive, Role::Actuated];
        let Shape::Word {
            word,
            content: None,
        } = piece.shape()
        else {
            self.wrong_type(piece, Expected::Role);
            return None;
        };
        let role = known.into_iter().find(|role| role.word() == word);
        if role.is_none() {
            self.unknown_word(piece, Expected::Role, word, known.map(Role::word).to_vec());
        }
        role
    }
}
