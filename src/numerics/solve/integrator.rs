//! Initial value problems ẏ = f(t, y), step by step, with dense output.

use crate::number::tolerance::CANCELLED;
use std::cell::RefCell;

use differential_equations::interpolate::Interpolation;
use differential_equations::linalg::Matrix;
use differential_equations::methods::{
    DormandPrince, ExplicitRungeKutta, ImplicitRungeKutta, Ordinary, Radau,
};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};

/// The right-hand side of ẏ = f(t, y).
pub trait Flow {
    /// Writes ẏ; false where it has no value: the step is then tried again, shorter.
    fn rates(&mut self, time: f64, state: &[f64], rates: &mut [f64]) -> bool;
}

/// Integrates by the explicit method of order 8 of Dormand and Prince (DOP853), and once that finds the problem stiff by
/// the implicit one of order 5 (Radau IIA), both with dense output.
///
/// Source: Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations (1993, 1996), II.5 and IV.8.
pub struct Integrator {
    method: Box<dyn Method>,
    stiff: bool,
    tolerance: f64,
    /// The next step; 0 lets the method choose.
    step: f64,
    end: f64,
    /// Steps made, a state's change along which f changes most, and how often in a row that limited the step.
    steps: usize,
    steepest: Phase,
    limited: usize,
}

type Phase = Vec<f64>;

/// A method that keeps its last step.
trait Method {
    fn begin(&mut self, flow: &SharedFlow, span: [f64; 2], state: &Phase) -> Result<(), TooShort>;
    /// One attempt of a step; returns the length of the next one.
    fn advance(&mut self, flow: &SharedFlow, end: f64) -> Result<f64, TooShort>;
    fn time(&self) -> f64;
    fn state(&self) -> &[f64];
    fn within(&mut self, time: f64) -> Option<Phase>;
    /// Time and state before the last step.
    fn before(&self) -> (f64, &[f64]);
}

/// A method over states of N numbers, of which the first are used: the implicit one needs their number at compilation.
struct Over<M, const N: usize> {
    method: M,
    size: usize,
}

impl<M, const N: usize> Method for Over<M, N>
where
    M: OrdinaryNumericalMethod<f64, [f64; N]> + Interpolation<f64, [f64; N]>,
{
    fn begin(
        &mut self,
        flow: &SharedFlow,
        [from, to]: [f64; 2],
        state: &Phase,
    ) -> Result<(), TooShort> {
        let mut filled = [0.0; N];
        filled[..self.size].copy_from_slice(state);
        let begun = self
            .method
            .init(&FilledState::<N>(flow, self.size), from, to, &filled);
        begun.map(drop).map_err(|_| TooShort)
    }

    fn advance(&mut self, flow: &SharedFlow, end: f64) -> Result<f64, TooShort> {
        advance(&mut self.method, &FilledState::<N>(flow, self.size), end)
    }

    fn time(&self) -> f64 {
        self.method.t()
    }

    fn state(&self) -> &[f64] {
        &self.method.y()[..self.size]
    }

    fn within(&mut self, time: f64) -> Option<Phase> {
        let found = self.method.interpolate(time).ok()?;
        Some(found[..self.size].to_vec())
    }

    fn before(&self) -> (f64, &[f64]) {
        (self.method.t_prev(), &self.method.y_prev()[..self.size])
    }
}

struct Any<M>(M);

impl<M: OrdinaryNumericalMethod<f64, Phase> + Interpolation<f64, Phase>> Method for Any<M> {
    fn begin(
        &mut self,
        flow: &SharedFlow,
        [from, to]: [f64; 2],
        state: &Phase,
    ) -> Result<(), TooShort> {
        self.0
            .init(flow, from, to, state)
            .map(drop)
            .map_err(|_| TooShort)
    }

    fn advance(&mut self, flow: &SharedFlow, end: f64) -> Result<f64, TooShort> {
        advance(&mut self.0, flow, end)
    }

    fn time(&self) -> f64 {
        self.0.t()
    }

    fn state(&self) -> &[f64] {
        self.0.y()
    }

    fn within(&mut self, time: f64) -> Option<Phase> {
        self.0.interpolate(time).ok()
    }

    fn before(&self) -> (f64, &[f64]) {
        (self.0.t_prev(), self.0.y_prev())
    }
}

fn advance<Y: differential_equations::traits::State<f64>>(
    method: &mut impl OrdinaryNumericalMethod<f64, Y>,
    flow: &impl ODE<f64, Y>,
    end: f64,
) -> Result<f64, TooShort> {
    let (time, wanted) = (method.t(), method.h());
    if wanted.is_nan() || wanted <= CANCELLED * end.abs() {
        return Err(TooShort);
    }
    let last = wanted >= end - time;
    method.set_h(if last { end - time } else { rounded(wanted) });
    method.step(flow).map_err(|_| TooShort)?;
    // a step cut short by the end tells nothing of the next
    let cut = last && method.t() > time;
    Ok(if cut { wanted } else { method.h() })
}

/// The step can be made no shorter, and the error is still too large or f has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooShort;

/// Steps are rounded to 2⁻²⁰ of themselves: the methods choose them by powers, whose last digit depends on the
/// platform.
fn rounded(step: f64) -> f64 {
    f64::from_bits(step.to_bits() & !0xffff_ffff)
}

impl Integrator {
    /// Integrates to an end time with this error per step, relative and absolute.
    pub fn new(tolerance: f64, end: f64) -> Self {
        Integrator {
            method: explicit(tolerance, 0.0, 0),
            stiff: false,
            tolerance,
            step: 0.0,
            end,
            steps: 0,
            steepest: Vec::new(),
            limited: 0,
        }
    }

    /// Begins, or goes on, at a time and state.
    pub fn start(&mut self, flow: &mut dyn Flow, time: f64, state: &[f64]) -> Result<(), TooShort> {
        // the methods refuse an interval without length
        if time >= self.end {
            return Ok(());
        }
        let method = if self.stiff { implicit } else { explicit };
        // and a first step beyond the end
        let first = self.step.min(self.end - time);
        self.method = method(self.tolerance, first, state.len());
        (self.method).begin(&SharedFlow::of(flow), [time, self.end], &state.to_vec())
    }

    /// Makes one step, not beyond the end; returns the time reached.
    pub fn step(&mut self, flow: &mut dyn Flow) -> Result<f64, TooShort> {
        let before = self.time();
        if self.is_limited_by_stability(flow) {
            self.stiff = true;
            let state = self.state().to_vec();
            self.start(flow, before, &state)?;
        }
        while self.time() == before && before < self.end {
            self.step = self.method.advance(&SharedFlow::of(&mut *flow), self.end)?;
        }
        self.steps += 1;
        Ok(self.time())
    }

    /// True if stability rather than accuracy limits the steps of the explicit method: |h λ| of the dominant eigenvalue λ
    /// of ∂f/∂y, by one iteration of the power method at a time, is larger than 1.5, to which accuracy keeps it; its domain of
    /// stability ends near 6.
    fn is_limited_by_stability(&mut self, flow: &mut dyn Flow) -> bool {
        const EVERY: usize = 8;
        const IN_A_ROW: usize = 8;
        if self.stiff || self.steps % EVERY != EVERY - 1 {
            return false;
        }
        let (time, state) = (self.time(), self.state().to_vec());
        let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut rates = vec![0.0; state.len()];
        if !flow.rates(time, &state, &mut rates) {
            return false;
        }
        if self.steepest.len() != state.len() {
            self.steepest = vec![1.0; state.len()];
        }
        let shift = 1e-7 * (1.0 + size(&state)) / size(&self.steepest);
        let moved = state.iter().zip(&self.steepest).map(|(y, v)| y + shift * v);
        let (moved, mut changed) = (moved.collect::<Vec<f64>>(), rates.clone());
        if !flow.rates(time, &moved, &mut changed) {
            return false;
        }
        let change = changed.iter().zip(&rates).map(|(b, a)| (b - a) / shift);
        let change: Vec<f64> = change.collect();
        let eigenvalue = size(&change) / size(&self.steepest);
        if eigenvalue > 0.0 {
            self.steepest = change.iter().map(|x| x / size(&change)).collect();
        }
        self.limited = match self.step * eigenvalue > 1.5 {
            true => self.limited + 1,
            false => 0,
        };
        self.limited >= IN_A_ROW
    }

    /// The time reached.
    pub fn time(&self) -> f64 {
        self.method.time()
    }

    /// The state there.
    pub fn state(&self) -> &[f64] {
        self.method.state()
    }

    /// The state at a time within the last step.
    pub fn within(&mut self, time: f64) -> Vec<f64> {
        let found = self.method.within(time);
        found.unwrap_or_else(|| self.state().to_vec())
    }

    /// The state at a time within the last step by a step that ends there, as accurate as those at the ends of steps.
    pub fn reached(&mut self, flow: &mut dyn Flow, time: f64) -> Vec<f64> {
        let (from, state) = self.method.before();
        if self.stiff || time <= from {
            return self.within(time);
        }
        let (span, cells) = ([from, time], SharedFlow::of(flow));
        let mut method = explicit(self.tolerance, time - from, state.len());
        let mut made = method.begin(&cells, span, &state.to_vec());
        while made.is_ok() && method.time() < time {
            made = method.advance(&cells, time).map(drop);
        }
        match made {
            Ok(()) => method.state().to_vec(),
            Err(_) => self.within(time),
        }
    }

    /// True once the problem was found to be stiff.
    pub fn is_stiff(&self) -> bool {
        self.stiff
    }
}

/// The methods themselves limit neither steps nor rejections.
const UNLIMITED: usize = usize::MAX;

fn explicit(tolerance: f64, step: f64, _: usize) -> Box<dyn Method> {
    let method = ExplicitRungeKutta::<Ordinary, DormandPrince, f64, Phase, 8, 12, 16>::dop853();
    let method = method.rtol(tolerance).atol(tolerance).h0(step);
    Box::new(Any(method.max_steps(UNLIMITED).max_rejects(UNLIMITED)))
}

fn implicit(tolerance: f64, step: f64, size: usize) -> Box<dyn Method> {
    match size {
        // the work supplied and twice as many numbers as freedoms
        ..=5 => implicit_over::<5>(tolerance, step, size),
        6..=9 => implicit_over::<9>(tolerance, step, size),
        10..=17 => implicit_over::<17>(tolerance, step, size),
        18..=64 => implicit_over::<64>(tolerance, step, size),
        _ => explicit(tolerance, step, size),
    }
}

fn implicit_over<const N: usize>(tolerance: f64, step: f64, size: usize) -> Box<dyn Method> {
    let method = ImplicitRungeKutta::<Ordinary, Radau, f64, [f64; N], 5, 3, 3>::radau5();
    let method = method.rtol(vec![tolerance; N]).atol(vec![tolerance; N]);
    let method = method.h0(step).max_steps(UNLIMITED).max_rejects(UNLIMITED);
    Box::new(Over { method, size })
}

/// The right-hand side behind a shared reference, as the methods take it.
struct SharedFlow<'a>(RefCell<&'a mut dyn Flow>);

impl<'a> SharedFlow<'a> {
    fn of(flow: &'a mut dyn Flow) -> Self {
        SharedFlow(RefCell::new(flow))
    }
}

impl ODE<f64, Vec<f64>> for SharedFlow<'_> {
    fn diff(&self, time: f64, state: &Vec<f64>, rates: &mut Vec<f64>) {
        if !self.0.borrow_mut().rates(time, state, rates) {
            rates.fill(f64::NAN);
        }
    }
}

/// That over states of N numbers, of which the first are used.
struct FilledState<'a, 'c, const N: usize>(&'a SharedFlow<'c>, usize);

impl<const N: usize> ODE<f64, [f64; N]> for FilledState<'_, '_, N> {
    fn diff(&self, time: f64, state: &[f64; N], rates: &mut [f64; N]) {
        let &FilledState(SharedFlow(flow), size) = self;
        let known = (flow.borrow_mut()).rates(time, &state[..size], &mut rates[..size]);
        if !known {
            rates[..size].fill(f64::NAN);
        }
        rates[size..].fill(0.0);
    }

    /// Differences for the numbers that are used, by the step of the default.
    fn jacobian(&self, time: f64, state: &[f64; N], jacobian: &mut Matrix<f64>) {
        let step = f64::EPSILON.sqrt();
        let (mut here, mut there) = ([0.0; N], [0.0; N]);
        self.diff(time, state, &mut here);
        for column in 0..self.1 {
            let mut moved = *state;
            moved[column] += step * state[column].abs().max(1.0);
            self.diff(time, &moved, &mut there);
            for row in 0..self.1 {
                let change = there[row] - here[row];
                jacobian[(row, column)] = change / (moved[column] - state[column]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Of<F>(F);

    impl<F: FnMut(f64, &[f64], &mut [f64]) -> bool> Flow for Of<F> {
        fn rates(&mut self, time: f64, state: &[f64], rates: &mut [f64]) -> bool {
            (self.0)(time, state, rates)
        }
    }

    fn integrate(flow: &mut dyn Flow, start: &[f64], end: f64) -> Result<Integrator, TooShort> {
        let mut integrator = Integrator::new(1e-11, end);
        integrator.start(flow, 0.0, start)?;
        while integrator.step(flow)? < end {}
        Ok(integrator)
    }

    #[test]
    fn an_oscillator_comes_back_after_ten_turns_and_is_right_within_a_step() {
        let turns = 10.0 * std::f64::consts::TAU;
        let mut flow = Of(|_: f64, y: &[f64], dy: &mut [f64]| {
            (dy[0], dy[1]) = (y[1], -y[0]);
            true
        });
        let mut end = integrate(&mut flow, &[1.0, 0.0], turns).unwrap();
        assert!((end.state()[0] - 1.0).abs() < 1e-8 && end.state()[1].abs() < 1e-8);
        let middle = turns - 0.5 * end.step.min(1e-3);
        let state = end.within(middle);
        assert!(
            (state[0] - middle.cos()).abs() < 1e-9 && state != end.state(),
            "{state:?}"
        );
        assert!(!end.is_stiff());
    }

    #[test]
    fn it_goes_on_near_the_end_with_a_longer_step_than_is_left() {
        let mut flow = Of(|t: f64, _: &[f64], dy: &mut [f64]| {
            dy[0] = t;
            true
        });
        let mut integrator = Integrator::new(1e-11, 100.0);
        integrator.start(&mut flow, 0.0, &[0.0]).unwrap();
        while integrator.time() < 99.0 {
            integrator.step(&mut flow).unwrap();
            let (time, state) = (integrator.time(), integrator.state().to_vec());
            integrator.start(&mut flow, time, &state).unwrap();
        }
        while integrator.time() < 100.0 {
            integrator.step(&mut flow).unwrap();
        }
        assert!((integrator.state()[0] - 5000.0).abs() < 1e-7);
    }

    #[test]
    fn a_stiff_problem_is_found_to_be_one_and_a_pole_cannot_be_passed() {
        // Hairer and Wanner (1996), IV.1: ẏ = −50 (y − cos t), here a thousand times stiffer
        let mut stiff = Of(|t: f64, y: &[f64], dy: &mut [f64]| {
            dy[0] = -5e4 * (y[0] - t.cos());
            true
        });
        let end = integrate(&mut stiff, &[0.0], 10.0).unwrap();
        assert!(end.is_stiff());
        assert!((end.state()[0] - 10.0f64.cos()).abs() < 1e-4);
        // y = 1/(1 − t)
        let mut pole = Of(|_: f64, y: &[f64], dy: &mut [f64]| {
            dy[0] = y[0] * y[0];
            y[0].is_finite()
        });
        assert_eq!(integrate(&mut pole, &[1.0], 2.0).err(), Some(TooShort));
    }
}
