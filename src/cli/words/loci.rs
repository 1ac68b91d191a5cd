//! Questions about singularities that make no sense: what to ask instead.

use linkwork::description::{count, nearest};
use linkwork::mechanism::Mechanism;
use linkwork::output::complaint::{Complaint, Part};

/// A side of a box without a range.
pub fn no_side(name: &str) -> Complaint {
    let said = Complaint::with_help(
        format!("the side `{name}` of the box has no range"),
        "no range",
        format!("write --locus {name}=FROM..TO, e.g. --locus {name}=0deg..360deg"),
    );
    said.at(Part::WholeValue)
}

/// A box without an inside.
pub fn empty_side(name: &str) -> Complaint {
    let said = Complaint::with_help(
        format!("the box is empty: the range of `{name}` does not end above its beginning"),
        "empty",
        "write the lower end first; for one value hold it with --hold, and for singularities along \
         the other coordinate use --input"
            .into(),
    );
    said.at(Part::WholeValue)
}

/// Not two coordinates for a locus.
pub fn not_two_sides(given: usize) -> Complaint {
    let help = match given {
        1 => "for singularities along one coordinate use --input NAME=FROM..TO",
        _ => "hold the others with --hold",
    };
    Complaint::with_help(
        format!(
            "a locus is a curve in two coordinates, and {} given",
            match given {
                1 => "1 is".to_owned(),
                n => format!("{n} are"),
            }
        ),
        "",
        format!("give --locus twice, e.g. --locus a=0..1 --locus b=0..1; {help}"),
    )
}

/// Nothing can be driven.
pub fn nothing_to_drive() -> Complaint {
    Complaint::with_help(
        "nothing is driven: singularities are defined with respect to inputs".into(),
        "",
        "hold the driven joints with --hold; `linkwork mobility` shows whether a mechanism without \
         freedoms is infinitesimally flexible"
            .into(),
    )
}

/// Links spin about their own lines, and no joint tells how far.
pub fn spinning(spins: usize) -> Complaint {
    Complaint::with_help(
        format!(
            "{} of the mechanism remain whatever the inputs do: links that spin about their own axes",
            count(spins, "freedom")
        ),
        "",
        "a locus needs a unique motion, and these links have no joint of their own that could be held: \
         write legs between two ball joints as `Distance` closures"
            .into(),
    )
}

/// An output that is neither a joint, a coordinate nor a frame.
pub fn unknown_output(mechanism: &Mechanism, name: &str) -> Complaint {
    let frames = mechanism.frames().into_iter();
    let mut known: Vec<String> = frames.map(|frame| mechanism.frame_name(frame)).collect();
    known.extend(mechanism.joints().iter().map(|joint| joint.name.clone()));
    let help = match nearest(name, known.iter().map(String::as_str)) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => "an output is a joint, a platform coordinate such as `top.x`, or a frame".into(),
    };
    Complaint::with_help(format!("`{name}` is not an output"), "not known", help)
}
