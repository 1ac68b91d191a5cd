//! Random configurations to start a search from.

use rand::Rng;

use crate::geometry::{Quaternion, Vector3};
use crate::mechanism::{Configuration, Joint, Mechanism, PlatformPose};

/// Range of random values of a joint: its limits, one turn, or a characteristic length either way from home.
pub fn sampling_range(joint: &Joint, home: f64, length: f64) -> (f64, f64) {
    match joint.limits {
        Some((low, high)) if low.is_finite() && high.is_finite() => (low, high),
        _ if joint.kind.is_angle() => (-std::f64::consts::PI, std::f64::consts::PI),
        _ => (home - length, home + length),
    }
}

/// A random value for every joint and a random pose for every platform, around the one given.
pub fn random_configuration(
    mechanism: &Mechanism,
    around: &Configuration<f64>,
    rng: &mut impl Rng,
) -> Configuration<f64> {
    let length = mechanism.characteristic_length();
    let mut at = around.clone();
    let home = mechanism.home().joints;
    let joints = mechanism.joints().iter().zip(home);
    for ((joint, home), value) in joints.zip(&mut at.joints) {
        let (low, high) = sampling_range(joint, home, length);
        *value = low + (high - low) * rng.random::<f64>();
    }
    for pose in &mut at.platforms {
        let mut inside = || 2.0 * rng.random::<f64>() - 1.0;
        let shift = Vector3([inside(), inside(), inside()]).times(length);
        let quaternion = Quaternion([inside(), inside(), inside(), inside()]);
        *pose = PlatformPose {
            orientation: quaternion.normalised(),
            position: pose.position + shift,
        };
    }
    at
}
