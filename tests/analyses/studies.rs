//! Studies: points by their numbers, regions of grids, and shards put together.

use linkwork::ask::{Points, ScatteredPoints, regions};
use linkwork::output::study::{Label, MergeError, mapped, merge, spread};

const UNIT: [ScatteredPoints; 10] = [ScatteredPoints::Even(0.0, 1.0); 10];

#[test]
fn each_part_of_each_range_has_one_point_of_a_latin_hypercube() {
    for count in [1, 2, 7, 100, 1000] {
        let points = Points::LatinHypercube(count);
        for axis in 0..3 {
            let part = |i| (points.at(i, &UNIT[..3], 5)[axis] * count as f64) as usize;
            let mut parts: Vec<usize> = (0..count).map(part).collect();
            assert!(count < 100 || !parts.is_sorted());
            parts.sort_unstable();
            assert_eq!(parts, (0..count).collect::<Vec<_>>());
        }
    }
    let (a, b) = (Points::LatinHypercube(9), Points::LatinHypercube(9));
    assert_eq!(a.at(4, &UNIT[..2], 5), b.at(4, &UNIT[..2], 5));
    assert_ne!(a.at(4, &UNIT[..2], 5), b.at(4, &UNIT[..2], 6));
}

/// Every box of the binary kind with the right volume has one point: a (0, m, 2)-net in the first two dimensions, and
/// each dimension alone is one.
#[test]
fn sobols_points_are_evenly_spread() {
    let count = 256;
    let points = Points::Sobol(count);
    // with the corner that is left out
    let all = |i: usize| match i {
        0 => vec![0.0; 10],
        _ => points.at(i - 1, &UNIT, 1),
    };
    let all: Vec<Vec<f64>> = (0..count).map(all).collect();
    for axis in 0..10 {
        let mut parts: Vec<usize> = all.iter().map(|p| (p[axis] * 256.0) as usize).collect();
        parts.sort_unstable();
        assert_eq!(parts, (0..count).collect::<Vec<_>>(), "axis {axis}");
    }
    for bits in 0..=8 {
        let (a, b) = (f64::from(1 << bits), f64::from(1 << (8 - bits)));
        let mut boxes: Vec<usize> = (all.iter())
            .map(|p| (p[0] * a) as usize * b as usize + (p[1] * b) as usize)
            .collect();
        boxes.sort_unstable();
        assert_eq!(boxes, (0..count).collect::<Vec<_>>());
    }
}

/// The values that Joe and Kuo print for their first dimensions.
#[test]
fn sobols_first_points_are_those_published() {
    let expected = [
        [0.5, 0.5, 0.5],
        [0.75, 0.25, 0.25],
        [0.25, 0.75, 0.75],
        [0.375, 0.375, 0.625],
        [0.875, 0.875, 0.125],
    ];
    for (i, expected) in expected.iter().enumerate() {
        assert_eq!(Points::Sobol(9).at(i, &UNIT[..3], 1), expected);
    }
}

#[test]
fn a_grid_has_every_combination_with_the_ends() {
    let points = Points::Grid(vec![3, 1, 2]);
    let ranges =
        [(0.0, 0.3), (1.0, 3.0), (-1.0, 1.0)].map(|(from, to)| ScatteredPoints::Even(from, to));
    let all: Vec<Vec<f64>> = (0..6).map(|i| points.at(i, &ranges, 1)).collect();
    let (middle, end) = (0.5 * 0.3, 0.3);
    let expected = [
        [0.0, 2.0, -1.0],
        [0.0, 2.0, 1.0],
        [middle, 2.0, -1.0],
        [middle, 2.0, 1.0],
        [end, 2.0, -1.0],
        [end, 2.0, 1.0],
    ];
    assert_eq!(all, expected);
    assert_eq!(Points::Grid(vec![usize::MAX, 3]).count(), None);
}

/// Quantiles of the standard normal distribution: Abramowitz and Stegun, table 26.5, and its symmetry.
#[test]
fn normal_deviations_have_the_quantiles_of_the_tables() {
    let normal = ScatteredPoints::Normal(0.0, 1.0);
    // the value below which so many thousandths of all lie
    let at = |of, part| Points::Grid(vec![1001]).at(part, &[of], 1)[0];
    for (part, expected) in [
        (500, 0.0),
        (250, -0.674_489_750_196_08),
        (975, 1.959_963_984_540_05),
        (999, 3.090_232_306_167_81),
    ] {
        assert!((at(normal, part) - expected).abs() < 1e-13, "{part}");
    }
    assert!(at(normal, 0) < -8.0 && at(normal, 0).is_finite());
    assert_eq!(at(ScatteredPoints::Normal(3.0, 0.0), 100), 3.0);
    let count = 4096;
    let squares = (0..count).map(|i| Points::Sobol(count).at(i, &[normal], 1)[0].powi(2));
    assert!((squares.sum::<f64>() / count as f64 - 1.0).abs() < 0.01);
}

/// In six coordinates the nodes within a shell and the core it surrounds are two regions, and any plane through the
/// shell leaves it whole.
#[test]
fn a_shell_and_its_core_are_two_regions() {
    let nodes: usize = 7;
    let grid = [nodes; 6];
    let count = nodes.pow(6);
    let from_middle = |mut node: usize| {
        let mut most = 0;
        for _ in 0..6 {
            most = most.max((node % nodes).abs_diff(3));
            node /= nodes;
        }
        most
    };
    let within: Vec<bool> = (0..count).map(|node| from_middle(node) != 2).collect();
    let found = regions(&grid, &within).expect("the nodes of the grid");
    for (node, region) in found.iter().enumerate() {
        let expected = match from_middle(node) {
            3 => 1,
            2 => 0,
            _ => 2,
        };
        assert_eq!(*region, expected);
    }
}

#[test]
fn ends_of_lines_are_not_beside_each_other_and_corners_do_not_join() {
    let within = [true, false, false, true, true, false];
    assert_eq!(regions(&[2, 3], &within), Some(vec![1, 0, 0, 1, 1, 0]));
    assert_eq!(regions(&[3, 2], &within), Some(vec![1, 0, 0, 2, 3, 0]));
    // a bow that is one piece only by its far side
    let bow = [true, false, true, true, true, true];
    assert_eq!(regions(&[2, 3], &bow), Some(vec![1, 0, 1, 1, 1, 1]));
    assert_eq!(regions(&[2, 2], &within), None);
}

fn file(name: &str, rows: &[&str]) -> (String, String) {
    let (part, of) = (if name == "a" { 1 } else { 2 }, 2);
    let label = Label { part, of, mark: 7 };
    let rows = rows.join("\n");
    let text = format!("{label}row of 4,l2 (m),assembled\n{rows}\n");
    (name.into(), text)
}

#[test]
fn shards_in_any_order_and_more_than_once_are_the_study() {
    let (a, b) = (
        file("a", &["0,1,1", "1,2,1"]),
        file("b", &["2,3,1", "3,4,0"]),
    );
    let whole = "row of 4,l2 (m),assembled\n0,1,1\n1,2,1\n2,3,1\n3,4,0\n";
    for order in [vec![&a, &b], vec![&b, &a], vec![&b, &a, &b]] {
        let files: Vec<_> = order.into_iter().cloned().collect();
        let merged = merge(&files).expect("a whole study");
        assert_eq!(merged.rows, whole);
        let twice = (files.len() > 2).then(|| (2, ["b".to_owned(), "b".to_owned()]));
        assert_eq!(merged.twice, Vec::from_iter(twice));
    }
    // a whole study is one of itself, with and without a line that says so
    let alone = merge(&[("w".into(), whole.into())]);
    assert_eq!(alone.expect("a whole study").rows, whole);
}

#[test]
fn a_label_is_read_as_it_is_written() {
    let (part, of, mark) = (3, 200, 0x0c1f_0e8d_2b7a_9635);
    let label = Label { part, of, mark };
    let text = format!("{label}row of 9\n");
    assert!(text.starts_with("# shard 3 of 200 of study 0c1f0e8d2b7a9635\n"));
    assert_eq!(Label::of(&text), (Some(label), "row of 9\n"));
    assert_eq!(Label::of("row of 9\n"), (None, "row of 9\n"));
    assert_eq!(
        Label::of("# said by hand\nrow of 9\n"),
        (None, "row of 9\n")
    );
}

/// The sample standard deviation of 2, 4, 4, 4, 5, 5, 7, 9 is √(32/7).
#[test]
fn the_spread_of_each_column_leaves_out_what_is_empty() {
    let values = ["2", "4", "4", "", "4", "5", "5", "7", "9"];
    let rows: Vec<String> = (values.iter().enumerate())
        .map(|(i, x)| format!("{i},{x},1\n"))
        .collect();
    let text = format!("row of 9,\"f(a, b) (m)\",assembled\n{}", rows.concat());
    let expected = format!(
        "quantity,rows,mean,standard deviation,least,greatest\n\
         \"f(a, b) (m)\",8,5,{},2,9\nassembled,9,1,0,1,1\n",
        (32.0_f64 / 7.0).sqrt()
    );
    assert_eq!(spread(&text).ok(), Some(expected));
}

#[test]
fn shards_of_a_map_are_joined_across_their_seams() {
    let shards = [
        file("a", &["0,1,1", "1,2,0"]),
        file("b", &["2,1,1", "3,2,1"]),
    ];
    let whole = merge(&shards).expect("a whole study").rows;
    let expected = "row of 4,l2 (m),assembled,region\n0,1,1,1\n1,2,0,\n2,1,1,1\n3,2,1,1\n";
    assert_eq!(mapped(&whole, &[2, 2]).as_deref(), Ok(expected));
    let row = "row of 4,l2 (m),assembled,region\n0,1,1,1\n1,2,0,\n2,1,1,2\n3,2,1,2\n";
    assert_eq!(mapped(&whole, &[4]).as_deref(), Ok(row));
    let refused = Err(MergeError::Grid(4, vec![2, 3]));
    assert_eq!(mapped(&whole, &[2, 3]), refused);
}

#[test]
fn what_is_missing_or_foreign_is_named() {
    let (a, b) = (
        file("a", &["0,1,1", "1,2,1"]),
        file("b", &["2,3,1", "3,4,0"]),
    );
    let shard = |number| MergeError::MissingShards {
        shards: vec![number],
        of: 2,
    };
    assert_eq!(merge(std::slice::from_ref(&a)), Err(shard(2)));
    assert_eq!(merge(std::slice::from_ref(&b)), Err(shard(1)));
    // a shard that was interrupted
    let begun = file("a", &["0,1,1"]);
    let refused = MergeError::Missing {
        first: 1,
        last: 1,
        of: 4,
        file: Some("a".into()),
    };
    assert_eq!(merge(&[begun, b.clone()]), Err(refused));
    let named = |name: &str, from: &str, to: &str| (name.to_owned(), b.1.replace(from, to));
    let two = || ("c".to_owned(), "a".to_owned());
    let other = merge(&[a.clone(), named("c", "l2", "l3")]);
    assert_eq!(other, Err(MergeError::Other(two().0, two().1)));
    let other = merge(&[a.clone(), named("c", "study 0000", "study 0001")]);
    assert_eq!(other, Err(MergeError::OtherStudy(two().0, two().1)));
    let other = merge(&[
        a.clone(),
        named("c", "# shard 2 of 2 of study 0000000000000007\n", ""),
    ]);
    assert_eq!(other, Err(MergeError::Unlabelled("c".into())));
    let changed = ("c".to_owned(), a.1.replace("0,1,1", "0,1,0"));
    let files = ["a".to_owned(), "c".to_owned()];
    assert_eq!(merge(&[a, changed]), Err(MergeError::Differ(0, files)));
    let text = ("d".to_owned(), "theta1\n1\n".to_owned());
    assert_eq!(merge(&[text]), Err(MergeError::NoShard("d".into())));
    let (shards, of) = (vec![2, 5, 6, 7, 9], 9);
    let said = MergeError::MissingShards { shards, of }.to_string();
    assert!(said.contains("2, 5 to 7, 9"), "{said}");
}

#[test]
fn a_unit_at_one_end_of_a_range_counts_for_both() {
    use linkwork::ask::{Demand, Role};
    use linkwork::mechanism::Value;
    let ends = |from: &str, to: &str| {
        let demand = Demand::new(Role::Vary, "x", [from, to]);
        [0, 1].map(|end| demand.value(end))
    };
    let texts = |from: &str, to: &str| [from, to].map(|end| Value::Text(end.into()));
    assert_eq!(ends("10", "80deg"), texts("10 deg", "80deg"));
    assert_eq!(ends("-1.5e1", "80 °"), texts("-1.5e1 °", "80 °"));
    assert_eq!(ends("10 mm", "80"), texts("10 mm", "80 mm"));
    // each says its own, or neither does
    for (from, to) in [
        ("1", "2"),
        ("1 rad", "80 deg"),
        ("home", "80 deg"),
        ("pi/2", "180 deg"),
        ("l1", "3 m"),
    ] {
        assert_eq!(ends(from, to), texts(from, to));
    }
    // moved from 10°, not from 10 rad
    let (code, said, _) = super::linkwork(&[
        "sweep",
        "mechanisms/four_bar.ron",
        "--input",
        "theta1=10..80deg",
    ]);
    assert_eq!(code, 0);
    assert!(said.contains("theta1 from 10° to 80°"), "{said}");
}
