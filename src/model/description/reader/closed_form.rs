//! Printed formulas.

use super::*;

impl FileReader {
    pub(super) fn closed_form(&mut self, piece: RawValue) -> Option<ClosedFormDescription> {
        let mut fields = self.fields(piece, ClosedFormDescription::GROUP)?;
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
        Some(ClosedFormDescription::of_fields(self, &mut fields))
    }

    pub(super) fn matrix<const N: usize>(
        &mut self,
        rows: [RawValue; 3],
        expected: Expected,
    ) -> Option<[[Entry; N]; 3]> {
        let rows = rows.map(|row| self.vector(row, expected));
        let rows: Vec<_> = rows.into_iter().flatten().collect();
        rows.try_into().ok()
    }

    /// Three rows of `[R | p]`, and perhaps the fourth that every homogeneous transform has.
    pub(super) fn homogeneous(
        &mut self,
        piece: RawValue,
        expected: Expected,
    ) -> Option<[[Entry; 4]; 3]> {
        const ROW: Expected = Expected::Said("a row of a transform");
        let PieceShape::Tuple = piece.shape() else {
            self.wrong_type(piece, expected);
            return None;
        };
        let mut rows = piece.elements();
        if rows.len() == 4
            && let Some(last) = rows.pop()
        {
            let row = self.vector::<4>(last, ROW)?;
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
            Ok(rows) => self.matrix(rows, ROW),
            Err(_) => self.wrong_length(piece, expected, 3, found),
        }
    }

    pub(super) fn matrix_entries(
        &mut self,
        named: Vec<Named<Entry>>,
    ) -> Vec<(Spanned<MatrixEntry>, Entry)> {
        let mut entries = Vec::new();
        for Named { name, value } in named {
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
