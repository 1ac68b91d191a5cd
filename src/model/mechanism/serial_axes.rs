//! Joint axes of a serial chain ↔ its Denavit–Hartenberg table, in both conventions.
//!
//! Consecutive axes k and k + 1 have the common normal N_k, with x_k along it. Both
//! conventions read the same four numbers off it (Craig 1986, §3.4; Denavit and Hartenberg 1955):
//!
//! - a_k, the length of N_k, not negative, and α_k, the angle from z_k to z_{k+1} about x_k;
//! - d_k along axis k from N_{k−1} to N_k, and θ_k, the angle from x_{k−1} to x_k about z_k.
//!
//! The modified row k is (α_{k−1}, a_{k−1}, d_k, θ_k), the standard row k is (θ_k, d_k, a_k, α_k).
//! z_k points along the given direction of axis k, so a joint's variable keeps its sense.
//!
//! If the axes leave a choice, the entry concerned becomes zero at the variable's zero:
//!
//! | axes k, k + 1 | choice |
//! |---|---|
//! | skew | none |
//! | intersecting | x_k along z_k × z_{k+1} or against it: θ_k within ±90°, at 90° along it |
//! | parallel, anti-parallel | place of N_k along them: d_k = 0 |
//! | collinear | x_k and its place: θ_k = 0, d_k = 0 |
//!
//! A prismatic axis has a direction only; `prismatic.rs` says where it is put. The first link is
//! (α₀, a₀) = (0, 0) unless a base frame is given from which another one leads to axis 1 (modified
//! convention); the last is (α_n, a_n) = (0, 0) unless a tool frame is given to which another one
//! leads (standard convention). The remainder goes to `base` and `tip`.

mod assignment;
mod normal;
mod prismatic;
mod table;

pub use assignment::FrameAssignment;
pub use normal::Normal;
pub use table::{DhTable, TableRow};

use crate::geometry::{Line, Pose, Vector3};

/// The largest angle, in rad, between nearly parallel axes.
const NEARLY_PARALLEL: f64 = 1e-2;

/// The axis of a joint in the home configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointAxis {
    /// The axis, in the coordinates in which base and tool are given too. The point of a prismatic axis has no meaning.
    pub line: Line,
    /// Rotation about the axis for a unit of the variable: 1 for a revolute joint, 0 for a prismatic one.
    pub turn: f64,
    /// Translation along the axis for a unit of the variable, in m: 0 for a revolute joint, 1 for a
    /// prismatic one, the lead per radian for a helical one.
    pub slide: f64,
    /// Value of the variable in the home configuration, rad or m.
    pub home: f64,
}

impl JointAxis {
    /// The axis of a revolute joint whose variable is `home` rad there.
    pub fn revolute(line: Line, home: f64) -> Self {
        JointAxis {
            line,
            turn: 1.0,
            slide: 0.0,
            home,
        }
    }

    /// The axis of a prismatic joint whose variable is `home` m there.
    pub fn prismatic(line: Line, home: f64) -> Self {
        JointAxis {
            turn: 0.0,
            slide: 1.0,
            ..JointAxis::revolute(line, home)
        }
    }

    /// Turn and travel of the variable at home, in rad and m.
    pub(super) fn home_motion(&self) -> (f64, f64) {
        (self.turn * self.home, self.slide * self.home)
    }

    /// True if the joint is prismatic, so that its axis has no position.
    pub fn is_prismatic(&self) -> bool {
        self.turn == 0.0
    }
}

/// The joint axes of a serial chain in the home configuration, in one frame's coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct SerialAxes {
    /// The frame from which the table should start. It does if a row can lead from it to the
    /// first axis; `None` leaves the first frame free.
    pub base: Option<Pose<f64>>,
    /// The axes, from the base to the tool.
    pub joints: Vec<JointAxis>,
    /// The frame at which the chain ends; `None` ends it with the last link frame.
    pub tool: Option<Pose<f64>>,
}

impl SerialAxes {
    /// A typical length of the axes: the largest distance of a given point from the first, which is at least half of that
    /// between any two; 1 m if there is none.
    pub fn length(&self) -> f64 {
        let placed = self.joints.iter().filter(|joint| !joint.is_prismatic());
        let ends = [&self.base, &self.tool].into_iter().flatten();
        let points = placed.map(|joint| joint.line.point);
        let mut points = points.chain(ends.map(|pose| pose.position));
        let first = points.next().unwrap_or_else(Vector3::zero);
        let distances = points.map(|point| (point - first).norm());
        let slides = self.joints.iter().map(|joint| joint.home_motion().1.abs());
        let largest = distances.chain(slides).fold(0.0, f64::max);
        if largest > 0.0 { largest } else { 1.0 }
    }
}
