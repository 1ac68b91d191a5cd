//! Conversion to another cut joint.
//!
//! A joint in row r of a chain becomes a closure. What hangs behind it keeps its connexion through
//! one of the old closures, which becomes rows: with K the motion of that joint, the chain
//! base · J₁ L₁ … J_n L_n · tip = closed on frame F becomes
//!
//! - `chain`: F · K, which is its old tip frame under its old name;
//! - `chain_back`: chain · tip⁻¹ · L_n⁻¹ J_n⁻¹ … J_{r+1}⁻¹ L_r⁻¹, back to axis r;
//! - `chain_front`: base · J₁ … L_{r−1}, forth to axis r;
//!
//! and `chain_front` and `chain_back` are joined by the joint of row r.

mod closure_rows;
mod error;

use super::references::{Substitute, exchange, free_name, link_of};
use super::{Conversion, ConversionNote};
use crate::algebra::Affine;
use crate::description::steps::{doing_something, link, negated, undone, zero};
use crate::description::{
    Axis, ChainDescription, ClosureDescription, ClosureKind, Convention, Description, Displacement,
    Entry, Named, Role, RowDescription, Spanned, names_of, nearest, place_of,
};
use crate::mechanism::{Frame, JointKind, Mechanism};
use crate::number::sorting::sort_by;
use closure_rows::{ClosureRows, free_closure};

pub use error::CutError;

/// Place of the joint in its chain.
struct RowPlace {
    joint: usize,
    chain: usize,
    /// Index of its row, from 0.
    row: usize,
    slides: bool,
    /// Rotation or translation for a unit of the variable.
    factor: f64,
}

/// The joints at which a mechanism can be broken instead, in the order of the file.
pub fn possible_cuts(mechanism: &Mechanism, description: &Description) -> Vec<String> {
    let mechanism = mechanism.as_written();
    let possible = names_of(&description.joints).filter(|name| {
        let place = find(&mechanism, description, name);
        place.is_ok_and(|place| closing(&mechanism, &place, name).is_ok())
    });
    possible.map(str::to_owned).collect()
}

pub(super) fn cut(
    mechanism: &Mechanism,
    description: &Description,
    joint: &str,
) -> Result<Conversion, CutError> {
    let written = mechanism.as_written();
    let place = find(&written, description, joint)?;
    let (closure, side) = closing(&written, &place, joint)?;
    let behind = description.chains[place.chain].value.rows[place.row..].iter();
    if behind.skip(1).any(|row| !row.beta.expression.is_zero()) {
        return Err(CutError::Tilted(joint.to_owned()));
    }
    let declared = mechanism.closures()[closure].opened.is_some();
    let motion = ClosureRows::of(&written, description, closure, side, declared);
    Ok(rebuild(
        &written,
        description,
        &place,
        (closure, side),
        motion,
    ))
}

fn find(
    mechanism: &Mechanism,
    description: &Description,
    name: &str,
) -> Result<RowPlace, CutError> {
    let joint = || name.to_owned();
    let Some(index) = mechanism.joint(name) else {
        if place_of(&description.closures, name).is_some() {
            return Err(CutError::AlreadyCut(joint()));
        }
        let names = names_of(&description.joints);
        return Err(CutError::UnknownJoint {
            name: joint(),
            suggestion: nearest(name, names).map(str::to_owned),
        });
    };
    if mechanism.joints()[index].kind == JointKind::Helical {
        return Err(CutError::Helical(joint()));
    }
    let mut places = Vec::new();
    for (chain, part) in mechanism.dimensions().chains.iter().enumerate() {
        for (row, dims) in part.rows.iter().enumerate() {
            let (turn, slide) = (&dims.turn.0, &dims.slide.0);
            let stands = |(j, _): &&(usize, f64)| *j == index;
            if turn.iter().chain(slide).any(|term| stands(&term)) {
                let factor = turn.iter().chain(slide).map(|(_, factor)| *factor).sum();
                places.push((chain, row, turn.len() + slide.len(), factor));
            }
        }
    }
    let lengths = mechanism.dimensions().closures.iter();
    let in_length = lengths
        .flat_map(|c| &c.extension.0)
        .any(|(j, _)| *j == index);
    match (places[..].as_ref(), in_length) {
        ([], _) if place_of(&description.closures, name).is_some() => {
            Err(CutError::AlreadyCut(joint()))
        }
        ([], _) => Err(CutError::NoRow(joint())),
        (&[(chain, row, 1, factor)], false) => Ok(RowPlace {
            joint: index,
            chain,
            row,
            slides: !mechanism.dimensions().chains[chain].rows[row]
                .slide
                .0
                .is_empty(),
            factor,
        }),
        ([_], false) => Err(CutError::SharedRow(joint())),
        _ => Err(CutError::SeveralRows(joint())),
    }
}

/// The closure that shall hold the links behind the joint, and which of its frames is there.
fn closing(
    mechanism: &Mechanism,
    place: &RowPlace,
    joint: &str,
) -> Result<(usize, usize), CutError> {
    let rows = mechanism.chains()[place.chain].rows.len();
    let behind = |frame: Frame| mechanism.joints_below(frame).contains(&place.joint);
    let ends = |frame: Frame| match frame {
        Frame::Tip { chain } => chain == place.chain,
        Frame::Link { chain, row } => chain == place.chain && row == rows,
        _ => false,
    };
    let link = |row: usize| Frame::Link {
        chain: place.chain,
        row,
    };
    let opened = [link(place.row), link(place.row + 1)];
    // what a rigid closure joins becomes one body, which nothing else may join to itself
    let stays_alone = |index: usize| {
        let bodies = |frames: [Frame; 2]| {
            let mut bodies = frames.map(|frame| mechanism.body(frame));
            sort_by(&mut bodies, Ord::cmp);
            bodies
        };
        let closures = mechanism.closures();
        let others = (closures.iter().enumerate()).filter(|(other, _)| *other != index);
        let mut others = others.map(|(_, other)| other.frames).chain([opened]);
        closures[index].kind != ClosureKind::Rigid
            || others.all(|frames| bodies(frames) != bodies(closures[index].frames))
    };
    let mut found: Vec<(usize, usize, usize)> = Vec::new();
    let mut others = Vec::new();
    for (index, closure) in mechanism.closures().iter().enumerate() {
        let side = match closure.frames.map(behind) {
            [true, false] => 0,
            [false, true] => 1,
            _ => continue,
        };
        match ClosureRows::variables(closure.kind) {
            Some(number) if ends(closure.frames[side]) && stays_alone(index) => {
                found.push((number, index, side))
            }
            _ => others.push(closure.name.clone()),
        }
    }
    match found.into_iter().min() {
        Some((_, index, side)) => Ok((index, side)),
        None => {
            let (joint, closures) = (joint.to_owned(), others);
            Err(match closures.is_empty() {
                true => CutError::NoLoop(joint),
                false => CutError::NotRows { joint, closures },
            })
        }
    }
}

/// An entry at the variables' zeros.
fn constant(e: &Entry, description: &Description) -> Entry {
    let is_joint = |name: &String| place_of(&description.joints, name).is_some();
    match e.expression.affine(is_joint) {
        Ok(Affine { constant, .. }) => constant.into(),
        // the mechanism was built from this entry, which is affine
        Err(_) => e.clone(),
    }
}

fn rebuild(
    mechanism: &Mechanism,
    description: &Description,
    place: &RowPlace,
    (closure, side): (usize, usize),
    motion: ClosureRows,
) -> Conversion {
    let convention = mechanism.chains()[place.chain].convention;
    let Named { name, value: chain } = &description.chains[place.chain];
    let (old, r) = (&chain.rows, place.row);
    let n = old.len();
    // L_k of k from 0 to n
    let links = |k: usize| {
        let row = match convention {
            Convention::Modified => old.get(k),
            Convention::Standard => k.checked_sub(1).map(|k| &old[k]),
        };
        row.map_or_else(Vec::new, |row| link([&row.a, &row.alpha, &row.beta]))
    };
    // forth to the axis of the joint
    let fixed = [
        Displacement::Rotate(Axis::Z, constant(&old[r].theta, description)),
        Displacement::Translate(Axis::Z, constant(&old[r].d, description)),
    ];
    let mut tip = match convention {
        Convention::Modified => links(r),
        Convention::Standard => Vec::new(),
    };
    tip.extend(doing_something(fixed));
    let front = ChainDescription {
        rows: old[..r].to_vec(),
        tip,
        ..chain.clone()
    };
    // from the closure to the old tip
    let whole_tip = matches!(
        mechanism.closures()[closure].frames[side],
        Frame::Tip { .. }
    );
    let mut end = motion.tip.clone();
    if !whole_tip {
        end.extend(chain.tip.iter().cloned());
    }
    let back = back(&name.value, chain, convention, r, &links);
    let back_rows = back.rows.len();
    let mut new = description.clone();
    let front_name = free_name(&new, &format!("{}_front", name.value));
    let back_name = free_name(&new, &format!("{}_back", name.value));
    // frames in front keep their number; those behind are counted from the other end
    let renamed = exchange(&mut new, |frame| {
        let k = link_of(frame, &name.value)?;
        if k <= r {
            let (frame, steps) = (format!("{front_name}.{k}"), vec![]);
            return Some(Substitute { frame, steps });
        }
        // the way back passes L_k the other way round
        let steps = match convention {
            Convention::Modified => undone(&links(k)),
            Convention::Standard => links(k),
        };
        let frame = format!("{back_name}.{}", (n - k).min(back_rows));
        Some(Substitute { frame, steps })
    });
    let at = place_of(&new.chains, &name.value).unwrap_or(0);
    let mut rows = motion.rows(convention);
    if let Some(last) = rows.last_mut() {
        last.link = old.last().and_then(|row| row.link.clone());
    }
    let held = ChainDescription {
        convention: chain.convention.clone(),
        rows,
        tip: end,
        ..ChainDescription::frame(&new.closures[closure].value.frames[1 - side].value, vec![])
    };
    let on_old = ChainDescription {
        on: new.chains[at].value.on.clone(),
        base: new.chains[at].value.base.clone(),
        ..front
    };
    new.chains.splice(
        at..=at,
        [
            Named::new(front_name.clone(), on_old),
            Named::new(name.value.clone(), held),
            Named::new(back_name.clone(), back),
        ],
    );
    let opened = &description.joints[place.joint];
    let joint = opened.name.value.clone();
    let name = free_closure(&new, closure, &joint);
    // the closure measures its joint from its first frame to its second
    let mut ends = [front_name, back_name];
    if place.factor < 0.0 {
        ends.swap(0, 1);
    }
    let used = new
        .closed_forms
        .iter()
        .any(|form| names(&form.value).any(|name| *name == joint));
    let told = opened.value.role == Role::Actuated || opened.value.limits.is_some();
    let reported = (new
        .outputs
        .iter()
        .flat_map(|output| output.value.expression.names()))
    .any(|(name, _)| *name == joint);
    let kept = name == joint && place.factor.abs() == 1.0 && (used || told || reported);
    let kind = match place.slides {
        true => ClosureKind::Prismatic,
        false => ClosureKind::Revolute,
    };
    new.closures[closure] = Named::new(name, ClosureDescription::new(kind, ends));
    // declared under the name of the closure, the joint keeps its variable
    let end = place.joint + usize::from(!kept);
    new.joints.splice(place.joint..end, motion.joints.clone());
    let renamed = renamed.into_iter();
    let mut notes: Vec<ConversionNote> = renamed
        .map(|(from, to)| ConversionNote::Renamed { from, to })
        .collect();
    notes.push(ConversionNote::Variables {
        closure: description.closures[closure].name.value.clone(),
        joints: names_of(&motion.joints).map(str::to_owned).collect(),
    });
    if opened.value.role == Role::Actuated && !kept {
        let joint = joint.clone();
        notes.push(ConversionNote::DriveLost { joint });
    }
    if opened.value.limits.is_some() && !kept {
        let joint = joint.clone();
        notes.push(ConversionNote::LimitsLost { joint });
    }
    new.closed_forms.retain(|form| {
        let lost = !kept
            && names(&form.value).any(|name| *name == joint)
            && place_of(&form.value.locals, &joint).is_none();
        if lost {
            notes.push(ConversionNote::Dropped {
                closed_form: form.name.value.clone(),
                joint: joint.clone(),
            });
        }
        !lost
    });
    let description = new;
    Conversion { description, notes }
}

/// Rows from the old tip, a frame of that name, back to the axis of row r.
fn back(
    name: &str,
    chain: &ChainDescription,
    convention: Convention,
    r: usize,
    links: &impl Fn(usize) -> Vec<Displacement>,
) -> ChainDescription {
    let n = chain.rows.len();
    let mut base = undone(&chain.tip);
    let mut tip = Vec::new();
    match convention {
        Convention::Modified if r + 1 < n => tip = undone(&links(r + 1)),
        Convention::Modified => {}
        Convention::Standard => base.extend(undone(&links(n))),
    }
    let rows = (r + 1..n).rev().map(|k| {
        let twisted = match convention {
            Convention::Modified => chain.rows.get(k + 1),
            Convention::Standard => chain.rows.get(k - 1),
        };
        let twist =
            |of: fn(&RowDescription) -> &Entry| twisted.map_or_else(zero, |row| negated(of(row)));
        let (alpha, a) = (twist(|row| &row.alpha), twist(|row| &row.a));
        let RowDescription { d, theta, .. } = &chain.rows[k];
        // the way back comes from behind a joint to the link before it
        let link = chain.rows[k - 1].link.clone();
        RowDescription {
            link,
            ..RowDescription::new(alpha, a, negated(d), negated(theta))
        }
    });
    ChainDescription {
        on: Some(Spanned::nowhere(name.to_owned())),
        convention: chain.convention.clone(),
        base,
        rows: rows.collect(),
        tip,
    }
}

/// Every name in the formulas of a closed form.
fn names(form: &crate::description::ClosedFormDescription) -> impl Iterator<Item = &String> {
    let locals = form.locals.iter().map(|local| &local.value);
    let identities = form.identities.iter().map(|identity| &identity.value);
    let position = form.position.iter().flatten();
    let rotation = form.rotation.iter().flatten().flatten();
    let transform = form.transform.iter().flatten().flatten();
    let entries = form.entries.iter().map(|(_, entry)| entry);
    locals
        .chain(identities)
        .chain(position)
        .chain(rotation)
        .chain(transform)
        .chain(entries)
        .chain(&form.identity)
        .flat_map(|entry| entry.expression.names().map(|(name, _)| name))
}
