//! What steps arrive at.

use super::configurations::Configurations;
use crate::analysis::workspace::problem::Indicators;
use crate::mechanism::{Configuration, ConfigurationRef};
use crate::number::Packed;

/// A configuration with its motions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moving<'a> {
    pub at: ConfigurationRef<'a, f64>,
    /// For unit rates of the held coordinates one by one, the mapped ones first, dimensionless.
    pub motions: &'a [f64],
    pub indicators: &'a Indicators,
}

/// The same, owned.
#[derive(Clone, Debug)]
pub(crate) struct Arrival {
    pub at: Configuration<f64>,
    pub motions: Vec<f64>,
    pub indicators: Indicators,
}

impl Arrival {
    pub fn moving(&self) -> Moving<'_> {
        Moving {
            at: self.at.view(),
            motions: &self.motions,
            indicators: &self.indicators,
        }
    }
}

impl Moving<'_> {
    pub fn arrival(&self) -> Arrival {
        Arrival {
            at: self.at.owned(),
            motions: self.motions.to_vec(),
            indicators: self.indicators.clone(),
        }
    }
}

/// What several steps side by side arrive at; the memory is used again.
#[derive(Clone, Debug, Default)]
pub(crate) struct Arrivals {
    /// For each step whether it does.
    arrived: Vec<bool>,
    at: Configurations,
    indicators: Vec<Indicators>,
    motions: Vec<f64>,
}

impl Arrivals {
    pub fn begin(&mut self, steps: usize) {
        self.arrived.clear();
        self.arrived.resize(steps, false);
        self.indicators.clear();
        self.indicators.resize(steps, Indicators::default());
    }

    /// Takes places over for steps from `first` on, and that these of them arrive.
    pub fn put<T: Packed>(
        &mut self,
        first: usize,
        at: &Configuration<T>,
        motions: &[T],
        indicators: &[Option<Indicators>],
    ) {
        let steps = self.arrived.len();
        self.at.fill(steps, &at.map(|x| x.part(0)));
        self.motions.resize(steps * motions.len(), 0.0);
        for (i, indicators) in (first..).zip(indicators) {
            if let Some(indicators) = indicators {
                self.arrived[i] = true;
                self.indicators[i].clone_from(indicators);
            }
        }
        let places = || (first..).zip(0..indicators.len());
        for (joint, x) in at.joints.iter().enumerate() {
            for (i, place) in places() {
                *self.at.joint_mut(i, joint) = x.part(place);
            }
        }
        for (platform, pose) in at.platforms.iter().enumerate() {
            for (i, place) in places() {
                let to = self.at.platform_mut(i, platform);
                to.orientation.0 = pose.orientation.0.map(|x| x.part(place));
                to.position.0 = pose.position.0.map(|x| x.part(place));
            }
        }
        for (k, x) in motions.iter().enumerate() {
            for (i, place) in places() {
                self.motions[i * motions.len() + k] = x.part(place);
            }
        }
    }

    pub fn reject(&mut self, step: usize) {
        self.arrived[step] = false;
    }

    pub fn get(&self, step: usize) -> Option<Moving<'_>> {
        let length = self.motions.len() / self.arrived.len().max(1);
        self.arrived[step].then(|| Moving {
            at: self.at.get(step),
            motions: &self.motions[step * length..][..length],
            indicators: &self.indicators[step],
        })
    }

    /// What all steps arrive at, in their order.
    pub fn iter(&self) -> impl Iterator<Item = Option<Moving<'_>>> {
        (0..self.arrived.len()).map(|step| self.get(step))
    }
}
