//! The closures of a description, each checked as far as the frames that it joins are known.

use std::collections::HashMap;

use super::super::model::{ChainRow, Closure};
use super::super::relation::joints_of;
use super::super::{Body, Frame};
use super::{ModelBuilder, ResolvedChain};
use crate::algebra::Measure;
use crate::description::{
    ClosureDescription, ClosureKind, Description, Named, ProblemKind, Scope, Spanned,
};

impl ModelBuilder<'_> {
    pub(super) fn closures(
        &mut self,
        description: &Description,
        chains: &[ResolvedChain],
    ) -> Vec<Closure> {
        let mut closures = Vec::new();
        for Named { name, value } in &description.closures {
            if value.kind == ClosureKind::Coupling {
                closures.extend(self.coupling(name, value));
                continue;
            }
            let frames = [0, 1].map(|i| self.frame(&value.frames[i]));
            let length =
                (value.length.as_ref()).map(|entry| (entry, self.affine(entry, Measure::Length)));
            if let [Some(a), Some(b)] = frames {
                self.check_bodies(&name.value, value, [a, b], chains);
                closures.push(Closure {
                    length: length.as_ref().and_then(|(_, affine)| affine.clone()),
                    ..Closure::new(name.value.clone(), value.kind, [a, b])
                });
            }
            if let (ClosureKind::Distance, Some((entry, Some(affine)))) = (value.kind, length)
                && affine.is_constant()
                && let Some(length) = self.value(&affine.constant)
                && let Some(fault) = fault_of_length(&name.value, length)
            {
                self.refuse(fault, &entry.span);
            }
        }
        closures
    }

    /// A coupling of joints, of which its expression names one at least.
    fn coupling(&mut self, name: &Spanned<String>, value: &ClosureDescription) -> Option<Closure> {
        let entry = value.length.as_ref()?;
        let formula = self.formula(entry, Scope::ParametersAndJoints, &HashMap::new())?;
        if let Err(error) = formula.measure(&|symbol| self.measure(symbol)) {
            self.refuse(ProblemKind::Unit(error.kind), &error.span);
        }
        if joints_of(&formula).is_empty() {
            let closure = name.value.clone();
            self.refuse(ProblemKind::CouplesNothing { closure }, &entry.span);
            return None;
        }
        Some(Closure {
            relation: Some(formula),
            ..Closure::new(name.value.clone(), value.kind, [Frame::Ground; 2])
        })
    }

    fn check_bodies(
        &mut self,
        name: &str,
        described: &ClosureDescription,
        frames: [Frame; 2],
        chains: &[ResolvedChain],
    ) {
        let [a, b] = frames;
        let bodies = frames.map(|frame| self.body(frame, chains));
        if a == b || (bodies[0].is_some() && bodies[0] == bodies[1]) {
            let closure = name.to_owned();
            let [first, second] = &described.frames;
            let span = first.span.start..second.span.end;
            self.refuse(ProblemKind::SameBody { closure }, &span);
        }
    }

    /// The body that a frame is fixed to, or `None` if that depends on errors in the file.
    fn body(&self, frame: Frame, chains: &[ResolvedChain]) -> Option<Body> {
        let mut frame = frame;
        loop {
            let (chain, rows) = match frame {
                Frame::Ground => return Some(Body::Ground),
                Frame::Platform { platform } | Frame::OnPlatform { platform, .. } => {
                    return Some(Body::Platform(platform));
                }
                Frame::Link { chain, row } => (chain, row),
                Frame::Tip { chain } => (chain, chains[chain].rows.len()),
            };
            let part = &chains[chain];
            if part.doubtful {
                return None;
            }
            for (i, row) in part.rows[..rows].iter().enumerate().rev() {
                let row = row.as_ref()?;
                if !row.joints().is_empty() {
                    return Some(Body::Link { chain, row: i + 1 });
                }
                if self.may_move(row) {
                    return None;
                }
            }
            if part.in_ring {
                return None;
            }
            frame = part.on?;
        }
    }

    /// True if a name in the row may be that of a joint after all.
    fn may_move(&self, row: &ChainRow) -> bool {
        let [_, _, d, theta, _] = &row.written;
        [d, theta].into_iter().any(|written| {
            let mut words = written.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            words.any(|word| self.doubtful.contains(word))
        })
    }
}

/// Problem of the length of a distance that no joint changes, if it has one.
pub(in super::super) fn fault_of_length(closure: &str, length: f64) -> Option<ProblemKind> {
    let closure = closure.to_owned();
    match length {
        _ if length < 0.0 => Some(ProblemKind::NegativeDistance { length }),
        0.0 => Some(ProblemKind::ZeroDistance { closure }),
        _ => None,
    }
}
