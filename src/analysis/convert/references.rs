//! Frames that other parts of a file refer to, when they are called otherwise or stand elsewhere.

use crate::description::{
    ChainDescription, Description, Displacement, Named, Spanned, first_free, place_of,
};

/// What stands for a frame in the new file: a frame and a displacement from it.
pub(super) struct Substitute {
    pub frame: String,
    pub steps: Vec<Displacement>,
}

/// A name that no chain and no platform of the file has.
pub(super) fn free_name(description: &Description, wanted: &str) -> String {
    first_free(wanted, "_", |name| {
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
    for frame in closures.chain(forms) {
        if !wanted.contains(&frame.value) {
            wanted.push(frame.value.clone());
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
    let new_name = |name: &mut String| {
        if let Some((_, new)) = renamed.iter().find(|(old, _)| old == name) {
            name.clone_from(new);
        }
    };
    for closure in &mut description.closures {
        let frames = closure.value.frames.iter_mut();
        frames.for_each(|frame| new_name(&mut frame.value));
    }
    for form in &mut description.closed_forms {
        let frames = form.value.of.iter_mut().chain(&mut form.value.relative_to);
        frames.for_each(|frame| new_name(&mut frame.value));
    }
    renamed
}

/// The number of a link frame of a chain, `name.k`.
pub(super) fn link_of(frame: &str, chain: &str) -> Option<usize> {
    frame.strip_prefix(chain)?.strip_prefix('.')?.parse().ok()
}
