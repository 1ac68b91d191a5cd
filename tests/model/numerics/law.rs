//! Laws of motion against differences.

use linkwork::analysis::sweep::Law;

#[test]
fn rates_and_accelerations_are_derivatives_of_the_laws() {
    let h = 1e-5;
    for law in Law::ALL {
        assert_eq!(law.at(0.0)[0], 0.0, "{}", law.word());
        assert!((law.at(1.0)[0] - 1.0).abs() < 1e-15);
        for u in [0.1, 0.37, 0.5, 0.81] {
            let [before, here, after] = [u - h, u, u + h].map(|u| law.at(u));
            assert!(((after[0] - before[0]) / (2.0 * h) - here[1]).abs() < 1e-8);
            assert!(((after[1] - before[1]) / (2.0 * h) - here[2]).abs() < 1e-7);
            assert!((law.inverse(here[0]) - u).abs() < 1e-14, "{}", law.word());
        }
    }
    let rest = |law: Law| [0.0, 1.0].map(|u| law.at(u)[1]);
    for law in [Law::Cubic, Law::Quintic, Law::Septic, Law::Cycloidal] {
        assert_eq!(rest(law), [0.0, 0.0], "{}", law.word());
    }
}
