//! Evaluates formulas to dimensions over a number type: the only place where this happens.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::dimensions::{
    ChainDimensions, ClosureDimensions, Dimensions, LinearForm, RowDimensions,
};
use super::model::{ChainRow, FixedStep, Formula, Joint, JointKind, Symbol};
use super::{Frame, JointRelation, Mechanism};
use crate::algebra::{Affine, EvaluationError};
use crate::description::{Convention, Role};
use crate::geometry::{Axis, Pose, Rotation, Vector3};
use crate::linear::{join, root};
use crate::number::Number;

pub(super) fn value<T: Number>(formula: &Formula, parameters: &[T]) -> Result<T, EvaluationError> {
    formula.evaluate(&|symbol| match *symbol {
        Symbol::Parameter(i) => parameters[i],
        Symbol::Joint(_) | Symbol::Local(_) => unreachable!("a dimension is resolved in the scope of parameters, where joints and local names are refused"),
    })
}

/// The results for all parts. Collecting results does not know their number, and allocates again as they grow.
fn each<A, B>(
    parts: &[A],
    mut over: impl FnMut(&A) -> Result<B, EvaluationError>,
) -> Result<Vec<B>, EvaluationError> {
    let mut all = Vec::with_capacity(parts.len());
    for part in parts {
        all.push(over(part)?);
    }
    Ok(all)
}

fn linear_form<T: Number>(
    affine: &Affine<Symbol>,
    parameters: &[T],
) -> Result<(T, LinearForm<T>), EvaluationError> {
    let mut terms = Vec::with_capacity(affine.terms.len());
    for (symbol, coefficient) in &affine.terms {
        let Symbol::Joint(joint) = *symbol else {
            unreachable!("the terms of an entry were split off for joint variables only");
        };
        let coefficient = value(coefficient, parameters)?;
        if coefficient != T::zero() {
            terms.push((joint, coefficient));
        }
    }
    Ok((value(&affine.constant, parameters)?, LinearForm(terms)))
}

pub(super) fn product<T: Number>(
    steps: &[FixedStep],
    parameters: &[T],
) -> Result<Pose<T>, EvaluationError> {
    product_from(Pose::identity(), steps, parameters)
}

/// The product of a pose and steps. Far from the origin it begins at the centre, so that what they have in common cancels
/// before what distinguishes them is added.
fn product_from<T: Number>(
    mut pose: Pose<T>,
    steps: &[FixedStep],
    parameters: &[T],
) -> Result<Pose<T>, EvaluationError> {
    for step in steps {
        let step = step.try_map(|formula| value(formula, parameters))?;
        step.extend(&mut pose);
    }
    Ok(pose)
}

impl ChainRow {
    fn over<T: Number>(
        &self,
        convention: Convention,
        parameters: &[T],
    ) -> Result<RowDimensions<T>, EvaluationError> {
        let (alpha, a) = (value(&self.alpha, parameters)?, value(&self.a, parameters)?);
        let (theta, turn) = linear_form(&self.theta, parameters)?;
        let (d, slide) = linear_form(&self.d, parameters)?;
        let (mut before, mut after) = (Pose::identity(), Pose::identity());
        let link = match convention {
            Convention::Modified => &mut before,
            Convention::Standard => &mut after,
        };
        link.shift(Axis::X, a);
        link.turn(Axis::X, alpha);
        if !self.beta.is_zero() {
            link.turn(Axis::Y, value(&self.beta, parameters)?);
        }
        // Rz(θ₀) and Tz(d₀) commute with the motion about and along the same z
        before.turn(Axis::Z, theta);
        before.shift(Axis::Z, d);
        Ok(RowDimensions {
            before,
            turn,
            slide,
            after,
        })
    }
}

impl Mechanism {
    /// All dimensions for given values of the parameters, over any number.
    ///
    /// `parameters` holds a value for each parameter of the mechanism, in order; the caller keeps the
    /// relations between them.
    ///
    /// # Errors
    /// If an expression has no value at these parameters.
    pub fn dimensions_over<T: Number>(
        &self,
        parameters: &[T],
    ) -> Result<Dimensions<T>, EvaluationError> {
        let known = &self.dimensions;
        self.dimensions_about((known.centre, known.axes), parameters)
    }

    /// As [`Mechanism::dimensions_over`], with positions from another centre, in m, along other axes.
    pub(super) fn dimensions_about<T: Number>(
        &self,
        (centre, axes): ([f64; 3], Option<Rotation<f64>>),
        parameters: &[T],
    ) -> Result<Dimensions<T>, EvaluationError> {
        let mut dimensions = Dimensions::empty();
        (dimensions.centre, dimensions.axes) = (centre, axes);
        dimensions.joint_scales = vec![1.0; self.joints.len()];
        let ground: Pose<T> = dimensions.ground();
        dimensions.chains = each(&self.chains, |chain| {
            let from = match chain.on {
                Frame::Ground => ground,
                _ => Pose::identity(),
            };
            Ok(ChainDimensions {
                on: chain.on,
                base: product_from(from, &chain.base, parameters)?,
                rows: each(&chain.rows, |row| row.over(chain.convention, parameters))?,
                tip: product(&chain.tip, parameters)?,
            })
        })?;
        dimensions.platforms = each(&self.platforms, |platform| {
            each(&platform.frames, |(_, steps)| product(steps, parameters))
        })?;
        dimensions.closures = each(&self.closures, |closure| {
            let (length, extension) = match &closure.length {
                Some(affine) => linear_form(affine, parameters)?,
                None => (T::zero(), LinearForm(vec![])),
            };
            Ok(ClosureDimensions {
                kind: closure.kind,
                frames: closure.frames,
                length,
                extension,
                relation: (closure.relation.as_ref())
                    .map(|formula| JointRelation::new(formula, parameters)),
            })
        })?;
        let length = self.largest_length(&dimensions, &self.driven_lengths());
        measure(&mut dimensions, length, &self.joints);
        Ok(dimensions)
    }

    /// The mechanism with the characteristic length of its dimensions and of held lengths, in m; `None` if it has that
    /// already.
    ///
    /// Within a factor of ten of the file's own characteristic length the file's is kept, so that figures
    /// for different values of the inputs can be compared.
    pub fn measured_by(&self, held: &[f64]) -> Option<Mechanism> {
        let own = self.largest_length(&self.dimensions, &self.driven_lengths());
        let asked = self.largest_length(&self.dimensions, held);
        let ratio = asked / own;
        let length = match (0.1..=10.0).contains(&ratio) {
            true => own,
            false => asked,
        };
        (length != self.dimensions.characteristic_length).then(|| self.clone().measured(length))
    }

    /// The mechanism with another characteristic length, in m.
    pub(super) fn measured(mut self, length: f64) -> Self {
        measure(Arc::make_mut(&mut self.dimensions), length, &self.joints);
        self
    }

    /// The lengths that the file holds.
    fn driven_lengths(&self) -> Vec<f64> {
        let driven = (self.joints.iter())
            .filter(|joint| joint.role == Role::Actuated && joint.kind == JointKind::Prismatic);
        driven.map(|joint| joint.home).collect()
    }

    /// The largest of the dimensions and of the lengths that are held, in m; without any the largest home
    /// value of a slide, or else 1 m.
    fn largest_length<T: Number>(&self, dimensions: &Dimensions<T>, held: &[f64]) -> f64 {
        let size = |pose: &Pose<T>| {
            let squares = pose.position.0.map(|x| x.real() * x.real());
            squares.iter().sum::<f64>().sqrt()
        };
        let chains = dimensions.chains.iter().flat_map(|chain| {
            let rows = chain.rows.iter().flat_map(|row| [&row.before, &row.after]);
            let base = (chain.on != Frame::Ground).then_some(&chain.base);
            rows.chain([&chain.tip]).chain(base)
        });
        let poses = chains.chain(dimensions.platforms.iter().flatten());
        let on_ground = on_ground(dimensions);
        let closures = dimensions.closures.iter();
        let distances = closures.map(|closure| closure.length.real().abs());
        let held = held.iter().map(|length| length.abs());
        let slides = self.joints.iter().filter(|joint| !joint.kind.is_angle());
        let slides = slides.map(|joint| joint.home.abs()).fold(0.0, f64::max);
        let all = poses
            .map(size)
            .chain(on_ground)
            .chain(distances)
            .chain(held);
        let largest = all.fold(0.0, f64::max);
        match (largest > 0.0, slides > 0.0) {
            (true, _) => largest,
            (false, true) => slides,
            (false, false) => 1.0,
        }
    }
}

/// Distances of the bases of one part of the mechanism on ground from their mean; the distance of two. Where the frame of ground
/// stands and how it is turned is no dimension, nor is the distance between parts that have nothing to do with one another.
fn on_ground<T: Number>(dimensions: &Dimensions<T>) -> Vec<f64> {
    let places = places_on_ground(dimensions);
    let mut parts: BTreeMap<usize, Vec<Vector3<f64>>> = BTreeMap::new();
    for (part, place) in places {
        let (known, place) = (parts.entry(part).or_default(), Vector3(place));
        if !known.contains(&place) {
            known.push(place);
        }
    }
    let distances = parts.into_values().flat_map(|bases| {
        let from = match bases[..] {
            [first, _] => first,
            _ => {
                let sum = bases.iter().fold(Vector3([0.0; 3]), |sum, of| sum + *of);
                Vector3(sum.0.map(|x| x / bases.len() as f64))
            }
        };
        bases.into_iter().map(move |of| (of - from).norm())
    });
    distances.collect()
}

/// The place of the box round some places that is nearest to the centre.
pub(super) fn nearest(places: &[[f64; 3]]) -> [f64; 3] {
    std::array::from_fn(|axis| {
        let along = places.iter().map(|place| place[axis]);
        let [low, high] = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
            [low.min(x), high.max(x)]
        });
        low.max(high.min(0.0))
    })
}

/// The bases of chains on the ground, and ground where closures join it, from the centre; those of one part of the
/// mechanism have one number.
pub(super) fn places_on_ground<T: Number>(dimensions: &Dimensions<T>) -> Vec<(usize, [f64; 3])> {
    let chains = &dimensions.chains;
    let platform = |platform: usize| Some(chains.len() + platform);
    let body = |frame: Frame| match frame {
        Frame::Ground => None,
        Frame::Platform { platform: of } | Frame::OnPlatform { platform: of, .. } => platform(of),
        Frame::Link { chain, .. } | Frame::Tip { chain } => Some(chain),
    };
    let bodies = chains.len() + dimensions.platforms.len();
    let mut roots: Vec<usize> = (0..bodies + dimensions.joint_scales.len()).collect();
    let stands = (0..)
        .zip(chains)
        .map(|(i, chain)| [Some(i), body(chain.on)]);
    let closed = dimensions
        .closures
        .iter()
        .map(|closure| closure.frames.map(body));
    // what a joint variable moves belongs together
    let moved = (0..).zip(chains).flat_map(|(i, chain)| {
        let forms = chain.rows.iter().flat_map(|row| [&row.turn, &row.slide]);
        let joints = forms.flat_map(|form| form.0.iter().map(|(joint, _)| bodies + joint));
        joints.map(move |joint| [Some(i), Some(joint)])
    });
    for pair in stands.chain(closed).chain(moved) {
        if let [Some(a), Some(b)] = pair {
            join(&mut roots, a, b);
        }
    }
    let bases = (0..)
        .zip(chains)
        .filter(|(_, chain)| chain.on == Frame::Ground);
    let bases = bases.map(|(i, chain)| (i, chain.base.position.0.map(|x| x.real())));
    let to_ground = dimensions.closures.iter().filter_map(|closure| {
        let frames = closure
            .frames
            .contains(&Frame::Ground)
            .then_some(closure.frames)?;
        frames.into_iter().find_map(body)
    });
    let ground = dimensions.ground().position.0.map(|x| x.real());
    let places = bases.chain(to_ground.map(|i| (i, ground)));
    let places = places.map(|(i, place)| (root(&mut roots, i), place));
    places.collect()
}

/// Gives dimensions their characteristic length, in m.
fn measure<T>(dimensions: &mut Dimensions<T>, length: f64, joints: &[Joint]) {
    dimensions.characteristic_length = length;
    for (scale, joint) in dimensions.joint_scales.iter_mut().zip(joints) {
        if joint.kind == JointKind::Prismatic {
            *scale = length;
        }
    }
}
