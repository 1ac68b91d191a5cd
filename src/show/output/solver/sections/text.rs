//! Operations written one after another, each under a name.

use std::collections::BTreeSet;

use super::OperationWriter;
use crate::algebra::{Operation, OperationIndex};
use crate::output::solver::language::{bound, operation};

/// The text of one function, with what is already written in it.
pub(super) struct Text<'w, 'a> {
    pub(super) writer: &'w OperationWriter<'a>,
    pub(super) text: String,
    pub(super) indent: usize,
    pub(super) known: BTreeSet<OperationIndex>,
    /// True if sines and cosines of the state have names of their own.
    pub(super) carries: bool,
}

impl Text<'_, '_> {
    pub(super) fn line(&mut self, lines: &str) {
        for line in lines.lines() {
            self.text += &"    ".repeat(self.indent);
            self.text += line;
            self.text.push('\n');
        }
    }

    /// The numbers of an array that are used, each under the name of the array and its place.
    pub(super) fn numbers(&mut self, used: &BTreeSet<OperationIndex>, array: &str) {
        for &place in used {
            if let Operation::Input(_) = self.writer.solver.operations[place as usize] {
                let name = self.writer.name(place, false);
                if let Some(number) = name
                    .strip_prefix(array)
                    .filter(|of| of.parse::<usize>().is_ok())
                {
                    self.line(&bound(&name, &format!("{array}[{number}]")));
                }
            }
        }
    }

    /// Gives up where a pivot that is used is too small.
    pub(super) fn pivots(&mut self, used: &BTreeSet<OperationIndex>) {
        let OperationWriter { code, solver, .. } = self.writer;
        let pivots = solver.pivots.iter();
        for pivot in pivots.filter(|pivot| used.contains(&pivot.inverse)) {
            self.operations(self.writer.needed([pivot.place]));
            let name = self.writer.name(pivot.place, self.carries);
            let scale = code.literal(pivot.scale);
            let small = format!("!(@fabs@({name}) > {scale} * LEAST_PIVOT)");
            self.line(&code.language.gives_up_if(&small));
        }
    }

    /// Operations that are not written yet.
    pub(super) fn operations(&mut self, places: impl IntoIterator<Item = OperationIndex>) {
        let places: BTreeSet<OperationIndex> = places.into_iter().collect();
        for &place in &places {
            if !self.known.insert(place) {
                continue;
            }
            let writer = self.writer;
            let carries = self.carries;
            let name = |place: OperationIndex| writer.name(place, carries);
            match writer.solver.operations[place as usize] {
                Operation::Constant(_) | Operation::Input(_) => {}
                Operation::Sin(angle) | Operation::Cos(angle) => {
                    if carries && writer.state_of(angle).is_some() {
                        continue;
                    }
                    self.turned(place, angle);
                }
                of => {
                    let value = match writer.root_under(place) {
                        Some((x, y)) => {
                            let inverse = format!("@own@inverse_root({})", name(y));
                            match writer.solver.operations[x as usize] {
                                Operation::Constant(1.0) => inverse,
                                _ => format!("{} * {inverse}", name(x)),
                            }
                        }
                        None => operation(of, &name),
                    };
                    let value = match writer.sign_of(place) {
                        Some(number) => writer.code.language.sign(number, &value),
                        None => value,
                    };
                    self.line(&bound(&name(place), &value));
                }
            }
        }
    }

    /// Sine and cosine of an angle, of which both are written where either is used.
    fn turned(&mut self, place: OperationIndex, angle: OperationIndex) {
        let writer = self.writer;
        let all = writer.solver.operations.iter().enumerate();
        let partner = |wanted: Operation| all.clone().find(|(_, of)| **of == wanted);
        let place_of = |wanted| partner(wanted).map(|(place, _)| place as OperationIndex);
        let sin = place_of(Operation::Sin(angle)).unwrap_or(place);
        let cos = place_of(Operation::Cos(angle)).unwrap_or(place);
        self.known.extend([sin, cos]);
        let name = |place| writer.name(place, self.carries);
        let language = writer.code.language;
        let line = language.turned(&name(sin), &name(cos), &name(angle), false);
        self.line(&line);
    }
}
