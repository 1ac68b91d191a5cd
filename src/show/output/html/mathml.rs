//! The LaTeX of formulas as MathML Core, which browsers show without a script.

use std::iter::Peekable;
use std::str::Chars;

use super::escaped;

/// A displayed formula. Of TeX it knows what [`latex`](crate::output::formulas::latex) writes: another command stands there by
/// its name.
pub fn render(latex: &str) -> String {
    let mut reader = FormulaReader {
        rest: latex.chars().peekable(),
    };
    format!(
        "<math display=\"block\">{}</math>",
        reader.row(&mut String::new())
    )
}

struct FormulaReader<'t> {
    rest: Peekable<Chars<'t>>,
}

/// Commands that are characters.
const SYMBOLS: [(&str, &str); 31] = [
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("epsilon", "ε"),
    ("zeta", "ζ"),
    ("eta", "η"),
    ("theta", "θ"),
    ("iota", "ι"),
    ("kappa", "κ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("nu", "ν"),
    ("xi", "ξ"),
    ("rho", "ρ"),
    ("sigma", "σ"),
    ("tau", "τ"),
    ("upsilon", "υ"),
    ("phi", "φ"),
    ("chi", "χ"),
    ("psi", "ψ"),
    ("omega", "ω"),
    ("Gamma", "Γ"),
    ("pi", "π"),
    ("circ", "°"),
    ("textbackslash", "\\"),
    ("textasciicircum", "^"),
    ("textasciitilde", "~"),
    ("textless", "<"),
    ("textgreater", ">"),
    ("_", "_"),
];

fn symbol(command: &str) -> Option<&'static str> {
    let known = SYMBOLS.iter().find(|(name, _)| *name == command);
    known.map(|(_, character)| *character)
}

fn tag(name: &str, inside: &str) -> String {
    format!("<{name}>{inside}</{name}>")
}

fn operator(text: &str) -> String {
    tag("mo", &escaped(text))
}

impl FormulaReader<'_> {
    /// The part up to the end of a group, a cell, a row, an environment or the text; `end` becomes what ended it.
    fn row(&mut self, end: &mut String) -> String {
        let mut row = String::new();
        end.clear();
        while let Some(&next) = self.rest.peek() {
            match next {
                '}' | '&' => {
                    self.rest.next();
                    end.push(next);
                    break;
                }
                c if c.is_whitespace() => {
                    self.rest.next();
                }
                _ => match self.atom() {
                    Ok(atom) => row += &self.scripted(atom),
                    Err(ending) => {
                        *end = ending;
                        break;
                    }
                },
            }
        }
        tag("mrow", &row)
    }

    /// An atom with what stands above and below it.
    fn scripted(&mut self, base: String) -> String {
        let (mut below, mut above) = (None, None);
        while let Some(which) = self.rest.next_if(|c| matches!(c, '^' | '_')) {
            let script = self.argument();
            match which {
                '_' => below = Some(script),
                _ => above = Some(script),
            }
        }
        match (below, above) {
            (Some(below), Some(above)) => tag("msubsup", &(base + &below + &above)),
            (Some(below), None) => tag("msub", &(base + &below)),
            (None, Some(above)) => tag("msup", &(base + &above)),
            (None, None) => base,
        }
    }

    fn argument(&mut self) -> String {
        while self.rest.next_if(|c| c.is_whitespace()).is_some() {}
        self.atom().unwrap_or_default()
    }

    /// One thing, or the command that ends what it stands in.
    fn atom(&mut self) -> Result<String, String> {
        let Some(first) = self.rest.next() else {
            return Ok(String::new());
        };
        Ok(match first {
            '{' => self.row(&mut String::new()),
            '\\' => return self.command(),
            '0'..='9' => {
                let mut number = String::from(first);
                while let Some(digit) = self.rest.next_if(|c| c.is_ascii_digit() || *c == '.') {
                    number.push(digit);
                }
                tag("mn", &number)
            }
            '-' => operator("−"),
            letter if letter.is_alphabetic() => tag("mi", &letter.to_string()),
            other => operator(&other.to_string()),
        })
    }

    fn word(&mut self) -> String {
        let mut word = String::new();
        while let Some(letter) = self.rest.next_if(char::is_ascii_alphabetic) {
            word.push(letter);
        }
        // one character that is no letter is a command too
        match word.is_empty() {
            true => self.rest.next().map(String::from).unwrap_or_default(),
            false => word,
        }
    }

    fn command(&mut self) -> Result<String, String> {
        let name = self.word();
        Ok(match name.as_str() {
            "frac" => tag("mfrac", &(self.argument() + &self.argument())),
            "sqrt" => tag("msqrt", &self.argument()),
            "left" => {
                let mut end = String::new();
                let open = self.rest.next().map(String::from).unwrap_or_default();
                let inside = self.row(&mut end);
                let shut = self.rest.next().map(String::from).unwrap_or_default();
                tag("mrow", &(operator(&open) + &inside + &operator(&shut)))
            }
            "begin" => self.environment(),
            "mathrm" | "operatorname" | "text" => {
                let text = self.plain();
                format!("<mi mathvariant=\"normal\">{}</mi>", escaped(&text))
            }
            "mathit" => tag("mi", &escaped(&self.plain())),
            "cos" | "sin" | "tan" | "exp" | "ln" | "min" | "max" => {
                let space = match self.rest.peek() {
                    Some(' ') => "<mspace width=\"0.17em\"/>",
                    _ => "",
                };
                format!("<mi>{name}</mi><mo>&#x2061;</mo>{space}")
            }
            "," => "<mspace width=\"0.17em\"/>".into(),
            "quad" => "<mspace width=\"1em\"/>".into(),
            "cdot" => operator("·"),
            "le" => operator("≤"),
            "\\" => {
                if self.rest.next_if_eq(&'[').is_some() {
                    while self.rest.next().is_some_and(|c| c != ']') {}
                }
                return Err(name);
            }
            "right" | "end" => return Err(name),
            other => tag("mi", &escaped(symbol(other).unwrap_or(other))),
        })
    }

    /// The text of a group, read as running text.
    fn plain(&mut self) -> String {
        let mut text = String::new();
        let mut depth = 0;
        while let Some(next) = self.rest.next() {
            match next {
                '{' => depth += 1,
                '}' if depth <= 1 => break,
                '}' => depth -= 1,
                '\\' => {
                    let word = self.word();
                    text += symbol(&word).unwrap_or(&word);
                }
                other => text.push(other),
            }
        }
        text
    }

    /// `array` with its columns, of which a bar separates some, or `aligned`.
    fn environment(&mut self) -> String {
        let name = self.plain();
        let columns = match name.as_str() {
            "array" => self.plain(),
            _ => String::new(),
        };
        let ruled = columns.find('|');
        let (mut rows, mut cells) = (String::new(), String::new());
        let (mut end, mut column) = (String::new(), 0);
        loop {
            let inside = self.row(&mut end);
            cells += &match ruled == Some(column) {
                true => format!("<mtd class=\"ruled\">{inside}</mtd>"),
                false => tag("mtd", &inside),
            };
            column += 1;
            if end == "&" {
                continue;
            }
            rows += &tag("mtr", &cells);
            (cells, column) = (String::new(), 0);
            if end != "\\" {
                break;
            }
        }
        // \end{name}
        self.plain();
        format!(
            "<mtable displaystyle=\"true\" class=\"{}\">{rows}</mtable>",
            escaped(&name)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inside(latex: &str) -> String {
        let page = render(latex);
        let inside = page.strip_prefix("<math display=\"block\"><mrow>");
        inside
            .and_then(|rest| rest.strip_suffix("</mrow></math>"))
            .unwrap()
            .to_owned()
    }

    #[test]
    fn what_formulas_are_made_of_is_set() {
        assert_eq!(
            inside(r"{l_{0}}^{2}"),
            "<msup><mrow><msub><mi>l</mi><mrow><mn>0</mn></mrow></msub></mrow><mrow><mn>2</mn></mrow></msup>"
        );
        assert_eq!(
            inside(r"\frac{a}{2} - \mathrm{x\_1}"),
            "<mfrac><mrow><mi>a</mi></mrow><mrow><mn>2</mn></mrow></mfrac><mo>−</mo><mi mathvariant=\"normal\">x_1</mi>"
        );
        assert_eq!(
            inside(
                "\\begin{array}{c|c}\n1 & a<b \\\\[6pt]\n\\sin\\left(x\\right) & 0\n\\end{array}"
            ),
            "<mtable displaystyle=\"true\" class=\"array\"><mtr><mtd><mrow><mn>1</mn></mrow></mtd><mtd class=\"ruled\"><mrow><mi>a</mi><mo>&lt;</mo>\
             <mi>b</mi></mrow></mtd></mtr><mtr><mtd><mrow><mi>sin</mi><mo>&#x2061;</mo><mrow><mo>(</mo><mrow><mi>x</mi></mrow>\
             <mo>)</mo></mrow></mrow></mtd><mtd class=\"ruled\"><mrow><mn>0</mn></mrow></mtd></mtr></mtable>"
        );
    }

    /// A formula that is cut off or wrong still ends.
    #[test]
    fn broken_latex_ends() {
        for latex in [
            "{",
            "}",
            "\\left(",
            "\\begin{array",
            "\\frac{a",
            "x^",
            "&",
            "\\",
            "\\\\[",
            "",
        ] {
            assert!(render(latex).ends_with("</math>"), "{latex}");
        }
    }
}
