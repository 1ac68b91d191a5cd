//! Parts that only keep two points at a distance, so that solutions are found without them.
//!
//! A body between two balls affects nothing else but by its length, nor does a link between two pins of a planar linkage, nor
//! a leg with two hinges whose axes meet and a ball: the hinges of that turn as they must, in two ways.

use super::bound::is_plain;
use super::coordinates::C;
use crate::geometry::{Pose, Vector3};
use crate::mechanism::{
    ChainDimensions, ClosureDimensions, ClosureKind, Dimensions, Frame, Kept, Kinematics,
    LinearForm, RowDimensions,
};
use crate::number::tolerance::ROUNDING;
use crate::number::{Number, complex::norm};
use crate::system::{Held, HeldPlatform};

/// A part that a rod stands for.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Rod {
    /// The last hinge, or the last two, on one side of a closure that nothing else depends on.
    Hinged {
        closure: usize,
        side: usize,
        joints: Vec<usize>,
    },
    /// A platform between two balls, each given by closure and side.
    Body {
        platform: usize,
        balls: [(usize, usize); 2],
    },
}

/// The way from ground or a platform to a frame: where it begins, moving rows, a fixed displacement.
type FramePath = (Frame, Vec<RowDimensions<C>>, Pose<C>);

/// The ways to both frames of every closure.
fn ways(dimensions: &Dimensions<C>) -> Vec<[FramePath; 2]> {
    let frames = dimensions.closures.iter().flat_map(|c| c.frames);
    let kinematics = Kinematics::new(dimensions, frames);
    let way = |frame| {
        let slot = kinematics.slot(frame).expect("it was planned for");
        let (root, rows, tip) = kinematics.path(slot);
        let root = match root.checked_sub(1) {
            None => Frame::Ground,
            Some(platform) => Frame::Platform { platform },
        };
        (root, rows, tip)
    };
    let closures = dimensions.closures.iter();
    closures.map(|c| c.frames.map(way)).collect()
}

fn occurs(rows: &[RowDimensions<C>], joint: usize) -> bool {
    let has = |form: &LinearForm<C>| form.0.iter().any(|(j, _)| *j == joint);
    rows.iter().any(|row| has(&row.turn) || has(&row.slide))
}

/// A leg as a rod.
struct Hinges {
    /// The place on the axis of the first hinge at which the rod begins.
    start: C,
    /// The rod's length, with what joints that are held add.
    length: C,
    extension: LinearForm<C>,
    /// By how much it is no rod.
    error: f64,
}

impl Hinges {
    fn of((_, rows, tip): &FramePath, joints: &[usize]) -> Option<Self> {
        let zero = C::from_f64(0.0);
        let first = rows
            .iter()
            .position(|row| row.turn.coefficient(joints[0]) != zero)?;
        let hinges = rows.get(first..first + joints.len())?;
        let turns = hinges.iter().zip(joints);
        if !turns
            .into_iter()
            .all(|(row, j)| row.slide.0.is_empty() && row.turn.coefficient(*j) != zero)
        {
            return None;
        }
        let off = |x: C, y: C| norm(x).max(norm(y));
        // both axes meet there; in a plane it is where the pin is
        let (start, at, mut error) = match hinges {
            [_, second] => {
                let (o, z) = (second.before.position.0, second.before.rotation.0[2].0);
                let along = -(o[0] * z[0] + o[1] * z[1]) / (z[0] * z[0] + z[1] * z[1]);
                let error = off(o[0] + along * z[0], o[1] + along * z[1]);
                (o[2] + along * z[2], along, error)
            }
            _ => (tip.position.0[2], tip.position.0[2], 0.0),
        };
        let mut at = Vector3([zero, zero, at]);
        let mut extension = LinearForm(Vec::new());
        for row in &rows[first + joints.len()..] {
            at = row.before.inverse() * at;
            match (extension.0.is_empty(), row.slide.0.is_empty()) {
                // a turn that is held, about an axis through the same point
                (true, true) => error = error.max(off(at.0[0], at.0[1])),
                (true, false) if row.turn.0.is_empty() => extension = row.slide.clone(),
                _ => return None,
            }
        }
        let gap = tip.position - at;
        let length = match extension.0.is_empty() {
            true => Number::sqrt(gap.dot(&gap)),
            false => {
                error = error.max(off(gap.0[0], gap.0[1]));
                gap.0[2]
            }
        };
        (start.is_finite()).then_some(Hinges {
            start,
            length,
            extension,
            error,
        })
    }
}

impl Rod {
    /// All that can be left out of what is to be found; `kept` are the rows of closures that do not vanish everywhere.
    pub fn all(dimensions: &Dimensions<C>, held: &Held<C>, kept: &[Kept]) -> Vec<Rod> {
        let ways = ways(dimensions);
        let is_ball = |c: usize| dimensions.closures[c].kind == ClosureKind::Spherical;
        // a pin of a planar linkage
        let is_pin = |c: usize| {
            let (kind, rows) = (dimensions.closures[c].kind, kept[c]);
            let count = |rows: &[bool]| rows.iter().filter(|kept| **kept).count();
            matches!(kind, ClosureKind::Revolute | ClosureKind::Spherical)
                && (count(&rows[..3]), count(&rows[3..kind.equations()])) == (2, 0)
        };
        let small = ROUNDING * dimensions.characteristic_length;
        let free = |way: &FramePath| -> Vec<usize> {
            let forms = way
                .1
                .iter()
                .flat_map(|row| row.turn.0.iter().chain(&row.slide.0));
            forms
                .map(|(j, _)| *j)
                .filter(|j| !held.joints[*j])
                .collect()
        };
        let mut rods = Vec::new();
        for (closure, pair) in ways.iter().enumerate() {
            let hinges = match () {
                () if is_pin(closure) => 1,
                () if is_ball(closure) => 2,
                () => continue,
            };
            let rod = [0, 1].into_iter().find_map(|side| {
                let own = free(&pair[side]);
                let joints = own[own.len().checked_sub(hinges)?..].to_vec();
                let elsewhere = |c: usize, way: usize| {
                    (c, way) != (closure, side)
                        && joints.iter().any(|&j| occurs(&ways[c][way].1, j))
                };
                let alone = !(0..ways.len()).any(|c| elsewhere(c, 0) || elsewhere(c, 1));
                let whole = hinges == 1 || own.len() == 2 && free(&pair[1 - side]).is_empty();
                let related = |j: &usize| {
                    let relations = dimensions
                        .closures
                        .iter()
                        .filter_map(|c| c.relation.as_ref());
                    relations.into_iter().any(|of| of.joints.contains(j))
                };
                let plain = (joints.iter()).all(|j| is_plain(dimensions, *j) && !related(j));
                let rod = Hinges::of(&pair[side], &joints)?;
                let long = norm(rod.length) > small || !rod.extension.0.is_empty();
                let fits = alone && whole && plain && long && rod.error <= small;
                fits.then_some(Rod::Hinged {
                    closure,
                    side,
                    joints,
                })
            });
            rods.extend(rod);
        }
        let mut bodies: Vec<Frame> = Vec::new();
        for (platform, held) in held.platforms.iter().enumerate() {
            let spins = matches!(held, HeldPlatform::Partly(parts)
                if parts.coordinates.is_empty() && parts.orientation.is_none() && parts.spins.len() == 1);
            let own = Frame::Platform { platform };
            let sides = ways
                .iter()
                .enumerate()
                .flat_map(|(c, pair)| [(c, 0, pair), (c, 1, pair)]);
            let sides: Vec<_> = sides
                .filter(|(_, side, pair)| pair[*side].0 == own)
                .collect();
            let [(a, i, first), (b, j, second)] = sides.as_slice() else {
                continue;
            };
            let fits = |side: usize, pair: &[FramePath; 2]| {
                pair[side].1.is_empty() && !bodies.contains(&pair[1 - side].0)
            };
            if spins && a != b && is_ball(*a) && is_ball(*b) && fits(*i, first) && fits(*j, second)
            {
                bodies.push(own);
                rods.push(Rod::Body {
                    platform,
                    balls: [(*a, *i), (*b, *j)],
                });
            }
        }
        rods
    }

    /// The closure that is made a rod, and one that is left out.
    pub fn closures(&self) -> (usize, Option<usize>) {
        match *self {
            Rod::Hinged { closure, .. } => (closure, None),
            Rod::Body { balls, .. } => (balls[0].0, Some(balls[1].0)),
        }
    }

    /// A list with one entry for each closure, changed to that of the closures with rods.
    pub fn replaced<T>(rods: &[Rod], all: Vec<T>, made: impl IntoIterator<Item = T>) -> Vec<T> {
        let mut all: Vec<Option<T>> = all.into_iter().map(Some).collect();
        for (rod, made) in rods.iter().zip(made) {
            let (kept, gone) = rod.closures();
            all[kept] = Some(made);
            if let Some(gone) = gone {
                all[gone] = None;
            }
        }
        all.into_iter().flatten().collect()
    }

    /// The dimensions with rods in place of parts.
    pub fn standing(rods: &[Rod], dimensions: &Dimensions<C>) -> Option<Dimensions<C>> {
        let ways = ways(dimensions);
        let mut reduced = dimensions.clone();
        let mut made = Vec::with_capacity(rods.len());
        for rod in rods {
            made.push(match rod {
                Rod::Hinged {
                    closure,
                    side,
                    joints,
                } => {
                    let hinges = Hinges::of(&ways[*closure][*side], joints)?;
                    let chains = dimensions.chains.iter().enumerate();
                    let mut rows = chains.flat_map(|(chain, part)| {
                        let rows = part.rows.iter().enumerate();
                        rows.map(move |(row, part)| (Frame::Link { chain, row }, part))
                    });
                    let (on, row) =
                        rows.find(|(_, row)| occurs(std::slice::from_ref(row), joints[0]))?;
                    let (zero, chain) = (C::from_f64(0.0), reduced.chains.len());
                    reduced.chains.push(ChainDimensions {
                        on,
                        base: row.before * Pose::translation(Vector3([zero, zero, hinges.start])),
                        rows: Vec::new(),
                        tip: Pose::identity(),
                    });
                    ClosureDimensions {
                        kind: ClosureKind::Distance,
                        frames: [
                            Frame::Tip { chain },
                            dimensions.closures[*closure].frames[1 - side],
                        ],
                        length: hinges.length,
                        extension: hinges.extension,
                        relation: None,
                    }
                }
                Rod::Body { balls, .. } => {
                    let [a, b] = balls.map(|(c, side)| ways[c][side].2.position);
                    let gap = b - a;
                    ClosureDimensions {
                        kind: ClosureKind::Distance,
                        frames: balls.map(|(c, side)| dimensions.closures[c].frames[1 - side]),
                        length: Number::sqrt(gap.dot(&gap)),
                        extension: LinearForm(Vec::new()),
                        relation: None,
                    }
                }
            });
        }
        reduced.closures = Rod::replaced(rods, reduced.closures, made);
        Some(reduced)
    }

    /// Held coordinates with rods: the unknowns of the parts count as held.
    pub fn held(rods: &[Rod], mut held: Held<C>) -> Held<C> {
        for rod in rods {
            match rod {
                Rod::Hinged { joints, .. } => joints.iter().for_each(|j| held.joints[*j] = true),
                Rod::Body { platform, .. } => held.platforms[*platform] = HeldPlatform::Pose,
            }
        }
        held
    }

    /// Number of equations that it saves.
    pub fn equations(&self) -> usize {
        match self {
            Rod::Hinged { joints, .. } => joints.len(),
            Rod::Body { .. } => 5,
        }
    }

    /// Number of ways in which the part closes.
    pub fn ways(&self) -> usize {
        match self {
            Rod::Hinged { joints, .. } => joints.len(),
            Rod::Body { .. } => 1,
        }
    }
}
