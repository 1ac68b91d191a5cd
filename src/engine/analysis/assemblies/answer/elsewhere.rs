//! Assemblies at the target inputs to which no path leads, and samples of sets of them.

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::super::Wanted;
use super::{Found, Gathered, Starts, TargetProblem};
use crate::analysis::assemblies::family::{C, size};
use crate::analysis::assemblies::report::Fit;
use crate::analysis::assemblies::search::GenericSolutions;
use crate::analysis::assemblies::track::{END, Local, ParameterHomotopy};
use crate::mechanism::Configuration;
use crate::number::tolerance::CANCELLED;
use crate::solve::{Homotopy, Newton};
use crate::system::{Cone, Neighbourhood, SET_STEP, independent_parts};

/// Starts from which what no path leads to is sought at every question, and where there is a reason
/// to expect it.
const STARTS: usize = 40;
const MANY_STARTS: usize = 400;
/// Samples of a set of one dimension.
const SAMPLES: usize = 6;

impl TargetProblem<'_> {
    /// True if Newton's method may have ended at a point on its way to a known assembly: the closures
    /// hardly differ between the two.
    fn is_at(&self, x: &[C], found: &Found, homotopy: &mut ParameterHomotopy<'_>) -> bool {
        let y = self.coordinates.flat(&found.point);
        // within 0.3 rad or characteristic lengths
        self.coordinates.within(0.3, x, &y)
            && homotopy.seen_apart(END, &y, x) <= 10.0 * Newton::default().tolerance
    }

    /// Adds what Newton's method finds at the target inputs itself.
    pub(crate) fn look_elsewhere(
        &self,
        gathered: &mut Gathered,
        (fit, generic, wanted): (&Fit, &GenericSolutions, Wanted),
        homotopy: &mut ParameterHomotopy<'_>,
        starts: &Starts<'_>,
    ) {
        let multiple =
            matches!(fit, Fit::TooManyHeld | Fit::AlwaysMultiple) || generic.search.multiple > 0;
        let many = multiple && *fit != Fit::Endless;
        let expected = many || *fit != Fit::Finite;
        if expected || wanted.starts {
            let count = if many { MANY_STARTS } else { STARTS };
            self.add(gathered, starts(count), homotopy, (fit, expected));
        }
    }

    /// A real solution beside a complex point.
    pub(crate) fn real_near(
        &self,
        x: &[C],
        homotopy: &mut ParameterHomotopy<'_>,
    ) -> Option<Configuration<f64>> {
        let start = self.coordinates.real_part(x, self.asked);
        let start = self.coordinates.flat(&start);
        let is_finite = start.iter().all(|z| z.re.is_finite());
        let x = Local::new(homotopy, true).settled(is_finite.then_some(start)?)?;
        Some(self.coordinates.placed(&x, self.asked).map(|z| z.re))
    }

    /// The dimension of the set of real solutions through a singular one, where fewer dimensions were
    /// `spanned` than there are null vectors and second order decides how many it has.
    ///
    /// Equations that only touch zero, as those of rods stretched straight, leave of many complex solutions
    /// few that are real, to which steps from beside them lead too slowly to be spanned.
    fn touching(&self, x: &[C], spanned: usize) -> Option<usize> {
        let point = self.coordinates.placed(x, self.asked).map(|z| z.re);
        let mut near = Neighbourhood::holding(self.mechanism, self.held);
        let mut tangent = near.tangent(point);
        // links that spin are assemblies of their own unless they are held
        tangent.motions.append(&mut tangent.idle);
        if tangent.motions.len() == spanned {
            return None;
        }
        let rng = &mut Pcg64Mcg::seed_from_u64(1);
        let parts = independent_parts(self.mechanism, near.system().unknowns());
        let dimensions = parts.iter().map(|own| {
            let part = tangent.within(own);
            if part.motions.is_empty() || near.is_regular(&part.at, own) {
                return Some(part.motions.len());
            }
            let cone = Cone::of(&mut near, &part);
            Some(cone.set(&mut near, &part, SET_STEP, rng)?.motions.len())
        });
        dimensions.sum()
    }

    /// Adds solved points: by themselves, or as samples of a set.
    pub(crate) fn add(
        &self,
        gathered: &mut Gathered,
        points: Vec<Configuration<f64>>,
        homotopy: &mut ParameterHomotopy<'_>,
        (fit, expected): (&Fit, bool),
    ) {
        let mut work = self.system.work();
        for point in points {
            let x = self.coordinates.flat(&point);
            let samples: Vec<&Found> = gathered.found.iter().filter(|f| f.dimension > 0).collect();
            if *fit != Fit::Finite && samples.len() >= SAMPLES {
                break;
            }
            let apart = |f: &Found, x: &[C]| {
                self.coordinates
                    .difference(x, &self.coordinates.flat(&f.point))
            };
            let is_known = |x: &[C], homotopy: &mut ParameterHomotopy<'_>| {
                (gathered.found.iter()).any(|f| f.dimension == 0 && self.is_at(x, f, homotopy))
            };
            if is_known(&x, homotopy) {
                continue;
            }
            let mut local = Local::new(homotopy, true);
            let regular = local.regular(&x);
            let order_of = regular.map_or_else(|| local.order(&x), |_| 1);
            let spanned = local.dimension(&x);
            let (x, dimension) = match (regular, order_of) {
                (Some(dimension), _) => (x, dimension),
                (None, 1) => (x, 0),
                (None, _) => {
                    let refined = local.refined(&x);
                    // beside solutions that nearly meet it leads to where they would
                    let most = homotopy.residual(END, &x).max(CANCELLED * (1.0 + size(&x)));
                    let refined = match homotopy.residual(END, &refined) <= most {
                        true => refined,
                        false => x.clone(),
                    };
                    match self.touching(&refined, spanned) {
                        Some(dimension) => (refined, dimension),
                        None if spanned == 0 => (refined, 0),
                        None => (x, spanned),
                    }
                }
            };
            let multiplicity = if dimension == 0 { order_of } else { 0 };
            // where solutions meet, no more than rounding is left. What Newton's method calls solved may
            // be beside a set of solutions of other inputs, a hair from these
            let left = homotopy.residual(END, &x);
            if !expected && multiplicity > 1 && left > CANCELLED * (1.0 + size(&x)) {
                continue;
            }
            let alike = samples.iter().filter(|f| f.dimension == dimension);
            // samples of a set lie apart
            let enough = dimension > 0
                && (alike.clone().count() >= SAMPLES || alike.clone().any(|f| apart(f, &x) < 1e-3));
            if enough || is_known(&x, homotopy) {
                continue;
            }
            let Some(point) = self.real(&x, multiplicity != 1, &mut work) else {
                continue;
            };
            gathered.multiple += usize::from(multiplicity > 1);
            gathered.unexpected += usize::from(dimension == 0 && !expected);
            gathered.found.push(Found::new(
                self.coordinates,
                point,
                (multiplicity, dimension),
            ));
        }
    }
}
