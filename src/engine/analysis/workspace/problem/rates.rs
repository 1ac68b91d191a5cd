//! Rates of inputs, outputs and platforms for unit rates of the mapped and held coordinates.

use nalgebra::DMatrix;

use super::condition::condition;
use super::map_problem::MapProblem;
use crate::linear::{Factorable, dot};
use crate::mechanism::{Configuration, Role};
use crate::number::tolerance::{SOLVED, STILL};
use crate::system::{Coordinate, Driving, Held, System, SystemWork, Unknown};

/// The motions for unit rates of the held coordinates one by one, the columns of N, dimensionless:
/// J N = 0 for the closures linearised with nothing held, and H N = 1 for the rates of the held coordinates.
///
/// With the rates A N of the inputs, det(A N) is the determinant of the derivative of the inputs by
/// mapped and held coordinates; it is defined for redundant rows as well, smooth on a solution, and changes
/// sign at direct singularities only. With those of outputs it tells the inverse ones.
#[derive(Clone, Debug)]
pub(crate) struct Rates {
    /// The closures with nothing held, which have all unknowns.
    free: System<f64>,
    driving: Driving,
    held: Vec<CoordinateRow>,
    inputs: Vec<CoordinateRow>,
    outputs: Vec<CoordinateRow>,
    /// True if outputs are other coordinates than those held.
    tells_inverse: bool,
    /// Unknowns whose rates stand for outputs where there are none.
    moved: Vec<usize>,
    /// Rates of the held coordinates, of the inputs, of the outputs and of the moved unknowns.
    rates: [Vec<f64>; 4],
}

/// The columns of N one after another, and the rates at which the rows of the closures open in each.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeldMotions<T> {
    pub motions: Vec<T>,
    pub opening: Vec<T>,
}

/// A coordinate and the first of the unknowns it depends on.
#[derive(Clone, Copy, Debug)]
struct CoordinateRow {
    of: Coordinate,
    first: usize,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Indicators {
    /// True if the held coordinates can have any rates, and these certainly belong to a solution that is no fold.
    pub regular: bool,
    /// det(A N): zero where A N has lost rank, at direct singularities; 1 where it is not reported.
    pub direct: f64,
    /// det(A N) of the outputs: zero at inverse singularities; 1 where it is not reported.
    pub inverse: f64,
    /// Condition number of the map from the inputs to the outputs, or else to the moved unknowns.
    pub condition: f64,
}

impl Rates {
    /// `system` is that of the question.
    pub fn new(problem: &MapProblem, system: &System<f64>) -> Self {
        let mechanism = problem.mechanism;
        let nothing = Held::nothing(mechanism);
        let free = System::reduced(mechanism, mechanism.dimensions(), &nothing);
        let place = |unknown: Unknown| (free.place_of(unknown)).expect("nothing is held");
        let row = |of: &Coordinate| CoordinateRow {
            of: *of,
            first: match *of {
                Coordinate::Joint(joint) => place(Unknown::Joint(joint)),
                Coordinate::Pose(platform, _) | Coordinate::Turn(platform, _) => {
                    place(Unknown::Twist(platform, 0))
                }
            },
        };
        let rows = |of: &[Coordinate]| of.iter().map(row).collect::<Vec<CoordinateRow>>();
        let whole = mechanism.platforms().is_empty();
        let unknowns = free.unknowns().iter().enumerate();
        let moved = unknowns.filter(|(_, unknown)| match **unknown {
            Unknown::Joint(joint) => whole && mechanism.joints()[joint].role != Role::Actuated,
            Unknown::Twist(..) => true,
        });
        Rates {
            driving: Driving::new(system, &problem.question.held(), &problem.held),
            held: rows(&problem.held),
            inputs: rows(&problem.inputs),
            outputs: rows(&problem.outputs),
            tells_inverse: problem.tells_inverse(),
            moved: moved.map(|(i, _)| i).collect(),
            rates: Default::default(),
            free,
        }
    }

    /// Moves a configuration by steps of all unknowns.
    pub fn displace(&self, at: &mut Configuration<f64>, step: &[f64]) {
        self.free.displace(at, step);
    }

    fn unknowns(&self) -> usize {
        self.free.unknowns().len()
    }

    /// Works N out where the equations are solved, linearised and factorised.
    pub fn motions<T: Factorable>(
        &self,
        at: &Configuration<T>,
        system: &System<T>,
        work: &mut SystemWork<T>,
        found: &mut HeldMotions<T>,
    ) {
        let (n, unknowns) = (self.held.len(), self.unknowns());
        let closures = 0..system.hold_rows().start;
        found.opening.clear();
        found.motions.clear();
        found.motions.resize(n * unknowns, T::zero());
        for i in 0..n {
            let given = (0..n).map(|k| T::from_f64(if k == i { 1.0 } else { 0.0 }));
            let given: Vec<T> = given.collect();
            let motion = &mut found.motions[i * unknowns..][..unknowns];
            (self.driving).rates(system, at, &given, work, motion);
            let rows = (self.driving).row_rates(system, at, &given, work, motion);
            found.opening.extend_from_slice(&rows[closures.clone()]);
        }
    }

    /// The determinants and the condition number of the motions.
    pub fn indicators(&mut self, at: &Configuration<f64>, found: &HeldMotions<f64>) -> Indicators {
        let (n, unknowns) = (self.held.len(), self.unknowns());
        let motions = &found.motions;
        // unit rates come out again if the held coordinates are independent
        let [mut back, mut input, mut output, mut moved] = std::mem::take(&mut self.rates);
        self.matrix(&self.held, at, motions, &mut back);
        self.matrix(&self.inputs, at, motions, &mut input);
        self.matrix(&self.outputs, at, motions, &mut output);
        // 1 where there are not as many inputs or outputs
        let of = |matrix: &[f64]| match matrix.len() == n * n {
            true => DMatrix::from_column_slice(n, n, matrix).determinant(),
            false => 1.0,
        };
        let (direct, inverse) = (of(&input), of(&output));
        let (of_inputs, of_outputs) = (!self.inputs.is_empty(), self.tells_inverse);
        let unknown = (false, f64::INFINITY);
        let (lost, condition_number) = match of_inputs {
            true => {
                moved.clone_from(&output);
                if self.outputs.is_empty() {
                    let motions = motions.chunks_exact(unknowns.max(1));
                    moved.extend(motions.flat_map(|one| self.moved.iter().map(|&i| one[i])));
                }
                condition(&mut input, &mut moved, n)
            }
            false => unknown,
        };
        let (lost_outputs, _) = match of_outputs {
            true => condition(&mut output, &mut [], n),
            false => unknown,
        };
        let of = |known: bool, lost: bool, determinant: f64| match (known, lost) {
            (false, _) => 1.0,
            (true, true) => 0.0,
            (true, false) => determinant,
        };
        // a NaN is not regular
        let unit = |(k, x): (usize, &f64)| {
            let unit = f64::from(u8::from(k % n == k / n));
            (x - unit).abs() < STILL
        };
        let opening = found
            .opening
            .chunks_exact((found.opening.len() / n.max(1)).max(1));
        let mut opening = opening.zip(motions.chunks_exact(unknowns.max(1)));
        let closed = opening.all(|(rows, motion)| largest(rows) < STILL * (1.0 + largest(motion)));
        // faster motions are those of a point √ε beside a fold, where ε is what solving leaves of the equations: it is found
        // from some starts and not from others, and a node on the very boundary of a map would depend on the seed
        let fastest = 0.1 / SOLVED.sqrt();
        let indicators = Indicators {
            regular: closed && back.iter().enumerate().all(unit) && largest(motions) < fastest,
            direct: of(of_inputs, lost, direct),
            inverse: of(of_outputs, lost_outputs, inverse),
            condition: condition_number,
        };
        self.rates = [back, input, output, moved];
        indicators
    }

    /// The rates of coordinates, a column for each held one.
    fn matrix(
        &self,
        rows: &[CoordinateRow],
        at: &Configuration<f64>,
        motions: &[f64],
        matrix: &mut Vec<f64>,
    ) {
        matrix.clear();
        matrix.resize(rows.len() * self.held.len(), 0.0);
        let motions = motions.chunks_exact(self.unknowns().max(1));
        for (i, row) in rows.iter().enumerate() {
            let slope = match row.of {
                Coordinate::Joint(_) => None,
                Coordinate::Pose(platform, c) => Some(c.slope(&at.platforms[platform].pose())),
                Coordinate::Turn(_, axis) => {
                    let mut slope = [0.0; 6];
                    slope[axis as usize] = 1.0;
                    Some(slope)
                }
            };
            for (j, motion) in motions.clone().enumerate() {
                matrix[j * rows.len() + i] = match &slope {
                    None => motion[row.first],
                    Some(slope) => dot(&motion[row.first..][..6], slope),
                };
            }
        }
    }
}

/// The largest of several numbers without their signs; a NaN is larger than any.
fn largest(of: &[f64]) -> f64 {
    of.iter().fold(0.0, |most, x| match x.abs() {
        size if size <= most => most,
        size => size,
    })
}
