//! `linkwork draw`

use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::singularities::SingularitiesSettings;
use linkwork::analysis::sweep::Row;
use linkwork::ask::{Mode, Question, Role};
use linkwork::description::listed;
use linkwork::mechanism::{Configuration, Point};
use linkwork::output::drawing::{DrawingSettings, Panel, Viewpoint, sheet};
use linkwork::output::glb::glb;
use linkwork::output::sweep::sentence;
use linkwork::scene::{Scene, Triple};

use super::output_files::file;
use super::pictures::{keep, view};
use super::question_options::{Forces, Posed, QuestionOptions};
use super::search_options::{SearchArgs, mode};
use super::source::Source;
use super::{Answer, Refusal, lines};

/// Draw the assembled mechanism as SVG, PNG or GLB.
///
/// A planar mechanism is drawn in its plane as a kinematic diagram: pins, sliders in their guides, ground hatched,
/// driven joints filled, gears by their pitch circles. A spatial one is seen isometrically, or from --view.
/// Forces given by --wrench or --load are drawn with the reactions in joints and closures.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork draw mechanisms/four_bar.ron --hold theta1=\"60 deg\" --labels --svg four_bar.svg\n  \
    linkwork draw mechanisms/four_bar.ron --trace left+-1.5,1 --png curve.png\n  \
    linkwork draw mechanisms/three_rps.ron --all-modes --svg modes.svg\n  \
    linkwork draw mechanisms/four_bar.ron --wrench left=0,-10,0 --svg forces.svg\n  \
    linkwork draw mechanisms/stewart_gough_6ups.ron --glb stewart.glb")]
pub struct Draw {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    asked: QuestionOptions,
    /// Draw this mode, numbered as `assemblies` lists it
    #[arg(long, value_name = "NUMBER", value_parser = mode, allow_negative_numbers = true)]
    mode: Option<usize>,
    /// Draw every assembly mode, to one scale
    #[arg(long, conflicts_with = "mode")]
    all_modes: bool,
    /// Draw the other modes faintly behind
    #[arg(long, conflicts_with = "all_modes")]
    ghosts: bool,
    /// Trace a frame's origin, or a point beside it in its axes, e.g. --trace left+0.5,0.2: its path over the whole motion
    /// of a mechanism with one freedom, driven joints moving
    #[arg(long, value_name = "FRAME[+X,Y,Z]")]
    trace: Vec<String>,
    /// Viewpoint: iso, front, top, or azimuth and elevation in degrees, e.g. --view 30,20
    #[arg(long, value_name = "VIEW", value_parser = view, allow_hyphen_values = true)]
    view: Option<Viewpoint>,
    /// Name joints, rods and platforms
    #[arg(long)]
    labels: bool,
    /// Draw the frames with x red, y green, z blue
    #[arg(long)]
    frames: bool,
    /// Draw the range of each joint that has limits
    #[arg(long)]
    limits: bool,
    /// Mark the instant centres of a planar mechanism
    #[arg(long)]
    centres: bool,
    /// Draw the axes of freedoms gained at a singular configuration
    #[arg(long)]
    screws: bool,
    /// Draw the forces, also where only those of the file act
    #[arg(long = "forces")]
    with_forces: bool,
    #[command(flatten)]
    forces: Forces,
    #[command(flatten)]
    search: SearchArgs,
    /// Write the picture as SVG to a file instead of stdout
    #[arg(long, value_name = "FILE", value_parser = file(&["svg"]))]
    svg: Option<PathBuf>,
    /// Write the picture as PNG, at twice the resolution of the SVG
    #[arg(long, value_name = "FILE", value_parser = file(&["png"]))]
    png: Option<PathBuf>,
    /// Write the mechanism as a solid for Blender, presentations and model viewers
    #[arg(long, value_name = "FILE", conflicts_with_all = ["all_modes", "ghosts"], value_parser = file(&["glb"]))]
    glb: Option<PathBuf>,
}

impl Draw {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let mut posed = self.asked.pose(&self.source)?;
        self.search.pose(&mut posed)?;
        posed.spelled(Role::Point, "trace");
        posed.names(Role::Point, &self.trace);
        self.forces.pose(&mut posed);
        posed.mode(self.mode);
        if self.all_modes || self.ghosts {
            posed.ask_with(|question| question.mode(Mode::All));
        }
        let modes = posed.ask(Question::configurations)?;
        let name = posed.loaded.mechanism.name();
        let mut notes = Vec::new();
        let mut scene = |at: &Configuration<f64>| self.scene(&posed, at, &mut notes);
        let panels: Vec<Panel> = match self.ghosts {
            true => {
                let shown = self.mode.unwrap_or(1);
                let main = modes.iter().position(|(mode, _)| *mode == Some(shown));
                let Some(main) = main else {
                    // the question for that mode alone says what is wrong
                    posed.mode(self.mode);
                    posed.ask(Question::configurations)?;
                    return Err(Refusal::error(format!("there is no mode {shown}")));
                };
                let others = modes.iter().enumerate().filter(|(i, _)| *i != main);
                let ghosts = others.map(|(_, (_, at))| Scene::of(&posed.loaded.mechanism, at));
                let (mode, at) = &modes[main];
                vec![Panel {
                    ghosts: ghosts.collect(),
                    ..Panel::new(name, *mode, scene(at)?)
                }]
            }
            false => {
                let panels = modes.iter();
                let panels = panels.map(|(mode, at)| Ok(Panel::new(name, *mode, scene(at)?)));
                panels.collect::<Result<_, Refusal>>()?
            }
        };
        let settings = DrawingSettings {
            view: self.view.unwrap_or_default(),
            labels: self.labels,
        };
        let picture = sheet(&panels, &settings);
        keep(self.svg.as_deref(), || picture.svg().into_bytes())?;
        keep(self.png.as_deref(), || picture.png())?;
        keep(self.glb.as_deref(), || glb(&[panels[0].scene.clone()], 0.0))?;
        let kept = [&self.svg, &self.png, &self.glb].into_iter().flatten();
        let data = match kept.count() {
            0 => picture.svg(),
            _ => String::new(),
        };
        Ok(Answer::yes(data, lines("note", notes)))
    }

    /// A configuration with what is asked for beside it.
    fn scene(
        &self,
        posed: &Posed,
        at: &Configuration<f64>,
        notes: &mut Vec<String>,
    ) -> Result<Scene, Refusal> {
        let mechanism = &posed.loaded.mechanism;
        let mut scene = Scene::of(mechanism, at);
        if !self.limits {
            scene.travels.clear();
        }
        if self.frames {
            scene = scene.with_frames(mechanism, at);
        }
        if !self.trace.is_empty() {
            let mut paths: Vec<Vec<Triple>> = vec![Vec::new(); self.trace.len()];
            let report = posed.ask(|question, watch| {
                let mut sink = |row: &Row| {
                    for (path, point) in paths.iter_mut().zip(row.points) {
                        path.push(*point);
                    }
                };
                question.through(at, &mut sink, watch)
            })?;
            if !report.ending.is_whole() {
                notes.push(sentence(&report));
            }
            for (name, path) in self.trace.iter().zip(paths) {
                // the question has read it
                if let Ok(point) = Point::read(mechanism, name) {
                    scene = scene.with_path(mechanism, at, &point, path);
                }
            }
        }
        let here = posed.question.clone().near(at.clone()).mode(Mode::Nearest);
        let loaded = here.keeping(|of| of.role != Role::Point);
        let here = loaded.keeping(|of| !matches!(of.role, Role::Wrench | Role::Load));
        if self.centres
            && let Some(report) = posed.ask_of(&here, Question::velocity)?.closed()
        {
            scene = scene.with_centres(&report);
        }
        if self.screws {
            let settings = SingularitiesSettings::default();
            let report =
                posed.ask_of(&here, |asked, watch| asked.singularities(&settings, watch))?;
            if let Some(report) = report.closed() {
                scene = scene.with_gained(&report);
            }
        }
        if (self.with_forces || self.forces.are_given())
            && let Some(report) = posed.ask_of(&loaded, Question::statics)?.closed()
        {
            if !report.balanced {
                let moved = listed(&report.unbalanced);
                notes.push(format!("nothing balances the load: {moved} would move"));
            }
            scene = scene.with_forces(mechanism, at, &report);
        }
        Ok(scene)
    }
}
