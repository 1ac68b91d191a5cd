//! Wrenches that the closures resist at outputs that lost freedoms.

use super::{Classifier, Resisted};
use crate::geometry::Vector3;
use crate::linear::{complement, dot, norm, orthonormal, remove};
use crate::mechanism::{Configuration, Frame};
use crate::system::{Coordinate, Lock, wrench_screws};

/// An output, or the coordinates of one platform, with its wrenches (m/L; f) about the origin of
/// the frame.
struct Part {
    frame: Frame,
    name: String,
    wrenches: Vec<[f64; 6]>,
}

impl Classifier<'_> {
    /// What the motions of the mechanism make of the outputs, orthonormal.
    fn image(&mut self, at: &Configuration<f64>) -> Vec<Vec<f64>> {
        let motions = self.closures.decomposition(at).null_space();
        let entries = self.inverse.jacobian(at);
        let (rows, first) = (self.inverse.rows(), self.closures.rows());
        let images: Vec<Vec<f64>> = (motions.iter())
            .map(|motion| {
                let mut image = vec![0.0; rows - first];
                for (column, rate) in entries.chunks_exact(rows.max(1)).zip(motion) {
                    let outputs = column[first..].iter();
                    (image.iter_mut().zip(outputs)).for_each(|(sum, x)| *sum += rate * x);
                }
                image
            })
            .collect();
        orthonormal(&images, crate::linear::RANK_TOLERANCE)
    }

    /// Wrenches reciprocal to all that the outputs can do here, but not to all they can do nearby.
    /// The latter must contain the former: it does if the outputs have all freedoms, or stay in a
    /// plane.
    pub(super) fn resisted(&mut self, at: &Configuration<f64>) -> Vec<Resisted> {
        let Some(beside) = self.beside.clone() else {
            return Vec::new();
        };
        let (here, there) = (self.image(at), self.image(&beside));
        let size = self.inverse.rows() - self.closures.rows();
        let outside = here.iter().any(|direction| {
            let mut left = direction.clone();
            remove(&mut left, &there);
            norm(&left) > 1e-6
        });
        if outside {
            return Vec::new();
        }
        // of what is reciprocal here, the part within what is possible nearby
        let within = complement(&here, size).into_iter().map(|w| {
            let mut inside = vec![0.0; size];
            for direction in &there {
                let along = dot(&w, direction);
                (inside.iter_mut().zip(direction)).for_each(|(x, d)| *x += along * d);
            }
            inside
        });
        let within = orthonormal(&within.collect::<Vec<_>>(), 1e-3);
        let mechanism = self.near.mechanism();
        let length = mechanism.characteristic_length();
        let mut parts: Vec<Part> = Vec::new();
        let mut row = 0;
        for output in &self.outputs {
            let rates = |first: usize, size: usize| {
                let wrenches = within.iter().map(|w| {
                    let mut wrench = [0.0; 6];
                    wrench[first..first + size].copy_from_slice(&w[row..row + size]);
                    wrench
                });
                wrenches.collect::<Vec<_>>()
            };
            match *output {
                Lock::Frame(frame) | Lock::Point(frame) => {
                    let (first, size) = match output {
                        Lock::Frame(_) => (0, 6),
                        _ => (3, 3),
                    };
                    parts.push(Part {
                        frame,
                        name: output.name(mechanism),
                        wrenches: rates(first, size),
                    });
                    row += size;
                }
                Lock::Coordinate(
                    coordinate @ (Coordinate::Pose(platform, _) | Coordinate::Turn(platform, _)),
                ) => {
                    let slope = coordinate.slope(&at.platforms[platform].pose(), length);
                    let frame = Frame::Platform { platform };
                    let place = parts.iter().position(|part| part.frame == frame);
                    let place = place.unwrap_or_else(|| {
                        parts.push(Part {
                            frame,
                            name: mechanism.frame_name(frame),
                            wrenches: vec![[0.0; 6]; within.len()],
                        });
                        parts.len() - 1
                    });
                    for (wrench, w) in parts[place].wrenches.iter_mut().zip(&within) {
                        (wrench.iter_mut().zip(slope)).for_each(|(sum, x)| *sum += w[row] * x);
                    }
                    row += 1;
                }
                Lock::Coordinate(Coordinate::Joint(_)) => row += 1,
            }
        }
        let resisted = parts.into_iter().map(|part| {
            let origin = mechanism.poses([part.frame; 2], at)[0].position;
            let wrenches = part.wrenches.iter().map(|&[a, b, c, d, e, f]| {
                let (moment, force) = (Vector3([a, b, c]), Vector3([d, e, f]));
                let moment = moment + origin.cross(&force).times(1.0 / length);
                [force.0, moment.0].concat()
            });
            Resisted {
                wrenches: wrench_screws(&wrenches.collect::<Vec<_>>(), length),
                output: part.name,
            }
        });
        resisted.filter(|r| !r.wrenches.is_empty()).collect()
    }
}
