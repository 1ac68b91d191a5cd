//! Values of fields, and the structures made of them.

use super::*;
use crate::description::file_fields::{axes_structures, load_structures, part_structures};
use crate::description::piece::{PieceShape, RawValue};

/// Reading of structures.
macro_rules! readable {
    ($($(#[$about:meta])* $name:ident = $form:ident $($by:ident)? $word:literal, $said:literal {
        $($(#[$doc:meta])* $field:ident: $type:ty = $key:tt $(as $expected:expr)?,)+
    })+) => {$(
        impl $name {
            /// Its name, its words and its fields.
            pub(in crate::description) const GROUP: FieldGroup = FieldGroup {
                word: $word,
                form: &GroupForm {
                    said: $said,
                    fields: &[readable!(keys $form), $(readable!(keys $key)),+],
                    within: &[$(readable!(within $key $type)),+],
                },
            };

            /// The structure of fields that are read; what is not given is absent.
            pub(super) fn of_fields(reader: &mut FileReader, fields: &mut Fields) -> Self {
                $name {
                    $($field: readable!(read reader, fields, $type, $key $($expected)?),)+
                }
            }

            /// Reads fields in parentheses.
            #[allow(dead_code)]
            fn of_piece(reader: &mut FileReader, piece: RawValue) -> Option<Self> {
                let mut fields = reader.fields(piece, Self::GROUP)?;
                Some(Self::of_fields(reader, &mut fields))
            }
        }
    )+};
    (keys file) => {
        &["version"]
    };
    (keys $apart:ident) => {
        &[]
    };
    (keys $key:literal) => {
        &[$key]
    };
    (within within $type:ty) => {
        <$type>::GROUP.form.fields
    };
    (within $key:tt $type:ty) => {
        &[]
    };
    (read $reader:ident, $fields:ident, $type:ty, within) => {
        <$type>::of_fields($reader, $fields)
    };
    (read $reader:ident, $fields:ident, $type:ty, place) => {
        $fields.span.clone()
    };
    (read $reader:ident, $fields:ident, $type:ty, apart) => {
        Default::default()
    };
    (read $reader:ident, $fields:ident, $type:ty, $key:literal $expected:expr) => {
        $reader.field($fields, $key, $expected)
    };
}

part_structures!(readable);
load_structures!(readable);
axes_structures!(readable);

/// A value of a file.
pub(super) trait FileItem: Sized {
    /// True if a map of such values may not be left out.
    const REQUIRED: bool = false;

    /// Reads it where something is expected; `None` if it has problems.
    fn read(reader: &mut FileReader, piece: RawValue, expected: Expected) -> Option<Self>;
}

macro_rules! items {
    ($($type:ty: |$reader:ident, $piece:ident, $expected:pat_param| $read:expr;)+) => {$(
        impl FileItem for $type {
            fn read($reader: &mut FileReader, $piece: RawValue, $expected: Expected) -> Option<Self> {
                $read
            }
        }
    )+};
}

items! {
    Spanned<String>: |reader, piece, expected| reader.text(piece, expected);
    Spanned<Convention>: |reader, piece, expected| {
        let found = reader.bare_word(piece, expected, &Convention::ALL, Convention::word)?;
        Some(Spanned::new(found, piece.span()))
    };
    Role: |reader, piece, expected| reader.bare_word(piece, expected, &ROLES, Role::word);
    Entry: |reader, piece, expected| match expected {
        Expected::Quantity => reader.quantity(piece),
        _ => reader.entry(piece),
    };
    (Entry, Entry): |reader, piece, expected| {
        reader.vector(piece, expected).map(|[low, high]| (low, high))
    };
    [Entry; 2]: |reader, piece, expected| reader.vector(piece, expected);
    [Entry; 3]: |reader, piece, expected| reader.vector(piece, expected);
    [Spanned<String>; 2]: |reader, piece, expected| {
        let [first, second] = reader.tuple(piece, expected)?.map(|of| reader.text(of, expected.part()));
        Some([first?, second?])
    };
    [[Entry; 3]; 2]: |reader, piece, expected| {
        let [first, second] = reader.tuple(piece, expected)?.map(|of| reader.vector(of, Expected::VECTOR));
        Some([first?, second?])
    };
    [[Entry; 3]; 3]: |reader, piece, expected| {
        let rows = reader.tuple(piece, expected)?;
        reader.matrix(rows, Expected::Said("a row of a rotation matrix"))
    };
    [[Entry; 4]; 3]: |reader, piece, expected| reader.homogeneous(piece, expected);
    Displacement: |reader, piece, _| reader.displacement(piece);
    Vec<Displacement>: |reader, piece, expected| FileField::read(reader, piece, expected);
    JointDescription: |reader, piece, _| {
        let (role, _) = reader.word(piece, Expected::JOINT, &ROLES, Role::word)?;
        let group = FieldGroup { word: role.word(), ..JointDescription::GROUP };
        let mut fields = reader.fields(piece, group)?;
        Some(JointDescription { role, ..JointDescription::of_fields(reader, &mut fields) })
    };
    ChainDescription: |reader, piece, _| ChainDescription::of_piece(reader, piece);
    RowDescription: |reader, piece, _| {
        let row = RowDescription::of_piece(reader, piece);
        // it still counts, so that the links after it keep their numbers
        let [alpha, a, d, theta] = std::array::from_fn(|_| Entry::absent());
        let span = piece.span();
        row.or(Some(RowDescription { span, ..RowDescription::new(alpha, a, d, theta) }))
    };
    PlatformDescription: |reader, piece, _| PlatformDescription::of_piece(reader, piece);
    ClosureDescription: |reader, piece, _| reader.closure(piece);
    ClosedFormDescription: |reader, piece, _| reader.closed_form(piece);
    MassDescription: |reader, piece, _| MassDescription::of_piece(reader, piece);
    InertiaDescription: |reader, piece, expected| Some(InertiaDescription(match piece.shape() {
        PieceShape::Tuple => Vec::from(reader.vector::<6>(piece, expected)?),
        _ => vec![reader.entry(piece)?],
    }));
    ShapeDescription: |reader, piece, expected| reader.shape(piece, expected);
    LoadDescription: |reader, piece, _| reader.load(piece);
    PointDescription: |reader, piece, _| reader.point(piece);
    AxisPlace: |reader, piece, _| reader.body(piece);
}

impl FileItem for AxisDescription {
    const REQUIRED: bool = true;

    fn read(reader: &mut FileReader, piece: RawValue, _: Expected) -> Option<Self> {
        reader.axis(piece)
    }
}

/// The value of a field.
pub(super) trait FileField: Sized {
    /// True if the field may not be left out.
    const REQUIRED: bool = false;

    /// The value where it is left out.
    fn absent() -> Self;

    /// Reads it where something is expected; `None` if it has problems.
    fn read(reader: &mut FileReader, piece: RawValue, expected: Expected) -> Option<Self>;
}

macro_rules! fields {
    ($([$($of:ident)?] $type:ty $(where $required:expr)? => $absent:expr, |$reader:ident, $piece:ident, $expected:pat_param| $read:expr;)+) => {$(
        impl$(<$of: FileItem>)? FileField for $type {
            $(const REQUIRED: bool = $required;)?

            fn absent() -> Self {
                $absent
            }

            fn read($reader: &mut FileReader, $piece: RawValue, $expected: Expected) -> Option<Self> {
                $read
            }
        }
    )+};
}

fields! {
    [] Entry => Entry::absent(), |reader, piece, _| reader.entry(piece);
    [] Spanned<String> where true => Spanned::default(), |reader, piece, expected| reader.text(piece, expected);
    [T] Option<T> => None, |reader, piece, expected| T::read(reader, piece, expected).map(Some);
    [T] Vec<T> => Vec::new(), |reader, piece, expected| {
        Some(reader.list(piece, expected, |reader, item| T::read(reader, item, expected.part())))
    };
    [T] Vec<Named<T>> where T::REQUIRED => Vec::new(), |reader, piece, expected| match expected {
        Expected::MapOf(noun) => Some(reader.map(piece, noun, |reader, item| T::read(reader, item, expected.part()))),
        _ => None,
    };
    [] Vec<(Spanned<MatrixEntry>, Entry)> => Vec::new(), |reader, piece, expected| {
        let named = FileField::read(reader, piece, expected)?;
        Some(reader.matrix_entries(named))
    };
}

/// The roles of joints, as messages list them.
const ROLES: [Role; 2] = [Role::Passive, Role::Actuated];
