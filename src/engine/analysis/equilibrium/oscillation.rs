//! Stability of a rest position, small oscillations about it and stiffness.

use std::f64::consts::TAU;

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::{NoRest, RestPosition, descent};
use crate::linear::add;
use crate::mechanism::{Configuration, Mechanism, turn_near};
use crate::system::{ByName, Dynamics, PlatformRecord};

/// Stability of a rest position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Stability {
    /// The energy is least.
    Stable,
    /// It falls in so many independent directions.
    Unstable {
        /// Number of directions.
        directions: usize,
    },
    /// To second order the energy does not change in so many directions.
    Undecided {
        /// Number of directions.
        directions: usize,
    },
}

/// A small oscillation, or the departure from an unstable position.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NaturalMode {
    /// Its frequency without damping, in Hz; `None` if the position is left.
    pub frequency: Option<f64>,
    /// The rate σ of a departure eᵟᵗ, in 1/s.
    pub departure: Option<f64>,
    /// Amplitudes of the joints, in rad and m, for the largest of all dimensionless amplitudes one.
    pub shape: ByName<f64>,
    /// Assembled configurations from one end of it to the other, the rest position in the middle, where the largest of all
    /// dimensionless amplitudes is 0.2.
    #[serde(skip)]
    pub swing: Vec<Configuration<f64>>,
}

/// Compliance and stiffness of a platform about its origin along the axes of ground: displacement and turn for force and
/// moment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Stiffness {
    /// The platform.
    pub name: String,
    /// Compliance: rows x, y, z (m), then the turns (rad), for Fx, Fy, Fz (N), Mx, My, Mz (N·m).
    pub compliance: [[f64; 6]; 6],
    /// Its inverse, in N, N·m, m and rad, where the platform has six freedoms.
    pub stiffness: Option<[[f64; 6]; 6]>,
}

/// The rest position at which the dynamics stand.
pub(super) fn position(
    mechanism: &Mechanism,
    dynamics: &mut Dynamics,
) -> Result<RestPosition, NoRest> {
    let hessian = descent::hessian(dynamics)?;
    let mass = dynamics.mass().ok_or(NoRest::Singular)?;
    let (forces, potential) = dynamics.at_rest()?;
    let units = dynamics.units();
    let free = units.len();
    let left = forces.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let scaled = DMatrix::from_fn(free, free, |i, j| {
        hessian[i * free + j] * units[i] * units[j]
    });
    let curvatures = scaled.symmetric_eigenvalues();
    // a smaller curvature is rounding of the forces that act
    let flat = 1e-8 * dynamics.size();
    let below = curvatures.iter().filter(|x| **x < -flat).count();
    let level = curvatures.iter().filter(|x| x.abs() <= flat).count();
    let stability = match (below, level) {
        (0, 0) => Stability::Stable,
        (0, directions) => Stability::Undecided { directions },
        (directions, _) => Stability::Unstable { directions },
    };
    let modes = modes(mechanism, dynamics, (&hessian, &mass), flat);
    let at = dynamics.configuration();
    let platforms = mechanism.platforms().iter().enumerate();
    let platforms = platforms.map(|(i, platform)| {
        let pose = mechanism.in_ground(&at.platforms[i]);
        (platform.name.clone(), PlatformRecord::of(&pose))
    });
    Ok(RestPosition {
        place: Some(at.clone()),
        joints: mechanism.named_joints(&turned(mechanism, &at.joints)),
        platforms: platforms.collect(),
        potential,
        left,
        stability,
        modes,
        stiffness: match stability {
            Stability::Stable => stiffness(mechanism, dynamics, &hessian),
            _ => Vec::new(),
        },
        outside_limits: (mechanism.outside_limits(&at.joints))
            .map(|joint| mechanism.joints()[joint].name.clone())
            .collect(),
    })
}

/// Joints turned back by whole turns that change nothing, to beside their home.
fn turned(mechanism: &Mechanism, joints: &[f64]) -> Vec<f64> {
    let joints = mechanism.joints().iter().zip(joints).enumerate();
    let turned = joints.map(|(i, (joint, value))| match mechanism.turns_to_repeat(i) {
        Some(turns) => joint.home + turns * turn_near((value - joint.home) / turns, 0.0),
        None => *value,
    });
    turned.collect()
}

/// Solutions of H·v = ω²·M·v, slowest first; none where some motion moves no mass. Of a motion that changes the energy by
/// no more than `flat` for its largest dimensionless amplitude ω is 0.
fn modes(
    mechanism: &Mechanism,
    dynamics: &mut Dynamics,
    (hessian, mass): (&[f64], &[f64]),
    flat: f64,
) -> Vec<NaturalMode> {
    let units = dynamics.units();
    let free = units.len();
    let mass = DMatrix::from_row_slice(free, free, mass);
    let Some(factor) = mass.cholesky() else {
        return Vec::new();
    };
    let Some(inverse) = factor.l().try_inverse() else {
        return Vec::new();
    };
    let hessian = DMatrix::from_row_slice(free, free, hessian);
    let eigen = (&inverse * hessian * inverse.transpose()).symmetric_eigen();
    let mut order: Vec<usize> = (0..free).collect();
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    let base = dynamics.values(dynamics.base());
    let mode = |i: usize| {
        let amplitudes = inverse.transpose() * eigen.eigenvectors.column(i);
        let sizes = amplitudes
            .iter()
            .zip(&units)
            .map(|(x, unit)| (x / unit).abs());
        let largest = sizes.fold(0.0, f64::max);
        // amplitudes have M-norm one, so that ω² is the change of the energy
        let square = match eigen.eigenvalues[i] {
            square if square.abs() <= flat * largest * largest => 0.0,
            square => square,
        };
        let (all, far) = spread(dynamics, amplitudes.as_slice());
        NaturalMode {
            frequency: (square >= 0.0).then(|| square.sqrt() / TAU),
            departure: (square < 0.0).then(|| (-square).sqrt()),
            shape: shape(mechanism, &all, far),
            swing: swing(dynamics, &base, amplitudes.as_slice(), far),
        }
    };
    let modes = order.into_iter().map(mode).collect();
    dynamics.close(&base);
    modes
}

/// Configurations of an oscillation, from end to end, 0.2 rad or characteristic lengths to either side.
fn swing(
    dynamics: &mut Dynamics,
    base: &[f64],
    amplitudes: &[f64],
    far: f64,
) -> Vec<Configuration<f64>> {
    let place = |k: i32| {
        let mut to = base.to_vec();
        add(&mut to, 0.2 * f64::from(k) / (4.0 * far), amplitudes);
        (dynamics.close(&to)).then(|| dynamics.configuration().clone())
    };
    (-4..=4).filter_map(place).collect()
}

/// Amplitudes of all unknowns for those of the independent coordinates, and the largest.
fn spread(dynamics: &Dynamics, amplitudes: &[f64]) -> (Vec<f64>, f64) {
    let unknowns = dynamics.responses().first().map_or(0, Vec::len);
    let mut all = vec![0.0; unknowns];
    for (response, amplitude) in dynamics.responses().iter().zip(amplitudes) {
        add(&mut all, *amplitude, response);
    }
    // of two signs that in which the largest moves up
    let largest = all.iter().fold(
        0.0,
        |most: f64, x| if x.abs() > most.abs() { *x } else { most },
    );
    (all, largest)
}

/// Amplitudes of the joints, that of the largest of all unknowns one.
fn shape(mechanism: &Mechanism, all: &[f64], largest: f64) -> ByName<f64> {
    let scales = &mechanism.dimensions().joint_scales;
    let joints = mechanism.joints().iter().zip(scales).zip(all);
    joints
        .map(|((joint, scale), x)| (joint.name.clone(), x * scale / largest))
        .collect()
}

/// C = T·H⁻¹·Tᵀ with the twists T of each platform for unit rates of the independent coordinates.
fn stiffness(mechanism: &Mechanism, dynamics: &Dynamics, hessian: &[f64]) -> Vec<Stiffness> {
    let free = dynamics.units().len();
    let Some(inverse) = DMatrix::from_row_slice(free, free, hessian).try_inverse() else {
        return Vec::new();
    };
    let (joints, length) = (mechanism.joints().len(), mechanism.characteristic_length());
    let platforms = mechanism.platforms().iter().enumerate();
    let of = platforms.map(|(platform, named)| {
        let twist = |row: usize, response: &Vec<f64>| {
            let first = joints + 6 * platform;
            match row {
                0..3 => response[first + 3 + row] * length,
                _ => response[first + row - 3],
            }
        };
        let twists = DMatrix::from_fn(6, free, |row, i| twist(row, &dynamics.responses()[i]));
        let compliance = &twists * &inverse * twists.transpose();
        let square =
            |of: &DMatrix<f64>| std::array::from_fn(|i| std::array::from_fn(|j| of[(i, j)]));
        let stiff = (free == 6)
            .then(|| compliance.clone().try_inverse())
            .flatten();
        Stiffness {
            name: named.name.clone(),
            compliance: square(&compliance),
            stiffness: stiff.map(|of| square(&of)),
        }
    });
    of.collect()
}
