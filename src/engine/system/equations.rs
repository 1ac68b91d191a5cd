//! Closure equations of a mechanism and their Jacobian, block by block.

mod approach;
mod closure_gap;
mod closures;
mod coordinate;
mod course;
mod decomposed;
mod displacement;
mod holds;
mod layout;
mod parts;
mod plan;
mod rates;
mod settle;
mod spin;

pub use approach::approach;
pub use closure_gap::Gap;
pub use closures::{ClosureAxes, ClosureWrenches};
pub use coordinate::Coordinate;
pub(crate) use course::ConstantsCourse;
pub(crate) use holds::hold_rows;
pub use layout::{Held, HeldParts, HeldPlatform, Places, Unknown};
pub use parts::independent_parts;
pub use settle::{settle, solve};
pub use spin::Spin;

use plan::ClosurePlan;

use crate::linear::{Bordered, Factorable};
use crate::mechanism::{
    ClosureEquations, Configuration, Dimensions, EVERY_ROW, Frame, Kept, Kinematics, Mechanism,
    Mover, Need, Placement, PoseCoordinate, Side, needs,
};
use crate::solve::{Equations, Size};
pub(crate) use layout::{HoldRow, measured};

use layout::Layout;

/// The closure equations of a mechanism for one choice of held coordinates.
///
/// Rows and unknowns are dimensionless. A point is a [`Configuration`]; held joints and poses keep the values it has.
#[derive(Clone, Debug)]
pub struct System<T: Factorable> {
    kinematics: Kinematics<T>,
    closures: Vec<ClosureEquations<T>>,
    plans: Vec<ClosurePlan<T>>,
    unknowns: Vec<Unknown>,
    places: Places,
    joint_scales: Vec<f64>,
    length: f64,
    centre: [f64; 3],
    holds: Vec<HoldRow<T>>,
    empty: Bordered<T>,
}

/// Storage of a [`System`]: nothing in it outlives the question it was made for.
#[derive(Clone, Debug)]
pub struct SystemWork<T: Factorable> {
    placement: Placement<T>,
    residual: Vec<T>,
    jacobian: Bordered<T>,
    hold_rows: Vec<T>,
    step: Vec<T>,
}

impl<T: Factorable> System<T> {
    /// The equations for a choice of held coordinates.
    pub fn new(dimensions: &Dimensions<T>, held: &Held<T>) -> Self {
        System::whole(dimensions, held, &[])
    }

    /// Equations without rows that vanish everywhere, such as those across the plane of a loop: enough for iterations.
    /// To count rows or to assign forces to them, all are needed.
    pub fn reduced(mechanism: &Mechanism, dimensions: &Dimensions<T>, held: &Held<T>) -> Self {
        System::placing(mechanism, dimensions, held, &[])
    }

    /// As [`System::reduced`], with the poses of further frames placed in its work.
    pub fn placing(
        mechanism: &Mechanism,
        dimensions: &Dimensions<T>,
        held: &Held<T>,
        frames: &[Frame],
    ) -> Self {
        System::keeping(dimensions, held, mechanism.rows_that_vary(), frames)
    }

    /// All equations, with the poses of more frames than the closures need.
    pub fn whole(dimensions: &Dimensions<T>, held: &Held<T>, frames: &[Frame]) -> Self {
        let all = vec![EVERY_ROW; dimensions.closures.len()];
        System::keeping(dimensions, held, &all, frames)
    }

    /// With chosen rows of every closure.
    pub(crate) fn keeping(
        dimensions: &Dimensions<T>,
        held: &Held<T>,
        kept: &[Kept],
        frames: &[Frame],
    ) -> Self {
        let parts = || dimensions.closures.iter().zip(kept);
        let needed = parts()
            .flat_map(|(closure, kept)| closure.frames.into_iter().zip(needs(closure.kind, kept)));
        let more = frames.iter().map(|&frame| (frame, Need::Pose));
        let kinematics = Kinematics::needing(dimensions, needed.chain(more));
        let closures: Vec<ClosureEquations<T>> = parts()
            .map(|(closure, &kept)| ClosureEquations::new(dimensions, closure, &kinematics, kept))
            .collect();
        let layout = Layout::new(&closures, held);
        let holds = hold_rows(held, &dimensions.centre);
        let hold_count = holds.iter().map(HoldRow::rows).sum();
        let mut block_start = Vec::with_capacity(layout.blocks.len());
        let mut row = 0;
        for block in &layout.blocks {
            block_start.push(row);
            row += block.rows;
        }
        let plans = (closures.iter().zip(&layout.places))
            .map(|(closure, &place)| ClosurePlan::new(closure, &layout, place, &block_start))
            .collect();
        System {
            kinematics,
            closures,
            plans,
            joint_scales: dimensions.joint_scales.clone(),
            length: dimensions.characteristic_length,
            centre: dimensions.centre,
            empty: Bordered::new(
                layout.unknowns.len(),
                layout.blocks,
                hold_count,
                layout.shared,
            ),
            unknowns: layout.unknowns,
            places: layout.places_of_unknowns,
            holds,
        }
    }

    /// Storage for solving.
    pub fn work(&self) -> SystemWork<T> {
        SystemWork {
            placement: self.kinematics.placement(),
            residual: vec![T::zero(); self.empty.rows()],
            jacobian: self.empty.clone(),
            hold_rows: vec![T::zero(); self.empty.extra_rows() * self.empty.shared().len()],
            step: vec![T::zero(); self.unknowns.len()],
        }
    }

    /// The order in which its frames are placed.
    pub fn kinematics(&self) -> &Kinematics<T> {
        &self.kinematics
    }

    /// Places its frames, and evaluates nothing.
    pub fn place<'a>(
        &self,
        at: &Configuration<T>,
        work: &'a mut SystemWork<T>,
    ) -> &'a Placement<T> {
        self.kinematics.place(at, &mut work.placement);
        &work.placement
    }

    /// The frames as they were last placed.
    pub fn placement<'a>(&self, work: &'a SystemWork<T>) -> &'a Placement<T> {
        &work.placement
    }

    /// Adapts storage of a system that differs in its dimensions only; its factors stay as they are.
    pub fn refit(&self, work: &mut SystemWork<T>) {
        let [here, there] =
            [&self.empty, &work.jacobian].map(|j| j.blocks().iter().map(|filled| &filled.block));
        match here.eq(there) {
            true => {
                work.placement = self.kinematics.placement();
                // what affected a closure there need not affect it here
                work.jacobian.clear();
            }
            // a coefficient that is zero there and not here
            false => *work = self.work(),
        }
    }

    /// The unknowns in the order of the Jacobian's columns.
    pub fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    /// The place of an unknown among them, if it is one.
    #[inline]
    pub fn place_of(&self, unknown: Unknown) -> Option<usize> {
        self.places.of(unknown)
    }

    /// The natural size of a joint's variable: 1 rad, or the characteristic length in m.
    pub fn joint_scale(&self, joint: usize) -> f64 {
        self.joint_scales[joint]
    }

    /// The length in m that makes rows and unknowns dimensionless.
    pub fn characteristic_length(&self) -> f64 {
        self.length
    }

    /// For each closure the range of its rows.
    pub fn closure_rows(&self) -> impl Iterator<Item = std::ops::Range<usize>> {
        self.plans.iter().map(|plan| plan.row..plan.row + plan.rows)
    }

    /// For each closure the unknown joints that affect it: not those that carry both of its frames.
    pub fn joints_of_closures(&self) -> impl Iterator<Item = Vec<usize>> {
        self.plans.iter().map(|plan| {
            let carries = |(side, mover, _): &(Side, Mover<T>, usize)| {
                (plan.movers.iter()).any(|(other, same, _)| other != side && same == mover)
            };
            let movers = plan.movers.iter().filter(|mover| !carries(mover));
            let movers = movers.map(|(_, mover, _)| mover.joint);
            let extensions = plan.extensions.iter().map(|(joint, _)| *joint);
            movers.chain(extensions).collect()
        })
    }

    /// Number of rows: closure equations, then held platform coordinates.
    pub fn rows(&self) -> usize {
        self.empty.rows()
    }

    /// A value of a platform coordinate with positions measured from the centre, as in the equations.
    pub(crate) fn about_centre(&self, coordinate: PoseCoordinate, value: T) -> T {
        coordinate.about_centre(value, &self.centre)
    }

    /// Sets the value at which a platform coordinate is held.
    pub fn set_target(&mut self, platform: usize, coordinate: PoseCoordinate, value: T) {
        self.set_target_about_centre(platform, coordinate, self.about_centre(coordinate, value));
    }

    /// As [`System::set_target`], with a position measured from the centre.
    pub(crate) fn set_target_about_centre(
        &mut self,
        platform: usize,
        coordinate: PoseCoordinate,
        value: T,
    ) {
        for hold in &mut self.holds {
            if let HoldRow::Coordinate(p, c, target, _) = hold
                && (*p, *c) == (platform, coordinate)
            {
                *target = value;
            }
        }
    }

    /// The dimensionless residual last evaluated.
    pub fn residual_of<'a>(&self, work: &'a SystemWork<T>) -> &'a [T] {
        &work.residual
    }

    /// The rows of platform coordinates held at values, after those of the closures.
    pub fn hold_rows(&self) -> std::ops::Range<usize> {
        self.rows() - self.empty.extra_rows()..self.rows()
    }

    /// The Jacobian last evaluated, dense and column-major, rows × unknowns.
    pub fn dense_jacobian(&self, work: &SystemWork<T>) -> Vec<T> {
        let (rows, row) = (self.rows(), self.hold_rows().start);
        let mut dense = vec![T::zero(); rows * self.unknowns.len()];
        for (row, unknown, column) in work.jacobian.columns() {
            dense[unknown * rows + row..][..column.len()].copy_from_slice(column);
        }
        let shared = self.empty.shared();
        for (i, entries) in work.hold_rows.chunks_exact(shared.len().max(1)).enumerate() {
            for (&unknown, &entry) in shared.iter().zip(entries) {
                dense[unknown * rows + row + i] = entry;
            }
        }
        dense
    }

    fn jacobian_columns(&self, at: &Configuration<T>, work: &mut SystemWork<T>) {
        for (plan, closure) in self.plans.iter().zip(&self.closures) {
            let rows = closure.rows(&work.placement, at);
            let residual = &rows.residual[..plan.rows];
            work.residual[plan.row..plan.row + plan.rows].copy_from_slice(residual);
            let entries = work.jacobian.block_mut(plan.block);
            let place = |column: usize| {
                let start = column * plan.block_rows + plan.block_row;
                start..start + plan.rows
            };
            // what does not affect this closure is zero from the beginning
            for column in &plan.sums {
                entries[place(*column)].fill(T::zero());
            }
            for (side, mover, column) in &plan.movers {
                let (omega, v) = work.placement.twist(mover, rows.velocity_point(*side));
                rows.rates(*side, &omega, &v, &mut entries[place(*column)]);
            }
            for &(joint, column) in &plan.extensions {
                entries[place(column)][0] += closure.length_column(joint, at);
            }
            for (i, &(side, platform, column)) in plan.platforms.iter().enumerate() {
                // a closure may join two parts of one platform
                let again = plan.platforms[..i].iter().any(|of| of.1 == platform);
                let arm = *rows.velocity_point(side) - at.platforms[platform].position;
                rows.twist_rows(side, &arm, self.length, |i, row| {
                    for (k, entry) in row.into_iter().enumerate() {
                        let to = &mut entries[place(column + k).start + i];
                        *to = if again { *to + entry } else { entry };
                    }
                });
            }
        }
    }
}

impl<T: Factorable> Equations for System<T> {
    type Scalar = T;
    type Point = Configuration<T>;
    type Work = SystemWork<T>;

    #[inline]
    fn residual(&self, at: &Configuration<T>, work: &mut SystemWork<T>) -> Size {
        self.kinematics.place(at, &mut work.placement);
        for (plan, closure) in self.plans.iter().zip(&self.closures) {
            let out = &mut work.residual[plan.row..plan.row + plan.rows];
            closure.residual(&work.placement, at, out);
        }
        if !self.holds.is_empty() {
            self.hold_residuals(at, work);
        }
        Size::of(&work.residual)
    }

    #[inline]
    fn linearise(&self, at: &Configuration<T>, work: &mut SystemWork<T>) -> Size {
        self.kinematics.place(at, &mut work.placement);
        self.jacobian_columns(at, work);
        if !self.holds.is_empty() {
            self.hold_residuals(at, work);
        }
        Size::of(&work.residual)
    }

    #[inline]
    fn factorise(&self, damping: f64, work: &mut SystemWork<T>) {
        work.jacobian.factorise(&work.hold_rows, damping);
    }

    #[inline]
    fn step(&self, work: &mut SystemWork<T>) -> f64 {
        work.jacobian.solve(&work.residual, &mut work.step);
        Size::of(&work.step).largest
    }

    #[inline]
    fn step_mut<'a>(&self, work: &'a mut SystemWork<T>) -> &'a mut [T] {
        &mut work.step
    }

    #[inline]
    fn advance(
        &self,
        from: &Configuration<T>,
        fraction: f64,
        work: &SystemWork<T>,
        to: &mut Configuration<T>,
    ) {
        let step = &work.step;
        let joints = to.joints.iter_mut().zip(&from.joints).enumerate();
        for (joint, (to, from)) in joints {
            *to = self.moved_joint(joint, *from, step, fraction);
        }
        let platforms = to.platforms.iter_mut().zip(&from.platforms).enumerate();
        for (platform, (to, from)) in platforms {
            *to = self.moved_platform(platform, from, step, fraction);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::random_configuration;
    use rand::SeedableRng;

    #[test]
    fn rows_left_out_are_exactly_zero_everywhere_and_the_others_the_same_bit_for_bit() {
        let mut rng = rand_pcg::Pcg64Mcg::seed_from_u64(7);
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../mechanisms");
        let mut left_out = 0;
        for file in std::fs::read_dir(folder).unwrap() {
            let path = file.unwrap().path();
            let Ok((_, description)) = Mechanism::read(&path) else {
                continue;
            };
            let mechanism = Mechanism::new(&description).unwrap();
            let dimensions = mechanism.dimensions();
            let held = Held::nothing(&mechanism);
            let all = System::new(dimensions, &held);
            let few = System::reduced(&mechanism, dimensions, &held);
            if all.unknowns().len() > 100 {
                continue;
            }
            let kept = mechanism.rows_that_vary().iter().zip(mechanism.closures());
            let kept: Vec<bool> = kept
                .flat_map(|(kept, closure)| kept[..closure.kind.equations()].to_vec())
                .collect();
            left_out += kept.iter().filter(|kept| !**kept).count();
            // the rows of the closures, in the order of the file
            let rows = |system: &System<f64>, numbers: &[f64]| -> Vec<f64> {
                system
                    .closure_rows()
                    .flat_map(|rows| numbers[rows].to_vec())
                    .collect()
            };
            let evaluated = |system: &System<f64>, at: &Configuration<f64>| {
                let mut work = system.work();
                system.linearise(at, &mut work);
                let mut all = vec![rows(system, system.residual_of(&work))];
                let jacobian = system.dense_jacobian(&work);
                all.extend(
                    jacobian
                        .chunks_exact(system.rows().max(1))
                        .map(|column| rows(system, column)),
                );
                all
            };
            for _ in 0..3 {
                let at = random_configuration(&mechanism, &mechanism.home(), &mut rng);
                for (all, few) in evaluated(&all, &at).iter().zip(evaluated(&few, &at)) {
                    let (some, none): (Vec<_>, Vec<_>) =
                        all.iter().zip(&kept).partition(|(_, kept)| **kept);
                    assert!(none.iter().all(|(x, _)| **x == 0.0), "{path:?} {none:?}");
                    let some: Vec<f64> = some.into_iter().map(|(x, _)| *x).collect();
                    assert_eq!(some, few, "{path:?}");
                }
            }
        }
        assert!(left_out > 50, "{left_out}");
    }
}
