//! `linkwork draw`

use std::path::PathBuf;

use clap::Args;
use linkwork::ask::{Mode, Question};
use linkwork::output::drawing::{DrawingSettings, View, svg};
use linkwork::scene::Scene;

use super::asked::Asked;
use super::search::{Search, mode};
use super::source::Source;
use super::written::written;
use super::{Answer, Refusal};

/// Draw the assembled mechanism as SVG.
///
/// A planar mechanism is drawn in its plane as a kinematic diagram: pins, sliders in their guides, ground hatched,
/// driven joints filled. A spatial one is seen isometrically, or from where --view says.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork draw mechanisms/four_bar.ron --hold theta1=\"60 deg\" --labels --svg four_bar.svg\n  \
    linkwork draw mechanisms/three_rps.ron --all-modes --svg modes.svg")]
pub struct Draw {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    asked: Asked,
    /// Draw this mode, numbered as `assemblies` lists it
    #[arg(long, value_name = "NUMBER", value_parser = mode, allow_negative_numbers = true)]
    mode: Option<usize>,
    /// Draw every assembly mode, to one scale
    #[arg(long, conflicts_with = "mode")]
    all_modes: bool,
    /// From where: iso, front, top, or azimuth and elevation in degrees, e.g. --view 30,20
    #[arg(long, value_name = "VIEW", value_parser = view, allow_hyphen_values = true)]
    view: Option<View>,
    /// Name joints, rods and platforms
    #[arg(long)]
    labels: bool,
    #[command(flatten)]
    search: Search,
    /// Write the picture to a file, not to stdout
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

fn view(text: &str) -> Result<View, String> {
    let angle = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    match text {
        "iso" => Ok(View::Isometric),
        "front" => Ok(View::Front),
        "top" => Ok(View::Top),
        _ => (text.split_once(','))
            .and_then(|(azimuth, elevation)| Some((angle(azimuth)?, angle(elevation)?)))
            .map(|(azimuth, elevation)| View::From(azimuth.to_radians(), elevation.to_radians()))
            .ok_or_else(|| {
                "a view is `iso`, `front`, `top`, or azimuth and elevation in degrees, as 30,20"
                    .into()
            }),
    }
}

impl Draw {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let mut posed = self.asked.pose(&self.source)?;
        self.search.pose(&mut posed)?;
        posed.mode(self.mode);
        if self.all_modes {
            posed.ask_with(|question| question.mode(Mode::All));
        }
        let modes = posed.ask(Question::configurations)?;
        let mechanism = &posed.loaded.mechanism;
        let scenes: Vec<(String, Scene)> = (modes.iter())
            .map(|(mode, at)| {
                let title = match mode {
                    Some(mode) => format!("{}: mode {mode}", mechanism.name()),
                    None => mechanism.name().to_owned(),
                };
                (title, Scene::of(mechanism, at))
            })
            .collect();
        let settings = DrawingSettings {
            view: self.view.unwrap_or_default(),
            labels: self.labels,
        };
        Ok(Answer {
            data: written(svg(&scenes, &settings), self.svg.as_deref())?,
            remarks: String::new(),
            yes: true,
        })
    }
}
