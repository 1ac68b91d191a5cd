//! Denavit–Hartenberg tables as LaTeX.

use crate::algebra::Expression;
use crate::analysis::overview::{ChainOverview, EntryOverview, Overview, RowOverview};
use crate::description::Convention;
use crate::output::formulas::{Notation, Script, upright};
use crate::system::FormulaNames;

/// The tables of all chains, each a `tabular` between the rules of booktabs; base and tip of a chain stand above and
/// below its table.
pub fn tables(overview: &Overview, names: &FormulaNames) -> String {
    let notation = Notation::new(names, Script::Latex);
    let name = overview.name.replace(char::is_control, " ");
    let head = format!("% {name}, by linkwork; needs booktabs and amsmath\n");
    let chains = overview.chains.iter();
    let tables = chains.map(|chain| table(&notation, chain));
    head + &tables.collect::<Vec<_>>().join("\n")
}

fn table(notation: &Notation, chain: &ChainOverview) -> String {
    let entry = |entry: &EntryOverview| format!("${}$", written(notation, &entry.written));
    let modified = chain.convention == Convention::Modified;
    let (mut link, joint) = match modified {
        true => (
            vec![r"$\alpha_{i-1}$", "$a_{i-1}$"],
            ["$d_i$", r"$\theta_i$"],
        ),
        false => (vec!["$a_i$", r"$\alpha_i$"], [r"$\theta_i$", "$d_i$"]),
    };
    let tilted = chain.rows.iter().any(|row| row.beta.is_some());
    if tilted {
        link.push(if modified {
            r"$\beta_{i-1}$"
        } else {
            r"$\beta_i$"
        });
    }
    fn ordered<C>(modified: bool, link: Vec<C>, joint: [C; 2]) -> Vec<C> {
        let joint = joint.into();
        let (mut first, second) = if modified {
            (link, joint)
        } else {
            (joint, link)
        };
        first.extend(second);
        first
    }
    let columns = ordered(modified, link, joint);
    let order = |row: &RowOverview| {
        let [alpha, a, d, theta] = [&row.alpha, &row.a, &row.d, &row.theta].map(entry);
        let (mut link, joint) = match modified {
            true => (vec![alpha, a], [d, theta]),
            false => (vec![a, alpha], [theta, d]),
        };
        link.extend(tilted.then(|| row.beta.as_ref().map_or("$0$".into(), entry)));
        ordered(modified, link, joint)
    };
    let on = upright(&chain.on);
    let mut text = format!("Chain ${}$ on ${on}$", upright(&chain.name));
    text += &moved(notation, ", base ", &chain.base);
    text += &moved(notation, ", tip ", &chain.tip);
    text += "\n\n";
    if chain.rows.is_empty() {
        return text;
    }
    let places = "c".repeat(columns.len() + 1);
    text += &format!("\\begin{{tabular}}{{{places}}}\n\\toprule\n");
    text += &format!("$i$ & {} \\\\\n\\midrule\n", columns.join(" & "));
    for (i, row) in (1..).zip(&chain.rows) {
        text += &format!("{i} & {} \\\\\n", order(row).join(" & "));
    }
    text + "\\bottomrule\n\\end{tabular}\n"
}

/// Displacements one after another; nothing if there are none.
fn moved(notation: &Notation, word: &str, by: &[String]) -> String {
    let one = |displacement: &String| {
        let whole = displacement.strip_suffix(')');
        match whole.and_then(|whole| whole.split_once('(')) {
            Some((name, value)) => format!(
                "\\operatorname{{{name}}}\\left({}\\right)",
                written(notation, value)
            ),
            None => upright(displacement),
        }
    };
    let by: Vec<String> = by.iter().map(one).collect();
    match by.is_empty() {
        true => String::new(),
        false => format!("{word}${}$", by.join(" \\, ")),
    }
}

/// An entry as formulas print it.
fn written(notation: &Notation, entry: &str) -> String {
    match Expression::parse(entry) {
        Ok(expression) => notation.print(&expression),
        Err(_) => upright(entry),
    }
}
