//! Frames that other parts of a file refer to, when they are called otherwise or stand elsewhere.

use std::convert::Infallible;
use std::ops::Range;

use crate::description::{
    ChainDescription, ClosedFormDescription, Description, Displacement, Entry, LoadsDescription,
    Named, Spanned, first_free, place_of,
};
use crate::mechanism::PoseCoordinate;

/// Substitute for a frame in the new file: another frame and a displacement from it.
pub(super) struct Substitute {
    pub frame: String,
    pub steps: Vec<Displacement>,
}

/// A name that no chain and no platform of the file has.
pub(super) fn free_name(description: &Description, wanted: &str) -> String {
    first_free(wanted, |name| {
        description.is_free_body(name) && !name.contains('.')
    })
}

/// Exchanges frames wherever they are referred to. A chain without rows carries a frame that is not
/// one of the new file by itself; returns the names that changed.
pub(super) fn exchange(
    description: &mut Description,
    substitute: impl Fn(&str) -> Option<Substitute>,
) -> Vec<(String, String)> {
    let mut renamed: Vec<(String, String)> = Vec::new();
    // a chain takes the displacement into its base
    for chain in &mut description.chains {
        let on = chain.value.on.as_ref().map(|on| on.value.clone());
        if let Some(found) = on.as_deref().and_then(&substitute) {
            chain.value.on = Some(Spanned::nowhere(found.frame));
            chain.value.base.splice(0..0, found.steps);
        }
    }
    let mut wanted: Vec<String> = Vec::new();
    let closures = description.closures.iter().flat_map(|c| &c.value.frames);
    let forms = description.closed_forms.iter();
    let forms = forms.flat_map(|form| form.value.of.iter().chain(&form.value.relative_to));
    let outputs = description.outputs.iter();
    let outputs = outputs.flat_map(|output| output.value.expression.names());
    let outputs = outputs.map(|(name, _)| &name[frame_in(name)]);
    let mut loads = description.loads.clone();
    let loads = loads
        .points()
        .map(|point| &point.value[..frame_of(&point.value)]);
    let frames = closures.chain(forms).map(|frame| frame.value.as_str());
    for frame in frames.chain(outputs).chain(loads) {
        if !wanted.iter().any(|known| known == frame) {
            wanted.push(frame.to_owned());
        }
    }
    for frame in wanted {
        let Some(found) = substitute(&frame) else {
            continue;
        };
        let name = match found.steps.is_empty() {
            true => found.frame,
            false => {
                let name = free_name(description, &frame.replace('.', "_"));
                let after = found.frame.split('.').next().unwrap_or_default().to_owned();
                let place = place_of(&description.chains, &after);
                let place = place.map_or(description.chains.len(), |place| place + 1);
                let chain = ChainDescription::frame(&found.frame, found.steps);
                let chain = Named::new(name.clone(), chain);
                description.chains.insert(place, chain);
                name
            }
        };
        if name != frame {
            renamed.push((frame, name));
        }
    }
    for frame in description
        .closures
        .iter_mut()
        .flat_map(|closure| &mut closure.value.frames)
    {
        if let Some((_, new)) = renamed.iter().find(|(old, _)| *old == frame.value) {
            frame.value.clone_from(new);
        }
    }
    rename(
        &mut description.closed_forms,
        &mut description.outputs,
        &mut description.loads,
        &renamed,
    );
    renamed
}

/// Refers to links that have names by chain and number, as a conversion may put their frames elsewhere.
pub(super) fn number_links(description: &mut Description) {
    let chains = description.chains.iter();
    let links = chains.flat_map(|chain| {
        let rows = (1..).zip(&chain.value.rows);
        rows.filter_map(|(k, row)| {
            let link = row.link.as_ref()?.value.clone();
            Some((link, format!("{}.{k}", chain.name.value)))
        })
    });
    let links: Vec<(String, String)> = links.collect();
    exchange(description, |frame| {
        let (_, frame) = links.iter().find(|(link, _)| link == frame)?.clone();
        let steps = Vec::new();
        Some(Substitute { frame, steps })
    });
}

/// Exchanges the names of frames in closed forms, quantities and loads.
pub(super) fn rename(
    closed_forms: &mut [Named<ClosedFormDescription>],
    outputs: &mut [Named<Entry>],
    loads: &mut LoadsDescription,
    renamed: &[(String, String)],
) {
    let new_name = |name: &str| {
        let known = renamed.iter().find(|(old, _)| old == name);
        known.map(|(_, new)| new.as_str())
    };
    for form in closed_forms {
        for frame in form.value.of.iter_mut().chain(&mut form.value.relative_to) {
            if let Some(new) = new_name(&frame.value) {
                frame.value = new.to_owned();
            }
        }
    }
    for output in outputs {
        let exchanged = output.value.expression.try_resolve(|name, _| {
            let (place, mut name) = (frame_in(name), name.clone());
            if let Some(new) = new_name(&name[place.clone()]) {
                name.replace_range(place, new);
            }
            Ok::<String, Infallible>(name)
        });
        output.value.expression = exchanged.expect("every name is kept or exchanged");
    }
    for point in loads.points() {
        let end = frame_of(&point.value);
        if let Some(new) = new_name(&point.value[..end]) {
            point.value.replace_range(..end, new);
        }
    }
}

/// The end of the name of the frame in that of a point, such as `top+0.15,0.05`.
pub(super) fn frame_of(point: &str) -> usize {
    point.find('+').unwrap_or(point.len())
}

/// Place of the name of a frame in that of a quantity, such as `velocity:[left+1].x`; of others, of what follows the
/// kind.
pub(super) fn frame_in(name: &str) -> Range<usize> {
    let start = name.find(':').map_or(0, |colon| colon + 1);
    if let Some(inside) = name[start..].strip_prefix('[') {
        let end = inside.find(['+', ']']).unwrap_or(inside.len());
        return start + 1..start + 1 + end;
    }
    match name.rsplit_once('.') {
        Some((frame, word)) if PoseCoordinate::from_word(word).is_some() && frame.len() > start => {
            start..frame.len()
        }
        _ => start..name.len(),
    }
}

/// The number of a link frame of a chain, `name.k`.
pub(super) fn link_of(frame: &str, chain: &str) -> Option<usize> {
    frame.strip_prefix(chain)?.strip_prefix('.')?.parse().ok()
}
