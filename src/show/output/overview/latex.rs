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
    let columns = match modified {
        true => r"$\alpha_{i-1}$ & $a_{i-1}$ & $d_i$ & $\theta_i$",
        false => r"$\theta_i$ & $d_i$ & $a_i$ & $\alpha_i$",
    };
    let order = |row: &RowOverview| {
        let [alpha, a, d, theta] = [&row.alpha, &row.a, &row.d, &row.theta].map(entry);
        match modified {
            true => [alpha, a, d, theta],
            false => [theta, d, a, alpha],
        }
    };
    let on = upright(&chain.on);
    let mut text = format!("Chain ${}$ on ${on}$", upright(&chain.name));
    text += &moved(notation, ", base ", &chain.base);
    text += &moved(notation, ", tip ", &chain.tip);
    text += "\n\n";
    if chain.rows.is_empty() {
        return text;
    }
    text += "\\begin{tabular}{ccccc}\n\\toprule\n";
    text += &format!("$i$ & {columns} \\\\\n\\midrule\n");
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
