//! Motion laws of inputs: position over time.

use serde::{Deserialize, Serialize};

use crate::algebra::words;
use crate::number::Number;
use crate::solve::halved;

words! {
    /// The way from 0 to 1 of a part s of the segment over a part u of the time.
    Law {
        /// s = u: a constant rate.
        Constant = "constant",
        /// s = 3u² − 2u³: at rest at both ends.
        Cubic = "cubic",
        /// s = 10u³ − 15u⁴ + 6u⁵: rate and acceleration vanish at both ends (the 3-4-5 polynomial).
        Quintic = "quintic",
        /// s = 35u⁴ − 84u⁵ + 70u⁶ − 20u⁷: the change of acceleration does too (the 4-5-6-7 polynomial).
        Septic = "septic",
        /// s = u − sin(2πu)/2π: the acceleration is a sine.
        Cycloidal = "cycloidal",
    }
}

/// A law with the time that the whole segment takes.
///
/// Source: Norton, Design of Machinery, chapter 8, on the laws; they are those of cams.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Pace {
    /// The law.
    pub law: Law,
    /// The time, in s.
    pub duration: f64,
}

impl Default for Pace {
    fn default() -> Self {
        Pace {
            law: Law::Constant,
            duration: 1.0,
        }
    }
}

impl Law {
    /// s, s′ and s″ at u.
    pub fn at<T: Number>(self, u: T) -> [T; 3] {
        use std::f64::consts::TAU;
        let n = T::from_f64;
        // what is left
        let v = n(1.0) - u;
        match self {
            Law::Constant => [u, n(1.0), n(0.0)],
            Law::Cubic => [
                u * u * (n(3.0) - n(2.0) * u),
                n(6.0) * u * v,
                n(6.0) - n(12.0) * u,
            ],
            Law::Quintic => [
                u.powi(3) * (n(10.0) - n(15.0) * u + n(6.0) * u * u),
                n(30.0) * (u * v).powi(2),
                n(60.0) * u * v * (n(1.0) - n(2.0) * u),
            ],
            Law::Septic => [
                u.powi(4) * (n(35.0) - n(84.0) * u + n(70.0) * u * u - n(20.0) * u.powi(3)),
                n(140.0) * (u * v).powi(3),
                n(420.0) * (u * v).powi(2) * (n(1.0) - n(2.0) * u),
            ],
            Law::Cycloidal => {
                let (sin, cos) = (n(TAU) * u).sin_cos();
                [u - sin / n(TAU), n(1.0) - cos, n(TAU) * sin]
            }
        }
    }

    /// The u at which s has a value from 0 to 1: all laws rise.
    pub fn inverse(self, s: f64) -> f64 {
        if self == Law::Constant {
            return s;
        }
        let [low, high] = halved([0.0, 1.0], |u| self.at(u)[0] < s);
        0.5 * (low + high)
    }
}

impl Pace {
    /// The rate over that of a constant law where a part of the time is gone, and its change per s.
    pub fn relative<T: Number>(&self, u: T) -> [T; 2] {
        let [_, rate, change] = self.law.at(u);
        [rate, change / T::from_f64(self.duration)]
    }
}
