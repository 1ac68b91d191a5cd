//! Chains in the other convention.
//!
//! Both are the product base · J₁ L₁ J₂ … L_{n−1} J_n · tip with J = Rz(θ)·Tz(d), L = Tx(a)·Rx(α)·Ry(β).
//! A modified row is L_{k−1} J_k, a standard row J_k L_k: twist and length move to the neighbouring
//! row, a remainder at an end into base or tip. Frame k moves by L_k.

use super::references::{Substitute, exchange, link_of};
use super::{Conversion, ConversionNote};
use crate::description::steps::{link, undone, zero};
use crate::description::{
    ChainDescription, Convention, Displacement, Entry, RowDescription, Spanned,
};

/// a, α and β of L₀ … L_n.
type Links = Vec<[Entry; 3]>;

pub(super) fn convert(conversion: &mut Conversion, to: Convention) {
    let description = &mut conversion.description;
    let of_file = description.convention.as_ref().map(|c| c.value);
    let mut moved: Vec<(String, Links)> = Vec::new();
    for chain in &mut description.chains {
        let from = chain.value.convention.take().map(|c| c.value).or(of_file);
        if let Some(from) = from.filter(|&from| from != to && !chain.value.rows.is_empty()) {
            let links = links(&chain.value.rows, from);
            rewrite(&mut chain.value, &links, to);
            moved.push((chain.name.value.clone(), links));
        }
    }
    description.convention = Some(Spanned::nowhere(to));
    let renamed = exchange(description, |frame| {
        moved.iter().find_map(|(chain, links)| {
            let k = link_of(frame, chain)?;
            let step = link(links.get(k)?.each_ref());
            // the modified frame stands before L_k, the standard one behind it
            let steps = match to {
                Convention::Modified if k > 0 => step,
                Convention::Standard => undone(&step),
                Convention::Modified => Vec::new(),
            };
            let frame = frame.to_owned();
            (!steps.is_empty()).then_some(Substitute { frame, steps })
        })
    });
    for (from, to) in renamed {
        // a frame that a cut has renamed before is named once
        let before = conversion.notes.iter_mut().find_map(|note| match note {
            ConversionNote::Renamed { to, .. } if *to == from => Some(to),
            _ => None,
        });
        match before {
            Some(name) => *name = to,
            None => conversion.notes.push(ConversionNote::Renamed { from, to }),
        }
    }
}

fn links(rows: &[RowDescription], from: Convention) -> Links {
    let own = rows
        .iter()
        .map(|row| [&row.a, &row.alpha, &row.beta].map(Entry::clone));
    let nothing = std::iter::once([zero(), zero(), zero()]);
    match from {
        Convention::Modified => own.chain(nothing).collect(),
        Convention::Standard => nothing.chain(own).collect(),
    }
}

fn rewrite(chain: &mut ChainDescription, links: &Links, to: Convention) {
    let n = chain.rows.len();
    let shift = usize::from(to == Convention::Standard);
    let rows = chain.rows.iter().enumerate().map(|(k, old)| {
        let [a, alpha, beta] = links[k + shift].clone();
        RowDescription {
            alpha,
            a,
            beta,
            ..old.clone()
        }
    });
    chain.rows = rows.collect();
    let step = |k: usize| -> Vec<Displacement> { link(links[k].each_ref()) };
    match to {
        Convention::Standard => chain.base.extend(step(0)),
        Convention::Modified => {
            chain.tip.splice(0..0, step(n));
        }
    }
}
