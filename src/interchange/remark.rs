//! What a file of another program cannot say, or says another way.

use std::fmt::{self, Display, Formatter};

use crate::description::{ClosureKind, quoted};

/// What is worth knowing about a file that was read or written.
#[derive(Clone, Debug, PartialEq)]
pub enum Remark {
    /// URDF has trees only.
    ClosureLost {
        /// The closure.
        closure: String,
        /// Its kind.
        kind: ClosureKind,
        /// The frames it joins.
        frames: [String; 2],
    },
    /// A joint variable that only changes the length of closures which are lost.
    LengthLost {
        /// The joint.
        joint: String,
        /// The closures.
        closures: Vec<String>,
    },
    /// A platform hangs on the ground by a floating joint.
    Floating {
        /// The platform.
        platform: String,
    },
    /// A platform is written as fixed to the frame that a rigid closure joins it to.
    Fixed {
        /// The platform.
        platform: String,
        /// The closure.
        closure: String,
        /// The frame.
        frame: String,
    },
    /// Every joint is at 0 where a URDF file stands.
    HomeLost {
        /// The joints that are not at 0 at home.
        joints: Vec<String>,
    },
    /// A joint variable that turns and slides.
    Helical {
        /// The joint.
        joint: String,
        /// The joint that follows it.
        followers: Vec<String>,
    },
    /// A variable that stands in several places or with a factor.
    Shared {
        /// The joint.
        joint: String,
        /// The joints that follow it.
        followers: Vec<String>,
    },
    /// A variable that no row moves by alone hangs on a body of its own.
    Carried {
        /// The joint.
        joint: String,
        /// The body.
        body: String,
    },
    /// A joint variable that moves nothing.
    Unused {
        /// The joint.
        joint: String,
    },
    /// A sliding joint of URDF must have limits.
    LimitsInvented {
        /// The joints.
        joints: Vec<String>,
        /// The limit in m to both sides.
        limit: f64,
    },
    /// A closure that is written as joints and a weld.
    Welded {
        /// The closure.
        closure: String,
        /// Its kind.
        kind: ClosureKind,
        /// The joints.
        joints: Vec<String>,
    },
    /// A distance of zero is a point.
    ZeroDistance {
        /// The closure.
        closure: String,
    },
    /// Masses and the like, which the mechanism does not have.
    MassesInvented,
    /// Elements of a file that linkwork has no use for.
    Ignored {
        /// Their name.
        element: String,
        /// How many there are.
        count: usize,
    },
    /// How it was decided which joints are actuated.
    Driven(&'static str),
    /// Two links that look like the two sides of a broken joint.
    Halves([String; 2]),
    /// A loop that joins two frames of one body.
    WithinBody {
        /// Its name.
        name: String,
    },
    /// A constraint of a file that is not active.
    Inactive {
        /// Its name.
        name: String,
    },
    /// A name that a mechanism file cannot use.
    Renamed {
        /// What bears it.
        noun: &'static str,
        /// The name in the file.
        from: String,
        /// The name given instead.
        to: String,
    },
    /// Where the home values come from.
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

impl Display for Remark {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Remark::ClosureLost {
                closure,
                kind,
                frames: [a, b],
            } => write!(
                f,
                "closure `{closure}` is left out: URDF cannot say that `{a}` and `{b}` are joined ({})",
                kind.word()
            ),
            Remark::LengthLost { joint, closures } => write!(
                f,
                "joint `{joint}` is left out: it is the length of {}",
                quoted(closures)
            ),
            Remark::Floating { platform } => write!(
                f,
                "platform `{platform}` hangs on a floating joint, which many readers of URDF ignore"
            ),
            Remark::HomeLost { joints } => write!(
                f,
                "URDF has no home configuration: the home {} of {} {} lost, and readers start with 0",
                if joints.len() == 1 { "value" } else { "values" },
                quoted(joints),
                if joints.len() == 1 { "is" } else { "are" }
            ),
            Remark::Fixed {
                platform,
                closure,
                frame,
            } => write!(
                f,
                "platform `{platform}` is fixed to `{frame}`, as closure `{closure}` says"
            ),
            Remark::Helical { joint, followers } => write!(
                f,
                "joint `{joint}` turns and slides: {} for the rest of its motion",
                follow(followers)
            ),
            Remark::Shared { joint, followers } => {
                write!(
                    f,
                    "joint `{joint}` moves several rows: {}",
                    follow(followers)
                )
            }
            Remark::Carried { joint, body } => write!(
                f,
                "joint `{joint}` moves no row by its own value: it is the joint of a body `{body}` on the ground"
            ),
            Remark::Unused { joint } => write!(f, "joint `{joint}` is left out: it moves nothing"),
            Remark::LimitsInvented { joints, limit } => write!(
                f,
                "URDF asks for limits of sliding joints: {} may slide by {limit} m to both sides",
                quoted(joints)
            ),
            Remark::Welded {
                closure,
                kind,
                joints,
            } => write!(
                f,
                "closure `{closure}` ({}) is written as {} and a weld",
                kind.word(),
                quoted(joints)
            ),
            Remark::ZeroDistance { closure } => write!(
                f,
                "closure `{closure}` is a distance of 0 m: it is written as a common point"
            ),
            Remark::MassesInvented => f.write_str(
                "masses, inertias, efforts and shapes are made up: the mechanism file has none",
            ),
            Remark::Ignored { element, count } => {
                write!(
                    f,
                    "{} ignored: `{element}`",
                    crate::description::count(*count, "element")
                )
            }
            Remark::Driven(rule) => f.write_str(rule),
            Remark::Halves([a, b]) => write!(
                f,
                "links `{a}` and `{b}` look like the two sides of a broken joint: close it with --loops"
            ),
            Remark::WithinBody { name } => {
                write!(
                    f,
                    "closure `{name}` is left out: it joins two frames of one body"
                )
            }
            Remark::Inactive { name } => {
                write!(f, "constraint `{name}` is left out: it is not active")
            }
            Remark::Renamed { noun, from, to } => {
                write!(
                    f,
                    "{noun} `{from}` is called `{to}`: names of frames have no dots, those of joints only letters, digits and `_`"
                )
            }
            Remark::Home(text) => f.write_str(text),
        }
    }
}

fn follow(followers: &[String]) -> String {
    let verb = if followers.len() == 1 {
        "follows"
    } else {
        "follow"
    };
    format!("{} {verb} it", quoted(followers))
}
