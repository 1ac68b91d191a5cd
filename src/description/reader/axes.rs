//! Files of joint coordinates.

use super::*;
use crate::description::axes::{
    AxesDescription, AxisDescription, AxisKind, AxisPlace, PointDescription,
};

impl FileReader {
    pub(super) fn axes(&mut self, piece: Piece) -> Option<AxesDescription> {
        let mut fields = self.fields(piece, FieldGroup::Axes)?;
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
            tolerance: self.optional_entry(f, "tolerance"),
            parameters: self.named(f, "parameters", Noun::Parameter, Self::entry),
            joints: self.named(f, "joints", Noun::Axis, Self::axis),
            bodies: self.named(f, "bodies", Noun::Body, |reader, piece| {
                let mut fields = reader.fields(piece, FieldGroup::BodyFrame)?;
                reader.point_or_frame(&mut fields, "origin")
            }),
            points: self.named(f, "points", Noun::Point, |reader, piece| {
                let mut fields = reader.fields(piece, FieldGroup::Point)?;
                let body = reader.require(&mut fields, "body");
                let body = body.and_then(|body| reader.text(body, Expected::Body));
                let place = reader.point_or_frame(&mut fields, "at")?;
                body.map(|body| PointDescription { body, place })
            }),
            base: f.take("base").map(|piece| self.transform(piece)),
            tool: f.take("tool").map(|piece| self.transform(piece)),
            cut: f.take("cut").map_or_else(Vec::new, |piece| {
                self.list(piece, Expected::Cuts, |reader, name| {
                    reader.text(name, Expected::NameOf(Noun::Axis))
                })
            }),
            closed_forms: self.named(f, "closed_forms", Noun::ClosedForm, Self::closed_form),
            outputs: self.named(f, "outputs", Noun::Output, Self::quantity),
            loads: self.loads(f),
        })
    }

    fn axis(&mut self, piece: Piece) -> Option<AxisDescription> {
        let (known, word) = (&AxisKind::ALL, AxisKind::word);
        let (kind, _) = self.word(piece, Expected::Axis, known, word)?;
        let mut fields = self.fields(piece, FieldGroup::Joint(kind))?;
        let f = &mut fields;
        let place = self.axis_place(kind, f);
        let second = f.take("second").and_then(|piece| {
            let mut fields = self.fields(piece, FieldGroup::SecondPlace)?;
            self.axis_place(kind, &mut fields)
        });
        let role = f.take("role").and_then(|piece| {
            let known = [Role::Passive, Role::Actuated];
            self.bare_word(piece, Expected::Role, &known, Role::word)
        });
        let home = self.optional_entry(f, "home");
        let drawn = self.optional_entry(f, "drawn");
        let by = match kind {
            AxisKind::Distance => "length",
            _ => "value",
        };
        let value = self.optional_entry(f, by);
        let pitch = match kind {
            AxisKind::Helical => self.require(f, "pitch").and_then(|piece| self.entry(piece)),
            _ => None,
        };
        let limits = self.limits(f);
        let between = f.take("between").and_then(|piece| {
            let bodies = self.tuple(piece, Expected::Bodies)?;
            let [first, second] = bodies.map(|body| self.text(body, Expected::Body));
            Some([first?, second?])
        });
        Some(AxisDescription {
            second,
            role,
            home,
            drawn,
            value,
            pitch,
            limits,
            between,
            span: fields.span,
            ..AxisDescription::new(kind, place?)
        })
    }

    pub(super) fn optional_entry(&mut self, fields: &mut Fields, field: &str) -> Option<Entry> {
        let piece = fields.take(field)?;
        self.entry(piece)
    }

    /// A point under a name, or a whole frame.
    fn point_or_frame(&mut self, fields: &mut Fields, name: &'static str) -> Option<AxisPlace> {
        if let Some(frame) = fields.take("frame") {
            return Some(AxisPlace::Frame(self.transform(frame)));
        }
        let point = self.require(fields, name)?;
        self.vector(point, Expected::Vector).map(AxisPlace::Centre)
    }

    fn axis_place(&mut self, kind: AxisKind, fields: &mut Fields) -> Option<AxisPlace> {
        for whole in ["through", "frame"] {
            if fields.gives(&[whole]) && fields.gives(&["point", "direction"]) {
                let joint = kind.word();
                let problem = ProblemKind::Axes(Box::new(AxesProblem::TwoPlaces { joint }));
                let span = fields.take(whole).map(|piece| piece.span());
                self.note(problem, span.unwrap_or(fields.head()));
                return None;
            }
        }
        if let Some(frame) = fields.take("frame") {
            return Some(AxisPlace::Frame(self.transform(frame)));
        }
        if kind == AxisKind::Fixed {
            return Some(AxisPlace::Frame(Vec::new()));
        }
        if kind == AxisKind::Distance || fields.gives(&["through"]) {
            let through = self.require(fields, "through")?;
            let points = self.tuple(through, Expected::TwoPoints)?;
            let [first, second] = points.map(|point| self.vector(point, Expected::Vector));
            return Some(AxisPlace::Through(first?, second?));
        }
        let point = match kind {
            AxisKind::Prismatic => fields.take("point").map(Some),
            _ => Some(self.require(fields, "point")),
        };
        if kind == AxisKind::Spherical {
            return self
                .vector(point??, Expected::Vector)
                .map(AxisPlace::Centre);
        }
        let directions = match kind {
            AxisKind::Universal => "directions",
            _ => "direction",
        };
        let directions = self.require(fields, directions);
        let point = match point {
            Some(piece) => Some(self.vector(piece?, Expected::Vector)?),
            None => None,
        };
        if kind == AxisKind::Universal {
            let both = self.tuple(directions?, Expected::TwoDirections)?;
            let [first, second] = both.map(|one| self.vector(one, Expected::Vector));
            return Some(AxisPlace::Cross(point?, [first?, second?]));
        }
        let direction = self.vector(directions?, Expected::Vector)?;
        Some(AxisPlace::Along(point, direction))
    }
}
