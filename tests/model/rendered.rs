//! Documents, cells and rows in each format, and the problems of a file on a terminal.

use linkwork::algebra::SiUnit;
use linkwork::description::{Entry, FileError};
use linkwork::mechanism::Mechanism;
use linkwork::output::csv::Csv;
use linkwork::output::diagnostics::{self, Style};
use linkwork::output::document::{Align, Cell, Column, Document, FormulaBlock, Section, Table};
use linkwork::output::quantity::{number, quantity};
use linkwork::output::{AnyReport, Report, html, markdown, text};
use serde::{Serialize, Serializer};
use serde_json::Value;

fn table<const N: usize>(columns: [(&str, SiUnit, Align); N], rows: Vec<[Cell; N]>) -> Table {
    let column = |(title, unit, align): (&str, SiUnit, Align)| Column {
        title: title.into(),
        unit,
        align,
    };
    Table {
        columns: columns.map(column).into(),
        rows: rows.into_iter().map(Vec::from).collect(),
        ruled: false,
    }
}

/// One of everything, with names that mean something in some format.
fn sample() -> Document {
    use Align::{Left, Right};
    let columns = [
        ("on|<b>", SiUnit::ONE, Left),
        ("Fx", SiUnit::NEWTON, Right),
        ("angle", SiUnit::ONE, Right),
    ];
    let angle = Cell::quantity(0.5, SiUnit::RADIAN);
    let rows = vec![
        [Cell::from("a|b"), Cell::from(-0.5), angle],
        [Cell::from("<script>"), Cell::from("10*"), Cell::Empty],
    ];
    let forces = table(columns, rows);
    let columns = [
        ("output", SiUnit::ONE, Left),
        ("l1 (m/s)", SiUnit::ONE, Right),
    ];
    let matrix = table(columns, vec![[Cell::from("x (m/s)"), Cell::from(2.0)]]);
    Document::new("4-bar <1>", "It moves: `a<b` drives *it*.")
        .note("near a limit")
        .section(Section::new("Forces").text("in ground").table(forces))
        .section(Section::new("Nothing"))
        .section(
            Section::new("More")
                .table(matrix)
                .code("ron", "a: \"```\",\n  <b>\n")
                .formulas([FormulaBlock {
                    title: "a_b".into(),
                    unicode: "x₁ = 0".into(),
                    latex: "x_{1} &= 0".into(),
                    below: vec!["as *said*".into()],
                }])
                .section(Section::new("Inner").list(["- one".into(), "two".into()])),
        )
        .method("3 steps")
}

#[test]
fn a_document_is_read_back_as_written() {
    let written = serde_json::to_string(&sample()).unwrap();
    assert_eq!(
        serde_json::from_str::<Document>(&written).unwrap(),
        sample()
    );
}

#[test]
fn sections_are_indented_and_numbers_end_at_the_same_place() {
    let wanted = r#"4-bar <1>
It moves: `a<b` drives *it*.
  near a limit

Forces
  in ground
  on|<b>    Fx (N)      angle
  a|b         -0.5  28.64789°
  <script>     10*

More
  output   l1 (m/s)
  x (m/s)         2
  a: "```",
    <b>
  a_b
    x₁ = 0
    as *said*
  Inner
    - one
    two

How it was found
  3 steps
"#;
    assert_eq!(text::render(&sample()), wanted);
}

#[test]
fn names_have_no_meaning_in_markdown() {
    let wanted = r#"# 4-bar \<1\>

It moves: `a<b` drives \*it\*.

- near a limit

## Forces

in ground

| on\|\<b\> | Fx (N) | angle |
| :-- | --: | --: |
| a\|b | -0.5 | 28.64789° |
| \<script\> | 10\* |  |

## More

| output | l1 (m/s) |
| :-- | --: |
| x (m/s) | 2 |

````ron
a: "```",
  <b>
````

a_b

$$
x_{1} &= 0
$$

- as \*said\*

### Inner

- \- one
- two

## How it was found

- 3 steps
"#;
    assert_eq!(markdown::render(&sample()), wanted);
}

#[test]
fn lines_that_look_like_lists_are_none() {
    let lines = ["1. x_1", "# a", "12 bars", "`b` and `c", "``", "a `b` c"];
    let notes = Document::new("", "").notes(lines.map(str::to_owned));
    let wanted = "- 1\\. x_1\n- \\# a\n- 12 bars\n- `b` and \\`c\n- \\`\\`\n- a `b` c\n";
    assert_eq!(markdown::render(&notes), wanted);
}

#[test]
fn names_have_no_meaning_in_html() {
    let page = html::render(&sample());
    let body = page.split("<main>").nth(1).unwrap();
    for wanted in [
        "<h1>4-bar &lt;1&gt;</h1>",
        "<p class=\"answer\">It moves: <code>a&lt;b</code> drives *it*.</p>",
        "<th scope=\"row\">&lt;script&gt;</th>",
        "<td class=\"right\">10*</td>",
        "<h3>Inner</h3>",
        "<h2>How it was found</h2>",
    ] {
        assert!(body.contains(wanted), "{wanted} is not in {body}");
    }
    assert!(!page.contains("<script") && !page.contains("<svg"));
}

#[test]
fn every_element_that_opens_closes() {
    let page = html::render(&sample());
    for name in [
        "html", "head", "body", "main", "section", "table", "tr", "th", "td", "ul", "li",
    ] {
        let opened =
            page.matches(&format!("<{name}>")).count() + page.matches(&format!("<{name} ")).count();
        assert_eq!(
            opened,
            page.matches(&format!("</{name}>")).count(),
            "{name}"
        );
    }
}

#[test]
fn cells_are_shown_with_their_units() {
    let angle = std::f64::consts::FRAC_PI_3;
    assert_eq!(Cell::quantity(angle, SiUnit::RADIAN).shown(), "60°");
    assert_eq!(
        Cell::quantity(0.25, SiUnit::RADIAN.per_second()).shown(),
        "0.25 rad/s"
    );
    assert_eq!(Cell::size(1e9).shown(), "1.0e9");
    assert_eq!(Cell::size(f64::INFINITY).shown(), "infinite");
    assert_eq!(Cell::from(None::<f64>).shown(), "");
}

#[test]
fn values_keep_their_digits_and_names_their_commas() {
    let mut csv = Csv::new(Vec::new(), ["mode", "a,b"]).unwrap();
    let row = [Cell::Empty, Cell::from(-0.0)];
    csv.row(row).unwrap();
    csv.row([Cell::from(2usize), Cell::from(0.1 + 0.2)])
        .unwrap();
    csv.row([Cell::from("say \"x\""), Cell::from(f64::NAN)])
        .unwrap();
    let text = String::from_utf8(csv.finish().unwrap()).unwrap();
    assert_eq!(
        text,
        "mode,\"a,b\"\n,0\n2,0.30000000000000004\n\"say \"\"x\"\"\",\n"
    );
}

/// A report that is what JSON says of it.
struct Said(Value);

impl Report for Said {
    fn document(&self) -> Document {
        Document::new("4-bar", "")
    }
}

impl Serialize for Said {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

#[test]
fn zeros_have_no_sign_however_deep() {
    let report = serde_json::json!({ "a": [-0.0, [-1.5, { "b": -0.0 }]], "c": -0.0 });
    let written: Value = serde_json::from_str(&Said(report).json()).unwrap();
    assert_eq!(written["a"].to_string(), "[0.0,[-1.5,{\"b\":0.0}]]");
    assert_eq!(written["c"].to_string(), "0.0");
}

#[test]
fn numbers_are_as_short_as_six_decimals_allow() {
    assert_eq!(number(0.5), "0.5");
    assert_eq!(number(-1e-17), "0");
    assert_eq!(number(2.0 / 3.0), "0.666667");
    assert_eq!(number(0.000_012_5), "1.2500e-5");
    assert_eq!(number(120.0), "120");
    assert_eq!(quantity(std::f64::consts::FRAC_PI_2, SiUnit::RADIAN), "90°");
    assert_eq!(quantity(3e-14, SiUnit::RADIAN), "0°");
    assert_eq!(quantity(3e-12, SiUnit::RADIAN), "1.7189e-10°");
    assert_eq!(
        [1.23e-16, 0.0, 31.66, 2.5e7].map(|x| Cell::size(x).shown()),
        ["1.2e-16", "0", "31.7", "2.5e7"]
    );
    assert_eq!(quantity(-0.25, SiUnit::METRE), "-0.25 m");
}

fn shown(text: &str) -> String {
    let error = FileError::new("x.ron", text, Mechanism::problems(text));
    diagnostics::render(&error, Style::Plain)
}

#[test]
fn of_a_long_line_the_part_around_the_offending_text_is_shown() {
    let many: String = (0..200).map(|i| format!("\"θ{i}\": {i}, ")).collect();
    let text = format!(
        r#"Mechanism(version: 1, name: "x", parameters: {{ {many}"t": "1 + nothing", "u": 1, "v": 2, "w": "a text longer than what is shown" }})"#
    );
    let shown = shown(&text);
    let lines: Vec<&str> = shown.lines().collect();
    let at = (lines.iter().position(|line| line.contains("1 + nothing"))).unwrap();
    assert!(
        lines[at].contains("| …") && lines[at].ends_with('…'),
        "{shown}"
    );
    assert!(lines[at].chars().count() < 120, "{shown}");
    let before = lines[at].find("nothing").unwrap();
    let column = lines[at][..before].chars().count();
    assert_eq!(
        lines[at + 1].find("^^^^^^^ not known"),
        Some(column),
        "{shown}"
    );
    assert!(shown.contains("= note: at x.ron:1:"), "{shown}");
}

#[test]
fn text_that_begins_or_ends_with_a_long_line_is_not_cut_there() {
    let text = format!("Mechanismus(version: 1, name: \"{}\")", "x".repeat(2500));
    let shown = shown(&text);
    assert!(shown.contains("1 | Mechanismus(version"), "{shown}");
    assert!(shown.contains("xxx…"), "{shown}");
}

#[test]
fn a_file_of_white_space_is_named_and_nothing_of_it_drawn() {
    let shown = shown("   \n\n \n");
    assert!(shown.contains("the file is empty") && shown.contains("= note: in x.ron"));
    assert!(!shown.contains('^') && !shown.contains("1 |"), "{shown}");
}
#[test]
fn numbers_are_written_as_they_would_be_by_hand() {
    let angle = |x: f64| Entry::angle(x).expression.to_string();
    assert_eq!(angle(std::f64::consts::FRAC_PI_2), "90 deg");
    assert_eq!(angle(-std::f64::consts::PI / 3.0), "-60 deg");
    assert_eq!(angle(22.5_f64.to_radians()), "22.5 deg");
    assert_eq!(angle(0.1), "0.1");
    let length = |x: f64| Entry::length(x).expression.to_string();
    assert_eq!(length(0.1 + 0.2), "0.3");
    assert_eq!(length(1.0 / 3.0), "0.3333333333333333");
    assert_eq!(length(-0.0), "0");
}
