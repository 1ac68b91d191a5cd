//! Conversion of a mechanism to the other convention, or to another cut joint.
//!
//! Nothing is evaluated: rows are moved and turned round as they are written, so that names and
//! expressions stay. Only home values of new variables are numbers.

mod cognates;
mod convention;
mod coordinates;
mod cut;
mod references;

use serde::{Deserialize, Serialize};

use crate::description::{Convention, Description, Problem, mechanism_text};
use crate::mechanism::Mechanism;

pub use cognates::{CognateError, cognates};
pub use coordinates::to_axes;
pub use cut::{CutError, possible_cuts};

/// Changes to be made.
#[derive(Clone, Debug, Default)]
pub struct ConvertSettings {
    /// The convention of all chains; `None` leaves each as it is.
    pub convention: Option<Convention>,
    /// The joint at which the mechanism is to be broken instead.
    pub cut: Option<String>,
}

/// A converted mechanism file, with its differences.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Conversion {
    /// The file, serialised as its text.
    #[serde(rename = "file", with = "mechanism_text")]
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub description: Description,
    /// Frames renamed, and information lost.
    pub notes: Vec<ConversionNote>,
}

/// A difference of a converted file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "note", rename_all = "snake_case")]
pub enum ConversionNote {
    /// A frame is called otherwise now.
    Renamed {
        /// Its name before.
        from: String,
        /// Its name now.
        to: String,
    },
    /// A closed form names the variable of the joint that is a closure now, and is left out.
    Dropped {
        /// The closed form.
        closed_form: String,
        /// The variable.
        joint: String,
    },
    /// A driven joint has no variable any more.
    DriveLost {
        /// The joint.
        joint: String,
    },
    /// A joint with limits has no variable any more.
    LimitsLost {
        /// The joint.
        joint: String,
    },
    /// A coupler point belongs to another linkage that traces the same curve.
    CouplerPoint {
        /// The point of the linkage that was given.
        point: String,
        /// The corresponding point of the other.
        now: String,
    },
    /// Variables that take the place of a closure.
    Variables {
        /// The closure.
        closure: String,
        /// The variables.
        joints: Vec<String>,
    },
}

/// Reasons for which a mechanism is not converted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ConvertError {
    /// It cannot be broken there.
    #[error(transparent)]
    Cut(#[from] CutError),
    /// A variable that moves no joint of its own.
    #[error(
        "the variable `{0}` never occurs alone with the factor 1 or -1, so that no joint can have it as its own"
    )]
    NotAlone(String),
    /// The result is not a mechanism.
    #[error("the converted file is not a mechanism: {}", titles(.0))]
    Wrong(Vec<Problem>),
}

fn titles(problems: &[Problem]) -> String {
    let titles: Vec<String> = problems.iter().map(|p| p.kind.title()).collect();
    titles.join("; ")
}

/// Writes the mechanism in another convention, or cut at another joint.
///
/// # Errors
/// If the cut asked for is not possible.
pub fn convert(
    mechanism: &Mechanism,
    description: &Description,
    settings: &ConvertSettings,
) -> Result<Conversion, ConvertError> {
    let mut description = description.clone();
    if settings.cut.is_some() || settings.convention.is_some() {
        references::number_links(&mut description);
    }
    let mut conversion = Conversion {
        description,
        notes: Vec::new(),
    };
    if let Some(joint) = &settings.cut {
        conversion = cut::cut(mechanism, &conversion.description, joint)?;
    }
    if let Some(convention) = settings.convention {
        convention::convert(&mut conversion, convention);
    }
    // frames that came with a cut had no name before
    conversion.notes.retain(|note| match note {
        ConversionNote::Renamed { from, .. } => mechanism.frame(from).is_some(),
        _ => true,
    });
    Mechanism::new(&conversion.description).map_err(ConvertError::Wrong)?;
    Ok(conversion)
}
