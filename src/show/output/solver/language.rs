//! Differences between the languages.

use super::Code;
use crate::algebra::{Function, Operation, OperationIndex};

/// The language of a solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Language {
    /// C99, a header of static functions.
    C,
    /// Rust, a module that needs no standard library.
    Rust,
}

/// The numbers of a solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Precision {
    /// 32 bits.
    Single,
    /// 64 bits.
    Double,
}

impl Language {
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

    /// Sine and cosine of an angle, which change where the angle does.
    pub(super) fn turned(self, sin: &str, cos: &str, angle: &str, changes: bool) -> String {
        let mutable = if changes { "mut " } else { "" };
        match self {
            Language::C => {
                format!("@real@ {sin}, {cos}; @name@_sine_cosine({angle}, &{sin}, &{cos});\n")
            }
            Language::Rust => {
                format!("let ({mutable}{sin}, {mutable}{cos}) = sine_cosine({angle});\n")
            }
        }
    }

    /// Sine and cosine after a turn by one of the steps.
    pub(super) fn turned_on(self, sin: &str, cos: &str, by: &str) -> String {
        match self {
            Language::C => format!("@name@_turn({by}, longest, &{sin}, &{cos});\n"),
            Language::Rust => format!("turn({by}, longest, &mut {sin}, &mut {cos});\n"),
        }
    }

    /// Gives up, in a function that says whether it came to an end.
    pub(super) fn gives_up_if(self, condition: &str) -> String {
        self.returns_if("@no@", condition)
    }

    /// Returns a value.
    pub(super) fn returns_if(self, value: &str, condition: &str) -> String {
        match self {
            Language::C => format!("if ({condition}) return {value};\n"),
            Language::Rust => format!("if {condition} {{ return {value}; }}\n"),
        }
    }

    /// A sign that is given, or chosen.
    pub(super) fn sign(self, number: usize, chosen: &str) -> String {
        match self {
            Language::C => format!("signs ? signs[{number}] : {chosen}"),
            Language::Rust => {
                format!("match signs {{ Some(signs) => signs[{number}], None => {chosen} }}")
            }
        }
    }

    /// The words of the templates and of lines written, each in C and in Rust.
    fn words(self) -> [(&'static str, &'static str); 12] {
        [
            ("@let@", "const @real@", "let"),
            ("@var@", "@real@", "let mut"),
            ("@is@", "", ": @real@"),
            ("@own@", "@name@_", ""),
            ("@open@", "{", "["),
            ("@shut@", "}", "]"),
            ("@yes@", "1", "true"),
            ("@no@", "0", "false"),
            ("@undetermined@", "@NAME@_SINGULAR", "Verdict::Singular"),
            ("@apart@", "@NAME@_NOT_ASSEMBLED", "Verdict::NotAssembled"),
            ("@fabs@", "fabs@f@", "absolute"),
            ("@sqrt@", "sqrt@f@", "root"),
        ]
        .map(|(word, c, rust)| match self {
            Language::C => (word, c),
            Language::Rust => (word, rust),
        })
    }
}

/// A name given a value that does not change.
pub(super) fn bound(name: &str, value: &str) -> String {
    format!("@let@ {name}@is@ = {value};\n")
}

/// A name given a value that does.
pub(super) fn variable(name: &str, value: &str) -> String {
    format!("@var@ {name}@is@ = {value};\n")
}

/// The larger of a size and that of a number.
pub(super) fn larger(size: &str, of: &str) -> String {
    format!("{size} = @own@larger({size}, {of});\n")
}

/// An operation on named operands.
pub(super) fn operation(of: Operation, name: &dyn Fn(OperationIndex) -> String) -> String {
    match of {
        Operation::Add(x, y) => format!("{} + {}", name(x), name(y)),
        Operation::Subtract(x, y) => format!("{} - {}", name(x), name(y)),
        Operation::Multiply(x, y) => format!("{} * {}", name(x), name(y)),
        Operation::Divide(x, y) => format!("{} / {}", name(x), name(y)),
        Operation::Negate(x) => format!("-{}", name(x)),
        Operation::Root(x) => format!("@own@root({})", name(x)),
        Operation::RootOrZero(x) => format!("@own@root_or_zero({})", name(x)),
        Operation::Angle(y, x) => format!("@own@angle({}, {})", name(y), name(x)),
        Operation::Near(x, y) => format!("@own@nearest({}, {})", name(x), name(y)),
        Operation::Sign(x) => format!("@own@sign({})", name(x)),
        Operation::Larger(x, y) => format!("@own@greater({}, {})", name(x), name(y)),
        Operation::Call(function, x) => called(function, &name(x)),
        Operation::Constant(_) | Operation::Input(_) | Operation::Sin(_) | Operation::Cos(_) => {
            unreachable!("numbers have names of their own, and sines come with their cosines")
        }
    }
}

/// A function of an operand by an angle of two numbers.
fn called(function: Function, x: &str) -> String {
    let across = format!("@own@root_or_zero(1.0@f@ - {x} * {x})");
    match function {
        Function::Asin => format!("@own@angle({x}, {across})"),
        Function::Acos => format!("@own@angle({across}, {x})"),
        Function::Atan => format!("@own@angle({x}, 1.0@f@)"),
        _ => unreachable!("a solver refuses other functions"),
    }
}

type PowerSeries = &'static [f64];

impl Code {
    /// A constant.
    pub(super) fn literal(&self, x: f64) -> String {
        let digits = match self.precision {
            Precision::Double => format!("{x:?}"),
            Precision::Single => format!("{:?}", x as f32),
        };
        match (self.precision, self.language) {
            (Precision::Single, Language::C) => digits + "f",
            _ => digits,
        }
    }

    /// A number as an operand: in parentheses if it is negative.
    pub(super) fn operand(&self, x: f64) -> String {
        let literal = self.literal(x);
        match x < 0.0 {
            true => format!("({literal})"),
            false => literal,
        }
    }

    /// All words to be replaced, in order: some stand in what replaces others.
    pub(super) fn words(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let precision = self.precision;
        let (real, suffix) = match (self.precision, self.language) {
            (Precision::Double, Language::C) => ("double", ""),
            (Precision::Single, Language::C) => ("float", "f"),
            (Precision::Double, Language::Rust) => ("f64", ""),
            (Precision::Single, Language::Rust) => ("f32", ""),
        };
        // halving the exponent gives 1/√x to some per cent
        let guesses = [
            "f64::from_bits(0x5fe6_eb50_c7b5_37a9 - (x.to_bits() >> 1))",
            "f32::from_bits(0x5f37_59df - (x.to_bits() >> 1))",
        ];
        let words = [
            ("@tolerance@", "1e-14", "1e-6"),
            ("@rounding@", "1e-12", "2e-5"),
            ("@rank@", "1e-10", "1e-5"),
            ("@singular@", "1e-5", "3e-3"),
            ("@close@", "1e-9", "2e-3"),
            ("@limit_rounding@", "1e-9", "1e-5"),
            // a step after which the rows are closed
            ("@closed_step@", "1e-8", "1e-4"),
            ("@shortest@", "1e-9", "1e-5"),
            ("@farthest@", "1e5", "1e4"),
            ("@two_over_pi@", "0.6366197723675814", "0.63661975@f@"),
            ("@round@", "6755399441055744.0", "12582912.0"),
            // from the second bit to that of the sign
            ("@to_sign@", "62", "30"),
            ("@polynomials@", "fdlibm, Sun 1993", "Cephes, Moshier 1989"),
            ("@root_guess@", guesses[0], guesses[1]),
            ("@root_steps@", "4", "3"),
        ];
        let words = words.map(move |(word, double, single)| match precision {
            Precision::Double => (word, double),
            Precision::Single => (word, single),
        });
        let words = self.language.words().into_iter().chain(words);
        words.chain([("@real@", real), ("@f@", suffix)])
    }

    /// Σ cₖ zᵏ in pairs, by w = z²: more at once than one after the other.
    fn series(&self, of: PowerSeries) -> String {
        let number = |x: f64| self.operand(x);
        let pairs = of.chunks(2).map(|pair| match pair {
            [x, y] => format!("({} + z * {})", number(*x), number(*y)),
            rest => number(rest[0]),
        });
        let pairs: Vec<String> = pairs.collect();
        let sum = pairs.into_iter().rev();
        sum.reduce(|sum, pair| format!("({pair} + w * {sum})"))
            .unwrap_or_default()
    }

    /// The angle a of a tangent t, |t| ≤ √2 − 1.
    pub(super) fn arctangent(&self) -> String {
        // (atan t − t)/t³ by powers of t²
        let series: PowerSeries = match self.precision {
            Precision::Double => &[
                -3.333_333_333_333_293e-1,
                1.999_999_999_987_648_3e-1,
                -1.428_571_427_250_346_6e-1,
                1.111_111_040_546_235_6e-1,
                -9.090_887_133_436_507e-2,
                7.691_876_205_044_83e-2,
                -6.661_073_137_387_531e-2,
                5.833_570_133_790_573_5e-2,
                -4.976_877_994_615_932e-2,
                3.653_157_274_421_691_6e-2,
                -1.628_582_011_536_578_2e-2,
            ],
            Precision::Single => &[
                -3.333_294_915_39e-1,
                1.997_771_064_78e-1,
                -1.387_768_560_32e-1,
                8.053_744_495_38e-2,
            ],
        };
        let sum = format!("t + t * z * {}", self.series(series));
        [bound("z", "t * t"), bound("w", "z * z"), bound("a", &sum)]
            .map(|line| format!("    {line}"))
            .concat()
    }

    /// Sine s and cosine c of the rest r of an angle x beyond k quarter turns, |r| ≤ π/4.
    pub(super) fn sine(&self) -> String {
        // π/2 in three parts, the first two with zeros in their last bits, so that products with k are exact; then
        // (sin r − r)/r³ and (cos r − 1 + r²/2)/r⁴ by powers of r²
        let (parts, sine, cosine): ([f64; 3], PowerSeries, PowerSeries) = match self.precision {
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
        let number = |x: f64| self.operand(x);
        let series = |of: PowerSeries| self.series(of);
        let [p, q, s] = parts.map(number);
        let half = self.literal(0.5);
        let one = self.literal(1.0);
        [
            bound("r", &format!("((x - k * {p}) - k * {q}) - k * {s}")),
            bound("z", "r * r"),
            bound("w", "z * z"),
            bound("s", &format!("r + r * z * {}", series(sine))),
            bound(
                "c",
                &format!("({one} - {half} * z) + w * {}", series(cosine)),
            ),
        ]
        .map(|line| format!("    {line}"))
        .concat()
    }
}
