//! Data about numbers that were changed because they are rounded.

use serde::{Deserialize, Serialize};

/// The effect of the rounding of a file's numbers on its loops, where it has one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "rounding", rename_all = "snake_case")]
pub enum Rounding {
    /// The loops close within the rounding; the mechanism is the nearest linkage that closes exactly.
    Nearest(Rounded),
    /// The loops would move if numbers were changed by a little more than they were rounded by. The mechanism is as written.
    Undecided {
        /// The least change with which they would move, in parts of what each number is rounded by: the largest of all.
        change: f64,
    },
}

/// The changes by which loops close exactly.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Rounded {
    /// The largest gap over finite motions with the numbers of the file, in m.
    pub gap: f64,
    /// The largest angle there, in rad.
    pub gap_angle: f64,
    /// The numbers that were changed.
    pub changes: Vec<NumberChange>,
}

/// A number of the file that was changed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NumberChange {
    /// The part of the file in which it stands.
    pub place: String,
    /// Its value in the file, in m or rad or without unit.
    pub from: f64,
    /// The value with which the linkage closes.
    pub to: f64,
    /// True for a length (m); otherwise it is an angle (rad) or a part of a direction.
    pub is_length: bool,
}

impl Rounded {
    /// The largest change of lengths in m, and that of angles in rad; `None` where none was changed.
    pub fn largest(&self) -> [Option<f64>; 2] {
        [true, false].map(|lengths| {
            let of = self
                .changes
                .iter()
                .filter(|change| change.is_length == lengths);
            of.map(|change| (change.to - change.from).abs())
                .reduce(f64::max)
        })
    }
}
