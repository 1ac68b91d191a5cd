//! Analyses of one assembled configuration, and those that need none.

use std::sync::Arc;

use super::{AskError, Demand, Item, Mode, Question, Role, Unmeasured, Value};
use crate::algebra::{Expression, MeasureError, MeasureErrorKind, SiUnit};
use crate::analysis::compare::{CompareReport, CompareSettings, compare};
use crate::analysis::equilibrium::{EquilibriumReport, EquilibriumSettings, equilibrium};
use crate::analysis::formulas::{FormulasReport, FormulasSettings, formulas, solution};
use crate::analysis::mobility::{MobilityReport, MobilitySettings, mobility};
use crate::analysis::simulation::{SimulationReport, SimulationSettings, Speed, simulation};
use crate::analysis::statics::{StaticsReport, statics};
use crate::analysis::velocity::{VelocityReport, velocity};
use crate::mechanism::{
    Along, Body, GivenEffort, GivenForce, GivenValue, Measured, NamedPoint, Point, PoseCoordinate,
    Quantity, QuantityError,
};
use crate::solve::Watch;
use crate::system::{
    self, Analysed, AssemblySettings, Closed, Coordinate, Drive, ForceError, Load, check_angle,
};

impl Question {
    /// The mechanism closed near the start, as all analyses of one configuration close it.
    ///
    /// # Errors
    /// If a name or a value is wrong.
    pub fn closed(&self, watch: &Watch) -> Result<Analysed<Closed>, AskError> {
        let question = self.resolved()?;
        let closing = AssemblySettings::seeded(self.seed);
        Ok((closing.start(&question, watch)).map_or_else(|open| open, Analysed::Closed))
    }

    /// The freedoms of the assembled mechanism, with the locked coordinates of the question at rest.
    ///
    /// # Errors
    /// If a name or a value is wrong, or an angle is locked of a platform whose pitch is ±90°.
    pub fn mobility(&self, watch: &Watch) -> Result<Analysed<MobilityReport>, AskError> {
        self.takes("mobility")?;
        let question = self.in_mode(watch)?;
        let settings = MobilitySettings {
            seed: self.seed,
            locked: self.locked(watch)?,
        };
        Ok(mobility(&question, &settings, watch))
    }

    /// Rates and accelerations of everything for those of the question's held coordinates; held coordinates without a
    /// rate stand still. Points of the question are followed.
    pub fn velocity(&self, watch: &Watch) -> Result<Analysed<VelocityReport>, AskError> {
        self.takes("velocity")?;
        let question = self.in_mode(watch)?;
        let points = self.followed()?;
        let drive = self.drive(&question)?;
        velocity(&question, &drive, &points, watch).map_err(AskError::Question)
    }

    /// The forces that balance the wrenches and loads of the question.
    pub fn statics(&self, watch: &Watch) -> Result<Analysed<StaticsReport>, AskError> {
        self.takes("statics")?;
        let question = self.in_mode(watch)?;
        let load = self.load_of(&question)?;
        statics(&question, &load, watch).map_err(AskError::Question)
    }

    /// Rest positions under the loads of the question, with its locked coordinates at rest.
    pub fn equilibrium(
        &self,
        settings: &EquilibriumSettings,
        watch: &Watch,
    ) -> Result<Analysed<EquilibriumReport>, AskError> {
        self.takes("equilibrium")?;
        let question = self.in_mode(watch)?;
        let settings = EquilibriumSettings {
            locked: self.locked(watch)?,
            ..settings.clone()
        };
        let load = self.load_of(&question)?;
        Ok(equilibrium(&question, &load, &settings, watch))
    }

    /// The motion of the mechanism when it is let go, with the rates, loads, locked coordinates and points of the question.
    pub fn simulation(
        &self,
        settings: &SimulationSettings,
        watch: &Watch,
    ) -> Result<Analysed<SimulationReport>, AskError> {
        self.takes("simulate")?;
        let question = self.in_mode(watch)?;
        let mut locked = self.locked(watch)?;
        let speeds = self.speeds(&question, &locked)?;
        locked.retain(|of| speeds.iter().all(|(_, speed)| speed.coordinate != *of));
        let drive = self.drive_but(&question, |item| speeds.iter().any(|(of, _)| *of == item))?;
        let settings = SimulationSettings {
            locked,
            speeds: speeds.into_iter().map(|(_, speed)| speed).collect(),
            points: self.followed()?,
            ..settings.clone()
        };
        let load = self.load_of(&question)?;
        Ok(simulation(&question, &drive, &load, &settings, watch))
    }

    /// The locked coordinates that have rates, which may be expressions of time.
    fn speeds(
        &self,
        question: &system::Question,
        locked: &[Coordinate],
    ) -> Result<Vec<(Item, Speed)>, AskError> {
        let mechanism = &**self.mechanism();
        let mut speeds = Vec::new();
        for (item, demand) in self.distinct(Role::Rate)? {
            let named = question.coordinates(&demand.name);
            let Some(&coordinate) = (named.as_deref().ok())
                .and_then(|of| <&[Coordinate; 1]>::try_from(of).ok())
                .map(|[of]| of)
                .filter(|of| locked.contains(of))
            else {
                continue;
            };
            let unit = SiUnit::of_coordinate(coordinate.is_angle(mechanism)).per_second();
            let known = |of: &Measured| of.is_constant() || *of == Measured::Time;
            let rate = self.law(item, demand, unit, ("time", known))?;
            speeds.push((
                item,
                Speed {
                    coordinate,
                    rate,
                    parameters: mechanism.parameters().iter().map(|of| of.value).collect(),
                },
            ));
        }
        Ok(speeds)
    }

    /// The expression that a demand gives to a name, in a unit, over quantities that are known.
    fn law(
        &self,
        item: Item,
        demand: &Demand,
        unit: SiUnit,
        (what, known): (&'static str, impl Fn(&Measured) -> bool),
    ) -> Result<Expression<Measured>, AskError> {
        let text = demand.value(0).to_string();
        let refused = item.quantity(&text);
        let read = Quantity::read(self.mechanism(), &demand.name, &text).map_err(&refused)?;
        if !read.measured().all(known) {
            return Err(item.unmeasured(&text, Unmeasured::Follows { what }));
        }
        match [SiUnit::ONE, unit.without_angle()].contains(&read.unit.without_angle()) {
            true => Ok(read.expression),
            false => Err(refused(QuantityError::Unit(MeasureError {
                kind: MeasureErrorKind::Instead(unit, read.unit),
                span: 0..text.len(),
            }))),
        }
    }

    /// The question near its start, or near the configuration of the mode that is asked for.
    fn in_mode(&self, watch: &Watch) -> Result<system::Question<'_>, AskError> {
        self.one_mode()?;
        let question = self.resolved()?;
        Ok(match self.mode {
            Mode::Nearest => question,
            Mode::Number(_) | Mode::All => {
                let start = self.start(&question.clone().with_spins_still(), watch)?;
                question.near(&start)
            }
        })
    }

    /// The wrenches and loads.
    pub(super) fn load_of(&self, question: &system::Question) -> Result<Load, AskError> {
        let mut own = self.mechanism().loads().clone();
        for (item, left_out) in self.of(Role::Without) {
            if let Some(known) = own.leave_out(&left_out.name) {
                let name = left_out.name.clone();
                return Err(item.wrong(AskError::Load)(ForceError::NotActing {
                    name,
                    known,
                }));
            }
        }
        let mut load = Load {
            own: Arc::new(own),
            ..Load::default()
        };
        for (item, wrench) in self.of(Role::Wrench) {
            let loaded = match wrench.values[..] {
                [
                    Value::Number(fx),
                    Value::Number(fy),
                    Value::Number(fz),
                    Value::Number(mx),
                    Value::Number(my),
                    Value::Number(mz),
                ] => load.forces(question, &wrench.name, ([fx, fy, fz], [mx, my, mz])),
                _ => {
                    let text = wrench.written().unwrap_or_default();
                    load.wrench(question, &wrench.name, &text)
                }
            };
            load = loaded.map_err(item.wrong(AskError::Load))?;
        }
        for (item, demand) in self.of(Role::Load) {
            if let Some(force) = self.changing(item, demand)? {
                Arc::make_mut(&mut load.own).forces.push(force);
                continue;
            }
            let loaded = load.joint(question, &demand.name, demand.value(0));
            load = loaded.map_err(item.wrong(AskError::Load))?;
        }
        Ok(load)
    }

    /// A load along a joint that follows from time, joints or rates, such as that of a motor with its law.
    fn changing(&self, item: Item, demand: &Demand) -> Result<Option<GivenForce>, AskError> {
        let mechanism = &**self.mechanism();
        let (Value::Text(text), Some(joint)) = (demand.value(0), mechanism.joint(&demand.name))
        else {
            return Ok(None);
        };
        // what is no expression over quantities is refused as a number
        let Ok(read) = Quantity::read(mechanism, &demand.name, &text) else {
            return Ok(None);
        };
        if read.measured().all(Measured::is_constant) {
            return Ok(None);
        }
        let unit = SiUnit::of_effort(mechanism.joints()[joint].kind.is_angle());
        let known = |of: &Measured| !of.follows_from_forces();
        let follows = "time, joints, points and their rates";
        let value = self.law(item, demand, unit, (follows, known))?;
        let value = GivenValue { value, table: None };
        Ok(Some(GivenForce {
            name: format!("load on {}", demand.name),
            on: GivenEffort::Along(Along::Joint(joint), Box::new(value)),
        }))
    }

    /// Resolves the locked coordinates.
    fn locked(&self, watch: &Watch) -> Result<Vec<Coordinate>, AskError> {
        let plain = system::Question::new(self.mechanism());
        let mut locked: Vec<Coordinate> = Vec::new();
        for (item, demand) in self.of(Role::Lock) {
            locked.extend(
                plain
                    .coordinates(&demand.name)
                    .map_err(item.wrong(AskError::Named))?,
            );
        }
        // three angles at once are an orientation, which has no gimbal lock
        let single = |coordinate: &&Coordinate| match **coordinate {
            Coordinate::Pose(platform, c) if c.is_angle() => !PoseCoordinate::ALL
                .into_iter()
                .filter(|c| c.is_angle())
                .all(|c| locked.contains(&Coordinate::Pose(platform, c))),
            _ => false,
        };
        let mut angles = locked.iter().filter(single).peekable();
        if angles.peek().is_some()
            && let Some(closed) = self.closed(watch)?.closed()
        {
            for &angle in angles {
                let checked = check_angle(self.mechanism(), &closed.configuration, angle);
                checked?;
            }
        }
        Ok(locked)
    }

    /// The closed forms of the file against its chains.
    pub fn compare(&self, samples: usize, watch: &Watch) -> CompareReport {
        let settings = CompareSettings {
            samples,
            seed: self.seed,
            ..CompareSettings::default()
        };
        compare(self.mechanism(), &settings, watch)
    }

    /// The mechanism's formulas in closed form.
    ///
    /// # Errors
    /// If an expression of the file has no value in letters.
    pub fn formulas(&self, settings: &FormulasSettings) -> Result<FormulasReport, AskError> {
        formulas(self.mechanism(), settings).map_err(AskError::Formula)
    }

    /// The unknowns in closed form, as far as they have one: solved in the assembly near the start, or that of the mode
    /// asked for, which decides what vanishes.
    ///
    /// # Errors
    /// If the question is wrong, nothing assembles, or an expression of the file has no value in letters.
    pub fn solution(&self, watch: &Watch) -> Result<FormulasReport, AskError> {
        let question = self.resolved()?.with_spins_still();
        let at = self.start(&question, watch)?;
        solution(&question, &at, self.seed).map_err(AskError::Formula)
    }

    pub(super) fn drive(&self, question: &system::Question) -> Result<Drive, AskError> {
        self.drive_but(question, |_| false)
    }

    /// The rates and accelerations but for some.
    fn drive_but(
        &self,
        question: &system::Question,
        but: impl Fn(Item) -> bool,
    ) -> Result<Drive, AskError> {
        let mut drive = Drive::still(question);
        for (item, demand) in
            (self.distinct(Role::Rate)?.into_iter()).filter(|(item, _)| !but(*item))
        {
            let driven = drive.rate(question, &demand.name, demand.value(0));
            drive = driven.map_err(item.wrong(AskError::Drive))?;
        }
        for (item, demand) in self.distinct(Role::Acceleration)? {
            let driven = drive.acceleration(question, &demand.name, demand.value(0));
            drive = driven.map_err(item.wrong(AskError::Drive))?;
        }
        Ok(drive)
    }

    /// The points of the question, which must move.
    fn followed(&self) -> Result<Vec<Point>, AskError> {
        let points = self.asked_points()?;
        let still = |point: &Point| self.mechanism().body(point.frame) == Body::Ground;
        let mut demands = self.of(Role::Point).zip(&points);
        match demands.find(|(_, point)| still(point)) {
            Some(((item, demand), _)) => Err(AskError::Motionless(item, demand.name.clone())),
            None => Ok(points),
        }
    }

    /// The points of the question.
    pub(super) fn asked_points(&self) -> Result<Vec<Point>, AskError> {
        let named = self.named_points()?.into_iter();
        Ok(named.map(|named| named.point).collect())
    }

    /// The points of the question with their names.
    pub(super) fn named_points(&self) -> Result<Vec<NamedPoint>, AskError> {
        let points = self.of(Role::Point).map(|(item, demand)| {
            let wrong = |error| AskError::Point(item, error);
            NamedPoint::read(self.mechanism(), &demand.name).map_err(wrong)
        });
        points.collect()
    }
}
