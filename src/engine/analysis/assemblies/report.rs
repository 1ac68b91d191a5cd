//! The report on the assemblies of a mechanism.

use serde::{Deserialize, Serialize};

use crate::algebra::SiUnit;
use crate::geometry::{Quaternion, Vector3};
use crate::mechanism::{Configuration, Mechanism, PlatformPose};
use crate::number::Complex;
pub use crate::system::{ByName, Unfit};
use crate::system::{Gap, is_origin, uncut};

/// The pose of a platform in ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PoseReport {
    /// Position of its origin in m.
    pub position: [f64; 3],
    /// Unit quaternion, scalar first, its first component that is not zero positive.
    pub quaternion: [f64; 4],
    /// Roll, pitch and yaw in rad.
    pub roll_pitch_yaw: [f64; 3],
}

/// One assembled configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Assembly {
    /// Its number, from 1.
    pub mode: usize,
    /// Joint values in rad or m, those of joints at which loops are cut last. Angles lie in (−π, π], or are that and whole
    /// turns where the limits of the joint ask for it.
    pub joints: ByName<f64>,
    /// The joints at which loops are cut.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cut: Vec<String>,
    /// Platform poses.
    pub platforms: ByName<PoseReport>,
    /// Position in ground, in m, from which its [configuration](Assembly::configuration) measures positions: the origin
    /// unless the mechanism is far from it.
    #[serde(default, skip_serializing_if = "is_origin")]
    pub centre: [f64; 3],
    /// Quotient of the largest and the smallest singular value of the dimensionless closure
    /// Jacobian; `null` where the smallest is zero.
    pub condition: Option<f64>,
    /// Sign of the determinant of the closure Jacobian on its independent rows: assemblies of
    /// opposite signs lie on different sides of a singularity. 0 where solutions meet, and where the rows that are
    /// independent at most assemblies depend on one another.
    pub determinant_sign: i8,
    /// Number of solutions that meet here: 1, or 2 at a dead point; 0 for a sample of infinitely many. Where no paths
    /// are counted ([`Fit`]) it is the least number that the equations allow, and where freedoms are left anything
    /// above 1 says only that the assembly is singular.
    pub multiplicity: usize,
    /// The dimension of the set of assemblies that this one is a sample of; 0 if it is isolated.
    pub dimension: usize,
    /// True if an interval test has proved that a box of `radius` holds exactly one solution.
    pub certified: bool,
    /// Half the side of that box in the dimensionless unknowns, rad or characteristic lengths.
    pub radius: Option<f64>,
    /// Reason for which the assembly is not certified.
    pub uncertified_because: Option<String>,
    /// True if all joints are within their limits.
    pub within_limits: bool,
    /// Names of the joints that are not.
    pub outside_limits: Vec<String>,
    /// Numbers of the other assemblies in the same pose of all platforms.
    pub shares_platform_pose_with: Vec<usize>,
}

impl Assembly {
    /// The assembly as a configuration.
    pub fn configuration(&self) -> Configuration<f64> {
        let platforms = self.platforms.values().map(|platform| PlatformPose {
            orientation: Quaternion(platform.quaternion),
            position: Vector3(platform.position) - Vector3(self.centre),
        });
        Configuration {
            joints: uncut(&self.joints, &self.cut),
            platforms: platforms.collect(),
        }
    }
}

/// Closest approach to assembly of a mechanism that cannot be assembled.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClosestApproach {
    /// The gap of each closure.
    pub gaps: ByName<Gap>,
    /// The closure with the largest gap.
    pub worst: String,
    /// True if no small motion comes closer.
    pub local_minimum: bool,
    /// True if rods count by (d² − L²)/2 over the square of the characteristic length, d being the distance of their
    /// ends and L their length, so that the configuration is not the one where Σ (d − L)² is least.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub squared_lengths: bool,
    /// Joint values there, rad or m.
    pub joints: ByName<f64>,
    /// Platform poses there.
    pub platforms: ByName<PoseReport>,
}

/// Number of held inputs compared with the freedoms of the mechanism.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Fit {
    /// As many inputs are held as the mechanism has freedoms: a finite number of assemblies.
    #[default]
    Finite,
    /// Freedoms left, so many; the assemblies listed are samples.
    FreedomLeft(usize),
    /// No generic solution was found, perhaps because more inputs are held than can be chosen
    /// freely; what is listed was found by starting from many guesses and need not be complete.
    TooManyHeld,
    /// Infinitely many generic solutions, as where a screw, or a gear whose ratio is no fraction, never comes
    /// back to the same place. The assemblies listed were found by starting from guesses.
    Endless,
    /// All generic solutions that were met are multiple, as in a shaky structure. No path follows
    /// them; what is listed was found by starting from many guesses and need not be complete.
    AlwaysMultiple,
}

/// Assemblies that are connected, infinitely many, at the target inputs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Continuum {
    /// Number of coordinates that can be chosen freely on it.
    pub dimension: usize,
    /// Paths that end on it.
    pub paths: usize,
    /// Numbers of the assemblies that are samples of it. Sets of the same dimension are not
    /// distinguished. None if only complex points of it were met.
    pub samples: Vec<usize>,
}

/// A joint of the list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ListedJoint {
    /// Its name.
    pub name: String,
    /// The unit of its values, rad or m.
    pub unit: SiUnit,
    /// True if its value was given.
    pub held: bool,
    /// True if its values repeat with every turn, without limits that distinguish turns.
    pub periodic: bool,
    /// True if its value is to be found and no number of turns leads back to the same place: it travels as it turns, or
    /// turns something by a ratio that is no fraction.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub winding: bool,
}

/// The search for the solutions of a generic member.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GenericSearch {
    /// The random seed.
    pub seed: u64,
    /// Newton seeds tried at the generic member.
    pub seeds: usize,
    /// Seeds since the last discovery.
    pub quiet_seeds: usize,
    /// Seeds that met a solution which is multiple for all inputs. No path follows such a solution;
    /// they are sought from many starts.
    pub multiple: usize,
    /// Independent monodromy loops through generic members, each followed by every solution known.
    pub loops: usize,
    /// Those on which no path was lost, or of 200 and more along each edge at most a quarter: they lead from what was found
    /// to nothing else.
    pub quiet_loops: usize,
    /// The most paths lost along one of their edges. If it is not 0, a solution whose path each of them lost may be missing.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub lost_in_loops: usize,
    /// True if the trace test (Leykin, Rodriguez and Sottile 2018, in double precision) holds for the length of one rod
    /// with all points of its cut: no isolated solution is missing but such of which the joint that makes the cut does
    /// not turn with that length. It is run where no known bound is reached.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub traced: bool,
    /// True if the trace test failed at each member that was searched: solutions are missing, or points of the cut.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub refuted: bool,
    /// True if the search varied dimensions with the relations between them that parameters and expressions of the file
    /// make: with other numbers of equations than of unknowns the mechanism may need them. Otherwise each is a number of its
    /// own.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub related: bool,
    /// For a platform on six rods: how many of the 40 poses of a general one, whose paths lead to all of its isolated poses, go
    /// to infinity for generic inputs. Then nothing is searched.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub general: Option<usize>,
    /// True if the search ended at its limits and not because nothing more was found.
    pub exhausted: bool,
}

/// All assemblies for the target inputs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AssembliesReport {
    /// Name of the mechanism.
    pub mechanism: String,
    /// The joints, in the order of the file, those at which loops are cut last.
    pub variables: Vec<ListedJoint>,
    /// Names of the platforms whose whole pose is held.
    pub held_platforms: Vec<String>,
    /// The length by which lengths are divided where angles and lengths are compared, in m.
    pub characteristic_length: f64,
    /// The real assemblies in the order of their numbers.
    pub assemblies: Vec<Assembly>,
    /// The numbers of the assemblies in each pose of all platforms together, poses in the order of
    /// their first assemblies; empty if no pose of a platform is to be found.
    #[serde(default)]
    pub poses: Vec<Vec<usize>>,
    /// The numbers of the assemblies in each position of the bodies, which is one for the two sets of angles that a ball
    /// written as three rows has for each of its orientations, and for all spins of links about their own lines; empty if
    /// there are no such sets.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub positions: Vec<Vec<usize>>,
    /// Complex assemblies that are not real, if they were asked for: unknown joints and platforms
    /// as pairs of real and imaginary part.
    pub complex_assemblies: Vec<ComplexAssembly>,
    /// Finite complex solutions, counted with multiplicity, the real ones among them.
    pub complex: usize,
    /// Real assemblies listed: those that are isolated, each once, and samples of sets.
    pub real: usize,
    /// Solutions of the generic member that go to infinity for these inputs, or beyond 1000
    /// characteristic lengths: so far out, rounding of the dimensions decides where they are.
    pub at_infinity: usize,
    /// Isolated points where solutions meet, real or complex, each once.
    pub singular: usize,
    /// Paths that end where roll or yaw of a platform is half a turn from the held value,
    /// or is not determined because its pitch is ±90°: the equations of a single angle cannot leave
    /// these out. They are not among the complex solutions.
    pub half_a_turn_away: usize,
    /// Paths that end on a set of infinitely many solutions.
    pub not_isolated: usize,
    /// Sets of infinitely many solutions by dimension, the largest first; empty if all assemblies are isolated.
    pub continua: Vec<Continuum>,
    /// Isolated real assemblies that were found from other starts and to which no path led.
    /// Anything but 0 means that the list may be incomplete.
    pub unexpected: usize,
    /// Paths whose end could not be decided. Anything but 0 means that the list may be incomplete.
    pub lost: usize,
    /// Complex solutions to which no path led, but one to their conjugates, which for real inputs are
    /// solutions too. Anything but 0 means that the search missed some, and the list may be
    /// incomplete.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub conjugates: usize,
    /// Paths that had to be followed again with greater care.
    pub retried: usize,
    /// Paths followed: as many as generic solutions, or fewer where legs close apart from one
    /// another and the other solutions are combinations of their ways.
    pub paths: usize,
    /// Steps along all paths, the last time each was followed.
    pub steps: usize,
    /// Isolated complex solutions of the generic member.
    pub generic: usize,
    /// The largest number of isolated complex solutions that the structure is known to have.
    pub bound: Option<usize>,
    /// The structure with the source of the bound.
    pub bound_source: Option<String>,
    /// Number of ways in which universal joints stand in each pose, where their legs were left out of the search.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flips: Option<usize>,
    /// Number of held inputs compared with the freedoms of the mechanism.
    pub fit: Fit,
    /// The search for the solutions of the generic member.
    #[serde(flatten)]
    pub search: GenericSearch,
    /// Number of the closure rows that certificates and determinants use, and of all; `None` if all are used.
    pub independent_rows: Option<(usize, usize)>,
    /// Closest approach to assembly, if there is no real assembly.
    pub closest: Option<ClosestApproach>,
    /// Result of branch and prune over boxes on all real assemblies, if it was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub proof: Option<Proof>,
    /// True if the work was stopped early: assemblies may be missing.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub interrupted: bool,
}

/// The values from `low` to `high` of a joint or of a coordinate of a platform.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Range {
    /// Its name.
    pub name: String,
    /// The unit of the values, rad or m.
    pub unit: SiUnit,
    /// The lowest.
    pub low: f64,
    /// The highest.
    pub high: f64,
}

/// A part of the region that a proof covers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Part {
    /// The joints that distinguish assemblies, with their values in it.
    pub ranges: Vec<Range>,
    /// Numbers of the listed assemblies in it.
    pub modes: Vec<usize>,
}

/// Result of interval branch and prune on all real assemblies: over every angle, and the `ranges` of everything else.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Proof {
    /// Reason for which nothing was proved.
    pub unfit: Option<Unfit>,
    /// Number of joint variables that distinguish assemblies.
    pub unknowns: usize,
    /// Boxes examined.
    pub boxes: usize,
    /// Boxes that were not, when the number allowed was reached or the search was stopped.
    pub waiting: usize,
    /// True if it ended because ever more boxes too small to be halved are left, as about a set of infinitely many
    /// solutions.
    #[serde(default)]
    pub crowded: bool,
    /// Ranges covered of joints that may go beyond them: the limits of those that do not come back to the same place.
    pub ranges: Vec<Range>,
    /// Joints without limits, for which no bound follows from the lengths: searched within 1000 characteristic lengths.
    pub unbounded: Vec<String>,
    /// Numbers of the listed assemblies outside of these ranges, of which nothing is proved.
    pub outside: Vec<usize>,
    /// Parts in which assemblies were neither excluded nor shown to be one that is listed.
    pub left: Vec<Part>,
    /// Parts that hold an assembly which is not listed.
    pub missing: Vec<Part>,
    /// Numbers of listed assemblies that were excluded: the program contradicts itself.
    pub excluded: Vec<usize>,
}

impl Proof {
    /// True if no real assembly is missing.
    pub fn is_complete(&self) -> bool {
        let parts = self.left.is_empty() && self.missing.is_empty() && self.excluded.is_empty();
        self.unfit.is_none() && self.waiting == 0 && parts
    }
}

/// A complex solution that is not real.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComplexAssembly {
    /// Joint values as (real, imaginary), rad or m.
    pub joints: ByName<[f64; 2]>,
    /// Positions (3, m) and quaternions (4) of the platforms.
    pub platforms: ByName<Vec<[f64; 2]>>,
    /// Number of solutions that meet here.
    pub multiplicity: usize,
    /// Quotient of the largest and the smallest singular value of the dimensionless closure
    /// Jacobian; `null` where solutions meet.
    pub condition: Option<f64>,
}

impl ComplexAssembly {
    /// The assembly as a configuration of the mechanism.
    pub fn configuration(&self, mechanism: &Mechanism) -> Configuration<Complex<f64>> {
        let number = |[re, im]: [f64; 2]| Complex::new(re, im);
        let platforms = self.platforms.values().map(|parts| PlatformPose {
            position: mechanism.to_centre(Vector3([0, 1, 2].map(|i| number(parts[i])))),
            orientation: Quaternion(std::array::from_fn(|i| number(parts[3 + i]))),
        });
        Configuration {
            joints: self.joints.values().map(|x| number(*x)).collect(),
            platforms: platforms.collect(),
        }
    }
}

impl AssembliesReport {
    /// True if an isolated assembly may be missing.
    pub fn may_lack_some(&self) -> bool {
        match &self.proof {
            Some(proof) if !proof.is_complete() => return true,
            Some(proof) if proof.ranges.is_empty() => return false,
            _ => {}
        }
        // with a freedom left, multiple solutions are where the sets of solutions cross
        let unsure = self.search.multiple > 0 || self.search.lost_in_loops > 0;
        let incomplete = unsure || self.search.exhausted || self.search.refuted;
        let doubted = self.fit == Fit::Finite && incomplete;
        let missed = self.lost + self.unexpected + self.conjugates > 0;
        let listed = matches!(self.fit, Fit::Finite | Fit::FreedomLeft(_));
        self.interrupted || !listed || doubted || missed
    }
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}
