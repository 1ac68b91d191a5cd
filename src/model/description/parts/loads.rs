//! Masses, springs and forces as a file gives them.

use std::collections::HashSet;
use std::ops::Range;

use super::{Displacement, Entry, Named, Spanned};
use crate::algebra::{Expression, words};
use crate::description::file_fields::{declared, load_structures};

load_structures!(declared);

/// Moments of inertia: six, or one of a flat body.
#[derive(Debug, Clone, PartialEq)]
pub struct InertiaDescription(pub Vec<Entry>);

/// A homogeneous shape with its dimensions (m).
#[derive(Debug, Clone, PartialEq)]
pub struct ShapeDescription {
    /// Its kind.
    pub kind: Shape,
    /// Its dimensions.
    pub sizes: Vec<Entry>,
}

words! {
    /// A homogeneous shape.
    Shape {
        /// `Rod(length)`: a thin rod along x.
        Rod = "Rod",
        /// `Plate(a, b)`: a thin plate with sides along x and y.
        Plate = "Plate",
        /// `Cylinder(radius, length)`: about z.
        Cylinder = "Cylinder",
        /// `Box(a, b, c)`: with edges along x, y and z.
        Box = "Box",
        /// `Sphere(radius)`.
        Sphere = "Sphere",
    }

    /// Forces between bodies, at joints or on a body.
    LoadKind {
        /// A spring, a damper or both, between two points or at a joint.
        Spring = "Spring",
        /// A force or moment that is given: between two points, at a joint or at a point.
        Force = "Force",
        /// Coulomb friction in a joint.
        Friction = "Friction",
    }
}

impl Shape {
    /// Number of its dimensions.
    pub fn sizes(self) -> usize {
        match self {
            Self::Rod | Self::Sphere => 1,
            Self::Plate | Self::Cylinder => 2,
            Self::Box => 3,
        }
    }
}

/// A spring, a force or friction, with its fields.
#[derive(Debug, Clone)]
pub struct LoadDescription {
    /// Its kind.
    pub kind: LoadKind,
    /// The fields that are given, in the order of their kind.
    pub fields: Vec<(&'static str, LoadField)>,
    /// Its place.
    pub span: Range<usize>,
}

/// The value of a field of a load.
#[derive(Debug, Clone, PartialEq)]
pub enum LoadField {
    /// The name of a joint or a point.
    Name(Spanned<String>),
    /// Two points.
    Points([Spanned<String>; 2]),
    /// A number or an expression.
    Entry(Entry),
    /// A vector.
    Vector([Entry; 3]),
    /// True or false.
    Yes(bool),
    /// Rows of a table, from which a value is read between its neighbours.
    Table(Vec<[Entry; 2]>),
    /// The CSV file of a table, in the folder of the mechanism file.
    File(Spanned<String>),
}

impl LoadDescription {
    /// A field, if it is given.
    pub fn field(&self, name: &str) -> Option<&LoadField> {
        let field = self.fields.iter().find(|(known, _)| *known == name);
        field.map(|(_, value)| value)
    }
}

impl LoadsDescription {
    /// The frames and points at which it acts, each with offsets if it has any.
    pub fn points(&mut self) -> impl Iterator<Item = &mut Spanned<String>> {
        let masses = self.masses.iter_mut().map(|mass| &mut mass.name);
        let fields = self.loads.iter_mut().flat_map(|of| &mut of.value.fields);
        masses.chain(fields.flat_map(|(field, value)| match value {
            LoadField::Name(name) if *field != "joint" => std::slice::from_mut(name),
            LoadField::Points(points) => points,
            _ => &mut [],
        }))
    }

    /// Every name in its expressions and in the offsets of its points.
    pub fn names(&self) -> HashSet<String> {
        let mut entries: Vec<&Entry> = self.gravity.iter().flatten().collect();
        let mut points: Vec<&str> = Vec::new();
        for Named { name, value } in &self.masses {
            points.push(&name.value);
            entries.extend(value.mass.iter().chain(&value.density));
            entries.extend(value.centre.iter().flatten());
            entries.extend(value.inertia.iter().flat_map(|of| &of.0));
            entries.extend(value.shape.iter().flat_map(|of| &of.sizes));
            entries.extend(value.turned.iter().flat_map(Displacement::entries));
        }
        let fields = self.loads.iter().flat_map(|load| &load.value.fields);
        for (_, field) in fields {
            match field {
                LoadField::Name(name) => points.push(&name.value),
                LoadField::Points(names) => points.extend(names.iter().map(|of| &*of.value)),
                LoadField::Entry(entry) => entries.push(entry),
                LoadField::Vector(parts) => entries.extend(parts),
                LoadField::Table(rows) => entries.extend(rows.iter().flatten()),
                LoadField::Yes(_) | LoadField::File(_) => {}
            }
        }
        let offsets = points.iter().filter_map(|point| point.split_once('+'));
        let offsets = offsets.flat_map(|(_, offsets)| offsets.split(','));
        let offsets = offsets.filter_map(|text| Expression::parse(text).ok());
        let written = entries.into_iter().map(|of| of.expression.clone());
        let all = written.chain(offsets);
        all.flat_map(|of| of.names().map(|(name, _)| name.clone()).collect::<Vec<_>>())
            .collect()
    }
}

// parts are equal if their contents are, wherever they stand
impl PartialEq for LoadDescription {
    fn eq(&self, other: &Self) -> bool {
        (self.kind, &self.fields) == (other.kind, &other.fields)
    }
}
