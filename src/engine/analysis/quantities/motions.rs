//! Motions that can begin, and their reports.

use super::course::{Course, Sought};
use super::extremes::located;
use super::meter::{Meter, MeterBlock, Metered, Name};
use crate::algebra::SiUnit;
use crate::analysis::sweep::{
    Columns, Dwell, Extremum, KeptRows, MetKind, MotionReport, MotionsReport, Passage, Paths, Row,
    Schedule, Sink, Straightness, SweepReport, SweepSettings, dwell, sweep,
};
use crate::mechanism::{
    Configuration, Measured, Mechanism, NamedPoint, Order, PoseCoordinate, Quantity, Variable,
};
use crate::solve::Watch;
use crate::system::{Driven, Held, Moved};

/// Results located between the rows of a motion.
#[derive(Default)]
struct Located {
    extremes: Vec<Extremum>,
    straightness: Vec<Straightness>,
    dwells: Vec<Dwell>,
}

/// Motions that can begin: of one mode or of several.
#[derive(Clone, Debug)]
pub struct Motions<'q> {
    pub(crate) mechanism: &'q Mechanism,
    pub(crate) held: Held<f64>,
    pub(crate) settings: SweepSettings,
    pub(crate) metered: Metered<'q>,
    /// Quantities that may dwell, by their numbers, with tolerances.
    pub(crate) dwells: Vec<(usize, f64)>,
    /// Start of each motion, with the number of its mode if one was asked for.
    pub starts: Vec<(Option<usize>, Configuration<f64>)>,
    /// The joint or platform that moved most from its guess to the start of the motion.
    pub(crate) moved: Option<Moved>,
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

    /// Columns of the rows.
    pub fn columns(&self) -> Columns {
        Columns::new(self.mechanism, self.points(), self.quantities())
    }

    /// Columns of the quantities: the time if there are quantities and inputs move, then the quantities.
    pub fn quantities(&self) -> Vec<Variable> {
        let of = |quantity: &Quantity| Variable::new(&quantity.name, quantity.unit);
        let quantities: Vec<Variable> = self.metered.quantities.iter().map(of).collect();
        let timed = !quantities.is_empty() && !self.metered.inputs.is_empty();
        let time = timed.then(|| Variable::new("time", SiUnit::SECOND));
        time.into_iter().chain(quantities).collect()
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

    /// As [`Motions::run`], with the results located between rows.
    fn measured(
        &self,
        start: &Configuration<f64>,
        sink: &mut Sink,
        watch: &Watch,
    ) -> (SweepReport, Located) {
        let wanted = self.settings.straightness || !self.dwells.is_empty();
        if self.metered.quantities.is_empty() && !wanted {
            let moved = self.moved(start, &self.settings, sink, watch);
            return (moved, Located::default());
        }
        let mut meter = Meter::new(&self.metered, start);
        let timed = !self.metered.inputs.is_empty() && !self.metered.quantities.is_empty();
        let mut values = Vec::new();
        let steps = self.settings.steps;
        let (mut names, programs) = self.metered.programs();
        let paths = self.points().iter().filter(|_| self.settings.straightness);
        let paths: Vec<(&NamedPoint, [usize; 3])> = paths
            .map(|of| {
                let axes = [PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z];
                names.extend(
                    axes.map(|axis| Name::of(Measured::Place(of.point, axis, Order::Value))),
                );
                (of, std::array::from_fn(|k| names.len() - 3 + k))
            })
            .collect();
        // work is the integral of the power
        for i in 0..names.len() {
            let Measured::Work(of) = names[i].of else {
                continue;
            };
            if names.iter().all(|name| name.of != Measured::Power(of)) {
                names.push(Name::of(Measured::Power(of)));
            }
        }
        let schedule = self.settings.schedule.as_ref();
        let inputs = &self.metered.inputs;
        let how = (self.settings.pace, schedule);
        let course = |names: &[Name]| {
            let passage = Passage::new(self.mechanism, &self.held, inputs, how);
            Course::new(passage, names.to_vec())
        };
        // goes on to a row, and tells the time and whether it is a place of the curve, which do not depend on the rows asked for
        let reach = |course: &mut Course, row: &Row| {
            let time = match row.step {
                Some(step) => step as f64 / steps as f64,
                None => (row.time).unwrap_or_else(|| course.time(row.configuration)),
            };
            let ends = row.step.is_none_or(|step| step == 0 || step == steps);
            // beside those of a table only what may end it: inputs that follow one are not where a straight line has them
            let passed = matches!(
                row.special,
                Some(MetKind::Cusp { .. } | MetKind::Turning { .. })
            );
            let ends = ends && !(schedule.is_some() && passed);
            if ends {
                course.reach(row, time);
            }
            (time, ends)
        };
        let settings = SweepSettings {
            between: true,
            ..self.settings.clone()
        };
        // what was followed before an interruption is looked at all the same
        let none = Watch::none();
        let look = |course: &mut Course| {
            let mut of_names = Meter::of_names(&self.metered, start, &names);
            course.look(
                &mut of_names,
                if watch.is_stopped() { &none } else { watch },
            );
        };
        // work at a row follows from the whole curve to there
        let working = names
            .iter()
            .any(|name| matches!(name.of, Measured::Work(_)));
        let whole = working.then(|| {
            let mut whole = course(&names);
            let mut follow = |row: &Row| _ = reach(&mut whole, row);
            self.moved(start, &settings, &mut follow, watch);
            look(&mut whole);
            whole.gather(self.settings.pace.duration);
            whole
        });
        let mut course = course(&names);
        let mut take = |block: &MeterBlock| {
            for i in 0..block.len() {
                let (row, time) = block.row(i);
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
            let (time, ends) = reach(&mut course, row);
            if let Some(whole) = &whole {
                let (stretch, part) = match course.stretches().checked_sub(1).filter(|_| ends) {
                    Some(last) => (last, 1.0),
                    None => whole.place_of(course.stretches(), row.configuration, time),
                };
                meter.gathered(&whole.works(stretch, part));
            }
            if !row.between || self.settings.between {
                meter.read_row(row, time, &mut take);
            }
        };
        let mut report = self.moved(start, &settings, &mut measured, watch);
        meter.read_waiting(&mut take);
        let mut course = whole.unwrap_or_else(|| {
            look(&mut course);
            course
        });
        report.interrupted |= watch.is_stopped();
        let sought: Vec<Sought> = (self.metered.quantities.iter().zip(&programs))
            .map(|(quantity, program)| Sought::new(quantity, program))
            .collect();
        let dwells = self.dwells.iter().filter_map(|&(quantity, tolerance)| {
            let (samples, whole) = course.samples(&sought[quantity], tolerance);
            let (value, places) = dwell(&samples, tolerance, &mut |place| {
                let near = samples
                    .partition_point(|of| of.0 < place)
                    .min(samples.len() - 1);
                let near = samples[near].1.or(samples[near.saturating_sub(1)].1)?;
                meter.settle(quantity, near[1]);
                let place = course.divided(place);
                let (all, when) = course.read(&mut meter, place)?;
                Some([when, all[quantity]?])
            })?;
            let [begin, end] = places.map(|place| {
                let (at, when) = course.at_place(place)?;
                let at = at.clone();
                Some((when, course.inputs(&at)))
            });
            let ((begin, from), (end, to)) = (begin?, end?);
            let of = &self.metered.quantities[quantity];
            Some(Dwell {
                name: of.name.clone(),
                unit: of.unit,
                tolerance,
                value,
                times: [begin, end],
                inputs: [from, to],
                at_least: !whole,
            })
        });
        let dwells = dwells.collect();
        let straightness = paths.into_iter().filter_map(|(named, axes)| {
            let mut paths = Paths::new(self.mechanism, std::slice::from_ref(named));
            let path = course.path(axes);
            let mut at = |place: f64| {
                paths.place(course.at_place(place)?.0);
                Some(paths.at[0])
            };
            let known = path
                .into_iter()
                .filter_map(|(place, _)| Some((place, at(place)?)));
            let known = known.collect();
            let line = Straightness::along(&named.name, known, &mut at)?;
            Some(Straightness {
                at_least: !course.whole,
                ..line
            })
        });
        let located = Located {
            straightness: straightness.collect(),
            dwells,
            extremes: located(
                &mut course,
                &self.metered.quantities,
                &sought,
                &mut meter,
                self.settings.means,
            ),
        };
        (report, located)
    }

    fn moved(
        &self,
        start: &Configuration<f64>,
        settings: &SweepSettings,
        sink: &mut Sink,
        watch: &Watch,
    ) -> SweepReport {
        let (mechanism, held, inputs) = (self.mechanism, &self.held, self.inputs());
        sweep(mechanism, held, inputs, start, settings, sink, watch)
    }
}
