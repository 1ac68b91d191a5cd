//! Files as texts within other data, as reports carry them: `#[serde(with = "…")]`.

use serde::de::{Deserialize, Deserializer, Error as _};
use serde::ser::{Error as _, Serializer};

use super::problem::titles;

/// A mechanism file.
pub mod mechanism_text {
    use super::*;
    use crate::description::Description;

    /// The text of the file.
    ///
    /// # Errors
    /// If the serializer refuses it.
    pub fn serialize<S: Serializer>(file: &Description, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&file.to_ron().map_err(S::Error::custom)?)
    }

    /// Reads the text of the file.
    ///
    /// # Errors
    /// With what is wrong with the text.
    pub fn deserialize<'de, D: Deserializer<'de>>(reader: D) -> Result<Description, D::Error> {
        let text = String::deserialize(reader)?;
        Description::read(&text).map_err(|problems| D::Error::custom(titles(&problems)))
    }
}

/// A file of joint axes.
pub mod axes_text {
    use super::*;
    use crate::description::AxesDescription;

    /// The text of the file.
    ///
    /// # Errors
    /// If the serializer refuses it.
    pub fn serialize<S: Serializer>(
        file: &AxesDescription,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&file.to_ron().map_err(S::Error::custom)?)
    }

    /// Reads the text of the file.
    ///
    /// # Errors
    /// With what is wrong with the text.
    pub fn deserialize<'de, D: Deserializer<'de>>(reader: D) -> Result<AxesDescription, D::Error> {
        let text = String::deserialize(reader)?;
        AxesDescription::read(&text).map_err(|problems| D::Error::custom(titles(&problems)))
    }
}
