//! The rows of platforms that are held in part.

use super::layout::measured;
use super::{Held, HoldRow, System, SystemWork, Unknown};
use crate::linear::Factorable;
use crate::mechanism::{Configuration, orientation_rows};
use crate::number::Field;

/// The rows of platforms held in part, with positions from the centre.
pub(crate) fn hold_rows<T: Field>(held: &Held<T>, centre: &[f64; 3]) -> Vec<HoldRow<T>> {
    let mut rows = Vec::new();
    for (platform, held) in held.platforms.iter().enumerate() {
        let reference = held.parts().and_then(|parts| parts.reference);
        rows.extend((held.coordinates().iter()).map(|&(c, value)| {
            HoldRow::Coordinate(platform, c, c.about_centre(value, centre), reference)
        }));
        rows.extend((held.orientation()).map(|wanted| HoldRow::Orientation(platform, wanted)));
        rows.extend(held.spins().iter().copied().map(HoldRow::Spin));
    }
    rows
}

impl<T: Factorable> System<T> {
    /// Evaluates these rows and their derivatives.
    pub(super) fn hold_residuals(&self, at: &Configuration<T>, work: &mut SystemWork<T>) {
        let width = self.empty.shared().len();
        let first = self.hold_rows().start;
        let twist_place = |platform| {
            let unknown = self.place_of(Unknown::first_twist(platform));
            unknown.expect("a partly held platform is unknown") - self.empty.shared()[0]
        };
        let mut row = 0;
        for hold in &self.holds {
            match hold {
                HoldRow::Coordinate(platform, coordinate, value, reference) => {
                    let pose = measured(&at.platforms[*platform].pose(), reference);
                    let (gap, slope) = coordinate.row(&pose, *value, self.length);
                    work.residual[first + row] = gap;
                    let place = row * width + twist_place(*platform);
                    work.hold_rows[place..place + 6].copy_from_slice(&slope);
                }
                HoldRow::Spin(spin) => {
                    let (gap, slope) = spin.row(&at.platforms[spin.platform].orientation);
                    work.residual[first + row] = gap;
                    let place = row * width + twist_place(spin.platform);
                    work.hold_rows[place..place + 3].copy_from_slice(&slope);
                }
                HoldRow::Orientation(platform, wanted) => {
                    let actual = at.platforms[*platform].orientation.rotation();
                    let (gaps, slopes) = orientation_rows(&actual, wanted);
                    for (i, (gap, slope)) in gaps.into_iter().zip(slopes).enumerate() {
                        work.residual[first + row + i] = gap;
                        let place = (row + i) * width + twist_place(*platform);
                        work.hold_rows[place..place + 3].copy_from_slice(&slope.0);
                    }
                }
            }
            row += hold.rows();
        }
    }
}
