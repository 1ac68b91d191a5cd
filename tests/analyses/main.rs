//! The other analyses, each against closed forms and published values.

mod bodies;
mod circuits;
mod closed_form;
mod closed_reports;
mod closing;
mod commands;
mod compared;
mod comparison;
mod conversion;
mod cusps;
mod cut_joints;
mod cycles;
mod cylinders;
mod design;
mod formulas;
mod four_bars;
mod frames;
mod gimbal_lock;
mod lengths;
mod let_go;
mod loads;
mod many;
mod mobility;
mod modes;
mod nine_points;
mod printed_solutions;
mod quantities;
mod rank;
mod refused;
mod reports;
mod rounding;
mod singularities;
mod spins;
mod statics;
mod steering;
mod stretched;
mod studies;
mod suspension;
mod sweep;
mod synthesis;
mod turns;
mod velocity;
mod watched;
mod whole_motions;
mod workspace;

/// The exit status of a command, its output and its messages.
fn linkwork(arguments: &[&str]) -> (i32, String, String) {
    let output = assert_cmd::Command::cargo_bin("linkwork")
        .unwrap()
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (
        output.status.code().unwrap(),
        text(output.stdout),
        text(output.stderr),
    )
}
