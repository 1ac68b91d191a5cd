//! The places of a mechanism along a motion, to be drawn over one another or one after the other.

use crate::analysis::sweep::Thinned;
use crate::geometry::Vector3;
use crate::mechanism::{Configuration, Mechanism, Point};
use crate::scene::Scene;

/// Places along motions.
#[derive(Clone, Debug, Default)]
pub struct DrawnCourse {
    motions: Vec<DrawnPlaces>,
    /// Points that are traced.
    points: Vec<Point>,
}

#[derive(Clone, Debug)]
struct DrawnPlaces {
    mode: Option<usize>,
    taken: Thinned<Configuration<f64>>,
}

impl DrawnCourse {
    /// Places of one motion at most.
    const MOST: usize = 120;

    /// With points that are traced.
    pub fn of(points: impl Iterator<Item = Point>) -> Self {
        DrawnCourse {
            points: points.collect(),
            ..DrawnCourse::default()
        }
    }

    /// Takes in a place of the motion in a mode; another mode begins another motion.
    pub fn take(&mut self, mode: Option<usize>, at: &Configuration<f64>) {
        if self.motions.last().is_none_or(|places| places.mode != mode) {
            self.motions.push(DrawnPlaces {
                mode,
                taken: Thinned::of(Vec::new()),
            });
        }
        if let Some(DrawnPlaces { taken, .. }) = self.motions.last_mut() {
            taken.take(taken.wants_next().then(|| at.clone()), Self::MOST);
        }
    }

    /// The mechanism with its points, their paths left to others.
    fn scene(&self, mechanism: &Mechanism, at: &Configuration<f64>) -> Scene {
        let mut scene = Scene::of(mechanism, at);
        scene.travels.clear();
        let points = self.points.iter();
        points.fold(scene, |scene, point| {
            scene.with_path(mechanism, at, point, Vec::new())
        })
    }

    /// The mechanism in a few places of each motion, where the first begins last.
    pub fn strobe(&self, mechanism: &Mechanism) -> Vec<Scene> {
        /// Places shown of all motions together.
        const SHOWN: usize = 8;
        let each = (SHOWN / self.motions.len().max(1)).max(1);
        let shown = self.motions.iter().rev().flat_map(|places| {
            let every = places.taken.kept.len().div_ceil(each).max(1);
            places.taken.kept.iter().step_by(every).rev()
        });
        shown.map(|at| self.scene(mechanism, at)).collect()
    }

    /// The mechanism from place to place.
    pub fn scenes(&self, mechanism: &Mechanism) -> Vec<(Option<usize>, Scene)> {
        let motions = self.motions.iter().flat_map(|places| {
            let scene = |at: &Configuration<f64>| (places.mode, self.scene(mechanism, at));
            let mut scenes: Vec<(Option<usize>, Scene)> =
                places.taken.kept.iter().map(scene).collect();
            let returns = match &scenes[..] {
                [(_, first), .., (_, last)] => {
                    let pairs = first.points().into_iter().zip(last.points());
                    let apart = pairs.map(|(a, b)| (Vector3(a) - Vector3(b)).norm());
                    apart.fold(0.0, f64::max) < 1e-6 * mechanism.characteristic_length()
                }
                _ => true,
            };
            if !returns {
                let back: Vec<_> = scenes[1..scenes.len() - 1].iter().rev().cloned().collect();
                scenes.extend(back);
            } else if scenes.len() > 1 {
                // the last place is the first of the next round
                scenes.pop();
            }
            scenes
        });
        motions.collect()
    }
}
