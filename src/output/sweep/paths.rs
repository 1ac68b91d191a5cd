//! Cusps and double points of paths.

use crate::algebra::SiUnit;
use crate::analysis::sweep::{PathPoint, PathReport};
use crate::description::{count, listed};
use crate::output::document::{Cell, Section, Table};

/// What is special on the path of each point over circuits, or along one motion if there is anything.
pub(super) fn sections(paths: &[PathReport], circuits: bool) -> impl Iterator<Item = Section> {
    let worth = move |path: &&PathReport| {
        circuits || !path.cusps.is_empty() || !path.double_points.is_empty()
    };
    (paths.iter().filter(worth)).map(move |path| section(path, circuits))
}

fn section(path: &PathReport, circuits: bool) -> Section {
    let (cusps, double) = (path.cusps.len(), path.double_points.len());
    let found = [(cusps, "cusp"), (double, "double point")];
    let found = found.into_iter().filter(|(number, _)| *number > 0);
    let found: Vec<String> = found.map(|(number, what)| count(number, what)).collect();
    let order = path.order.map(|order| format!("; order {order}"));
    let order = order.unwrap_or_default();
    let title = format!("Path of {}", path.point);
    if found.is_empty() {
        return Section::new(title).text(format!("No cusp and no double point{order}."));
    }
    let section = Section::new(format!("{title}: {}{order}", listed(&found)));
    let passages = |what: &'static str, points: &[PathPoint]| {
        let rows = points.iter().enumerate().flat_map(|(number, point)| {
            let passages = point.joints.iter().zip(&point.circuits);
            passages.map(move |(joints, circuit)| Row {
                what: format!("{what} {}", number + 1),
                circuit: *circuit,
                position: point.position,
                joints: joints.clone(),
            })
        });
        rows.collect::<Vec<_>>()
    };
    let cusps = passages("cusp", &path.cusps);
    let double = passages("double point", &path.double_points);
    let metres = |k: usize| move |row: &Row| Cell::quantity(row.position[k], SiUnit::METRE);
    let rows = [cusps, double].concat();
    let table = Table::of(&rows).words("what", |row| row.what.clone());
    let table = match circuits {
        true => table.numbers("circuit", |row| row.circuit),
        false => table,
    };
    let table = (table.numbers("x", metres(0)))
        .numbers("y", metres(1))
        .numbers("z", metres(2));
    let joints = path.variables.iter().enumerate();
    section.table(joints.fold(table, |table, (k, joint)| {
        table.numbers(&joint.name, move |row| {
            Cell::quantity(row.joints[k], joint.unit)
        })
    }))
}

/// A passage through a special point.
#[derive(Clone)]
struct Row {
    what: String,
    circuit: usize,
    position: [f64; 3],
    joints: Vec<f64>,
}
