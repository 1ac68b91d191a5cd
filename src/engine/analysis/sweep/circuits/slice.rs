//! A place on every circuit, by following complex configurations.
//!
//! At one value of a joint all configurations are known, real and complex. Followed along the real values of the joint,
//! a conjugate pair becomes real where a circuit begins, that is where the joint turns back on it, and the real
//! configurations become such a pair where it ends. So circuits that do not reach the value are met by the pairs, and
//! those hidden behind others by the pairs that leave these.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::pairs::{ARRIVED, PairEnd, PairPaths};
use super::tracing::Tracing;
use crate::algebra::SiUnit;
use crate::linear::norm;
use crate::mechanism::{Configuration, turn_near};
use crate::number::sorting::sort_by;
use crate::number::tolerance::SAME;
use crate::number::{C, Number};
use crate::solve::{Continuation, Watch};
use crate::system::{ComplexCurve, Held};

/// All assembled configurations at one value of a joint, real and complex.
#[derive(Clone, Debug, PartialEq)]
pub struct Slice {
    /// The joint.
    pub joint: usize,
    /// Its value, rad or m.
    pub value: f64,
    /// The distance to which they are followed on either side, if the joint does not come back to it: rad or m.
    pub reach: f64,
    /// The real ones.
    pub real: Vec<Configuration<f64>>,
    /// The others.
    pub complex: Vec<Configuration<C>>,
    /// True if the search for them ended with no sign that one was missed.
    pub whole: bool,
    /// Freedoms left to some of them, which are infinitely many and on no circuit.
    pub freedoms: usize,
}

/// The search for circuits by following complex configurations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Swept {
    /// The joint along whose values complex configurations were followed.
    pub joint: String,
    /// rad or m.
    pub unit: SiUnit,
    /// The value at which all configurations were known.
    pub value: f64,
    /// Their number, real or complex.
    pub configurations: usize,
    /// The number of real ones.
    pub real: usize,
    /// The values between which they were followed; `None` if the joint came back to where it was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    /// Values beyond which other configurations had to be known, because there some go to infinity.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub poles: Vec<f64>,
    /// Values that no path covers, from one to another: next to poles with no configurations known beyond.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub gaps: Vec<[f64; 2]>,
    /// Paths that were lost, and dead points that none of them led to.
    pub lost: usize,
    /// Values of the joint near which they were lost, each once, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lost_at: Vec<f64>,
    /// Paths that took more steps than are made for them.
    #[serde(default, skip_serializing_if = "is_none")]
    pub given_up: usize,
    /// True if the search for the configurations may have missed some.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub doubtful: bool,
    /// Freedoms left to some of the configurations, which are infinitely many and on no circuit.
    #[serde(default, skip_serializing_if = "is_none")]
    pub freedoms: usize,
}

fn is_none(count: &usize) -> bool {
    *count == 0
}

impl Swept {
    fn lose(&mut self, value: f64) {
        self.lost += 1;
        self.lost_at.push(value);
    }

    /// True if every circuit on which the joint moves was met, provided that all configurations at the values were known.
    pub fn is_whole(&self) -> bool {
        self.lost + self.given_up == 0 && self.gaps.is_empty() && !self.doubtful
    }
}

/// Follows all curves that slices at values of one joint lead to.
pub(super) fn sweep(
    slices: &[Slice],
    held: &Held<f64>,
    tracing: &mut Tracing,
    watch: &Watch,
) -> Option<Swept> {
    let mechanism = tracing.mechanism;
    let slice = slices.first()?;
    let of = &mechanism.joints()[slice.joint];
    let cycle = mechanism.turns_to_repeat(slice.joint);
    let mut swept = Swept {
        joint: of.name.clone(),
        unit: SiUnit::of_coordinate(of.kind.is_angle()),
        value: slice.value,
        configurations: slice.real.len() + slice.complex.len(),
        real: slice.real.len(),
        range: (cycle.is_none()).then_some([slice.value - slice.reach, slice.value + slice.reach]),
        poles: Vec::new(),
        gaps: Vec::new(),
        lost: 0,
        lost_at: Vec::new(),
        given_up: 0,
        doubtful: !slices.iter().all(|slice| slice.whole),
        freedoms: (slices.iter())
            .map(|slice| slice.freedoms)
            .fold(0, usize::max),
    };
    // what they cover, as distances from the first
    let mut covered = Vec::new();
    let mut steps = 0;
    for of in slices {
        let went = from_one((of, held), tracing, &mut swept, &mut steps, watch);
        let Some([below, above]) = went else {
            swept.doubtful = true;
            continue;
        };
        for side in [below, above] {
            if side.abs() < paths_reach(of, cycle) {
                let pole = of.value + side;
                swept.poles.push(within_cycle(cycle, pole));
            }
        }
        let from = of.value - slice.value;
        covered.push([from + below, from + above]);
    }
    let reach = paths_reach(slice, cycle);
    swept.gaps = gaps(&covered, reach, cycle.is_some())
        .map(|gap| gap.map(|from| slice.value + from))
        .collect();
    sort_by(&mut swept.poles, f64::total_cmp);
    swept.poles.dedup_by(|a, b| (*a - *b).abs() < BESIDE_A_POLE);
    let lost_at = swept.lost_at.iter();
    swept.lost_at = lost_at.map(|at| within_cycle(cycle, *at)).collect();
    sort_by(&mut swept.lost_at, f64::total_cmp);
    swept.lost_at.dedup_by(|a, b| (*a - *b).abs() < ARRIVED);
    Some(swept)
}

/// A value of a joint, that nearest to 0 if it comes back.
fn within_cycle(cycle: Option<f64>, value: f64) -> f64 {
    cycle.map_or(value, |turns| turns * turn_near(value / turns, 0.0))
}

/// The distance to which a pair is followed on either side.
fn paths_reach(slice: &Slice, cycle: Option<f64>) -> f64 {
    cycle.map_or(slice.reach, |turns| turns * PI)
}

/// Next to a pole, on either side, what goes to infinity is complex.
const BESIDE_A_POLE: f64 = 0.02;

/// The parts that intervals leave uncovered between −reach and reach, which are the same place if that is a whole cycle.
fn gaps(covered: &[[f64; 2]], reach: f64, cycle: bool) -> impl Iterator<Item = [f64; 2]> {
    let shifts: &[f64] = if cycle { &[-2.0, 0.0, 2.0] } else { &[0.0] };
    let moved = |shift: &f64| {
        let by = shift * reach;
        covered.iter().map(move |[low, high]| [low + by, high + by])
    };
    let mut all: Vec<[f64; 2]> = shifts.iter().flat_map(moved).collect();
    sort_by(&mut all, |a, b| a[0].total_cmp(&b[0]));
    let mut gaps = Vec::new();
    let mut end = -reach;
    for [low, high] in all.into_iter().chain([[reach, reach]]) {
        if low.min(reach) > end + 2.0 * BESIDE_A_POLE {
            gaps.push([end, low.min(reach)]);
        }
        end = end.max(high);
    }
    gaps.into_iter()
}

/// Follows the curves that one slice leads to. Returns the distances below and above its value that all paths covered.
fn from_one(
    (slice, held): (&Slice, &Held<f64>),
    tracing: &mut Tracing,
    swept: &mut Swept,
    steps: &mut usize,
    watch: &Watch,
) -> Option<[f64; 2]> {
    let mechanism = tracing.mechanism;
    let cycle = mechanism.turns_to_repeat(slice.joint);
    slice.real.iter().for_each(|seed| tracing.take(seed));
    // of large mechanisms not all dead points are located
    if tracing.curve.system().is_large() {
        return None;
    }
    let complex = ComplexCurve::new(mechanism, held, slice.joint)?;
    let mut paths = PairPaths {
        // far from the real ones cosines and sines are large
        method: Continuation {
            tolerance: 1e-10,
            shortest: 1e-7,
            change: 0.5,
            ..tracing.method().clone()
        },
        value: slice.value,
        reach: paths_reach(slice, cycle),
        complex,
        crossings: Vec::new(),
        steps: *steps,
        watch,
    };
    let mut went = [-paths.reach, paths.reach];
    let mut waiting = Vec::new();
    let mut pairs: Vec<&Configuration<C>> = Vec::new();
    for at in &slice.complex {
        let conjugate = at.map(|z| z.conj());
        if (pairs.iter()).any(|known| paths.complex.apart(known, &conjugate) < SAME) {
            continue;
        }
        pairs.push(at);
        match paths.method.settle(&mut paths.complex, at.clone()) {
            Ok(place) => {
                for up in [false, true] {
                    waiting.push((paths.complex.going(place.clone(), up), up));
                }
            }
            // the value is beside a pole itself
            Err(_) if paths.is_far(at) => went = [0.0; 2],
            Err(_) => swept.lose(slice.value),
        }
    }
    // dead points that a path is to end at, and those that one did
    let (mut wanted, mut reached) = (Vec::new(), Vec::new());
    let mut lost = Vec::new();
    let mut seen = 0;
    loop {
        for found in &tracing.traced[seen..] {
            for (fold, greatest) in &found.folds {
                let from = fold.at.joints[slice.joint] - slice.value;
                let from = within_cycle(cycle, from);
                if from.abs() >= paths.reach {
                    continue;
                }
                if (from > 0.0) != *greatest {
                    wanted.push((from, fold.at.clone()));
                } else {
                    let mut at = fold.at.map(C::from_f64);
                    at.joints[slice.joint] = C::from_f64(slice.value + from);
                    match paths.leaving(&at, &fold.tangent, *greatest) {
                        Some(place) => waiting.push((place, *greatest)),
                        None => swept.lose(slice.value + from),
                    }
                }
            }
        }
        seen = tracing.traced.len();
        let Some((place, up)) = waiting.pop() else {
            break;
        };
        if watch.is_stopped() || tracing.is_exhausted() {
            swept.given_up += 1;
            break;
        }
        match paths.follow(&mut tracing.curve, place, (up, slice.joint)) {
            PairEnd::Real(at) => {
                tracing.take(&at);
                reached.push(at);
            }
            PairEnd::Through => {}
            PairEnd::Pole(at) => match up {
                true => went[1] = went[1].min(at - slice.value),
                false => went[0] = went[0].max(at - slice.value),
            },
            PairEnd::Crossing(places) => {
                waiting.extend(places.into_iter().map(|place| (place, up)))
            }
            PairEnd::Lost(at) => lost.push(at),
            PairEnd::GivenUp => swept.given_up += 1,
        }
    }
    *steps = paths.steps;
    // of the sets of angles of balls one is followed, and paths may end at another
    let one_set = |at: &Configuration<f64>| mechanism.sets_of_angles(at).len() == 1;
    let near = |a: &Configuration<f64>, b: &Configuration<f64>| {
        norm(&tracing.curve.difference_but_turns(a, b)) < ARRIVED
    };
    let within = |from: f64| from > went[0] && from < went[1];
    let missed = (wanted.iter()).filter(|(from, fold)| within(*from) && one_set(fold));
    for (from, fold) in missed.filter(|(_, fold)| !reached.iter().any(|at| near(fold, at))) {
        // a path that was lost just before the dead point is the one that ends there, as where freer configurations meet it
        let ends = |at: &Configuration<C>| {
            let (imaginary, beside) = paths.complex.split(at);
            imaginary < ARRIVED && near(fold, &beside)
        };
        match lost.iter().position(ends) {
            Some(path) => drop(lost.swap_remove(path)),
            None => swept.lose(slice.value + from),
        }
    }
    for at in lost {
        swept.lose(at.joints[slice.joint].re);
    }
    Some(went)
}
