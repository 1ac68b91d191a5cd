//! What is said beside the answer of a document.

use serde::{Deserialize, Deserializer, Serialize};

/// What is said beside the answer; each is absent where the question is another one.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Remarks {
    /// Why the mobility is not that of Kutzbach's count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub explanation: Option<String>,
    /// How sure it is that no assembly is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub complete: Option<String>,
    /// How sure it is that no singularity or mode is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub completeness: Option<String>,
    /// What outputs that are full poses may hide; `null` if nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[serde(deserialize_with = "present")]
    pub note: Option<Option<String>>,
    /// What repeats what other closures hold already.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub redundant_constraints: Option<Vec<String>>,
}

impl Remarks {
    /// With a note where there is one to be made.
    pub(in crate::output) fn note(note: &Option<String>) -> Self {
        Remarks {
            note: Some(note.clone()),
            ..Remarks::default()
        }
    }
}

/// A field that is there, though it may be `null`.
fn present<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Option<String>>, D::Error> {
    Option::deserialize(from).map(Some)
}
