//! Cuts of closed mechanisms. `build.rs` makes chains and closures of the rest.

use std::collections::BTreeSet;

use super::build::Build;
use super::values::Values;
use super::{CutChoice, CutReport, FramesReport};
use crate::description::{
    AxesDescription, AxesProblem, AxisKind, Convention, Graph, Problem, place_of,
};
use crate::number::sorting::sort_by_key;

/// The most ways to cut that are compared.
const MOST_WAYS: usize = 200;

/// The most choices of joints that are tried to find them.
const MOST_CHOICES: usize = 20_000;

pub(super) fn closed(
    axes: &AxesDescription,
    values: &Values,
    convention: Convention,
) -> Result<FramesReport, Vec<Problem>> {
    let graph = Graph::of(axes)?;
    let balls = axes.always_cut();
    let ways = match axes.cut.is_empty() {
        true => proposed(axes, &graph, &balls)?,
        false => (vec![given(axes, &graph, &balls)?], false),
    };
    let mut compared: Vec<(CutChoice, FramesReport)> = (ways.0.into_iter())
        .map(|cuts| {
            let built = Build::new(axes, values, &graph, &cuts, convention).build();
            (way(axes, &cuts, &balls, &built), built)
        })
        .collect();
    sort_by_key(&mut compared, |(way, _)| {
        (way.longest, way.entries, way.prismatic)
    });
    let ways_compared = compared.iter().map(|(way, _)| way.clone()).collect();
    let (best, built) = compared.swap_remove(0);
    let named = |j: &usize| axes.joints[*j].name.value.clone();
    Ok(FramesReport {
        cuts: Some(CutReport {
            cut: best
                .cut
                .into_iter()
                .chain(balls.iter().map(named))
                .collect(),
            given: !axes.cut.is_empty(),
            ways: ways_compared,
            more: ways.1,
        }),
        ..built
    })
}

fn way(
    axes: &AxesDescription,
    cuts: &BTreeSet<usize>,
    balls: &BTreeSet<usize>,
    built: &FramesReport,
) -> CutChoice {
    let named = |j: &usize| axes.joints[*j].name.value.clone();
    let chosen: Vec<usize> = cuts.difference(balls).copied().collect();
    let prismatic = |j: &&usize| axes.joints[**j].value.kind == AxisKind::Prismatic;
    let rows = built.chains.iter().flat_map(|chain| &chain.rows);
    let constants = rows.flat_map(|row| [row.alpha, row.a, row.d, row.theta]);
    let chains = built.description.chains.iter().map(|chain| &chain.value);
    let steps = chains.map(|chain| chain.base.len() + chain.tip.len());
    let on_platforms = built.description.platforms.iter();
    let on_platforms = on_platforms.flat_map(|platform| &platform.value.frames);
    let longest = built.chains.iter().map(|chain| chain.rows.len());
    CutChoice {
        longest: longest.max().unwrap_or(0),
        entries: constants.filter(|x| *x != 0.0).count()
            + steps.sum::<usize>()
            + on_platforms.map(|frame| frame.value.len()).sum::<usize>(),
        prismatic: chosen.iter().filter(prismatic).count(),
        cut: chosen.iter().map(named).collect(),
    }
}

/// The cuts that the file names.
fn given(
    axes: &AxesDescription,
    graph: &Graph,
    balls: &BTreeSet<usize>,
) -> Result<BTreeSet<usize>, Vec<Problem>> {
    let cuts = axes.named_cuts(graph)?;
    let parts = graph.parts(|j| !cuts.contains(&j));
    // what is cut off is a platform if three legs or more hold it
    let holding = |part| {
        let of = |joint: &&usize| graph.ends[**joint].iter().any(|&body| parts[body] == part);
        cuts.iter().filter(of).count()
    };
    let mut named = BTreeSet::new();
    let mut problems = Vec::new();
    for cut in &axes.cut {
        let Some(joint) = place_of(&axes.joints, &cut.value) else {
            continue;
        };
        let [a, b] = graph.ends[joint];
        // balls, cut in any case, hold bodies too
        named.insert(joint);
        let apart = graph.parts(|j| !named.contains(&j));
        let before = graph.parts(|j| !named.contains(&j) || j == joint);
        let off = !balls.contains(&joint) && apart[a] != apart[b] && before[a] == before[b];
        let mut sides = [a, b].map(|body| parts[body]).into_iter();
        if off && !sides.any(|part| part != parts[0] && holding(part) >= 3) {
            let joint = cut.value.clone();
            problems.push(AxesProblem::CutsOff { joint }.at(&cut.span));
        }
    }
    match problems.is_empty() {
        true => Ok(cuts),
        false => Err(problems),
    }
}

/// Ways to cut every loop once without cutting a driven joint, and true if there are more.
fn proposed(
    axes: &AxesDescription,
    graph: &Graph,
    balls: &BTreeSet<usize>,
) -> Result<(Vec<BTreeSet<usize>>, bool), Vec<Problem>> {
    let number = graph.loops(|j| !balls.contains(&j));
    let (driven, leading) = (axes.driven(), axes.leading());
    let stays = |j: usize| driven[j] || leading.contains(&*axes.joints[j].name.value);
    let free: Vec<usize> = (0..axes.joints.len())
        .filter(|&j| !balls.contains(&j) && !stays(j))
        .collect();
    let mut found = Vec::new();
    let mut choices = 0;
    // choices of `number` of the free joints in the order of the file, depth first
    let mut chosen: Vec<usize> = Vec::new();
    let mut next = 0;
    loop {
        let opens = |chosen: &[usize]| {
            let cut = |j: usize| balls.contains(&j) || chosen.iter().any(|&c| free[c] == j);
            graph.loops(|j| !cut(j)) + chosen.len() == number
        };
        if chosen.len() == number && opens(&chosen) {
            let cuts = chosen.iter().map(|&c| free[c]);
            found.push(balls.iter().copied().chain(cuts).collect());
        }
        choices += 1;
        if choices > MOST_CHOICES || found.len() == MOST_WAYS {
            break;
        }
        // a choice that takes something off is not continued
        if chosen.len() < number && next < free.len() {
            chosen.push(next);
            if !opens(&chosen) {
                chosen.pop();
            }
            next += 1;
        } else {
            match chosen.pop() {
                Some(last) => next = last + 1,
                None => break,
            }
        }
    }
    let more = choices > MOST_CHOICES || found.len() == MOST_WAYS;
    match found.is_empty() {
        true => Err(vec![AxesProblem::NothingToCut.at(&axes.name.span)]),
        false => Ok((found, more)),
    }
}
