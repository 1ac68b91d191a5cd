//! Answer of a design question.

use serde::{Deserialize, Serialize};

use super::exact::{Exact, NotAll};
use super::listed::Listed;
use crate::algebra::SiUnit;
use crate::system::{Bound, Target};

/// A target in one position.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Deviation {
    /// The position, from 1.
    pub position: usize,
    /// The quantity.
    pub quantity: String,
    /// Its unit.
    pub unit: SiUnit,
    /// By how much it differs from its target.
    pub deviation: f64,
    /// By how much it may differ.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
}

impl Deviation {
    /// Residual of a target.
    pub fn of(target: &Target, deviation: f64) -> Self {
        Deviation {
            position: target.configuration + 1,
            quantity: target.quantity.name.clone(),
            unit: target.quantity.unit,
            deviation,
            tolerance: None,
        }
    }

    /// True if it is missed by more than its tolerance.
    pub fn is_missed(&self) -> bool {
        let slack = 1.0 + crate::number::tolerance::SAME;
        self.tolerance
            .is_some_and(|most| self.deviation.abs() > most * slack)
    }
}

/// A reason for which a design does not do what it shall although it passes through its positions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "defect", rename_all = "snake_case")]
pub enum Defect {
    /// Positions that lie on another circuit than the first: it would have to be taken apart.
    Circuit {
        /// The positions, from 1.
        positions: Vec<usize>,
    },
    /// Positions that the driving joint does not reach without passing a dead position.
    Branch {
        /// The joint.
        driver: String,
        /// The positions, from 1.
        positions: Vec<usize>,
    },
    /// Positions are met in another order.
    Order {
        /// The order, from 1.
        order: Vec<usize>,
    },
    /// Positions lie beyond the limit of a joint.
    Limit {
        /// The joints.
        joints: Vec<String>,
        /// The positions, from 1.
        positions: Vec<usize>,
    },
    /// Positions of a mechanism with several freedoms at which the driven joints, moved straight from the position before, arrive
    /// in another assembly.
    Assembly {
        /// The positions, from 1.
        positions: Vec<usize>,
    },
    /// Branches cross on the way.
    Crossing,
    /// It does not move as far as it shall.
    Motion {
        /// The input.
        input: String,
        /// Its unit.
        unit: SiUnit,
        /// The value at which it stops.
        at: Option<f64>,
    },
    /// A quantity leaves its range during the motion.
    Condition {
        /// The quantity.
        quantity: String,
        /// Its unit.
        unit: SiUnit,
        /// The bound.
        bound: f64,
        /// The worst value; `None` if it is not determined everywhere.
        worst: Option<f64>,
        /// True for a bound from below.
        at_least: bool,
    },
    /// Targets are missed by more than their tolerances.
    Tolerance {
        /// Those targets.
        targets: Vec<Deviation>,
    },
    /// It could not be judged: a position is singular, or leaves more than one freedom.
    NotJudged,
}

/// The driving joint of a design along the whole curve of its mechanism.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Moves {
    /// It turns fully.
    Turns,
    /// It goes to and fro between dead positions or limits.
    Rocks,
    /// Not known, or there is none.
    #[default]
    Unknown,
}

/// A figure that is made as small or as great as possible.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Goal {
    /// The figure, as it was asked for.
    pub figure: String,
    /// Its unit.
    pub unit: SiUnit,
    /// True if it is made great.
    pub greatest: bool,
    /// Designs that meet the targets and were improved.
    pub improved: usize,
}

/// A design.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(
    feature = "schema",
    derive(schemars::JsonSchema),
    schemars(rename = "Design")
)]
pub struct FoundDesign {
    /// The values of the numbers, in the order of [`DesignReport::varied`].
    pub values: Vec<f64>,
    /// Σ (w·deviation)² over all targets.
    pub sum_of_squares: f64,
    /// The value of the figure that is improved; `None` without one, or if it is not determined everywhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub goal: Option<f64>,
    /// The value of the second figure, where there are two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub second_goal: Option<f64>,
    /// All targets.
    pub deviations: Vec<Deviation>,
    /// For each number the root of the sum of squares of the weighted changes of all targets, for a change of it by one unit.
    pub sensitivities: Vec<f64>,
    /// Defects; none for a design that does what it shall.
    pub defects: Vec<Defect>,
    /// Motion of the driving joint.
    pub driver: Moves,
    /// Number of starts that led to it.
    pub reached: usize,
    /// The two other four-bars with the same coupler curve (Roberts 1875), where the point of one passes through points.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cognates: Vec<Cognate>,
    /// The mechanism file.
    pub file: String,
}

/// Another four-bar whose coupler point has the same curve, in the first position, in ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Cognate {
    /// x and y of its pivots, in m.
    pub pivots: [[f64; 2]; 2],
    /// x and y of the pins of its coupler, in m.
    pub pins: [[f64; 2]; 2],
    /// Lengths of ground, first link, coupler and second link, in m.
    pub lengths: [f64; 4],
    /// Its number among the designs that are listed, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub design: Option<usize>,
}

/// The design nearest to targets that none meets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Nearest {
    /// The values of the numbers, in the order of [`DesignReport::varied`].
    pub values: Vec<f64>,
    /// Σ (w·deviation)² over all targets.
    pub sum_of_squares: f64,
    /// The target that is missed most.
    pub largest: Deviation,
    /// Number of random starts.
    pub starts: usize,
}

/// Answer of a design question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DesignReport {
    /// The mechanism's name.
    pub mechanism: String,
    /// The numbers that are sought.
    pub varied: Vec<Bound>,
    /// Number of positions.
    pub positions: usize,
    /// Number of targets beyond given inputs, and how many numbers they leave open at the best design.
    pub targets: usize,
    /// Number of targets and given values beyond that of unknowns: in general not all can be met.
    #[serde(default)]
    pub surplus: usize,
    /// Number of directions in which the numbers of the best design may change without any target changing.
    pub undetermined: usize,
    /// The joint that drives, by which branches are judged.
    pub driver: Option<String>,
    /// Different designs: first those without defects, each group by its sum of squares.
    pub designs: Vec<FoundDesign>,
    /// The figure that is improved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub goal: Option<Goal>,
    /// The figure that is improved beside it: no design is beaten in both.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub second_goal: Option<Goal>,
    /// Counts of the combinations of listed values that were tried, where numbers have lists.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub listed: Option<Listed>,
    /// True for a mechanism with several freedoms: designs are judged on straight moves of the driven joints from each position to
    /// the next.
    pub straight_moves: bool,
    /// Number of different designs found beyond those listed.
    pub more: usize,
    /// Counts of an exact synthesis, where there are as many targets as unknowns.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exact: Option<Exact>,
    /// The nearest design where no exact solution is real and in the ranges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nearest: Option<Nearest>,
    /// The reason for which not all exact solutions were sought where there are as many targets as unknowns.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub not_all: Option<NotAll>,
    /// Number of random starts from which a search ran.
    pub starts: usize,
    /// Number of random dimensions that could not be assembled in all positions.
    pub not_assembled: usize,
    /// Seed of the search.
    pub seed: u64,
    /// True if the work was stopped early.
    pub interrupted: bool,
}
