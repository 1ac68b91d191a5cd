//! The fourteen steps of the Denavit–Hartenberg algorithm, with what each of them gave.

use super::super::quantity::{degrees, metres, number, triple};
use super::{relation, sense_of_first};
use crate::analysis::frames::PlacedChain;
use crate::geometry::Relation;
use crate::mechanism::TableRow;
use crate::output::document::Section;

fn place(v: [f64; 3]) -> String {
    let [x, y, z] = v.map(number);
    format!("({x}, {y}, {z}) m")
}

fn variable(constant: String, zero: bool, factor: f64, name: &str) -> String {
    let moving = if factor < 0.0 {
        format!("-{name}")
    } else {
        name.to_owned()
    };
    match (factor == 0.0, zero) {
        (true, _) => constant,
        (false, true) => moving,
        (false, false) => match constant.strip_prefix('-') {
            Some(size) => format!("{moving} - {size}"),
            None => format!("{moving} + {constant}"),
        },
    }
}

fn why_origin(found: Option<Relation>, k: usize) -> String {
    match found {
        None => format!("free: where d{k} = 0"),
        Some(Relation::Skew) => "at the foot of the common normal".into(),
        Some(Relation::Intersecting) => "where the axes meet".into(),
        Some(Relation::NearlyParallel) => format!("on the axis where d{k} = 0"),
        Some(_) => format!("free along the axis: where d{k} = 0"),
    }
}

fn why_x(found: Option<Relation>, k: usize) -> String {
    match found {
        None => format!("free: θ{k} = 0"),
        Some(Relation::Skew) => "along the common normal".into(),
        Some(Relation::NearlyParallel) => {
            format!(
                "orthogonal to the axis, to where axis {} meets that plane",
                k + 1
            )
        }
        Some(Relation::Intersecting) => {
            format!("orthogonal to both axes, in the sense in which θ{k} is within ±90°")
        }
        Some(Relation::Parallel | Relation::AntiParallel) => {
            "orthogonal to both axes, away from the one before".into()
        }
        Some(_) => format!("free: θ{k} = 0"),
    }
}

/// The steps for one chain. In the modified convention z of frame k lies along joint k, in the
/// standard one, for which the steps are printed, along joint k + 1.
pub(super) fn steps(chain: &PlacedChain, modified: bool) -> Section {
    let n = chain.joints.len();
    let mut lines = Vec::new();
    let mut say = |step: usize, what: String| lines.push(format!("{step:>2}. {what}"));
    let kind = |row: &TableRow| {
        if row.turn == 0.0 {
            "prismatic"
        } else {
            "revolute"
        }
    };
    let joints: Vec<String> = (chain.joints.iter().zip(&chain.rows).enumerate())
        .map(|(k, (joint, row))| format!("{} {joint} ({})", k + 1, kind(row)))
        .collect();
    say(1, format!("joints from the base: {}", joints.join(", ")));
    let frame = &chain.frames[0];
    say(
        2,
        format!(
            "L0 at {}, z0 {} along {}, x0 {}; k = 1",
            place(frame.position),
            triple(&frame.z),
            if modified && chain.starts_at_base {
                "the base's z"
            } else {
                "the axis of joint 1"
            },
            triple(&frame.x)
        ),
    );
    // all that follows the axis of joint k in the one convention follows that of joint k + 1 in the other
    let ahead = usize::from(!modified);
    let placed = 1..n + 1 - ahead;
    for k in placed.clone() {
        let (frame, normal) = (&chain.frames[k], &chain.normals[k]);
        let (joint, z) = (k + ahead, triple(&frame.z));
        say(3, format!("z{k} along the axis of joint {joint}: {z}"));
        let axes = match normal.relation {
            None => String::new(),
            found => format!("axes {k} and {} {}: ", k + 1, relation(found)),
        };
        let why = why_origin(normal.relation, k);
        say(4, format!("L{k} at {}: {axes}{why}", place(frame.position)));
        let sense = sense_of_first(chain).filter(|_| k == 1);
        let why = match sense {
            Some(sense) => format!("orthogonal to both axes, in the sense: {sense}"),
            None => why_x(normal.relation, k),
        };
        say(5, format!("x{k} {}: {why}", triple(&frame.x)));
        say(6, format!("y{k} = z{k} × x{k} = {}", triple(&frame.y)));
        let on = if k + 1 < placed.end {
            "k < n: go on"
        } else {
            "k = n: done"
        };
        say(7, format!("k = {}; {on}", k + 1));
    }
    let last = &chain.frames[n];
    let end = match (modified, chain.ends_at_tool) {
        (true, _) => format!("L{n} is the last link's; the rest, up to the tool, is the tip"),
        (false, true) => format!("L{n} at the tool"),
        (false, false) => format!("L{n} on the last axis, a{n} = α{n} = 0; the rest is the tip"),
    };
    say(
        8,
        format!(
            "{end}: {}, x{n} {}, y{n} {}, z{n} {}; k = 1",
            place(last.position),
            triple(&last.x),
            triple(&last.y),
            triple(&last.z)
        ),
    );
    for (k, row) in (1..).zip(&chain.rows) {
        let (link, z) = (k - 1 + ahead, k - ahead);
        let (joint, foot) = (&chain.joints[k - 1], place(chain.normals[k].from));
        say(9, format!("b{k} at {foot}, where x{k} meets z{z}"));
        let theta = variable(degrees(row.theta), row.theta == 0.0, row.turn, joint);
        say(
            10,
            format!("θ{k} = {theta}, from x{} to x{k} about z{z}", k - 1),
        );
        let d = variable(metres(row.d), row.d == 0.0, row.slide, joint);
        say(11, format!("d{k} = {d}, along z{z} to b{k}"));
        say(12, format!("a{link} = {}, along x{link}", metres(row.a)));
        let (alpha, from) = (degrees(row.alpha), link - ahead);
        let to = from + 1;
        let tilt = match row.beta {
            0.0 => String::new(),
            beta => format!(", then β{link} = {} about y", degrees(beta)),
        };
        say(
            13,
            format!("α{link} = {alpha}, from z{from} to z{to} about x{link}{tilt}"),
        );
        let on = if k < n { "k ≤ n: go on" } else { "stop" };
        say(14, format!("k = {}; {on}", k + 1));
    }
    Section::new(format!("Steps for {}", chain.name)).list(lines)
}
