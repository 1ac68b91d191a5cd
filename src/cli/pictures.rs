//! View of pictures, and their files.

use std::path::Path;

use linkwork::output::drawing::Viewpoint;

use super::Refusal;
use super::written::save;

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

/// Seconds that an animation lasts.
pub const LASTS: f64 = 4.0;

pub fn keep(path: Option<&Path>, made: impl FnOnce() -> Vec<u8>) -> Result<(), Refusal> {
    path.map_or(Ok(()), |path| save(path, &made()))
}
