//! Description → text that reads back as an equal description.

use ron::ser::PrettyConfig;
use serde::ser::{
    Serialize, SerializeStruct, SerializeStructVariant, SerializeTupleVariant, Serializer,
};

use super::*;

/// Writes the fields that are given.
macro_rules! fields {
    ($start:expr, $($name:tt: $value:expr, if $given:expr;)+) => {{
        let mut fields = $start?;
        $(if $given { fields.serialize_field($name, $value)?; })+
        fields.end()
    }};
}

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

impl Serialize for AxesDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        fields!(serializer.serialize_struct_variant("File", 0, "Axes", 13),
            "version": &VERSION, if true;
            "name": &self.name, if true;
            "source": &Bare(&self.source), if self.source.is_some();
            "convention": &Bare(&self.convention), if self.convention.is_some();
            "parameters": &Map(&self.parameters), if !self.parameters.is_empty();
            "joints": &Map(&self.joints), if true;
            "bodies": &Bodies(&self.bodies), if !self.bodies.is_empty();
            "points": &Map(&self.points), if !self.points.is_empty();
            "base": &Bare(&self.base), if self.base.is_some();
            "tool": &Bare(&self.tool), if self.tool.is_some();
            "cut": &self.cut, if !self.cut.is_empty();
            "closed_forms": &Map(&self.closed_forms), if !self.closed_forms.is_empty();
            "outputs": &Map(&self.outputs), if !self.outputs.is_empty();
        )
    }
}

/// The frames of bodies, as a map in the same order.
struct Bodies<'a>(&'a [Named<AxisPlace>]);

impl Serialize for Bodies<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        struct Body<'a>(&'a AxisPlace);
        impl Serialize for Body<'_> {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let (origin, frame) = self.0.point_or_frame();
                fields!(serializer.serialize_struct("Body", 2),
                    "origin": &Bare(&origin), if origin.is_some();
                    "frame": &Bare(&frame), if frame.is_some();
                )
            }
        }
        let bodies = self.0.iter();
        serializer.collect_map(bodies.map(|named| (&named.name, Body(&named.value))))
    }
}

impl Serialize for PointDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (at, frame) = self.place.point_or_frame();
        fields!(serializer.serialize_struct("Point", 3),
            "body": &self.body, if true;
            "at": &Bare(&at), if at.is_some();
            "frame": &Bare(&frame), if frame.is_some();
        )
    }
}

/// The place of a joint on its second body.
impl Serialize for AxisPlace {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Place", 1)?;
        for (name, value) in self.fields() {
            fields.serialize_field(name, &value)?;
        }
        fields.end()
    }
}

/// The value of a field that places something.
enum Placed<'a> {
    Vector(&'a [Entry; 3]),
    Pair(&'a [Entry; 3], &'a [Entry; 3]),
    Frame(&'a [Displacement]),
}

impl Serialize for Placed<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Placed::Vector(vector) => vector.serialize(serializer),
            Placed::Pair(first, second) => (first, second).serialize(serializer),
            Placed::Frame(steps) => steps.serialize(serializer),
        }
    }
}

impl AxisPlace {
    /// The fields that say it, in their order.
    fn fields(&self) -> Vec<(&'static str, Placed<'_>)> {
        match self {
            AxisPlace::Along(point, direction) => {
                let point = point.as_ref().map(|point| ("point", Placed::Vector(point)));
                let direction = ("direction", Placed::Vector(direction));
                point.into_iter().chain([direction]).collect()
            }
            AxisPlace::Through(first, second) => vec![("through", Placed::Pair(first, second))],
            AxisPlace::Cross(point, [first, second]) => vec![
                ("point", Placed::Vector(point)),
                ("directions", Placed::Pair(first, second)),
            ],
            AxisPlace::Centre(point) => vec![("point", Placed::Vector(point))],
            AxisPlace::Frame(steps) => vec![("frame", Placed::Frame(steps))],
        }
    }

    fn point_or_frame(&self) -> (Option<&[Entry; 3]>, Option<&Vec<Displacement>>) {
        match self {
            AxisPlace::Centre(point) => (Some(point), None),
            AxisPlace::Frame(steps) => (None, Some(steps)),
            _ => (None, None),
        }
    }
}

/// A word without anything behind it.
struct Word(&'static str);

impl Serialize for Word {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_unit_variant("Word", 0, self.0)
    }
}

impl Serialize for AxisDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let role = self.role.map(|role| Word(role.word()));
        let by = match self.kind {
            AxisKind::Distance => "length",
            _ => "value",
        };
        // a fixed joint may be anywhere
        let anywhere = self.kind == AxisKind::Fixed && self.place == AxisPlace::Frame(Vec::new());
        let name = self.kind.word();
        let mut fields = serializer.serialize_struct_variant("Axis", 0, name, 12)?;
        for (name, value) in self.place.fields() {
            if !anywhere {
                fields.serialize_field(name, &value)?;
            }
        }
        fields!(Ok::<_, S::Error>(fields),
            "second": &Bare(&self.second), if self.second.is_some();
            "pitch": &Bare(&self.pitch), if self.pitch.is_some();
            by: &Bare(&self.value), if self.value.is_some();
            "home": &Bare(&self.home), if self.home.is_some();
            "drawn": &Bare(&self.drawn), if self.drawn.is_some();
            "limits": &Bare(&self.limits), if self.limits.is_some();
            "role": &Bare(&role), if role.is_some();
            "between": &Bare(&self.between), if self.between.is_some();
        )
    }
}

/// A list of named things, as a map in the same order.
struct Map<'a, T>(&'a [Named<T>]);

impl<T: Serialize> Serialize for Map<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|named| (&named.name, &named.value)))
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

impl Serialize for Description {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // A variant is named in every layout, a structure is not.
        fields!(serializer.serialize_struct_variant("File", 0, "Mechanism", 11),
            "version": &VERSION, if true;
            "name": &self.name, if true;
            "source": &Bare(&self.source), if self.source.is_some();
            "convention": &Bare(&self.convention), if self.convention.is_some();
            "parameters": &Map(&self.parameters), if !self.parameters.is_empty();
            "joints": &Map(&self.joints), if !self.joints.is_empty();
            "chains": &Map(&self.chains), if !self.chains.is_empty();
            "platforms": &Map(&self.platforms), if !self.platforms.is_empty();
            "closures": &Map(&self.closures), if !self.closures.is_empty();
            "closed_forms": &Map(&self.closed_forms), if !self.closed_forms.is_empty();
            "outputs": &Map(&self.outputs), if !self.outputs.is_empty();
        )
    }
}

impl Serialize for JointDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        fields!(serializer.serialize_struct_variant("Joint", self.role as u32, self.role.word(), 2),
            "home": &self.home, if !self.home.expression.is_zero();
            "limits": &Bare(&self.limits), if self.limits.is_some();
        )
    }
}

impl Serialize for ChainDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        fields!(serializer.serialize_struct_variant("Body", 0, "Chain", 5),
            "on": &Bare(&self.on), if self.on.is_some();
            "convention": &Bare(&self.convention), if self.convention.is_some();
            "base": &self.base, if !self.base.is_empty();
            "rows": &self.rows, if !self.rows.is_empty();
            "tip": &self.tip, if !self.tip.is_empty();
        )
    }
}

impl Serialize for Row {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        fields!(serializer.serialize_struct("Row", 4),
            "alpha": &self.alpha, if !self.alpha.expression.is_zero();
            "a": &self.a, if !self.a.expression.is_zero();
            "d": &self.d, if !self.d.expression.is_zero();
            "theta": &self.theta, if !self.theta.expression.is_zero();
        )
    }
}

impl Serialize for PlatformDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        fields!(serializer.serialize_struct_variant("Body", 1, "Platform", 2),
            "home": &self.home, if !self.home.is_empty();
            "frames": &Map(&self.frames), if !self.frames.is_empty();
        )
    }
}

impl Serialize for ClosedFormDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        fields!(serializer.serialize_struct_variant("Formula", 0, "ClosedForm", 10),
            "of": &Bare(&self.of), if self.of.is_some();
            "in": &Bare(&self.relative_to), if self.relative_to.is_some();
            "where": &Map(&self.locals), if !self.locals.is_empty();
            "source": &Bare(&self.source), if self.source.is_some();
            "position": &Bare(&self.position), if self.position.is_some();
            "rotation": &Bare(&self.rotation), if self.rotation.is_some();
            "transform": &Bare(&self.transform), if self.transform.is_some();
            "entries": &Entries(&self.entries), if !self.entries.is_empty();
            "identity": &Bare(&self.identity), if self.identity.is_some();
            "identities": &Map(&self.identities), if !self.identities.is_empty();
        )
    }
}

/// Single entries of a pose, as a map in the same order.
struct Entries<'a>(&'a [(Spanned<MatrixEntry>, Entry)]);

impl Serialize for Entries<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(
            self.0
                .iter()
                .map(|(place, entry)| (place.value.to_string(), entry)),
        )
    }
}

impl Serialize for Displacement {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let entries = self.entries();
        let mut tuple =
            serializer.serialize_tuple_variant("Displacement", 0, self.word(), entries.len())?;
        entries
            .iter()
            .try_for_each(|entry| tuple.serialize_field(entry))?;
        tuple.end()
    }
}

impl Serialize for ClosureDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let length = 2 + usize::from(self.length.is_some());
        let kind = self.kind;
        let mut tuple =
            serializer.serialize_tuple_variant("Closure", kind as u32, kind.word(), length)?;
        self.frames
            .iter()
            .try_for_each(|frame| tuple.serialize_field(frame))?;
        self.length
            .iter()
            .try_for_each(|length| tuple.serialize_field(length))?;
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
