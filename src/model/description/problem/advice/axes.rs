//! Words for problems of joint axes.

use crate::description::{AxesProblem, Convention, GROUND};

pub(super) fn help(problem: &AxesProblem) -> Option<String> {
    use AxesProblem::*;
    Some(match problem {
        NoDirection { .. } => "give a nonzero vector, or two different points".into(),
        TooFew { .. } => "a table needs at least two axes".into(),
        TwoPlaces { .. } => "give either `point` and `direction`, or `through` two points, or `frame`".into(),
        NotBetween { .. } => {
            "write `between: (\"body\", \"body\")` in all joints or in none".into()
        }
        OneBody { .. } => "name the two bodies that it connects".into(),
        NoGround => format!("the fixed body is called `{GROUND}`; one that floats has `Free(between: (\"{GROUND}\", \"body\"))`"),
        NotConnected { body } => {
            format!("if it floats, add a joint `Free(between: (\"{GROUND}\", \"{body}\"))`")
        }
        UnknownCut {
            suggestion: Some(meant),
            ..
        } => format!("did you mean `{meant}`?"),
        UnknownBody {
            suggestion: Some(meant),
            ..
        } => format!("did you mean `{meant}`?"),
        UnknownBody { .. } => "connect it with others by the `between` of a joint, or leave it out".into(),
        FollowsItself { .. } => "leave out the `value` of one of them: it is then the variable".into(),
        ConstantLost { .. } => {
            "leave it out, or give its value in the drawing, e.g. `drawn: \"0 deg\"`".into()
        }
        Follows { field, by, .. } => format!("leave out `{field}`, or else `{by}`"),
        NotPerpendicular { .. } => "turn one of them, or write two revolute joints with a body between them".into(),
        NotPlaced { .. } => "`check` and all other commands take all kinds of joints".into(),
        ScrewCut { .. } => "cut another joint of its loop".into(),
        CutsOff { .. } => "cut one joint of each loop only".into(),
        StillClosed { joint } => format!("cut `{joint}` too, or leave out `cut` and let the program choose"),
        NothingToCut => "give one joint of each loop `role: Passive`".into(),
        SphericalInSerial { .. } => {
            "write three revolute joints with intersecting axes, or name the bodies that the joints connect".into()
        }
        DriveCut { .. } => "cut another joint of its loop, or drive another joint".into(),
        LimitsCut { .. } => "cut another joint of its loop to keep them".into(),
        BaseUnused {
            convention: Convention::Modified,
        } => "its x axis must intersect the first joint's axis at a right angle, not behind the origin".into(),
        BaseUnused {
            convention: Convention::Standard,
        } => "its z axis must lie on the first joint's axis and point the same way".into(),
        _ => return None,
    })
}
