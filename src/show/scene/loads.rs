//! Springs, dampers and masses of the file.

use super::{Scene, SpringShape, Weight};
use crate::geometry::Vector3;
use crate::mechanism::{Along, Configuration, Mechanism, Point};

impl Scene {
    /// Adds the springs, dampers and masses of the file. A spring at a slide ends where the slide stands, and begins where it would
    /// stand at its free length.
    #[must_use]
    pub fn with_loads(mut self, mechanism: &Mechanism, at: &Configuration<f64>) -> Self {
        let loads = mechanism.loads();
        let placed = |point: &Point| {
            let pose = mechanism.transform(crate::mechanism::Frame::Ground, point.frame, at);
            point.placed(&pose).0
        };
        for spring in &loads.springs {
            let (ends, axis) = match spring.along {
                Along::Points(ends) => (ends.map(|end| placed(&end)), None),
                Along::Joint(joint) => {
                    let of = &mechanism.joints()[joint];
                    let mut shapes = self.joints.iter();
                    let Some(shape) = shapes.find(|shape| shape.names.contains(&of.name)) else {
                        continue;
                    };
                    let place = shape.names.iter().position(|name| *name == of.name);
                    let axes = shape.axes.len().saturating_sub(1);
                    let Some(&axis) = shape.axes.get(place.unwrap_or(0).min(axes)) else {
                        continue;
                    };
                    let stretched = at.joints[joint] - spring.rest;
                    match of.kind.is_angle() {
                        true => ([shape.at; 2], Some(axis)),
                        false => {
                            let begin = Vector3(shape.at) - Vector3(axis).times(stretched);
                            ([begin.0, shape.at], None)
                        }
                    }
                }
            };
            self.springs.push(SpringShape {
                name: spring.name.clone(),
                ends,
                axis,
                elastic: spring.stiffness != 0.0 || spring.preload != 0.0,
                damping: spring.damping != 0.0,
            });
        }
        let weights = loads.masses.iter().map(|of| Weight {
            name: of.name.clone(),
            at: placed(&of.centre),
            force: loads.gravity.map(|g| of.mass * g),
        });
        self.weights.extend(weights);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spring_is_as_long_as_the_law_of_cosines_says_and_weights_are_mass_times_gravity() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../mechanisms/loads/desk_lamp.ron"
        );
        let text = std::fs::read_to_string(path).unwrap();
        let description = crate::description::Description::read(&text).unwrap();
        let mechanism = Mechanism::new(&description).unwrap();
        let mut at = mechanism.home();
        at.joints[0] = 0.5;
        let scene = Scene::of(&mechanism, &at).with_loads(&mechanism, &at);
        let [from, to] = scene.springs[0].ends.map(Vector3);
        // hook at 80 mm on the arm, anchor 60 mm above the pivot, 0.5 rad between them
        let (r, h) = (0.08_f64, 0.06);
        let length = (r * r + h * h - 2.0 * r * h * 0.5_f64.cos()).sqrt();
        assert!(((from - to).norm() - length).abs() < 1e-12);
        assert!(
            scene
                .springs
                .iter()
                .all(|of| of.elastic && !of.damping && of.axis.is_none())
        );
        let weights = scene.weights.iter().map(|of| of.force[2]);
        for (weight, mass) in weights.zip([0.3, 0.25, 0.4]) {
            assert!((weight + 9.81 * mass).abs() < 1e-12);
        }
    }
}
