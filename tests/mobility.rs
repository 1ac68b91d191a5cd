//! Mobility against the counts of the literature and of independent programs.

use std::path::PathBuf;

use linkwork::analysis::mobility::{Character, MobilityReport, MobilitySettings, mobility};
use linkwork::mechanism::Mechanism;
use linkwork::system::Question;

fn load(name: &str) -> Mechanism {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("mechanisms")
        .join(format!("{name}.ron"));
    Mechanism::load(path).unwrap_or_else(|error| panic!("{name}: {error:?}"))
}

fn report(name: &str) -> MobilityReport {
    let mechanism = load(name);
    let question = Question::new(&mechanism);
    mobility(&question, &MobilitySettings::default())
        .closed()
        .unwrap_or_else(|| panic!("{name} does not close"))
}

#[test]
fn print_all() {
    let mut names: Vec<String> =
        std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/mechanisms"))
            .unwrap()
            .map(|e| {
                e.unwrap()
                    .path()
                    .file_stem()
                    .unwrap()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
    names.sort();
    for name in names {
        let mechanism = load(&name);
        let question = Question::new(&mechanism);
        let start = std::time::Instant::now();
        let report = mobility(&question, &MobilitySettings::default()).closed();
        let time = start.elapsed();
        let none = MobilitySettings {
            elsewhere: 0,
            ..MobilitySettings::default()
        };
        let start = std::time::Instant::now();
        let _ = mobility(&question, &none);
        let time2 = start.elapsed();
        match report {
            None => println!("{name}: NOT CLOSED"),
            Some(r) => {
                println!(
                    "{name}: {} k{} rank{} inf{} red{} {:?} idle{:?} {:?} {time:?} {time2:?}\n    {}",
                    r.mobility,
                    r.kutzbach,
                    r.rank,
                    r.infinitesimal,
                    r.redundant,
                    r.character,
                    r.idle_joints,
                    r.idle_freedoms.len(),
                    r.explanation
                );
                for l in &r.loops {
                    println!(
                        "    loop {} f{} order{} k{} {} : {:?} {:?}",
                        l.closure, l.freedoms, l.order, l.kutzbach, l.by_order, l.bodies, l.joints
                    );
                }
                for t in &r.twists {
                    println!("    {} {:?}", t.body, t.screws);
                }
                for b in &r.branches {
                    println!("    branch {} {:?}", b.mobility, b.moving_joints);
                }
                let _ = Character::Regular;
            }
        }
    }
}

#[test]
fn known() {
    assert_eq!(report("bennett").mobility, 1);
}
