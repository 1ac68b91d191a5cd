//! Description → text that reads back as an equal description.

use ron::ser::PrettyConfig;
use serde::ser::{
    Serialize, SerializeStruct, SerializeStructVariant, SerializeTupleVariant, Serializer,
};

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

/// The value of a field, which is left out unless it is given.
trait WrittenField {
    fn is_given(&self) -> bool;

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error>;
}

macro_rules! field {
    ($($type:ty $(where $parameter:ident)?: |$value:ident| $given:expr, $written:expr;)+) => {$(
        impl$(<$parameter: Serialize>)? WrittenField for $type {
            #[allow(unused_variables)]
            fn is_given(&self) -> bool {
                let $value = self;
                $given
            }

            fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let $value = self;
                $written.serialize(serializer)
            }
        }
    )+};
}

field! {
    u32: |number| true, number;
    Spanned<String>: |text| true, text;
    Entry: |entry| !entry.expression.is_zero(), entry;
    Vec<Displacement>: |steps| !steps.is_empty(), steps;
    Vec<RowDescription>: |rows| !rows.is_empty(), rows;
    Vec<Spanned<String>>: |names| !names.is_empty(), names;
    Vec<(Spanned<MatrixEntry>, Entry)>: |entries| !entries.is_empty(), PoseEntries(entries);
    Vec<Named<T>> where T: |named| !named.is_empty(), NamedMap(named);
    Option<T> where T: |value| value.is_some(), Bare(value);
}

struct AsWritten<'a, F>(&'a F);

impl<F: WrittenField> Serialize for AsWritten<'_, F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.write(serializer)
    }
}

/// Fields in parentheses. A variant is named in every layout; a structure is not, unless its name is asked for, which is that
/// of the file.
macro_rules! started {
    ($serializer:ident, $part:ident, $word:expr) => {
        $serializer.serialize_struct_variant(stringify!($part), 0, $word, 1)
    };
    ($serializer:ident, $part:ident) => {
        $serializer.serialize_struct(stringify!($part).trim_end_matches("Description"), 1)
    };
}

/// Writes the given fields of each part, behind a word if it has one.
macro_rules! written {
    ($($part:ident |$of:ident| $(as $word:expr,)? { $($name:literal: $value:expr),+ $(,)? })+) => {$(
        impl Serialize for $part {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let $of = self;
                let mut fields = started!(serializer, $part $(, $word)?)?;
                $(if $value.is_given() { fields.serialize_field($name, &AsWritten(&$value))?; })+
                fields.end()
            }
        }
    )+};
}

written! {
    Description |file| as "Mechanism", {
        "version": VERSION, "name": file.name, "source": file.source, "convention": file.convention,
        "tolerance": file.tolerance, "parameters": file.parameters, "joints": file.joints, "chains": file.chains, "platforms": file.platforms,
        "closures": file.closures, "closed_forms": file.closed_forms, "outputs": file.outputs,
        "gravity": file.loads.gravity, "masses": file.loads.masses, "loads": file.loads.loads,
    }
    JointDescription |joint| as joint.role.word(), { "home": joint.home, "limits": joint.limits }
    ChainDescription |chain| as "Chain", {
        "on": chain.on, "convention": chain.convention, "base": chain.base, "rows": chain.rows, "tip": chain.tip,
    }
    RowDescription |row| { "alpha": row.alpha, "a": row.a, "d": row.d, "theta": row.theta, "link": row.link }
    PlatformDescription |platform| as "Platform", { "home": platform.home, "frames": platform.frames }
    ClosedFormDescription |form| as "ClosedForm", {
        "of": form.of, "in": form.relative_to, "where": form.locals, "source": form.source,
        "position": form.position, "rotation": form.rotation, "transform": form.transform,
        "entries": form.entries, "identity": form.identity, "identities": form.identities,
    }
    AxesDescription |file| as "Axes", {
        "version": VERSION, "name": file.name, "source": file.source, "convention": file.convention,
        "tolerance": file.tolerance, "parameters": file.parameters, "joints": Some(NamedMap(&file.joints)), "bodies": bodies(&file.bodies),
        "points": file.points, "base": file.base, "tool": file.tool, "cut": file.cut,
        "closed_forms": file.closed_forms, "outputs": file.outputs,
        "gravity": file.loads.gravity, "masses": file.loads.masses, "loads": file.loads.loads,
    }
    MassDescription |of| {
        "mass": of.mass, "centre": of.centre, "inertia": of.inertia, "shape": of.shape, "density": of.density,
        "turned": of.turned,
    }
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
        let mut fields =
            serializer.serialize_struct_variant("Load", 0, self.kind.word(), self.fields.len())?;
        for (name, value) in &self.fields {
            match value {
                LoadField::Name(name_of) | LoadField::File(name_of) => {
                    fields.serialize_field(name, name_of)?
                }
                LoadField::Points([a, b]) => fields.serialize_field(name, &(a, b))?,
                LoadField::Entry(entry) => fields.serialize_field(name, entry)?,
                LoadField::Vector([x, y, z]) => fields.serialize_field(name, &(x, y, z))?,
                LoadField::Yes(yes) => fields.serialize_field(name, yes)?,
                LoadField::Table(rows) => {
                    let rows: Vec<(&Entry, &Entry)> = rows.iter().map(|[x, y]| (x, y)).collect();
                    fields.serialize_field(name, &rows)?;
                }
            }
        }
        fields.end()
    }
}

fn bodies(bodies: &[Named<AxisPlace>]) -> Vec<Named<WrittenPlace<'_>>> {
    let bodies = bodies.iter();
    bodies
        .map(|body| {
            Named::new(
                &body.name.value,
                WrittenPlace("Body", "origin", &body.value),
            )
        })
        .collect()
}

/// A place with the words of its fields: the name of the whole and that of its point.
struct WrittenPlace<'a>(&'static str, &'static str, &'a AxisPlace);

impl Serialize for WrittenPlace<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct(self.0, 1)?;
        for (name, value) in self.2.fields(self.1) {
            fields.serialize_field(name, &value)?;
        }
        fields.end()
    }
}

impl Serialize for PointDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Point", 2)?;
        fields.serialize_field("body", &self.body)?;
        for (name, value) in self.place.fields("at") {
            fields.serialize_field(name, &value)?;
        }
        fields.end()
    }
}

/// The value of a field that places something.
#[derive(serde::Serialize)]
#[serde(untagged)]
enum PlacedField<'a> {
    Vector(&'a [Entry; 3]),
    Pair(&'a [Entry; 3], &'a [Entry; 3]),
    Frame(&'a [Displacement]),
}

impl AxisPlace {
    /// The fields that say it, in their order; that of a point has different names.
    fn fields(&self, point_name: &'static str) -> Vec<(&'static str, PlacedField<'_>)> {
        let at = |point| (point_name, PlacedField::Vector(point));
        match self {
            AxisPlace::Along(point, direction) => {
                let direction = ("direction", PlacedField::Vector(direction));
                point.iter().map(at).chain([direction]).collect()
            }
            AxisPlace::Through(first, second) => {
                vec![("through", PlacedField::Pair(first, second))]
            }
            AxisPlace::Cross(point, [first, second]) => {
                vec![at(point), ("directions", PlacedField::Pair(first, second))]
            }
            AxisPlace::Centre(point) => vec![at(point)],
            AxisPlace::Frame(steps) => vec![("frame", PlacedField::Frame(steps))],
        }
    }
}

impl Serialize for AxisDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let by = match self.kind {
            AxisKind::Distance => "length",
            _ => "value",
        };
        let mut fields = serializer.serialize_struct_variant("Axis", 0, self.kind.word(), 1)?;
        // a fixed joint may be anywhere
        if self.kind != AxisKind::Fixed || self.place != AxisPlace::Frame(Vec::new()) {
            for (name, value) in self.place.fields("point") {
                fields.serialize_field(name, &value)?;
            }
        }
        macro_rules! given {
            ($($name:expr => $value:expr),+) => {
                $(if $value.is_some() { fields.serialize_field($name, &Bare(&$value))?; })+
            };
        }
        let second = self
            .second
            .as_ref()
            .map(|place| WrittenPlace("WrittenPlace", "point", place));
        given!("second" => second, "pitch" => self.pitch, by => self.value, "home" => self.home);
        given!("drawn" => self.drawn, "limits" => self.limits, "role" => self.role, "between" => self.between);
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

/// An optional value, without `Some(…)` around it.
struct Bare<'a, T>(&'a Option<T>);

impl<T: Serialize> Serialize for Bare<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            Some(value) => value.serialize(serializer),
            None => serializer.serialize_unit(),
        }
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
