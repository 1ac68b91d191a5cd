//! What moves how fast when the mapped and held coordinates do.

use super::condition::{condition, determinant};
use super::map_problem::MapProblem;
use crate::linear::Factorable;
use crate::mechanism::{Configuration, Role};
use crate::number::{LANES, Packed};
use crate::solve::Equations;
use crate::system::{Coordinate, Driving, Held, System, Unknown, Work};

/// The motions for unit rates of the held coordinates one by one, the columns of N, dimensionless:
/// J N = 0 for the closures linearised with nothing held, and H N = 1 for the rates of what is held.
///
/// With the rates A N of the inputs, det(A N) is the determinant of the derivative of the inputs by
/// what is mapped and held; it is defined for redundant rows as well, smooth on a solution, and changes
/// sign at direct singularities only. With those of outputs it tells the inverse ones.
#[derive(Clone, Debug)]
pub(crate) struct Rates<T: Factorable> {
    /// The closures with nothing held, which have all unknowns.
    free: System<T>,
    driving: Driving,
    held: Vec<Row>,
    inputs: Vec<Row>,
    outputs: Vec<Row>,
    /// Whether outputs are other than what is held.
    tells_inverse: bool,
    /// Unknowns whose rates are what moves out where there are no outputs.
    moved: Vec<usize>,
    /// Rates of the held coordinates.
    given: Vec<T>,
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
        let whole = mechanism.platforms().is_empty();
        let unknowns = free.unknowns().iter().enumerate();
        let moved = unknowns.filter(|(_, unknown)| match **unknown {
            Unknown::Joint(joint) => whole && mechanism.joints()[joint].role != Role::Actuated,
            Unknown::Twist(..) => true,
        });
        let unknowns = free.unknowns().len();
        Rates {
            driving: Driving::new(system, &problem.question.held(), &problem.held),
            held: rows(&problem.held),
            inputs: rows(&problem.inputs),
            outputs: rows(&problem.outputs),
            tells_inverse: problem.tells_inverse(),
            moved: moved.map(|(i, _)| i).collect(),
            given: vec![T::zero(); problem.held.len()],
            motions: vec![T::zero(); unknowns * problem.held.len()],
            rates: Default::default(),
            spare: Vec::new(),
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
        system.factorise(0.0, work);
        let (n, unknowns) = (self.held.len(), self.unknowns());
        // the largest that J N is off
        let mut gap = [0.0f64; LANES];
        let closures = 0..system.hold_rows().start;
        for i in 0..n {
            self.given.fill(T::zero());
            self.given[i] = T::one();
            let motion = &mut self.motions[i * unknowns..][..unknowns];
            (self.driving).rates(system, at, &self.given, work, motion);
            let rows = (self.driving).row_rates(system, at, &self.given, work, motion);
            let (off, size) = (largest(&rows[closures.clone()]), largest(motion));
            for (gap, (off, size)) in gap.iter_mut().zip(off.iter().zip(size)) {
                let relative = off / (1.0 + size);
                *gap = if relative <= *gap { *gap } else { relative };
            }
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
