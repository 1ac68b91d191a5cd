//! What is wrong with a load.

use linkwork::description::listed;
use linkwork::mechanism::Mechanism;
use linkwork::output::complaint::{Complaint, Part};
use linkwork::system::ForceError;

use super::question::{driven_complaint, unknown_frame};

pub fn complaint(mechanism: &Mechanism, error: &ForceError, option: &str) -> Complaint {
    match error {
        ForceError::Value(error) => {
            let said = driven_complaint(error, option);
            // of several components the wrong one is not known here
            match said.part {
                Part::Value(_) if option == "--wrench" => said.at(Part::WholeValue),
                _ => said,
            }
        }
        ForceError::UnknownFrame { name } => unknown_frame(mechanism, name),
        ForceError::OnGround { name, instead } => Complaint::with_help(
            format!("`{name}` does not move: the ground carries any wrench"),
            "on the ground",
            format!("load a body that moves, such as {}", listed(instead)),
        ),
        ForceError::Components { given } => Complaint::with_help(
            format!("a wrench has three or six components, not {given}"),
            "",
            "write Fx,Fy,Fz in N, or Fx,Fy,Fz,Mx,My,Mz with N·m".into(),
        )
        .at(Part::WholeValue),
        ForceError::UnknownJoint {
            name,
            suggestion,
            known,
        } => Complaint::with_help(
            format!("`{name}` is not a joint"),
            "not known",
            match (suggestion, known.is_empty()) {
                (Some(meant), _) => format!("did you mean `{meant}`?"),
                (None, false) => format!("the joints are {}", listed(known)),
                (None, true) => "there are no joints: load a frame with --wrench".into(),
            },
        ),
        ForceError::Platform {
            name,
            platform,
            component,
        } => {
            let mut example = ["0"; 6];
            example[component.unwrap_or(2)] = "1";
            let given = match component {
                Some(3..) => 6,
                _ => 3,
            };
            Complaint::with_help(
                format!("`{name}` is not a joint: a platform is loaded by a wrench"),
                "not a joint",
                format!(
                    "give force and moment on it in ground, e.g. --wrench {platform}={}",
                    example[..given].join(",")
                ),
            )
        }
    }
}
