//! Requests of a page.

use serde::{Deserialize, Serialize};

use super::state::State;

#[derive(Debug, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case")]
pub enum Request {
    /// Reads a mechanism file and assembles it.
    Load(LoadRequest),
    /// Moves held coordinates together, in rad or m.
    Move { to: Vec<(String, f64)> },
    /// Takes a point of a body or a rod, by its number in the scene, where it is in ground: what holds it.
    Grab {
        #[serde(flatten)]
        part: Grip,
        at: [f64; 3],
    },
    /// Pulls such a point to a place in ground, both seen along a direction.
    Pull {
        grip: Vec<Hold>,
        to: [f64; 3],
        #[serde(default)]
        sight: Option<[f64; 3]>,
    },
    /// Presses on a point, or on none any more.
    Press { load: Option<Press> },
    /// Reads quantities from now on: a list, or those of the file and the transmission angle if it is empty.
    Watch { quantities: String },
    /// The freedoms gained where a motion was stopped, or where the mechanism is.
    Gained,
    /// Holds these coordinates where they are, and no others.
    Hold { names: Vec<String> },
    /// Puts the mechanism into an assembled configuration.
    Go { at: State },
    /// The ways to go on from the singular configuration where the mechanism is or was stopped.
    Ways,
    /// The number of an expression, in rad, m or N.
    Number { text: String, measure: MeasureKind },
    /// Only shows a configuration, with the frames that have names if they are asked for.
    Show {
        at: State,
        #[serde(default)]
        frames: bool,
    },
    /// A picture as SVG: seen as the mechanism is seen best, or from azimuth and elevation in rad.
    Picture {
        #[serde(default)]
        from: Option<(f64, f64)>,
        #[serde(default)]
        labels: bool,
    },
    /// An answer of the command line, with the coordinates held where they are, or as in the file.
    Ask {
        what: Analysis,
        #[serde(default)]
        as_filed: bool,
    },
    /// Moves one coordinate over a range, or follows the whole curve.
    Sweep(SweepRequest),
    /// Lets the mechanism go where it is, under its loads.
    LetGo(LetGoRequest),
    /// Dimensions with which a point passes through places.
    Design(DesignRequest),
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MeasureKind {
    Angle,
    Length,
    Force,
    Time,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Grip {
    Body(usize),
    Rod(usize),
}

/// A point of a body, and its share in a place that bodies carry together.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Hold {
    pub body: usize,
    pub offset: [f64; 3],
    pub share: f64,
}

/// A force in N, in ground, at a point.
#[derive(Clone, Debug, Deserialize)]
pub struct Press {
    pub point: String,
    pub force: [f64; 3],
}

#[derive(Debug, Deserialize)]
pub struct LoadRequest {
    pub text: String,
    /// Parameters with other values.
    #[serde(default)]
    pub set: Vec<(String, String)>,
    /// The held coordinates; as in the file if not given.
    #[serde(default)]
    pub held: Option<Vec<String>>,
    /// An earlier configuration of the mechanism, so that it stays on its branch.
    #[serde(default)]
    pub near: Option<State>,
    #[serde(default)]
    pub load: Option<Press>,
    #[serde(default)]
    pub quantities: String,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Analysis {
    Solve,
    Assemblies,
    Mobility,
}

#[derive(Debug, Deserialize)]
pub struct SweepRequest {
    /// Name, from and to, in rad or m; without it the whole curve is followed.
    #[serde(default)]
    pub input: Option<(String, f64, f64)>,
    pub steps: usize,
    #[serde(default)]
    pub follow: bool,
    /// The time that it takes, in s.
    #[serde(default)]
    pub duration: Option<f64>,
    #[serde(default)]
    pub points: Vec<String>,
    #[serde(default)]
    pub report: Vec<String>,
}

#[derive(Debug, Deserialize)]
pub struct LetGoRequest {
    /// In s.
    pub duration: f64,
    pub rows: usize,
    /// Part of its speed with which a joint comes back from a limit; without it the motion ends there.
    #[serde(default)]
    pub restitution: Option<f64>,
    /// Goes on straight where branches of motion meet.
    #[serde(default)]
    pub through: bool,
    #[serde(default)]
    pub points: Vec<String>,
}

#[derive(Debug, Deserialize)]
pub struct DesignRequest {
    /// A mechanism file; without it the mechanism that is shown.
    #[serde(default)]
    pub text: Option<String>,
    /// The numbers that vary, with their ranges in m or rad; new names are further unknowns.
    pub vary: Vec<(String, f64, f64)>,
    /// The point, whose offsets may be such numbers.
    pub path: String,
    /// Places in ground, two or three coordinates each.
    pub points: Vec<Vec<f64>>,
    pub any_order: bool,
    /// Further fields of a design file: tolerances, bounds, goals, and values of numbers that vary.
    #[serde(default)]
    pub more: String,
    pub starts: usize,
    /// Starts from the dimensions of the file.
    pub own: bool,
    /// All solutions, where there are as many targets as unknowns.
    pub exact: bool,
}
