//! The numbers of a file that are dimensions, as they are written, and how far writing has rounded them.

mod vectors;

use std::ops::Range;

use super::steps::zero;
use super::{
    AxisKind, AxisPlace, Description, Displacement, Entry, Named, Problem, first_free, names_of,
};
use crate::algebra::{Expression, Measure, Node, Operator, Unit};

pub use vectors::WrittenVector;

/// A number in a dimension of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Literal {
    /// The number.
    pub written: f64,
    /// The unit behind it.
    pub unit: Option<Unit>,
    /// Its measure; [`Measure::Number`] for a part of a direction, [`Measure::Open`] where nothing says it.
    pub measure: Measure,
    /// The part of the file in which it stands: `b`, `links row 2`, `joint A`.
    pub place: String,
    /// True for a coordinate of a point or a direction.
    pub in_vector: bool,
}

impl Literal {
    /// Its value in m or rad or without unit.
    pub fn value(&self) -> f64 {
        self.unit
            .map_or(self.written, |unit| unit.over(self.written))
    }

    /// The value of 1 in its place and unit in m or rad or without unit.
    fn size(&self) -> f64 {
        self.unit.map_or(1.0, |unit| unit.over(1.0))
    }

    /// The expression of another value in its place, in m or rad or without unit; right angles and their like in degrees.
    fn with_value(&self, value: f64) -> Expression {
        let node = match (self.measure, self.unit) {
            (Measure::Angle, None) => return Entry::angle(value).expression,
            (_, None) => Node::Number(value),
            (Measure::Angle, Some(_)) => {
                let degrees = Entry::angle(value).expression;
                let plain = degrees.as_number().is_some_and(|x| x != 0.0);
                match (plain, self.unit) {
                    (true, Some(unit)) => Node::Quantity(value / self.size(), unit),
                    _ => return degrees,
                }
            }
            (_, Some(unit)) => Node::Quantity(value / self.size(), unit),
        };
        match node {
            // a sign stands before a quantity, as the parser reads it
            Node::Quantity(x, unit) if x < 0.0 => {
                Node::negated(Node::Quantity(-x, unit).at(0..0)).at(0..0)
            }
            node => node.at(0..0),
        }
    }
}

/// The number of digits, and the power of ten of its last one.
fn digits(value: f64) -> (i32, i32) {
    let written = format!("{value:e}");
    let (mantissa, power) = written.split_once('e').unwrap_or((&written, "0"));
    let count = mantissa.chars().filter(char::is_ascii_digit).count() as i32;
    let power: i32 = power.parse().unwrap_or(0);
    (count, power - (count - 1))
}

/// So many digits were not rounded by anyone.
const ALL_DIGITS: i32 = 15;

/// So few digits are chosen, not measured.
const CHOSEN: i32 = 3;

/// For each literal the most by which it is off if it was rounded when it was written, in m or rad or without unit; `None` if
/// it is exact.
///
/// Numbers of one kind and unit are written alike: to as many decimals as the one with most, or, where several long ones have
/// fewer decimals, to as many digits; trailing zeros are not told from digits that are missing. A number with all digits of a
/// double is exact, and so are short ones like `2` or `90 deg` unless others of their kind are long. A number that is next to
/// nothing may be nothing.
pub fn roundings(literals: &[Literal], length: f64) -> Vec<Option<f64>> {
    /// One long number with fewer decimals has lost a zero.
    const SEVERAL: usize = 2;
    let rounded = |of: &Literal| {
        Some(digits(of.written)).filter(|(n, _)| *n < ALL_DIGITS && of.written != 0.0)
    };
    // the digits of all numbers of one kind and unit
    let mut kinds: Vec<(&Literal, Vec<(i32, i32)>)> = Vec::new();
    let kind_of = literals.iter().map(|of| {
        let alike =
            |(other, _): &(&Literal, _)| other.unit == of.unit && other.measure == of.measure;
        let kind = kinds.iter().position(alike).unwrap_or(kinds.len());
        if kind == kinds.len() {
            kinds.push((of, Vec::new()));
        }
        kinds[kind].1.extend(rounded(of));
        kind
    });
    let kind_of: Vec<usize> = kind_of.collect();
    // most digits, the last decimal, and true if several long numbers have fewer decimals
    let longest = |(_, alike): &(_, Vec<(i32, i32)>)| {
        let most = alike.iter().map(|(count, _)| *count).max()?;
        let last = alike.iter().map(|(_, power)| *power).min()?;
        let is_long = |(count, power): &&(i32, i32)| *count >= most - 1 && *power > last;
        Some((most, last, alike.iter().filter(is_long).count() >= SEVERAL))
    };
    let kinds: Vec<Option<(i32, i32, bool)>> = kinds.iter().map(longest).collect();
    let scale = |of: &Literal| match of.measure {
        Measure::Length | Measure::Open => length,
        _ => 1.0,
    };
    let off = |(of, kind): (&Literal, usize)| {
        let size = of.value().abs();
        // what is so small beside the mechanism is rounding, whatever its digits
        if size > 0.0 && size < 1e-8 * scale(of) {
            return Some(size);
        }
        let (most, last, several) = kinds[kind]?;
        let power = match rounded(of) {
            _ if most <= CHOSEN => return None,
            None if of.written == 0.0 && of.in_vector => last,
            None => return None,
            Some((count, own)) if several => own.min(last.max(own + count - most)),
            Some(_) => last,
        };
        let off = 0.5 * 10.0_f64.powi(power) * of.size();
        let beside = off / scale(of);
        // fewer digits are chosen, not measured
        (1e-15..7.5e-4).contains(&beside).then_some(off)
    };
    literals.iter().zip(kind_of).map(off).collect()
}

/// The most by which numbers of a text below 1, or about 1 where these are off by more, are off, from those with most
/// digits; numbers with all digits of a double do not count. `None` if all are short.
///
/// Programs write either so many decimals, or so many digits: then what is nearly nothing has decimals that say little, and
/// numbers above 1, such as angles, have one decimal less.
pub fn rounding_of_text(text: &str) -> Option<f64> {
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e' | 'E');
    let words = text.split(|c| !is_part(c)).filter(|w| w.contains('.'));
    let written: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
    let most = |sizes: Range<f64>| {
        let sized = written.iter().filter(|x| **x != 0.0);
        let sized = sized.filter(|x| sizes.contains(&x.abs()));
        let all = sized.map(|x| digits(*x));
        all.filter(|(n, _)| (CHOSEN + 1..ALL_DIGITS).contains(n))
            .max()
    };
    let (below, above) = (most(0.0..1.0), most(1.0..10.0));
    let last = match (below, above) {
        (Some((n, _)), Some((m, _))) if m <= n => 1 - n,
        (Some((_, last)), _) | (None, Some((_, last))) => last,
        (None, None) => return None,
    };
    Some(0.5 * 10.0_f64.powi(last))
}

/// Visits the numbers of a sum.
fn of_sum(expression: &mut Expression, visit: &mut dyn FnMut(&mut Expression)) {
    match &mut expression.node {
        Node::Number(_) | Node::Quantity(..) => visit(expression),
        Node::Negate(x) => of_sum(x, visit),
        Node::Binary(Operator::Add | Operator::Subtract, x, y) => {
            of_sum(x, visit);
            of_sum(y, visit);
        }
        _ => {}
    }
}

type Visit<'v> = dyn FnMut(&mut Entry, Measure, &str, bool) + 'v;

fn of_steps(steps: &mut [Displacement], place: &str, visit: &mut Visit) {
    for step in steps {
        match step {
            Displacement::Rotate(_, angle) => visit(angle, Measure::Angle, place, false),
            Displacement::Translate(_, length) => visit(length, Measure::Length, place, false),
            Displacement::TranslateBy(all) => {
                all.iter_mut()
                    .for_each(|of| visit(of, Measure::Length, place, true));
            }
        }
    }
}

fn of_axis(at: &mut AxisPlace, place: &str, visit: &mut Visit) {
    let mut vector = |entries: &mut [Entry; 3], measure| {
        entries
            .iter_mut()
            .for_each(|of| visit(of, measure, place, true));
    };
    match at {
        AxisPlace::Along(point, direction) => {
            point
                .iter_mut()
                .for_each(|point| vector(point, Measure::Length));
            vector(direction, Measure::Number);
        }
        AxisPlace::Through(first, second) => {
            vector(first, Measure::Length);
            vector(second, Measure::Length);
        }
        AxisPlace::Cross(point, directions) => {
            vector(point, Measure::Length);
            directions
                .iter_mut()
                .for_each(|of| vector(of, Measure::Number));
        }
        AxisPlace::Centre(point) => vector(point, Measure::Length),
        AxisPlace::Frame(steps) => of_steps(steps, place, visit),
    }
}

impl Description {
    /// Visits every entry on which the closures depend.
    fn dimensions(&mut self, visit: &mut Visit) {
        let of_parameters = |parameters: &mut [Named<Entry>], visit: &mut Visit| {
            for Named { name, value } in parameters {
                visit(value, Measure::Open, &name.value, false);
            }
        };
        if let Some(coordinates) = &mut self.coordinates {
            of_parameters(&mut coordinates.axes.parameters, visit);
            for Named { name, value } in &mut coordinates.axes.joints {
                let place = format!("joint {}", name.value);
                of_axis(&mut value.place, &place, visit);
                value
                    .second
                    .iter_mut()
                    .for_each(|of| of_axis(of, &place, visit));
                if let (AxisKind::Distance, Some(length)) = (value.kind, &mut value.value) {
                    visit(length, Measure::Length, &place, false);
                }
            }
            return;
        }
        of_parameters(&mut self.parameters, visit);
        for Named { name, value } in &mut self.chains {
            of_steps(&mut value.base, &name.value, visit);
            for (row, number) in value.rows.iter_mut().zip(1..) {
                let place = format!("{} row {number}", name.value);
                visit(&mut row.alpha, Measure::Angle, &place, false);
                visit(&mut row.a, Measure::Length, &place, false);
                visit(&mut row.d, Measure::Length, &place, false);
                visit(&mut row.theta, Measure::Angle, &place, false);
                visit(&mut row.beta, Measure::Angle, &place, false);
            }
            of_steps(&mut value.tip, &name.value, visit);
        }
        for Named { name, value } in &mut self.platforms {
            for frame in &mut value.frames {
                let place = format!("{}.{}", name.value, frame.name.value);
                of_steps(&mut frame.value, &place, visit);
            }
        }
        for Named { name, value } in &mut self.closures {
            if let Some(length) = &mut value.length {
                visit(length, Measure::Length, &name.value, false);
            }
        }
    }

    /// The numbers in its dimensions, in the order of the file. What a parameter measures is seen from where it is used.
    pub fn literals(&self) -> Vec<Literal> {
        let (mut literals, mut copy) = (Vec::new(), self.clone());
        let mut used: Vec<(String, Measure)> = Vec::new();
        copy.dimensions(&mut |entry, measure, place, in_vector| {
            if measure != Measure::Open {
                let names = entry.expression.names();
                used.extend(names.map(|(name, _)| (name.clone(), measure)));
            }
            of_sum(&mut entry.expression, &mut |number| {
                let (written, unit) = match number.node {
                    Node::Quantity(written, unit) => (written, Some(unit)),
                    Node::Number(written) => (written, None),
                    _ => return,
                };
                literals.push(Literal {
                    written,
                    unit,
                    measure,
                    place: place.to_owned(),
                    in_vector,
                });
            });
        });
        for literal in literals.iter_mut().filter(|of| of.measure == Measure::Open) {
            let of_unit = literal.unit.map(Unit::measure);
            let of_use = used.iter().find(|(name, _)| *name == literal.place);
            let found = of_unit.or(of_use.map(|(_, measure)| *measure));
            literal.measure = found.unwrap_or(Measure::Open);
        }
        literals
    }

    /// The file with other expressions in place of its literals.
    fn replaced(&self, mut replacement: impl FnMut(usize) -> Option<Expression>) -> Description {
        let (mut changed, mut number) = (self.clone(), 0);
        changed.dimensions(&mut |entry, _, _, _| {
            of_sum(&mut entry.expression, &mut |literal| {
                if let Some(other) = replacement(number) {
                    *literal = other.relocate(&|_| literal.span.clone());
                }
                number += 1;
            });
        });
        changed
    }

    /// Tables made anew where it was made from joint coordinates.
    fn made_anew(self) -> Result<Description, Vec<Problem>> {
        match self.coordinates {
            Some(coordinates) => coordinates.axes.tables(),
            None => Ok(self),
        }
    }

    /// The file with other values of some literals, by their places in [`literals`](Self::literals), in m or rad or
    /// without unit.
    ///
    /// # Errors
    /// If no tables can be made of joint coordinates.
    pub fn with_literals(&self, values: &[(usize, f64)]) -> Result<Description, Vec<Problem>> {
        let literals = self.literals();
        let value = |i: usize| values.iter().find(|(of, _)| *of == i);
        let changed = self.replaced(|i| value(i).map(|(_, value)| literals[i].with_value(*value)));
        changed.made_anew()
    }

    /// The file with parameters in place of some literals, by their places, and the names of these parameters.
    ///
    /// # Errors
    /// If no tables can be made of joint coordinates.
    pub fn with_named_literals(
        &self,
        places: &[usize],
    ) -> Result<(Description, Vec<String>), Vec<Problem>> {
        let literals = self.literals();
        let mut taken: Vec<String> = names_of(&self.parameters).map(str::to_owned).collect();
        taken.extend(names_of(&self.joints).map(str::to_owned));
        if let Some(coordinates) = &self.coordinates {
            taken.extend(names_of(&coordinates.axes.joints).map(str::to_owned));
        }
        let names: Vec<String> = places
            .iter()
            .map(|place| {
                let wanted = format!("number{place}");
                first_free(&wanted, |name| taken.iter().all(|of| of != name))
            })
            .collect();
        let name = |i: usize| {
            places
                .iter()
                .position(|of| *of == i)
                .map(|k| names[k].clone())
        };
        let mut changed = self.replaced(|i| name(i).map(Expression::name));
        let parameters = match &mut changed.coordinates {
            Some(coordinates) => &mut coordinates.axes.parameters,
            None => &mut changed.parameters,
        };
        for (&place, name) in places.iter().zip(&names) {
            let Literal { written, unit, .. } = literals[place];
            let node = unit.map_or(Node::Number(written), |unit| Node::Quantity(written, unit));
            let entry = Entry {
                expression: node.at(0..0),
                ..zero()
            };
            parameters.push(Named::new(name.clone(), entry));
        }
        Ok((changed.made_anew()?, names))
    }

    /// The file with numbers that may be off by so much, a length as in the file; `None` if it is no positive length.
    pub fn with_tolerance(mut self, length: &str) -> Option<Description> {
        let expression = Expression::parse(length).ok()?;
        let is_length = expression.check_measure(Measure::Length, &|_| Measure::Open);
        is_length.ok()?;
        expression.fixed_value().filter(|value| *value > 0.0)?;
        let entry = Entry::from(expression);
        if let Some(coordinates) = &mut self.coordinates {
            coordinates.axes.tolerance = Some(entry.clone());
        }
        self.tolerance = Some(entry);
        Some(self)
    }
}
