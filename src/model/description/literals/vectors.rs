//! Vectors of joint coordinates, as they are written.

use super::of_sum;
use crate::algebra::{Expression, Measure, Node};
use crate::description::Description;

/// Three plain numbers of a point or a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrittenVector {
    /// [`Measure::Length`] for a point, [`Measure::Number`] for a direction.
    pub measure: Measure,
    /// The places of its numbers in [`Description::literals`], each with its sign there.
    pub literals: [(usize, f64); 3],
}

/// The sign before a number that stands alone.
fn sign(expression: &Expression) -> Option<f64> {
    match &expression.node {
        Node::Number(_) | Node::Quantity(..) => Some(1.0),
        Node::Negate(x) => sign(x).map(|sign| -sign),
        _ => None,
    }
}

impl Description {
    /// The vectors of joint coordinates, in the order of the file, with the joint of each; `None` for one that is not three
    /// plain numbers.
    pub fn written_vectors(&self) -> Vec<(String, Option<WrittenVector>)> {
        let (mut vectors, mut number) = (Vec::new(), 0);
        let mut entries: Vec<Option<(usize, f64)>> = Vec::new();
        self.clone()
            .dimensions(&mut |entry, measure, place, in_vector| {
                let first = number;
                of_sum(&mut entry.expression, &mut |_| number += 1);
                if !in_vector {
                    return;
                }
                entries.push(sign(&entry.expression).map(|sign| (first, sign)));
                if entries.len() == 3 {
                    let all: Option<Vec<(usize, f64)>> = entries.drain(..).collect();
                    let vector = all.and_then(|all| all.try_into().ok());
                    let vector = vector.map(|literals| WrittenVector { measure, literals });
                    vectors.push((place.to_owned(), vector));
                }
            });
        vectors
    }
}
