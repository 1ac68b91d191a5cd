//! `--schema`: the form of each command's JSON.

#[cfg(feature = "schema")]
mod generated;

/// Schemas as the feature `schema` generates them; built with it, the program prints those of its own types instead.
macro_rules! shipped {
    ($($command:literal)+) => {
        const SHIPPED: &[(&str, &str)] =
            &[$(($command, include_str!(concat!("schemas/", $command, ".json")))),+];
    };
}

shipped! {
    "assemblies" "check" "compare" "convert" "design" "equilibrium" "formulas" "frames" "mobility"
    "simulate" "singularities" "snap" "solve" "statics" "sweep" "velocity" "workspace"
}

/// True for commands with `--format json`.
pub fn has_one(command: &str) -> bool {
    SHIPPED.iter().any(|(name, _)| *name == command)
}

/// The schema of a command's JSON; none if it has no `--format json`.
pub fn of(command: &str) -> Option<String> {
    #[cfg(feature = "schema")]
    if let Some(schema) = generated::of(command) {
        return Some(schema);
    }
    let (_, text) = SHIPPED.iter().find(|(name, _)| *name == command)?;
    let schema: serde_json::Value = serde_json::from_str(text).expect("written by serde_json");
    Some(format!("{schema:#}\n"))
}
