//! Formulas as LaTeX: displayed equations, each of which stands alone.

use super::notation::upright;
use super::{Notation, Script, notes, one_line, printed_rows};
use crate::algebra::Expression;
use crate::analysis::formulas::{
    ClosureFormula, FormulasReport, JacobianFormula, TransformFormula,
};

/// Matrices with longer rows are set entry by entry.
const WIDEST: usize = 240;

/// The report as displayed equations `\[…\]` that need amsmath (or KaTeX, or MathJax); what stands between them are comments.
pub fn latex(report: &FormulasReport) -> String {
    let notation = Notation::new(&report.names, Script::Latex);
    let mut text = comment(&format!("{}, by linkwork; needs amsmath", report.mechanism));
    for transform in report.links.iter().chain(&report.transforms) {
        text += &display(transform_of(&notation, transform));
    }
    for closure in &report.closures {
        text += &comment(&format!(
            "closure {}: {} between {} and {}",
            closure.name,
            closure.kind.word(),
            closure.between[0],
            closure.between[1]
        ));
        if let Some(equations) = closure_of(&notation, closure) {
            text += &display(equations);
        }
    }
    for jacobian in &report.jacobians {
        text += &display(jacobian_of(&notation, jacobian));
    }
    notes(report).iter().for_each(|note| text += &comment(note));
    text
}

fn comment(text: &str) -> String {
    format!("% {}\n", one_line(text))
}

fn display(body: String) -> String {
    format!("\\[\n{body}\n\\]\n")
}

fn transform_of(notation: &Notation, transform: &TransformFormula) -> String {
    let [relative_to, of] = [&transform.relative_to, &transform.of].map(|name| upright(name));
    let name = format!("{{}}^{{{relative_to}}}_{{{of}}}T");
    let rows = printed_rows(notation, transform);
    if rows
        .iter()
        .any(|row| row.iter().map(String::len).sum::<usize>() > WIDEST)
    {
        let names = ["r_{#1}", "r_{#2}", "r_{#3}", "p_{@}"];
        let mut lines = Vec::new();
        for (column, name) in names.into_iter().enumerate() {
            for (row, cells) in rows.iter().enumerate() {
                let axis = ["x", "y", "z"][row];
                let name = name.replace('#', &(row + 1).to_string()).replace('@', axis);
                lines.push(format!("{name} &= {}", cells[column]));
            }
        }
        let aligned = lines.join(" \\\\\n");
        return format!("{name}: \\quad \\begin{{aligned}}\n{aligned}\n\\end{{aligned}}");
    }
    let rows = rows.iter().map(|row| row.join(" & ")).collect::<Vec<_>>();
    format!(
        "{name} = \\left[\\begin{{array}}{{ccc|c}}\n{} \\\\\n0 & 0 & 0 & 1\n\\end{{array}}\\right]",
        rows.join(" \\\\\n")
    )
}

fn closure_of(notation: &Notation, closure: &ClosureFormula) -> Option<String> {
    let mut lines: Vec<String> = (closure.equations.iter())
        .map(|equation| format!("{} &= 0", notation.print(equation)))
        .collect();
    if let Some((gap, length)) = &closure.distance {
        for (axis, component) in ["x", "y", "z"].into_iter().zip(gap) {
            lines.push(format!("g_{{{axis}}} &= {}", notation.print(component)));
        }
        let length = notation.print(length);
        lines.push(format!(
            "g_{{x}}^{{2}} + g_{{y}}^{{2}} + g_{{z}}^{{2}} &= \\left({length}\\right)^{{2}}"
        ));
    }
    if closure.same_axes {
        let [a, b] = closure.between.each_ref().map(|name| upright(name));
        lines.push(format!("R_{{{a}}} &= R_{{{b}}}"));
    }
    let aligned = lines.join(" \\\\\n");
    (!lines.is_empty()).then(|| format!("\\begin{{aligned}}\n{aligned}\n\\end{{aligned}}"))
}

fn jacobian_of(notation: &Notation, jacobian: &JacobianFormula) -> String {
    let JacobianFormula {
        of,
        relative_to,
        columns,
    } = jacobian;
    let name = format!("{{}}^{{{}}}J_{{{}}}", upright(relative_to), upright(of));
    let print = |e: &Expression| notation.print(e);
    let entries: Vec<Vec<String>> = (columns.iter())
        .map(|c| c.velocity.iter().chain(&c.omega).map(print).collect())
        .collect();
    let rows: Vec<String> = (0..6)
        .map(|row| {
            entries
                .iter()
                .map(|column| column[row].clone())
                .collect::<Vec<_>>()
        })
        .map(|row| row.join(" & "))
        .collect();
    if rows.iter().all(|row| row.len() <= WIDEST) {
        let kind = "c".repeat(columns.len());
        return format!(
            "{name} = \\left[\\begin{{array}}{{{kind}}}\n{}\n\\end{{array}}\\right]",
            rows.join(" \\\\\n")
        );
    }
    let mut lines = Vec::new();
    for (column, entries) in columns.iter().zip(&entries) {
        let joint = notation.name(&column.joint);
        for (i, entry) in entries.iter().enumerate() {
            let letter = if i < 3 { "v" } else { "\\omega" };
            let axis = ["x", "y", "z"][i % 3];
            lines.push(format!("{letter}_{{{axis}}}^{{({joint})}} &= {entry}"));
        }
    }
    let aligned = lines.join(" \\\\\n");
    format!("{name}: \\quad \\begin{{aligned}}\n{aligned}\n\\end{{aligned}}")
}
