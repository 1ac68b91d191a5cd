//! JSON Schemas of reports (draft 2020-12), made of their types and docs.

use std::borrow::Cow;
use std::collections::BTreeMap;

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

use super::json::AnswerJson;
use crate::algebra::{Expression, SiUnit};
use crate::analysis::workspace::Cells;
use crate::system::Named;

/// A report as part of a schema: [`of`] its type.
pub type SchemaOf = fn(&mut SchemaGenerator) -> Schema;

/// The JSON of a command that answers with this report.
pub fn of<R: JsonSchema>(generator: &mut SchemaGenerator) -> Schema {
    generator.subschema_for::<AnswerJson<R>>()
}

/// The schema of a command that answers with one of these reports.
pub fn schema(parts: &[SchemaOf]) -> String {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let mut generator = settings.into_generator();
    let parts: Vec<Schema> = parts.iter().map(|part| part(&mut generator)).collect();
    let schema = json_schema!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "anyOf": parts,
        "$defs": generator.take_definitions(true),
    });
    format!("{:#}\n", schema.as_value())
}

/// Types written as others are, or as a schema of their own says.
macro_rules! written {
    ($($Type:ident $(<$T:ident>)? => $as:ty;)+) => {$(
        impl $(<$T: JsonSchema>)? JsonSchema for $Type $(<$T>)? {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($Type).into()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                <$as>::json_schema(generator)
            }
        }
    )+};
}

written! {
    SiUnit => String;
    Named<T> => BTreeMap<String, T>;
}

/// A number, or an expression as text.
impl<N> JsonSchema for Expression<N> {
    fn schema_name() -> Cow<'static, str> {
        "Expression".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": ["number", "string"] })
    }
}

/// Columns by name, and rows with a value or `null` in each.
impl JsonSchema for Cells {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Cells".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let row = json_schema!({ "type": "array", "items": { "type": ["number", "null"] } });
        json_schema!({
            "type": "object",
            "properties": {
                "columns": { "type": "array", "items": { "type": "string" } },
                "values": { "type": "array", "items": row },
            },
            "required": ["columns", "values"],
        })
    }
}
