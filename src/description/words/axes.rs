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
            format!(
                "the joint `{joint}` does not name the bodies that it connects, as other joints do"
            )
        }
        OneBody { body } => format!("the joint connects the body `{body}` with itself"),
        NoGround => format!("no joint connects anything with `{GROUND}`"),
        NotConnected { body } => format!("no joints connect the body `{body}` with `{GROUND}`"),
        UnknownCut { name, .. } => format!("there is no joint `{name}` to cut"),
        CutsOff { joint } => {
            format!("cutting the joint `{joint}` disconnects bodies instead of opening a loop")
        }
        StillClosed { joint } => {
            format!("the cuts leave a closed loop through the joint `{joint}`")
        }
        NothingToCut => "a loop has no joint to cut, because all its joints are driven".into(),
        SerialOnly { field } => {
            format!("`{field}` is for serial chains, but these joints connect named bodies")
        }
        SphericalInSerial { joint } => {
            format!("a serial chain cannot contain the spherical joint `{joint}`")
        }
        TooMany { joints } => format!("there are {joints} joints, more than can be placed"),
        DriveCut { joint } => {
            format!("the driven joint `{joint}` is cut and loses its variable")
        }
        LimitsCut { joint } => {
            format!("the joint `{joint}` is cut and loses its variable and its limits")
        }
        BaseUnused { .. } => "frame 0 cannot be placed as `base` says; it is placed freely".into(),
        FarNormal {
            joints: [first, second],
            angle,
            offset,
            size,
        } => format!(
            "the axes of `{first}` and `{second}` are nearly parallel, {angle:.1e} rad apart: their common normal is \
             {offset:.1e} m away, {:.0e} times the size of the mechanism",
            offset / size
        ),
    }
}

pub(super) fn help(problem: &AxesProblem) -> Option<String> {
    use AxesProblem::*;
    Some(match problem {
        NoDirection { .. } => "give a nonzero vector, or two different points".into(),
        TooFew { .. } => "a table needs at least two axes".into(),
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
        StillClosed { joint } => format!("cut `{joint}` too, or leave out `cut` and let the program choose"),
        NothingToCut => "give one joint of each loop `role: Passive`".into(),
        SphericalInSerial { .. } => {
            "write three revolute joints with intersecting axes, or name the bodies that the joints connect".into()
        }
        DriveCut { .. } => "cut another joint of its loop, or hold another joint with --hold".into(),
        LimitsCut { .. } => "cut another joint of its loop to keep them".into(),
        BaseUnused {
            convention: Convention::Modified,
        } => "its x axis must intersect the first joint's axis at a right angle, not behind the origin".into(),
        BaseUnused {
            convention: Convention::Standard,
        } => "its z axis must lie on the first joint's axis and point the same way".into(),
        FarNormal { .. } => {
            "if they are meant to be parallel, give both the same direction: axes within 1e-7 rad count as parallel".into()
        }
        _ => return None,
    })
}
