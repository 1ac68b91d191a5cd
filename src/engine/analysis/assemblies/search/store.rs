//! Generic solutions as text, so that a later run starts from them.
//!
//! One line says what it is, how many solutions there are and which checksum (CRC-32, ISO 3309) the
//! rest has; the rest is RON. A lost solution would be a lost assembly, so a text that is not as it
//! was written is refused.

use super::solutions::GenericSolutions;
use crate::analysis::assemblies::family::{Family, size, spanning_points};
use crate::analysis::assemblies::track::START;
use crate::mechanism::Mechanism;
use crate::number::mark;
use crate::number::tolerance::ROUNDING;

const TITLE: &str = "linkwork generic solutions, version ";
/// Counts changes of the text and of the meaning of its numbers.
const VERSION: u32 = 6;

/// Errors of stored solutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StoredError {
    /// The text is something else.
    #[error("it is something else")]
    SomethingElse,
    /// The text was written by a linkwork that stores solutions in another form.
    #[error("another version of linkwork wrote them in another form")]
    OtherVersion,
    /// The text was changed or cut short after it was written.
    #[error("they are cut short or changed since they were written")]
    Damaged,
}

impl GenericSolutions {
    /// Reads the text written by [`GenericSolutions::to_text`].
    ///
    /// # Errors
    /// If it is something else, or not as it was written.
    pub fn from_text(text: &str) -> Result<Self, StoredError> {
        let rest = text.strip_prefix(TITLE).ok_or(StoredError::SomethingElse)?;
        let (version, _) = rest.split_once(':').ok_or(StoredError::Damaged)?;
        if version.parse() != Ok(VERSION) {
            return Err(StoredError::OtherVersion);
        }
        let (line, body) = text.split_once('\n').ok_or(StoredError::Damaged)?;
        let stored: Self = ron::from_str(body).map_err(|_| StoredError::Damaged)?;
        match line == title(&stored, body) {
            true => Ok(stored),
            false => Err(StoredError::Damaged),
        }
    }

    /// All digits, as RON below a line with a checksum.
    pub fn to_text(&self) -> String {
        let body = ron::to_string(self).expect("lists of numbers have a RON form") + "\n";
        format!("{}\n{body}", title(self, &body))
    }

    /// True if the generic member is assembled at every solution.
    pub(crate) fn solves(&self, family: &Family) -> bool {
        let member = self.member();
        let Some(mut homotopy) = family.homotopy(&member, &member) else {
            return false;
        };
        // the others are combinations of these
        let shown = spanning_points(&self.legwise, &family.coordinates);
        (shown.iter()).all(|x| homotopy.linearise(START, x) <= ROUNDING * (1.0 + size(x).powi(2)))
    }
}

/// Key of the question that stored solutions belong to: the mechanism's name, and a hash of dimensions and inputs.
pub(crate) fn question(mechanism: &Mechanism, family: &Family) -> String {
    let all = format!(
        "{:?} {:?} {:?} {:?}",
        mechanism.dimensions(),
        mechanism.home(),
        mechanism.parameters(),
        family.coordinates.inputs,
    );
    format!("{} {:016x}", mechanism.name(), mark(&all))
}

fn title(stored: &GenericSolutions, body: &str) -> String {
    format!(
        "{TITLE}{VERSION}: {} solutions, checksum {:08x}",
        stored.count(),
        crc32fast::hash(body.as_bytes())
    )
}
