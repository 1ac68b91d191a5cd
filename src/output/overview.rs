//! What a mechanism file means, drawn as a lecture draws it, as a document.

use super::document::{Column, Document, Report, Section, Table, cells};
use super::quantity::{degrees, number, quantity, signed};
use crate::analysis::overview::{
    ChainOverview, ClosureOverview, LoopStep, MobilityCount, Overview, PlatformOverview,
    RowOverview,
};
use crate::description::{ClosureKind, Convention, count};

impl Report for Overview {
    fn document(&self) -> Document {
        Document::new(&self.name, "")
            .notes(self.source.clone())
            .section(Section::new("Parameters").table(parameters(self)))
            .section(Section::new("Joints").table(joints(self)))
            .sections(self.chains.iter().map(chain))
            .sections(platforms(self))
            .sections(closures(self))
            .sections((!self.closures.is_empty()).then(|| loops(self)))
            .section(mobility(&self.count))
            .section(Section::new("Closed forms").table(closed_forms(self)))
    }
}

fn parameters(overview: &Overview) -> Table {
    let mut table = Table::new([
        Column::words("name"),
        Column::numbers("value"),
        Column::words("defined as"),
    ]);
    for parameter in &overview.parameters {
        let definition = match parameter.definition.parse() == Ok(parameter.value) {
            true => "",
            false => &parameter.definition,
        };
        table.row(cells![&parameter.name, parameter.value, definition]);
    }
    table
}

fn joints(overview: &Overview) -> Table {
    let mut table = Table::new([
        Column::words("name"),
        Column::words("kind"),
        Column::words("role"),
        Column::numbers("home"),
        Column::words("limits"),
    ]);
    for joint in &overview.joints {
        let shown = |value| match joint.unit {
            Some(unit) => quantity(value, unit.is_angle()),
            None => number(value),
        };
        let limits = joint.limits.map_or("none".to_owned(), |(low, high)| {
            format!("{} to {}", shown(low), shown(high))
        });
        let role = joint.role.word().to_lowercase();
        table.row(cells![
            &joint.name,
            joint.kind.word(),
            role,
            shown(joint.home),
            limits
        ]);
    }
    table
}

pub(super) fn chain(chain: &ChainOverview) -> Section {
    let mut title = format!("Chain {} on {}", chain.name, chain.on);
    if !chain.rows.is_empty() {
        let convention = chain.convention.word().to_lowercase();
        title += &format!(", {convention} Denavit–Hartenberg table");
    }
    let step = |name: &str, steps: &[String]| match steps.is_empty() {
        true => String::new(),
        false => format!("{name} {}", product(steps)),
    };
    let entries = |row: &RowOverview| {
        let lengths = [row.a.clone(), row.d.clone()].map(|entry| (entry, false));
        let angles = [row.alpha.clone(), row.theta.clone()].map(|entry| (entry, true));
        lengths.into_iter().chain(angles)
    };
    let mut values: Vec<String> = Vec::new();
    for (entry, is_angle) in chain.rows.iter().flat_map(entries) {
        if let (Some(value), true) = (entry.value, entry.uses_parameters) {
            let said = format!("{} = {}", entry.written, quantity(value, is_angle));
            if !values.contains(&said) {
                values.push(said);
            }
        }
    }
    let values = match values.is_empty() {
        true => String::new(),
        false => format!("with {}", values.join(", ")),
    };
    let section = Section::new(title)
        .text(step("base", &chain.base))
        .table(table(chain))
        .text(step("tip", &chain.tip))
        .text(values);
    match section.blocks.is_empty() {
        true => section.text("no joints"),
        false => section,
    }
}

fn product(steps: &[String]) -> String {
    steps.join(" ")
}

/// The table in the order of its convention, as lectures print it.
fn table(chain: &ChainOverview) -> Table {
    let modified = chain.convention == Convention::Modified;
    let columns = match modified {
        true => ["i", "αᵢ₋₁", "aᵢ₋₁", "dᵢ", "θᵢ"],
        false => ["i", "θᵢ", "dᵢ", "aᵢ", "αᵢ"],
    };
    let mut table = Table::new(columns.map(Column::words)).ruled();
    for (i, row) in chain.rows.iter().enumerate() {
        let RowOverview { alpha, a, d, theta } = row;
        let entries = match modified {
            true => [alpha, a, d, theta],
            false => [theta, d, a, alpha],
        };
        let [first, second, third, fourth] = entries.map(|entry| &entry.written);
        table.row(cells![i + 1, first, second, third, fourth]);
    }
    table
}

pub(super) fn platforms(overview: &Overview) -> Vec<Section> {
    let platform = |platform: &PlatformOverview| {
        let [x, y, z] = platform.position.map(number);
        let [roll, pitch, yaw] = platform.roll_pitch_yaw.map(degrees);
        let home = format!("home at ({x}, {y}, {z}) m, roll {roll}, pitch {pitch}, yaw {yaw}");
        let mut table = Table::new(["frame", "placed by"].map(Column::words));
        for frame in &platform.frames {
            table.row(cells![&frame.name, product(&frame.placed)]);
        }
        Section::new(format!("Platform {}", platform.name))
            .text(home)
            .table(table)
    };
    overview.platforms.iter().map(platform).collect()
}

/// The closures; none if there are none.
pub(super) fn closures(overview: &Overview) -> Option<Section> {
    let mut table = Table::new(["name", "kind", "between", "equations"].map(Column::words));
    for closure in &overview.closures {
        let [from, to] = &closure.frames;
        table.row(cells![
            &closure.name,
            closure.kind.word().to_lowercase(),
            format!("{from} and {to}"),
            format!("{}: {}", closure.equations, equations(closure))
        ]);
    }
    (!table.rows.is_empty()).then(|| Section::new("Closures").table(table))
}

/// The equations of a closure in words; the axes are the z axes of the frames.
fn equations(closure: &ClosureOverview) -> String {
    match (closure.kind, &closure.length) {
        (ClosureKind::Distance, Some(length)) => format!("origins at distance {length} (1)"),
        (ClosureKind::Distance, None) => "origins at a given distance (1)".into(),
        (ClosureKind::Spherical, _) => "origins coincide (3)".into(),
        (ClosureKind::Revolute, _) => "origins coincide (3), axes aligned (2)".into(),
        (ClosureKind::Prismatic, _) => "orientations equal (3), origins on one axis (2)".into(),
        (ClosureKind::Universal, _) => "origins coincide (3), axes perpendicular (1)".into(),
        (ClosureKind::Cylindrical, _) => "axes aligned (2), origins on one axis (2)".into(),
        (ClosureKind::Planar, _) => "axes aligned (2), origins in one plane (1)".into(),
        (ClosureKind::Rigid, _) => "origins coincide (3), orientations equal (3)".into(),
    }
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

/// The count with its terms.
fn mobility(count: &MobilityCount) -> Section {
    let MobilityCount {
        bodies,
        variables,
        platforms,
        equations,
        mobility,
        ..
    } = count;
    let mut terms = format!("6·({bodies} − 1)");
    for (number, constraints) in [(of_freedom(count, 1), 5), (of_freedom(count, 2), 4)] {
        if number > 0 {
            terms += &format!(" − {constraints}·{number}");
        }
    }
    match count.correction {
        0 => {}
        correction if correction > 0 => terms += &format!(" + {correction}"),
        correction => terms += &format!(" − {}", -correction),
    }
    let planar = count.planar.as_ref().map(|planar| {
        format!(
            "planar: {variables} + 3·{platforms} − {} = {}, as all joints move parallel to one \
             plane at home",
            planar.equations,
            signed(planar.mobility)
        )
    });
    let lines = [
        format!("{terms} − {equations} = {}", signed(*mobility)),
        explained(count),
        format!(
            "the same as {variables} + 6·{platforms} − {equations}: {}, {}, {}",
            self::count(*variables, "joint variable"),
            self::count(*platforms, "platform"),
            self::count(*equations, "closure equation"),
        ),
    ];
    Section::new("Kutzbach count").list(lines.into_iter().chain(planar))
}

/// How many rows have so many freedoms.
fn of_freedom(count: &MobilityCount, freedoms: usize) -> usize {
    let rows = count.row_freedoms.iter();
    rows.filter(|&&found| found == freedoms).count()
}

fn explained(count: &MobilityCount) -> String {
    let mut parts = vec![format!("{} with ground", self::count(count.bodies, "body"))];
    for f in [1, 2] {
        if of_freedom(count, f) > 0 {
            let joints = self::count(of_freedom(count, f), "row");
            parts.push(format!("{joints} with {}", self::count(f, "freedom")));
        }
    }
    match count.correction {
        0 => {}
        correction if correction > 0 => {
            parts.push(self::count(correction as usize, "variable") + " in distances");
        }
        correction => parts.push(
            self::count(correction.unsigned_abs() as usize, "row")
                + " driven together with another",
        ),
    }
    parts.push(self::count(count.equations, "closure equation"));
    parts.join(", ")
}

fn closed_forms(overview: &Overview) -> Table {
    let mut table = Table::new(["name", "gives", "source"].map(Column::words));
    for form in &overview.closed_forms {
        let gives = match &form.pose_of {
            Some([of, relative_to]) => {
                format!("{} of {of} in {relative_to}", count(form.formulas, "entry"))
            }
            None => count(form.formulas, "identity"),
        };
        table.row(cells![&form.name, gives, form.source.as_deref()]);
    }
    table
}
