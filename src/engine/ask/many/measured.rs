//! Quantities and Jacobians at rows that were reached, and a search for rows that no path leads to.

use std::sync::Arc;

use super::{Many, Unreached};
use crate::analysis::quantities::Meter;
use crate::ask::preparation::with_joint;
use crate::ask::{AskError, Question, Role};
use crate::geometry::{RollPitchYaw, Vector3};
use crate::mechanism::{Configuration, Mechanism, PlatformPose, Quantity, Variable};
use crate::solve::{Progress, Stage, Watch, each};
use crate::system::{Coordinate, NamedUnit};

/// Rows for which the quantities are planned once.
const ROWS: usize = 256;

/// Quantities at rows of held values.
#[derive(Clone, Debug, PartialEq)]
pub struct ManyMeasured {
    /// The quantities that the question reports.
    pub columns: Vec<Variable>,
    /// Row by row; not a number where something is not determined.
    pub values: Vec<f64>,
    /// The Jacobian of each row, if it was asked for.
    pub jacobians: Option<Jacobians>,
}

/// Rates of outputs for unit rates of what is held, at each row: `entries` are row by row of one Jacobian after another, each
/// in the unit of its output over that of its input. Not a number at singular configurations.
#[derive(Clone, Debug, PartialEq)]
pub struct Jacobians {
    /// The outputs: rows of each Jacobian.
    pub rows: Vec<NamedUnit>,
    /// The held coordinates: columns of each Jacobian.
    pub columns: Vec<NamedUnit>,
    /// The entries.
    pub entries: Vec<f64>,
}

impl Question {
    /// The question with the named coordinates held, at home where it holds them at no value.
    fn holding_names(&self, names: &[String]) -> Question {
        let known = self.mechanism().clone();
        let more: Arc<Mechanism> = (names.iter()).fold(known, |of, name| with_joint(of, name));
        let held = |name: &String| self.of(Role::Hold).any(|(_, held)| held.name == *name);
        let free = names.iter().filter(|name| !held(name));
        free.fold(self.about(more), |asked, name| asked.hold(name, "home"))
    }

    /// The quantities that the question reports ([`Question::report`]) at rows of held values that were found by
    /// [`solve_many`](Self::solve_many) for the same names, and with `jacobian` the input–output Jacobian at each.
    ///
    /// # Errors
    /// If a quantity is wrong, or the mechanism does not assemble where the paths began.
    pub fn measure_many(
        &self,
        names: &[String],
        many: &Many,
        jacobian: bool,
        watch: &Watch,
    ) -> Result<ManyMeasured, AskError> {
        let mut asked = self.holding_names(names);
        let figure = |part: &str| part.trim() == "condition";
        let mut lists = self.of(Role::Report);
        // its figures need a Jacobian; the column is left out of the answer
        let more = jacobian
            && !lists.any(|(_, of)| Quantity::split(&of.name).iter().any(|part| figure(part)));
        if more {
            asked = asked.report("condition");
        }
        let held = asked.resolved()?;
        let start = asked.start(&held.clone().with_spins_still(), watch)?;
        let (quantities, inputs) = asked.measured_by_rates(&held)?;
        let shown = quantities.len() - usize::from(more);
        let columns = quantities[..shown].iter();
        let columns = columns.map(|of| Variable::new(&of.name, of.unit)).collect();
        let metered = asked.metered(held, quantities, inputs)?;
        let axes = Meter::new(&metered, &start).axes();
        let entries: usize = axes.iter().map(Vec::len).product();
        let (rows, width) = (many.reached.len(), many.names.len());
        let mechanism = asked.mechanism();
        let blocks = each(rows.div_ceil(ROWS), &(), |(), block| {
            let mut meter = Meter::new(&metered, &start);
            let mut at = start.clone();
            let (mut values, mut jacobians) = (Vec::new(), Vec::new());
            for row in block * ROWS..rows.min((block + 1) * ROWS) {
                let now = Progress {
                    stage: Stage::Rows,
                    done: row,
                    of: Some(rows),
                };
                if watch.at(now).is_break() {
                    return None;
                }
                let known = many.reached[row];
                if known {
                    place(
                        mechanism,
                        &many.values[row * width..(row + 1) * width],
                        &mut at,
                    );
                    let read = meter.read_here(&at)[..shown].iter();
                    values.extend(read.map(|value| value.unwrap_or(f64::NAN)));
                } else {
                    values.resize(values.len() + shown, f64::NAN);
                }
                if jacobian {
                    let first = jacobians.len();
                    jacobians.extend(meter.jacobian().filter(|_| known).into_iter().flatten());
                    jacobians.resize(first + entries, f64::NAN);
                }
            }
            Some((values, jacobians))
        });
        let blocks: Option<Vec<_>> = blocks.into_iter().collect();
        let (values, jacobians): (Vec<_>, Vec<_>) =
            blocks.ok_or(AskError::Interrupted)?.into_iter().unzip();
        let [outputs, inputs] = axes;
        Ok(ManyMeasured {
            columns,
            values: values.concat(),
            jacobians: jacobian.then(|| Jacobians {
                rows: outputs,
                columns: inputs,
                entries: jacobians.concat(),
            }),
        })
    }

    /// Searches for an assembly, as [`solve`](Self::solve) does, at each row to which no path leads. Rows found so may be on
    /// other branches than their neighbours.
    ///
    /// # Errors
    /// If the question is wrong.
    pub fn search_many(
        &self,
        names: &[String],
        values: &[f64],
        many: &mut Many,
        watch: &Watch,
    ) -> Result<(), AskError> {
        let asked = self.holding_names(names);
        let columns: Vec<Coordinate> = Coordinate::all(asked.mechanism()).collect();
        let (width, given) = (columns.len(), names.len());
        let lost = std::mem::take(&mut many.lost);
        let found = each(lost.len(), &(), |(), i| {
            let (row, why) = lost[i];
            if why == Unreached::NotFinite {
                return Ok(None);
            }
            let named = names.iter().zip(&values[row * given..]);
            let at_row = named.fold(asked.clone(), |asked, (name, value)| {
                asked.let_go(name).hold(name, *value)
            });
            let held = at_row.resolved()?.with_spins_still();
            match at_row.start(&held, watch) {
                Ok(at) => {
                    let mechanism = held.mechanism();
                    let values = columns.iter().map(|of| of.of(mechanism, &at));
                    Ok(Some(values.collect::<Vec<f64>>()))
                }
                Err(AskError::NotAssembled(_)) => Ok(None),
                Err(error) => Err(error),
            }
        });
        for ((row, why), found) in lost.into_iter().zip(found) {
            match (found?, why) {
                (Some(values), _) => {
                    many.values[row * width..(row + 1) * width].copy_from_slice(&values);
                    many.reached[row] = true;
                }
                (None, Unreached::NotFinite) => many.lost.push((row, why)),
                (None, _) => many.lost.push((row, Unreached::NotFound)),
            }
        }
        Ok(())
    }
}

/// Puts a configuration where the values of all its coordinates say.
fn place(mechanism: &Mechanism, values: &[f64], at: &mut Configuration<f64>) {
    let (joints, poses) = values.split_at(at.joints.len());
    at.joints.copy_from_slice(joints);
    let centre = Vector3(mechanism.dimensions().centre);
    for (platform, pose) in at.platforms.iter_mut().zip(poses.chunks_exact(6)) {
        let [x, y, z, roll, pitch, yaw] = [0, 1, 2, 3, 4, 5].map(|i| pose[i]);
        *platform = PlatformPose {
            orientation: RollPitchYaw { roll, pitch, yaw }.quaternion(),
            position: Vector3([x, y, z]) - centre,
        };
    }
}
