//! A comparison of closed forms with the chains as a document.

use super::document::{Document, Section, Table, TableOf};
use super::formulas::{Notation, Script};
use super::quantity::{form, quantity, size, values as values_of, with_unit};
use super::report::Report;
use crate::algebra::SiUnit;
use crate::analysis::compare::{
    CompareReport, ComponentReport, Difference, FormReport, Proof, Quantity, Reason, Verdict,
};
use crate::description::count;

impl Report for CompareReport {
    fn document(&self) -> Document {
        if self.closed_forms.is_empty() {
            return Document::new(&self.mechanism, "The file has no closed forms to compare.");
        }
        let notation = Notation::new(&self.names, Script::Unicode);
        let not_assembled = (self.not_assembled > 0).then(|| {
            format!(
                "no assembled configuration was found at {}, which were left out",
                count(self.not_assembled, "random input")
            )
        });
        let home = (!self.home_assembles)
            .then(|| "the mechanism cannot be assembled from its home configuration".to_owned());
        let remarks = self.closed_forms.iter().flat_map(|form| {
            let components = form.components.iter();
            let remarks = components.flat_map(|component| remark(self, form, component));
            exact(&notation, form).into_iter().chain(remarks)
        });
        let title = "Closed forms compared with the chains";
        Document::new(&self.mechanism, sentence(self) + &proved(self))
            .interrupted(self.interrupted, "samples and proofs")
            .notes(home)
            .section(Section::new(title).table(table(self)).text(units(self)))
            .section(Section::new("Differences").list(remarks))
            .notes(not_assembled)
    }

    fn is_yes(&self) -> bool {
        self.agree
    }
}

/// How many forms are proved, if any.
fn proved(report: &CompareReport) -> String {
    let forms = &report.closed_forms;
    let all = forms.len();
    let proved = |form: &&FormReport| form.components.iter().all(|c| c.proof.proved());
    let special = |form: &&FormReport| {
        use Proof::{FollowsForTheseDimensions, IdenticalForTheseDimensions};
        let mut proofs = form.components.iter().map(|component| &component.proof);
        proofs.any(|p| matches!(p, IdenticalForTheseDimensions | FollowsForTheseDimensions))
    };
    let number = forms.iter().filter(proved).count();
    let only = match forms.iter().filter(proved).filter(special).count() {
        0 => String::new(),
        n if n == number => " for these dimensions only".into(),
        n => format!(", {n} of them for these dimensions only"),
    };
    match (number, all) {
        (0, _) => String::new(),
        (1, 1) => format!(" It is proved{only}."),
        (n, all) if n == all => format!(" All are proved{only}."),
        (1, _) => format!(" 1 is proved{only}."),
        (n, _) => format!(" {n} are proved{only}."),
    }
}

fn table(report: &CompareReport) -> TableOf<&FormReport> {
    Table::of(&report.closed_forms)
        .words("form", |form| form.name.as_str())
        .numbers("components", |form| form.components.len())
        .numbers("samples", |form| form.samples)
        .words("largest difference", largest)
        .words("verdict", |form| match form.verdict {
            Verdict::Agrees => "agrees",
            Verdict::Disagrees => "disagrees",
            Verdict::NotTried => "not tried",
        })
        .words("proof", proof)
        .words("source", |form| form.source.as_deref())
}

const QUANTITIES: [Quantity; 3] = [Quantity::Position, Quantity::Rotation, Quantity::Identity];

/// The largest difference of each kind of component, for they have different units.
fn largest(form: &FormReport) -> String {
    let of = |quantity: Quantity| {
        let tried = form.components.iter();
        let tried = tried.filter(|c| c.samples > 0 && c.quantity == quantity);
        let largest = tried.map(|c| c.max_difference).reduce(f64::max)?;
        let place = match quantity {
            Quantity::Rotation => " in R",
            Quantity::Position | Quantity::Identity => "",
        };
        Some(with_unit(&size(largest), unit(quantity)) + place)
    };
    let parts: Vec<String> = QUANTITIES.into_iter().filter_map(of).collect();
    match parts.is_empty() {
        true => "-".into(),
        false => parts.join(", "),
    }
}

/// What the numbers without unit mean, if there are any.
fn units(report: &CompareReport) -> String {
    let tried = |quantity| {
        let components = report.closed_forms.iter().flat_map(|form| &form.components);
        let mut tried = components.filter(|component| component.samples > 0);
        tried.any(|component| component.quantity == quantity)
    };
    let mut units = Vec::new();
    if tried(Quantity::Rotation) {
        units.push("in R, of entries of rotation matrices, have no unit");
    }
    if tried(Quantity::Identity) {
        units.push("of identities have the unit of their formula");
    }
    match units.is_empty() {
        true => String::new(),
        false => format!("Differences {}.", units.join("; those ")),
    }
}

fn unit(quantity: Quantity) -> SiUnit {
    match quantity {
        Quantity::Position => SiUnit::METRE,
        Quantity::Rotation | Quantity::Identity => SiUnit::ONE,
    }
}

/// What was proved of a form as a whole: the least that was proved of its components.
fn proof(form: &FormReport) -> &'static str {
    let proofs = || form.components.iter().map(|component| &component.proof);
    if proofs().any(|proof| matches!(proof, Proof::Different(_))) {
        return "refuted";
    }
    match proofs().filter(|proof| proof.proved()).count() {
        0 => "not proved",
        n if n < form.components.len() => "in part",
        _ if proofs().any(|proof| *proof == Proof::FollowsForTheseDimensions) => {
            "from closures, for these dimensions"
        }
        _ if proofs().any(|proof| *proof == Proof::IdenticalForTheseDimensions) => {
            "for these dimensions"
        }
        _ if proofs().any(|proof| *proof == Proof::FollowsFromClosures) => "from closures",
        _ => "identical",
    }
}

/// The exact difference of every component that has one, and why others are not decided.
fn exact(notation: &Notation, form: &FormReport) -> Vec<String> {
    let mut lines = Vec::new();
    let mut undecided: Vec<(Reason, Vec<&str>)> = Vec::new();
    for component in &form.components {
        match &component.proof {
            Proof::Different(difference) => {
                let Difference {
                    closed_form,
                    chains,
                    difference,
                } = &**difference;
                let print = |expression| notation.print(expression);
                let (own, theirs) = (print(closed_form), print(chains));
                let place = format!("{}, {}", form.name, component.name);
                let given = match component.quantity {
                    Quantity::Identity => "the closures give",
                    _ => "the chains give",
                };
                let whole = closed_form == difference && component.quantity == Quantity::Identity;
                let mut line = match (closed_form.is_zero(), chains.is_zero()) {
                    (false, true) if whole => {
                        format!("{place}: the form has {own} where the closures give 0")
                    }
                    (false, true) => {
                        format!("{place}: the form has {own}, which is not in the chains")
                    }
                    (true, false) => format!("{place}: the form lacks {theirs}"),
                    _ => format!("{place}: the form has {own} where {given} {theirs}"),
                };
                line += &format!("; difference {}.", print(difference));
                if component.agree {
                    line += " The difference is below the tolerance of the numerical comparison.";
                }
                lines.push(line);
            }
            Proof::NotDecided { reason } => {
                match undecided.iter_mut().find(|(own, _)| own == reason) {
                    Some((_, names)) => names.push(&component.name),
                    None => undecided.push((*reason, vec![&component.name])),
                }
            }
            _ => {}
        }
    }
    for (reason, names) in undecided {
        lines.push(format!(
            "{}, {}: not proved, because {}; it was compared numerically only.",
            form.name,
            names.join(", "),
            why(reason)
        ));
    }
    lines
}

fn why(reason: Reason) -> &'static str {
    match reason {
        Reason::NotPolynomial => {
            "it contains roots or inverse functions, or angles that are no multiples of 15 deg"
        }
        Reason::NeedsElimination => {
            "it holds only when assembled and is not a linear combination of the closure equations"
        }
        Reason::NeedsPlatform => "it depends on the pose of a platform when assembled",
        Reason::TooLong => "it is too long to be expanded",
        Reason::Interrupted => "the work was interrupted",
    }
}

/// The remarks on a component that does not simply agree; none on others.
fn remark(report: &CompareReport, form: &FormReport, component: &ComponentReport) -> Vec<String> {
    let ComponentReport {
        name,
        quantity,
        samples,
        without_value,
        max_difference,
        ..
    } = component;
    let form = &form.name;
    if *samples == 0 {
        return vec![match without_value {
            0 => format!("{form}, {name}: not tried, as no assembled configuration was found."),
            _ => format!("{form}, {name}: has no value at any of {without_value} samples."),
        }];
    }
    let mut lines = Vec::new();
    if let Some(worst) = component.worst.as_ref().filter(|_| !component.agree) {
        let six = |value: f64| with_unit(&format!("{value:.6}"), unit(*quantity));
        let (own, theirs) = (six(worst.closed_form), six(worst.chains));
        let values = match quantity {
            Quantity::Identity => format!("it is {own}, not zero,"),
            _ => format!("the form gives {own}, the chains {theirs},"),
        };
        let joints = values_of(&report.names.joints, worst.joints.values());
        lines.push(format!(
            "{form}, {name}: differs by up to {}: {values} at {}.",
            self::quantity(*max_difference, unit(*quantity)),
            joints.join(", ")
        ));
    }
    if *without_value > 0 {
        let of = samples + without_value;
        lines.push(format!(
            "{form}, {name}: has no value at {without_value} of {of} samples."
        ));
    }
    lines
}

fn sentence(report: &CompareReport) -> String {
    let forms = &report.closed_forms;
    let having = |verdict: Verdict| forms.iter().filter(|form| form.verdict == verdict).count();
    let (disagree, untried) = (having(Verdict::Disagrees), having(Verdict::NotTried));
    let all = count(forms.len(), "closed form");
    let verb = form(disagree, "disagrees", "disagree");
    let outcome = match (disagree, untried, forms.len()) {
        (0, 0, 1) => "The closed form agrees with the chains".into(),
        (0, 0, 2) => "Both closed forms agree with the chains".into(),
        (0, 0, _) => format!("All {all} agree with the chains"),
        (0, ..) => format!("{untried} of {all} could not be tried"),
        (_, 0, _) => format!("{disagree} of {all} {verb} with the chains"),
        _ => format!("{disagree} of {all} {verb} with the chains, {untried} could not be tried"),
    };
    format!("{outcome} (seed {}).", report.seed)
}
