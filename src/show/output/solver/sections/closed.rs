//! The state in closed form.

use super::OperationWriter;
use crate::algebra::OperationIndex;

impl OperationWriter<'_> {
    /// The state in closed form; nothing if it has none.
    pub fn closed(&self) -> String {
        let Some(closed) = &self.solver.closed else {
            return String::new();
        };
        let radicands = closed.radicands.iter().flat_map(|of| [of.place, of.size]);
        let divisors = closed.divisors.iter().map(|(place, _)| *place);
        let used = self.needed(
            closed
                .state
                .iter()
                .copied()
                .chain(radicands)
                .chain(divisors),
        );
        let language = self.code.language;
        let mut text = self.text(1, false);
        text.numbers(&used, "u");
        text.numbers(&used, "x");
        text.operations(used);
        for radicand in &closed.radicands {
            let [value, size] = [radicand.place, radicand.size].map(|of| self.name(of, false));
            let negative = format!("!({value} >= -ROUNDING * {size})");
            text.line(&language.returns_if("@apart@", &negative));
            text.line(&format!(
                "singular |= {value} < @singular@@f@ * @singular@@f@ * {size};\n"
            ));
        }
        for &(place, least) in &closed.divisors {
            let least = self.code.literal(least);
            let zero = format!("!(@fabs@({}) > {least})", self.name(place, false));
            text.line(&language.returns_if("@undetermined@", &zero));
        }
        for (i, &place) in closed.state.iter().enumerate() {
            text.line(&format!("x[{i}] = {};\n", self.name(place, false)));
        }
        text.text
    }

    /// The number of a sign at a place.
    pub(super) fn sign_of(&self, place: OperationIndex) -> Option<usize> {
        let closed = self.solver.closed.as_ref()?;
        closed.signs.iter().position(|sign| *sign == place)
    }
}
