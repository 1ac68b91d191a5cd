//! Masses, springs and forces of a file.

use super::*;
use crate::description::Shape;
use crate::description::expectation::form;

impl LoadKind {
    /// The fields of a load of that kind.
    pub(super) fn group(self) -> FieldGroup {
        const ALONG: &[&str] = &["between", "joint"];
        const ELASTIC: &[&str] = &["stiffness", "length", "rest", "preload"];
        const ONE_WAY: &[&str] = &["tension_only", "compression_only"];
        const FORCE: &[&str] = &["at", "force", "moment"];
        const FRICTION: &[&str] = &["joint", "force", "moment", "coefficient", "radius"];
        let form = match self {
            Self::Spring => form!("a spring", ALONG, ELASTIC, &["damping"], ONE_WAY),
            Self::Force => form!("a force", ALONG, FORCE, &["along", "table", "over"]),
            Self::Friction => form!("friction", FRICTION),
        };
        let word = self.word();
        FieldGroup { word, form }
    }
}

const LOAD: Expected = Expected::Said("`Spring(…)`, `Force(…)` or `Friction(…)`");

const TABLE: Expected =
    Expected::Said("a list of rows `[(0, 10), (0.1, 12)]`, or the name of a CSV file");

impl FileReader {
    pub(super) fn shape(
        &mut self,
        piece: RawValue,
        expected: Expected,
    ) -> Option<ShapeDescription> {
        let (kind, content) = self.word(piece, expected, &Shape::ALL, Shape::word)?;
        let expected = sizes(kind);
        let found = content.map_or(0, |content| content.elements().len());
        if found != kind.sizes() {
            return self.wrong_length(piece, expected, kind.sizes(), found);
        }
        let pieces = content?.elements().into_iter();
        let sizes: Vec<Option<Entry>> = pieces.map(|size| self.entry(size)).collect();
        let sizes = sizes.into_iter().collect::<Option<_>>()?;
        Some(ShapeDescription { kind, sizes })
    }

    pub(super) fn load(&mut self, piece: RawValue) -> Option<LoadDescription> {
        let (kind, _) = self.word(piece, LOAD, &LoadKind::ALL, LoadKind::word)?;
        let mut fields = self.fields(piece, kind.group())?;
        let mut read = Vec::new();
        for name in kind.group().fields() {
            let Some(piece) = fields.take(name) else {
                continue;
            };
            let field = match name {
                "between" => LoadField::Points(FileItem::read(self, piece, Expected::POINTS)?),
                "joint" | "at" | "along" => LoadField::Name(self.text(piece, Expected::FRAME)?),
                "tension_only" | "compression_only" => LoadField::Yes(self.yes(piece)?),
                "table" if matches!(piece.shape(), PieceShape::Text) => {
                    LoadField::File(self.text(piece, TABLE)?)
                }
                "table" => LoadField::Table(self.table(piece)?),
                _ => match piece.shape() {
                    PieceShape::Tuple if kind == LoadKind::Force => {
                        let vector = self.tuple(piece, Expected::VECTOR)?;
                        let [x, y, z] = vector.map(|part| self.quantity(part));
                        LoadField::Vector([x?, y?, z?])
                    }
                    _ => LoadField::Entry(self.quantity(piece)?),
                },
            };
            read.push((name, field));
        }
        Some(LoadDescription {
            kind,
            fields: read,
            span: fields.span,
        })
    }

    fn yes(&mut self, piece: RawValue) -> Option<bool> {
        match piece.shape() {
            PieceShape::Word {
                word: word @ ("true" | "false"),
                content: None,
            } => Some(word == "true"),
            _ => {
                self.wrong_type(piece, Expected::Said("`true` or `false`"));
                None
            }
        }
    }

    fn table(&mut self, piece: RawValue) -> Option<Vec<[Entry; 2]>> {
        let rows = self.list(piece, TABLE, |reader, row| {
            reader.vector(row, Expected::Said("a row `(value, force)`"))
        });
        (!rows.is_empty()).then_some(rows)
    }
}

/// The dimensions of a shape.
fn sizes(shape: Shape) -> Expected {
    Expected::Parts(match shape {
        Shape::Rod => &["`Rod(length)`", "dimension"],
        Shape::Plate => &["`Plate(a, b)`", "dimension"],
        Shape::Cylinder => &["`Cylinder(radius, length)`", "dimension"],
        Shape::Box => &["`Box(a, b, c)`", "dimension"],
        Shape::Sphere => &["`Sphere(radius)`", "dimension"],
    })
}
