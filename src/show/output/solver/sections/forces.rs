//! The forces that drive the inputs.

use super::OperationWriter;
use crate::analysis::solver::ForceProgram;

impl OperationWriter<'_> {
    /// The forces at the inputs into an array.
    pub fn forces(&self, program: &ForceProgram) -> String {
        let decisions = program.decisions.iter();
        let places = decisions.clone().map(|(place, _)| *place);
        let used = self.needed(places.chain(program.forces.iter().map(|of| of.place)));
        let mut text = self.text(1, false);
        for array in ["u", "x", "v", "a"] {
            text.numbers(&used, array);
        }
        text.operations(self.needed(decisions.clone().map(|(place, _)| *place)));
        for (place, negative) in decisions {
            let holds = match negative {
                true => "<",
                false => ">=",
            };
            let name = self.name(*place, false);
            let zero = self.code.literal(0.0);
            let singular = format!("!({name} {holds} {zero})");
            text.line(&self.code.language.gives_up_if(&singular));
        }
        text.operations(used);
        for (i, force) in program.forces.iter().enumerate() {
            let name = self.name(force.place, false);
            text.line(&format!("force[{i}] = {name};\n"));
        }
        text.text
    }
}
