//! What a mechanism file means, drawn as a lecture draws it.

use std::fmt::Write;

use super::json::document;
use super::layout::{align_right, indented, plain, ruled};
use super::quantity::{degrees, number, quantity};
use crate::analysis::overview::{
    ChainOverview, ClosureOverview, LoopStep, MobilityCount, Overview, PlatformOverview,
    RowOverview,
};
use crate::description::{ClosureKind, Convention, count};

/// The overview as JSON.
pub fn json(overview: &Overview) -> String {
    document(&overview.name, overview)
}

/// The overview as text.
pub fn text(overview: &Overview) -> String {
    let mut sections = vec![heading(overview)];
    if !overview.parameters.is_empty() {
        sections.push(parameters(overview));
    }
    if !overview.joints.is_empty() {
        sections.push(joints(overview));
    }
    sections.extend(overview.chains.iter().map(chain));
    sections.extend(platforms(overview));
    if !overview.closures.is_empty() {
        sections.push(closures(overview));
        sections.push(loops(overview));
    }
    sections.push(mobility(&overview.count));
    if !overview.closed_forms.is_empty() {
        sections.push(closed_forms(overview));
    }
    sections.join("\n")
}

pub(super) fn heading(overview: &Overview) -> String {
    match &overview.source {
        Some(source) => format!("{}\n  {source}\n", overview.name),
        None => format!("{}\n", overview.name),
    }
}

fn parameters(overview: &Overview) -> String {
    let mut table = plain(["name", "value", "defined as"]);
    for parameter in &overview.parameters {
        let value = number(parameter.value);
        let definition = match parameter.definition.parse() == Ok(parameter.value) {
            true => "",
            false => &parameter.definition,
        };
        table.add_row([&parameter.name, &value, definition]);
    }
    align_right(&mut table, [1]);
    format!("Parameters\n{}", indented(&table.to_string()))
}

fn joints(overview: &Overview) -> String {
    let mut table = plain(["name", "kind", "role", "home", "limits"]);
    for joint in &overview.joints {
        let shown = |value| match joint.unit {
            Some(unit) => quantity(value, unit.is_angle()),
            None => number(value),
        };
        let limits = joint.limits.map_or("none".to_owned(), |(low, high)| {
            format!("{} to {}", shown(low), shown(high))
        });
        let role = joint.role.word().to_lowercase();
        table.add_row([
            &joint.name,
            joint.kind.word(),
            &role,
            &shown(joint.home),
            &limits,
        ]);
    }
    align_right(&mut table, [3]);
    format!("Joints\n{}", indented(&table.to_string()))
}

pub(super) fn chain(chain: &ChainOverview) -> String {
    let mut text = format!("Chain {} on {}", chain.name, chain.on);
    if !chain.rows.is_empty() {
        let convention = chain.convention.word().to_lowercase();
        let _ = write!(text, ", {convention} Denavit–Hartenberg table");
    }
    text.push('\n');
    if !chain.base.is_empty() {
        let _ = writeln!(text, "  base {}", product(&chain.base));
    }
    if !chain.rows.is_empty() {
        text += &indented(&table(chain));
    }
    if !chain.tip.is_empty() {
        let _ = writeln!(text, "  tip {}", product(&chain.tip));
    }
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
    if !values.is_empty() {
        let _ = writeln!(text, "  with {}", values.join(", "));
    }
    text
}

fn product(steps: &[String]) -> String {
    steps.join(" ")
}

/// The table in the order of its convention, as lectures print it.
fn table(chain: &ChainOverview) -> String {
    let modified = chain.convention == Convention::Modified;
    let mut table = match modified {
        true => ruled(["i", "αᵢ₋₁", "aᵢ₋₁", "dᵢ", "θᵢ"]),
        false => ruled(["i", "θᵢ", "dᵢ", "aᵢ", "αᵢ"]),
    };
    for (i, row) in chain.rows.iter().enumerate() {
        let RowOverview { alpha, a, d, theta } = row;
        let entries = match modified {
            true => [alpha, a, d, theta],
            false => [theta, d, a, alpha],
        };
        let [first, second, third, fourth] = entries.map(|entry| entry.written.clone());
        table.add_row([(i + 1).to_string(), first, second, third, fourth]);
    }
    table.to_string()
}

pub(super) fn platforms(overview: &Overview) -> Vec<String> {
    let platform = |platform: &PlatformOverview| {
        let [x, y, z] = platform.position.map(number);
        let [roll, pitch, yaw] = platform.roll_pitch_yaw.map(degrees);
        let mut text = format!("Platform {}\n", platform.name);
        let _ = writeln!(
            text,
            "  home at ({x}, {y}, {z}) m, roll {roll}, pitch {pitch}, yaw {yaw}"
        );
        if !platform.frames.is_empty() {
            let mut table = plain(["frame", "placed by"]);
            for frame in &platform.frames {
                table.add_row([&frame.name, &product(&frame.placed)]);
            }
            text += &indented(&table.to_string());
        }
        text
    };
    overview.platforms.iter().map(platform).collect()
}

pub(super) fn closures(overview: &Overview) -> String {
    let mut table = plain(["name", "kind", "between", "equations"]);
    for closure in &overview.closures {
        let [from, to] = &closure.frames;
        let kind = closure.kind.word().to_lowercase();
        table.add_row([
            &closure.name,
            &kind,
            &format!("{from} and {to}"),
            &format!("{}: {}", closure.equations, equations(closure)),
        ]);
    }
    format!("Closures\n{}", indented(&table.to_string()))
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

fn loops(overview: &Overview) -> String {
    let title = match overview.loops.len() {
        0 => return "Loops\n  none\n".into(),
        number => format!("Loops: {number}\n"),
    };
    let step = |step: &LoopStep| match step {
        LoopStep::Ground => "ground".to_owned(),
        LoopStep::Platform(name) | LoopStep::Chain(name) => name.clone(),
        LoopStep::Closure(name) => format!("[{name}]"),
    };
    let lines = overview.loops.iter().enumerate().map(|(i, found)| {
        let steps: Vec<String> = found.steps.iter().map(step).collect();
        format!("  {}: {}\n", i + 1, steps.join(" - "))
    });
    title + &lines.collect::<String>()
}

/// The count with its terms.
fn mobility(count: &MobilityCount) -> String {
    let mut text = String::from("Kutzbach count\n");
    let MobilityCount {
        bodies,
        variables,
        platforms,
        equations,
        mobility,
        ..
    } = count;
    let of_freedom = |f: usize| {
        count
            .row_freedoms
            .iter()
            .filter(|&&found| found == f)
            .count()
    };
    let mut terms = format!("6·({bodies} − 1)");
    for (number, constraints) in [(of_freedom(1), 5), (of_freedom(2), 4)] {
        if number > 0 {
            let _ = write!(terms, " − {constraints}·{number}");
        }
    }
    match count.correction {
        0 => {}
        correction if correction > 0 => terms += &format!(" + {correction}"),
        correction => terms += &format!(" − {}", -correction),
    }
    let _ = writeln!(
        text,
        "  {terms} − {equations} = {mobility}",
        mobility = signed(*mobility)
    );
    let _ = writeln!(text, "  {}", explained(count));
    let _ = writeln!(
        text,
        "  the same as {variables} + 6·{platforms} − {equations}: {}, {}, {}",
        self::count(*variables, "joint variable"),
        self::count(*platforms, "platform"),
        self::count(*equations, "closure equation"),
    );
    if let Some(planar) = &count.planar {
        let _ = writeln!(
            text,
            "  planar: {variables} + 3·{platforms} − {} = {}, as all joints move parallel to one \
             plane at home",
            planar.equations,
            signed(planar.mobility)
        );
    }
    text
}

fn signed(number: i64) -> String {
    number.to_string().replace('-', "−")
}

fn explained(count: &MobilityCount) -> String {
    let of_freedom = |f: usize| {
        count
            .row_freedoms
            .iter()
            .filter(|&&found| found == f)
            .count()
    };
    let mut parts = vec![format!("{} with ground", bodies(count.bodies))];
    for f in [1, 2] {
        if of_freedom(f) > 0 {
            let joints = self::count(of_freedom(f), "row");
            parts.push(format!("{joints} with {}", self::count(f, "freedom")));
        }
    }
    match count.correction {
        0 => {}
        correction if correction > 0 => {
            parts.push(self::count(correction as usize, "variable") + " in distances");
        }
        correction => parts.push(
            self::count(correction.unsigned_abs() as usize, "row") + " driven along with another",
        ),
    }
    parts.push(self::count(count.equations, "closure equation"));
    parts.join(", ")
}

fn bodies(number: usize) -> String {
    match number {
        1 => "1 body".into(),
        _ => format!("{number} bodies"),
    }
}

fn closed_forms(overview: &Overview) -> String {
    let mut table = plain(["name", "gives", "source"]);
    for form in &overview.closed_forms {
        let gives = match &form.pose_of {
            Some([of, relative_to]) => {
                format!("{} of {of} in {relative_to}", count(form.formulas, "entry"))
            }
            None if form.formulas == 1 => "1 identity".into(),
            None => format!("{} identities", form.formulas),
        };
        table.add_row([&form.name, &gives, form.source.as_deref().unwrap_or("")]);
    }
    format!("Closed forms\n{}", indented(&table.to_string()))
}
