//! The held coordinates of a choice, in the form the solver takes.

use crate::geometry::{Pose, Rotation};
use crate::mechanism::{Mechanism, PoseCoordinate};
use crate::system::{Coordinate, Held, HeldPlatform};

/// Every coordinate singly, but poses and orientations held by turns as wholes.
pub(super) fn of(mechanism: &Mechanism, coordinates: &[Coordinate]) -> Held<f64> {
    let mut held = Held::nothing(mechanism);
    for &coordinate in coordinates {
        match coordinate {
            Coordinate::Joint(joint) => held.joints[joint] = true,
            Coordinate::Pose(platform, _) | Coordinate::Turn(platform, _)
                if whole(coordinates, platform) =>
            {
                held.platforms[platform] = HeldPlatform::Pose;
            }
            Coordinate::Pose(platform, coordinate) => {
                partly(&mut held.platforms[platform])
                    .0
                    .push((coordinate, 0.0));
            }
            // the three turns of an orientation
            Coordinate::Turn(platform, _) => {
                *partly(&mut held.platforms[platform]).1 = Some(Pose::<f64>::identity().rotation);
            }
        }
    }
    held
}

/// Whether a pose is held whole, with turns about the axes of ground.
fn whole(coordinates: &[Coordinate], platform: usize) -> bool {
    let all = coordinates.iter();
    let of_it = all.filter(|held| match held {
        Coordinate::Turn(of, _) => *of == platform,
        Coordinate::Pose(of, c) => *of == platform && !c.is_angle(),
        Coordinate::Joint(_) => false,
    });
    of_it.count() == 6
}

/// The coordinates and the orientation of a platform held in part.
fn partly(
    held: &mut HeldPlatform<f64>,
) -> (&mut Vec<(PoseCoordinate, f64)>, &mut Option<Rotation<f64>>) {
    if !matches!(held, HeldPlatform::Partly { .. }) {
        *held = HeldPlatform::Partly {
            coordinates: Vec::new(),
            orientation: None,
            spins: Vec::new(),
        };
    }
    match held {
        HeldPlatform::Partly {
            coordinates,
            orientation,
            ..
        } => (coordinates, orientation),
        HeldPlatform::Free | HeldPlatform::Pose => unreachable!("made so above"),
    }
}
