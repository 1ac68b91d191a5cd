//! Remarks on what a file of another program cannot express, or expresses differently.

use thiserror::Error;

use crate::description::{ClosureKind, count as count_of, joined, quoted};

/// A remark on a file that was read or written, in one line.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)]
pub enum Remark {
    /// URDF has trees only.
    #[error(
        "closure `{closure}` is left out: URDF cannot express the closure of `{}` and `{}` ({})",
        frames[0], frames[1], kind.word()
    )]
    ClosureLost {
        closure: String,
        kind: ClosureKind,
        frames: [String; 2],
    },
    #[error("coupling `{closure}` is left out: this format has no such relation between joints")]
    CouplingLost { closure: String },
    /// A joint variable that only changes the length of lost closures.
    #[error(
        "joint `{joint}` is left out: it is the length of {}",
        quoted(closures)
    )]
    LengthLost {
        joint: String,
        closures: Vec<String>,
    },
    #[error(
        "platform `{platform}` is attached by a floating joint, which many URDF readers ignore"
    )]
    Floating { platform: String },
    #[error("platform `{platform}` is fixed to `{frame}` because of closure `{closure}`")]
    Fixed {
        platform: String,
        closure: String,
        frame: String,
    },
    /// Every joint starts at 0 in a URDF file; the home values of these joints are not 0.
    #[error(
        "URDF has no home configuration: the home {} of {} {} lost, and readers start at 0",
        if joints.len() == 1 { "value" } else { "values" },
        quoted(joints),
        if joints.len() == 1 { "is" } else { "are" }
    )]
    HomeLost { joints: Vec<String> },
    #[error(
        "joint `{joint}` is helical: {} for the second part of its motion",
        follow(followers)
    )]
    Helical {
        joint: String,
        followers: Vec<String>,
    },
    /// A variable that occurs several times or with a factor.
    #[error("joint `{joint}` moves several rows: {}", follow(followers))]
    Shared {
        joint: String,
        followers: Vec<String>,
    },
    #[error(
        "no row has joint `{joint}` with factor 1: it moves an added body `{body}` on the ground"
    )]
    Carried { joint: String, body: String },
    #[error("joint `{joint}` is left out: it moves nothing")]
    Unused { joint: String },
    /// A prismatic joint of URDF must have limits; the limit is in m.
    #[error(
        "URDF requires limits for prismatic joints: {} may slide by {limit} m in both directions",
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
    #[error("closure `{closure}` has the distance 0 m: it is written as a common point")]
    ZeroDistance { closure: String },
    #[error("masses, inertias, efforts and shapes are placeholders: the mechanism file has none")]
    MassesInvented,
    /// Elements of a file that linkwork does not use.
    #[error("{} ignored: `{element}`", count_of(*count, "element"))]
    Ignored { element: String, count: usize },
    /// The rule that decided which joints are actuated.
    #[error("{0}")]
    Driven(&'static str),
    #[error(
        "links `{}` and `{}` look like the two halves of a cut joint: close it in a file of loops",
        _0[0], _0[1]
    )]
    Halves([String; 2]),
    #[error("closure `{name}` is left out: it joins two frames of one body")]
    WithinBody { name: String },
    #[error("constraint `{name}` is left out: it is not active")]
    Inactive { name: String },
    #[error("joint `{joint}` stands at {value} {unit}: it is coupled to nothing that moves")]
    Stands {
        joint: String,
        value: f64,
        unit: &'static str,
    },
    #[error("the limits of joint `{joint}` are left out: it follows several joints")]
    LimitsLost { joint: String },
    #[error("the limits of joint `{joint}` are left out: it closes a loop")]
    ClosingLimits { joint: String },
    #[error("the limit of joint `{joint}` is left out: it has one only")]
    OneSided { joint: String },
    #[error("{} on the ground: no joint leads from the world to {}", stand(links), if links.len() == 1 { "it" } else { "them" })]
    Grounded { links: Vec<String> },
    #[error(
        "{}: without axes a universal joint turns about x and y of its frame, without the second about z, or x across that",
        named_few(joints, ["lacks an axis", "lack axes"])
    )]
    AxisLacks { joints: Vec<String> },
    /// Joints of SDF are at 0 where they are written.
    #[error("joints count from the configuration that is written: there all are at 0")]
    CountedFromHome,
    /// Joints with motors that other motors move already.
    #[error(
        "{} passive: with more motors than freedoms, the other motors decide where {}",
        named_few(joints, ["is", "are"]),
        if joints.len() == 1 { "it is" } else { "they are" }
    )]
    Redundant { joints: Vec<String> },
    /// Bodies that only keep two points apart.
    #[error(
        "{} between two balls: {} as the {} of the balls",
        named_few(names, ["is a rod", "are rods"]),
        if names.len() == 1 { "it is read" } else { "they are read" },
        if names.len() == 1 { "distance" } else { "distances" }
    )]
    Rods { names: Vec<String> },
    /// Points of plane loops that lie apart along their pins, by at most so much in m.
    #[error(
        "{} points up to {} mm apart along the hinges: the links lie beside each other on one pin",
        named_few(names, ["has", "have"]),
        (most * 1e5).round() / 100.0
    )]
    Beside { names: Vec<String>, most: f64 },
    /// Home values that were moved inside the limits.
    #[error(
        "the home {} of {} outside the limits: moved inside",
        if joints.len() == 1 { "value" } else { "values" },
        named_few(joints, ["is", "are"])
    )]
    Moved { joints: Vec<String> },
    /// Names that a mechanism file cannot use, with those in their place.
    #[error(
        "{}: a name is given once, names of frames have no dots, names of joints only letters, digits, `_` and single blanks",
        renamed(noun, names)
    )]
    Renamed {
        noun: &'static str,
        names: Vec<[String; 2]>,
    },
    /// The origin of the home values.
    #[error("{0}")]
    Home(String),
}

impl Remark {
    /// True if a part of the mechanism is missing in the file.
    pub fn is_loss(&self) -> bool {
        matches!(
            self,
            Self::ClosureLost { .. }
                | Self::CouplingLost { .. }
                | Self::LengthLost { .. }
                | Self::Floating { .. }
                | Self::Unused { .. }
                | Self::HomeLost { .. }
                | Self::Halves(_)
        )
    }
}

/// Names of a few, how many more there are, and the verb.
fn named_few(names: &[String], verbs: [&str; 2]) -> String {
    const MOST: usize = 5;
    let more = names.len().saturating_sub(MOST);
    let verb = verbs[usize::from(names.len() > 1)];
    match more {
        0 => format!("{} {verb}", quoted(names)),
        _ => {
            let first: Vec<String> = names[..MOST]
                .iter()
                .map(|name| format!("`{name}`"))
                .collect();
            format!("{} and {more} more {verb}", first.join(", "))
        }
    }
}

fn renamed(noun: &str, names: &[[String; 2]]) -> String {
    const MOST: usize = 3;
    let each = names.iter().take(MOST);
    let each: Vec<String> = each
        .map(|[from, to]| format!("`{from}` is renamed `{to}`"))
        .collect();
    match names.len() {
        0..=MOST => format!("{noun} {}", joined(&each, "and")),
        many => format!("{noun} {}, and {} more alike", each.join(", "), many - MOST),
    }
}

fn stand(links: &[String]) -> String {
    let noun = ["link", "links"][usize::from(links.len() > 1)];
    format!("{noun} {}", named_few(links, ["stands", "stand"]))
}

fn follow(followers: &[String]) -> String {
    let verb = ["follows", "follow"][usize::from(followers.len() > 1)];
    format!("{} {verb} it", quoted(followers))
}
