//! Printed formulas.

use super::*;

impl FileReader {
    pub(super) fn closed_form(&mut self, piece: Piece) -> Option<ClosedFormDescription> {
        let mut fields = self.fields(piece, FieldGroup::ClosedForm)?;
        // reading takes the fields out, so the kind of formula is decided first
        let pose = fields.gives(&["position", "rotation", "transform", "entries"]);
        let identity = fields.gives(&["identity", "identities"]);
        if pose && !fields.gives(&["of"]) {
            self.require(&mut fields, "of");
        }
        match (pose, identity) {
            (true, true) => self.note(ProblemKind::MixedClosedForm, fields.head()),
            (false, false) => self.note(ProblemKind::EmptyClosedForm, fields.head()),
            _ => {}
        }
        let f = &mut fields;
        let position = f.take("position");
        Some(ClosedFormDescription {
            of: self.optional_text(f, "of", Expected::Frame),
            relative_to: self.optional_text(f, "in", Expected::Frame),
            locals: self.named(f, "where", Noun::LocalName, Self::entry),
            source: self.optional_text(f, "source", Expected::Text),
            position: position.and_then(|piece| self.vector(piece, Expected::Vector)),
            rotation: f.take("rotation").and_then(|piece| {
                let rows = self.tuple(piece, Expected::RotationRows)?;
                self.matrix(rows, Expected::RotationRow)
            }),
            transform: f
                .take("transform")
                .and_then(|piece| self.homogeneous(piece)),
            entries: self.matrix_entries(f),
            identity: f.take("identity").and_then(|piece| self.entry(piece)),
            identities: self.named(f, "identities", Noun::Identity, Self::entry),
        })
    }

    fn matrix<const N: usize>(
        &mut self,
        rows: [Piece; 3],
        expected: Expected,
    ) -> Option<[[Entry; N]; 3]> {
        let rows = rows.map(|row| self.vector(row, expected));
        let rows: Vec<_> = rows.into_iter().flatten().collect();
        rows.try_into().ok()
    }

    /// Three rows of `[R | p]`, and perhaps the fourth that every homogeneous transform has.
    fn homogeneous(&mut self, piece: Piece) -> Option<[[Entry; 4]; 3]> {
        let PieceShape::Tuple = piece.shape() else {
            self.wrong_type(piece, Expected::TransformRows);
            return None;
        };
        let mut rows = piece.elements();
        if rows.len() == 4
            && let Some(last) = rows.pop()
        {
            let row = self.vector::<4>(last, Expected::TransformRow)?;
            let is_usual = row
                .iter()
                .zip([0.0, 0.0, 0.0, 1.0])
                .all(|(entry, usual)| entry.expression.as_number() == Some(usual));
            if !is_usual {
                self.note(ProblemKind::WrongLastRow, last.span());
            }
        }
        let found = rows.len();
        match rows.try_into() {
            Ok(rows) => self.matrix(rows, Expected::TransformRow),
            Err(_) => self.wrong_length(piece, Expected::TransformRows, 3, found),
        }
    }

    fn matrix_entries(&mut self, fields: &mut Fields) -> Vec<(Spanned<MatrixEntry>, Entry)> {
        let mut entries = Vec::new();
        for Named { name, value } in self.named(fields, "entries", Noun::MatrixEntry, Self::entry) {
            match MatrixEntry::all().find(|entry| entry.to_string() == name.value) {
                Some(entry) => entries.push((Spanned::new(entry, name.span), value)),
                None => self.note(
                    ProblemKind::UnknownMatrixEntry { name: name.value },
                    name.span,
                ),
            }
        }
        entries
    }
}
