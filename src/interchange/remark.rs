//! What a file of another program cannot say, or says another way.

use thiserror::Error;

use crate::description::{ClosureKind, count as count_of, listed};

/// What is worth knowing about a file that was read or written: a warning, in one line.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)]
pub enum Remark {
    /// URDF has trees only.
    #[error(
        "closure `{closure}` is left out: URDF cannot say that `{}` and `{}` are joined ({})",
        frames[0], frames[1], kind.word()
    )]
    ClosureLost {
        closure: String,
        kind: ClosureKind,
        frames: [String; 2],
    },
    /// A joint variable that only changes the length of closures which are lost.
    #[error(
        "joint `{joint}` is left out: it is the length of {}",
        quoted(closures)
    )]
    LengthLost {
        joint: String,
        closures: Vec<String>,
    },
    #[error("platform `{platform}` hangs on a floating joint, which many readers of URDF ignore")]
    Floating { platform: String },
    #[error("platform `{platform}` is fixed to `{frame}`, as closure `{closure}` says")]
    Fixed {
        platform: String,
        closure: String,
        frame: String,
    },
    /// Every joint is at 0 in a URDF file; these are not at home.
    #[error(
        "URDF has no home configuration: the home {} of {} {} lost, and readers start with 0",
        if joints.len() == 1 { "value" } else { "values" },
        quoted(joints),
        if joints.len() == 1 { "is" } else { "are" }
    )]
    HomeLost { joints: Vec<String> },
    #[error(
        "joint `{joint}` turns and slides: {} for the rest of its motion",
        follow(followers)
    )]
    Helical {
        joint: String,
        followers: Vec<String>,
    },
    /// A variable that stands in several places or with a factor.
    #[error("joint `{joint}` moves several rows: {}", follow(followers))]
    Shared {
        joint: String,
        followers: Vec<String>,
    },
    #[error(
        "joint `{joint}` moves no row by its own value: it is the joint of a body `{body}` on the ground"
    )]
    Carried { joint: String, body: String },
    #[error("joint `{joint}` is left out: it moves nothing")]
    Unused { joint: String },
    /// A sliding joint of URDF must have limits; the limit is in m.
    #[error(
        "URDF asks for limits of sliding joints: {} may slide by {limit} m to both sides",
        quoted(joints)
    )]
    LimitsInvented { joints: Vec<String>, limit: f64 },
    #[error(
        "closure `{closure}` ({}) is written as {} and a weld",
        kind.word(),
        quoted(joints)
    )]
    Welded {
        closure: String,
        kind: ClosureKind,
        joints: Vec<String>,
    },
    #[error("closure `{closure}` is a distance of 0 m: it is written as a common point")]
    ZeroDistance { closure: String },
    #[error("masses, inertias, efforts and shapes are made up: the mechanism file has none")]
    MassesInvented,
    /// Elements of a file that linkwork has no use for.
    #[error("{} ignored: `{element}`", count_of(*count, "element"))]
    Ignored { element: String, count: usize },
    /// How it was decided which joints are actuated.
    #[error("{0}")]
    Driven(&'static str),
    #[error(
        "links `{}` and `{}` look like the two sides of a broken joint: close it with --loops",
        _0[0], _0[1]
    )]
    Halves([String; 2]),
    #[error("closure `{name}` is left out: it joins two frames of one body")]
    WithinBody { name: String },
    #[error("constraint `{name}` is left out: it is not active")]
    Inactive { name: String },
    /// A name that a mechanism file cannot use.
    #[error(
        "{noun} `{from}` is called `{to}`: names of frames have no dots, those of joints only letters, digits and `_`"
    )]
    Renamed {
        noun: &'static str,
        from: String,
        to: String,
    },
    /// Where the home values come from.
    #[error("{0}")]
    Home(String),
}

impl Remark {
    /// Whether something of the mechanism is missing in the file.
    pub fn is_loss(&self) -> bool {
        matches!(
            self,
            Self::ClosureLost { .. }
                | Self::LengthLost { .. }
                | Self::Floating { .. }
                | Self::Unused { .. }
                | Self::HomeLost { .. }
                | Self::Halves(_)
        )
    }
}

fn quoted(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    listed(&names)
}

fn follow(followers: &[String]) -> String {
    let verb = if followers.len() == 1 {
        "follows"
    } else {
        "follow"
    };
    format!("{} {verb} it", quoted(followers))
}
