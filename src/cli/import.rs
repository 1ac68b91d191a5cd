//! `linkwork import`

use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::rounding::posed_from_poses;
use linkwork::ask::Question;
use linkwork::description::{
    self, Convention, Description, Displacement, Entry, LoadError, MAX_BYTES, ProblemKind, Role,
    rounding_of_text,
};
use linkwork::interchange::{ImportError, ImportSettings, Remark, load_beside};
use linkwork::mechanism::{Configuration, Mechanism, Rounding};
use linkwork::number::tolerance::SAME;
use linkwork::output::diagnostics;
use linkwork::output::rounding::sentence;
use linkwork::solve::Watch;
use linkwork::system::redundant_motors;

use super::export::remarks;
use super::output_files::{file, written};
use super::read::{called, text};
use super::{Answer, Refusal, lines, style};

/// Read a URDF, MJCF or SDF file as a mechanism.
///
/// Trees become chains with tables, and branches chains on links of others; coupled joints share variables and keep their
/// names as outputs; `connect` and `weld` constraints, the loop elements that programs add to URDF, and joints of SDF
/// that close loops, become closures. What is left out, and what was decided, is listed on stderr.
#[derive(Args)]
#[command(
    after_help = "Example: linkwork import robot.urdf --loops loops.ron --frame tool0 > robot.ron"
)]
pub struct Import {
    /// The URDF, MJCF or SDF file; `-` reads standard input
    file: PathBuf,
    /// A mechanism file with the closures of the loops, and chains `on:` links, by the names of links and sites
    #[arg(long, value_name = "FILE")]
    loops: Option<PathBuf>,
    /// Keep the frame of a link or site under its name; `all` keeps all
    #[arg(long, value_name = "NAME")]
    frame: Vec<String>,
    /// Folder from which included files may be read too, besides that of the model
    #[arg(long, value_name = "DIR")]
    include_from: Vec<PathBuf>,
    /// The convention of the tables
    #[arg(long, value_enum, default_value_t = Convention::Modified)]
    convention: Convention,
    /// Write to this file instead of stdout
    #[arg(long, value_name = "FILE", value_parser = file(&["ron"]))]
    output: Option<PathBuf>,
}

impl Import {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let closing = |path: &PathBuf| {
            let read = Mechanism::read_text(called(path), text(path, MAX_BYTES)?);
            read.map_err(Refusal::from)
        };
        let loops = self.loops.as_ref().map(closing).transpose()?;
        let settings = ImportSettings {
            convention: self.convention,
            frames: self.frame.clone(),
            all_frames: self.frame.iter().any(|name| name == "all"),
            include_from: self.include_from.clone(),
        };
        let closing = loops.as_ref().map(|(_, description)| description);
        let path = called(&self.file);
        let text = text(&self.file, MAX_BYTES)?;
        let mut imported =
            load_beside(&path, &text, closing, &settings).map_err(|error| match error {
                ImportError::Wrong(wrong) => Refusal(diagnostics::import(&wrong, style())),
                ImportError::Unreadable(error) => error.into(),
            })?;
        // loops are closed where the file is drawn, which may be outside the limits
        let drawn = with_homes(&imported.description, &imported.outside);
        let (exact, note) = exact(&drawn, &text);
        let fewer = with_fewer_motors(&exact).0;
        let found = inside(&fewer, &imported.outside);
        if let Some(found) = &found
            && imported.outside.is_empty()
            && !found.moved.is_empty()
        {
            let joints = found.moved.clone();
            imported.remarks.push(Remark::Moved { joints });
        }
        let closed = found.map(|found| found.applied(&exact));
        let placed = closed.unwrap_or_else(|| {
            let moved = |(name, _): &(String, f64)| {
                let mut joints = imported.description.joints.iter();
                let of = joints.find(|joint| joint.name.value == *name)?;
                Some((name.clone(), of.value.home.clone()))
            };
            with_entries(&exact, imported.outside.iter().filter_map(moved))
        });
        let (placed, redundant) = with_fewer_motors(&placed);
        imported.description = placed;
        if !redundant.is_empty() {
            (imported.remarks).push(Remark::Redundant { joints: redundant });
        }
        let made = Mechanism::new(&imported.description);
        if let Err(mut problems) = made {
            for problem in &mut problems {
                if let ProblemKind::UnknownFrame { name, suggestion } = &mut problem.kind {
                    let links = imported.links.iter().map(String::as_str);
                    *suggestion = description::nearest(name, links).map(str::to_owned);
                }
            }
            // names and values of the imported part are sound: what is wrong stands in the file of loops
            let (path, text) = match (&self.loops, loops) {
                (Some(path), Some((text, _))) => (path, text),
                _ => (&path, String::new()),
            };
            return Err(LoadError::wrong(path, text, problems).into());
        }
        let text = imported.description.to_ron();
        let said = |error| format!("the mechanism cannot be written: {error}");
        let text = text.map_err(|error| Refusal::error(said(error)))?;
        let data = written(text, self.output.as_deref())?;
        Ok(Answer::yes(data, remarks(&imported.remarks) + &note))
    }
}

/// The description with other home values, in m or rad.
fn with_homes(description: &Description, homes: &[(String, f64)]) -> Description {
    with_entries(description, written_values(description, homes).into_iter())
}

/// Values of joints as they are written.
fn written_values(description: &Description, values: &[(String, f64)]) -> Vec<(String, Entry)> {
    let slides = Mechanism::new(description).map_or(Vec::new(), |mechanism| {
        let slides = mechanism.joints().iter().filter(|of| !of.kind.is_angle());
        slides.map(|joint| joint.name.clone()).collect()
    });
    let entry = |(name, value): &(String, f64)| {
        let entry = [Entry::angle, Entry::length][usize::from(slides.contains(name))];
        (name.clone(), entry(*value))
    };
    values.iter().map(entry).collect()
}

fn with_entries(
    description: &Description,
    homes: impl Iterator<Item = (String, Entry)>,
) -> Description {
    let mut description = description.clone();
    for (name, home) in homes {
        let mut joints = description.joints.iter_mut();
        if let Some(joint) = joints.find(|joint| joint.name.value == name) {
            joint.value.home = home;
        }
    }
    description
}

/// The description in which motors that others move already are passive, and their joints. Without loops every motor has a
/// freedom of its own.
fn with_fewer_motors(description: &Description) -> (Description, Vec<String>) {
    let mut description = description.clone();
    let mechanism = Mechanism::new(&description).ok();
    let closed = mechanism.filter(|mechanism| !mechanism.closures().is_empty());
    let redundant = closed.map_or(Vec::new(), |mechanism| redundant_motors(&mechanism));
    for joint in &mut description.joints {
        if redundant.contains(&joint.name.value) {
            joint.value.role = Role::Passive;
        }
    }
    (description, redundant)
}

/// Home values of joints, and poses of platforms.
struct FoundHome {
    /// The joints that were moved inside their limits.
    moved: Vec<String>,
    joints: Vec<(String, f64)>,
    platforms: Vec<(String, Vec<Displacement>)>,
    /// Lower and upper limits beyond which joints are by rounding.
    reached: [Vec<(String, f64)>; 2],
}

impl FoundHome {
    fn applied(&self, description: &Description) -> Description {
        let mut description = with_homes(description, &self.joints);
        for (end, reached) in self.reached.iter().enumerate() {
            for (name, value) in written_values(&description, reached) {
                let mut joints = description.joints.iter_mut();
                let of = joints.find(|joint| joint.name.value == name);
                if let Some((low, high)) = of.and_then(|of| of.value.limits.as_mut()) {
                    *[low, high][end] = value;
                }
            }
        }
        for (name, home) in &self.platforms {
            let mut platforms = description.platforms.iter_mut();
            if let Some(platform) = platforms.find(|platform| platform.name.value == *name) {
                platform.value.home.clone_from(home);
            }
        }
        description
    }
}

/// A home inside the limits with loops closed, on the way from that of the file: one joint after another that is outside is
/// held a little inside, farther if others stay outside. `None` if some do all the same.
fn inside(description: &Description, outside: &[(String, f64)]) -> Option<FoundHome> {
    /// Parts of the range between the limits.
    const INSIDE: [f64; 3] = [0.02, 0.1, 0.3];
    let mechanism = Mechanism::new(description).ok()?;
    if mechanism.closures().is_empty() {
        return None;
    }
    // an assembly far away may be within the limits too, and that of motors where they are drawn may not
    let eased = |limited: bool, driven: bool| {
        let mut eased = description.clone();
        for joint in &mut eased.joints {
            joint.value.limits = joint.value.limits.take().filter(|_| limited);
            if !driven {
                joint.value.role = Role::Passive;
            }
        }
        eased
    };
    let ways = [(false, true), (true, true), (false, false)];
    let found = ways.iter().find_map(|(limited, driven)| {
        let question = Question::new(Mechanism::new(&eased(*limited, *driven)).ok()?);
        let first = closed(&question)?;
        let parts = INSIDE.iter();
        let mut homes =
            parts.map(|part| within(&mechanism, question.clone(), first.clone(), *part));
        homes.find_map(|home| home)
    })?;
    let is_reached = found.reached.iter().any(|end| !end.is_empty());
    (!found.moved.is_empty() || !outside.is_empty() || is_reached).then_some(found)
}

fn closed(question: &Question) -> Option<Configuration<f64>> {
    let found = question.closed(&Watch::none()).ok()?;
    Some(found.closed()?.configuration)
}

/// From a configuration a home inside the limits with loops closed, where joints outside are held this part of their range inside.
fn within(
    mechanism: &Mechanism,
    mut question: Question,
    mut found: Configuration<f64>,
    part: f64,
) -> Option<FoundHome> {
    let mut moved = Vec::new();
    for _ in 0..=mechanism.joints().len() {
        let joints = mechanism.joints().iter().zip(&found.joints);
        let beyond = joints.clone().filter_map(|(joint, value)| {
            let (low, high) = joint.limits?;
            let margin = part * (high - low);
            let to = value.clamp(low + margin, high - margin);
            (*value < low - SAME || *value > high + SAME).then_some((joint.role, &joint.name, to))
        });
        // what is driven is held anyway
        let beyond = beyond.min_by_key(|(role, ..)| *role != Role::Actuated);
        let Some((_, name, to)) = beyond else {
            let beyond = |is_beyond: fn(f64, (f64, f64)) -> bool| {
                let beyond = joints
                    .clone()
                    .filter(|(joint, value)| joint.limits.is_some_and(|of| is_beyond(**value, of)));
                beyond
                    .map(|(joint, value)| (joint.name.clone(), *value))
                    .collect()
            };
            let reached = [
                beyond(|value, (low, _)| value < low),
                beyond(|value, (_, high)| value > high),
            ];
            let joints = joints.map(|(joint, value)| (joint.name.clone(), *value));
            let platforms = mechanism.platforms().iter().zip(&found.platforms);
            let platforms = platforms.map(|(of, pose)| {
                let steps = Displacement::of_pose(&pose.pose());
                (of.name.clone(), steps)
            });
            return Some(FoundHome {
                moved,
                joints: joints.collect(),
                platforms: platforms.collect(),
                reached,
            });
        };
        moved.push(name.clone());
        question = question.hold(name, to);
        found = closed(&question)?;
    }
    None
}

/// The description of the nearest linkage that closes exactly where loops close within the rounding of the numbers of a file
/// of another program, with what is said about it.
fn exact(description: &Description, text: &str) -> (Description, String) {
    let found =
        rounding_of_text(text).and_then(|off| posed_from_poses(description.clone(), off).ok());
    let found = found
        .as_ref()
        .map(|(of, mechanism)| (of, mechanism.rounding()));
    match found {
        Some((exact, Some(rounding @ Rounding::Nearest(_)))) => {
            (exact.clone(), lines("note", [sentence(rounding)]))
        }
        _ => (description.clone(), String::new()),
    }
}
