//! Twists in words and numbers.

use super::document::{Column, Table, cells};
use super::quantity::{quantity, short};
use crate::system::{Screw, TwistSpace};

/// A table of twists.
pub(super) fn twist_table(spaces: &[TwistSpace]) -> Table {
    let mut table = Table::new([
        Column::words("body"),
        Column::words("motion"),
        Column::words("along"),
        Column::words("through").in_unit("m"),
        Column::words("pitch"),
    ]);
    for space in spaces {
        for screw in &space.screws {
            let [kind, along, through, pitch] = screw_words(screw);
            table.row(cells![&space.body, kind, along, through, pitch]);
        }
        for spin in &space.spins {
            let [_, along, through, _] = screw_words(spin);
            table.row(cells![&space.body, "idle spin", along, through, ""]);
        }
    }
    table
}

/// Kind, direction, point and pitch of a screw.
pub(super) fn screw_words(screw: &Screw) -> [String; 4] {
    let triple = |v: &[f64; 3]| format!("({})", v.map(short).join(", "));
    let along = triple(&screw.direction);
    match (&screw.point, screw.pitch) {
        (Some(point), Some(0.0)) => ["turn".into(), along, triple(point), String::new()],
        (Some(point), Some(pitch)) => {
            let pitch = format!("{}/rad", quantity(pitch, false));
            ["screw".into(), along, triple(point), pitch]
        }
        _ => ["shift".into(), along, String::new(), String::new()],
    }
}
