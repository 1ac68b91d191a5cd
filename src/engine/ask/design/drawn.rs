//! Designs as they are drawn.

use super::Design;
use crate::algebra::Measure;
use crate::analysis::design;
use crate::analysis::sweep::{Row, SweepSettings};
use crate::ask::Question;
use crate::description::{Description, Entry};
use crate::mechanism::{Configuration, Mechanism};
use crate::solve::Watch;
use crate::system::Value;

/// A design in its first position, with what it shall reach. Positions are in ground, in m.
#[derive(Clone, Debug)]
pub struct DrawnDesign {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Its configuration in the first position.
    pub at: Configuration<f64>,
    /// Configurations along its motion; none where it has several freedoms.
    pub moving: Vec<Configuration<f64>>,
    /// The points that have targets, with their curves where the mechanism has one freedom.
    pub curves: Vec<(String, Vec<[f64; 3]>)>,
    /// The positions with targets of a point, by their numbers from 1.
    pub targets: Vec<(usize, [f64; 3])>,
}

impl Design {
    /// The contents of a picture of a design; `None` for one that does not assemble.
    pub fn drawn(&self, design: &design::FoundDesign, watch: &Watch) -> Option<DrawnDesign> {
        let description = Description::read(&design.file).ok()?;
        let mechanism = Mechanism::new(&description).ok()?;
        let question = Question::new(mechanism.clone());
        let (_, at) = question.configurations(watch).ok()?.into_iter().next()?;
        let length = |entry: &Entry| {
            let text = Value::Text(entry.expression.to_string());
            text.number(&mechanism, Measure::Length).ok()
        };
        let mut curves: Vec<(String, Vec<[f64; 3]>)> = Vec::new();
        let mut targets = Vec::new();
        let asked = self.asked.clone().with_box();
        for (k, position) in asked.positions.iter().enumerate() {
            for named in position.iter().filter(|named| named.value.len() > 1) {
                let mut target = [0.0; 3];
                for (x, entry) in target.iter_mut().zip(&named.value) {
                    *x = length(entry)?;
                }
                targets.push((k + 1, target));
                let name = &named.name.value;
                if curves.iter().all(|(known, _)| known != name) {
                    curves.push((name.clone(), Vec::new()));
                }
            }
        }
        let settings = SweepSettings {
            follow: true,
            between: true,
            ..SweepSettings::default()
        };
        let points = curves
            .iter()
            .map(|(name, _)| with_numbers(&mechanism, name));
        let points: Vec<String> = points.collect::<Option<_>>()?;
        let question = points.into_iter().fold(question, Question::point);
        let mut moving = Vec::new();
        let mut sink = |_: Option<usize>, row: &Row| {
            let curves = curves.iter_mut().zip(row.points);
            curves.for_each(|((_, curve), point)| curve.push(*point));
            moving.push(row.configuration.clone());
        };
        if let Ok(motions) = question.motions(&settings, watch) {
            motions.report(2, &mut sink, watch);
        }
        Some(DrawnDesign {
            mechanism,
            at,
            moving,
            curves,
            targets,
        })
    }
}

/// A point, whose offsets may be expressions, with numbers.
pub(super) fn with_numbers(mechanism: &Mechanism, name: &str) -> Option<String> {
    let Some((frame, offsets)) = name.split_once('+') else {
        return Some(name.to_owned());
    };
    let offsets = offsets.split(',').map(|text| {
        let text = Value::Text(text.trim().to_owned());
        Some(text.number(mechanism, Measure::Length).ok()?.to_string())
    });
    let offsets: Vec<String> = offsets.collect::<Option<_>>()?;
    Some(format!("{}+{}", frame.trim(), offsets.join(",")))
}
