//! The file of the nearest linkage that closes exactly.

use serde::{Deserialize, Serialize};

use crate::description::Description;
use crate::mechanism::{Mechanism, Rounding};

/// A mechanism file whose loops close exactly, and what was changed to that end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Snapped {
    /// The mechanism's name.
    pub mechanism: String,
    /// The text of the file: tables or joint coordinates, as it was given.
    pub file: String,
    /// The effect of the rounding of the numbers; `None` if there is none.
    pub rounding: Option<Rounding>,
}

/// The file of a mechanism as it was [posed](super::posed).
pub fn snap(description: &Description, mechanism: &Mechanism) -> Snapped {
    // what is exact needs no tolerance
    let file = match description.coordinates.as_deref().cloned() {
        Some(mut coordinates) => {
            coordinates.axes.tolerance = None;
            coordinates.axes.to_ron()
        }
        None => {
            let tolerance = None;
            let description = description.clone();
            Description {
                tolerance,
                ..description
            }
            .to_ron()
        }
    };
    Snapped {
        mechanism: mechanism.name().to_owned(),
        file: file.unwrap_or_default(),
        rounding: mechanism.rounding().cloned(),
    }
}
