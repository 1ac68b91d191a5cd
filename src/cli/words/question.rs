//! Words for questions that cannot be put, with the options that would put them right.

use linkwork::algebra::Expression;
use linkwork::ask::Holdable;
use linkwork::description::{ProblemKind, Scope, listed, nearest};
use linkwork::mechanism::Mechanism;
use linkwork::output::complaint::{Complaint, Part};
use linkwork::system::{Demand, DriveError, QuestionError, ValueError};

/// What is wrong with a question, and with which part of the option that asked it, if one did.
pub fn complaint(error: &QuestionError) -> Complaint {
    complaint_of(error, &at_home)
}

/// The options that hold coordinates where the file has them.
pub fn at_home(names: &[String]) -> String {
    options("--hold", names, "=home")
}

/// The options that hold coordinates at values.
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

/// What was freed by name but has to be held.
pub fn freed_in_vain(error: &QuestionError, freed: &[&str]) -> Option<Complaint> {
    let QuestionError::TooFew { hold, .. } = error else {
        return None;
    };
    let in_vain: Vec<String> = (hold.iter())
        .filter(|name| freed.contains(&name.as_str()))
        .cloned()
        .collect();
    let help = format!("leave out {}", options("--free", &in_vain, ""));
    (!in_vain.is_empty() && in_vain.len() == hold.len())
        .then(|| Complaint::new(error.title(), "", Some(help)))
}

/// The same; `hold` writes the options that hold coordinates.
pub fn complaint_of(error: &QuestionError, hold: &dyn Fn(&[String]) -> String) -> Complaint {
    let holding = hold;
    let title = error.title();
    match error {
        QuestionError::UnknownName { suggestion, .. } => {
            let help = match suggestion {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => "a coordinate is a joint, `platform.x`, `.y`, `.z`, `.roll`, `.pitch` or \
                         `.yaw`, or a whole platform"
                    .into(),
            };
            Complaint::new(title, "not known", Some(help))
        }
        QuestionError::NotAJoint { .. } => {
            let help = "a platform is free unless it is held with --hold".to_owned();
            Complaint::new(title, "not a joint", Some(help))
        }
        QuestionError::Value { text, error, .. } => value(text, error),
        QuestionError::Contradiction { first, second } => {
            let [first, second] = [first, second].map(option);
            let title = format!("{first} and {second} contradict one another");
            let help = Some("give only one of them".to_owned());
            Complaint::new(title, "", help)
        }
        QuestionError::TooMany { mobility, free, .. } => {
            let rest = match mobility {
                0 => "; it is a structure, which nothing can move",
                _ => "",
            };
            Complaint::new(title, "", Some(release(free) + rest))
        }
        QuestionError::TooFew { hold, .. } => {
            let help = format!("hold {} too, e.g. {}", listed(hold), holding(hold));
            Complaint::new(title, "", Some(help))
        }
        QuestionError::AnglesLocked { platform } => {
            let help = format!(
                "hold joints instead of `{platform}`, or describe `{platform}` by a frame that is turned"
            );
            Complaint::new(title, "", Some(help))
        }
        QuestionError::Dependent { free, hold } => {
            let help = format!(
                "{}; then hold {}, e.g. {}",
                release(free),
                listed(hold),
                options("--hold", hold, "=home")
            );
            Complaint::new(title, "", Some(help))
        }
    }
}

/// What is wrong with a rate, an acceleration or a force that an option gives.
pub fn driven_complaint(error: &DriveError, option: &str) -> Complaint {
    match error {
        DriveError::Question(error) => complaint(error),
        DriveError::UnknownName {
            name,
            suggestion,
            held,
        } => {
            let title = QuestionError::UnknownName {
                name: name.clone(),
                suggestion: None,
            };
            let help = match (suggestion, held.is_empty()) {
                (Some(meant), _) => format!("did you mean `{meant}`?"),
                (None, false) => format!("drive what is held: {}", options(option, held, "=0.1")),
                (None, true) => "hold a joint with --hold, and give the rate of that".into(),
            };
            Complaint::new(title.title(), "not known", Some(help))
        }
        DriveError::Whole { platform, held } => {
            let title =
                format!("`{platform}` is a whole platform, and a single coordinate has a rate");
            let help = match held.is_empty() {
                true => format!(
                    "hold it, and give rates of its coordinates: {} {option} {}",
                    instead(platform),
                    quoted(&format!("{platform}.z=0.1")),
                ),
                false => format!("give {}", options(option, held, "=0.1")),
            };
            Complaint::new(title, "a platform", Some(help))
        }
        DriveError::NotTurned { platform } => {
            let title = format!(
                "`{platform}` turns about given axes only where its whole orientation is held"
            );
            let help = format!("hold it: {}", instead(platform));
            Complaint::new(title, "not held", Some(help))
        }
        DriveError::Mixed { platform } => {
            let title = format!(
                "how `{platform}` turns is given both by its angles and about the axes of ground"
            );
            let help = format!(
                "give either roll, pitch and yaw, or {platform}.wx, {platform}.wy and {platform}.wz"
            );
            Complaint::new(title, "given twice", Some(help))
        }
        DriveError::Structure => {
            let title = "nothing can be driven: the mechanism is a structure, without a freedom";
            let help = "`linkwork mobility` says why, `linkwork statics` what forces it carries";
            Complaint::new(title.into(), "", Some(help.into()))
        }
        DriveError::NotHeld { name, held } => {
            let title = format!("`{name}` is not held here, so its rate follows from the others");
            let help = match held.is_empty() {
                true => format!("hold it: --hold {name}=home"),
                false => format!(
                    "give rates of what is held, e.g. {}; or hold `{name}` in place of one of \
                     them, e.g. --free {} --hold {name}=home",
                    options(option, held, "=0.1"),
                    held[0]
                ),
            };
            Complaint::new(title, "not held", Some(help))
        }
    }
}

/// What is wrong with the name of a frame.
pub fn unknown_frame(mechanism: &Mechanism, name: &str) -> Complaint {
    let frames = mechanism.frames().into_iter();
    let known: Vec<String> = frames.map(|frame| mechanism.frame_name(frame)).collect();
    let help = match nearest(name, known.iter().map(String::as_str)) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => format!("the frames are {}", listed(&known)),
    };
    let title = format!("`{name}` is not a frame");
    Complaint::new(title, "not known", Some(help))
}

/// What is wrong with a frame that stands still, where its motion is asked for.
pub fn motionless_frame(name: &str) -> Complaint {
    let title = match name {
        "ground" => "ground does not move".into(),
        name => format!("`{name}` stands on ground and does not move"),
    };
    let help = "follow a frame of a link or of a platform, e.g. the tip of a chain by its name";
    Complaint::new(title, "stands still", Some(help.into()))
}

/// The options that hold a platform and nothing else.
fn instead(platform: &str) -> String {
    format!(
        "--free actuated --hold {}",
        quoted(&format!("{platform}=home"))
    )
}

/// How to stop holding coordinates: joints are freed, platform coordinates are held only by an option,
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
    let value = value
        .as_ref()
        .map_or(String::new(), |value| format!("={value}"));
    format!("`--{} {}`", verb.word(), quoted(&format!("{name}{value}")))
}

/// `--free l1 --free l2`
fn options(option: &str, names: &[String], value: &str) -> String {
    let options = names
        .iter()
        .map(|name| format!("{option} {}", quoted(&format!("{name}{value}"))));
    options.collect::<Vec<_>>().join(" ")
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
    let (kind, part) = match error {
        ValueError::Parse(kind) => {
            let part = match &parsed {
                Err(error) if error.kind == *kind => Part::Value(error.span.clone()),
                _ => Part::WholeValue,
            };
            (ProblemKind::Expression(kind.clone()), part)
        }
        ValueError::UnknownName { name, suggestion } => {
            let place = parsed.as_ref().ok().and_then(|expression| {
                let mut names = expression.names();
                names.find(|(found, _)| *found == name)
            });
            let part = place.map_or(Part::WholeValue, |(_, span)| Part::Value(span.clone()));
            let kind = ProblemKind::UnknownName {
                name: name.clone(),
                suggestion: suggestion.clone(),
                scope: Scope::Parameters,
            };
            (kind, part)
        }
        ValueError::NoValue(kind) => (ProblemKind::NoValue(*kind), Part::WholeValue),
        ValueError::Unit(kind) => (ProblemKind::Unit(*kind), Part::WholeValue),
        ValueError::NotANumber => {
            return Complaint::new(error.to_string(), "", None).at(Part::WholeValue);
        }
        ValueError::NotAPose { .. } => {
            let title = error.to_string();
            let help = "a pose is a list such as [Tz(0.5), Rx(10 deg)], or home".to_owned();
            return Complaint::new(title, "", Some(help)).at(Part::WholeValue);
        }
    };
    let help = match &kind {
        // nothing can be declared in an option
        ProblemKind::UnknownName {
            suggestion: None, ..
        } => Some("a value may use the parameters of the file".into()),
        kind => kind.help(),
    };
    Complaint::new(kind.title(), &kind.label(), help).at(part)
}
