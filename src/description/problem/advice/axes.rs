//! The words for what is wrong with joint axes.

use crate::description::{AxesProblem, Convention, GROUND};

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
