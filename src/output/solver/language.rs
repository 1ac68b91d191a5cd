//! What differs between the languages.

use crate::algebra::{Operation, Place};

/// The language of a solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// C99, a header of static functions.
    C,
    /// Rust, a module that needs no standard library.
    Rust,
}

/// The numbers of a solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// 32 bits.
    Single,
    /// 64 bits.
    Double,
}

impl Language {
    /// The ending of its files.
    pub fn ending(self) -> &'static str {
        match self {
            Language::C => "h",
            Language::Rust => "rs",
        }
    }

    /// The ending of a program.
    pub fn program_ending(self) -> &'static str {
        match self {
            Language::C => "c",
            Language::Rust => "rs",
        }
    }

    pub(super) fn template(self) -> &'static str {
        match self {
            Language::C => include_str!("solver.h.in"),
            Language::Rust => include_str!("solver.rs.in"),
        }
    }

    pub(super) fn test_template(self) -> &'static str {
        match self {
            Language::C => include_str!("test.c.in"),
            Language::Rust => include_str!("test.rs.in"),
        }
    }

    pub(super) fn comment(self) -> &'static str {
        match self {
            Language::C => " *",
            Language::Rust => "//!",
        }
    }

    pub(super) fn brackets(self) -> (char, char) {
        match self {
            Language::C => ('{', '}'),
            Language::Rust => ('[', ']'),
        }
    }

    /// A name given a value that does not change.
    pub(super) fn bound(self, name: &str, value: &str) -> String {
        match self {
            Language::C => format!("const @real@ {name} = {value};\n"),
            Language::Rust => format!("let {name}: @real@ = {value};\n"),
        }
    }

    /// A name given a value that does.
    pub(super) fn variable(self, name: &str, value: &str) -> String {
        match self {
            Language::C => format!("@real@ {name} = {value};\n"),
            Language::Rust => format!("let mut {name}: @real@ = {value};\n"),
        }
    }

    /// Sine and cosine of an angle.
    pub(super) fn turned(self, sin: &str, cos: &str, angle: &str) -> String {
        match self {
            Language::C => {
                format!("@real@ {sin}, {cos}; @name@_sine_cosine({angle}, &{sin}, &{cos});\n")
            }
            Language::Rust => format!("let ({sin}, {cos}) = sine_cosine({angle});\n"),
        }
    }

    /// The same of an angle that turns on.
    pub(super) fn turning(self, sin: &str, cos: &str, angle: &str) -> String {
        match self {
            Language::C => {
                format!("@real@ {sin}, {cos}; @name@_sine_cosine({angle}, &{sin}, &{cos});\n")
            }
            Language::Rust => format!("let (mut {sin}, mut {cos}) = sine_cosine({angle});\n"),
        }
    }

    /// Sine and cosine after a small turn.
    pub(super) fn turned_on(self, sin: &str, cos: &str, by: &str) -> String {
        match self {
            Language::C => format!("@name@_turn({by}, &{sin}, &{cos});\n"),
            Language::Rust => format!("turn({by}, &mut {sin}, &mut {cos});\n"),
        }
    }

    /// The larger of a size and that of a number.
    pub(super) fn larger(self, size: &str, of: &str) -> String {
        match self {
            Language::C => format!("{size} = @name@_larger({size}, {of});\n"),
            Language::Rust => format!("{size} = larger({size}, {of});\n"),
        }
    }

    /// Gives up, in a function that says whether it came to an end.
    pub(super) fn gives_up_if(self, condition: &str) -> String {
        match self {
            Language::C => format!("if ({condition}) return 0;\n"),
            Language::Rust => format!("if {condition} {{ return false; }}\n"),
        }
    }

    /// An operation on named operands.
    pub(super) fn operation(self, of: Operation, name: &dyn Fn(Place) -> String) -> String {
        match of {
            Operation::Add(x, y) => format!("{} + {}", name(x), name(y)),
            Operation::Subtract(x, y) => format!("{} - {}", name(x), name(y)),
            Operation::Multiply(x, y) => format!("{} * {}", name(x), name(y)),
            Operation::Divide(x, y) => format!("{} / {}", name(x), name(y)),
            Operation::Negate(x) => format!("-{}", name(x)),
            Operation::Root(x) => match self {
                Language::C => format!("@name@_root({})", name(x)),
                Language::Rust => format!("root({})", name(x)),
            },
            Operation::Constant(_)
            | Operation::Input(_)
            | Operation::Sin(_)
            | Operation::Cos(_) => {
                unreachable!("numbers have names of their own, and sines come with their cosines")
            }
        }
    }
}

impl Precision {
    /// A constant.
    pub(super) fn literal(self, x: f64, language: Language) -> String {
        let digits = match self {
            Precision::Double => format!("{x:?}"),
            Precision::Single => format!("{:?}", x as f32),
        };
        match (self, language) {
            (Precision::Single, Language::C) => digits + "f",
            _ => digits,
        }
    }

    /// Words of the templates.
    pub(super) fn words(self, language: Language) -> [(&'static str, &'static str); 14] {
        let (real, suffix, root, absolute) = match (self, language) {
            (Precision::Double, Language::C) => ("double", "", "sqrt", "fabs"),
            (Precision::Single, Language::C) => ("float", "f", "sqrtf", "fabsf"),
            (Precision::Double, Language::Rust) => ("f64", "", "", ""),
            (Precision::Single, Language::Rust) => ("f32", "", "", ""),
        };
        let (tolerance, rounding, rank, singular, close) = match self {
            Precision::Double => ("1e-14", "1e-12", "1e-10", "1e-5", "1e-9"),
            Precision::Single => ("1e-6", "2e-5", "1e-5", "3e-3", "2e-3"),
        };
        // halving the exponent gives 1/√x to some per cent
        let (root_guess, root_steps) = match self {
            Precision::Double => (
                "f64::from_bits(0x5fe6_eb50_c7b5_37a9 - (x.to_bits() >> 1))",
                "4",
            ),
            Precision::Single => ("f32::from_bits(0x5f37_59df - (x.to_bits() >> 1))", "3"),
        };
        let (farthest, two_over_pi, polynomials) = match self {
            Precision::Double => ("1e5", "0.6366197723675814", "fdlibm, Sun 1993"),
            Precision::Single => ("1e4", "0.63661975", "Cephes, Moshier 1989"),
        };
        [
            ("@real@", real),
            ("@f@", suffix),
            ("@sqrt@", root),
            ("@fabs@", absolute),
            ("@tolerance@", tolerance),
            ("@rounding@", rounding),
            ("@rank@", rank),
            ("@singular@", singular),
            ("@close@", close),
            ("@farthest@", farthest),
            (
                "@two_over_pi@",
                match (self, language) {
                    (Precision::Single, Language::C) => "0.63661975f",
                    _ => two_over_pi,
                },
            ),
            ("@polynomials@", polynomials),
            ("@root_guess@", root_guess),
            ("@root_steps@", root_steps),
        ]
    }

    /// Sine s and cosine c of the rest r of an angle x beyond k quarter turns, |r| ≤ π/4.
    pub(super) fn sine(self, language: Language) -> String {
        type Series = &'static [f64];
        // π/2 in three parts, the first two with zeros in their last bits, so that products with k are exact; then
        // (sin r − r)/r³ and (cos r − 1 + r²/2)/r⁴ by powers of r²
        let (parts, sine, cosine): ([f64; 3], Series, Series) = match self {
            Precision::Double => (
                [
                    1.570_796_326_734_125_6,
                    6.077_100_506_303_966e-11,
                    2.022_266_248_795_950_6e-21,
                ],
                &[
                    -0.166_666_666_666_666_32,
                    0.008_333_333_333_322_49,
                    -0.000_198_412_698_298_579_5,
                    2.755_731_370_707_006_8e-6,
                    -2.505_076_025_340_686_3e-8,
                    1.589_690_995_211_55e-10,
                ],
                &[
                    0.041_666_666_666_666_6,
                    -0.001_388_888_888_887_411,
                    2.480_158_728_947_673e-5,
                    -2.755_731_435_139_066_3e-7,
                    2.087_572_321_298_175e-9,
                    -1.135_964_755_778_819_5e-11,
                ],
            ),
            Precision::Single => (
                [
                    1.570_312_5,
                    4.837_512_969_970_703e-4,
                    7.549_789_954_891_882e-8,
                ],
                &[-1.666_665_461_1e-1, 8.332_160_873_6e-3, -1.951_529_589_1e-4],
                &[
                    4.166_664_568_298_827e-2,
                    -1.388_731_625_493_765e-3,
                    2.443_315_711_809_948e-5,
                ],
            ),
        };
        let number = |x: f64| match x < 0.0 {
            true => format!("({})", self.literal(x, language)),
            false => self.literal(x, language),
        };
        let series = |of: Series| -> String {
            let last = of.len() - 1;
            of[..last].iter().rev().fold(number(of[last]), |sum, x| {
                format!("({} + z * {sum})", number(*x))
            })
        };
        let [p, q, s] = parts.map(number);
        let half = self.literal(0.5, language);
        let one = self.literal(1.0, language);
        [
            language.bound("r", &format!("((x - k * {p}) - k * {q}) - k * {s}")),
            language.bound("z", "r * r"),
            language.bound("s", &format!("r + r * z * {}", series(sine))),
            language.bound(
                "c",
                &format!("({one} - {half} * z) + z * z * {}", series(cosine)),
            ),
        ]
        .map(|line| format!("    {line}"))
        .concat()
    }
}
