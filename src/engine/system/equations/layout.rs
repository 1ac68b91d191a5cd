//! Held coordinates, unknowns, and the blocks of the Jacobian.

use super::Spin;
use crate::geometry::{Pose, Rotation};
use crate::linear::{ColumnBlock, Factorable, SparseStep};
use crate::mechanism::{ClosureEquations, Configuration, Mechanism, PoseCoordinate};
use crate::number::Number;

/// Held coordinates of a platform.
#[derive(Clone, Debug, PartialEq)]
pub enum HeldPlatform<T> {
    /// No coordinate: the pose is to be found.
    Free,
    /// Its whole pose, at the value it has in the configuration the solver starts from.
    Pose,
    /// Some coordinates.
    Partly(HeldParts<T>),
}

/// Held coordinates of a platform whose pose is not held as a whole.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeldParts<T> {
    /// Single coordinates with their values, m and rad.
    pub coordinates: Vec<(PoseCoordinate, T)>,
    /// The orientation from which single angles are measured, if not that of ground.
    pub reference: Option<Rotation<T>>,
    /// A wanted orientation: ground from platform.
    pub orientation: Option<Rotation<T>>,
    /// Lines of its own about which it does not spin.
    pub spins: Vec<Spin>,
}

impl<T: Copy> HeldPlatform<T> {
    /// The parts held, if it is held in part.
    pub fn parts(&self) -> Option<&HeldParts<T>> {
        match self {
            HeldPlatform::Partly(parts) => Some(parts),
            HeldPlatform::Free | HeldPlatform::Pose => None,
        }
    }

    /// Single coordinates that are held, with their values.
    pub fn coordinates(&self) -> &[(PoseCoordinate, T)] {
        self.parts().map_or(&[], |parts| &parts.coordinates)
    }

    /// The value at which a single coordinate is held.
    pub fn target(&self, coordinate: PoseCoordinate) -> Option<T> {
        let mut held = self.coordinates().iter();
        held.find(|(c, _)| *c == coordinate).map(|held| held.1)
    }

    /// Lines of its own about which it does not spin.
    pub fn spins(&self) -> &[Spin] {
        self.parts().map_or(&[], |parts| &parts.spins)
    }

    /// The orientation at which it is held, if its position is not held with it.
    pub fn orientation(&self) -> Option<Rotation<T>> {
        self.parts()?.orientation
    }
}

impl HeldPlatform<f64> {
    /// The parts held, to be added to; `None` if the whole pose is held.
    pub fn parts_mut(&mut self) -> Option<&mut HeldParts<f64>> {
        if let HeldPlatform::Free = self {
            *self = HeldPlatform::Partly(HeldParts::default());
        }
        match self {
            HeldPlatform::Partly(parts) => Some(parts),
            HeldPlatform::Free | HeldPlatform::Pose => None,
        }
    }

    /// Makes it spin about no more lines of its own.
    pub fn stop(&mut self, more: &[Spin]) {
        if !more.is_empty()
            && let Some(parts) = self.parts_mut()
        {
            parts.spins.extend(more);
        }
    }
}

/// Held coordinates of a mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct Held<T> {
    /// For each joint, true if its variable keeps the value of the starting configuration.
    pub joints: Vec<bool>,
    /// Held coordinates of each platform.
    pub platforms: Vec<HeldPlatform<T>>,
}

impl<T: Number> Held<T> {
    /// The held coordinates over another number.
    pub fn map<U: Number>(&self, mut f: impl FnMut(T) -> U) -> Held<U> {
        let platforms = self.platforms.iter().map(|part| match part {
            HeldPlatform::Free => HeldPlatform::Free,
            HeldPlatform::Pose => HeldPlatform::Pose,
            HeldPlatform::Partly(parts) => HeldPlatform::Partly(HeldParts {
                coordinates: (parts.coordinates.iter())
                    .map(|&(c, x)| (c, f(x)))
                    .collect(),
                reference: (parts.reference).map(|r| Rotation(r.0.map(|axis| axis.map(&mut f)))),
                orientation: (parts.orientation)
                    .map(|r| Rotation(r.0.map(|axis| axis.map(&mut f)))),
                spins: parts.spins.clone(),
            }),
        });
        Held {
            joints: self.joints.clone(),
            platforms: platforms.collect(),
        }
    }
}

impl Held<f64> {
    /// Copies from `at` the values that are held without an equation of their own.
    pub fn keep(&self, at: &Configuration<f64>, to: &mut Configuration<f64>) {
        for (i, _) in self.joints.iter().enumerate().filter(|(_, held)| **held) {
            to.joints[i] = at.joints[i];
        }
        for (i, held) in self.platforms.iter().enumerate() {
            if *held == HeldPlatform::Pose {
                to.platforms[i] = at.platforms[i];
            }
        }
    }

    /// Nothing held: all joints and platforms are to be found.
    pub fn nothing(mechanism: &Mechanism) -> Self {
        Held {
            joints: vec![false; mechanism.joints().len()],
            platforms: vec![HeldPlatform::Free; mechanism.platforms().len()],
        }
    }
}

/// A scalar unknown. All are dimensionless: lengths are divided by the characteristic length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// The variable of a joint.
    Joint(usize),
    /// Component 0 to 5 of a platform's twist: rotation about x, y, z, then displacement along them.
    Twist(usize, usize),
}

impl Unknown {
    /// The first of the six components of a platform's twist; the others follow it.
    pub fn first_twist(platform: usize) -> Self {
        Unknown::Twist(platform, 0)
    }

    /// The name of the joint or platform it belongs to.
    pub fn owner(self, mechanism: &Mechanism) -> &str {
        match self {
            Unknown::Joint(joint) => &mechanism.joints()[joint].name,
            Unknown::Twist(platform, _) => &mechanism.platforms()[platform].name,
        }
    }
}

/// The places of unknowns in a list of them.
#[derive(Clone, Debug, Default)]
pub struct Places {
    joints: Vec<Option<usize>>,
    /// Places of the first twist components of the platforms.
    twists: Vec<Option<usize>>,
}

impl Places {
    /// Places in this list, where the components of a twist follow one another.
    pub fn new(unknowns: &[Unknown]) -> Self {
        let mut places = Places::default();
        for (place, unknown) in unknowns.iter().enumerate() {
            let (all, owner) = match *unknown {
                Unknown::Joint(joint) => (&mut places.joints, joint),
                Unknown::Twist(platform, 0) => (&mut places.twists, platform),
                Unknown::Twist(..) => continue,
            };
            all.resize(all.len().max(owner + 1), None);
            all[owner] = Some(place);
        }
        places
    }

    /// The place of an unknown, if it is in the list.
    #[inline]
    pub fn of(&self, unknown: Unknown) -> Option<usize> {
        match unknown {
            Unknown::Joint(joint) => *self.joints.get(joint)?,
            Unknown::Twist(platform, component) => {
                self.twists.get(platform)?.map(|first| first + component)
            }
        }
    }
}

/// A row below the blocks: a platform coordinate held at a value, or a spin.
#[derive(Clone, Debug)]
pub(crate) enum HoldRow<T> {
    /// With the orientation from which an angle is measured, if not that of ground.
    Coordinate(usize, PoseCoordinate, T, Option<Rotation<T>>),
    Orientation(usize, Rotation<T>),
    Spin(Spin),
}

/// A pose with its orientation measured from a reference.
pub(crate) fn measured<T: Number>(pose: &Pose<T>, reference: &Option<Rotation<T>>) -> Pose<T> {
    reference.map_or(*pose, |from| Pose {
        rotation: pose.rotation * from.transpose(),
        ..*pose
    })
}

impl<T> HoldRow<T> {
    pub(crate) fn rows(&self) -> usize {
        match self {
            HoldRow::Coordinate(..) | HoldRow::Spin(_) => 1,
            HoldRow::Orientation(..) => 3,
        }
    }
}

/// The unknowns, the blocks they make of the closures, and the place of each closure.
pub(crate) struct Layout {
    pub unknowns: Vec<Unknown>,
    pub places_of_unknowns: Places,
    pub blocks: Vec<ColumnBlock>,
    /// For each closure its block and its first row in it.
    pub places: Vec<(usize, usize)>,
    pub shared: Vec<usize>,
}

impl Layout {
    /// Closures that share a free joint variable form a block; platforms tie the blocks together.
    pub fn new<T: Factorable>(closures: &[ClosureEquations<T>], held: &Held<T>) -> Self {
        let free = (0..held.joints.len()).filter(|joint| !held.joints[*joint]);
        let mut unknowns: Vec<Unknown> = free.map(Unknown::Joint).collect();
        let joints = unknowns.len();
        let moving = (0..held.platforms.len()).filter(|p| held.platforms[*p] != HeldPlatform::Pose);
        unknowns
            .extend(moving.flat_map(|p| (0..6).map(move |component| Unknown::Twist(p, component))));
        let places_of_unknowns = Places::new(&unknowns);

        // the first unknowns may belong to one block alone; for a sparse matrix every closure is a block and all are
        // shared
        let sparse = unknowns.len() > T::Sparse::ABOVE;
        // one block of all would be the border itself, which over complex numbers elimination is fastest for
        let whole = !T::REAL && unknowns.len() == joints;
        let owned = if sparse || whole { 0 } else { joints };
        let unknowns_of = |closure: &ClosureEquations<T>| {
            let joints = closure.joints().into_iter();
            joints.filter_map(|joint| places_of_unknowns.of(Unknown::Joint(joint)))
        };
        let mut owner: Vec<usize> = (0..closures.len()).collect();
        let mut closure_of: Vec<Option<usize>> = vec![None; owned];
        for (c, closure) in closures.iter().enumerate() {
            for unknown in unknowns_of(closure).filter(|unknown| *unknown < owned) {
                let first = *closure_of[unknown].get_or_insert(c);
                let (a, b) = (root(&mut owner, c), root(&mut owner, first));
                owner[a.max(b)] = a.min(b);
            }
        }

        let mut blocks: Vec<ColumnBlock> = Vec::new();
        let mut block_of_root = vec![None; closures.len()];
        let mut places = Vec::with_capacity(closures.len());
        for (c, closure) in closures.iter().enumerate() {
            let number = *block_of_root[root(&mut owner, c)].get_or_insert_with(|| {
                blocks.push(ColumnBlock::default());
                blocks.len() - 1
            });
            let block = &mut blocks[number];
            places.push((number, block.rows));
            block.rows += closure.equations();
            let shared = unknowns_of(closure).filter(|unknown| *unknown >= owned);
            block.shared.extend(shared);
            for platform in closure.platforms.iter().flatten() {
                if let Some(first) = places_of_unknowns.of(Unknown::first_twist(*platform))
                    && !block.shared.contains(&first)
                {
                    block.shared.extend(first..first + 6);
                }
            }
        }
        for (unknown, closure) in closure_of.iter().enumerate() {
            match closure {
                Some(c) => blocks[places[*c].0].own.push(unknown),
                None => blocks.push(ColumnBlock {
                    own: vec![unknown],
                    ..ColumnBlock::default()
                }),
            }
        }
        Layout {
            shared: (owned..unknowns.len()).collect(),
            places_of_unknowns,
            unknowns,
            blocks,
            places,
        }
    }

    /// The column of an unknown in a block.
    pub fn column(&self, block: usize, unknown: Unknown) -> Option<usize> {
        let index = self.places_of_unknowns.of(unknown)?;
        self.blocks[block].unknowns().position(|u| u == index)
    }
}

/// Root of a union–find set.
pub(super) fn root(owner: &mut [usize], mut i: usize) -> usize {
    while owner[i] != i {
        owner[i] = owner[owner[i]];
        i = owner[i];
    }
    i
}
