//! Results of analyses in the scene.

use super::{ForceArrow, Mark, Scene, ScrewAxis, Trace, Triple, least_and_greatest};
use crate::analysis::singularities::SingularitiesReport;
use crate::analysis::statics::StaticsReport;
use crate::analysis::velocity::VelocityReport;
use crate::geometry::Vector3;
use crate::mechanism::{Configuration, Frame, Mechanism, Point};
use crate::number::tolerance::ROUNDING;

impl Scene {
    /// Adds the instant centres beside the joints that are no farther from the mechanism than it is large.
    #[must_use]
    pub fn with_centres(mut self, report: &VelocityReport) -> Self {
        let (middle, size) = self.extent();
        for centre in &report.centres {
            let Some(at) = centre.point else { continue };
            // in the plane in which the mechanism is drawn
            let at = match self.normal.map(Vector3) {
                Some(normal) => {
                    let off = Vector3(middle) - Vector3(at);
                    (Vector3(at) + normal.times(off.dot(&normal))).0
                }
                None => at,
            };
            let apart = |other: Triple| (Vector3(at) - Vector3(other)).norm();
            // a centre on a joint is obvious and not marked
            let mut joints = self.joints.iter();
            let joint = joints.any(|joint| apart(joint.at) < 1e-6 * size);
            if !joint && apart(middle) <= 1.5 * size {
                self.centres.push(Mark {
                    name: centre.bodies.join(" / "),
                    at,
                });
            }
        }
        self
    }

    /// Adds a point with its path, joined to the frame that carries it.
    #[must_use]
    pub fn with_path(
        mut self,
        mechanism: &Mechanism,
        at: &Configuration<f64>,
        point: &Point,
        points: Vec<Triple>,
    ) -> Self {
        let pose = mechanism.transform(Frame::Ground, point.frame, at);
        let body = mechanism.body(point.frame);
        let number = mechanism.bodies().iter().position(|known| *known == body);
        let ends = [pose.position.0, point.placed(&pose).0];
        if let Some(body) = number
            && ends[0] != ends[1]
        {
            self.bodies[body].lines.push(ends.to_vec());
        }
        self.paths.push(Trace {
            name: point.name(mechanism),
            points,
        });
        self
    }

    /// Adds the screws of the freedoms gained at a singular configuration.
    #[must_use]
    pub fn with_gained(mut self, report: &SingularitiesReport) -> Self {
        let (middle, _) = self.extent();
        let gained = report.singularity.gained.iter();
        for space in gained.flat_map(|gained| &gained.twists) {
            self.screws.extend(space.screws.iter().map(|screw| {
                let along = Vector3(screw.direction);
                // where the axis is nearest to the mechanism
                let at = screw.point.map_or(middle, |point| {
                    let off = Vector3(middle) - Vector3(point);
                    (Vector3(point) + along.times(off.dot(&along))).0
                });
                ScrewAxis {
                    name: space.body.clone(),
                    at,
                    along: screw.direction,
                    pitch: screw.pitch,
                }
            }));
        }
        self
    }

    /// Adds the applied wrenches, and the reactions at closures and joints of chains.
    #[must_use]
    pub fn with_forces(
        mut self,
        mechanism: &Mechanism,
        at: &Configuration<f64>,
        report: &StaticsReport,
    ) -> Self {
        for load in &report.loads {
            let Ok(point) = Point::read(mechanism, &load.frame) else {
                continue;
            };
            let pose = mechanism.transform(Frame::Ground, point.frame, at);
            self.arrows.push(ForceArrow {
                name: load.frame.clone(),
                applied: true,
                at: point.placed(&pose).0,
                force: load.force,
                moment: load.moment,
            });
        }
        for reaction in report.closures.iter().chain(&report.joints) {
            // joints that meet pass on the same force
            let same = |arrow: &ForceArrow| {
                let apart = |a: Triple, b: Triple| (Vector3(a) - Vector3(b)).norm();
                let size = Vector3(reaction.force).norm();
                !arrow.applied
                    && apart(arrow.at, reaction.point) < 1e-9 * report.normalising_length
                    && apart(arrow.force, reaction.force) <= 1e-9 * size
            };
            if !self.arrows.iter().any(same) {
                self.arrows.push(ForceArrow {
                    name: reaction.name.clone(),
                    applied: false,
                    at: reaction.point,
                    force: reaction.force,
                    moment: reaction.moment,
                });
            }
        }
        // what is as small as rounding beside the largest of them is nothing
        let length = report.normalising_length;
        let sizes = |arrow: &ForceArrow| {
            [
                Vector3(arrow.force).norm() * length,
                Vector3(arrow.moment).norm(),
            ]
        };
        let largest = self.arrows.iter().flat_map(sizes).fold(0.0, f64::max);
        for arrow in &mut self.arrows {
            let [force, moment] = sizes(arrow).map(|size| size > ROUNDING * largest);
            if !force {
                arrow.force = [0.0; 3];
            }
            if !moment {
                arrow.moment = [0.0; 3];
            }
        }
        self
    }

    /// The middle of the scene and its size, in m.
    fn extent(&self) -> (Triple, f64) {
        let points = self.points();
        let ends = [0, 1, 2].map(|axis| {
            let values = points.iter().map(|point| point[axis]);
            least_and_greatest(values)
        });
        let size = Vector3(ends.map(|(low, high)| high - low)).norm();
        (ends.map(|(low, high)| 0.5 * (low + high)), size)
    }
}
