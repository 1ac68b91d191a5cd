//! Following a motion allocates nothing once the tracker is built.

// counting allocations takes an allocator of its own
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System as Heap};
use std::cell::Cell;

use linkwork::geometry::{Axis, Pose, Quaternion, Vector3};
use linkwork::mechanism::{
    ChainDimensions, ClosureDimensions, ClosureKind, Configuration, Dimensions, Frame, LinearForm,
    PlatformPose, RowDimensions,
};
use linkwork::solve::Watch;
use linkwork::solve::{Newton, Stop, Warm};
use linkwork::system::{
    Coordinate, FrameTwists, Held, HeldPlatform, Motion, MotionTracker, Question, System, close,
};

struct Counting;

// the count is of one thread: the thread that runs the tests allocates as it pleases
thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

fn allocations() -> usize {
    ALLOCATIONS.get()
}

// SAFETY: every call goes to the system's allocator unchanged
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { Heap.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { Heap.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static HEAP: Counting = Counting;

/// The 3-RPS manipulator: three legs of a turn and a slide, ball joints on a platform.
fn three_rps() -> Dimensions<f64> {
    let turned = |axis, degrees: f64| Pose::rotation(axis, degrees.to_radians());
    let along_x = |x| Pose::translation(Vector3([x, 0.0, 0.0]));
    let row = |before, turn: &[usize], slide: &[usize]| RowDimensions {
        before,
        turn: LinearForm(turn.iter().map(|&joint| (joint, 1.0)).collect()),
        slide: LinearForm(slide.iter().map(|&joint| (joint, 1.0)).collect()),
        after: Pose::identity(),
    };
    let places = (0..3).map(|i| turned(Axis::Z, 120.0 * f64::from(i)));
    Dimensions {
        characteristic_length: 1.0,
        centre: [0.0; 3],
        axes: None,
        joint_scales: vec![1.0; 6],
        chains: (places.clone().enumerate())
            .map(|(i, place)| ChainDimensions {
                on: Frame::Ground,
                base: place * along_x(1.0) * turned(Axis::X, 90.0),
                rows: vec![
                    row(Pose::identity(), &[2 * i], &[]),
                    row(turned(Axis::X, -90.0), &[], &[2 * i + 1]),
                ],
                tip: Pose::identity(),
            })
            .collect(),
        platforms: vec![places.map(|place| place * along_x(0.5)).collect()],
        closures: (0..3)
            .map(|i| ClosureDimensions {
                kind: ClosureKind::Spherical,
                frames: [
                    Frame::Tip { chain: i },
                    Frame::OnPlatform {
                        platform: 0,
                        frame: i,
                    },
                ],
                length: 0.0,
                extension: LinearForm(vec![]),
                relation: None,
            })
            .collect(),
    }
}

#[test]
fn solves_and_rates_allocate_nothing() {
    a_solve_allocates_nothing();
    rates_and_accelerations_of_everything_allocate_nothing();
}

fn a_solve_allocates_nothing() {
    let held = Held {
        joints: vec![false, true, false, true, false, true],
        platforms: vec![HeldPlatform::Free],
    };
    let start = Configuration {
        joints: vec![0.67, 0.8, 0.67, 0.9, 0.67, 0.73],
        platforms: vec![PlatformPose {
            orientation: Quaternion::identity(),
            position: Vector3([0.0, 0.0, 0.6]),
        }],
    };
    for extrapolation in [0, 3] {
        let system = System::new(&three_rps(), &held);
        let mut tracker = MotionTracker::new(system, start.clone()).with(Warm {
            extrapolation,
            ..Warm::default()
        });
        assert_eq!(tracker.recover(&Newton::default()).stop, Stop::Solved);
        let before = allocations();
        let (mut steps, mut renewals) = (0, 0);
        for k in 0..1000 {
            let report = tracker.solve(|held| {
                for (leg, phase) in [0.0, 1.7, 3.9].into_iter().enumerate() {
                    let wave = (f64::from(k) * 0.01 + phase).sin();
                    held.joints[2 * leg + 1] = 0.8 + 0.1 * wave;
                }
            });
            assert!(report.solved && report.residual <= 1e-12, "{k}: {report:?}");
            steps += report.steps;
            renewals += report.renewals;
        }
        assert_eq!(allocations(), before);
        assert!(steps > 0 && renewals > 0);
    }
}

fn rates_and_accelerations_of_everything_allocate_nothing() {
    for name in ["three_rps", "stewart_gough_6ups", "bennett", "delta"] {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/mechanisms");
        let mechanism = linkwork::load(format!("{folder}/{name}.ron")).unwrap();
        let question = Question::new(&mechanism);
        let at = close(&question, &Newton::default(), (0, 1), &Watch::none())
            .unwrap()
            .configuration;
        let held: Vec<Coordinate> = question.held_coordinates();
        let frames = mechanism.frames();
        let mut motion = Motion::placing(&mechanism, &held, &frames, |held| held);
        let motions = FrameTwists::moving(&mechanism, &motion, &frames);
        let (rates, changes) = (vec![0.3; held.len()], vec![-0.1; held.len()]);
        let before = allocations();
        let mut sum = 0.0;
        for _ in 0..100 {
            motion.at(&at);
            sum += motion.rates(&rates)[0];
            sum += motion.accelerations(&changes)[0];
            let changes = motion.changes();
            for i in 0..frames.len() {
                sum += motions.motion(i, changes).change.velocity.norm();
            }
        }
        assert_eq!(allocations(), before, "{name}");
        assert!(sum.is_finite() && sum != 0.0);
    }
}
