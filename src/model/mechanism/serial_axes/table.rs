use serde::{Deserialize, Serialize};

use super::{JointAxis, SerialAxes};
use crate::description::Convention;
use crate::geometry::{Axis, Line, Pose, Vector3};

/// A Denavit–Hartenberg table as numbers: base · row₁ · … · row_n · tip.
#[derive(Clone, Debug, PartialEq)]
pub struct DhTable {
    /// Convention of the rows.
    pub convention: Convention,
    /// To frame 0, in the coordinates of the axes.
    pub base: Pose<f64>,
    /// The rows.
    pub rows: Vec<TableRow>,
    /// Pose of the tool in frame n.
    pub tip: Pose<f64>,
}

/// A row: the constant parts of its entries, and the way in which the variable enters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TableRow {
    /// Twist of the link, in rad.
    pub alpha: f64,
    /// Length of the link, in m.
    pub a: f64,
    /// d where the variable is zero, in m.
    pub d: f64,
    /// θ where the variable is zero, in rad.
    pub theta: f64,
    /// Turn about y behind the twist, in rad: zero but where axes are nearly parallel.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub beta: f64,
    /// Factor of the variable in θ.
    pub turn: f64,
    /// Factor of the variable in d.
    pub slide: f64,
    /// The variable's value in the home configuration, rad or m.
    #[serde(skip)]
    pub home: f64,
}

#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

impl TableRow {
    /// Rx(α)·Tx(a)·Ry(β).
    pub fn link(&self) -> Pose<f64> {
        let along = Pose::translation(Vector3::unit(0).times(self.a));
        let link = Pose::rotation(Axis::X, self.alpha) * along;
        match self.beta {
            0.0 => link,
            beta => link * Pose::rotation(Axis::Y, beta),
        }
    }

    /// Rz(θ)·Tz(d) in the home configuration.
    pub fn joint(&self) -> Pose<f64> {
        let theta = self.theta + self.turn * self.home;
        let d = self.d + self.slide * self.home;
        Pose::rotation(Axis::Z, theta) * Pose::translation(Vector3::unit(2).times(d))
    }
}

impl DhTable {
    /// Frames 0 to n in the home configuration, in the coordinates of the axes.
    pub fn frames(&self) -> Vec<Pose<f64>> {
        let mut frames = vec![self.base];
        let mut pose = self.base;
        for row in &self.rows {
            pose = pose
                * match self.convention {
                    Convention::Modified => row.link() * row.joint(),
                    Convention::Standard => row.joint() * row.link(),
                };
            frames.push(pose);
        }
        frames
    }

    /// The tool in the home configuration: the whole product.
    pub fn tool(&self) -> Pose<f64> {
        let last = self.frames().pop();
        last.unwrap_or(self.base) * self.tip
    }

    /// The joint axes that the table describes: z_k in the modified convention, z_{k−1} in the standard one.
    pub fn axes(&self) -> SerialAxes {
        let frames = self.frames();
        let placed = match self.convention {
            Convention::Modified => &frames[1..],
            Convention::Standard => &frames[..self.rows.len()],
        };
        let axis = |(row, frame): (&TableRow, &Pose<f64>)| JointAxis {
            line: Line {
                point: frame.position,
                direction: frame.rotation.column(Axis::Z),
            },
            turn: row.turn,
            slide: row.slide,
            home: row.home,
        };
        SerialAxes {
            base: Some(self.base),
            joints: self.rows.iter().zip(placed).map(axis).collect(),
            tool: Some(self.tool()),
        }
    }
}
