//! Description → text that reads back as an equal description.

use ron::ser::PrettyConfig;
use serde::ser::{
    Serialize, SerializeStruct, SerializeStructVariant, SerializeTupleVariant, Serializer,
};

use super::file_fields::{axes_structures, load_structures, part_structures};
use super::*;

impl Description {
    /// The text of an equivalent mechanism file. Comments are not kept.
    pub fn to_ron(&self) -> Result<String, ron::Error> {
        // rows and vectors on one line, as in a printed table
        let layout = PrettyConfig::new().depth_limit(4);
        Ok(ron::ser::to_string_pretty(self, layout)? + "\n")
    }
}

impl AxesDescription {
    /// The text of an equivalent file of joint coordinates. Comments are not kept.
    pub fn to_ron(&self) -> Result<String, ron::Error> {
        let layout = PrettyConfig::new().depth_limit(2);
        Ok(ron::ser::to_string_pretty(self, layout)? + "\n")
    }
}

/// Fields in parentheses that are being written. The word before them is left out unless it is asked for, or they are those of a
/// variant.
enum WrittenFields<S: Serializer> {
    Bare(S::SerializeStruct),
    Named(S::SerializeStructVariant),
}

impl<S: Serializer> WrittenFields<S> {
    fn bare(serializer: S, word: &'static str) -> Result<Self, S::Error> {
        serializer.serialize_struct(word, 1).map(Self::Bare)
    }

    fn named(serializer: S, word: &'static str) -> Result<Self, S::Error> {
        let fields = serializer.serialize_struct_variant("Part", 0, word, 1);
        fields.map(Self::Named)
    }

    fn put<T: Serialize + ?Sized>(
        &mut self,
        name: &'static str,
        value: &T,
    ) -> Result<(), S::Error> {
        match self {
            Self::Bare(fields) => fields.serialize_field(name, value),
            Self::Named(fields) => fields.serialize_field(name, value),
        }
    }

    /// Writes a field, unless it is not given.
    fn given<T: WrittenField>(&mut self, name: &'static str, value: &T) -> Result<(), S::Error> {
        match value.written() {
            Some(written) => self.put(name, &written),
            None => Ok(()),
        }
    }

    fn end(self) -> Result<S::Ok, S::Error> {
        match self {
            Self::Bare(fields) => fields.end(),
            Self::Named(fields) => fields.end(),
        }
    }
}

/// Writing of structures.
macro_rules! writable {
    ($($(#[$about:meta])* $name:ident = $form:ident $($by:ident)? $word:literal, $said:literal {
        $($(#[$doc:meta])* $field:ident: $type:ty = $key:tt $(as $expected:expr)?,)+
    })+) => {$(
        impl $name {
            fn write_fields<S: Serializer>(&self, fields: &mut WrittenFields<S>) -> Result<(), S::Error> {
                writable!(version fields, $form);
                $(writable!(write fields, self.$field, $key);)+
                Ok(())
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let mut fields = writable!(start serializer, self, $form $($by)?, $word);
                self.write_fields(&mut fields)?;
                fields.end()
            }
        }
    )+};
    (version $fields:ident, file) => {
        $fields.put("version", &VERSION)?
    };
    (version $fields:ident, $form:ident) => {};
    (write $fields:ident, $of:ident.$field:ident, within) => {
        $of.$field.write_fields($fields)?
    };
    (write $fields:ident, $of:ident.$field:ident, $key:ident) => {};
    (write $fields:ident, $of:ident.$field:ident, $key:literal) => {
        $fields.given($key, &$of.$field)?
    };
    (start $serializer:ident, $of:ident, part, $word:literal) => {
        WrittenFields::bare($serializer, $word)?
    };
    (start $serializer:ident, $of:ident, by $kind:ident, $word:literal) => {
        WrittenFields::named($serializer, $of.$kind.word())?
    };
    (start $serializer:ident, $of:ident, $form:ident, $word:literal) => {
        WrittenFields::named($serializer, $word)?
    };
}

part_structures!(writable);
load_structures!(writable);
axes_structures!(writable);

/// The value of a field as it is written, unless it is left out.
trait WrittenField {
    fn written(&self) -> Option<impl Serialize>;
}

macro_rules! written {
    ($([$($of:ident)?] $type:ty => |$value:ident| $written:expr;)+) => {$(
        impl$(<$of: Serialize>)? WrittenField for $type {
            fn written(&self) -> Option<impl Serialize> {
                let $value = self;
                $written
            }
        }
    )+};
}

written! {
    [] Entry => |entry| Some(entry).filter(|entry| !entry.expression.is_zero());
    [] Spanned<String> => |text| Some(text);
    [T] Option<T> => |value| value.as_ref();
    [] Vec<Displacement> => |steps| Some(steps).filter(|steps| !steps.is_empty());
    [] Vec<RowDescription> => |rows| Some(rows).filter(|rows| !rows.is_empty());
    [] Vec<Spanned<String>> => |names| Some(names).filter(|names| !names.is_empty());
    [T] Vec<Named<T>> => |items| (!items.is_empty()).then_some(NamedMap(items));
    [] Vec<(Spanned<MatrixEntry>, Entry)> => |entries| (!entries.is_empty()).then_some(PoseEntries(entries));
}

impl Serialize for InertiaDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0[..] {
            [only] => only.serialize(serializer),
            [a, b, c, d, e, f] => (a, b, c, d, e, f).serialize(serializer),
            other => other.serialize(serializer),
        }
    }
}

impl Serialize for ShapeDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (word, count) = (self.kind.word(), self.sizes.len());
        let mut tuple = serializer.serialize_tuple_variant("Shape", 0, word, count)?;
        for size in &self.sizes {
            tuple.serialize_field(size)?;
        }
        tuple.end()
    }
}

impl Serialize for LoadDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = WrittenFields::named(serializer, self.kind.word())?;
        for (name, value) in &self.fields {
            match value {
                LoadField::Name(name_of) | LoadField::File(name_of) => fields.put(name, name_of)?,
                LoadField::Points(points) => fields.put(name, points)?,
                LoadField::Entry(entry) => fields.put(name, entry)?,
                LoadField::Vector(vector) => fields.put(name, vector)?,
                LoadField::Yes(yes) => fields.put(name, yes)?,
                LoadField::Table(rows) => fields.put(name, rows)?,
            }
        }
        fields.end()
    }
}

/// A place with the words of its fields: the name of the whole and that of its point.
struct WrittenPlace<'a>(&'static str, &'static str, &'a AxisPlace);

impl Serialize for WrittenPlace<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = WrittenFields::bare(serializer, self.0)?;
        self.2.write_fields(self.1, &mut fields)?;
        fields.end()
    }
}

/// As that of a body.
impl Serialize for AxisPlace {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        WrittenPlace("Body", "origin", self).serialize(serializer)
    }
}

impl Serialize for PointDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = WrittenFields::bare(serializer, "Point")?;
        fields.put("body", &self.body)?;
        self.place.write_fields("at", &mut fields)?;
        fields.end()
    }
}

impl AxisPlace {
    /// Writes the fields that say it, in their order; that of a point has different names.
    fn write_fields<S: Serializer>(
        &self,
        point: &'static str,
        fields: &mut WrittenFields<S>,
    ) -> Result<(), S::Error> {
        match self {
            AxisPlace::Along(at, direction) => {
                fields.given(point, at)?;
                fields.put("direction", direction)
            }
            AxisPlace::Through(first, second) => fields.put("through", &(first, second)),
            AxisPlace::Cross(at, directions) => {
                fields.put(point, at)?;
                fields.put("directions", directions)
            }
            AxisPlace::Centre(at) => fields.put(point, at),
            AxisPlace::Frame(steps) => fields.put("frame", steps),
        }
    }
}

impl Serialize for AxisDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = WrittenFields::named(serializer, self.kind.word())?;
        if !self.has_no_place() {
            self.place.write_fields("point", &mut fields)?;
        }
        if let Some(second) = &self.second {
            fields.put("second", &WrittenPlace("Place", "point", second))?;
        }
        fields.given("pitch", &self.pitch)?;
        fields.given(self.kind.follows_by(), &self.value)?;
        fields.given("home", &self.home)?;
        fields.given("drawn", &self.drawn)?;
        fields.given("limits", &self.limits)?;
        fields.given("role", &self.role)?;
        fields.given("between", &self.between)?;
        fields.end()
    }
}

/// A list of named things, as a map in the same order.
struct NamedMap<'a, T>(&'a [Named<T>]);

impl<T: Serialize> Serialize for NamedMap<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|named| (&named.name, &named.value)))
    }
}

/// Single entries of a pose, as a map in the same order.
struct PoseEntries<'a>(&'a [(Spanned<MatrixEntry>, Entry)]);

impl Serialize for PoseEntries<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let entries = self.0.iter();
        serializer.collect_map(entries.map(|(place, entry)| (place.value.to_string(), entry)))
    }
}

impl Serialize for Displacement {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let entries = self.entries();
        let mut tuple =
            serializer.serialize_tuple_variant("Step", 0, self.word(), entries.len())?;
        for entry in entries {
            tuple.serialize_field(entry)?;
        }
        tuple.end()
    }
}

impl Serialize for ClosureDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let frames = match self.kind {
            ClosureKind::Coupling => &[],
            _ => &self.frames[..],
        };
        let length = frames.len() + usize::from(self.length.is_some());
        let mut tuple =
            serializer.serialize_tuple_variant("Closure", 0, self.kind.word(), length)?;
        for frame in frames {
            tuple.serialize_field(frame)?;
        }
        if let Some(length) = &self.length {
            tuple.serialize_field(length)?;
        }
        tuple.end()
    }
}

impl<T: Serialize> Serialize for Spanned<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.value.serialize(serializer)
    }
}

impl Serialize for Entry {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.expression.serialize(serializer)
    }
}
