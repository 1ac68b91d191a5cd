//! The interface of the page of `linkwork view`: requests in, replies out, both JSON.
//!
//! The page has this library inside, compiled to WebAssembly, and asks it as the command line does. It keeps one
//! mechanism and its configuration; everything else is in [`ask`](crate::ask), [`scene`](crate::scene) and
//! [`output`](crate::output). There are no files, threads or clocks here.

#[cfg(target_arch = "wasm32")]
mod abi;
mod design;
mod grip;
mod live;
mod motion;
mod request;
mod shown;
mod state;
mod words;

use std::sync::Arc;

use serde::Serialize;
use serde_json::{Value, json};

use crate::algebra::{Measure, SiUnit};
use crate::analysis::assembly::AssemblySettings;
use crate::analysis::rounding::posed;
use crate::ask::{AskError, Question, Solved, Steering, Value as Written};
use crate::description::{Description, Problem};
use crate::mechanism::{Configuration, Mechanism};
use crate::output::complaint::no_value;
use crate::output::drawing::{DrawingSettings, Panel, Viewpoint, sheet};
use crate::output::rounding::Prefaced;
use crate::output::{AnyReport, JsonReport};
use crate::scene::Scene;
use crate::solve::Watch;
use crate::system::Coordinate;
use request::{Analysis, LoadRequest, MeasureKind, Press, Request};
use state::State;

/// State of a page between requests.
#[derive(Debug, Default)]
pub struct Page {
    mechanism: Option<Arc<Mechanism>>,
    /// The mechanism in its configuration; none if it does not assemble.
    steering: Option<Steering>,
    /// Its file, with the parameters that were set.
    description: Option<Description>,
    load: Option<Press>,
    /// The quantities that are read.
    watched: String,
}

/// Configurations of an answer that lists none.
const NONE: &[Value] = &[];

/// Reply in place of an answer.
struct RefusedReply(Value);

/// The refusal of a question.
fn refused(question: &Question) -> impl Fn(AskError) -> RefusedReply + '_ {
    |error| nothing(&words::refused(question, &error))
}

impl Page {
    /// The reply to a request.
    pub fn answer(&mut self, request: &str) -> String {
        let reply = match serde_json::from_str(request) {
            Ok(Request::Ask { what, as_filed }) => self.ask(what, as_filed, &Watch::none()),
            Ok(Request::Sweep(sweep)) => self.sweep(&sweep, &Watch::none()),
            Ok(Request::LetGo(asked)) => self.let_go(&asked, &Watch::none()),
            Ok(Request::Design(asked)) => self.design(&asked, &Watch::none()),
            Ok(request) => self.reply(request).map(|reply| reply.to_string()),
            Err(error) => Err(nothing(&error.to_string())),
        };
        reply.unwrap_or_else(|RefusedReply(said)| said.to_string())
    }

    fn mechanism(&self) -> Result<Arc<Mechanism>, RefusedReply> {
        (self.mechanism.clone()).ok_or_else(|| nothing("no mechanism"))
    }

    fn reply(&mut self, request: Request) -> Result<Value, RefusedReply> {
        let watch = &Watch::none();
        match request {
            Request::Load(load) => return self.load(&load, watch),
            Request::Move { to } => return self.move_to(&to, watch),
            _ => {}
        }
        let mechanism = self.mechanism()?;
        match request {
            Request::Hold { names } => {
                let at = self.steering()?.at().clone();
                let asked = holding(&mechanism, &names, &at);
                let steering = asked.steering_near(&at, watch);
                self.steering = Some(steering.map_err(refused(&asked))?);
                Ok(self.frame(None))
            }
            Request::Go { at } => {
                let at = configuration(&at, &mechanism)?;
                let asked = self.steering()?.question();
                let steering = asked.steering_from(at);
                self.steering = Some(steering.map_err(refused(&asked))?);
                Ok(self.frame(None))
            }
            Request::Grab { part, at } => grip::grab(self.steering()?, part, at),
            Request::Pull { grip, to, sight } => {
                let grip = grip::points(&mechanism, &grip)?;
                let steering = self.steering.as_mut().ok_or_else(not_assembled)?;
                let report = steering.pull(&grip, to, sight, watch);
                Ok(self.frame(words::pulled(&report).as_deref()))
            }
            Request::Press { load } => {
                self.load = load;
                Ok(self.frame(None))
            }
            Request::Watch { quantities } => {
                self.watch(quantities);
                Ok(self.frame(None))
            }
            Request::Gained => live::gained(self.steering()?, watch),
            Request::Ways => {
                let ways = self.steering()?.ways_on(watch);
                let states = ways
                    .iter()
                    .map(|at| json!({ "at": State::of(at), "scene": Scene::of(&mechanism, at) }));
                Ok(json!({ "states": states.collect::<Vec<_>>() }))
            }
            Request::Number { text, measure } => {
                let measure = match measure {
                    MeasureKind::Angle => Measure::Angle,
                    MeasureKind::Length => Measure::Length,
                    MeasureKind::Force => Measure::Force,
                    MeasureKind::Time => Measure::Other(SiUnit::SECOND),
                };
                let value = Written::from(text.as_str()).number(&mechanism, measure);
                let value = value.map_err(|error| {
                    let why = words::in_a_line(no_value(&text, &error));
                    nothing(&format!("{text}: {why}"))
                })?;
                Ok(json!({ "value": value }))
            }
            Request::Show { at, frames } => {
                let at = configuration(&at, &mechanism)?;
                let scene = Scene::of(&mechanism, &at).with_loads(&mechanism, &at);
                let scene = match frames {
                    true => scene.with_frames(&mechanism, &at),
                    false => scene,
                };
                Ok(json!({ "scene": scene }))
            }
            Request::Picture { from, labels } => {
                let view = from.map_or(Viewpoint::Natural, |(azimuth, elevation)| {
                    Viewpoint::From(azimuth, elevation)
                });
                let panel = Panel::new(mechanism.name(), None, self.here(&mechanism).1);
                let picture = sheet(&[panel], &DrawingSettings { view, labels });
                Ok(json!({ "svg": picture.svg() }))
            }
            Request::Ask { .. }
            | Request::Sweep(_)
            | Request::LetGo(_)
            | Request::Design(_)
            | Request::Load(_)
            | Request::Move { .. } => {
                unreachable!("answered before")
            }
        }
    }

    /// Reads a file; its errors come back with lines and columns.
    fn load(&mut self, load: &LoadRequest, watch: &Watch) -> Result<Value, RefusedReply> {
        let text = &load.text;
        let wrong = |problems: &[Problem]| {
            RefusedReply(json!({ "problems": shown::problems(text, problems) }))
        };
        let mut description = match Description::read(text) {
            Ok(description) => description,
            Err(_) => return Err(wrong(&Mechanism::problems(text))),
        };
        for (name, value) in &load.set {
            description = (description.with_parameter(name, value))
                .map_err(|error| nothing(&words::parameter(name, value, &error)))?;
        }
        let (description, mechanism) = posed(description).map_err(|problems| wrong(&problems))?;
        let mechanism = Arc::new(mechanism);
        self.mechanism = Some(mechanism.clone());
        let near = load
            .near
            .as_ref()
            .and_then(|near| near.of_mechanism(&mechanism));
        let asked = match &load.held {
            Some(names) => {
                let home = mechanism.home();
                holding(&mechanism, names, near.as_ref().unwrap_or(&home))
            }
            None => Question::new(mechanism.clone()),
        };
        let steering = match near {
            Some(at) => asked.steering_near(&at, watch),
            None => asked.steering(watch),
        };
        let why = steering.as_ref().err();
        let why = why.map(|error| words::refused(&asked, error));
        self.steering = steering.ok();
        self.load = load.load.clone();
        self.watch(load.quantities.clone());
        let mut reply = self.frame(why.as_deref());
        reply["mechanism"] = shown::mechanism(&mechanism, &description);
        self.description = Some(description);
        reply["warnings"] = shown::problems(text, mechanism.warnings()).into();
        Ok(reply)
    }

    /// Moves the held coordinates; the mechanism follows as far as its branch goes.
    fn move_to(&mut self, to: &[(String, f64)], watch: &Watch) -> Result<Value, RefusedReply> {
        let steering = self.steering.as_mut().ok_or_else(not_assembled)?;
        let mechanism = steering.mechanism().clone();
        let of = |name: &str| {
            let mut driven = steering.driven().iter();
            driven.find(|of| of.name(&mechanism) == name).copied()
        };
        let targets = to.iter().map(|(name, value)| {
            let coordinate = of(name).ok_or_else(|| nothing(&format!("{name} is not held")))?;
            Ok((coordinate, *value))
        });
        let targets: Vec<(Coordinate, f64)> = targets.collect::<Result<_, RefusedReply>>()?;
        let report = steering.move_to(&targets, watch);
        Ok(self.frame(words::stopped(&report).as_deref()))
    }

    /// The answer of a command.
    fn ask(&self, what: Analysis, as_filed: bool, watch: &Watch) -> Result<String, RefusedReply> {
        let mechanism = &self.mechanism()?;
        let asked = match as_filed {
            true => Question::new(mechanism.clone()),
            false => self.asked(mechanism),
        };
        let refused = refused(&asked);
        Ok(match what {
            Analysis::Solve => {
                let solved = asked.solve(&AssemblySettings::default(), watch);
                match solved.map_err(refused)? {
                    Solved::Ended(report) => answered(mechanism, &*report, NONE),
                    Solved::Lost(lost) => answered(mechanism, &*lost, NONE),
                }
            }
            Analysis::Assemblies => {
                let report = asked.assemblies(Default::default(), watch);
                let report = report.map_err(refused)?;
                let states = report.assemblies.iter().map(|assembly| {
                    let at = assembly.configuration();
                    json!({ "at": State::of(&at), "scene": Scene::of(mechanism, &at) })
                });
                answered(mechanism, &report, &states.collect::<Vec<_>>())
            }
            Analysis::Mobility => {
                answered(mechanism, &asked.mobility(watch).map_err(refused)?, NONE)
            }
        })
    }

    fn steering(&self) -> Result<&Steering, RefusedReply> {
        self.steering.as_ref().ok_or_else(not_assembled)
    }

    /// The question that holds the held coordinates at their present values.
    fn asked(&self, mechanism: &Arc<Mechanism>) -> Question {
        match &self.steering {
            Some(steering) => steering.question(),
            None => Question::new(mechanism.clone()),
        }
    }

    fn watch(&mut self, quantities: String) {
        self.watched = match (quantities.trim(), &self.steering) {
            ("", Some(steering)) => live::usual(steering),
            _ => quantities,
        };
    }

    /// Configuration of the mechanism, its scene with the load, and the forces that balance this.
    fn here(&self, mechanism: &Mechanism) -> (Configuration<f64>, Scene, Value) {
        let Some(steering) = &self.steering else {
            let home = mechanism.home();
            let scene = Scene::of(mechanism, &home).with_loads(mechanism, &home);
            return (home, scene, Value::Null);
        };
        let scene = Scene::of(mechanism, steering.at()).with_loads(mechanism, steering.at());
        let (scene, forces) = match &self.load {
            Some(load) => live::pressed(steering, load, scene),
            None => (scene, Value::Null),
        };
        (steering.at().clone(), scene, forces)
    }

    /// The mechanism as it is now.
    fn frame(&self, said: Option<&str>) -> Value {
        let Some(mechanism) = &self.mechanism else {
            return json!({ "said": said });
        };
        let (at, scene, forces) = self.here(mechanism);
        json!({
            "said": said,
            "assembled": self.steering.is_some(),
            "scene": scene,
            "forces": forces,
            "quantities": self.steering.as_ref().map(|of| live::readings(of, &self.watched)),
            "at": State::of(&at),
            "values": shown::values(mechanism, &at),
            "held": self.steering.as_ref().map(shown::held),
            "limits": self.steering.as_ref().map(words::limits).unwrap_or_default(),
            "crossed": self.steering.as_ref().is_some_and(Steering::is_crossed),
            "figures": self.steering.as_ref().map(shown::figures),
        })
    }
}

fn not_assembled() -> RefusedReply {
    nothing("the mechanism is not assembled")
}

fn nothing(why: &str) -> RefusedReply {
    RefusedReply(json!({ "error": why }))
}

/// The question that holds these where they are, and nothing else.
fn holding(mechanism: &Arc<Mechanism>, names: &[String], at: &Configuration<f64>) -> Question {
    let all: Vec<Coordinate> = Coordinate::all(mechanism).collect();
    let named = |name: &String| all.iter().find(|of| of.name(mechanism) == *name);
    let asked = Question::new(mechanism.clone()).free("actuated");
    names
        .iter()
        .filter_map(|name| Some((name, named(name)?)))
        .fold(asked, |asked, (name, of)| {
            asked.hold(name, of.of(mechanism, at))
        })
}

/// A report as the command line prints it, with the configurations that it lists. It may be long: it is written once.
fn answered(mechanism: &Mechanism, report: &impl JsonReport, states: &[impl Serialize]) -> String {
    let report = Prefaced::new(mechanism, report);
    let (report, states) = (report.json(), serde_json::to_string(states));
    let states = states.expect("what a page is shown can be written");
    format!("{{\"report\":{report},\"states\":{states}}}")
}

fn configuration(state: &State, mechanism: &Mechanism) -> Result<Configuration<f64>, RefusedReply> {
    (state.of_mechanism(mechanism))
        .ok_or_else(|| nothing("the configuration is of another mechanism"))
}
