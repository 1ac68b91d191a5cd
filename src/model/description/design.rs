//! The design file: what a mechanism shall do, and which of its dimensions may vary.

use std::ops::Range;

use super::{Entry, Named, Spanned};
use crate::algebra::{Expression, ParseError};

/// Targets and requirements of a mechanism, and its numbers that may vary. Everything is in the order of the file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DesignDescription {
    /// Name of the design.
    pub name: Spanned<String>,
    /// The mechanism file, from the folder of the design file.
    pub mechanism: Spanned<String>,
    /// The parameters that vary, with the values they may have. A name that the mechanism file does not have is a further unknown,
    /// for expressions of the positions.
    pub vary: Vec<Named<Varied>>,
    /// The positions: values of quantities, or two or three coordinates of a point in ground.
    pub positions: Vec<Vec<Named<Vec<Entry>>>>,
    /// Weights of targets by their names in the positions, one for all positions or one for each.
    pub weights: Vec<Named<Vec<Entry>>>,
    /// By how much targets may be missed, one for all positions or one for each. The weight of a target is divided by it.
    pub tolerances: Vec<Named<Vec<Entry>>>,
    /// Quantities with ranges that span a box: its corners, the middles of its sides and its middle are positions after the others.
    pub contains: Vec<Named<[Entry; 2]>>,
    /// Inputs with the ranges through which they shall move.
    pub motion: Vec<Named<[Entry; 2]>>,
    /// Quantities with the least values that they may have during the motion.
    pub at_least: Vec<Named<Entry>>,
    /// Quantities with the greatest values that they may have during the motion.
    pub at_most: Vec<Named<Entry>>,
    /// Outputs by which quantities such as the condition number are taken: joints, coordinates of points, frames.
    pub outputs: Vec<Spanned<String>>,
    /// Figures that shall be as small or as great as possible: one, or two of which none can be had without the other's loss.
    pub goals: Vec<DesignGoal>,
    /// True if positions without given inputs may be passed in any order.
    pub any_order: bool,
}

/// The values that a number may have.
#[derive(Debug, Clone, PartialEq)]
pub enum Varied {
    /// All of a range.
    Range([Entry; 2]),
    /// Those of a list.
    OneOf(Vec<Entry>),
    /// That of an expression of other numbers.
    Equal(Entry),
}

impl Varied {
    /// The ends of the range, the values of the list, or the expression.
    pub fn entries(&self) -> &[Entry] {
        match self {
            Self::Range(ends) => ends,
            Self::OneOf(values) => values,
            Self::Equal(value) => std::slice::from_ref(value),
        }
    }
}

/// A figure of a quantity over the motion, such as `max(force:theta1)`, that shall be as small or as great as possible.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignGoal {
    /// The figure.
    pub figure: Spanned<String>,
    /// True if it shall be great.
    pub greatest: bool,
}

impl DesignGoal {
    /// −1 for a figure that shall be great, else 1.
    pub fn sign(&self) -> f64 {
        if self.greatest { -1.0 } else { 1.0 }
    }
}

/// Part of a design file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DesignPart {
    /// The file as a whole.
    Whole,
    /// A number that varies.
    Vary(usize),
    /// A quantity of a position.
    Position(usize, usize),
    /// A weight.
    Weight(usize),
    /// A tolerance.
    Tolerance(usize),
    /// A range of the motion.
    Motion(usize),
    /// A least value.
    AtLeast(usize),
    /// A greatest value.
    AtMost(usize),
    /// An output.
    Output(usize),
    /// The figure to be small or great.
    Goal(usize),
}

impl DesignDescription {
    /// The place of a part: its name, or with `value` what it is given.
    pub fn span(&self, part: DesignPart, value: bool) -> Range<usize> {
        let of = |name: &Spanned<String>, entries: &[Entry]| match entries {
            [first, .., last] if value => first.span.start..last.span.end,
            [one] if value => one.span.clone(),
            _ => name.span.clone(),
        };
        match part {
            DesignPart::Whole => 0..1,
            DesignPart::Output(i) => self.outputs[i].span.clone(),
            DesignPart::Goal(i) => self.goals[i].figure.span.clone(),
            DesignPart::Vary(i) => of(&self.vary[i].name, self.vary[i].value.entries()),
            DesignPart::Position(k, i) => match self.positions.get(k) {
                Some(position) => of(&position[i].name, &position[i].value),
                // of the box, whose last side comes first
                None => {
                    let side = &self.contains[self.contains.len() - 1 - i];
                    of(&side.name, &side.value)
                }
            },
            DesignPart::Weight(i) => of(&self.weights[i].name, &self.weights[i].value),
            DesignPart::Tolerance(i) => of(&self.tolerances[i].name, &self.tolerances[i].value),
            DesignPart::Motion(i) => of(&self.motion[i].name, &self.motion[i].value),
            DesignPart::AtLeast(i) => of(
                &self.at_least[i].name,
                std::slice::from_ref(&self.at_least[i].value),
            ),
            DesignPart::AtMost(i) => of(
                &self.at_most[i].name,
                std::slice::from_ref(&self.at_most[i].value),
            ),
        }
    }
}

impl DesignDescription {
    /// With the positions of the box among the positions: line by line, each line in the sense against that of the last.
    #[must_use]
    pub fn with_box(mut self) -> Self {
        const PER_SIDE: usize = 3;
        let sides = std::mem::take(&mut self.contains);
        if sides.is_empty() {
            return self;
        }
        // what does not change along a side is asked for once
        let counts = sides.iter().map(|side| {
            let [from, to] = side.value.each_ref().map(|of| of.expression.to_string());
            if from == to { 1 } else { PER_SIDE }
        });
        let counts: Vec<usize> = counts.collect();
        for node in 0..counts.iter().product() {
            let (mut rest, mut back) = (node, false);
            let mut position = Vec::new();
            // the last side is the slowest
            let mut places: Vec<usize> = Vec::new();
            for count in &counts {
                places.push(rest % count);
                rest /= count;
            }
            for ((side, count), place) in sides.iter().zip(&counts).zip(&places).rev() {
                let place = if back { count - 1 - place } else { *place };
                back ^= place % 2 == 1;
                let part = place as f64 / (PER_SIDE - 1) as f64;
                let [from, to] = &side.value;
                let text = format!(
                    "({})*{} + ({})*{part}",
                    from.expression,
                    1.0 - part,
                    to.expression
                );
                let value = Entry::read(&text).unwrap_or_else(|_| from.clone());
                position.push(Named {
                    name: side.name.clone(),
                    value: vec![value],
                });
            }
            self.positions.push(position);
        }
        self
    }
}

impl Entry {
    /// The entry of a text, as in a file.
    ///
    /// # Errors
    /// If it is no expression.
    pub fn read(text: &str) -> Result<Self, ParseError> {
        Expression::parse(text).map(Entry::from)
    }
}
