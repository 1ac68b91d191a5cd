//! Ingredients that quantities need.

use crate::mechanism::{Figure, Measured, Order, Point};

/// Ingredients of quantities besides positions.
#[derive(Clone, Copy, Default)]
pub(super) struct Wants {
    pub order: Order,
    pub forces: bool,
    pub reactions: bool,
    pub transmission: bool,
    pub jacobian: bool,
    pub determinant: bool,
    pub singular_values: bool,
    pub distances: bool,
}

impl Wants {
    pub fn of<'m>(measured: impl Iterator<Item = &'m Measured>) -> Self {
        let mut wants = Wants::default();
        for measured in measured {
            match measured {
                Measured::Parameter(_) | Measured::Time | Measured::Work(_) => {}
                Measured::Joint(_, order)
                | Measured::Place(_, _, order)
                | Measured::Size(_, order) => wants.order = wants.order.max(*order),
                Measured::Screw(..) => wants.order = wants.order.max(Order::Velocity),
                Measured::Curvature(_) => wants.order = Order::Acceleration,
                Measured::Force(_)
                | Measured::PlatformForce(..)
                | Measured::Power(_)
                | Measured::Energy(_)
                | Measured::Inertia(_)
                | Measured::Shaking(_) => wants.forces = true,
                Measured::Reaction(..) => (wants.forces, wants.reactions) = (true, true),
                Measured::Transmission(_) => wants.transmission = true,
                Measured::Figure(Figure::Determinant) => {
                    (wants.jacobian, wants.determinant) = (true, true);
                }
                Measured::Figure(Figure::Condition | Figure::Manipulability) => {
                    (wants.jacobian, wants.singular_values) = (true, true);
                }
                Measured::Figure(_) => wants.distances = true,
            }
        }
        wants
    }
}

/// The points whose motion a name needs: of a screw the origin of its frame, then one on each of its axes.
pub(super) fn points_of(measured: &Measured, length: f64) -> Vec<Point> {
    match *measured {
        Measured::Place(point, ..) | Measured::Size(point, _) | Measured::Curvature(point) => {
            vec![point]
        }
        Measured::Screw(frame, _) => {
            let mut points = vec![Point::from(frame); 4];
            (0..3).for_each(|k| points[k + 1].offset[k] = length);
            points
        }
        _ => Vec::new(),
    }
}
