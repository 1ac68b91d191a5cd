//! Directed lines.

use linkwork::geometry::{Line, Vector3};

#[test]
fn a_direction_of_no_length_is_refused_and_a_tiny_one_is_not() {
    let along = |x: f64| Line::new(Vector3::zero(), Vector3([x, 0.0, 0.0]));
    assert!(along(0.0).is_none() && along(f64::NAN).is_none());
    assert_eq!(along(1e-300).unwrap().direction, Vector3([1.0, 0.0, 0.0]));
    assert_eq!(along(1e300).unwrap().direction, Vector3([1.0, 0.0, 0.0]));
}
