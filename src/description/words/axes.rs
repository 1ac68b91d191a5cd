//! The words for what is wrong with joint axes.

use crate::description::{AxesProblem, Convention, GROUND};

pub(super) fn title(problem: &AxesProblem) -> String {
    use AxesProblem::*;
    match problem {
        NoDirection { joint } => format!("the axis of joint `{joint}` has no direction"),
        TooFew { joints: 0 } => "there are no joints".into(),
        TooFew { .. } => "there is only one joint".into(),
        TwoPlaces { .. } => "the axis is given in two ways".into(),
        NotBetween { joint } => {
            format!("nothing says which bodies the joint `{joint}` connects, as others do")
        }
        OneBody { body } => format!("the joint connects the body `{body}` with itself"),
        NoGround => format!("no joint connects anything with `{GROUND}`"),
        NotConnected { body } => format!("no joints connect the body `{body}` with `{GROUND}`"),
        UnknownCut { name, .. } => format!("there is no joint `{name}` to be cut"),
        CutsOff { joint } => {
            format!("cutting the joint `{joint}` takes bodies off instead of opening a loop")
        }
        StillClosed { joint } => {
            format!("the cuts leave a loop closed that goes through the joint `{joint}`")
        }
        NothingToCut => "a loop has no joint to be cut, because all of them are driven".into(),
        SerialOnly { field } => {
            format!("`{field}` is for serial chains, and these joints say what they connect")
        }
        SphericalInSerial { joint } => {
            format!("the spherical joint `{joint}` stands in a serial chain")
        }
        TooMany { joints } => format!("there are {joints} joints, more than are placed"),
        DriveCut { joint } => {
            format!("the driven joint `{joint}` is cut, and so has no variable any more")
        }
        LimitsCut { joint } => {
            format!("the joint `{joint}` is cut, and so has no variable and no limits any more")
        }
        BaseUnused { .. } => "frame 0 cannot stand where `base` says, and is placed freely".into(),
        FarNormal {
            joints: [first, second],
            angle,
            offset,
            size,
        } => format!(
            "the axes of `{first}` and `{second}` are nearly parallel, {angle:.1e} rad apart: their common normal is \
             {offset:.1e} m off, {:.0e} times the size of the mechanism",
            offset / size
        ),
    }
}

pub(super) fn help(problem: &AxesProblem) -> Option<String> {
    use AxesProblem::*;
    Some(match problem {
        NoDirection { .. } => "give a vector that is not zero, or two points that differ".into(),
        TooFew { .. } => "a table between axes needs two of them".into(),
        TwoPlaces { .. } => "give either `point` and `direction`, or `through` two points".into(),
        NotBetween { .. } => {
            "write `between: (\"body\", \"body\")` in all joints or in none".into()
        }
        OneBody { .. } => "name the two bodies that it connects".into(),
        NoGround => format!("the fixed body is called `{GROUND}`"),
        UnknownCut {
            suggestion: Some(meant),
            ..
        } => format!("did you mean `{meant}`?"),
        CutsOff { .. } => "cut one joint of each loop only".into(),
        StillClosed { joint } => format!("cut `{joint}` too, or leave out `cut` to be advised"),
        NothingToCut => "leave one joint of each loop `role: Passive`".into(),
        SphericalInSerial { .. } => {
            "write three revolute joints whose axes meet, or say what the joints connect".into()
        }
        DriveCut { .. } => "cut another joint of its loop, or hold another joint with --hold".into(),
        LimitsCut { .. } => "cut another joint of its loop to keep them".into(),
        BaseUnused {
            convention: Convention::Modified,
        } => "its x axis must meet the first joint's axis at a right angle, and not behind its origin".into(),
        BaseUnused {
            convention: Convention::Standard,
        } => "its z axis must lie on the first joint's axis, the same way".into(),
        FarNormal { .. } => {
            "if they shall be parallel give both the same direction: within 1e-7 rad they are taken as parallel".into()
        }
        _ => return None,
    })
}
