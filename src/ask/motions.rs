//! Motions that can begin, and their reports.

use std::cell::Cell;
use std::f64::consts::{PI, TAU};

use super::quantities::{Block, Course, Extremes, Meter, Metered, Passage, Seen};
use crate::algebra::SiUnit;
use crate::analysis::sweep::{
    Columns, Dwell, Extremum, KeptRows, MotionReport, MotionsReport, Paths, Row, Schedule, Sink,
    Straightness, SweepReport, SweepSettings, dwell, sweep,
};
use crate::mechanism::{Configuration, Mechanism, NamedPoint, Quantity, Variable};
use crate::solve::Watch;
use crate::system::{Coordinate, Driven, Held, Moved};

/// What is sought between the rows of a motion.
#[derive(Default)]
struct Located {
    extremes: Vec<Extremum>,
    straightness: Vec<Straightness>,
    dwells: Vec<Dwell>,
}

/// Motions that can begin: of one mode or of several.
#[derive(Clone, Debug)]
pub struct Motions<'q> {
    pub(super) mechanism: &'q Mechanism,
    pub(super) held: Held<f64>,
    pub(super) settings: SweepSettings,
    pub(super) metered: Metered<'q>,
    /// Quantities that may dwell, by their numbers, with tolerances.
    pub(super) dwells: Vec<(usize, f64)>,
    /// Where each begins, with the number of its mode if one was asked for.
    pub starts: super::Modes,
    /// What moved most from the values guessed to where the motion begins.
    pub(super) moved: Option<Moved>,
}

impl Motions<'_> {
    /// The inputs; none where the whole curve is followed.
    pub fn inputs(&self) -> &[Driven] {
        &self.metered.inputs
    }

    /// The points that are traced.
    pub fn points(&self) -> &[NamedPoint] {
        &self.settings.points
    }

    /// What the columns of rows are.
    pub fn columns(&self) -> Columns {
        Columns::new(self.mechanism, self.points(), self.quantities())
    }

    /// What the columns of quantities are: the time if any is asked for and inputs move, then these.
    pub fn quantities(&self) -> Vec<Variable> {
        let of = |quantity: &Quantity| Variable::new(&quantity.name, quantity.unit);
        let quantities: Vec<Variable> = self.metered.quantities.iter().map(of).collect();
        let timed = !quantities.is_empty() && !self.metered.inputs.is_empty();
        let time = timed.then(|| Variable::new("time", SiUnit::SECOND));
        time.into_iter().chain(quantities).collect()
    }

    /// The part of the time that is gone where the inputs are; those that follow a table are past this number of steps.
    fn time(&self, at: &Configuration<f64>, step: usize) -> f64 {
        if let Some(schedule) = &self.settings.schedule {
            let inputs = schedule.between(&self.metered.inputs, step, self.settings.steps);
            let size = |of: &Driven| (of.to - of.from).abs() / of.coordinate.scale(self.mechanism);
            let most = (inputs.iter()).max_by(|a, b| size(a).total_cmp(&size(b)));
            let gone = most.map_or(0.0, |of| {
                (of.coordinate.of(self.mechanism, at) - of.from) / (of.to - of.from)
            });
            let gone = if gone.is_finite() { gone } else { 0.0 };
            return (step as f64 + gone.clamp(0.0, 1.0)) / self.settings.steps as f64;
        }
        let joint = |input: &&Driven| matches!(input.coordinate, Coordinate::Joint(_));
        let measure = self
            .metered
            .inputs
            .iter()
            .find(joint)
            .or(self.metered.inputs.first());
        let part = measure.map_or(0.0, |input| {
            let way = input.to - input.from;
            let gone = input.coordinate.of(self.mechanism, at) - input.from;
            match input.coordinate {
                Coordinate::Joint(_) => gone / way,
                // an angle of a platform is known modulo a turn
                of if of.is_angle(self.mechanism) => {
                    let middle = 0.5 * way;
                    (middle + (gone - middle + PI).rem_euclid(TAU) - PI) / way
                }
                _ => gone / way,
            }
        });
        self.settings.pace.law.inverse(part.clamp(0.0, 1.0))
    }

    /// The same with rows between those asked for, so near to one another that a line through them looks smooth.
    #[must_use]
    pub fn smooth(mut self, smooth: bool) -> Self {
        self.settings.between = smooth;
        self
    }

    /// Moves from every start and keeps no more than `most` rows of each motion. All rows go to `sink` as they are
    /// found, with the number of their mode.
    pub fn report(
        &self,
        most: usize,
        sink: &mut dyn FnMut(Option<usize>, &Row),
        watch: &Watch,
    ) -> MotionsReport {
        let columns = self.columns();
        let mut motions = Vec::new();
        for (mode, start) in &self.starts {
            let mut rows = KeptRows::of(most);
            let mut take = |row: &Row| {
                if row.between {
                    sink(*mode, row);
                    return;
                }
                rows.take(&columns, row);
                sink(*mode, row);
            };
            let (sweep, located) = self.measured(start, &mut take, watch);
            let interrupted = sweep.interrupted;
            motions.push(MotionReport {
                mode: *mode,
                sentence: String::new(),
                sweep,
                pace: (!self.metered.inputs.is_empty()).then_some(self.settings.pace),
                table: self.settings.schedule.as_ref().map(Schedule::rows),
                extremes: located.extremes,
                straightness: located.straightness,
                dwells: located.dwells,
                columns: columns.variables().to_vec(),
                values: rows.finished(),
            });
            if interrupted {
                break;
            }
        }
        MotionsReport {
            mechanism: self.mechanism.name().to_owned(),
            moved: self.moved.clone(),
            motions,
        }
    }

    /// Moves from one of the starts. Rows go to `sink` as they are found.
    pub fn run(&self, start: &Configuration<f64>, sink: &mut Sink, watch: &Watch) -> SweepReport {
        self.measured(start, sink, watch).0
    }

    /// The same with what is sought between rows too.
    fn measured(
        &self,
        start: &Configuration<f64>,
        sink: &mut Sink,
        watch: &Watch,
    ) -> (SweepReport, Located) {
        let wanted = self.settings.straightness || !self.dwells.is_empty();
        if self.metered.quantities.is_empty() && !wanted {
            let moved = self.moved(start, sink, watch);
            return (moved, Located::default());
        }
        let mut meter = Meter::new(&self.metered, start);
        let mut extremes = Extremes::new(self.metered.quantities.len());
        let timed = !self.metered.inputs.is_empty() && !self.metered.quantities.is_empty();
        let mut values = Vec::new();
        let mut all: Vec<Seen> = Vec::new();
        let steps = self.settings.steps as f64;
        let latest = Cell::new(0);
        let mut take = |block: &Block| {
            extremes.take(block);
            for i in 0..block.len() {
                let (row, time) = block.row(i);
                if wanted && !row.between {
                    all.push(Seen::of(block, i));
                }
                values.clear();
                values.extend(timed.then_some(Some(time * self.settings.pace.duration)));
                values.extend(block.values(i));
                sink(&Row {
                    quantities: &values,
                    ..row
                });
            }
        };
        let mut measured = |row: &Row| {
            let at = row.configuration;
            latest.set(row.step.unwrap_or(latest.get()));
            let time = row
                .step
                .map_or_else(|| self.time(at, latest.get()), |step| step as f64 / steps);
            meter.read_row(row, time, &mut take);
        };
        let report = self.moved(start, &mut measured, watch);
        meter.read_waiting(&mut take);
        let passage = Passage {
            mechanism: self.mechanism,
            held: &self.held,
            inputs: &self.metered.inputs,
            schedule: self.settings.schedule.as_ref(),
            time: &|at| self.time(at, latest.get()),
        };
        let dwells = self.dwells.iter().filter_map(|(quantity, tolerance)| {
            let mut course = Course::new(passage, &all);
            let (value, places) = dwell(all.len(), *tolerance, &mut |place| {
                meter.settle(&course.row(place).values);
                let (at, when) = course.at(place)?;
                Some([when, meter.read(at, when)[*quantity]?])
            })?;
            let [begin, end] = places.map(|place| {
                let found = course.at(place);
                found.map(|(at, when)| (when, passage.inputs(at)))
            });
            let ((begin, from), (end, to)) = (begin?, end?);
            let of = &self.metered.quantities[*quantity];
            Some(Dwell {
                name: of.name.clone(),
                unit: of.unit,
                tolerance: *tolerance,
                value,
                times: [begin, end],
                inputs: [from, to],
            })
        });
        let dwells = dwells.collect();
        let points = self.points().iter().filter(|_| self.settings.straightness);
        let straightness = points.filter_map(|named| {
            let mut paths = Paths::new(self.mechanism, std::slice::from_ref(named));
            let mut course = Course::new(passage, &all);
            Straightness::along(&named.name, all.len(), &mut |place| {
                paths.place(course.at(place)?.0);
                Some(paths.at[0])
            })
        });
        let located = Located {
            straightness: straightness.collect(),
            dwells,
            extremes: extremes.located(&self.metered.quantities, passage, &mut meter),
        };
        (report, located)
    }

    fn moved(&self, start: &Configuration<f64>, sink: &mut Sink, watch: &Watch) -> SweepReport {
        let (mechanism, held, inputs) = (self.mechanism, &self.held, self.inputs());
        sweep(mechanism, held, inputs, start, &self.settings, sink, watch)
    }
}
