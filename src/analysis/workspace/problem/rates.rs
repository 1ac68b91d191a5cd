//! What moves how fast when the mapped and held coordinates do.

use super::condition::{condition, determinant};
use super::map_problem::MapProblem;
use crate::geometry::Vector3;
use crate::linear::Factorable;
use crate::mechanism::{Configuration, PoseCoordinate, Role, orientation_rows};
use crate::number::{LANES, Packed};
use crate::solve::Equations;
use crate::system::{Coordinate, Held, HeldPlatform, System, Unknown, Work};

/// The motions for unit rates of the held coordinates one by one, the columns of N, dimensionless:
/// J N = 0 for the closures linearised with nothing held, and H N = 1 for the rates of what is held.
///
/// With the rates A N of the inputs, det(A N) is the determinant of the derivative of the inputs by
/// what is mapped and held; it is defined for redundant rows as well, smooth on a solution, and changes
/// sign at direct singularities only. With those of outputs it tells the inverse ones.
#[derive(Clone, Debug)]
pub(crate) struct Rates<T: Factorable> {
    /// The closures with nothing held.
    free: System<T>,
    work: Work<T>,
    /// For each row of the closures at a node the same row with nothing held.
    rows: Vec<usize>,
    /// For each unknown at a node its place among all.
    places: Vec<usize>,
    held: Vec<Row>,
    ways: Vec<RateSource>,
    inputs: Vec<Row>,
    outputs: Vec<Row>,
    /// Whether outputs are other than what is held.
    tells_inverse: bool,
    /// Unknowns whose rates are what moves out where there are no outputs.
    moved: Vec<usize>,
    /// Rates of the equations at a node, and of those with nothing held.
    right: Vec<T>,
    column: Vec<T>,
    motions: Vec<T>,
    /// Rates of what is held, of the inputs, of the outputs and of what moves.
    rates: [Vec<T>; 4],
    spare: Vec<T>,
}

/// A coordinate and the first of the unknowns it depends on.
#[derive(Clone, Copy, Debug)]
struct Row {
    of: Coordinate,
    first: usize,
}

/// How the rate of a held coordinate enters the equations at a node.
#[derive(Clone, Copy, Debug)]
enum RateSource {
    /// A joint or displacement that is no unknown there: by its column.
    Unknown(usize),
    /// An angle of a platform whose pose is no unknown: by the columns of its turning.
    Turned(usize, PoseCoordinate),
    /// A coordinate that is one of the equations.
    Row(usize),
    /// An angle of an orientation that three of the equations hold.
    Turning(usize, PoseCoordinate),
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Indicators {
    /// Whether the held coordinates can have any rates.
    pub regular: bool,
    /// det(A N): zero where A N has lost rank, at direct singularities; 1 where it is not reported.
    pub direct: f64,
    /// The same for outputs: zero at inverse singularities.
    pub inverse: f64,
    /// Condition number of the map from the inputs to the outputs, or else to what moves.
    pub condition: f64,
}

impl<T: Factorable + Packed> Rates<T> {
    /// `system` is that of the question.
    pub fn new(problem: &MapProblem, system: &System<T>) -> Self {
        let mechanism = problem.mechanism;
        let dimensions = mechanism.dimensions().map(&mut T::from_f64);
        let nothing = Held::nothing(mechanism).map(T::from_f64);
        let free = System::reduced(mechanism, &dimensions, &nothing);
        let place = |unknown: Unknown| (free.place_of(unknown)).expect("nothing is held");
        let row = |of: &Coordinate| Row {
            of: *of,
            first: match *of {
                Coordinate::Joint(joint) => place(Unknown::Joint(joint)),
                Coordinate::Pose(platform, _) | Coordinate::Turn(platform, _) => {
                    place(Unknown::Twist(platform, 0))
                }
            },
        };
        let rows = |of: &[Coordinate]| of.iter().map(row).collect::<Vec<Row>>();
        let mut matching = vec![0; system.hold_rows().start];
        for (here, there) in system.closure_rows().zip(free.closure_rows()) {
            here.zip(there).for_each(|(h, t)| matching[h] = t);
        }
        let whole = mechanism.platforms().is_empty();
        let unknowns = free.unknowns().iter().enumerate();
        let moved = unknowns.filter(|(_, unknown)| match **unknown {
            Unknown::Joint(joint) => whole && mechanism.joints()[joint].role != Role::Actuated,
            Unknown::Twist(..) => true,
        });
        let unknowns = free.unknowns().len();
        Rates {
            rows: matching,
            places: system.unknowns().iter().map(|u| place(*u)).collect(),
            held: rows(&problem.held),
            ways: ways(problem, system, &place),
            inputs: rows(&problem.inputs),
            outputs: rows(&problem.outputs),
            tells_inverse: problem.tells_inverse(),
            moved: moved.map(|(i, _)| i).collect(),
            right: vec![T::zero(); system.rows()],
            column: vec![T::zero(); free.rows()],
            motions: vec![T::zero(); unknowns * problem.held.len()],
            rates: Default::default(),
            spare: Vec::new(),
            work: free.work(),
            free,
        }
    }

    /// Moves a configuration by steps of all unknowns.
    pub fn displace(&self, at: &mut Configuration<T>, step: &[T]) {
        self.free.displace(at, step);
    }

    pub fn unknowns(&self) -> usize {
        self.free.unknowns().len()
    }

    /// Works N out, and what follows from it, where the equations are solved and linearised.
    pub fn at(
        &mut self,
        at: &Configuration<T>,
        system: &System<T>,
        work: &mut Work<T>,
    ) -> [Indicators; LANES] {
        self.free.linearise(at, &mut self.work);
        system.factorise(0.0, work);
        let (n, unknowns) = (self.held.len(), self.unknowns());
        // the largest that J N is off
        let mut gap = [0.0f64; LANES];
        for i in 0..n {
            let mut motion = std::mem::take(&mut self.motions);
            self.move_one(at, system, work, i, &mut motion[i * unknowns..][..unknowns]);
            let one = &motion[i * unknowns..][..unknowns];
            self.free.product_into(one, &self.work, &mut self.column);
            let (off, size) = (largest(&self.column), largest(one));
            for (gap, (off, size)) in gap.iter_mut().zip(off.iter().zip(size)) {
                let relative = off / (1.0 + size);
                *gap = if relative <= *gap { *gap } else { relative };
            }
            self.motions = motion;
        }
        // unit rates come out again if the held coordinates are independent
        let [mut back, mut input, mut output, mut moved] = std::mem::take(&mut self.rates);
        self.matrix(&self.held, at, &mut back);
        self.matrix(&self.inputs, at, &mut input);
        self.matrix(&self.outputs, at, &mut output);
        let mut of = |matrix: &Vec<T>| {
            self.spare.clone_from(matrix);
            determinant(&mut self.spare, n)
        };
        let (direct, inverse) = (of(&input), of(&output));
        let any = |rows: &[Row]| !rows.is_empty();
        let (of_inputs, of_outputs) = (any(&self.inputs), self.tells_inverse);
        let conditions = match of_inputs {
            true => {
                moved.clone_from(&output);
                if !any(&self.outputs) {
                    let motions = self.motions.chunks_exact(unknowns.max(1));
                    moved.extend(motions.flat_map(|one| self.moved.iter().map(|&i| one[i])));
                }
                condition(&mut input, &mut moved, n)
            }
            false => [(false, f64::INFINITY); LANES],
        };
        let lost = match of_outputs {
            true => condition(&mut output, &mut [], n),
            false => [(false, f64::INFINITY); LANES],
        };
        let of = |known: bool, lost: bool, determinant: f64| match (known, lost) {
            (false, _) => 1.0,
            (true, true) => 0.0,
            (true, false) => determinant,
        };
        let mut regular = [true; LANES];
        for (k, x) in back.iter().enumerate() {
            let unit = f64::from(u8::from(k % n == k / n));
            for (place, regular) in regular.iter_mut().enumerate().take(T::WIDTH) {
                // a NaN is not regular
                *regular &= (x.part(place) - unit).abs() < 1e-6;
            }
        }
        let indicators = std::array::from_fn(|place| match place < T::WIDTH {
            true => Indicators {
                regular: regular[place] && gap[place] < 1e-6,
                direct: of(of_inputs, conditions[place].0, direct.part(place)),
                inverse: of(of_outputs, lost[place].0, inverse.part(place)),
                condition: conditions[place].1,
            },
            false => Indicators::default(),
        });
        self.rates = [back, input, output, moved];
        indicators
    }

    /// The motion for a unit rate of held coordinate `i`: the step −J⁺r for the rate r of the residual
    /// that what is held would make takes the rest along.
    fn move_one(
        &mut self,
        at: &Configuration<T>,
        system: &System<T>,
        work: &mut Work<T>,
        i: usize,
        motion: &mut [T],
    ) {
        motion.fill(T::zero());
        self.right.fill(T::zero());
        match self.ways[i] {
            RateSource::Unknown(unknown) => motion[unknown] = T::one(),
            RateSource::Turned(first, c) => {
                let Coordinate::Pose(platform, _) = self.held[i].of else {
                    return;
                };
                let omega = turning(at, platform, c);
                motion[first..first + 3].copy_from_slice(&omega.0);
            }
            RateSource::Row(row) => self.right[row] = -T::one(),
            RateSource::Turning(row, c) => {
                let (omega, platform) = match self.held[i].of {
                    Coordinate::Pose(platform, _) => (turning(at, platform, c), platform),
                    Coordinate::Turn(platform, axis) => (Vector3::unit(axis as usize), platform),
                    Coordinate::Joint(_) => return,
                };
                let actual = at.platforms[platform].orientation.rotation();
                let (_, slopes) = orientation_rows(&actual, &actual);
                for (right, slope) in self.right[row..].iter_mut().zip(slopes) {
                    *right = -slope.dot(&omega);
                }
            }
        }
        for (unknown, rate) in motion.iter().enumerate() {
            // most do not move; where one does not in any place the sum is the same without it
            if (0..T::WIDTH).all(|place| rate.part(place) == 0.0) {
                continue;
            }
            (self.free).column_into(unknown, &self.work, &mut self.column);
            for (right, &row) in self.right.iter_mut().zip(&self.rows) {
                *right += self.column[row] * *rate;
            }
        }
        system.step_for(&self.right, work);
        let step = system.step_of(work);
        for (&place, &rate) in self.places.iter().zip(step) {
            motion[place] = rate;
        }
    }

    /// The motions for unit rates of all held coordinates, one after another.
    pub fn motions(&self) -> &[T] {
        &self.motions
    }

    /// The rates of coordinates, a column for each held one.
    fn matrix(&self, rows: &[Row], at: &Configuration<T>, matrix: &mut Vec<T>) {
        matrix.clear();
        matrix.resize(rows.len() * self.held.len(), T::zero());
        let motions = self.motions.chunks_exact(self.unknowns().max(1));
        for (i, row) in rows.iter().enumerate() {
            let slope = match row.of {
                Coordinate::Joint(_) => None,
                Coordinate::Pose(platform, c) => Some(c.slope(&at.platforms[platform].pose())),
                Coordinate::Turn(_, axis) => {
                    let mut slope = [T::zero(); 6];
                    slope[axis as usize] = T::one();
                    Some(slope)
                }
            };
            for (j, motion) in motions.clone().enumerate() {
                matrix[j * rows.len() + i] = match &slope {
                    None => motion[row.first],
                    Some(slope) => {
                        let products = motion[row.first..].iter().zip(slope);
                        products.fold(T::zero(), |sum, (x, s)| sum + *x * *s)
                    }
                };
            }
        }
    }
}

/// The largest of several numbers without their signs, in each place; a NaN is larger than any.
fn largest<T: Packed>(of: &[T]) -> [f64; LANES] {
    let mut most = [0.0; LANES];
    for x in of {
        for (place, most) in most.iter_mut().enumerate().take(T::WIDTH) {
            let size = x.part(place).abs();
            *most = if size <= *most { *most } else { size };
        }
    }
    most
}

/// How the rate of each held coordinate enters the equations of the question.
fn ways<T: Factorable>(
    problem: &MapProblem,
    system: &System<T>,
    place: &impl Fn(Unknown) -> usize,
) -> Vec<RateSource> {
    let held = problem.question.held();
    let twist = |platform, component| place(Unknown::Twist(platform, component));
    let way = |of: &Coordinate| match *of {
        Coordinate::Joint(joint) => RateSource::Unknown(place(Unknown::Joint(joint))),
        Coordinate::Pose(platform, c) => {
            let known = held.platforms[platform] == HeldPlatform::Pose;
            let row = system.coordinate_row(platform, c);
            match (known, c.is_angle(), row) {
                (true, true, _) => RateSource::Turned(twist(platform, 0), c),
                (true, false, _) => RateSource::Unknown(twist(platform, 3 + c as usize)),
                (false, _, Some(row)) => RateSource::Row(row),
                (false, _, None) => RateSource::Turning(orientation(system, platform), c),
            }
        }
        Coordinate::Turn(platform, axis) => match held.platforms[platform] {
            HeldPlatform::Pose => RateSource::Unknown(twist(platform, axis as usize)),
            _ => RateSource::Turning(orientation(system, platform), PoseCoordinate::Yaw),
        },
    };
    problem.held.iter().map(way).collect()
}

fn orientation<T: Factorable>(system: &System<T>, platform: usize) -> usize {
    let row = system.orientation_row(platform);
    row.expect("three held angles are an orientation")
}

/// The angular velocity for a unit rate of one angle of a platform, the other two at rest.
fn turning<T: Packed>(at: &Configuration<T>, platform: usize, c: PoseCoordinate) -> Vector3<T> {
    let pose = at.platforms[platform].pose();
    let slope = |c: PoseCoordinate| {
        let slope = c.slope(&pose);
        Vector3([slope[0], slope[1], slope[2]])
    };
    let [next, last] = match c {
        PoseCoordinate::Roll => [PoseCoordinate::Pitch, PoseCoordinate::Yaw],
        PoseCoordinate::Pitch => [PoseCoordinate::Yaw, PoseCoordinate::Roll],
        _ => [PoseCoordinate::Roll, PoseCoordinate::Pitch],
    };
    let across = slope(next).cross(&slope(last));
    across.times(T::one() / slope(c).dot(&across))
}
