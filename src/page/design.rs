//! Designs on a page.

use serde::Serialize;

use super::request::DesignRequest;
use super::{Page, RefusedReply, answered, nothing, shown, words};
use crate::ask::{Design, DesignError};
use crate::description::{Description, DesignDescription, Entry, Named, Varied};
use crate::mechanism::Mechanism;
use crate::output::Report;
use crate::output::complaint::Complaint;
use crate::output::design::{largest, verdict};
use crate::scene::{Scene, Triple};
use crate::solve::Watch;
use serde_json::json;

/// A design as it is shown: in its first position, with the curve of its point.
#[derive(Serialize)]
struct ShownDesign {
    scene: Option<Scene>,
    curve: Vec<Triple>,
    verdict: String,
    /// The largest deviation in words.
    largest: String,
}

impl Page {
    /// Designs whose point passes through places, judged over their whole motion.
    pub(super) fn design(
        &self,
        request: &DesignRequest,
        watch: &Watch,
    ) -> Result<String, RefusedReply> {
        let wrong = |text: &str, problems: &[_]| {
            RefusedReply(json!({ "problems": shown::problems(text, problems) }))
        };
        let description = match &request.text {
            Some(text) => Description::read(text).map_err(|problems| wrong(text, &problems))?,
            None => (self.description.clone()).ok_or_else(|| nothing("no mechanism"))?,
        };
        let more = format!("Design(version: 1, mechanism: \"\", {})", request.more);
        let more = DesignDescription::read(&more).map_err(|problems| {
            let first = problems.first().map(Complaint::of);
            nothing(&first.map(words::in_a_line).unwrap_or_default())
        })?;
        let number = |value: &f64| Entry::number(*value, 0..0);
        let place = |point: &Vec<f64>| {
            let target = point.iter().map(number).collect();
            vec![Named::new(request.path.as_str(), target)]
        };
        let named = |name: &String| more.vary.iter().any(|of| of.name.value == *name);
        let vary = request.vary.iter().filter(|(name, ..)| !named(name));
        let vary = vary.map(|(name, from, to)| {
            Named::new(name.as_str(), Varied::Range([number(from), number(to)]))
        });
        let design = Design {
            asked: DesignDescription {
                vary: vary.chain(more.vary.clone()).collect(),
                positions: request.points.iter().map(place).collect(),
                any_order: request.any_order || more.any_order,
                ..more
            },
            mechanism: description,
            starts: request.starts,
            own: request.own,
            approximate: !request.exact,
            ..Design::default()
        };
        let report = design.report(watch).map_err(|error| match error {
            DesignError::Mechanism(problems) => {
                let first = problems.first();
                let why = first.map(|problem| words::in_a_line(Complaint::of(problem)));
                nothing(&why.unwrap_or_default())
            }
            DesignError::Part { problem, .. } => match problem.help() {
                Some(help) => nothing(&format!("{problem}; {help}")),
                None => nothing(&problem.to_string()),
            },
        })?;
        let shown = report.designs.iter().map(|of| {
            let drawn = design.drawn(of, watch);
            ShownDesign {
                scene: (drawn.as_ref()).map(|drawn| Scene::of(&drawn.mechanism, &drawn.at)),
                curve: drawn
                    .and_then(|drawn| drawn.curves.into_iter().next())
                    .map_or_else(Vec::new, |(_, points)| points),
                verdict: verdict(&report, of),
                largest: largest(of),
            }
        });
        let shown: Vec<ShownDesign> = shown.collect();
        let how = json!(report.document().method);
        // the page is titled by the mechanism that is shown
        let read = Mechanism::new(&design.mechanism)
            .map_err(|problems| wrong(request.text.as_deref().unwrap_or_default(), &problems))?;
        let answer = answered(&read, &report, &shown);
        Ok(format!("{{\"how\":{how},{}", &answer[1..]))
    }
}
