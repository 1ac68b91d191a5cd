//! Overview of a mechanism file, as a document, drawn as in a lecture.

pub mod latex;

use super::coordinates as given_coordinates;
use super::document::{Document, Section, Table, TableOf};
use super::quantity::{at, degrees, form, number, quantity, signed};
use super::report::Report;
use crate::algebra::SiUnit;
use crate::analysis::overview::{
    BodyOverview, ChainOverview, ClosedFormOverview, ClosureOverview, CoordinatesOverview,
    JointOverview, LoopStep, MobilityCount, Overview, ParameterOverview, PlatformOverview,
    RowOverview,
};
use crate::description::{AxisCondition, ClosureKind, Convention, count, listed, quoted};

impl Report for Overview {
    fn document(&self) -> Document {
        Document::new(&self.name, "")
            .notes(self.source.clone())
            .table("Parameters", parameters(self))
            .sections(self.coordinates.as_ref().map(coordinates))
            .table("Joints", joints(self))
            .sections(self.chains.iter().map(chain))
            .sections(platforms(self))
            .section(closures(self))
            .table("Bodies", bodies(self))
            .sections((!self.closures.is_empty()).then(|| loops(self)))
            .section(mobility(&self.count))
            .table("Closed forms", closed_forms(self))
    }
}

/// The coordinates as given, with the choices made on the way to the tables.
fn coordinates(given: &CoordinatesOverview) -> Section {
    let cut = match (given.cut.is_empty(), given.axes.cut.is_empty()) {
        (true, _) => String::new(),
        (false, false) => format!("cut at {}, as the file says", quoted(&given.cut)),
        (false, true) => format!(
            "cut at {}, as far from the ground as possible; `cut` in the file chooses others",
            quoted(&given.cut)
        ),
    };
    let have = form(given.rods.len(), "has two balls", "have two balls each");
    let rods = quoted(&given.rods);
    let rods =
        (!rods.is_empty()).then(|| format!("{rods} {have} only: a rod, whose spin is left out"));
    let section = given_coordinates::section(&given.axes);
    section.text(cut).text(rods.unwrap_or_default())
}

fn parameters(overview: &Overview) -> TableOf<&ParameterOverview> {
    let definition = |parameter: &ParameterOverview| match parameter.definition.parse::<f64>() {
        Ok(value) if value == parameter.value => None,
        _ => Some(parameter.definition.clone()),
    };
    Table::of(&overview.parameters)
        .words("name", |parameter| &parameter.name)
        .numbers("value", |parameter| parameter.value)
        .words("defined as", definition)
}

fn joints(overview: &Overview) -> TableOf<&JointOverview> {
    let shown = |joint: &JointOverview, value| quantity(value, joint.unit.unwrap_or(SiUnit::ONE));
    let limits = move |joint: &JointOverview| match joint.limits {
        Some((low, high)) => format!("{} to {}", shown(joint, low), shown(joint, high)),
        None => "none".into(),
    };
    Table::of(&overview.joints)
        .words("name", |joint| &joint.name)
        .words("kind", |joint| joint.kind.word())
        .words("role", |joint| joint.role.word().to_lowercase())
        .numbers("home", move |joint| shown(joint, joint.home))
        .words("limits", limits)
}

pub(super) fn chain(chain: &ChainOverview) -> Section {
    let mut title = format!("Chain {} on {}", chain.name, chain.on);
    if !chain.rows.is_empty() {
        let convention = chain.convention.word().to_lowercase();
        title += &format!(", {convention} Denavit–Hartenberg table");
    }
    let some = |what: &str, of: &[String], by: &str| match of.is_empty() {
        true => String::new(),
        false => format!("{what} {}", of.join(by)),
    };
    let entries = |row: &RowOverview| {
        let lengths = [&row.a, &row.d].map(|entry| (entry.clone(), SiUnit::METRE));
        let angles = [&row.alpha, &row.theta].map(|entry| (entry.clone(), SiUnit::RADIAN));
        let tilt = row.beta.clone().map(|entry| (entry, SiUnit::RADIAN));
        lengths.into_iter().chain(angles).chain(tilt)
    };
    let mut values: Vec<String> = Vec::new();
    for (entry, unit) in chain.rows.iter().flat_map(entries) {
        if let (Some(value), true) = (entry.value, entry.uses_parameters) {
            let value = at(&entry.written, value, unit);
            if !values.contains(&value) {
                values.push(value);
            }
        }
    }
    Section::new(title)
        .text(some("base", &chain.base, " "))
        .table(table(chain))
        .text(some("tip", &chain.tip, " "))
        .text(some("with", &values, ", "))
        .or_text("no joints")
}

/// The table in the order of its convention, as lectures print it.
fn table(chain: &ChainOverview) -> TableOf<(usize, &RowOverview)> {
    let table = Table::of((1..).zip(&chain.rows))
        .ruled()
        .words("i", |(i, _)| i);
    let tilted = chain.rows.iter().any(|row| row.beta.is_some());
    let tilt = |(_, row): (usize, &RowOverview), _| match &row.beta {
        Some(beta) => beta.written.clone(),
        None => "0".into(),
    };
    match chain.convention {
        Convention::Modified => table
            .words("αᵢ₋₁", |(_, row)| &row.alpha.written)
            .words("aᵢ₋₁", |(_, row)| &row.a.written)
            .each(tilted.then_some("βᵢ₋₁"), tilt)
            .words("dᵢ", |(_, row)| &row.d.written)
            .words("θᵢ", |(_, row)| &row.theta.written),
        Convention::Standard => table
            .words("θᵢ", |(_, row)| &row.theta.written)
            .words("dᵢ", |(_, row)| &row.d.written)
            .words("aᵢ", |(_, row)| &row.a.written)
            .words("αᵢ", |(_, row)| &row.alpha.written)
            .each(tilted.then_some("βᵢ"), tilt),
    }
}

pub(super) fn platforms(overview: &Overview) -> Vec<Section> {
    let platform = |platform: &PlatformOverview| {
        let [x, y, z] = platform.position.map(number);
        let [roll, pitch, yaw] = platform.roll_pitch_yaw.map(degrees);
        let home = format!("home at ({x}, {y}, {z}) m, roll {roll}, pitch {pitch}, yaw {yaw}");
        let frames = Table::of(&platform.frames)
            .words("frame", |frame| &frame.name)
            .words("placed by", |frame| frame.placed.join(" "));
        Section::new(format!("Platform {}", platform.name))
            .text(home)
            .table(frames)
    };
    overview.platforms.iter().map(platform).collect()
}

pub(super) fn closures(overview: &Overview) -> Section {
    let between = |closure: &ClosureOverview| closure.frames.join(" and ");
    Section::new("Closures").table(
        Table::of(&overview.closures)
            .words("name", |closure| &closure.name)
            .words("kind", |closure| closure.kind.word().to_lowercase())
            .words("between", between)
            .words("equations", |closure| {
                format!("{}: {}", closure.equations, equations(closure))
            }),
    )
}

/// Bodies, by names that every option takes where it takes a frame.
fn bodies(overview: &Overview) -> TableOf<&BodyOverview> {
    Table::of(&overview.bodies)
        .words("name", |body| &body.name)
        .words("joined by", |body| listed(&body.joints))
        .words("frames on it", |body| body.frames.join(", "))
}

/// The equations of a closure in words; the axes are the z axes of the frames.
fn equations(closure: &ClosureOverview) -> String {
    match (closure.kind, &closure.length) {
        (ClosureKind::Distance, Some(length)) => {
            return format!("origins at distance {length} (1)");
        }
        (ClosureKind::Distance, None) => return "origins at a given distance (1)".into(),
        (ClosureKind::Coupling, _) => return "an expression of joints is zero (1)".into(),
        _ => {}
    }
    let conditions = closure.kind.conditions();
    let all = [
        (conditions.origins, "origins coincide (3)"),
        (
            conditions.axes == AxisCondition::Perpendicular,
            "axes perpendicular (1)",
        ),
        (
            conditions.axes == AxisCondition::Aligned,
            "axes aligned (2)",
        ),
        (
            conditions.axes == AxisCondition::Oriented,
            "orientations equal (3)",
        ),
        (conditions.offsets.len() == 2, "origins on one axis (2)"),
        (conditions.offsets.len() == 1, "origins in one plane (1)"),
    ];
    let set = all.into_iter().filter(|(set, _)| *set);
    set.map(|(_, words)| words).collect::<Vec<_>>().join(", ")
}

fn loops(overview: &Overview) -> Section {
    let step = |step: &LoopStep| match step {
        LoopStep::Ground => "ground".to_owned(),
        LoopStep::Platform(name) | LoopStep::Chain(name) => name.clone(),
        LoopStep::Closure(name) => format!("[{name}]"),
    };
    let lines = overview.loops.iter().enumerate().map(|(i, found)| {
        let steps: Vec<String> = found.steps.iter().map(step).collect();
        format!("{}: {}", i + 1, steps.join(" - "))
    });
    match overview.loops.len() {
        0 => Section::new("Loops").text("none"),
        number => Section::new(format!("Loops: {number}")).list(lines),
    }
}

/// The count with its terms, and what each of them counts.
fn mobility(of: &MobilityCount) -> Section {
    let (variables, platforms, equations) = (of.variables, of.platforms, of.equations);
    let bodies = count(of.bodies, "body") + " with ground";
    let mut terms = vec![(format!("6·({} − 1)", of.bodies), bodies)];
    for (freedoms, constraints) in [(1, 5), (2, 4)] {
        let rows = of.row_freedoms.iter().filter(|f| **f == freedoms).count();
        let meaning = format!("{} with {}", count(rows, "row"), count(freedoms, "freedom"));
        if rows > 0 {
            terms.push((format!(" − {constraints}·{rows}"), meaning));
        }
    }
    let size = of.correction.unsigned_abs() as usize;
    match of.correction {
        0 => {}
        1.. => terms.push((
            format!(" + {size}"),
            count(size, "variable") + " in distances",
        )),
        _ => {
            let meaning = count(size, "row") + " driven together with another";
            terms.push((format!(" − {size}"), meaning));
        }
    }
    let closure_equations = count(equations, "closure equation");
    terms.push((format!(" − {equations}"), closure_equations.clone()));
    let (terms, meanings): (Vec<String>, Vec<String>) = terms.into_iter().unzip();
    let planar = of.planar.as_ref().map(|planar| {
        format!(
            "planar: {variables} + 3·{platforms} − {} = {}, as all joints move parallel to one \
             plane at home",
            planar.equations,
            signed(planar.mobility)
        )
    });
    let lines = [
        format!("{} = {}", terms.concat(), signed(of.mobility)),
        meanings.join(", "),
        format!(
            "the same as {variables} + 6·{platforms} − {equations}: {}, {}, {closure_equations}",
            count(variables, "joint variable"),
            count(platforms, "platform"),
        ),
    ];
    Section::new("Kutzbach count").list(lines.into_iter().chain(planar))
}

fn closed_forms(overview: &Overview) -> TableOf<&ClosedFormOverview> {
    let gives = |form: &ClosedFormOverview| match &form.pose_of {
        Some([of, relative_to]) => {
            format!("{} of {of} in {relative_to}", count(form.formulas, "entry"))
        }
        None => count(form.formulas, "identity"),
    };
    Table::of(&overview.closed_forms)
        .words("name", |form| &form.name)
        .words("gives", gives)
        .words("source", |form| form.source.as_deref())
}
