//! Rates of the equations, for following a solution while the inputs change.

use super::layout::{HoldRow, measured};
use super::{System, SystemWork};
use crate::geometry::Rotation;
use crate::linear::{CANCELLED, Factorable, Qr, RANK_TOLERANCE};
use crate::mechanism::PoseCoordinate;
use crate::mechanism::{Configuration, Side};
use crate::number::tolerance::SUMMED;
use crate::solve::Equations;

impl<T: Factorable> System<T> {
    /// The rates of all rows where frames were last placed, in place of the residual: for rates of all joints, then of
    /// the twist components of all platforms. What platform coordinates are held at stands still.
    pub fn row_rates<'a>(
        &self,
        at: &Configuration<T>,
        rates: &[T],
        work: &'a mut SystemWork<T>,
    ) -> &'a mut [T] {
        let twist = |platform: usize| {
            let first = self.joint_scales.len() + 6 * platform;
            &rates[first..first + 6]
        };
        for (plan, closure) in self.plans.iter().zip(&self.closures) {
            let rows = closure.rows(&work.placement, at);
            let out = &mut work.residual[plan.row..plan.row + plan.rows];
            out.fill(T::zero());
            let sides = closure.movers.iter().zip(closure.platforms);
            for (side, (movers, platform)) in [Side::A, Side::B].into_iter().zip(sides) {
                let moving = movers.iter().map(|mover| (mover, rates[mover.joint]));
                let moving = moving.filter(|(_, rate)| *rate != T::zero());
                let platform = platform.map(|platform| (platform, twist(platform)));
                let point = rows.velocity_point(side);
                let (omega, v) = (work.placement).carried(moving, platform, point, self.length);
                rows.rates(side, &omega, &v, out);
            }
            for &joint in &plan.extending {
                out[0] += closure.length_column(joint, at) * rates[joint];
            }
        }
        let mut row = self.hold_rows().start;
        for hold in &self.holds {
            let out = &mut work.residual[row..row + hold.rows()];
            let along = |slope: &[T], twist: &[T]| {
                let products = slope.iter().zip(twist).map(|(s, t)| *s * *t);
                products.fold(T::zero(), |sum, x| sum + x)
            };
            match hold {
                HoldRow::Coordinate(platform, coordinate, _, reference) => {
                    let pose = measured(work.placement.pose(1 + platform), reference);
                    let slope = coordinate.slope(&pose);
                    out[0] = along(&slope, twist(*platform));
                }
                HoldRow::Spin(spin) => {
                    let (_, slope) = spin.row(&at.platforms[spin.platform].orientation);
                    out[0] = along(&slope, twist(spin.platform));
                }
                // the deviation from where it is at this instant
                HoldRow::Orientation(platform, _) => out.copy_from_slice(&twist(*platform)[..3]),
            }
            row += hold.rows();
        }
        &mut work.residual
    }

    /// Makes rates of angles, as [`row_rates`](Self::row_rates) finds them, rates of the rows: over numbers that are not
    /// real these rows are entire, and change cos(pitch) times as fast where they vanish.
    pub fn stretch_angle_rates(&self, work: &mut SystemWork<T>) {
        if T::REAL {
            return;
        }
        let mut row = self.hold_rows().start;
        for hold in &self.holds {
            if let HoldRow::Coordinate(platform, coordinate, _, reference) = hold
                && coordinate.is_angle()
            {
                let pose = measured(work.placement.pose(1 + platform), reference);
                let [x, y, _] = pose.rotation.0[0].0;
                work.residual[row] *= (x * x + y * y).sqrt();
            }
            row += hold.rows();
        }
    }

    /// For each platform angle held by itself a number that is positive at its value, and negative half a turn from
    /// there, which the entire rows also allow.
    pub fn sides_of_angles(&self, work: &SystemWork<T>) -> Vec<T> {
        let side = |hold: &HoldRow<T>| match hold {
            HoldRow::Coordinate(platform, coordinate, value, reference) => {
                let pose = measured(work.placement.pose(1 + platform), reference);
                coordinate.along(&pose.rotation, *value)
            }
            _ => None,
        };
        self.holds.iter().filter_map(side).collect()
    }

    /// The residual as it stands, to be replaced.
    pub fn residual_mut<'a>(&self, work: &'a mut SystemWork<T>) -> &'a mut [T] {
        &mut work.residual
    }

    /// The step last computed, in the order of the unknowns, dimensionless.
    pub fn step_of<'a>(&self, work: &'a SystemWork<T>) -> &'a [T] {
        &work.step
    }

    /// The step −J⁺r for another residual and the factors last made.
    pub fn step_for(&self, residual: &[T], work: &mut SystemWork<T>) -> f64 {
        work.residual.copy_from_slice(residual);
        self.step(work)
    }

    /// Divides equations by the length of their row of the Jacobian where that exceeds 1, and writes these factors down:
    /// relative to long rows the pivots of others would seem lost.
    pub fn shorten_rows(&self, work: &mut SystemWork<T>, factors: &mut [f64]) {
        let width = self.empty.shared().len().max(1);
        let mut first = 0;
        for b in 0..self.empty.blocks().len() {
            let rows = self.empty.blocks()[b].block.rows;
            let entries = work.jacobian.block_mut(b);
            for r in 0..rows {
                factors[first + r] = shorten(entries, r, rows);
            }
            first += rows;
        }
        for (row, factor_of) in work
            .hold_rows
            .chunks_exact_mut(width)
            .zip(&mut factors[first..])
        {
            *factor_of = shorten(row, 0, 1);
        }
        for (row, factor) in work.residual.iter_mut().zip(factors) {
            *row = row.scale(*factor);
        }
    }

    /// The row of a platform coordinate that is held at a value by itself.
    pub fn coordinate_row(&self, platform: usize, coordinate: PoseCoordinate) -> Option<usize> {
        self.hold_row(|hold| {
            matches!(hold, HoldRow::Coordinate(p, c, ..) if (*p, *c) == (platform, coordinate))
        })
    }

    /// The first of the three rows of a platform's orientation that is held whole.
    pub fn orientation_row(&self, platform: usize) -> Option<usize> {
        self.hold_row(|hold| matches!(hold, HoldRow::Orientation(p, _) if *p == platform))
    }

    fn hold_row(&self, wanted: impl Fn(&HoldRow<T>) -> bool) -> Option<usize> {
        let at = self.holds.iter().position(wanted)?;
        let before = self.holds[..at].iter().map(HoldRow::rows);
        Some(self.hold_rows().start + before.sum::<usize>())
    }

    /// Factorises the Jacobian last evaluated where solutions are known to be isolated, however badly they are
    /// determined: only pivots that rounding loses are.
    pub fn factorise_isolated(&self, work: &mut SystemWork<T>) {
        work.jacobian.trust(SUMMED);
        work.jacobian.factorise(&work.hold_rows, 0.0);
        work.jacobian.trust(RANK_TOLERANCE);
    }

    /// Number of unknowns that the factors last made leave undetermined.
    pub fn undetermined(&self, work: &SystemWork<T>) -> usize {
        work.jacobian.nullity()
    }

    /// Sets the orientation at which a platform is held.
    pub fn set_orientation(&mut self, platform: usize, wanted: Rotation<T>) {
        for hold in &mut self.holds {
            if let HoldRow::Orientation(p, target) = hold
                && *p == platform
            {
                *target = wanted;
            }
        }
    }

    /// The largest and the smallest pivot of a factorisation of the Jacobian last evaluated: their quotient measures
    /// how near it is to losing rank. The smallest is zero when there are more unknowns than rows.
    ///
    /// Rows and columns longer than 1 are shortened first: complex rotations and positions have no bound.
    pub fn pivots(&self, work: &SystemWork<T>) -> (f64, f64) {
        let (rows, columns) = (self.rows(), self.unknowns().len());
        let mut dense = self.dense_jacobian(work);
        for r in 0..rows {
            shorten(&mut dense, r, rows);
        }
        for column in dense.chunks_exact_mut(rows.max(1)) {
            shorten(column, 0, 1);
        }
        let pivots = pivots_of(rows, columns, &dense);
        match (columns, pivots.len()) {
            (0, _) => (1.0, 1.0),
            (n, rank) if rank == n => (pivots[0], pivots[n - 1]),
            (_, 0) => (0.0, 0.0),
            _ => (pivots[0], 0.0),
        }
    }

    /// Number of independent directions that the Jacobian maps to pivots smaller than `tolerance` times the largest, or
    /// to rounding.
    pub fn nullity(&self, tolerance: f64, work: &SystemWork<T>) -> usize {
        let (rows, columns) = (self.rows(), self.unknowns().len());
        let pivots = pivots_of(rows, columns, &self.dense_jacobian(work));
        let counts = |pivot: &&f64| **pivot > (tolerance * pivots[0]).max(CANCELLED);
        columns - pivots.iter().filter(counts).count()
    }
}

/// The pivots of an orthogonal factorisation that count.
fn pivots_of<T: Factorable>(rows: usize, columns: usize, dense: &[T]) -> Vec<f64> {
    let mut qr = Qr::new(rows, columns, 0);
    qr.load(rows, dense);
    qr.factorise(0.0);
    let size = |k: usize| qr.column(k)[k].norm_squared().sqrt();
    (0..qr.rank()).map(size).collect()
}

/// Shortens the vector of every so many of some entries if it is longer than 1, by the factor returned.
fn shorten<T: Factorable>(entries: &mut [T], first: usize, step: usize) -> f64 {
    let own = entries.iter().skip(first).step_by(step);
    let squares: f64 = own.map(|x| x.norm_squared()).sum();
    let factor = 1.0 / squares.max(1.0).sqrt();
    if factor < 1.0 {
        let own = entries.iter_mut().skip(first).step_by(step);
        own.for_each(|x| *x = x.scale(factor));
    }
    factor
}
