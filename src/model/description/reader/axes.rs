//! Files of joint coordinates.

use super::*;
use crate::description::axes::{AxisDescription, AxisKind, AxisPlace, PointDescription};
use crate::description::expectation::form;

impl AxisKind {
    /// The fields of a joint of that kind.
    pub(super) fn group(self) -> FieldGroup {
        const AXIS: &[&str] = &["point", "direction", "through", "frame"];
        const VARIABLE: &[&str] = &["home", "drawn", "value", "limits", "role", "between"];
        const CUT: &[&str] = &["second", "between"];
        const ROD: &[&str] = &["home", "limits", "role", "between"];
        let form = match self {
            Self::Revolute => form!("a revolute joint", AXIS, &["second"], VARIABLE),
            Self::Prismatic => form!("a prismatic joint", AXIS, &["second"], VARIABLE),
            Self::Helical => form!("a helical joint", AXIS, &["pitch"], VARIABLE),
            Self::Cylindrical => form!("a cylindrical joint", AXIS, CUT),
            Self::Universal => form!("a universal joint", &["point", "directions"], CUT),
            Self::Spherical => form!("a spherical joint", &["point"], CUT),
            Self::Planar => form!("a planar joint", AXIS, CUT),
            Self::Fixed => form!("a fixed joint", &["frame"], CUT),
            Self::Distance => form!("a rod", &["through", "length"], ROD),
            Self::Free => form!("a free joint", &["between"]),
        };
        let word = self.word();
        FieldGroup { word, form }
    }
}

const BODY: FieldGroup = FieldGroup {
    word: "Body",
    form: form!("a body", &["origin", "frame"]),
};

const POINT: FieldGroup = FieldGroup {
    word: "Point",
    form: form!("a point", &["body", "at", "frame"]),
};

const SECOND: FieldGroup = FieldGroup {
    word: "Place",
    form: form!(
        "the place on the second body",
        &["point", "direction", "directions", "through", "frame"]
    ),
};

impl FileReader {
    /// The frame of a body.
    pub(super) fn body(&mut self, piece: RawValue) -> Option<AxisPlace> {
        let mut fields = self.fields(piece, BODY)?;
        self.point_or_frame(&mut fields, "origin")
    }

    pub(super) fn point(&mut self, piece: RawValue) -> Option<PointDescription> {
        let mut fields = self.fields(piece, POINT)?;
        let body = self.require(&mut fields, "body");
        let body = body.and_then(|body| self.text(body, Expected::BODY));
        let place = self.point_or_frame(&mut fields, "at")?;
        body.map(|body| PointDescription { body, place })
    }

    pub(super) fn axis(&mut self, piece: RawValue) -> Option<AxisDescription> {
        let (known, word) = (&AxisKind::ALL, AxisKind::word);
        let expected =
            Expected::Said("a joint such as `Revolute(…)`, `Prismatic(…)` or `Spherical(…)`");
        let (kind, _) = self.word(piece, expected, known, word)?;
        let mut fields = self.fields(piece, kind.group())?;
        let f = &mut fields;
        let place = self.axis_place(kind, f);
        let second = f.take("second").and_then(|piece| {
            let mut fields = self.fields(piece, SECOND)?;
            self.axis_place(kind, &mut fields)
        });
        let pitch = match kind {
            AxisKind::Helical => self.require(f, "pitch").and_then(|piece| self.entry(piece)),
            _ => None,
        };
        let axis = AxisDescription {
            second,
            role: self.field(f, "role", Expected::ROLE),
            home: self.field(f, "home", Expected::ENTRY),
            drawn: self.field(f, "drawn", Expected::ENTRY),
            value: self.field(f, kind.follows_by(), Expected::ENTRY),
            pitch,
            limits: self.field(f, "limits", Expected::LIMITS),
            between: self.field(f, "between", Expected::BODIES),
            ..AxisDescription::new(kind, place?)
        };
        let span = fields.span;
        Some(AxisDescription { span, ..axis })
    }

    /// A point under a name, or a whole frame.
    fn point_or_frame(&mut self, fields: &mut Fields, name: &'static str) -> Option<AxisPlace> {
        if let Some(frame) = fields.take("frame") {
            return Some(AxisPlace::Frame(self.transform(frame)));
        }
        let point = self.require(fields, name)?;
        self.vector(point, Expected::VECTOR).map(AxisPlace::Centre)
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
        if matches!(kind, AxisKind::Fixed | AxisKind::Free) {
            return Some(AxisPlace::Frame(Vec::new()));
        }
        if kind == AxisKind::Distance || fields.gives(&["through"]) {
            let through = self.require(fields, "through")?;
            let expected = Expected::Parts(&["two points `((x, y, z), (x, y, z))`", "point"]);
            let [first, second] = FileItem::read(self, through, expected)?;
            return Some(AxisPlace::Through(first, second));
        }
        let point = match kind {
            AxisKind::Prismatic => fields.take("point").map(Some),
            _ => Some(self.require(fields, "point")),
        };
        if kind == AxisKind::Spherical {
            return self
                .vector(point??, Expected::VECTOR)
                .map(AxisPlace::Centre);
        }
        let directions = match kind {
            AxisKind::Universal => "directions",
            _ => "direction",
        };
        let directions = self.require(fields, directions);
        let point = match point {
            Some(piece) => Some(self.vector(piece?, Expected::VECTOR)?),
            None => None,
        };
        if kind == AxisKind::Universal {
            let expected =
                Expected::Parts(&["two directions `((x, y, z), (x, y, z))`", "direction"]);
            let both = FileItem::read(self, directions?, expected)?;
            return Some(AxisPlace::Cross(point?, both));
        }
        let direction = self.vector(directions?, Expected::VECTOR)?;
        Some(AxisPlace::Along(point, direction))
    }
}
