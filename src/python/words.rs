//! Demands, settings and analyses as keywords and methods.

use crate::ask::{AskError, Demand, Remedy, Role};
use crate::output::complaint::{Complaint, Door, Ranged};
use crate::output::diagnostics::Style;

pub enum Refused {
    Asked(AskError),
    Said(Complaint),
}

impl From<AskError> for Refused {
    fn from(error: AskError) -> Self {
        Refused::Asked(error)
    }
}

/// A complaint as the message of an exception.
pub fn message(rendered: &str) -> String {
    let rendered = rendered.trim_end();
    rendered.strip_prefix("error: ").unwrap_or(rendered).into()
}

pub fn worded(said: &Complaint) -> String {
    message(&said.render(Style::Plain))
}

/// Demands as keywords. Roles that have another keyword here are `spelled` so.
#[derive(Default)]
pub struct Keywords {
    pub spelled: Vec<(Role, &'static str)>,
}

impl Door for Keywords {
    fn option(&self, role: Role, ranged: Ranged) -> String {
        let spelled = self.spelled.iter().rfind(|(of, _)| *of == role);
        let keyword = match (spelled, role, ranged) {
            (Some((_, keyword)), ..) => keyword,
            (None, Role::Input, Ranged::Locus) => "locus",
            (None, Role::Input, Ranged::Map) => "map",
            (None, role, _) => role.word(),
        };
        keyword.into()
    }

    fn remedies(&self, remedies: &[Remedy], ranged: Ranged) -> String {
        let mut words: Vec<String> = Vec::new();
        let mut demands: Vec<(Role, Vec<&Demand>)> = Vec::new();
        for remedy in remedies {
            match remedy {
                Remedy::Demand(demand) => match demands.iter_mut().find(|of| of.0 == demand.role) {
                    Some((_, of_role)) => of_role.push(demand),
                    None => demands.push((demand.role, vec![demand])),
                },
                Remedy::Role(role) => words.push(format!("`{}`", self.option(*role, ranged))),
                Remedy::Setting("circuits", _) => words.push("`.circuits`".into()),
                Remedy::Setting(setting, None) => words.push(format!("`{setting}`")),
                Remedy::Setting(setting, Some(value)) if value.contains(',') => {
                    words.push(format!("{setting}=[{}]", value.replace(',', ", ")));
                }
                Remedy::Setting(setting, Some(value)) => words.push(format!("{setting}={value}")),
                Remedy::Analysis(analysis, None) => words.push(format!("`.{analysis}`")),
                Remedy::Analysis(analysis, Some(role)) => {
                    let option = self.option(*role, ranged);
                    words.push(format!("`.{analysis}` with `{option}`"));
                }
            }
        }
        let demands = demands
            .iter()
            .map(|(role, demands)| format!("{}={}", self.option(*role, ranged), mapping(demands)));
        words.extend(demands);
        words.join(", ")
    }
}

/// `{"a": "1", "b": "2"}`, `{"a": ("0", "1")}`, `"a"` or `["a", "b"]`.
fn mapping(demands: &[&Demand]) -> String {
    let names = demands.iter().map(|demand| format!("{:?}", demand.name));
    let value = |demand: &&Demand| {
        let values = demand.values.iter();
        let values: Vec<String> = values
            .map(|value| format!("{:?}", value.to_string()))
            .collect();
        match &values[..] {
            [] => None,
            [one] => Some(one.clone()),
            several => Some(format!("({})", several.join(", "))),
        }
    };
    let values: Option<Vec<String>> = demands.iter().map(value).collect();
    match values {
        Some(values) => {
            let entries = names
                .zip(values)
                .map(|(name, value)| format!("{name}: {value}"));
            format!("{{{}}}", entries.collect::<Vec<_>>().join(", "))
        }
        None => match &names.collect::<Vec<_>>()[..] {
            [one] => one.clone(),
            several => format!("[{}]", several.join(", ")),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remedies_are_keywords() {
        let free = |name: &str| Remedy::Demand(Demand::named(Role::Free, name));
        let hold = |name: &str| Remedy::Demand(Demand::new(Role::Hold, name, ["home"]));
        let turn = Demand::new(Role::Input, "t", ["0deg", "360deg"]);
        let cases = [
            (vec![free("theta1")], Ranged::Input, "free=\"theta1\""),
            (
                vec![hold("a b"), hold("c")],
                Ranged::Input,
                "hold={\"a b\": \"home\", \"c\": \"home\"}",
            ),
            (
                vec![free("a"), free("b"), hold("c")],
                Ranged::Input,
                "free=[\"a\", \"b\"], hold={\"c\": \"home\"}",
            ),
            (
                vec![Remedy::Demand(turn)],
                Ranged::Map,
                "map={\"t\": (\"0deg\", \"360deg\")}",
            ),
            (
                vec![Remedy::Setting("steps", Some("100".into()))],
                Ranged::Input,
                "steps=100",
            ),
            (
                vec![Remedy::Analysis("sweep", Some(Role::Input))],
                Ranged::Input,
                "`.sweep` with `input`",
            ),
        ];
        for (remedies, ranged, words) in cases {
            assert_eq!(Keywords::default().remedies(&remedies, ranged), words);
        }
    }
}
