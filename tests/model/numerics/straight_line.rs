//! Straight-line programs: the kinematics evaluated over operations that are written down.

use linkwork::algebra::*;
use linkwork::number::Number;

#[test]
fn what_does_not_depend_on_inputs_is_not_written() {
    let (kept, operations) = record(vec![0.3, 2.0], || {
        let (x, y) = (Recorded::input(0), Recorded::input(1));
        let zero = Recorded::zero();
        let (sin, cos) = zero.sin_cos();
        assert_eq!((sin, cos), (zero, Recorded::one()));
        assert_eq!(x * sin + y * cos, y);
        assert_eq!(-(x - y), y - x);
        assert_eq!((x - y) - (x - y), zero);
        let sum = x + y * y + x * y;
        assert_eq!((sum - x) - y * y, x * y);
        assert_eq!(-(-x), x);
        assert_eq!(x * y, y * x);
        let [quarter, half] = [0.25, 0.5].map(Recorded::from_f64);
        assert_eq!(quarter * x + half * x + quarter * x, x);
        assert_eq!(half * x - half * x, zero);
        let of = x.sin_cos().0;
        assert_eq!((half * of) * y, half * (of * y));
        let (sin, cos) = (-x).sin_cos();
        assert_eq!((-sin, cos), x.sin_cos());
        (x * y + sin).place()
    });
    let used = |place: OperationIndex| operations[place as usize].operands().count();
    assert_eq!(used(kept), 2);
}

#[test]
fn the_value_at_the_sample_is_that_of_the_operations() {
    let f = |x: f64, y: f64| (x.sin() / y - (x * y).cos()) * (x + y).sqrt();
    let (value, _) = record(vec![0.4, 1.7], || {
        let (x, y) = (Recorded::input(0), Recorded::input(1));
        ((x.sin_cos().0 / y - (x * y).sin_cos().1) * (x + y).sqrt()).real()
    });
    assert!((value - f(0.4, 1.7)).abs() < 1e-15);
}
