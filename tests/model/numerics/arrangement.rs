//! Normal form → the expression a textbook would print.

use linkwork::algebra::Budget;
use linkwork::algebra::*;
use linkwork::algebra::{Symbolic, with_letters};

const LETTERS: [&str; 9] = ["a", "b", "l", "t1", "t2", "t3", "t4", "t5", "t6"];

fn printed(texts: &[&str]) -> Vec<String> {
    let budget = Budget { products: 100_000 };
    with_letters(vec![1.0; LETTERS.len()], budget, || {
        let number = |name: &String| LETTERS.iter().position(|l| l == name).unwrap() as u32;
        let formulas: Vec<Trigonometric> = (texts.iter())
            .map(|text| {
                let expression = Expression::parse(text).unwrap();
                let value = expression.evaluate(&|n: &String| Symbolic::symbol(number(n)));
                (*value.unwrap().formula().unwrap()).clone()
            })
            .collect();
        let formulas: Vec<&Trigonometric> = formulas.iter().collect();
        let arranged = arrange(&formulas, &|symbol| LETTERS[symbol as usize].into());
        arranged.expressions.iter().map(|e| e.to_string()).collect()
    })
}

#[test]
fn constants_are_exact_and_in_front() {
    assert_eq!(
        printed(&[
            "sqrt(3)/2*b - l*cos(t1)*sin(60 deg)",
            "0.4318*a",
            "a/3",
            "cos(t1 + 20 deg)"
        ]),
        [
            "sqrt(3)/2*b - sqrt(3)/2*l*cos(t1)",
            "0.4318*a",
            "1/3*a",
            "cos(t1 + 20 deg)"
        ]
    );
    assert_eq!(printed(&["0", "-1", "a - a"]), ["0", "-1", "0"]);
}

#[test]
fn quotients_and_roots_are_printed_as_such() {
    assert_eq!(
        printed(&["a/(b*l)", "sqrt(a + b)*l", "a/(1 + cos(t1))", "a^2/b^2"]),
        ["a/(b*l)", "l*sqrt(a + b)", "a/(1 + cos(t1))", "a^2/b^2"]
    );
    assert_eq!(
        printed(&["0.1/(2*pi)*t1", "1/20/pi", "sqrt(3)/2*a/b", "-2*a/(3*l)"]),
        ["t1/(20*pi)", "1/(20*pi)", "sqrt(3)*a/(2*b)", "-2*a/(3*l)"]
    );
}

#[test]
fn half_angles_and_products_with_letters_are_angles() {
    assert_eq!(
        printed(&["cos(t1/2)", "cos(b*t1 - t2)"]),
        ["cos(1/2*t1)", "cos(b*t1 - t2)"]
    );
}
