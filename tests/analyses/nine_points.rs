//! Four-bars whose coupler point passes through nine points.

use linkwork::analysis::design::Defect;
use linkwork::ask::Design;
use linkwork::description::{Description, DesignDescription};
use linkwork::solve::Watch;
use serde_json::Value;

fn pair(value: &Value) -> [f64; 2] {
    [0, 1].map(|i| value[i].as_f64().unwrap())
}

/// The 64 real triples of the classical problem, all of them by three cognates of one verdict each, of which 30 have their points on
/// one circuit, three also in order, and one can be driven.
#[test]
fn the_classical_nine_points_have_64_real_triples() {
    let data: Value = serde_json::from_str(include_str!("../data/nine_points.json")).unwrap();
    let read = |name: &str| std::fs::read_to_string(format!("mechanisms/designs/{name}")).unwrap();
    let asked = DesignDescription::read(&read("nine_points.ron")).unwrap();
    for (position, point) in asked
        .positions
        .iter()
        .zip(data["points"].as_array().unwrap())
    {
        let values = position[0].value.iter().map(|of| of.expression.as_number());
        assert_eq!(values.collect::<Vec<_>>(), pair(point).map(Some));
    }
    let design = Design {
        mechanism: Description::read(&read("four_bar_on_a_frame.ron")).unwrap(),
        asked,
        ..Design::default()
    };
    let report = design.report(&Watch::none()).unwrap();
    let exact = report.exact.as_ref().unwrap();
    let triples = exact.triples.unwrap();
    assert_eq!(
        (triples.generic, exact.generic, triples.real),
        (1442, 8652, 64)
    );
    assert!(triples.different >= 1441, "{triples:?}");
    assert_eq!(
        (exact.real, exact.outside, report.designs.len()),
        (192, 0, 192)
    );
    let text = linkwork::output::text::render(&linkwork::output::Report::document(&report));
    for said in [
        "1442 triples of cognates",
        "64 real",
        "of their 192 four-bars 0 outside",
    ] {
        assert!(text.contains(said), "{text}");
    }
    assert!(!text.contains("Stopped"), "{text}");
    let near = |a: [f64; 2], b: [f64; 2]| {
        let size = 1.0 + b[0].abs().max(b[1].abs());
        (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < 1e-6 * size
    };
    let mut seen = vec![0; report.designs.len()];
    let (mut on_one, mut in_order, mut driven) = (0, 0, 0);
    for triple in data["triples"].as_array().unwrap() {
        let pivots = triple["pivots"].as_array().unwrap();
        let pivots: Vec<[f64; 2]> = pivots.iter().map(pair).collect();
        // x, y, turn and l0 are the ground link
        let on = |values: &[f64]| {
            let [x, y, turn, l0] = [values[0], values[1], values[2], values[3]];
            let ends = [[x, y], [x + l0 * turn.cos(), y + l0 * turn.sin()]];
            ends.iter()
                .all(|end| pivots.iter().any(|pivot| near(*end, *pivot)))
        };
        let places: Vec<usize> = (0..report.designs.len())
            .filter(|i| on(&report.designs[*i].values))
            .collect();
        assert_eq!(places.len(), 3, "{pivots:?}");
        places.iter().for_each(|i| seen[*i] += 1);
        let mut best = false;
        for i in &places {
            let design = &report.designs[*i];
            assert!(design.sum_of_squares < 1e-18);
            let mut others: Vec<usize> = design
                .cognates
                .iter()
                .map(|of| of.design.unwrap() - 1)
                .collect();
            others.push(*i);
            others.sort_unstable();
            assert_eq!(others, places);
            let has = |kind: fn(&Defect) -> bool| design.defects.iter().any(kind);
            let circuit = has(|of| matches!(of, Defect::Circuit { .. }));
            let order = has(|of| matches!(of, Defect::Order { .. }));
            assert_eq!(!circuit, triple["one_circuit"], "{design:?}");
            assert_eq!(!circuit && !order, triple["in_order"], "{design:?}");
            on_one += usize::from(!circuit);
            in_order += usize::from(!circuit && !order);
            best |= design.defects.is_empty();
        }
        assert_eq!(best, triple["drivable"]);
        driven += usize::from(best);
    }
    assert!(seen.iter().all(|count| *count == 1));
    assert_eq!((on_one, in_order, driven), (90, 9, 1));
}
