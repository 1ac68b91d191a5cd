//! Designs drawn: with their targets and the curves of their points, moving, and in the plane of two goals.

use crate::analysis::design::{DesignReport, FoundDesign, Goal};
use crate::ask::DrawnDesign;
use crate::output::canvas::Canvas;
use crate::output::drawing::Panel;
use crate::output::plot::{LineChart, Series, label, stacked};
use crate::output::quantity::shown;
use crate::output::sweep::DrawnCourse;
use crate::scene::{Mark, Scene, Trace};

/// A design in its first position.
pub fn panel(drawn: &DrawnDesign) -> Panel {
    of(drawn, Scene::of(&drawn.mechanism, &drawn.at))
}

/// A design along its motion, there and back again where that does not end where it began.
pub fn panels_moving(drawn: &DrawnDesign) -> Vec<Panel> {
    let mut course = DrawnCourse::of(std::iter::empty());
    drawn.moving.iter().for_each(|at| course.take(None, at));
    let scenes = course.scenes(&drawn.mechanism).into_iter();
    scenes.map(|(_, scene)| of(drawn, scene)).collect()
}

/// A place of a design with its targets and the curves of its points.
fn of(drawn: &DrawnDesign, mut scene: Scene) -> Panel {
    let curves = drawn.curves.iter().cloned();
    scene.paths = curves
        .map(|(name, points)| Trace { name, points })
        .collect();
    let mark = |&(k, at): &(usize, _)| Mark {
        name: k.to_string(),
        at,
    };
    scene.centres = drawn.targets.iter().map(mark).collect();
    Panel::new(drawn.mechanism.name(), None, scene)
}

/// The designs without defects in the plane of two goals; `None` where there are not two.
pub fn front(report: &DesignReport) -> Option<Canvas> {
    let (first, second) = (report.goal.as_ref()?, report.second_goal.as_ref()?);
    let axis = |of: &Goal| label(&of.figure, of.unit);
    let good = report.designs.iter().filter(|of| of.defects.is_empty());
    let at = |of: &FoundDesign| {
        Some((
            shown(of.goal?, first.unit),
            shown(of.second_goal?, second.unit),
        ))
    };
    let points = good.filter_map(at);
    Some(stacked(&[LineChart {
        title: format!(
            "{}: designs of which none is beaten in both",
            report.mechanism
        ),
        x: axis(first),
        y: axis(second),
        marks: vec![Series::new("design", points)],
        ..LineChart::default()
    }]))
}
