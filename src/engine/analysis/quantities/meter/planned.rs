//! A meter with all that its quantities need planned.

use super::*;
use crate::analysis::statics::determined;
use crate::analysis::velocity::outputs;

impl<'q> Meter<'q> {
    /// Plans what the names in programs need.
    pub(super) fn reading(
        of: &'q Metered<'q>,
        start: &Configuration<f64>,
        (names, programs): (Vec<Name>, Vec<Expression<usize>>),
        turns: Vec<bool>,
    ) -> Self {
        let question = &of.question;
        let mechanism = question.mechanism();
        let all = || names.iter().map(|name| &name.of);
        let mut wants = Wants::of(all());
        if wants.forces && (of.load.has_inertia() || of.load.has_friction()) {
            wants.order = Order::Acceleration;
        }
        let mut points: Vec<Point> = Vec::new();
        let length = mechanism.characteristic_length();
        let first = |points: &[Point], of: &[Point]| {
            let mut windows = points.windows(of.len().max(1));
            windows.position(|known| known == of)
        };
        for of in all().map(|measured| points_of(measured, length)) {
            if first(&points, &of).is_none() {
                points.extend(of);
            }
        }
        let coordinates = question.driven_coordinates();
        // about which lines links spin matters to a Jacobian and to rates of points alone
        let matters = wants.jacobian || wants.order > Order::Value && !points.is_empty();
        let near = matters.then(|| {
            let mut held = Neighbourhood::holding(mechanism, &question.held());
            let rest = held.tangent(start.clone());
            (Spins::of(&held, &rest), held, rest)
        });
        let (spins, held, outputs) = match near {
            Some((spins, held, rest)) if wants.jacobian => {
                let outputs = match &of.outputs[..] {
                    [] => outputs(mechanism, &coordinates, &held, &rest),
                    outputs => outputs.to_vec(),
                };
                (spins, Some(held), outputs)
            }
            near => (near.map(|near| near.0).unwrap_or_default(), None, vec![]),
        };
        let mut frames: Vec<Frame> = points.iter().map(|point| point.frame).collect();
        let loose = frames
            .iter()
            .filter(|frame| !spins.lines_of(**frame).is_empty());
        let loose = loose.copied().collect();
        frames.extend(Outputs::frames(&outputs));
        if wants.forces {
            frames.extend(Balance::<f64>::frames(mechanism, &of.load, wants.reactions));
        }
        if wants.transmission {
            frames.extend(TransmissionAngles::frames(mechanism));
        }
        let mut works = Vec::new();
        let numbered = (names.iter()).map(|&name| {
            if let Measured::Work(_) = name.of {
                works.push(f64::NAN);
                return (name, works.len() - 1);
            }
            let number = first(&points, &points_of(&name.of, length));
            (name, number.unwrap_or(0))
        });
        let numbered: Vec<(Name, usize)> = numbered.collect();
        let held_by = |coordinate: &Coordinate| {
            names.iter().any(|name| match name.of {
                Measured::Force(joint) | Measured::Inertia(joint) => {
                    *coordinate == Coordinate::Joint(joint)
                }
                Measured::PlatformForce(platform, c) => {
                    *coordinate == Coordinate::Pose(platform, c)
                }
                _ => false,
            })
        };
        let wanted = coordinates.iter();
        let wanted = wanted.map(|of_it| wants.jacobian || held_by(of_it));
        // how an angle changes depends on how fast it turns
        let angles = numbered.iter().flat_map(|(name, point)| {
            let wanted = match name.of {
                Measured::Place(_, c, order) if c.is_angle() => Some((c, order)),
                _ => None,
            };
            let orders = wanted.into_iter().flat_map(|(c, order)| match order {
                Order::Acceleration => vec![(c, Order::Velocity), (c, order)],
                _ => vec![(c, order)],
            });
            orders.map(|(c, order)| (*point, c, order))
        });
        let mut plan = Plan {
            order: wants.order,
            angles: angles.collect(),
            responses: wanted.collect(),
            forces: wants.forces,
            reactions: wants.reactions,
            outputs: wants.jacobian.then_some(outputs),
            transmission: None,
            points,
            frames,
        };
        let probe = Probe::new(of, &plan);
        plan.transmission = wants.transmission.then(|| {
            let mut near = Neighbourhood::new(mechanism);
            TransmissionAngles::new(&mut near, start, &coordinates, probe.kinematics())
        });
        let way = |of_it: &Coordinate| {
            let mut inputs = of.inputs.iter();
            let place = inputs.position(|input| input.coordinate == *of_it)?;
            Some((place, of.inputs[place].to - of.inputs[place].from))
        };
        Meter {
            ways: coordinates.iter().map(way).collect(),
            turns,
            spinning: match held {
                Some(held) if !spins.is_empty() => Spinning::Something(Box::new(held)),
                _ => Spinning::Nothing(spins),
            },
            loose,
            distances: wants.distances.then(|| {
                let inputs = system::inputs_of(question);
                let distances = Figure::ALL.into_iter().filter(|figure| {
                    figure.is_distance() && all().any(|of| *of == Measured::Figure(*figure))
                });
                let outputs = match &of.outputs[..] {
                    [] => system::default_outputs(mechanism, &inputs),
                    outputs => outputs.to_vec(),
                };
                let classifier = Classifier::new(mechanism, &inputs, &outputs, start);
                Box::new((classifier, distances.collect()))
            }),
            driven: [(); 2].map(|()| vec![0.0; coordinates.len()]),
            coordinates,
            plan,
            probe,
            block: MeterBlock::new(programs.len()),
            rows: 0,
            recording: None,
            failed: 0,
            before: vec![None; programs.len()],
            values: vec![None; programs.len()],
            known: vec![[0.0; 2]; names.len()],
            noise: vec![0.0; programs.len()],
            names: numbered,
            works,
            programs,
            wants,
            planar: wants.reactions && mechanism.plane_of_motion().is_some(),
            determined: match wants.reactions {
                true => determined(mechanism, start, &question.driven_coordinates()),
                false => Vec::new(),
            },
            of,
        }
    }
}
