//! Plane four-bars among mechanisms whose coupler carries a point through given points: where their pins are.

use super::coupler_curve::{FourBar, Z};
use crate::description::AxesInPlane;
use crate::mechanism::{
    Body, Convention, Frame, Measured, Mechanism, Point, PoseCoordinate, Quantity,
};
use crate::number::C;
use crate::system::{Bundle, Bundled, Target};

/// A plane four-bar with four pins whose coupler carries a point through given points.
#[derive(Clone, Debug)]
pub struct PinnedFourBar {
    /// x and y of both pivots, of both pins on the coupler, and of the point.
    quantities: Vec<Quantity>,
    /// The table rows of the pins that have joint variables.
    pub(super) turns: Vec<PinTurn>,
    /// The points.
    pub(super) points: Vec<[f64; 2]>,
}

/// A row of a table that turns one part against another.
#[derive(Clone, Debug)]
pub(super) struct PinTurn {
    /// The joints of its angle, with their coefficients.
    pub joints: Vec<(usize, f64)>,
    /// The parts before and behind it: 0 for ground, 1 and 3 for the links, 2 for the coupler.
    pub parts: [usize; 2],
    /// 1 or −1 for an axis along z or against it.
    pub sense: f64,
}

/// A pin between two bodies, with a frame on its axis and the row of its joint, if it has one.
struct Pin {
    frame: Frame,
    bodies: [Body; 2],
    row: Option<(usize, usize)>,
}

/// All pins of a mechanism; `None` if it has other joints.
fn pins(mechanism: &Mechanism) -> Option<Vec<Pin>> {
    let mut all = Vec::new();
    for (chain, part) in mechanism.chains().iter().enumerate() {
        let rows = &mechanism.dimensions().chains[chain].rows;
        for (i, row) in rows.iter().enumerate().filter(|(_, row)| row.moves()) {
            let link = |row: usize| Frame::Link { chain, row };
            if !row.slide.0.is_empty() {
                return None;
            }
            all.push(Pin {
                frame: match part.convention {
                    Convention::Standard => link(i),
                    Convention::Modified => link(i + 1),
                },
                bodies: [link(i), link(i + 1)].map(|frame| mechanism.body(frame)),
                row: Some((chain, i)),
            });
        }
    }
    for closure in mechanism.closures() {
        if closure.kind.in_plane()?.0 != AxesInPlane::Normal {
            return None;
        }
        all.push(Pin {
            frame: closure.frames[0],
            bodies: closure.frames.map(|frame| mechanism.body(frame)),
            row: None,
        });
    }
    Some(all)
}

impl PinnedFourBar {
    /// The four-bar that a mechanism is, with a point of its coupler that has these targets in all positions; `None` if it is none.
    pub fn of(mechanism: &Mechanism, targets: &[Target], positions: usize) -> Option<Self> {
        let normal = mechanism.plane_of_motion()?;
        if normal.0[2].abs() < 0.5 || targets.len() != 2 * positions || targets.is_empty() {
            return None;
        }
        let pins = pins(mechanism)?;
        let on_ground = |pin: &&Pin| pin.bodies.contains(&Body::Ground);
        let [first, second] = pins.iter().filter(on_ground).collect::<Vec<_>>()[..] else {
            return None;
        };
        let link = |pin: &Pin| pin.bodies.into_iter().find(|body| *body != Body::Ground);
        let links = [link(first)?, link(second)?];
        let moving: Vec<&Pin> = pins.iter().filter(|pin| !on_ground(pin)).collect();
        let on = |body: Body| moving.iter().find(|pin| pin.bodies.contains(&body));
        let couplings = [on(links[0])?, on(links[1])?];
        let other = |i: usize| {
            couplings[i]
                .bodies
                .into_iter()
                .find(|body| *body != links[i])
        };
        let coupler = other(0)?;
        let loops = pins.len() == 4 && other(1) == Some(coupler) && coupler != links[1];
        // the same two coordinates of a point on the coupler everywhere
        let [x, y] = [&targets[0].quantity, &targets[1].quantity];
        let of_point = targets.chunks_exact(2).enumerate().all(|(k, pair)| {
            let same = pair[0].quantity == *x && pair[1].quantity == *y;
            same && pair.iter().all(|of| of.configuration == k && !of.exact)
        });
        let along = |quantity: &Quantity, axis: PoseCoordinate| {
            let places = quantity.measured().filter_map(|of| match of {
                Measured::Place(point, along, _) => Some((point, along)),
                _ => None,
            });
            let places: Vec<_> = places.collect();
            let on_coupler = |(point, along): &(&Point, &PoseCoordinate)| {
                mechanism.body(point.frame) == coupler && **along == axis
            };
            !places.is_empty() && places.iter().all(on_coupler)
        };
        if !(loops && of_point && along(x, PoseCoordinate::X) && along(y, PoseCoordinate::Y)) {
            return None;
        }
        let mut quantities = Vec::new();
        for pin in [first, second, couplings[0], couplings[1]] {
            for axis in ["x", "y"] {
                let text = format!("[{}].{axis}", mechanism.frame_name(pin.frame));
                quantities.push(Quantity::read(mechanism, "pin", &text).ok()?);
            }
        }
        quantities.extend([x.clone(), y.clone()]);
        let part = |body: Body| match body {
            Body::Ground => 0,
            body if body == links[0] => 1,
            body if body == coupler => 2,
            _ => 3,
        };
        let home = mechanism.home();
        let turns = pins.iter().filter_map(|pin| {
            let (chain, row) = pin.row?;
            let frame = mechanism.transform(Frame::Ground, pin.frame, &home);
            let form = &mechanism.dimensions().chains[chain].rows[row].turn;
            Some(PinTurn {
                joints: form.0.clone(),
                parts: pin.bodies.map(part),
                sense: frame.rotation.0[2].0[2].signum(),
            })
        });
        let turns: Vec<PinTurn> = turns.collect();
        let points = targets.chunks_exact(2);
        let points = points.map(|pair| [pair[0].value, pair[1].value]);
        (turns.len() == mechanism.joints().len()).then(|| PinnedFourBar {
            quantities,
            turns,
            points: points.collect(),
        })
    }

    /// One configuration of a bundle with the pins and the point as targets.
    pub(super) fn single<'m>(&self, bundle: &Bundle<'m>) -> Bundle<'m> {
        let targets = self.quantities.iter().map(|quantity| Target {
            configuration: 0,
            quantity: quantity.clone(),
            value: 0.0,
            weight: 1.0,
            exact: false,
        });
        bundle.aimed(targets.collect())
    }

    /// The four-bar that a design is, and its point in ground.
    pub(super) fn four_bar(&self, bundle: &Bundle, at: &Bundled) -> Option<(FourBar, Z)> {
        let first = Bundled {
            numbers: at.numbers.clone(),
            configurations: at.configurations[..1].to_vec(),
        };
        let single = self.single(bundle);
        let places = single.deviations(&first)?;
        let z = |i: usize| {
            let (x, y) = (places[2 * i].1, places[2 * i + 1].1);
            [C::new(x, y), C::new(x, -y)]
        };
        let point = z(4);
        let from = |i: usize| {
            let z = z(i);
            [z[0] - point[0], z[1] - point[1]]
        };
        let of = FourBar {
            pivots: [from(0), from(1)],
            pins: [from(2), from(3)],
        };
        Some((of, point))
    }
}
