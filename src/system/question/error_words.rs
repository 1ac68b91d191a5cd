//! Words for rates, forces and loads that cannot be given.

use std::error::Error;
use std::fmt::{self, Display, Formatter};

use super::{DriveError, ForceError};
use crate::description::listed;

/// `; did you mean …?`, or `; what there is`.
fn instead(
    f: &mut Formatter,
    suggestion: &Option<String>,
    known: &[String],
    are: &str,
) -> fmt::Result {
    match (suggestion, known) {
        (Some(meant), _) => write!(f, "; did you mean `{meant}`?"),
        (None, []) => Ok(()),
        (None, known) => write!(f, "; {are} {}", listed(known)),
    }
}

impl DriveError {
    /// What is wrong, without what to do about it.
    pub fn title(&self) -> String {
        match self {
            DriveError::Question(error) => error.title(),
            DriveError::UnknownName { name, .. } => {
                format!("`{name}` is neither a joint nor a coordinate of a platform")
            }
            DriveError::NotHeld { name, .. } => {
                format!("`{name}` is not held: its rate follows from the others")
            }
            DriveError::Whole { platform, .. } => {
                format!("`{platform}` is a platform: give the rate of one of its coordinates")
            }
            DriveError::NotTurned { platform } => format!(
                "an angular velocity of `{platform}` can be given only if its whole orientation is held"
            ),
            DriveError::Mixed { platform } => format!(
                "the rotation of `{platform}` is given twice, by its angles and about the axes of ground"
            ),
            DriveError::Structure => "nothing can be driven: the mechanism is a structure".into(),
        }
    }
}

impl Display for DriveError {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        if let DriveError::Question(error) = self {
            return error.fmt(f);
        }
        f.write_str(&self.title())?;
        match self {
            DriveError::UnknownName {
                suggestion, held, ..
            } => instead(f, suggestion, held, "held:"),
            DriveError::NotHeld { held, .. } | DriveError::Whole { held, .. } => {
                instead(f, &None, held, "held:")
            }
            _ => Ok(()),
        }
    }
}

impl Error for DriveError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            DriveError::Question(error) => error.source(),
            _ => None,
        }
    }
}

impl ForceError {
    /// What is wrong, without what to do about it.
    pub fn title(&self) -> String {
        match self {
            ForceError::Value(error) => error.title(),
            ForceError::UnknownFrame { name } => format!("there is no frame `{name}`"),
            ForceError::OnGround { name, .. } => {
                format!("`{name}` is fixed to the ground and cannot be loaded")
            }
            ForceError::Components { given } => format!(
                "a wrench has three components (N) or six (N and N·m), but {given} were given"
            ),
            ForceError::UnknownJoint { name, .. } => format!("`{name}` is not a joint"),
            ForceError::Platform { name, .. } => {
                format!("`{name}` is not a joint: a platform is loaded by a wrench")
            }
        }
    }
}

impl Display for ForceError {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        if let ForceError::Value(error) = self {
            return error.fmt(f);
        }
        f.write_str(&self.title())?;
        match self {
            ForceError::OnGround { instead, .. } if !instead.is_empty() => {
                write!(f, "; load a body that moves, such as {}", listed(instead))
            }
            ForceError::UnknownJoint {
                suggestion, known, ..
            } => instead(f, suggestion, known, "the joints are"),
            _ => Ok(()),
        }
    }
}

impl Error for ForceError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            ForceError::Value(error) => error.source(),
            _ => None,
        }
    }
}
