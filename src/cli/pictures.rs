//! View of pictures, and their files.

use std::path::{Path, PathBuf};

use clap::Args;
use linkwork::output::canvas::{Canvas, gif};
use linkwork::output::drawing::{DrawingSettings, Panel, Viewpoint, frames};
use linkwork::output::glb::glb;

use super::Refusal;
use super::output_files::{file, save};

pub fn view(text: &str) -> Result<Viewpoint, String> {
    let angle = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    match text {
        "iso" => Ok(Viewpoint::Isometric),
        "front" => Ok(Viewpoint::Front),
        "top" => Ok(Viewpoint::Top),
        _ => (text.split_once(','))
            .and_then(|(azimuth, elevation)| Some((angle(azimuth)?, angle(elevation)?)))
            .map(|(azimuth, elevation)| {
                Viewpoint::From(azimuth.to_radians(), elevation.to_radians())
            })
            .ok_or_else(|| {
                "a view is `iso`, `front`, `top`, or azimuth and elevation in degrees, as 30,20"
                    .into()
            }),
    }
}

/// Files for pictures of an answer, drawn and moving.
#[derive(Args)]
pub struct Pictures {
    /// Draw the answer to a file: the mechanism in several places with the paths of points, then curves
    #[arg(long, value_name = "FILE", value_parser = file(&["svg"]))]
    svg: Option<PathBuf>,
    /// Write the same picture as PNG, at twice the resolution of the SVG
    #[arg(long, value_name = "FILE", value_parser = file(&["png"]))]
    png: Option<PathBuf>,
    /// Draw the mechanism moving, as an animated GIF of 4 s, there and back if the motion does not close
    #[arg(long, value_name = "FILE", value_parser = file(&["gif"]))]
    animate: Option<PathBuf>,
    /// Write the mechanism moving as a GLB solid for Blender, presentations and model viewers
    #[arg(long, value_name = "FILE", value_parser = file(&["glb"]))]
    glb: Option<PathBuf>,
    /// Viewpoint: iso, front, top, or azimuth and elevation in degrees, e.g. --view 30,20
    #[arg(long, value_name = "VIEW", value_parser = view, allow_hyphen_values = true)]
    pub view: Option<Viewpoint>,
}

impl Pictures {
    pub fn are_wanted(&self) -> bool {
        let files = [&self.svg, &self.png, &self.animate, &self.glb];
        files.into_iter().any(Option::is_some)
    }

    pub fn are_moving(&self) -> bool {
        self.animate.is_some() || self.glb.is_some()
    }

    pub fn settings(&self) -> DrawingSettings {
        DrawingSettings {
            view: self.view.unwrap_or_default(),
            labels: false,
        }
    }

    pub fn keep(
        &self,
        drawn: impl Fn() -> Canvas,
        moving: impl Fn() -> Vec<Panel>,
    ) -> Result<(), Refusal> {
        /// Seconds that an animation lasts.
        const LASTS: f64 = 4.0;
        keep(self.svg.as_deref(), || drawn().svg().into_bytes())?;
        keep(self.png.as_deref(), || drawn().png())?;
        keep(self.glb.as_deref(), || {
            let scenes = moving().into_iter().map(|panel| panel.scene);
            glb(&scenes.collect::<Vec<_>>(), LASTS)
        })?;
        let Some(path) = &self.animate else {
            return Ok(());
        };
        let panels = moving();
        let hundredths = (100.0 * LASTS / panels.len().max(1) as f64).round() as u16;
        let moving = gif(&frames(&panels, &self.settings()), hundredths.max(2));
        let said = |error| format!("{} cannot be written: {error}", path.display());
        save(path, &moving.map_err(|error| Refusal::error(said(error)))?)
    }
}

pub fn keep(path: Option<&Path>, made: impl FnOnce() -> Vec<u8>) -> Result<(), Refusal> {
    path.map_or(Ok(()), |path| save(path, &made()))
}
