//! Proof that the listed assemblies are all the real ones: interval branch and prune over the joint variables that
//! distinguish them.
//!
//! Around each listed assembly a box is made that contains at most one; everything outside of these boxes is excluded
//! piece by piece, and the rest is reported. Angles cover the full turn, whatever their limits; slides their range or,
//! without limits, as far as the lengths of the mechanism allow.

use std::f64::consts::FRAC_PI_2;

use super::family::Coordinates;
use super::report::{Part, Proof, Range};
use crate::algebra::SiUnit;
use crate::mechanism::{Configuration, Mechanism, PoseCoordinate};
use crate::number::tolerance::ROUNDING;
use crate::number::{Interval, Number};
use crate::solve::{Pruning, Sides, Watch, isolated, prune as prune_boxes};
use crate::system::{Held, JointSpace, Unfit};

/// Looks for real assemblies beside those given with their numbers. What is held without an equation is where `asked`
/// has it.
pub fn prove(
    mechanism: &Mechanism,
    (held, asked): (&Held<f64>, &Configuration<f64>),
    known: &[(usize, Configuration<f64>)],
    settings: &Pruning,
    watch: &Watch,
) -> Proof {
    let space = match Space::new(mechanism, held, asked) {
        Ok(space) => space,
        Err(unfit) => {
            return Proof {
                unfit: Some(unfit),
                ..Proof::default()
            };
        }
    };
    let within = |x: f64, side: Interval| side.low <= x && x <= side.high;
    let mut proof = Proof {
        unknowns: space.sides.len(),
        ranges: space.named(&space.sides, |i| space.cut[i]),
        unbounded: space.unbounded.clone(),
        ..Proof::default()
    };
    let mut modes: Vec<(usize, Vec<f64>)> = Vec::new();
    for (mode, at) in known {
        let x = space.of(mechanism, at);
        let mut sides = x.iter().zip(&space.sides);
        match sides.all(|(x, side)| within(*x, *side)) {
            true => modes.push((*mode, x)),
            false => proof.outside.push(*mode),
        }
    }
    let found: Vec<Option<Sides>> = modes
        .iter()
        .map(|(_, x)| isolated(&space.variables.enclosure, x))
        .collect();
    let regions: Vec<Sides> = found.iter().flatten().cloned().collect();
    let pruned = prune_boxes(
        &space.variables.enclosure,
        space.sides.clone(),
        &space.periods,
        &regions,
        settings,
        watch,
    );
    proof.boxes = pruned.boxes;
    proof.waiting = pruned.waiting.len();
    proof.crowded = proof.waiting > 0 && pruned.left.len() >= settings.most_left;
    // how exactly the listed assemblies are where they are said to be
    let near = |sides: &Sides, x: &[f64], margin: f64| {
        let periods = space.periods.iter();
        sides.iter().zip(x).zip(periods).all(|((side, x), period)| {
            let period = period.map_or(f64::INFINITY, |period| period.real());
            let turns = ((x - side.real()) / period).round();
            let x = if turns == 0.0 { *x } else { x - turns * period };
            within(x, *side + Interval::around(0.0, margin))
        })
    };
    let part = |sides: &Sides| Part {
        ranges: space.named(sides, |_| true),
        modes: (modes.iter().filter(|(_, x)| near(sides, x, 1e-4)))
            .map(|(mode, _)| *mode)
            .collect(),
    };
    proof.left = joined(pruned.left).iter().map(part).collect();
    // an assembly without a box of its own may lie in one that the search found
    let mut missing = pruned.found;
    let mut met = pruned.met.iter();
    for ((mode, x), region) in modes.iter().zip(&found) {
        let kept = match region {
            Some(_) => met.next().is_some_and(|boxes| *boxes > 0),
            None => {
                let known = missing.len();
                let own = missing.iter().position(|sides| near(sides, x, 1e-7));
                if let Some(place) = own {
                    missing.remove(place);
                }
                missing.len() < known || proof.left.iter().any(|part| part.modes.contains(mode))
            }
        };
        if !kept && proof.waiting == 0 {
            proof.excluded.push(*mode);
        }
    }
    proof.missing = missing.iter().map(part).collect();
    proof
}

/// The variables that distinguish assemblies, with the ranges in which these are sought.
struct Space {
    variables: JointSpace,
    sides: Sides,
    periods: Vec<Option<Interval>>,
    names: Vec<Option<(String, SiUnit)>>,
    /// For each unknown, true if it may have values beyond its side.
    cut: Vec<bool>,
    unbounded: Vec<String>,
}

impl Space {
    fn new(
        mechanism: &Mechanism,
        held: &Held<f64>,
        asked: &Configuration<f64>,
    ) -> Result<Self, Unfit> {
        let variables = JointSpace::new(mechanism, held, &[], asked)?;
        let turns = Coordinates::new(mechanism, held).turns;
        let joints = mechanism.joints();
        let pi: Interval = Number::pi();
        // in rad or m
        let all = variables.recut.dimensions.joint_scales.len();
        let mut bounds: Vec<Option<Interval>> = vec![None; all];
        let mut periods = vec![None; all];
        let mut names: Vec<Option<(String, SiUnit)>> = vec![None; all];
        // slides of one platform are perpendicular to each other: one of them is as long as all
        let mut groups: Vec<usize> = (0..all).collect();
        let both_ways = |x: f64| Interval { low: -x, high: x };
        for (j, joint) in joints.iter().enumerate() {
            let unit = SiUnit::of_coordinate(joint.kind.is_angle());
            names[j] = Some((joint.name.clone(), unit));
            bounds[j] = match (turns[j], joint.limits) {
                _ if held.joints[j] => Some(Interval::point(asked.joints[j])),
                (Some(turns), _) => {
                    let half = pi * Interval::point(turns);
                    periods[j] = Some(half + half);
                    Some(both_ways(half.high))
                }
                (None, Some((low, high))) => Some(Interval { low, high }),
                (None, None) => None,
            };
        }
        for carried in &variables.recut.carried {
            for (i, coordinate) in carried.freedoms().iter().enumerate() {
                let j = carried.first + i;
                let half = *coordinate == PoseCoordinate::Pitch && carried.halves_pitch();
                if carried.kind.is_none() {
                    let platform = &mechanism.platforms()[carried.platform].name;
                    let unit = SiUnit::of_coordinate(coordinate.is_angle());
                    names[j] = Some((format!("{platform}.{}", coordinate.word()), unit));
                }
                match (coordinate.is_angle(), half) {
                    (true, true) => bounds[j] = Some(both_ways(FRAC_PI_2.next_up())),
                    (true, false) => {
                        bounds[j] = Some(both_ways(pi.high));
                        periods[j] = Some(pi + pi);
                    }
                    (false, _) => groups[j] = carried.first,
                }
            }
        }
        for _ in 0..all {
            for (fixed, slides) in variables.enclosure.reaches() {
                let open = slides.iter().filter(|(j, _)| bounds[*j].is_none());
                let mut group: Vec<usize> = open.clone().map(|(j, _)| groups[*j]).collect();
                group.dedup();
                if group.len() != 1 || open.clone().any(|(_, length)| *length == 0.0) {
                    continue;
                }
                let others = slides
                    .iter()
                    .filter_map(|(j, length)| Some(bounds[*j]?.magnitude() * length));
                // rounding of a few sums is far less than this
                let longest = (fixed + others.sum::<f64>()) * (1.0 + ROUNDING);
                let open: Vec<(usize, f64)> = open.copied().collect();
                for (j, length) in open {
                    bounds[j] = Some(both_ways(longest / length));
                }
            }
        }
        let mut space = Space {
            variables,
            names: Vec::new(),
            cut: Vec::new(),
            unbounded: Vec::new(),
            sides: Vec::new(),
            periods: Vec::new(),
        };
        let enclosure = &space.variables.enclosure;
        for (&j, &scale) in enclosure.unknowns().iter().zip(enclosure.scales()) {
            let angle = joints.get(j).is_some_and(|joint| joint.kind.is_angle());
            let bound = match (bounds[j], angle) {
                (Some(bound), _) => bound,
                (None, true) => return Err(Unfit::Endless(joints[j].name.clone())),
                (None, false) => {
                    let name = names[j].iter().map(|(name, _)| name.clone());
                    space.unbounded.extend(name);
                    // no bound follows for it
                    both_ways(1000.0 * mechanism.characteristic_length())
                }
            };
            let limited = joints.get(j).is_some_and(|joint| joint.limits.is_some());
            let cut = bounds[j].is_none() || limited && periods[j].is_none();
            space.sides.push(bound / Interval::point(scale));
            space.cut.push(cut);
            space.periods.push(periods[j]);
            space.names.push(names[j].take());
        }
        Ok(space)
    }

    /// The variables of a configuration.
    fn of(&self, mechanism: &Mechanism, at: &Configuration<f64>) -> Vec<f64> {
        let values = self.variables.of(mechanism, at).into_iter();
        (values.zip(&self.periods))
            .map(|(x, period)| match period {
                Some(period) => x - (x / period.real()).round() * period.real(),
                None => x,
            })
            .collect()
    }

    /// The sides of chosen unknowns that have a name.
    fn named(&self, sides: &Sides, chosen: impl Fn(usize) -> bool) -> Vec<Range> {
        let scales = self.variables.enclosure.scales();
        let ranges = (0..sides.len()).filter(|&i| chosen(i)).filter_map(|i| {
            let (name, unit) = self.names[i].clone()?;
            Some(Range {
                name,
                unit,
                low: sides[i].low * scales[i],
                high: sides[i].high * scales[i],
            })
        });
        ranges.collect()
    }
}

/// Hulls of boxes that touch.
fn joined(boxes: Vec<Sides>) -> Vec<Sides> {
    let mut parts: Vec<Sides> = Vec::new();
    for mut part in boxes {
        while let Some(place) = parts.iter().position(|other| {
            other
                .iter()
                .zip(&part)
                .all(|(a, b)| a.low <= b.high + ROUNDING && b.low <= a.high + ROUNDING)
        }) {
            let other = parts.swap_remove(place);
            for (side, other) in part.iter_mut().zip(&other) {
                side.low = side.low.min(other.low);
                side.high = side.high.max(other.high);
            }
        }
        parts.push(part);
    }
    parts
}
