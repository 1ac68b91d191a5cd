//! The assembled configurations of a mechanism with one freedom left, as a curve.

mod complex;
mod ending;
mod locus;
mod trace;
mod tracker;
mod walk;

pub use complex::ComplexCurve;
pub use ending::{NoStart, SweepEnd};
pub use locus::{LocusCurve, Singular};
pub use trace::{ConfigurationCurve, LocusEnd, Region, Traced, met_at, neared, settled};
pub use tracker::MotionTracker;
pub use walk::{Event, Monitor, Segment, Walk};

use serde::{Deserialize, Serialize};

use super::equations::{System, SystemWork};
use crate::algebra::SiUnit;
use crate::linear::RowGroup;
use crate::mechanism::{Configuration, ConfigurationRef, Mechanism, turn_near};
use crate::number::tolerance::ROUNDING;
use crate::solve::{Continuation, CurvePoint, Equations, SolutionCurve, StepFailure};
use crate::system::{Coordinate, Held, Unknown};

/// A coordinate that moves along a segment, in m or rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven {
    /// The coordinate.
    pub coordinate: Coordinate,
    /// Its value at the start of the segment.
    pub from: f64,
    /// Its value at the end.
    pub to: f64,
}

impl Driven {
    /// The value where a part of the segment is gone; the ends themselves without rounding.
    pub fn at(&self, part: f64) -> f64 {
        match part {
            0.0 => self.from,
            1.0 => self.to,
            _ => self.from + part * (self.to - self.from),
        }
    }
}

/// Range of a coordinate that moves, of a side of a box, or of a number that is sought.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Bound {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: SiUnit,
    /// Its value at the start of a segment, otherwise the least.
    pub from: f64,
    /// Its value at the end, otherwise the greatest.
    pub to: f64,
}

impl Bound {
    pub(crate) fn new(mechanism: &Mechanism, driven: &Driven) -> Self {
        Bound {
            name: driven.coordinate.name(mechanism),
            unit: SiUnit::of_coordinate(driven.coordinate.is_angle(mechanism)),
            from: driven.from,
            to: driven.to,
        }
    }
}

/// The closure equations with one freedom left: nothing but that freedom is to be chosen.
///
/// Inputs that move together along a segment are unknowns too, tied by one row less than there are inputs. Unknowns are
/// those of [`System`]: rad and characteristic lengths.
#[derive(Clone, Debug)]
pub struct Curve {
    system: System<f64>,
    work: SystemWork<f64>,
    inputs: Vec<Driven>,
    /// The input that measures the part of the segment that is gone.
    measure: usize,
    /// For each joint the number of turns after which the mechanism is as before; `None` if there is none.
    cycles: Vec<Option<f64>>,
}

impl Curve {
    /// The curve that is left when `held` is held. It must leave one freedom.
    pub fn new(mechanism: &Mechanism, held: &Held<f64>) -> Self {
        Curve::along(mechanism, held, Vec::new())
    }

    /// The curve on which the inputs move together along a segment. `held` holds none of them.
    pub fn along(mechanism: &Mechanism, held: &Held<f64>, inputs: Vec<Driven>) -> Self {
        let system = System::new(mechanism.dimensions(), held);
        // an angle of a platform jumps, a joint does not
        let measures = |input: &Driven| {
            let preferred = match input.coordinate {
                Coordinate::Joint(_) => 2.0,
                of if of.is_angle(mechanism) => 0.1,
                _ => 1.0,
            };
            preferred * (input.to - input.from).abs() / input.coordinate.scale(mechanism)
        };
        let measure = (0..inputs.len())
            .max_by(|&i, &j| measures(&inputs[i]).total_cmp(&measures(&inputs[j])))
            .unwrap_or(0);
        Curve {
            work: system.work(),
            system,
            inputs,
            measure,
            cycles: Curve::cycles_of(mechanism),
        }
    }

    /// For each joint the number of turns after which the mechanism is as before; `None` if there is none.
    fn cycles_of(mechanism: &Mechanism) -> Vec<Option<f64>> {
        let joints = 0..mechanism.joints().len();
        joints
            .map(|joint| mechanism.turns_to_repeat(joint))
            .collect()
    }

    /// The closure equations.
    pub fn system(&self) -> &System<f64> {
        &self.system
    }

    /// The inputs that move along the segment.
    pub fn inputs(&self) -> &[Driven] {
        &self.inputs
    }

    /// The part of the segment that is gone; 0 without inputs.
    pub fn part(&self, at: &Configuration<f64>) -> f64 {
        let Some(input) = self.inputs.get(self.measure) else {
            return 0.0;
        };
        let change = input.to - input.from;
        match input.coordinate {
            Coordinate::Joint(joint) => (at.joints[joint] - input.from) / change,
            of => {
                let gap = self.gap(of, at, 0.5 * (input.from + input.to));
                0.5 + gap * self.unit(of) / change
            }
        }
    }

    /// Excess of a coordinate over a value, in rad or characteristic lengths.
    fn gap(&self, of: Coordinate, at: &Configuration<f64>, value: f64) -> f64 {
        match of {
            Coordinate::Joint(joint) => (at.joints[joint] - value) / self.unit(of),
            Coordinate::Pose(platform, c) => {
                let length = self.system.characteristic_length();
                let value = self.system.about_centre(c, value);
                c.row(&at.platforms[platform].pose(), value, length).0
            }
            Coordinate::Turn(..) => 0.0,
        }
    }

    /// The place where a motion begins. `start` is brought within limits by whole turns, with driven
    /// joints where their segment begins.
    ///
    /// # Errors
    /// If no motion can begin there.
    pub fn begin(
        &mut self,
        mechanism: &Mechanism,
        start: &mut Configuration<f64>,
        method: &Continuation,
    ) -> Result<CurvePoint<Configuration<f64>>, NoStart> {
        mechanism.turn_to_limits(&mut start.joints);
        for input in &self.inputs {
            if let Coordinate::Joint(joint) = input.coordinate {
                start.joints[joint] = input.from;
            }
        }
        if let Some(joint) = mechanism.outside_limits(&start.joints).next() {
            return Err(NoStart::OutsideLimits(joint));
        }
        match method.settle(self, start.clone()) {
            Ok(place) if !place.is_beside_a_crossing() => Ok(place),
            Err(StepFailure::NotClosed) => Err(NoStart::NotClosed),
            _ => Err(NoStart::Singular),
        }
    }

    /// A place followed towards the end of the segment, and true if the inputs turn back there.
    pub fn towards_end(
        &self,
        place: CurvePoint<Configuration<f64>>,
    ) -> (CurvePoint<Configuration<f64>>, bool) {
        let rate = self.part_rate(&place.at, &place.tangent);
        let place = if rate < 0.0 { place.reversed() } else { place };
        (place, rate.abs() < ROUNDING)
    }

    /// Rate of the part of the segment that is gone, per unit step along a tangent; 0 without inputs.
    pub fn part_rate(&self, at: &Configuration<f64>, tangent: &[f64]) -> f64 {
        self.inputs.get(self.measure).map_or(0.0, |input| {
            self.rate(at, tangent, input.coordinate) * self.unit(input.coordinate)
                / (input.to - input.from)
        })
    }

    /// Rate of a coordinate along a tangent, in rad or characteristic lengths; 0 if it is held.
    pub fn rate(&self, at: &Configuration<f64>, tangent: &[f64], of: Coordinate) -> f64 {
        let slope = of.slope_in(&self.system, at);
        slope
            .iter()
            .map(|&(column, slope)| slope * tangent[column])
            .sum()
    }

    /// Column of a joint among the unknowns; `None` if it is held.
    pub fn column(&self, joint: usize) -> Option<usize> {
        self.system.place_of(Unknown::Joint(joint))
    }

    /// rad or m in one unit of the scaled coordinate.
    fn unit(&self, of: Coordinate) -> f64 {
        match of {
            Coordinate::Joint(joint) => self.system.joint_scale(joint),
            Coordinate::Pose(_, c) if !c.is_angle() => self.system.characteristic_length(),
            Coordinate::Pose(..) | Coordinate::Turn(..) => 1.0,
        }
    }

    /// The rows that tie the inputs together: each is where the segment has it.
    fn ties(&self, at: &Configuration<f64>) -> Vec<(f64, Vec<(usize, f64)>)> {
        let (part, mut ties) = (self.part(at), Vec::new());
        for (i, input) in self.inputs.iter().enumerate() {
            if i == self.measure {
                continue;
            }
            let (of, measure) = (input.coordinate, &self.inputs[self.measure]);
            let ratio = (input.to - input.from) / self.unit(of) * self.unit(measure.coordinate)
                / (measure.to - measure.from);
            let mut slope = of.slope_in(&self.system, at);
            let other = measure.coordinate.slope_in(&self.system, at);
            slope.extend(other.into_iter().map(|(c, s)| (c, -ratio * s)));
            ties.push((self.gap(of, at, input.at(part)), slope));
        }
        ties
    }

    /// Distances of a configuration from a place, along its tangent and across it. Nothing allocates.
    #[inline]
    pub fn offset(
        &self,
        from: &CurvePoint<Configuration<f64>>,
        to: &Configuration<f64>,
    ) -> (f64, f64) {
        let (mut along, mut squares) = (0.0, 0.0);
        (self.system).each_difference(from.at.view(), to.view(), |i, x| {
            along += x * from.tangent[i];
            squares += x * x;
        });
        (along, (squares - along * along).max(0.0).sqrt())
    }

    /// The step from one configuration to another without whole turns that change nothing.
    pub fn difference_but_turns(
        &self,
        from: &Configuration<f64>,
        to: &Configuration<f64>,
    ) -> Vec<f64> {
        let mut step = vec![0.0; self.system.unknowns().len()];
        self.difference_but_turns_into(from.view(), to.view(), &mut step);
        step
    }

    /// As [`Curve::difference_but_turns`], into a slice as long as there are unknowns.
    pub fn difference_but_turns_into(
        &self,
        from: ConfigurationRef<f64>,
        to: ConfigurationRef<f64>,
        step: &mut [f64],
    ) {
        self.system.difference_into(from, to, step);
        for (x, unknown) in step.iter_mut().zip(self.system.unknowns()) {
            if let Unknown::Joint(joint) = *unknown
                && let Some(turns) = self.cycles[joint]
            {
                *x = turns * turn_near(*x / turns, 0.0);
            }
        }
    }
}

impl SolutionCurve for Curve {
    type Point = Configuration<f64>;

    fn unknowns(&self) -> usize {
        self.system.unknowns().len()
    }

    fn residual(&mut self, at: &Configuration<f64>) -> Vec<f64> {
        self.system.residual(at, &mut self.work);
        let mut residual = self.system.residual_of(&self.work).to_vec();
        residual.extend(self.ties(at).into_iter().map(|(gap, _)| gap));
        residual
    }

    fn linearise(&mut self, at: &Configuration<f64>) -> (Vec<f64>, Vec<f64>) {
        self.system.linearise(at, &mut self.work);
        let mut residual = self.system.residual_of(&self.work).to_vec();
        let jacobian = self.system.dense_jacobian(&self.work);
        if self.inputs.len() < 2 {
            return (residual, jacobian);
        }
        let ties = self.ties(at);
        let (rows, more) = (residual.len(), ties.len());
        let mut extended = vec![0.0; (rows + more) * self.unknowns()];
        let columns = extended.chunks_exact_mut(rows + more);
        for (to, from) in columns.zip(jacobian.chunks_exact(rows.max(1))) {
            to[..rows].copy_from_slice(&from[..rows]);
        }
        for (i, (gap, slope)) in ties.into_iter().enumerate() {
            residual.push(gap);
            for (column, slope) in slope {
                extended[column * (rows + more) + rows + i] += slope;
            }
        }
        (residual, extended)
    }

    fn linearise_groups(&mut self, at: &Configuration<f64>) -> Option<(Vec<f64>, Vec<RowGroup>)> {
        if !self.system.is_large() {
            return None;
        }
        self.system.linearise(at, &mut self.work);
        let mut residual = self.system.residual_of(&self.work).to_vec();
        let mut groups = self.system.jacobian_rows(&self.work);
        for (gap, slope) in self.ties(at) {
            residual.push(gap);
            groups.push(RowGroup::single(slope));
        }
        Some((residual, groups))
    }

    fn displaced(&self, at: &Configuration<f64>, step: &[f64]) -> Configuration<f64> {
        self.system.displaced(at, step)
    }

    fn difference(&self, from: &Configuration<f64>, to: &Configuration<f64>) -> Vec<f64> {
        self.system.difference(from, to)
    }
}
