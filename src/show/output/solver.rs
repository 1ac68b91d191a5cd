//! A solver as source code: C99 or Rust without the standard library, one file without dependencies.

mod language;
mod sections;

pub use language::{Language, Precision};

use crate::analysis::solver::{Component, LEAST_PIVOT, Solver};
use crate::ask::{SampleAnswer, SampleForces};
use sections::OperationWriter;

/// Settings of generated code.
#[derive(Clone, Debug, PartialEq)]
pub struct Code {
    /// The language.
    pub language: Language,
    /// The numbers.
    pub precision: Precision,
    /// Prefix of the names in the code; a Rust module needs none and has this one as its own.
    pub name: String,
}

impl Code {
    /// The solver.
    pub fn solver(&self, solver: &Solver) -> String {
        let language = self.language;
        let writer = OperationWriter::new(self, solver);
        let values = |of: &[Component]| self.numbers(of.iter().map(|component| component.value));
        let sections = [
            ("heading", self.heading(solver)),
            ("start_inputs", values(&solver.inputs)),
            ("start_state", values(&solver.state)),
            ("fast", writer.fast()),
            ("linearise", writer.linearise()),
            ("slopes", writer.slopes()),
            ("apart", writer.apart()),
            ("limits", writer.limits()),
            ("rates", writer.rates()),
            ("move", writer.moved()),
            ("normalise", writer.normalise()),
            ("frames", writer.frames()),
            ("sine", self.sine()),
            ("closed", writer.closed()),
            ("forces", self.forces(solver)),
            ("arctangent", self.arctangent()),
        ];
        let parts = [
            ("iteration", solver.closed.is_none()),
            ("closed form", solver.closed.is_some()),
            ("forces", solver.forces.is_some()),
            (
                "functions",
                solver.closed.is_some() || solver.forces.is_some(),
            ),
        ];
        let left_out = parts.iter().filter(|(_, kept)| !kept);
        let left_out: Vec<&str> = left_out.map(|(part, _)| *part).collect();
        let mut filled = without(language.template(), &left_out);
        for (name, section) in sections {
            filled = filled.replace(&format!("@{name}@\n"), &section);
        }
        self.named(filled, solver)
    }

    /// The forces at the inputs; nothing if they are not wanted.
    fn forces(&self, solver: &Solver) -> String {
        // a sign of the closed form may be given there, but not here
        let here = Solver {
            closed: None,
            ..solver.clone()
        };
        let writer = OperationWriter::new(self, &here);
        let program = solver.forces.as_ref();
        program.map_or(String::new(), |program| writer.forces(program))
    }

    /// A program that runs the solver through configurations found by the library, each from the one before it, with the
    /// forces there if they are wanted, and fails if a number differs by more than it should.
    pub fn test(
        &self,
        solver: &Solver,
        examples: &[SampleAnswer],
        forces: &[SampleForces],
    ) -> String {
        let written = |numbers: Vec<f64>| {
            let row = self.numbers(numbers.into_iter());
            format!("    @open@{}@shut@,\n", row.trim_end().replace('\n', ""))
        };
        let rows = examples.iter();
        let rows = rows.map(|(inputs, state)| written([&inputs[..], state].concat()));
        let forces = forces.iter().map(|of| written(of.concat()));
        let left_out: &[&str] = match solver.forces {
            Some(_) => &[],
            None => &["forces"],
        };
        let text = without(self.language.test_template(), left_out)
            .replace("@examples@\n", &rows.collect::<String>())
            .replace("@driven@\n", &forces.collect::<String>());
        self.named(
            text.replace("@example_count@", &examples.len().to_string()),
            solver,
        )
    }

    /// The names and counts put in.
    fn named(&self, text: String, solver: &Solver) -> String {
        let signs = solver.closed.as_ref();
        let counts = [
            ("@inputs@", solver.inputs.len()),
            ("@state@", solver.state.len()),
            ("@iterated@", solver.first_following()),
            ("@unknowns@", solver.unknowns),
            ("@rows@", solver.residual.len()),
            ("@equations@", solver.slopes.len()),
            ("@steps@", solver.step.len()),
            ("@frame_count@", solver.frames.len()),
            ("@signs@", signs.map_or(0, |closed| closed.signs.len())),
        ];
        let text = counts.into_iter().fold(text, |text, (name, count)| {
            text.replace(name, &count.to_string())
        });
        let unknowns = solver.step.iter().map(|(unknown, _)| unknown.to_string());
        let unknowns: Vec<String> = unknowns.collect();
        let text = text.replace("@unknown_of_steps@", &unknowns.join(", "));
        let text = text.replace("@curvature@", &self.literal(solver.curvature));
        let text = text.replace("@least_pivot@", &format!("{LEAST_PIVOT:e}"));
        let words = self.words();
        let text = words.fold(text, |text, (name, word)| text.replace(name, word));
        text.replace("@NAME@", &self.name.to_uppercase())
            .replace("@name@", &self.name)
    }

    fn numbers(&self, numbers: impl Iterator<Item = f64>) -> String {
        let numbers = numbers.map(|x| self.literal(x));
        let numbers: Vec<String> = numbers.collect();
        let lines = numbers
            .chunks(4)
            .map(|line| format!("    {},\n", line.join(", ")));
        lines.collect()
    }

    /// Heading: the unknowns, units and the order of arrays.
    fn heading(&self, solver: &Solver) -> String {
        let list = |components: &[Component]| -> String {
            let lines = components.iter().enumerate().map(|(i, component)| {
                let unit = component.unit.to_string();
                let comma = if unit.is_empty() { "" } else { ", " };
                format!("   {i:>3}  {}{comma}{unit}\n", plain(&component.name))
            });
            lines.collect()
        };
        let mut lines = format!(
            "{}\n\nSolver written by linkwork {}.\n\nInputs, what is held:\n{}\nState, what is found:\n{}",
            plain(&solver.mechanism),
            env!("CARGO_PKG_VERSION"),
            list(&solver.inputs),
            list(&solver.state),
        );
        let mut state = solver.state.iter();
        if state.any(|component| component.unit.to_string().is_empty()) {
            lines += "qw, qx, qy, qz is the unit quaternion of a platform, ground from platform.\n";
            if solver.centre != [0.0; 3] {
                let [x, y, z] = solver.centre;
                lines += &format!("Its position is from ({x}, {y}, {z}) m in ground.\n");
            }
        }
        if let Some(program) = &solver.forces {
            lines += "\nForces, what drives the inputs:\n";
            for (i, (input, force)) in solver.inputs.iter().zip(&program.forces).enumerate() {
                lines += &format!("   {i:>3}  {}, {}\n", plain(&input.name), force.unit);
            }
        }
        if !solver.frames.is_empty() {
            lines += "\nFrames:\n";
            for (i, frame) in solver.frames.iter().enumerate() {
                lines += &format!("   {i:>3}  {}\n", plain(&frame.name));
            }
        }
        let comment = self.language.comment();
        let lines = lines
            .lines()
            .map(|line| format!("{comment} {line}").trim_end().to_owned() + "\n");
        lines.collect()
    }
}

/// A template without the parts of some kinds, which stand between `@only <kind>@` and `@end@`.
fn without(template: &str, kinds: &[&str]) -> String {
    let mut left_out = false;
    let mut kept = String::with_capacity(template.len());
    for line in template.lines() {
        match line.strip_prefix("@only ") {
            Some(of) => left_out = (of.strip_suffix('@')).is_some_and(|of| kinds.contains(&of)),
            None if line == "@end@" => left_out = false,
            None if left_out => {}
            None => kept += &format!("{line}\n"),
        }
    }
    kept
}

/// A name on one line of a comment, which it cannot end.
fn plain(name: &str) -> String {
    name.replace(|c: char| c.is_control() || c == '\\', " ")
        .replace("*/", "* /")
        .replace("??", "? ?")
}
