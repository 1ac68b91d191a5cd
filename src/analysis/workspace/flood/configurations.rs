//! Many configurations of one mechanism without a piece of memory for each.

use crate::mechanism::{Configuration, ConfigurationRef, PlatformPose};

/// Configurations one after another.
#[derive(Clone, Debug, Default)]
pub(crate) struct Configurations {
    joints: Vec<f64>,
    platforms: Vec<PlatformPose<f64>>,
    /// Joints and platforms of each.
    widths: [usize; 2],
}

impl Configurations {
    /// Room for so many more that are like this one.
    pub fn reserve(&mut self, more: usize, like: ConfigurationRef<f64>) {
        self.joints.reserve(more * like.joints.len());
        self.platforms.reserve(more * like.platforms.len());
    }

    pub fn push(&mut self, at: ConfigurationRef<f64>) {
        self.widths = [at.joints.len(), at.platforms.len()];
        self.joints.extend(at.joints);
        self.platforms.extend(at.platforms);
    }

    /// At least so many, of which new ones are this one.
    pub fn fill(&mut self, count: usize, with: &Configuration<f64>) {
        let width = with.joints.len() + with.platforms.len();
        while self.joints.len() + self.platforms.len() < count * width {
            self.push(with.view());
        }
    }

    pub fn get(&self, i: usize) -> ConfigurationRef<'_, f64> {
        let [joints, platforms] = self.widths;
        ConfigurationRef {
            joints: &self.joints[i * joints..][..joints],
            platforms: &self.platforms[i * platforms..][..platforms],
        }
    }

    pub fn joint_mut(&mut self, i: usize, joint: usize) -> &mut f64 {
        &mut self.joints[i * self.widths[0] + joint]
    }

    pub fn platform_mut(&mut self, i: usize, platform: usize) -> &mut PlatformPose<f64> {
        &mut self.platforms[i * self.widths[1] + platform]
    }
}
