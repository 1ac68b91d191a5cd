//! Wrenches that the closures resist at outputs that lost freedoms.

use super::{CLOSURES, Classifier, INVERSE, Resisted};
use crate::geometry::Vector3;
use crate::linear::{RANK_TOLERANCE, add, complement, dot, norm, orthonormal, remove};
use crate::mechanism::{Configuration, Point};
use crate::number::tolerance::STILL;
use crate::system::{Coordinate, Lock, wrench_screws};

/// An output, or the coordinates of one platform, with its wrenches (m/L; f) about the point.
struct OutputWrenches {
    point: Point,
    name: String,
    wrenches: Vec<[f64; 6]>,
}

impl Classifier<'_> {
    /// The rates of the outputs that the motions of the mechanism make possible, orthonormal.
    fn image(&mut self, at: &Configuration<f64>) -> Vec<Vec<f64>> {
        let motions = self.matrices[CLOSURES].decomposition(at).null_space();
        let rates = self.matrices[INVERSE].rates(at, &motions);
        orthonormal(&rates, RANK_TOLERANCE)
    }

    /// Wrenches reciprocal to all motions of the outputs here, but not to all nearby, which must contain the former.
    pub(super) fn resisted(&mut self, at: &Configuration<f64>) -> Vec<Resisted> {
        let Some(beside) = self.beside.clone() else {
            return Vec::new();
        };
        let (here, there) = (self.image(at), self.image(&beside));
        let size = self.matrices[INVERSE].rows() - self.matrices[CLOSURES].rows();
        let outside = here.iter().any(|direction| {
            let mut left = direction.clone();
            remove(&mut left, &there);
            norm(&left) > STILL
        });
        if outside {
            return Vec::new();
        }
        // of what is reciprocal here, the part within what is possible nearby
        let within = complement(&here, size).into_iter().map(|w| {
            let mut inside = vec![0.0; size];
            for direction in &there {
                add(&mut inside, dot(&w, direction), direction);
            }
            inside
        });
        let within = orthonormal(&within.collect::<Vec<_>>(), 1e-3);
        let mechanism = self.near.mechanism();
        let length = mechanism.characteristic_length();
        let mut parts: Vec<OutputWrenches> = Vec::new();
        let mut row = 0;
        for &output in &self.outputs {
            let unit = |k: usize| std::array::from_fn(|i| f64::from(u8::from(i == k)));
            // how each of its rates depends on the twist (ω; v/L) of its frame
            let slopes: Vec<[f64; 6]> = match output {
                Lock::Frame(_) => (0..6).map(unit).collect(),
                Lock::Point(_) => (3..6).map(unit).collect(),
                Lock::Coordinate(
                    of @ (Coordinate::Pose(platform, _) | Coordinate::Turn(platform, _)),
                ) => {
                    vec![of.slope(&at.platforms[platform].pose(), length)]
                }
                Lock::Coordinate(Coordinate::Joint(_)) => vec![[0.0; 6]],
            };
            if let Some(point) = output.point() {
                let of_platform = matches!(output, Lock::Coordinate(_));
                let known = parts
                    .iter()
                    .position(|part| of_platform && part.point == point);
                let place = known.unwrap_or_else(|| {
                    parts.push(OutputWrenches {
                        point,
                        name: match of_platform {
                            true => mechanism.frame_name(point.frame),
                            false => output.name(mechanism),
                        },
                        wrenches: vec![[0.0; 6]; within.len()],
                    });
                    parts.len() - 1
                });
                for (wrench, w) in parts[place].wrenches.iter_mut().zip(&within) {
                    for (slope, force) in slopes.iter().zip(&w[row..]) {
                        add(wrench, *force, slope);
                    }
                }
            }
            row += slopes.len();
        }
        let resisted = parts.into_iter().map(|part| {
            let origin = mechanism.to_centre(part.point.at(mechanism, at));
            let wrenches = part.wrenches.iter().map(|&[a, b, c, d, e, f]| {
                let (moment, force) = (Vector3([a, b, c]), Vector3([d, e, f]));
                let moment = moment + origin.cross(&force).times(1.0 / length);
                [force.0, moment.0].concat()
            });
            Resisted {
                wrenches: wrench_screws(mechanism, &wrenches.collect::<Vec<_>>()),
                output: part.name,
            }
        });
        resisted.filter(|r| !r.wrenches.is_empty()).collect()
    }
}
