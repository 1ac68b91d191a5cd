//! A configuration as a page keeps it.

use serde::{Deserialize, Serialize};

use crate::geometry::{Quaternion, Vector3};
use crate::mechanism::{Configuration, Mechanism, PlatformPose};

/// Joint values in rad and m; of each platform position and unit quaternion, scalar first.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct State {
    joints: Vec<f64>,
    platforms: Vec<([f64; 3], [f64; 4])>,
}

impl State {
    pub fn of(at: &Configuration<f64>) -> Self {
        let platforms = at.platforms.iter();
        State {
            joints: at.joints.clone(),
            platforms: platforms
                .map(|pose| (pose.position.0, pose.orientation.0))
                .collect(),
        }
    }

    /// The configuration, if it is one of this mechanism.
    pub fn of_mechanism(&self, mechanism: &Mechanism) -> Option<Configuration<f64>> {
        let counts = (mechanism.joints().len(), mechanism.platforms().len());
        ((self.joints.len(), self.platforms.len()) == counts).then(|| Configuration {
            joints: self.joints.clone(),
            platforms: (self.platforms.iter())
                .map(|&(position, orientation)| PlatformPose {
                    orientation: Quaternion(orientation).normalised(),
                    position: Vector3(position),
                })
                .collect(),
        })
    }
}
