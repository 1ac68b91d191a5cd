//! Schemas of the report types of each command.

use linkwork::analysis::assemblies::{AssembliesReport, LostMode};
use linkwork::analysis::assembly::AssemblyReport;
use linkwork::analysis::compare::CompareReport;
use linkwork::analysis::convert::Conversion;
use linkwork::analysis::design::DesignReport;
use linkwork::analysis::equilibrium::EquilibriumReport;
use linkwork::analysis::formulas::FormulasReport;
use linkwork::analysis::frames::{AxesReport, FramesReport};
use linkwork::analysis::mobility::MobilityReport;
use linkwork::analysis::overview::Overview;
use linkwork::analysis::rounding::Snapped;
use linkwork::analysis::simulation::SimulationReport;
use linkwork::analysis::singularities::{AlongReport, LocusReport, SingularitiesReport};
use linkwork::analysis::statics::StaticsReport;
use linkwork::analysis::sweep::{CircuitsReport, MotionsReport};
use linkwork::analysis::velocity::VelocityReport;
use linkwork::analysis::workspace::WorkspaceReport;
use linkwork::output::schema::{SchemaOf, of as report, schema};
use linkwork::system::Analysed;

/// Reports of a command; none if it has no `--format json`.
fn parts(command: &str) -> &'static [SchemaOf] {
    match command {
        "assemblies" => &[report::<AssembliesReport>],
        "check" => &[report::<Overview>],
        "compare" => &[report::<CompareReport>],
        "convert" => &[report::<Conversion>, report::<AxesReport>],
        "design" => &[report::<DesignReport>],
        "equilibrium" => &[report::<EquilibriumReport>],
        "formulas" => &[report::<FormulasReport>],
        "frames" => &[report::<FramesReport>, report::<AxesReport>],
        "mobility" => &[report::<Analysed<MobilityReport>>],
        "simulate" => &[report::<SimulationReport>],
        "singularities" => &[
            report::<Analysed<SingularitiesReport>>,
            report::<AlongReport>,
            report::<LocusReport>,
        ],
        "snap" => &[report::<Snapped>],
        "solve" => &[report::<AssemblyReport>, report::<LostMode>],
        "statics" => &[report::<Analysed<StaticsReport>>],
        "sweep" => &[report::<MotionsReport>, report::<CircuitsReport>],
        "velocity" => &[report::<Analysed<VelocityReport>>],
        "workspace" => &[report::<WorkspaceReport>],
        _ => &[],
    }
}

/// The schema of a command's JSON; none if no report is named.
pub fn of(command: &str) -> Option<String> {
    let parts = parts(command);
    (!parts.is_empty()).then(|| schema(parts))
}
