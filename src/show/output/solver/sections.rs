//! The straight-line parts of a solver.

mod closed;
mod forces;
mod keeping;
mod text;

use std::collections::{BTreeMap, BTreeSet};

use super::language::{bound, larger, variable};
use super::{Code, Language};
use crate::algebra::{Operation, OperationIndex};
use crate::analysis::solver::{Component, Solver};
use text::Text;

/// Writes operations in the language of the code.
pub(super) struct OperationWriter<'a> {
    code: &'a Code,
    solver: &'a Solver,
    /// For each operation, true if it depends on held coordinates only.
    given: Vec<bool>,
}

impl<'a> OperationWriter<'a> {
    pub fn new(code: &'a Code, solver: &'a Solver) -> Self {
        let mut given: Vec<bool> = Vec::with_capacity(solver.operations.len());
        for operation in &solver.operations {
            let of_inputs = match *operation {
                Operation::Input(i) => (i as usize) < solver.inputs.len(),
                _ => operation.operands().all(|place| given[place as usize]),
            };
            given.push(of_inputs);
        }
        OperationWriter {
            code,
            solver,
            given,
        }
    }

    fn text(&self, indent: usize, carries: bool) -> Text<'_, 'a> {
        Text {
            writer: self,
            text: String::new(),
            indent,
            known: BTreeSet::new(),
            carries,
        }
    }

    fn name(&self, place: OperationIndex, carries: bool) -> String {
        let (given, kept) = (self.solver.inputs.len(), self.solver.state.len());
        match self.solver.operations[place as usize] {
            Operation::Constant(x) => self.code.operand(x),
            Operation::Input(i) => match i as usize {
                i if i < given => format!("u{i}"),
                i if i < given + kept => format!("x{}", i - given),
                i => match i.checked_sub(given + kept + self.solver.unknowns) {
                    None => format!("d{}", i - given - kept),
                    Some(i) if i < given => format!("v{i}"),
                    Some(i) if i < 2 * given => format!("a{}", i - given),
                    Some(_) => "time".into(),
                },
            },
            Operation::Sin(angle) if carries && self.state_of(angle).is_some() => {
                format!("s{}", self.state_of(angle).unwrap_or_default())
            }
            Operation::Cos(angle) if carries && self.state_of(angle).is_some() => {
                format!("c{}", self.state_of(angle).unwrap_or_default())
            }
            _ => format!("t{place}"),
        }
    }

    /// The number of the state at a place.
    fn state_of(&self, place: OperationIndex) -> Option<usize> {
        let (given, kept) = (self.solver.inputs.len(), self.solver.state.len());
        match self.solver.operations[place as usize] {
            Operation::Input(i) => (i as usize).checked_sub(given).filter(|i| *i < kept),
            _ => None,
        }
    }

    /// Operations needed for places, in order.
    fn needed(&self, places: impl IntoIterator<Item = OperationIndex>) -> BTreeSet<OperationIndex> {
        let mut needed = BTreeSet::new();
        let mut open: Vec<OperationIndex> = places.into_iter().collect();
        while let Some(place) = open.pop() {
            if needed.insert(place) {
                match self.root_under(place) {
                    Some((of, square)) => open.extend([of, square]),
                    None => open.extend(self.solver.operations[place as usize].operands()),
                }
            }
        }
        needed
    }

    /// For x/√y the places of x and y: it is written with 1/√y.
    fn root_under(&self, place: OperationIndex) -> Option<(OperationIndex, OperationIndex)> {
        let operations = &self.solver.operations;
        match operations[place as usize] {
            Operation::Divide(x, root) => match operations[root as usize] {
                Operation::Root(y) => Some((x, y)),
                _ => None,
            },
            _ => None,
        }
    }

    /// The numbers of the state whose sines or cosines are used.
    fn angles(&self, used: &BTreeSet<OperationIndex>) -> BTreeSet<usize> {
        let angles =
            used.iter()
                .filter_map(|&place| match self.solver.operations[place as usize] {
                    Operation::Sin(angle) | Operation::Cos(angle) => self.state_of(angle),
                    _ => None,
                });
        angles.collect()
    }

    /// Newton's method where every step is a good one.
    pub fn fast(&self) -> String {
        let solver = self.solver;
        let language = self.code.language;
        let zero = self.code.literal(0.0);
        let steps = || solver.step.iter().map(|(_, place)| *place);
        let rows = || solver.iterated.iter().map(|(row, _)| *row);
        let used = self.needed(rows().chain(steps()));
        let follows: BTreeMap<usize, OperationIndex> = solver.placed.iter().copied().collect();
        let free: Vec<usize> = (0..solver.state.len())
            .filter(|i| !follows.contains_key(i))
            .collect();
        let angles = self.angles(&used);
        let mut text = self.text(1, true);
        text.numbers(&used, "u");
        text.operations(
            used.iter()
                .copied()
                .filter(|&place| self.given[place as usize]),
        );
        for i in &free {
            text.line(&variable(&format!("x{i}"), &format!("x[{i}]")));
        }
        for i in &angles {
            let [s, c, x] = ["s", "c", "x"].map(|letter| format!("{letter}{i}"));
            text.line(&language.turned(&s, &c, &x, true));
        }
        text.line(&variable("last", "LARGE"));
        text.line(match language {
            Language::C => "int k;\nfor (k = 0; k < MOST_STEPS; ++k) {\n",
            Language::Rust => "for _ in 0..MOST_STEPS {\n",
        });
        text.indent = 2;
        text.operations(self.needed(rows()));
        text.line(&variable("size", &zero));
        for &(row, factor) in &solver.iterated {
            let name = self.name(row, true);
            let factor = (factor != 1.0).then(|| self.code.literal(factor));
            let row = factor.map_or(name.clone(), |factor| format!("{factor} * {name}"));
            text.line(&larger("size", &row));
        }
        // where rounding is reached the rows no longer halve
        let settled = "!(size < HALF * last)";
        let condition = match language {
            Language::C => {
                format!("if (size <= TOLERANCE || (size <= ROUNDING && {settled})) {{\n")
            }
            Language::Rust => {
                format!("if size <= TOLERANCE || size <= ROUNDING && {settled} {{\n")
            }
        };
        text.line(&condition);
        text.indent = 3;
        let known = text.known.clone();
        let of_placed = self.needed(follows.values().copied());
        let before = of_placed.iter().filter_map(|&place| self.state_of(place));
        for i in before.filter(|i| follows.contains_key(i)) {
            text.line(&bound(&format!("x{i}"), &format!("x[{i}]")));
        }
        text.operations(of_placed.iter().copied());
        text.pivots(&of_placed);
        for i in 0..solver.state.len() {
            let value = follows.get(&i).map(|&place| self.name(place, true));
            let value = value.unwrap_or_else(|| format!("x{i}"));
            text.line(&format!("x[{i}] = {value};\n"));
        }
        text.line("return @yes@;\n");
        text.known = known;
        text.indent = 2;
        text.line("}\n");
        text.line("/* a step that does not halve the rows is not to be trusted */\n");
        text.line(&language.gives_up_if(settled));
        text.line("last = size;\n");
        text.operations(self.needed(steps()));
        text.pivots(&used);
        for (i, part) in &solver.step {
            text.line(&bound(&format!("d{i}"), &self.name(*part, true)));
        }
        text.line(&variable("longest", &zero));
        for (i, _) in &solver.step {
            text.line(&larger("longest", &format!("d{i}")));
        }
        text.line(&language.gives_up_if("!(longest <= LONGEST_STEP)"));
        text.operations(self.needed(free.iter().map(|i| solver.moved[*i])));
        for &i in &angles {
            let by = self.change(i);
            text.line(&language.turned_on(&format!("s{i}"), &format!("c{i}"), &by));
        }
        // all at once: one may depend on another
        for i in &free {
            text.line(&bound(&format!("y{i}"), &self.name(solver.moved[*i], true)));
        }
        for i in &free {
            text.line(&format!("x{i} = y{i};\n"));
        }
        text.indent = 1;
        text.line("}\n");
        text.text
    }

    /// Change of a number of the state by a step, in code.
    fn change(&self, i: usize) -> String {
        let to = self.solver.moved[i];
        match self.solver.operations[to as usize] {
            Operation::Add(x, d) if self.state_of(x) == Some(i) => self.name(d, true),
            _ => format!("{} - x{i}", self.name(to, true)),
        }
    }

    /// Rows and Jacobian into arrays.
    pub fn linearise(&self) -> String {
        self.rows(&self.solver.residual, &self.solver.jacobian)
    }

    fn rows(&self, rows: &[OperationIndex], jacobian: &[Vec<OperationIndex>]) -> String {
        let used = self.needed(rows.iter().chain(jacobian.iter().flatten()).copied());
        let mut text = self.text(1, false);
        text.numbers(&used, "u");
        text.numbers(&used, "x");
        text.operations(used);
        for (i, &row) in rows.iter().enumerate() {
            text.line(&format!("r[{i}] = {};\n", self.name(row, false)));
        }
        for (i, row) in jacobian.iter().enumerate() {
            for (k, &entry) in row.iter().enumerate() {
                text.line(&format!("j[{i}][{k}] = {};\n", self.name(entry, false)));
            }
        }
        text.text
    }

    /// The state moved by a step.
    pub fn moved(&self) -> String {
        let moved = &self.solver.moved;
        let used = self.needed(moved.iter().copied());
        let mut text = self.text(1, false);
        text.numbers(&used, "x");
        for i in 0..self.solver.unknowns {
            let read = format!("d[{i}]");
            text.line(&bound(&format!("d{i}"), &read));
        }
        text.operations(used);
        for (i, &to) in moved.iter().enumerate() {
            text.line(&format!("y[{i}] = {};\n", self.name(to, false)));
        }
        text.text
    }

    /// Unit quaternions after a small change, but for those that are not iterated: one step of Newton's method for 1/√(q·q).
    pub fn normalise(&self) -> String {
        let mut text = self.text(1, false);
        let placed = |i: usize| self.solver.placed.iter().any(|(of, _)| *of == i);
        let first =
            |&(i, component): &(usize, &Component)| component.name.ends_with(".qw") && !placed(i);
        for (i, _) in self.solver.state.iter().enumerate().filter(first) {
            let squares: Vec<String> = (i..i + 4).map(|i| format!("x[{i}] * x[{i}]")).collect();
            let of = |x: f64| self.code.literal(x);
            let factor = format!("{} - {} * ({})", of(1.5), of(0.5), squares.join(" + "));
            text.line(&bound(&format!("f{i}"), &factor));
            (i..i + 4).for_each(|k| text.line(&format!("x[{k}] *= f{i};\n")));
        }
        text.text
    }

    /// Poses and twists of frames into arrays.
    pub fn frames(&self) -> String {
        let frames = &self.solver.frames;
        let places = frames
            .iter()
            .flat_map(|f| f.pose.iter().chain(f.twists.iter().flatten()));
        let used = self.needed(places.copied());
        let mut text = self.text(1, false);
        text.numbers(&used, "u");
        text.numbers(&used, "x");
        text.operations(used.iter().copied());
        text.pivots(&used);
        for (f, frame) in frames.iter().enumerate() {
            for (i, &place) in frame.pose.iter().enumerate() {
                text.line(&format!("pose[{f}][{i}] = {};\n", self.name(place, false)));
            }
            for (input, twist) in frame.twists.iter().enumerate() {
                for (i, &place) in twist.iter().enumerate() {
                    let name = self.name(place, false);
                    text.line(&format!("twist[{f}][{input}][{i}] = {name};\n"));
                }
            }
        }
        text.text
    }
}
