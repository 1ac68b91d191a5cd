//! Mobility of a mechanism, in sentences.

use crate::analysis::mobility::{
    Character, Elsewhere, LocalFreedom, MobilityReport, Redundancy, RedundantWrench,
};
use crate::description::{count, listed};
use crate::linear::{RANK_TOLERANCE, SPECTRUM_LIMIT};
use crate::output::assembly_remarks;
use crate::output::quantity::{clause, coarse, form, if_any, metres, signed, triple, values};

/// The answer: how many freedoms, and why that is not what counting says.
pub(super) fn explanation(report: &MobilityReport) -> String {
    let answer = assembly_remarks::after_moving(report.pose.moved.as_ref(), mobility(report));
    let mut sentences = vec![answer];
    sentences.extend(judged(report));
    sentences.push(counted(report));
    if !report.redundancies.is_empty() {
        let redundant: Vec<String> = report.redundancies.iter().map(redundancy).collect();
        let verb = form(report.redundant, "is", "are");
        sentences.push(format!("Redundant {verb}: {}.", redundant.join("; ")));
    }
    let (rods, links): (Vec<&LocalFreedom>, Vec<&LocalFreedom>) =
        (report.idle_freedoms.iter()).partition(|freedom| matches!(freedom, LocalFreedom::Rod(_)));
    let why_rods = "Kutzbach's count leaves out too, as a `Distance` does not model it";
    for (spins, why) in [(links, "Kutzbach's count includes"), (rods, why_rods)] {
        let what = match &spins[..] {
            [] => continue,
            [one] => idle(one),
            _ => "each a spin of a link about its own line".into(),
        };
        let freedoms = count(spins.len(), "idle freedom");
        sentences.push(format!("Not counted: {freedoms}, {what}, which {why}."));
    }
    let still = still(report);
    if report.mobility > 0 && !still.is_empty() {
        sentences.push(format!("{} still.", clause(&still, "stands", "stand")));
    }
    sentences.extend(locked(report));
    sentences.extend((report.elsewhere.iter()).map(|other| elsewhere(report, other)));
    sentences.extend(assembly_remarks::given(&report.pose));
    sentences.join(" ")
}

/// The pose that was judged, where that is beside the singular one it is taken for.
pub(super) fn judged(report: &MobilityReport) -> Option<String> {
    let part = report.neglected?;
    let values = values(&report.variables, report.joints.values()).into_iter();
    let exact = report.variables.iter().zip(report.joints.values());
    let at = listed(
        values
            .zip(exact)
            // how far small values in rad or m are from 0 matters here
            .map(|(said, (of, x))| match *x != 0.0 && x.abs() < 1e-4 {
                true => format!("{} = {x:.1e} {}", of.name, of.unit),
                false => said,
            }),
    );
    Some(format!(
        "The configuration judged, {at}, is beside a singular one and is taken for it: singular values of up to {part:.1e} of \
         the largest count as 0."
    ))
}

/// Special configuration with all freedoms, as in gimbal lock, in a sentence.
pub(super) fn locked(report: &MobilityReport) -> Option<String> {
    let (locked, all) = (report.gimbal_locked, report.infinitesimal);
    (locked > 0).then(|| {
        format!(
            "The configuration is special, as in gimbal lock: {} there without moving \
             anything else, so that links move with {} of the {all} freedoms only.",
            clause(&report.gimbal_locked_joints, "turns", "turn"),
            all - locked.min(all),
        )
    })
}

/// Joints that stand still in every motion, idle ones too.
pub(super) fn still(report: &MobilityReport) -> Vec<String> {
    let idle = report.idle_joints.iter();
    idle.filter(|joint| !report.spinning_joints.contains(joint))
        .cloned()
        .collect()
}

fn freedoms(number: usize) -> String {
    match number {
        0 => "no freedom".into(),
        _ => count(number, "freedom"),
    }
}

pub(super) fn mobility(report: &MobilityReport) -> String {
    let (mobility, infinitesimal) = (report.mobility, report.infinitesimal);
    // `With a locked `, where something is
    let with = if_any(&report.locked, |locked| format!("With {locked} locked "));
    let the_mechanism = match with.is_empty() {
        true => "The mechanism".into(),
        false => format!("{with}the mechanism"),
    };
    match report.character {
        Character::Structure if !with.is_empty() => {
            format!("{with}nothing can move, not even infinitesimally.")
        }
        Character::Structure => "A structure: nothing can move, not even infinitesimally.".into(),
        Character::Regular if report.counted_beside => format!(
            "{the_mechanism} has {}, counted beside this configuration.",
            freedoms(mobility)
        ),
        Character::Regular => match report.singular_at {
            None => format!("{the_mechanism} has {}.", freedoms(mobility)),
            Some(distance) => format!(
                "{the_mechanism} has {}; the configuration is regular, but only about {} (in rad, and \
                 lengths divided by {}) away from a singular one.",
                freedoms(mobility),
                coarse(distance),
                metres(report.length)
            ),
        },
        Character::Shaky => {
            let gap = match report.gap_after_step {
                Some(gap) => format!("a finite step leaves the closures open by {gap:.1e}"),
                None => "no finite step closes".into(),
            };
            let shaky = match with.is_empty() {
                true => "Infinitesimally flexible (shaky): it".into(),
                false => format!("{the_mechanism} is infinitesimally flexible (shaky): it"),
            };
            let freedoms = freedoms(infinitesimal);
            format!(
                "{shaky} has {freedoms} to first order, none of them finite ({gap}), so it cannot move."
            )
        }
        Character::Singular => format!(
            "{the_mechanism} has {} at this singular configuration, where {infinitesimal} {} \
             infinitesimal{}.",
            freedoms(mobility),
            form(infinitesimal, "is", "are"),
            match report.branches_complete {
                true => "",
                false => "; at least the one branch shown passes through it",
            }
        ),
        Character::Bifurcation => format!(
            "{}ifurcation: {}{} branches of {} each meet here, where {infinitesimal} freedoms are \
             infinitesimal; the motion can pass from one to the other.",
            match with.is_empty() {
                true => "B".into(),
                false => with + "a b",
            },
            at_least(report),
            report.branch_count,
            freedoms(mobility)
        ),
        Character::Kinematotropic => {
            let branches = report.branches.iter();
            let each = branches.map(|branch| branch.mobility);
            let of = match report.branch_count {
                ..=8 => format!("branches of {}", listed(each.map(|n| n.to_string()))),
                many => format!(
                    "{many} branches, of {} to {mobility}",
                    each.min().unwrap_or(0)
                ),
            };
            format!(
                "{}inematotropic: {}{of} freedoms meet here, where {infinitesimal} are \
                 infinitesimal, so the mobility depends on the branch.",
                match with.is_empty() {
                    true => "K".into(),
                    false => format!("{the_mechanism} is k"),
                },
                at_least(report),
            )
        }
    }
}

fn at_least(report: &MobilityReport) -> &'static str {
    match report.branches_complete {
        true => "",
        false => "at least ",
    }
}

pub(super) fn counted(report: &MobilityReport) -> String {
    let (unknowns, equations, rank) = (report.unknowns, report.equations, report.rank);
    if equations == 0 {
        let not_locked = match report.locked.is_empty() {
            true => "",
            false => " that are not locked",
        };
        return format!(
            "There are no closures: all {unknowns} joint variables{not_locked} are free."
        );
    }
    let independent = match (equations, report.redundant) {
        (1, 0) => " and is independent".into(),
        (1, _) => " and is redundant".into(),
        (_, 0) => ", all of them independent".into(),
        (_, redundant) => format!(", {redundant} of them redundant"),
    };
    let equations_said = match equations {
        _ if report.locking > 0 => format!(
            "the {equations} equations, {} of which {}, have",
            report.locking,
            form(
                report.locking,
                "locks a coordinate of a platform",
                "lock coordinates of platforms"
            )
        ),
        1 => "the closure equation has".into(),
        _ => format!("the {equations} closure equations have"),
    };
    format!(
        "Kutzbach counts {unknowns} − {equations} = {}; {equations_said} rank \
         {rank}{independent}.",
        signed(report.kutzbach)
    )
}

/// Method by which the rank of a large mechanism was found; empty for others, whose singular values are all computed.
pub(super) fn elimination(report: &MobilityReport) -> String {
    match report.unknowns > SPECTRUM_LIMIT {
        true => format!(
            ", estimated; the rank is that of an orthogonal elimination of one unknown after another, in which a column \
             shorter than {RANK_TOLERANCE:e} of the largest singular value depends on the others; beyond \
             {SPECTRUM_LIMIT} unknowns redundant equations are counted and not listed"
        ),
        false => String::new(),
    }
}

pub(super) fn idle(freedom: &LocalFreedom) -> String {
    match freedom {
        LocalFreedom::Joints(joints) => {
            format!("a link spins about its own line in {}", listed(joints))
        }
        LocalFreedom::Platforms { platforms, joints } => {
            let spin = form(platforms.len(), "spins about its own", "spin about their");
            let joints = if_any(joints, |joints| format!(" in {joints}"));
            format!("{} {spin} line{joints}", listed(platforms))
        }
        LocalFreedom::Rod(rod) => format!("rod {rod} spins about its own line"),
    }
}

pub(super) fn elsewhere(report: &MobilityReport, other: &Elsewhere) -> String {
    let near = listed(values(&report.variables, other.joints.values()));
    let freedoms = freedoms(other.mobility);
    format!("The mobility depends on the assembly: near {near} the mechanism has {freedoms}.")
}

/// ``closure `pin`: force along z, moments about x and y``
pub(super) fn redundancy(redundancy: &Redundancy) -> String {
    let closure = format!("closure `{}`: ", redundancy.closure);
    if redundancy.rod {
        return closure + "force along the rod";
    }
    let words = [
        ("force along", "forces along"),
        ("moment about", "moments about"),
    ];
    let mut parts = Vec::new();
    for (part, (one, many)) in words.into_iter().enumerate() {
        let wrenches = redundancy.wrenches.iter().filter_map(axis);
        let axes: Vec<&str> = (wrenches.filter(|(kind, _)| *kind == part))
            .map(|(_, axis)| ["x", "y", "z"][axis])
            .collect();
        match axes[..] {
            [] => {}
            [axis] => parts.push(format!("{one} {axis}")),
            _ => parts.push(format!("{many} {}", listed(&axes))),
        }
    }
    let others = redundancy.wrenches.iter().filter(|w| axis(w).is_none());
    parts.extend(others.map(general));
    closure + &parts.join(", ")
}

/// `(0, 2)` for a force along z, `(1, 0)` for a moment about x.
fn axis(wrench: &RedundantWrench) -> Option<(usize, usize)> {
    let parts = [wrench.force, wrench.moment];
    let places = (0..6).map(|i| (i / 3, i % 3));
    let nonzero: Vec<(usize, usize)> = places.filter(|&(part, i)| parts[part][i] != 0.0).collect();
    match nonzero[..] {
        [one] => Some(one),
        _ => None,
    }
}

fn general(wrench: &RedundantWrench) -> String {
    let size = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let triple = |v: &[f64; 3], length: f64| triple(&v.map(|x| x / length));
    let (force, moment) = (size(&wrench.force), size(&wrench.moment));
    if force == 0.0 {
        return format!("moment about {}", triple(&wrench.moment, moment));
    }
    let along = format!("force along {}", triple(&wrench.force, force));
    match moment < 1e-9 * force {
        true => along,
        false => format!("{along} with moment {} m", triple(&wrench.moment, force)),
    }
}
