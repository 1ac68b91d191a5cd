//! What moves how fast when the mapped and held coordinates do.

use super::asked::Asked;
use crate::linear::{Factorable, Qr, RANK_TOLERANCE};
use crate::mechanism::{Configuration, Role};
use crate::number::Packed;
use crate::solve::Equations;
use crate::system::{Held, Holdable, System, Unknown, Work};

/// The closures linearised with nothing held, above the rates of what is held: M = [J; H]. The
/// columns of N = M⁺[0; 1] are the motions for unit rates of the held coordinates, dimensionless.
///
/// With the rates A N of the inputs, det(A N) = det[J; A]/det[J; H] for square J; it is defined for
/// redundant rows as well, smooth on a sheet, and changes sign at direct singularities only. With
/// those of outputs it tells the inverse ones.
#[derive(Clone, Debug)]
pub(super) struct Rates<T: Factorable> {
    system: System<T>,
    work: Work<T>,
    qr: Qr<T>,
    held: Vec<Row>,
    inputs: Vec<Row>,
    outputs: Vec<Row>,
    /// Unknowns whose rates are what moves out.
    moved: Vec<usize>,
    right: Vec<T>,
    columns: Vec<T>,
}

/// A coordinate and the first of the unknowns it depends on.
#[derive(Clone, Copy, Debug)]
struct Row {
    of: Holdable,
    first: usize,
}

/// What is told of a configuration in one place.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Told {
    /// Whether M has full rank, so far as elimination tells.
    pub regular: bool,
    /// det(A N): zero at direct singularities; 1 where it is not told.
    pub direct: f64,
    /// The same for outputs: zero at inverse singularities.
    pub inverse: f64,
    /// Largest over smallest singular value of what moves out for what is put in.
    pub condition: f64,
}

impl<T: Factorable + Packed> Rates<T> {
    pub fn new(asked: &Asked) -> Self {
        let mechanism = asked.mechanism;
        let dimensions = mechanism.dimensions().map(&mut T::from_f64);
        let system = System::new(&dimensions, &Held::nothing(mechanism).map(T::from_f64));
        let place = |unknown: Unknown| {
            let place = system.unknowns().iter().position(|u| *u == unknown);
            place.expect("nothing is held")
        };
        let row = |of: &Holdable| Row {
            of: *of,
            first: match *of {
                Holdable::Joint(joint) => place(Unknown::Joint(joint)),
                Holdable::Coordinate(platform, _) | Holdable::Turn(platform, _) => {
                    place(Unknown::Twist {
                        platform,
                        component: 0,
                    })
                }
            },
        };
        let rows = |of: &[Holdable]| of.iter().map(row).collect::<Vec<Row>>();
        let whole = mechanism.platforms().is_empty();
        let unknowns = system.unknowns().iter().enumerate();
        let moved = unknowns.filter(|(_, unknown)| match **unknown {
            Unknown::Joint(joint) => whole && mechanism.joints()[joint].role != Role::Actuated,
            Unknown::Twist { .. } => true,
        });
        let moved = moved.map(|(i, _)| i).collect();
        let (all, columns) = (system.rows() + asked.held.len(), system.unknowns().len());
        Rates {
            qr: Qr::new(all, columns, asked.held.len()),
            held: rows(&asked.held),
            inputs: rows(&asked.inputs),
            outputs: match asked.holds(&asked.outputs) {
                true => Vec::new(),
                false => rows(&asked.outputs),
            },
            moved,
            right: vec![T::zero(); all],
            columns: vec![T::zero(); columns * asked.held.len()],
            work: system.work(),
            system,
        }
    }

    pub fn unknowns(&self) -> usize {
        self.system.unknowns().len()
    }

    fn slope(&self, row: Row, at: &Configuration<T>) -> Vec<T> {
        match row.of {
            Holdable::Joint(_) => vec![T::one()],
            Holdable::Coordinate(platform, c) => {
                let pose = at.platforms[platform].pose();
                c.slope(&pose).to_vec()
            }
            Holdable::Turn(_, axis) => {
                let one = |i: usize| {
                    if i == axis as usize {
                        T::one()
                    } else {
                        T::zero()
                    }
                };
                (0..6).map(one).collect()
            }
        }
    }

    /// Works N out and tells what follows from it, for each place.
    pub fn at(&mut self, at: &Configuration<T>) -> Vec<Told> {
        self.system.linearise(at, &mut self.work);
        let jacobian = self.system.dense_jacobian(&mut self.work);
        let (rows, n) = (self.system.rows(), self.held.len());
        let columns = self.unknowns();
        self.qr.reset(rows + n);
        for (j, column) in jacobian.chunks_exact(rows.max(1)).take(columns).enumerate() {
            self.qr.column_mut(j)[..rows].copy_from_slice(&column[..rows]);
        }
        for (i, row) in self.held.clone().into_iter().enumerate() {
            for (k, slope) in self.slope(row, at).into_iter().enumerate() {
                self.qr.column_mut(row.first + k)[rows + i] = slope;
            }
            self.qr.column_mut(columns + i)[rows + i] = T::one();
        }
        self.qr.factorise(1.0);
        for i in 0..n {
            self.right.copy_from_slice(self.qr.carried(i));
            let to = &mut self.columns[i * columns..(i + 1) * columns];
            self.qr.back_substitute(&mut self.right, to);
        }
        // unit rates come out again if the held coordinates are independent
        let back = self.matrix(&self.held.clone(), at);
        let input = self.matrix(&self.inputs.clone(), at);
        let output = self.matrix(&self.outputs.clone(), at);
        let moved: Vec<Vec<T>> = (0..n)
            .map(|j| {
                self.moved
                    .iter()
                    .map(|&i| self.columns[j * columns + i])
                    .collect()
            })
            .collect();
        let conditions = match self.inputs.is_empty() {
            true => vec![f64::INFINITY; T::WIDTH],
            false => condition(input.clone(), moved),
        };
        (0..T::WIDTH)
            .map(|place| {
                let unit = |i: usize, j: usize| f64::from(u8::from(i == j));
                let misses = back.iter().enumerate().flat_map(|(j, column)| {
                    let column = column.iter().enumerate();
                    column.map(move |(i, x)| (x.part(place) - unit(i, j)).abs())
                });
                let finite = |m: &[Vec<T>]| m.iter().flatten().all(|x| x.part(place).is_finite());
                // a NaN is not regular
                let regular = misses.fold(0.0, f64::max) < 1e-6 && finite(&back);
                Told {
                    regular,
                    direct: determinant(&input, place),
                    inverse: determinant(&output, place),
                    condition: conditions[place],
                }
            })
            .collect()
    }

    /// The motion for a unit rate of held coordinate `i`, in one place.
    pub fn motion(&self, i: usize, place: usize) -> Vec<f64> {
        let columns = self.unknowns();
        let column = &self.columns[i * columns..(i + 1) * columns];
        column.iter().map(|x| x.part(place)).collect()
    }

    /// The rates of coordinates, a column for each held one.
    fn matrix(&self, rows: &[Row], at: &Configuration<T>) -> Vec<Vec<T>> {
        let slopes: Vec<Vec<T>> = rows.iter().map(|row| self.slope(*row, at)).collect();
        let motions = self.columns.chunks_exact(self.unknowns().max(1));
        motions
            .map(|motion| {
                let rate = |(row, slope): (&Row, &Vec<T>)| {
                    let motion = &motion[row.first..row.first + slope.len()];
                    let products = motion.iter().zip(slope);
                    products.fold(T::zero(), |sum, (x, s)| sum + *x * *s)
                };
                rows.iter().zip(&slopes).map(rate).collect()
            })
            .collect()
    }
}

/// The determinant of a square matrix of columns in one place; 1 of none.
fn determinant<T: Packed>(columns: &[Vec<T>], place: usize) -> f64 {
    let n = columns.len();
    if columns.iter().any(|column| column.len() != n) {
        return 1.0;
    }
    nalgebra::DMatrix::from_fn(n, n, |i, j| columns[j][i].part(place)).determinant()
}

/// The condition number of the matrix that takes the columns of `input` to those of `moved`, in each
/// place: infinite if `input` loses rank.
///
/// With the singular value decomposition input = U Σ Vᵀ it is that of moved·V·Σ⁻¹. One-sided Jacobi
/// rotations (Hestenes 1958) do the same in every place, so that places side by side do not wait
/// for one another.
fn condition<T: Packed>(mut input: Vec<Vec<T>>, mut moved: Vec<Vec<T>>) -> Vec<f64> {
    rotate(&mut input, &mut moved);
    let sizes: Vec<T> = input.iter().map(|column| square(column).sqrt()).collect();
    let inputs = extremes(&sizes);
    for (column, size) in moved.iter_mut().zip(&sizes) {
        column.iter_mut().for_each(|x| *x = *x / *size);
    }
    rotate(&mut moved, &mut Vec::new());
    let sizes: Vec<T> = moved.iter().map(|column| square(column).sqrt()).collect();
    let quotient = |((least, greatest), of): (&(f64, f64), &(f64, f64))| {
        let lost = *least <= RANK_TOLERANCE * greatest || of.0 <= RANK_TOLERANCE * of.1;
        match lost || !of.1.is_finite() || of.0.is_nan() {
            true => f64::INFINITY,
            false => of.1 / of.0,
        }
    };
    inputs.iter().zip(&extremes(&sizes)).map(quotient).collect()
}

fn square<T: Packed>(column: &[T]) -> T {
    column.iter().fold(T::zero(), |sum, x| sum + *x * *x)
}

/// The least and the greatest, in each place.
fn extremes<T: Packed>(sizes: &[T]) -> Vec<(f64, f64)> {
    let of = |place: usize| {
        let parts = sizes.iter().map(|size| size.part(place));
        parts.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), x| {
            (
                if x < least { x } else { least },
                if x > most { x } else { most },
            )
        })
    };
    (0..T::WIDTH).map(of).collect()
}

/// Makes columns orthogonal to one another by rotations, which other columns go along with.
fn rotate<T: Packed>(columns: &mut [Vec<T>], with: &mut [Vec<T>]) {
    let n = columns.len();
    // two columns take one rotation; six are orthogonal to rounding after seven rounds
    let rounds = if n <= 2 { 1 } else { 3 + n / 2 + 1 };
    for _ in 0..rounds {
        for i in 0..n {
            for j in i + 1..n {
                let (a, b) = (square(&columns[i]), square(&columns[j]));
                let both = columns[i].iter().zip(&columns[j]);
                let c = both.fold(T::zero(), |sum, (x, y)| sum + *x * *y);
                let turn = |place: usize| {
                    let (a, b, c) = (a.part(place), b.part(place), c.part(place));
                    if c == 0.0 {
                        return 0.0;
                    }
                    let z = (b - a) / (2.0 * c);
                    1.0f64.copysign(z) / (z.abs() + (1.0 + z * z).sqrt())
                };
                let tan = T::of_parts(turn);
                let cos = T::one() / (T::one() + tan * tan).sqrt();
                let sin = cos * tan;
                let pair = |all: &mut [Vec<T>]| {
                    let (left, right) = all.split_at_mut(j);
                    for (x, y) in left[i].iter_mut().zip(&mut right[0]) {
                        (*x, *y) = (*x * cos - *y * sin, *x * sin + *y * cos);
                    }
                };
                pair(columns);
                if !with.is_empty() {
                    pair(with);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Lanes;

    #[test]
    fn conditions_are_those_of_a_singular_value_decomposition_in_every_lane() {
        for n in 1..=6usize {
            let entry = |i: usize, j: usize, k: usize| {
                (12.9898 * (i + 7 * j + 53 * k + 1) as f64).sin() * 43758.5453 % 1.0
            };
            let lanes = |rows: usize, shift: usize| -> Vec<Vec<Lanes>> {
                let column = |j| {
                    let row = |i| Lanes::of_parts(|k| entry(i, j, k + shift));
                    (0..rows).map(row).collect()
                };
                (0..n).map(column).collect()
            };
            let (input, moved) = (lanes(n, 0), lanes(6, 100));
            let found = condition(input.clone(), moved.clone());
            for (k, found) in found.into_iter().enumerate() {
                let input = nalgebra::DMatrix::from_fn(n, n, |i, j| input[j][i].0[k]);
                let moved = nalgebra::DMatrix::from_fn(6, n, |i, j| moved[j][i].0[k]);
                let values = (moved * input.try_inverse().unwrap()).singular_values();
                let exact = values[0] / values[n - 1];
                assert!((found / exact - 1.0).abs() < 1e-9, "{n}: {found} {exact}");
            }
        }
    }

    #[test]
    fn where_inputs_depend_on_one_another_the_condition_is_infinite() {
        let input = vec![vec![1.0, 2.0], vec![2.0, 4.0]];
        let moved = vec![vec![1.0, 0.0], vec![0.0, 1.0]];
        assert_eq!(condition::<f64>(input, moved), [f64::INFINITY]);
    }
}
