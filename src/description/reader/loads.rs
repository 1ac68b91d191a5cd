//! Masses, springs and forces of a file.

use super::shapes::Fields;
use super::*;

impl FileReader {
    /// The fields of a file for what acts in the mechanism.
    pub(super) fn loads(&mut self, fields: &mut Fields) -> LoadsDescription {
        let gravity = fields.take("gravity");
        LoadsDescription {
            gravity: gravity.and_then(|piece| self.vector(piece, Expected::Vector)),
            masses: self.named(fields, "masses", Noun::Mass, Self::mass),
            loads: self.named(fields, "loads", Noun::Load, Self::load),
        }
    }

    fn mass(&mut self, piece: Piece) -> Option<MassDescription> {
        let mut fields = self.fields(piece, FieldGroup::Mass)?;
        let f = &mut fields;
        let (centre, inertia) = (f.take("centre"), f.take("inertia"));
        Some(MassDescription {
            mass: self.optional_entry(f, "mass"),
            centre: centre.and_then(|piece| self.vector(piece, Expected::Vector)),
            inertia: inertia.and_then(|piece| match piece.shape() {
                PieceShape::Tuple => {
                    let six: [Entry; 6] = self.vector(piece, Expected::Inertia)?;
                    Some(InertiaDescription(six.into()))
                }
                _ => Some(InertiaDescription(vec![self.entry(piece)?])),
            }),
            shape: f.take("shape").and_then(|piece| self.shape(piece)),
            density: self.optional_entry(f, "density"),
            turned: self.transform_field(f, "turned"),
            span: fields.span,
        })
    }

    fn shape(&mut self, piece: Piece) -> Option<ShapeDescription> {
        use crate::description::Shape;
        let (kind, content) = self.word(piece, Expected::Shape, &Shape::ALL, Shape::word)?;
        let expected = Expected::Sizes(kind);
        let found = content.map_or(0, |content| content.elements().len());
        if found != kind.sizes() {
            return self.wrong_length(piece, expected, kind.sizes(), found);
        }
        let pieces = content?.elements().into_iter();
        let sizes: Vec<Option<Entry>> = pieces.map(|size| self.entry(size)).collect();
        let sizes = sizes.into_iter().collect::<Option<_>>()?;
        Some(ShapeDescription { kind, sizes })
    }

    fn load(&mut self, piece: Piece) -> Option<LoadDescription> {
        let (kind, _) = self.word(piece, Expected::Load, &LoadKind::ALL, LoadKind::word)?;
        let mut fields = self.fields(piece, FieldGroup::Load(kind))?;
        let mut read = Vec::new();
        for name in kind.fields().split(' ') {
            let Some(piece) = fields.take(name) else {
                continue;
            };
            let field = match name {
                "between" => {
                    let pair = self.tuple(piece, Expected::Points)?;
                    let [a, b] = pair.map(|point| self.text(point, Expected::Frame));
                    LoadField::Points([a?, b?])
                }
                "joint" | "at" | "along" => LoadField::Name(self.text(piece, Expected::Frame)?),
                "tension_only" | "compression_only" => LoadField::Yes(self.yes(piece)?),
                "table" if matches!(piece.shape(), PieceShape::Text) => {
                    LoadField::File(self.text(piece, Expected::Table)?)
                }
                "table" => LoadField::Table(self.table(piece)?),
                _ => match piece.shape() {
                    PieceShape::Tuple if kind == LoadKind::Force => {
                        let vector = self.tuple(piece, Expected::Vector)?;
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

    fn yes(&mut self, piece: Piece) -> Option<bool> {
        match piece.shape() {
            PieceShape::Word {
                word: word @ ("true" | "false"),
                content: None,
            } => Some(word == "true"),
            _ => {
                self.wrong_type(piece, Expected::YesOrNo);
                None
            }
        }
    }

    fn table(&mut self, piece: Piece) -> Option<Vec<[Entry; 2]>> {
        let rows = self.list(piece, Expected::Table, |reader, row| {
            reader.vector(row, Expected::TableRow)
        });
        (!rows.is_empty()).then_some(rows)
    }
}
