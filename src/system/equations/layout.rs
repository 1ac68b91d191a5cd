use super::Spin;
use crate::geometry::Rotation;
use crate::linear::{Block, DENSE_LIMIT, Factorable, SparseStep};
use crate::mechanism::{Closure, Configuration, Mechanism, PoseCoordinate};
use crate::number::Number;

/// What is held of a platform.
#[derive(Clone, Debug, PartialEq)]
pub enum HeldPlatform<T> {
    /// Nothing: its pose is to be found.
    Free,
    /// Its whole pose, at the value it has in the configuration the solver starts from.
    Pose,
    /// Some coordinates at given values, m and rad, and perhaps the whole orientation.
    Partly {
        /// Single coordinates with their values.
        coordinates: Vec<(PoseCoordinate, T)>,
        /// A wanted orientation: ground from platform.
        orientation: Option<Rotation<T>>,
        /// Lines of its own about which it does not spin.
        spins: Vec<Spin>,
    },
}

impl<T: Copy> HeldPlatform<T> {
    /// The value at which a single coordinate is held.
    pub fn target(&self, coordinate: PoseCoordinate) -> Option<T> {
        match self {
            HeldPlatform::Partly { coordinates, .. } => (coordinates.iter())
                .find(|(held, _)| *held == coordinate)
                .map(|(_, value)| *value),
            _ => None,
        }
    }

    /// Lines of its own about which it does not spin.
    pub fn spins(&self) -> &[Spin] {
        match self {
            HeldPlatform::Partly { spins, .. } => spins,
            _ => &[],
        }
    }

    /// Makes it spin about no more lines of its own.
    pub fn stop(&mut self, more: &[Spin]) {
        match self {
            HeldPlatform::Partly { spins, .. } => spins.extend(more),
            HeldPlatform::Free if !more.is_empty() => {
                *self = HeldPlatform::Partly {
                    coordinates: Vec::new(),
                    orientation: None,
                    spins: more.to_vec(),
                };
            }
            HeldPlatform::Free | HeldPlatform::Pose => {}
        }
    }

    /// The orientation at which it is held, if its position is not held with it.
    pub fn orientation(&self) -> Option<Rotation<T>> {
        match self {
            HeldPlatform::Partly { orientation, .. } => *orientation,
            _ => None,
        }
    }
}

/// Which coordinates of a mechanism are held.
#[derive(Clone, Debug, PartialEq)]
pub struct Held<T> {
    /// For each joint whether its variable keeps the value it has in the starting configuration.
    pub joints: Vec<bool>,
    /// For each platform what is held of it.
    pub platforms: Vec<HeldPlatform<T>>,
}

impl<T: Number> Held<T> {
    /// The same over another number.
    pub fn map<U: Number>(&self, mut f: impl FnMut(T) -> U) -> Held<U> {
        let platforms = self.platforms.iter().map(|part| match part {
            HeldPlatform::Free => HeldPlatform::Free,
            HeldPlatform::Pose => HeldPlatform::Pose,
            HeldPlatform::Partly {
                coordinates,
                orientation,
                spins,
            } => HeldPlatform::Partly {
                coordinates: coordinates.iter().map(|&(c, x)| (c, f(x))).collect(),
                orientation: orientation.map(|r| {
                    let [x, y, z] = r.0;
                    Rotation([x.map(&mut f), y.map(&mut f), z.map(&mut f)])
                }),
                spins: spins.clone(),
            },
        });
        Held {
            joints: self.joints.clone(),
            platforms: platforms.collect(),
        }
    }
}

impl Held<f64> {
    /// Puts what is held without an equation of its own where it is in a configuration.
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
    /// A component of a platform's twist: rotation about x, y, z, then displacement along them.
    Twist {
        /// Index of the platform.
        platform: usize,
        /// 0 to 5.
        component: usize,
    },
}

impl Unknown {
    /// The first of the six components of a platform's twist; the others follow it.
    pub fn first_twist(platform: usize) -> Self {
        Unknown::Twist {
            platform,
            component: 0,
        }
    }

    /// The name of the joint or platform it belongs to.
    pub fn owner(self, mechanism: &Mechanism) -> &str {
        match self {
            Unknown::Joint(joint) => &mechanism.joints()[joint].name,
            Unknown::Twist { platform, .. } => &mechanism.platforms()[platform].name,
        }
    }
}

/// The places of unknowns in a list of them.
#[derive(Clone, Debug, Default)]
pub struct Places {
    joints: Vec<Option<usize>>,
    /// Of the first twist components of the platforms.
    twists: Vec<Option<usize>>,
}

impl Places {
    /// In this list, where the components of a twist follow one another.
    pub fn new(unknowns: &[Unknown]) -> Self {
        let mut places = Places::default();
        for (place, unknown) in unknowns.iter().enumerate() {
            let (all, owner) = match *unknown {
                Unknown::Joint(joint) => (&mut places.joints, joint),
                Unknown::Twist {
                    platform,
                    component: 0,
                } => (&mut places.twists, platform),
                Unknown::Twist { .. } => continue,
            };
            all.resize(all.len().max(owner + 1), None);
            all[owner] = Some(place);
        }
        places
    }

    /// The place of an unknown, if it is in the list.
    pub fn of(&self, unknown: Unknown) -> Option<usize> {
        match unknown {
            Unknown::Joint(joint) => *self.joints.get(joint)?,
            Unknown::Twist {
                platform,
                component,
            } => self.twists.get(platform)?.map(|first| first + component),
        }
    }
}

/// A row below the blocks: a platform coordinate held at a value, or a spin.
#[derive(Clone, Debug)]
pub(crate) enum HoldRow<T> {
    Coordinate(usize, PoseCoordinate, T),
    Orientation(usize, Rotation<T>),
    Spin(Spin),
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
    /// Which unknown each joint is, if it is one.
    pub joint_unknowns: Vec<Option<usize>>,
    /// The unknown that is the first component of each platform's twist.
    pub first_twists: Vec<Option<usize>>,
    pub blocks: Vec<Block>,
    /// For each closure its block and its first row in it.
    pub places: Vec<(usize, usize)>,
    pub shared: Vec<usize>,
    places_of_unknowns: Places,
}

impl Layout {
    /// Closures that share a free joint variable form a block; platforms tie the blocks together.
    pub fn new<T: Factorable>(closures: &[Closure<T>], held: &Held<T>) -> Self {
        let mut unknowns: Vec<Unknown> = Vec::new();
        let mut joint_unknowns = vec![None; held.joints.len()];
        for (joint, _) in held.joints.iter().enumerate().filter(|(_, held)| !**held) {
            joint_unknowns[joint] = Some(unknowns.len());
            unknowns.push(Unknown::Joint(joint));
        }
        let joints = unknowns.len();
        let mut first_twists = vec![None; held.platforms.len()];
        for (platform, held) in held.platforms.iter().enumerate() {
            if *held != HeldPlatform::Pose {
                first_twists[platform] = Some(unknowns.len());
                let twist = (0..6).map(|component| Unknown::Twist {
                    platform,
                    component,
                });
                unknowns.extend(twist);
            }
        }

        if T::Sparse::AVAILABLE && unknowns.len() > DENSE_LIMIT {
            return Layout::of_single_closures(closures, unknowns, joint_unknowns, first_twists);
        }
        let mut owner: Vec<usize> = (0..closures.len()).collect();
        let mut closure_of: Vec<Option<usize>> = vec![None; joints];
        for (c, closure) in closures.iter().enumerate() {
            for joint in closure.joints() {
                let Some(unknown) = joint_unknowns[joint] else {
                    continue;
                };
                match closure_of[unknown] {
                    None => closure_of[unknown] = Some(c),
                    Some(other) => {
                        let (a, b) = (root(&owner, c), root(&owner, other));
                        owner[a.max(b)] = a.min(b);
                    }
                }
            }
        }

        let mut blocks: Vec<Block> = Vec::new();
        let mut block_of_root = vec![None; closures.len()];
        let mut places = Vec::with_capacity(closures.len());
        for (c, closure) in closures.iter().enumerate() {
            let block = *block_of_root[root(&owner, c)].get_or_insert_with(|| {
                blocks.push(Block::default());
                blocks.len() - 1
            });
            places.push((block, blocks[block].rows));
            blocks[block].rows += closure.equations();
            for platform in closure.platforms.iter().flatten() {
                if let Some(first) = first_twists[*platform]
                    && !blocks[block].shared.contains(&first)
                {
                    blocks[block].shared.extend(first..first + 6);
                }
            }
        }
        for (unknown, closure) in closure_of.iter().enumerate() {
            match closure {
                Some(c) => blocks[places[*c].0].own.push(unknown),
                None => blocks.push(Block {
                    own: vec![unknown],
                    ..Block::default()
                }),
            }
        }
        Layout {
            shared: (joints..unknowns.len()).collect(),
            places_of_unknowns: Places::new(&unknowns),
            unknowns,
            joint_unknowns,
            first_twists,
            blocks,
            places,
        }
    }

    /// A block for every closure, all unknowns shared: the pattern of a sparse matrix.
    fn of_single_closures<T: Number>(
        closures: &[Closure<T>],
        unknowns: Vec<Unknown>,
        joint_unknowns: Vec<Option<usize>>,
        first_twists: Vec<Option<usize>>,
    ) -> Self {
        let blocks = closures.iter().map(|closure| {
            let joints = closure.joints().into_iter();
            let mut shared: Vec<usize> = joints.filter_map(|joint| joint_unknowns[joint]).collect();
            for platform in closure.platforms.iter().flatten() {
                if let Some(first) = first_twists[*platform]
                    && !shared.contains(&first)
                {
                    shared.extend(first..first + 6);
                }
            }
            Block {
                rows: closure.equations(),
                own: Vec::new(),
                shared,
            }
        });
        Layout {
            blocks: blocks.collect(),
            places: (0..closures.len()).map(|block| (block, 0)).collect(),
            shared: (0..unknowns.len()).collect(),
            places_of_unknowns: Places::new(&unknowns),
            unknowns,
            joint_unknowns,
            first_twists,
        }
    }

    /// The column of an unknown in a block.
    pub fn column(&self, block: usize, unknown: Unknown) -> Option<usize> {
        let index = self.places_of_unknowns.of(unknown)?;
        let Block { own, shared, .. } = &self.blocks[block];
        own.iter().chain(shared).position(|&u| u == index)
    }
}

fn root(owner: &[usize], mut closure: usize) -> usize {
    while owner[closure] != closure {
        closure = owner[closure];
    }
    closure
}
