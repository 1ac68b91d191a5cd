//! Options as help shows them: the command's own first, then by subject, those that are rarely needed last.

use clap::{Arg, ArgAction, Command};

use super::schema;

/// Subjects and their options, by the names of their fields.
const SUBJECTS: [(&str, &[&str]); 4] = [
    (
        "Configuration",
        &["hold", "free", "guess", "mode", "all_modes", "lock"],
    ),
    ("Forces", &["wrench", "load"]),
    (
        "Answer",
        &[
            "format", "latex", "unicode", "ron", "rust", "svg", "png", "animate", "glb", "front",
            "view", "labels", "output",
        ],
    ),
    (
        "Rarely needed",
        &[
            "tolerance",
            "searched",
            "starts",
            "boxes",
            "seed",
            "store",
            "max_bytes",
            "schema",
        ],
    ),
];

/// The commands with their options under headings, and with `--schema` where there is JSON.
pub fn arranged(program: Command) -> Command {
    program.mut_subcommands(|command| {
        let mut command = match schema::has_one(command.get_name()) {
            true => command.arg(
                Arg::new("schema")
                    .long("schema")
                    .action(ArgAction::SetTrue)
                    .exclusive(true)
                    .help("Print the JSON Schema of what --format json writes, without a FILE"),
            ),
            false => command,
        };
        for (subject, options) in SUBJECTS {
            for option in options {
                if command.get_arguments().any(|of| of.get_id() == option) {
                    // moved to the end, as the order of the options is that of the headings
                    command = command.mut_arg(option, |of| of.help_heading(subject));
                }
            }
        }
        command
    })
}
