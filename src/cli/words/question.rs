//! Words for questions that cannot be put, with the options that would put them right.

use linkwork::algebra::Expression;
use linkwork::ask::Holdable;
use linkwork::description::{ProblemKind, Scope, listed, nearest};
use linkwork::mechanism::{Mechanism, QuantityError};
use linkwork::output::complaint::{Complaint, Part};
use linkwork::system::{Demand, DriveError, ForceError, PointError, QuestionError, ValueError};

/// The error in a question, and the part of its option that it is in, if it is in one.
pub fn complaint(error: &QuestionError) -> Complaint {
    complaint_of(error, &at_home)
}

/// The options that hold coordinates where the file has them.
pub fn at_home(names: &[String]) -> String {
    options("--hold", names, "=home")
}

pub fn held_at(holdable: &[Holdable]) -> String {
    let option = |one: &Holdable| {
        let value = match one.value {
            None => "home".to_owned(),
            Some(value) if one.is_angle => format!("{}deg", short(value.to_degrees())),
            Some(value) => short(value),
        };
        format!("--hold {}", quoted(&format!("{}={value}", one.name)))
    };
    holdable.iter().map(option).collect::<Vec<_>>().join(" ")
}

/// Four digits, enough to assemble near an assembly.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    rounded.to_string()
}

/// Complaint about coordinates freed by name that have to be held.
pub fn freed_in_vain(error: &QuestionError, freed: &[&str]) -> Option<Complaint> {
    let QuestionError::TooFew { hold, .. } = error else {
        return None;
    };
    let in_vain = hold.iter().all(|name| freed.contains(&name.as_str()));
    let help = format!("leave out {}", options("--free", hold, ""));
    (!hold.is_empty() && in_vain).then(|| Complaint::new(error.title()).help(help))
}

/// As [`complaint`]; `holding` writes the options that hold coordinates.
pub fn complaint_of(error: &QuestionError, holding: &dyn Fn(&[String]) -> String) -> Complaint {
    let said = Complaint::new(error.title());
    match error {
        QuestionError::UnknownName { suggestion, .. } => said.label("not known").help(match suggestion {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => "a coordinate is a joint, `platform.x`, `.y`, `.z`, `.roll`, `.pitch` or \
                     `.yaw`, a point's `left+0.5,0.2.x`, `.y` or `.z`, or a whole platform"
                .into(),
        }),
        QuestionError::NotAJoint(_) => said
            .label("not a joint")
            .help("a platform is free unless it is held with --hold"),
        QuestionError::Value { text, error, .. } => value(text, error),
        QuestionError::Contradiction { first, second } => {
            let [first, second] = [first, second].map(option);
            Complaint::new(format!("{first} and {second} contradict one another"))
                .help("give only one of them")
        }
        QuestionError::TooMany { mobility, free, .. } => said.help(match mobility {
            0 => release(free) + "; it is a structure, which nothing can move",
            _ => release(free),
        }),
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
            release(free),
            listed(hold),
            options("--hold", hold, "=home")
        )),
    }
}

/// The error in a rate, an acceleration or a force that an option gives.
pub fn driven_complaint(error: &DriveError, option: &str) -> Complaint {
    let said = |label| Complaint::new(error.to_string()).label(label);
    let held_at = |held: &[String]| options(option, held, "=0.1");
    match error {
        DriveError::Question(error) => complaint(error),
        DriveError::UnknownName {
            suggestion, held, ..
        } => said("not known").help(match (suggestion, held.is_empty()) {
            (Some(meant), _) => format!("did you mean `{meant}`?"),
            (None, false) => format!("drive a held coordinate: {}", held_at(held)),
            (None, true) => "hold a joint with --hold, and give the rate of that".into(),
        }),
        DriveError::Whole { platform, held } => said("a platform").help(match held.is_empty() {
            true => format!(
                "hold it, and give rates of its coordinates: {} {option} {}",
                instead(platform),
                quoted(&format!("{platform}.z=0.1")),
            ),
            false => format!("give {}", held_at(held)),
        }),
        DriveError::NotTurned(platform) => {
            said("not held").help(format!("hold it: {}", instead(platform)))
        }
        DriveError::Mixed(platform) => said("given twice").help(format!(
            "give either roll, pitch and yaw, or {platform}.wx, {platform}.wy and {platform}.wz"
        )),
        DriveError::Structure => said("")
            .help("`linkwork mobility` shows why, `linkwork statics` which forces it carries"),
        DriveError::NotHeld { name, held } => said("not held").help(match held.is_empty() {
            true => format!("hold it: --hold {name}=home"),
            false => format!(
                "give the rate of a held coordinate, e.g. {}; or hold `{name}` in place of one of them, e.g. \
                 --free {} --hold {name}=home",
                held_at(held),
                held[0]
            ),
        }),
    }
}

pub fn load_complaint(mechanism: &Mechanism, error: &ForceError, option: &str) -> Complaint {
    let said = |label| Complaint::new(error.to_string()).label(label);
    match error {
        ForceError::Value(error) => {
            let said = driven_complaint(error, option);
            // of several components the wrong one is not known here
            match said.part {
                Part::Value(_) if option == "--wrench" => said.at(Part::WholeValue),
                _ => said,
            }
        }
        ForceError::Point(error) => no_point(mechanism, error),
        ForceError::OnGround { instead, .. } => {
            let bodies = listed(instead);
            said("on the ground").help(format!("load a body that moves, such as {bodies}"))
        }
        ForceError::Components(_) => said("")
            .help("write Fx,Fy,Fz in N, or Fx,Fy,Fz,Mx,My,Mz with N·m")
            .at(Part::WholeValue),
        ForceError::UnknownJoint {
            suggestion, known, ..
        } => said("not known").help(match (suggestion, known.is_empty()) {
            (Some(meant), _) => format!("did you mean `{meant}`?"),
            (None, false) => format!("the joints are {}", listed(known)),
            (None, true) => "there are no joints: load a frame with --wrench".into(),
        }),
        ForceError::Platform {
            platform,
            component,
            ..
        } => {
            let mut example = ["0"; 6];
            example[component.unwrap_or(2)] = "1";
            let given = if *component >= Some(3) { 6 } else { 3 };
            said("not a joint").help(format!(
                "give force and moment on it in ground, e.g. --wrench {platform}={}",
                example[..given].join(",")
            ))
        }
    }
}

/// The name that was probably meant, or else a more general remedy.
pub fn meant(name: &str, known: &[String], other: impl FnOnce() -> String) -> String {
    match nearest(name, known.iter().map(String::as_str)) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => other(),
    }
}

pub fn frame_names(mechanism: &Mechanism) -> impl Iterator<Item = String> {
    let frames = mechanism.frames().into_iter();
    frames.map(|frame| mechanism.frame_name(frame))
}

pub fn unknown_frame(mechanism: &Mechanism, name: &str) -> Complaint {
    let known: Vec<String> = frame_names(mechanism).collect();
    let said = Complaint::new(format!("`{name}` is not a frame")).label("not known");
    said.help(meant(name, &known, || {
        format!("the frames are {}", listed(&known))
    }))
}

pub fn no_point(mechanism: &Mechanism, error: &PointError) -> Complaint {
    match error {
        PointError::NoFrame(name) => unknown_frame(mechanism, name),
        PointError::Value { text, error } => value(text, error).at(Part::Name),
        PointError::TooMany(_) => Complaint::new(error.to_string())
            .label("too many")
            .help("write FRAME+X,Y,Z, e.g. left+0.5,0.2,0"),
    }
}

pub fn no_quantity(mechanism: &Mechanism, text: &str, error: &QuantityError) -> Complaint {
    let kind = match error {
        QuantityError::Parse(error) => ProblemKind::Expression(error.kind.clone()),
        QuantityError::Unit(error) => ProblemKind::Unit(error.kind),
        QuantityError::Unknown { name, suggestion } => ProblemKind::UnknownName {
            name: name.clone(),
            suggestion: suggestion.clone(),
            scope: Scope::Outputs,
        },
        QuantityError::Point { error, .. } => return no_point(mechanism, error),
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

/// The options that hold a platform and nothing else.
fn instead(platform: &str) -> String {
    let home = quoted(&format!("{platform}=home"));
    format!("--free actuated --hold {home}")
}

/// Options that release coordinates: joints are freed, platform coordinates are held only by an option,
/// of their own or of the whole platform.
fn release(held: &[String]) -> String {
    let (coordinates, joints): (Vec<String>, Vec<String>) =
        held.iter().cloned().partition(|name| name.contains('.'));
    let mut ways = Vec::new();
    if !joints.is_empty() {
        let free = options("--free", &joints, "");
        ways.push(format!("free {}: {free}", listed(&joints)));
    }
    if !coordinates.is_empty() {
        ways.push(format!("do not hold {}", listed(&coordinates)));
    }
    ways.join(" and ")
}

/// The option that makes a demand: `--hold l1=0.7`.
fn option(demand: &Demand) -> String {
    let Demand { verb, name, value } = demand;
    let value = value.as_ref().map(|value| format!("={value}"));
    let value = value.unwrap_or_default();
    format!("`--{} {}`", verb.word(), quoted(&format!("{name}{value}")))
}

/// `--free l1 --free l2`
pub fn options(option: &str, names: &[String], value: &str) -> String {
    let one = |name| format!("{option} {}", quoted(&format!("{name}{value}")));
    names.iter().map(one).collect::<Vec<_>>().join(" ")
}

/// The word as a shell takes it.
pub fn quoted(word: &str) -> String {
    let safe = |c: char| c.is_alphanumeric() || "._=-".contains(c);
    match word.chars().all(safe) {
        true => word.into(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

pub fn value(text: &str, error: &ValueError) -> Complaint {
    // a value that is one expression tells where it is wrong
    let parsed = Expression::parse(text);
    let whole = |kind: ProblemKind| Complaint::kind(&kind).at(Part::WholeValue);
    match error {
        ValueError::Parse(kind) => {
            let said = whole(ProblemKind::Expression(kind.clone()));
            match &parsed {
                Err(error) if error.kind == *kind => said.at(Part::Value(error.span.clone())),
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
                Some((_, span)) => said.at(Part::Value(span.clone())),
                None => said,
            }
        }
        ValueError::NoValue(kind) => whole(ProblemKind::NoValue(*kind)),
        ValueError::Unit(kind) => whole(ProblemKind::Unit(*kind)),
        ValueError::NotANumber => Complaint::new(error.to_string()).at(Part::WholeValue),
        ValueError::NotAPose { .. } => Complaint::new(error.to_string())
            .help("a pose is a list such as [Tz(0.5), Rx(10 deg)], or home")
            .at(Part::WholeValue),
    }
}
