//! Errors of numbers that were computed from poses whose numbers are off by 1.

use std::collections::HashMap;

use crate::algebra::Measure;
use crate::description::{Description, Entry, Literal};

/// The angle between two frames.
const TURN: f64 = 4.0;

/// The distance of two points.
const SHIFT: f64 = 2.0;

/// For each literal of a description the most by which it is off, in these parts.
pub(super) fn sizes(description: &Description, literals: &[Literal]) -> Vec<f64> {
    let simple = |of: &Literal| match of.measure {
        Measure::Length | Measure::Open => SHIFT,
        _ => TURN,
    };
    let mut sizes: Vec<f64> = literals.iter().map(simple).collect();
    let mut lengths: HashMap<&str, Vec<usize>> = HashMap::new();
    for (i, of) in literals.iter().enumerate() {
        if of.measure == Measure::Length {
            lengths.entry(&of.place).or_default().push(i);
        }
    }
    let size = |of: &Entry| of.expression.fixed_value().unwrap_or(0.0);
    for chain in &description.chains {
        let rows = &chain.value.rows;
        for number in 0..rows.len() {
            // a row shares each of its axes with a neighbour
            let near = &rows[number.saturating_sub(1)..rows.len().min(number + 2)];
            let offsets = near.iter().map(|row| size(&row.d).abs());
            let normal = SHIFT + TURN * offsets.fold(0.0, f64::max);
            let normals = near.iter().map(|row| {
                let sine = crate::number::real::sin(size(&row.alpha)).abs();
                // an axis that is turned less against the one before has no certain offset
                let over = if sine > 0.05 { 1.0 / sine } else { 1.0 };
                (SHIFT + TURN * size(&row.a).abs()) * over
            });
            let offset = normals.fold(SHIFT, f64::max);
            let place = format!("{} row {}", chain.name.value, number + 1);
            let own = lengths.get(place.as_str()).into_iter().flatten();
            for (&i, size) in own.zip([normal, offset]) {
                sizes[i] = size;
            }
        }
    }
    sizes
}
