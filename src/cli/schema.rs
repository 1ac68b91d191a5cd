//! `--schema`: the form of each command's JSON.

use linkwork::analysis::assemblies::{AssembliesReport, LostMode};
use linkwork::analysis::assembly::AssemblyReport;
use linkwork::analysis::compare::CompareReport;
use linkwork::analysis::convert::Conversion;
use linkwork::analysis::formulas::FormulasReport;
use linkwork::analysis::frames::{AxesReport, FramesReport};
use linkwork::analysis::mobility::MobilityReport;
use linkwork::analysis::overview::Overview;
use linkwork::analysis::rounding::Snap;
use linkwork::analysis::singularities::{AlongReport, LocusReport, SingularitiesReport};
use linkwork::analysis::statics::StaticsReport;
use linkwork::analysis::sweep::{CircuitsReport, MotionsReport};
use linkwork::analysis::velocity::VelocityReport;
use linkwork::analysis::workspace::WorkspaceReport;
use linkwork::output::schema::{Part, of, schema};
use linkwork::system::Analysed;

/// Reports of a command; none if it has no `--format json`.
fn parts(command: &str) -> &'static [Part] {
    match command {
        "assemblies" => &[of::<AssembliesReport>],
        "check" => &[of::<Overview>],
        "compare" => &[of::<CompareReport>],
        "convert" => &[of::<Conversion>, of::<AxesReport>],
        "formulas" => &[of::<FormulasReport>],
        "frames" => &[of::<FramesReport>, of::<AxesReport>],
        "mobility" => &[of::<Analysed<MobilityReport>>],
        "singularities" => &[
            of::<Analysed<SingularitiesReport>>,
            of::<AlongReport>,
            of::<LocusReport>,
        ],
        "snap" => &[of::<Snap>],
        "solve" => &[of::<AssemblyReport>, of::<LostMode>],
        "statics" => &[of::<Analysed<StaticsReport>>],
        "sweep" => &[of::<MotionsReport>, of::<CircuitsReport>],
        "velocity" => &[of::<Analysed<VelocityReport>>],
        "workspace" => &[of::<WorkspaceReport>],
        _ => &[],
    }
}

pub fn has_one(command: &str) -> bool {
    !parts(command).is_empty()
}

/// The schema as text.
pub fn written(command: &str) -> String {
    schema(parts(command))
}
