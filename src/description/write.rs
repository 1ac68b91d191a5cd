//! Description → text that reads back as an equal description.

use ron::ser::PrettyConfig;
use serde::ser::{
    Serialize, SerializeStruct, SerializeStructVariant, SerializeTupleVariant, Serializer,
};

use super::*;

/// Writes the fields that are given.
macro_rules! fields {
    ($start:expr, $($name:literal: $value:expr, if $given:expr;)+) => {{
        let mut fields = $start?;
        $(if $given { fields.serialize_field($name, $value)?; })+
        fields.end()
    }};
}

impl Description {
    /// The text of an equivalent mechanism file. Comments are not kept.
    pub fn to_ron(&self) -> Result<String, ron::Error> {
        // Rows and vectors stand on one line, as in a printed table.
        let layout = PrettyConfig::new().depth_limit(4);
        Ok(ron::ser::to_string_pretty(self, layout)? + "\n")
    }
}

impl AxesDescription {
    /// The text of an equivalent file of joint axes. Comments are not kept.
    pub fn to_ron(&self) -> Result<String, ron::Error> {
        let layout = PrettyConfig::new().depth_limit(2);
        Ok(ron::ser::to_string_pretty(self, layout)? + "\n")
    }
}

impl Serialize for AxesDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        fields!(serializer.serialize_struct_variant("File", 0, "Axes", 9),
            "version": &VERSION, if true;
            "name": &self.name, if true;
            "source": &Bare(&self.source), if self.source.is_some();
            "convention": &Bare(&self.convention), if self.convention.is_some();
            "parameters": &Map(&self.parameters), if !self.parameters.is_empty();
            "joints": &Map(&self.joints), if true;
            "base": &Bare(&self.base), if self.base.is_some();
            "tool": &Bare(&self.tool), if self.tool.is_some();
            "cut": &self.cut, if !self.cut.is_empty();
        )
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
        let (point, direction, through) = match &self.place {
            AxisPlace::Along(point, direction) => (point.as_ref(), Some(direction), None),
            AxisPlace::Through(first, second) => (None, None, Some((first, second))),
            AxisPlace::Centre(point) => (Some(point), None, None),
        };
        let role = self.role.map(|role| Word(role.word()));
        fields!(serializer.serialize_struct_variant("Axis", 0, self.kind.word(), 7),
            "point": &Bare(&point), if point.is_some();
            "direction": &Bare(&direction), if direction.is_some();
            "through": &Bare(&through), if through.is_some();
            "home": &self.home, if !self.home.expression.is_zero();
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
