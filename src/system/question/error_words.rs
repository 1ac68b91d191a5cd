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

impl Display for DriveError {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            DriveError::Question(error) => error.fmt(f),
            DriveError::UnknownName {
                name,
                suggestion,
                held,
            } => {
                write!(
                    f,
                    "`{name}` is neither a joint nor a coordinate of a platform"
                )?;
                instead(f, suggestion, held, "held:")
            }
            DriveError::NotHeld { name, held } => {
                write!(f, "`{name}` is not held: its rate follows from the others")?;
                instead(f, &None, held, "held:")
            }
            DriveError::Whole { platform, held } => {
                write!(
                    f,
                    "`{platform}` is a platform: give the rate of one of its coordinates"
                )?;
                instead(f, &None, held, "held:")
            }
            DriveError::NotTurned { platform } => write!(
                f,
                "an angular velocity of `{platform}` can be given only if its whole orientation is held"
            ),
            DriveError::Mixed { platform } => write!(
                f,
                "the rotation of `{platform}` is given twice, by its angles and about the axes of ground"
            ),
            DriveError::Structure => {
                f.write_str("nothing can be driven: the mechanism is a structure")
            }
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

impl Display for ForceError {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            ForceError::Value(error) => error.fmt(f),
            ForceError::UnknownFrame { name } => write!(f, "there is no frame `{name}`"),
            ForceError::OnGround { name, instead } => {
                write!(f, "`{name}` is fixed to the ground and cannot be loaded")?;
                match &instead[..] {
                    [] => Ok(()),
                    moving => write!(f, "; load a body that moves, such as {}", listed(moving)),
                }
            }
            ForceError::Components { given } => write!(
                f,
                "a wrench has three components (N) or six (N and N·m), but {given} were given"
            ),
            ForceError::UnknownJoint {
                name,
                suggestion,
                known,
            } => {
                write!(f, "`{name}` is not a joint")?;
                instead(f, suggestion, known, "the joints are")
            }
            ForceError::Platform { name, .. } => {
                write!(
                    f,
                    "`{name}` is not a joint: a platform is loaded by a wrench"
                )
            }
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
