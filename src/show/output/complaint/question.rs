//! Words for questions that cannot be put, with the remedies that would put them right.

use std::fmt::Display;

use super::door::Wording;
use super::{Complaint, OptionPart};
use crate::algebra::{Expression, Measure, SiUnit};
use crate::ask::{Demand, Remedy, Role, Value};
use crate::description::{ProblemKind, Scope, listed, nearest};
use crate::mechanism::{Mechanism, QuantityError};
use crate::output::quantity::quantity;
use crate::system::{DriveError, ForceError, PointError, QuestionError, ValueError};

impl Wording<'_> {
    /// The words for a question that holds what it cannot hold, or names what is not there.
    pub fn question(&self, error: &QuestionError) -> Complaint {
        self.held(error, &|names| self.each(Role::Hold, names, Some("home")))
    }

    /// The words for a question that holds what it cannot hold; `holding` writes remedies that hold coordinates.
    pub(super) fn held(
        &self,
        error: &QuestionError,
        holding: &dyn Fn(&[String]) -> String,
    ) -> Complaint {
        let said = Complaint::new(error.title());
        match error {
            QuestionError::UnknownName { suggestion, .. } => {
                said.label("not known").help(suggested(suggestion.as_ref(), || {
                    "a coordinate is a joint, `platform.x`, `.y`, `.z`, `.roll`, `.pitch` or \
                     `.yaw`, a point's `left+0.5,0.2.x`, `.y` or `.z`, or a whole platform"
                        .into()
                }))
            }
            QuestionError::NotAJoint(_) => said.label("not a joint").help(format!(
                "a platform is free unless it is held with {}",
                self.role(Role::Hold)
            )),
            QuestionError::Value { text, error, .. } => no_value(text, error),
            QuestionError::Contradiction { first, second } => self.contradiction(first, second),
            QuestionError::TooMany {
                mobility,
                free,
                apart,
                ..
            } => {
                let help = match mobility {
                0 => self.release(free) + "; it is a structure, which nothing can move",
                _ => self.release(free),
            };
                said.help(match apart {
                    Some((name, by, unit)) => {
                        let by = quantity(*by, *unit);
                        format!("{help}; the others put {name} {by} from the value held")
                    }
                    None => help,
                })
            }
            QuestionError::TooFew { hold, .. } => said.help(format!(
                "hold {} too, e.g. {}",
                listed(hold),
                holding(hold)
            )),
            QuestionError::AnglesLocked(platform) => said.help(format!(
                "hold joints instead of `{platform}`, or describe `{platform}` by a frame that is turned"
            )),
            QuestionError::Dependent { free, hold } => said.help(format!(
                "{}; then hold {}, e.g. {}",
                self.release(free),
                listed(hold),
                self.each(Role::Hold, hold, Some("home"))
            )),
        }
    }

    /// The words for two demands that cannot both be meant.
    pub(super) fn contradiction(&self, first: &Demand, second: &Demand) -> Complaint {
        let [first, second] = [first, second].map(|demand| {
            let demand = Remedy::Demand(demand.clone());
            format!("`{}`", self.remedies(&[demand]))
        });
        Complaint::new(format!("{first} and {second} contradict one another"))
            .help("give only one of them")
    }

    /// Remedies that hold a platform and nothing else.
    fn instead(&self, platform: &str) -> String {
        self.remedies(&[
            Remedy::Demand(Demand::named(Role::Free, "actuated")),
            Remedy::Demand(Demand::new(Role::Hold, platform, ["home"])),
        ])
    }

    /// Ways to stop holding coordinates: joints are freed, platform coordinates are held only by a demand,
    /// of their own or of the whole platform.
    fn release(&self, held: &[String]) -> String {
        let (coordinates, joints): (Vec<String>, Vec<String>) =
            held.iter().cloned().partition(|name| name.contains('.'));
        let mut ways = Vec::new();
        if !joints.is_empty() {
            let free = self.each(Role::Free, &joints, None);
            ways.push(format!("free {}: {free}", listed(&joints)));
        }
        if !coordinates.is_empty() {
            ways.push(format!("do not hold {}", listed(&coordinates)));
        }
        ways.join(" and ")
    }

    /// The words for a rate, an acceleration or a force.
    pub(super) fn driven(&self, error: &DriveError, role: Role) -> Complaint {
        let said = |label| Complaint::new(error.to_string()).label(label);
        let held_at = |held: &[String]| self.each(role, held, Some("0.1"));
        match error {
        DriveError::Question(error) => self.question(error),
        DriveError::UnknownName {
            suggestion, held, ..
        } => said("not known").help(suggested(suggestion.as_ref(), || match held.is_empty() {
            false => format!("drive a held coordinate: {}", held_at(held)),
            true => format!(
                "hold a joint with {}, and give the rate of that",
                self.role(Role::Hold)
            ),
        })),
        DriveError::Whole { platform, held } => said("a platform").help(match held.is_empty() {
            true => format!(
                "hold it, and give rates of its coordinates: {} {}",
                self.instead(platform),
                self.give(role, &format!("{platform}.z"), &["0.1"]),
            ),
            false => format!("give {}", held_at(held)),
        }),
        DriveError::NotTurned(platform) => {
            said("not held").help(format!("hold it: {}", self.instead(platform)))
        }
        DriveError::Mixed(platform) => said("given twice").help(format!(
            "give either roll, pitch and yaw, or {platform}.wx, {platform}.wy and {platform}.wz"
        )),
        DriveError::Structure => said("")
            .help(format!(
                "{} shows why, {} which forces it carries",
                self.analysis("mobility"),
                self.analysis("statics")
            )),
        DriveError::NotHeld { name, held } => said("not held").help(match held.is_empty() {
            true => format!("hold it: {}", self.give(Role::Hold, name, &["home"])),
            false => format!(
                "give the rate of a held coordinate, e.g. {}; or hold `{name}` in place of one of them, e.g. {}",
                held_at(held),
                self.remedies(&[
                    Remedy::Demand(Demand::named(Role::Free, &held[0])),
                    Remedy::Demand(Demand::new(Role::Hold, name, ["home"])),
                ])
            ),
        }),
    }
    }

    /// The words for a wrench or a load.
    pub(super) fn load(&self, mechanism: &Mechanism, error: &ForceError, role: Role) -> Complaint {
        let said = |label| Complaint::new(error.to_string()).label(label);
        match error {
            ForceError::Value(error) => {
                let said = self.driven(error, role);
                // of several components the wrong one is not known here
                match said.part {
                    OptionPart::Value(_) if role == Role::Wrench => said.at(OptionPart::WholeValue),
                    _ => said,
                }
            }
            ForceError::Point(error) => no_point(mechanism, error),
            ForceError::OnGround { instead, .. } => {
                let bodies = listed(instead);
                said("on the ground").help(format!("load a body that moves, such as {bodies}"))
            }
            ForceError::NotActing { name, known } => {
                said("not known").help(meant(name, known, || {
                    format!("leave out {}", listed(known))
                }))
            }
            ForceError::Components(_) => said("")
                .help("write Fx,Fy,Fz in N, or Fx,Fy,Fz,Mx,My,Mz with N·m")
                .at(OptionPart::WholeValue),
            ForceError::UnknownJoint {
                suggestion, known, ..
            } => {
                said("not known").help(suggested(suggestion.as_ref(), || match known.is_empty() {
                    false => format!("the joints are {}", listed(known)),
                    true => format!(
                        "there are no joints: load a frame with {}",
                        self.role(Role::Wrench)
                    ),
                }))
            }
            ForceError::Platform {
                platform,
                component,
                ..
            } => {
                let mut example = ["0"; 6];
                example[component.unwrap_or(2)] = "1";
                let given = if *component >= Some(3) { 6 } else { 3 };
                said("not a joint").help(format!(
                    "give force and moment on it in ground, e.g. {}",
                    self.give(Role::Wrench, platform, &[&example[..given].join(",")])
                ))
            }
        }
    }
}

/// A known name that is nearly the same, or else something more general.
pub(super) fn meant(name: &str, known: &[String], other: impl FnOnce() -> String) -> String {
    suggested(nearest(name, known.iter().map(String::as_str)), other)
}

/// The name that was probably meant, or else something more general.
pub fn suggested<S: Display>(meant: Option<S>, other: impl FnOnce() -> String) -> String {
    meant.map_or_else(other, |meant| format!("did you mean `{meant}`?"))
}

/// The names of all frames.
pub(super) fn frame_names(mechanism: &Mechanism) -> impl Iterator<Item = String> {
    let frames = mechanism.frames().into_iter();
    frames.map(|frame| mechanism.frame_name(frame))
}

/// The words for a name that no frame has.
pub fn unknown_frame(mechanism: &Mechanism, name: &str) -> Complaint {
    let known: Vec<String> = frame_names(mechanism).collect();
    let said = Complaint::new(format!("`{name}` is not a frame")).label("not known");
    said.help(meant(name, &known, || {
        format!("the frames are {}", listed(&known))
    }))
}

/// The words for a point that is none.
pub fn no_point(mechanism: &Mechanism, error: &PointError) -> Complaint {
    match error {
        PointError::NoFrame(name) => unknown_frame(mechanism, name),
        PointError::Value { text, error } => no_value(text, error).at(OptionPart::Name),
        PointError::TooMany(_) => Complaint::new(error.to_string())
            .label("too many")
            .help("write FRAME+X,Y,Z, e.g. left+0.5,0.2,0"),
    }
}

/// The words for a quantity that is none.
pub(super) fn no_quantity(mechanism: &Mechanism, text: &str, error: &QuantityError) -> Complaint {
    let kind = match error {
        QuantityError::Parse(error) => ProblemKind::Expression(error.kind.clone()),
        QuantityError::Unit(error) => ProblemKind::Unit(error.kind),
        QuantityError::Unknown { name, suggestion } => ProblemKind::UnknownName {
            name: name.clone(),
            suggestion: suggestion.clone(),
            scope: Scope::Outputs,
        },
        QuantityError::Point { name, error } => {
            return match error {
                // joints have rates too
                PointError::NoFrame(of) if name.contains(':') => {
                    let joints = mechanism.joints().iter().map(|joint| joint.name.clone());
                    let known: Vec<String> = frame_names(mechanism).chain(joints).collect();
                    Complaint::new(format!("`{of}` is neither a frame nor a joint"))
                        .label("not known")
                        .help(meant(of, &known, || {
                            format!("there are {}", listed(&known))
                        }))
                }
                _ => no_point(mechanism, error),
            };
        }
    };
    let mut said = Complaint::kind(&kind);
    if let QuantityError::Parse(_) = error {
        // a name of several words is read as several
        let mut plain = frame_names(mechanism)
            .filter(|name| name.contains(' ') && !text.contains(&format!("[{name}")));
        if let Some(name) = plain.find(|name| text.contains(name.as_str())) {
            let bracketed = text.replace(&name, &format!("[{name}]"));
            said = said.help(format!("put the name into brackets: `{bracketed}`"));
        }
    }
    match error {
        QuantityError::Unknown { name, .. } if name == text => said,
        _ => Complaint {
            title: format!("in `{text}`: {}", said.title),
            ..said
        },
    }
}

/// The number of a setting in SI units, written with its unit or without, that lies between two others.
///
/// # Errors
/// The words for a value that does not.
pub fn setting(
    mechanism: &Mechanism,
    value: &Value,
    unit: SiUnit,
    (least, most): (f64, f64),
) -> Result<f64, Complaint> {
    let measure = match unit {
        SiUnit::ONE => Measure::Number,
        unit => Measure::Other(unit),
    };
    let text = value.to_string();
    let number = value.number(mechanism, measure);
    let number = number.map_err(|error| no_value(&text, &error).at(OptionPart::Name))?;
    if (least..=most).contains(&number) {
        return Ok(number);
    }
    let range = match least == f64::MIN_POSITIVE {
        true => format!("more than 0 and at most {}", quantity(most, unit)),
        false => format!(
            "between {} and {}",
            quantity(least, unit),
            quantity(most, unit)
        ),
    };
    Err(Complaint::new(format!("{text} is not {range}")))
}

/// The words for a value that is none.
pub fn no_value(text: &str, error: &ValueError) -> Complaint {
    // a value that is one expression tells where it is wrong
    let parsed = Expression::parse(text);
    let whole = |kind: ProblemKind| Complaint::kind(&kind).at(OptionPart::WholeValue);
    match error {
        ValueError::Parse(kind) => {
            let said = whole(ProblemKind::Expression(kind.clone()));
            match &parsed {
                Err(error) if error.kind == *kind => said.at(OptionPart::Value(error.span.clone())),
                _ => said,
            }
        }
        ValueError::UnknownName { name, suggestion } => {
            let said = whole(ProblemKind::UnknownName {
                name: name.clone(),
                suggestion: suggestion.clone(),
                scope: Scope::Parameters,
            });
            // nothing can be declared in an option
            let said = match suggestion {
                Some(_) => said,
                None => said.help("a value may use the parameters of the file"),
            };
            let names = parsed.iter().flat_map(Expression::names);
            match names.into_iter().find(|(found, _)| *found == name) {
                Some((_, span)) => said.at(OptionPart::Value(span.clone())),
                None => said,
            }
        }
        ValueError::NoValue(kind) => whole(ProblemKind::NoValue(*kind)),
        ValueError::Unit(kind) => whole(ProblemKind::Unit(*kind)),
        ValueError::NotANumber => Complaint::new(error.to_string()).at(OptionPart::WholeValue),
        ValueError::NotAPose { .. } => Complaint::new(error.to_string())
            .help("a pose is a list such as [Tz(0.5), Rx(10 deg)], or home")
            .at(OptionPart::WholeValue),
    }
}
