//! Masses, shapes and inertias from a file.

use super::*;

impl Reading<'_> {
    pub(super) fn mass(&mut self, name: &Spanned<String>, file: &MassDescription) -> Option<Mass> {
        let owned = || name.value.clone();
        let point = self.point(name)?;
        if self.mechanism.body(point.frame) == Body::Ground {
            self.note(LoadProblem::OnGround { name: owned() }, &name.span);
            return None;
        }
        let centre = file.centre.as_ref();
        let centre = centre.map_or([0.0; 3], |of| {
            of.each_ref().map(|x| self.number(x, SiUnit::METRE))
        });
        let offset = std::array::from_fn(|i| point.offset[i] + centre[i]);
        let given = file.mass.as_ref();
        let given = given.map(|mass| self.positive(mass, SiUnit::KILOGRAM, "the mass"));
        let shape = file.shape.as_ref().map(|shape| self.shape(shape));
        let mass = match (given, &file.density, &shape) {
            (Some(_), Some(density), _) => {
                let fields = "mass and density";
                let name = owned();
                self.note(LoadProblem::Twice { name, fields }, &density.span);
                return None;
            }
            (Some(mass), None, _) => mass,
            (None, Some(density), Some((_, volume, dimensions))) => {
                let lengths = SiUnit::METRE.powi(-dimensions).expect("at most three");
                let unit = SiUnit::KILOGRAM.times(lengths);
                self.positive(density, unit, "the density") * volume
            }
            (None, ..) => {
                self.note(LoadProblem::NoMass { name: owned() }, &file.span);
                return None;
            }
        };
        if let (Some(_), Some(inertia)) = (&shape, &file.inertia) {
            let fields = "shape and inertia";
            let (name, first) = (owned(), &inertia.0[0].span);
            self.note(LoadProblem::Twice { name, fields }, first);
        }
        let tensor = match (&file.inertia, shape) {
            (Some(inertia), _) => self.inertia(inertia),
            (None, Some(([x, y, z], ..))) => {
                [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]].map(|row| row.map(|of| of * mass))
            }
            (None, None) => [[0.0; 3]; 3],
        };
        let turn = self.turn(&file.turned);
        Some(Mass {
            name: owned(),
            centre: Point {
                frame: point.frame,
                offset,
            },
            mass,
            inertia: turn.turned_tensor(&tensor),
        })
    }

    /// Radii of gyration squared along x, y and z, the volume, area or length, and its dimension.
    fn shape(&mut self, shape: &ShapeDescription) -> ([f64; 3], f64, i32) {
        let sizes = shape.sizes.iter();
        let sizes: Vec<f64> = sizes
            .map(|size| self.positive(size, SiUnit::METRE, "a dimension"))
            .collect();
        let third = |x: f64| x * x / 12.0;
        match (shape.kind, &sizes[..]) {
            (Shape::Rod, &[l]) => ([0.0, third(l), third(l)], l, 1),
            (Shape::Plate, &[a, b]) => ([third(b), third(a), third(a) + third(b)], a * b, 2),
            (Shape::Cylinder, &[r, l]) => {
                let across = r * r / 4.0 + third(l);
                let volume = std::f64::consts::PI * r * r * l;
                ([across, across, r * r / 2.0], volume, 3)
            }
            (Shape::Box, &[a, b, c]) => {
                let [a2, b2, c2] = [a, b, c].map(third);
                ([b2 + c2, a2 + c2, a2 + b2], a * b * c, 3)
            }
            (_, sizes) => {
                let r = sizes.first().copied().unwrap_or(f64::NAN);
                let volume = 4.0 / 3.0 * std::f64::consts::PI * r * r * r;
                ([0.4 * r * r; 3], volume, 3)
            }
        }
    }

    fn inertia(&mut self, file: &InertiaDescription) -> [[f64; 3]; 3] {
        let unit = SiUnit::KILOGRAM.times(SiUnit::METRE).times(SiUnit::METRE);
        let values: Vec<f64> = file.0.iter().map(|x| self.number(x, unit)).collect();
        let tensor = match values[..] {
            [xx, yy, zz, xy, xz, yz] => [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
            // a flat body: Ixx + Iyy = Izz
            _ => {
                let zz = values[0];
                [[zz / 2.0, 0.0, 0.0], [0.0, zz / 2.0, 0.0], [0.0, 0.0, zz]]
            }
        };
        if values.iter().all(|x| x.is_finite()) {
            let symmetric = nalgebra::Matrix3::from_fn(|i, j| tensor[i][j]);
            let mut moments: [f64; 3] = symmetric.symmetric_eigenvalues().into();
            crate::number::sorting::sort_by(&mut moments, |a, b| a.total_cmp(b));
            let [a, b, c] = moments;
            let off = ROUNDING * c.abs().max(a.abs());
            if a < -off || c > a + b + off {
                let last = &file.0[file.0.len() - 1];
                let span = file.0[0].span.start..last.span.end;
                self.note(LoadProblem::Triangle(moments), &span);
            }
        }
        tensor
    }

    fn turn(&mut self, steps: &[Displacement]) -> Rotation<f64> {
        let mut turn = Pose::identity();
        for step in steps {
            let unit = match step {
                Displacement::Rotate(..) => SiUnit::RADIAN,
                _ => SiUnit::METRE,
            };
            let number = step.try_map(|entry: &Entry| Ok::<_, ()>(self.number(entry, unit)));
            let number = number.expect("every number is read");
            number.extend(&mut turn);
        }
        turn.rotation
    }
}
