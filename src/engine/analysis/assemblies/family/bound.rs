//! Structures with a known number of solutions.
//!
//! The structure is read off a generic member: axes that are parallel or meet there do so for all
//! inputs, and so do points that coincide. A bound that is reached ends the search; one that is not
//! makes it longer.

use rand::SeedableRng;
use rand_pcg::Pcg64;

use super::Family;
use super::coordinates::C;
use crate::geometry::Vector3;
use crate::mechanism::{ClosureKind, Dimensions, Frame, JointKind, Mechanism};
use crate::number::tolerance::ROUNDING;
use crate::number::{Number, complex};
use crate::system::{ClosureAxes, HeldPlatform, System};

/// The largest number of isolated complex solutions that a structure has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct KnownBound {
    pub count: usize,
    pub structure: &'static str,
    pub source: &'static str,
}

/// The known bound for a question, if its structure is recognised.
pub(crate) fn known_bound(mechanism: &Mechanism, family: &Family) -> Option<KnownBound> {
    let known = |family: &Family| {
        let family = Some(family).filter(|family| family.is_whole())?;
        let structure = Structure::of(mechanism, family)?;
        match structure.platforms.as_slice() {
            [] => (structure.dyads())
                .or_else(|| structure.triad())
                .or_else(|| structure.hinged_points())
                .or_else(|| structure.arm()),
            [HeldPlatform::Free] => structure.platform(),
            _ => None,
        }
    };
    // a universal joint stands in two ways wherever the rod of its leg is
    let with_rods = family.reduced.as_ref().and_then(|reduced| known(reduced));
    let with_rods = with_rods.map(|bound| KnownBound {
        count: bound.count * family.ways(),
        ..bound
    });
    with_rods.or_else(|| known(family))
}

fn bound(count: usize, structure: &'static str, source: &'static str) -> Option<KnownBound> {
    Some(KnownBound {
        count,
        structure,
        source,
    })
}

/// Structure of a closure.
struct Link {
    kind: ClosureKind,
    frames: [Frame; 2],
    /// Unknown joints that affect its equations.
    joints: Vec<usize>,
    axes: ClosureAxes<C>,
}

struct Structure<'a> {
    mechanism: &'a Mechanism,
    dimensions: Dimensions<C>,
    links: Vec<Link>,
    /// Platforms whose whole pose is not held.
    platforms: Vec<&'a HeldPlatform<C>>,
}

fn parallel(a: &Vector3<C>, b: &Vector3<C>) -> bool {
    let size = |v: &Vector3<C>| v.0.iter().map(|x| complex::norm(*x)).fold(0.0, f64::max);
    size(&a.cross(b)) <= ROUNDING * size(a) * size(b)
}

impl<'a> Structure<'a> {
    /// `None` if a joint moves more than one row, or by more than its own variable.
    fn of(mechanism: &'a Mechanism, family: &'a Family) -> Option<Self> {
        let mut rng = Pcg64::seed_from_u64(1);
        let member = family.generic_member(&mut rng);
        let dimensions = family.dimensions(&member.parameters)?;
        let mut way = family.homotopy(&member, &member)?;
        way.linearise(C::from_f64(0.0), &family.random_point(&mut rng, 1.0));
        if dimensions.closures.iter().any(|of| of.relation.is_some()) {
            return None;
        }
        let system = System::new(&dimensions, &family.held);
        let axes = system.axes(&way.here.at, &mut system.work());
        let closures = dimensions.closures.iter();
        let links = closures.zip(system.joints_of_closures());
        let small = ROUNDING * dimensions.characteristic_length;
        let links = links.zip(axes).map(|((closure, mut joints), axes)| {
            // a closure does not see a turn about the origin of its frame, or about the axis of that
            let turned = |(_, omega, v): &(usize, Vector3<C>, Vector3<C>)| {
                let moved = v.0.iter().any(|x| complex::norm(*x) > small);
                let about = |axis: &Vector3<C>| closure.kind.leaves_turn() && parallel(omega, axis);
                moved || !(closure.kind.leaves_orientation() || axes.frames.iter().any(about))
            };
            joints.retain(|joint| {
                let mut at = axes.joints.iter().filter(|(j, ..)| j == joint).peekable();
                at.peek().is_none() || at.any(turned)
            });
            joints.sort_unstable();
            joints.dedup();
            Link {
                kind: closure.kind,
                frames: closure.frames,
                joints,
                axes,
            }
        });
        let links = links.collect();
        let platforms = family.held.platforms.iter();
        let platforms = platforms
            .filter(|held| **held != HeldPlatform::Pose)
            .collect();
        let plain = |joint: &usize| is_plain(&dimensions, *joint);
        let free = &family.coordinates.free_joints;
        free.iter().all(plain).then_some(Structure {
            mechanism,
            links,
            platforms,
            dimensions,
        })
    }

    fn turns(&self, joints: &[usize]) -> bool {
        let kind = |joint: &usize| self.mechanism.joints()[*joint].kind;
        (joints.iter()).all(|joint| kind(joint) == JointKind::Revolute)
    }

    /// True if two joints of a closure slide in one direction, so that it does not determine their meeting point.
    fn slide_alike(&self, link: &Link, joints: [usize; 2]) -> bool {
        let along = joints.map(|joint| {
            let own = link.axes.joints.iter().find(|(j, ..)| *j == joint);
            own.filter(|_| !self.turns(&[joint])).map(|(.., v)| v)
        });
        matches!(along, [Some(a), Some(b)] if parallel(a, b))
    }

    /// Closures that can be closed one after another, each by two joints or one.
    ///
    /// Circles and lines share two finite points at most: 4-bar and slider-crank linkages, spherical
    /// 4-bars, RSSR, five-bars with two cranks held, Watt six-bars.
    fn dyads(&self) -> Option<KnownBound> {
        let mut known: Vec<usize> = Vec::new();
        let mut left: Vec<&Link> = self.links.iter().collect();
        let mut count = 1;
        while !left.is_empty() {
            let ways = |link: &Link| {
                let open: Vec<usize> = (link.joints.iter().copied())
                    .filter(|joint| !known.contains(joint))
                    .collect();
                let meets = matches!(
                    link.kind,
                    ClosureKind::Revolute | ClosureKind::Spherical | ClosureKind::Rigid
                );
                match (open.as_slice(), link.kind) {
                    ([], _) => Some(1),
                    ([_], ClosureKind::Distance) => Some(2),
                    ([_], _) if meets => Some(1),
                    ([a, b], _) if meets && !self.slide_alike(link, [*a, *b]) => {
                        Some(1 + usize::from(self.turns(&[*a]) || self.turns(&[*b])))
                    }
                    _ => None,
                }
            };
            let (place, ways) = (left.iter().enumerate())
                .filter_map(|(place, link)| Some((place, ways(link)?)))
                .min_by_key(|(_, ways)| *ways)?;
            known.extend(&left.swap_remove(place).joints);
            count *= ways;
        }
        bound(
            count,
            match self.links.len() {
                1 => "a circle that meets a circle, a line or a sphere",
                _ => "circles that meet circles, lines or spheres, one after another",
            },
            "Freudenstein 1955",
        )
    }

    /// True if all joints of closures turn about parallel axes, and the axes of the closures are parallel to them.
    fn planar(&self) -> bool {
        let about = |link: &Link| {
            let [a, b] = link.axes.frames;
            let turning = link.axes.joints.iter().map(|(_, omega, _)| *omega);
            // an unknown platform stands askew at a random point
            let fixed = [(0, a), (1, b)].into_iter().filter(|(side, _)| {
                !matches!(
                    link.frames[*side],
                    Frame::Platform { .. } | Frame::OnPlatform { .. }
                )
            });
            turning.chain(fixed.map(|(_, z)| z)).collect::<Vec<_>>()
        };
        let all: Vec<Vector3<C>> = self.links.iter().flat_map(about).collect();
        let turning = |link: &Link| link.kind == ClosureKind::Revolute && self.turns(&link.joints);
        self.links.iter().all(turning) && all.windows(2).all(|pair| parallel(&pair[0], &pair[1]))
    }

    /// Two planar loops that only close together: the sextic coupler curve of a four-bar meets a
    /// circle in six finite points (Primrose, Freudenstein and Roth 1967).
    fn triad(&self) -> Option<KnownBound> {
        let [a, b] = self.links.as_slice() else {
            return None;
        };
        let mut joints = [a.joints.as_slice(), &b.joints].concat();
        joints.sort_unstable();
        joints.dedup();
        match self.planar() && joints.len() == 4 {
            true => bound(
                6,
                "the coupler curve of a four-bar that meets a circle",
                "Primrose, Freudenstein and Roth 1967",
            ),
            false => None,
        }
    }

    /// Three points, each turned by a hinge, two and two at given distances: the points of a rigid
    /// triangle on three circles.
    fn hinged_points(&self) -> Option<KnownBound> {
        let mut pairs: Vec<&[usize]> = self.links.iter().map(|l| l.joints.as_slice()).collect();
        pairs.sort_unstable();
        let [[a, b], [c, d], [e, f]] = pairs.as_slice() else {
            return None;
        };
        let ring = a == c && b == e && d == f;
        let rods = |link: &Link| link.kind == ClosureKind::Distance && self.turns(&link.joints);
        match ring && self.links.iter().all(rods) {
            true => bound(
                16,
                "three hinged points at given distances",
                "Nanua, Waldron and Murthy 1990",
            ),
            false => None,
        }
    }

    /// One loop of six revolute joints, a pin that closes it among them, of which one may slide; or three that bring a
    /// point to a place.
    fn arm(&self) -> Option<KnownBound> {
        let [link] = self.links.as_slice() else {
            return None;
        };
        let is = |kind: JointKind| {
            let joints = link.joints.iter().map(|j| self.mechanism.joints()[*j].kind);
            joints.filter(|of| *of == kind).count()
        };
        let turning = is(JointKind::Revolute);
        if turning + is(JointKind::Prismatic) != link.joints.len() {
            return None;
        }
        match (link.kind, link.joints.len(), link.joints.len() - turning) {
            (ClosureKind::Rigid, 6, 0) | (ClosureKind::Revolute, 5, 0) => bound(
                16,
                "six revolute joints in one loop",
                "Primrose 1986; Lee and Liang 1988",
            ),
            (ClosureKind::Rigid, 6, 1)
            | (ClosureKind::Revolute, 5, 1)
            | (ClosureKind::Prismatic, 5, 0) => bound(
                16,
                "five revolute joints and a prismatic one in one loop",
                "Raghavan and Roth 1993",
            ),
            (ClosureKind::Spherical, 3, 0) => bound(
                4,
                "three revolute joints that bring a point to a place",
                "Pieper 1968",
            ),
            _ => None,
        }
    }

    /// Legs between fixed bodies and one platform.
    fn platform(&self) -> Option<KnownBound> {
        let on_platform =
            |frame: &Frame| matches!(frame, Frame::Platform { .. } | Frame::OnPlatform { .. });
        let to_platform =
            |link: &Link| on_platform(&link.frames[0]) != on_platform(&link.frames[1]);
        // two legs share no joint
        let joints = self.links.iter().flat_map(|link| &link.joints);
        let mut joints: Vec<usize> = joints.copied().collect();
        joints.sort_unstable();
        let shared = joints.windows(2).any(|pair| pair[0] == pair[1]);
        if shared || !self.links.iter().all(to_platform) {
            return None;
        }
        let hinged = |link: &Link| link.joints.len() == 1 && self.turns(&link.joints);
        let all = |kind: ClosureKind| self.links.iter().all(|link| link.kind == kind);
        match self.links.len() {
            1 if self.links[0].joints.is_empty() && all(ClosureKind::Rigid) => bound(
                1,
                "a body fixed to what is held",
                "its pose is the product of the displacements that lead to it",
            ),
            3 if self.links.iter().all(hinged) && all(ClosureKind::Spherical) => bound(
                16,
                "a rigid triangle on three circles: three hinged legs with balls on a platform",
                "Nanua, Waldron and Murthy 1990",
            ),
            3 if self.links.iter().all(hinged) && self.planar() => bound(
                6,
                "a rigid triangle on three circles of a plane",
                "Hunt 1983; Gosselin, Sefrioui and Richard 1992",
            ),
            6 if joints.is_empty() && all(ClosureKind::Distance) => match self.meets_by_pairs() {
                true => bound(
                    16,
                    "six legs that meet by pairs on a platform",
                    "Nanua, Waldron and Murthy 1990; Faugère and Lazard 1995",
                ),
                false => bound(
                    40,
                    "six legs between a base and a platform",
                    "Ronga and Vust 1992; Raghavan 1993",
                ),
            },
            _ => None,
        }
    }

    /// True if six legs end at three points of the platform, two at each.
    fn meets_by_pairs(&self) -> bool {
        let point = |link: &Link| {
            link.frames.iter().find_map(|frame| match frame {
                Frame::OnPlatform { platform, frame } => {
                    Some(self.dimensions.platforms[*platform][*frame].position)
                }
                Frame::Platform { .. } => Some(Vector3::zero()),
                _ => None,
            })
        };
        let points: Vec<Vector3<C>> = self.links.iter().filter_map(point).collect();
        let size = ROUNDING * self.dimensions.characteristic_length;
        let near = |a: &Vector3<C>, b: &Vector3<C>| {
            a.0.iter()
                .zip(&b.0)
                .all(|(a, b)| complex::norm(a - b) <= size)
        };
        let at_same = |a: &&Vector3<C>| points.iter().filter(|b| near(a, b)).count() == 2;
        points.len() == 6 && points.iter().filter(at_same).count() == 6
    }
}

/// True if a joint stands in one row of one chain, or in the length of one closure, with a factor of absolute value 1.
pub(super) fn is_plain(dimensions: &Dimensions<C>, joint: usize) -> bool {
    let rows = dimensions.chains.iter().flat_map(|chain| &chain.rows);
    let in_rows = rows.flat_map(|row| [row.turn.coefficient(joint), row.slide.coefficient(joint)]);
    let in_lengths = dimensions.closures.iter();
    let in_lengths = in_lengths.map(|closure| closure.extension.coefficient(joint));
    let factors: Vec<f64> = (in_rows.chain(in_lengths))
        .map(complex::norm)
        .filter(|factor| *factor > 0.0)
        .collect();
    matches!(factors.as_slice(), [factor] if (factor - 1.0).abs() <= ROUNDING)
}
