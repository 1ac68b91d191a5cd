//! The order of the modules: each uses only those left of it.

use std::path::{Path, PathBuf};

/// The library's modules, from the one that uses no other to the one that may use all.
///
/// `interchange` makes descriptions from files of other programs and such files from mechanisms: it knows both and
/// nothing of systems and analyses.
const ORDER: [&str; 12] = [
    "number",
    "linear",
    "algebra",
    "geometry",
    "solve",
    "description",
    "mechanism",
    "interchange",
    "system",
    "analysis",
    "scene",
    "output",
];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in folder.read_dir().unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
}

/// Every source file: its path within `src` as parts without `.rs`, and its text without comments.
fn files() -> Vec<(Vec<String>, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut paths = Vec::new();
    sources(&root, &mut paths);
    paths.sort();
    let read = |path: &PathBuf| {
        let within = path.strip_prefix(&root).unwrap().with_extension("");
        let parts = within.iter().map(|part| part.to_str().unwrap().to_owned());
        let text = std::fs::read_to_string(path).unwrap();
        let code = text
            .lines()
            .map(|line| line.split("//").next().unwrap_or_default());
        (parts.collect(), code.collect::<Vec<_>>().join("\n"))
    };
    paths.iter().map(read).collect()
}

/// The paths that begin with `start`, as far as they are one name after the other; `start{a, b::c}` gives two.
fn uses(code: &str, start: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (at, _) in code.match_indices(start) {
        let before = code[..at].chars().next_back();
        if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':') {
            continue;
        }
        let rest = &code[at + start.len()..];
        match rest.strip_prefix('{') {
            None => found.push(path(rest)),
            Some(list) => {
                let mut depth = 0;
                let end = list.find(|c| {
                    depth += i32::from(c == '{') - i32::from(c == '}');
                    depth < 0
                });
                let mut depth = 0;
                let separate = |c: char| {
                    depth += i32::from(c == '{') - i32::from(c == '}');
                    depth == 0 && c == ','
                };
                let parts = list[..end.unwrap_or(list.len())].split(separate);
                found.extend(parts.map(|part| path(part.trim())));
            }
        }
    }
    found.retain(|path| !path.is_empty());
    found
}

fn path(text: &str) -> String {
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
    text[..end.unwrap_or(text.len())].to_owned()
}

fn place(module: &str) -> Option<usize> {
    ORDER.iter().position(|&known| known == module)
}

#[test]
fn a_module_uses_only_those_left_of_it() {
    let mut wrong = Vec::new();
    for (parts, code) in files() {
        let Some(own) = place(&parts[0]) else {
            continue;
        };
        for used in uses(&code, "crate::") {
            let module = used.split("::").next().unwrap_or_default();
            match place(module) {
                Some(other) if other <= own => {}
                _ => wrong.push(format!("src/{}.rs uses {used}", parts.join("/"))),
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_module_has_its_place_in_the_order() {
    for (parts, _) in files() {
        let known = place(&parts[0]).is_some();
        let outside = ["lib", "main", "cli", "guide"].contains(&parts[0].as_str());
        assert!(known || outside, "src/{} has no place", parts[0]);
    }
}

#[test]
fn analyses_do_not_use_one_another() {
    let mut wrong = Vec::new();
    for (parts, code) in files() {
        let ("analysis", Some(own)) = (parts[0].as_str(), parts.get(1)) else {
            continue;
        };
        let mut used = uses(&code, "crate::analysis::");
        // the file of an analysis reaches the others with one `super`, files below it with two
        let up = "super::".repeat(parts.len() - 1);
        used.extend(uses(&code, &up));
        for used in used {
            let analysis = used.split("::").next().unwrap_or_default();
            if analysis != own && analysis != "super" {
                wrong.push(format!("src/{}.rs uses {used}", parts.join("/")));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_command_line_sees_only_what_the_library_shows() {
    for (parts, code) in files() {
        if !["main", "cli"].contains(&parts[0].as_str()) {
            continue;
        }
        for used in uses(&code, "crate::") {
            let own = used.split("::").next() == Some("cli");
            assert!(own, "src/{}.rs uses {used}", parts.join("/"));
        }
        let file = parts.join("/");
        assert!(!code.contains("#[path"), "src/{file}.rs includes a module");
        assert!(!code.contains("include!"), "src/{file}.rs includes a file");
        for line in code.lines().filter(|line| line.starts_with("use ")) {
            let first = path(line.trim_start_matches("use "));
            let first = first.split("::").next().unwrap_or_default();
            let allowed = ["std", "clap", "linkwork", "super", "self"];
            assert!(allowed.contains(&first), "src/{file}.rs uses {first}");
        }
    }
}

#[test]
fn uses_are_found_in_all_their_forms() {
    let code = "use crate::a::B;\nuse crate::{c, d::{E, F}, g};\nlet x = crate::h::i(1);";
    assert_eq!(uses(code, "crate::"), ["a::B", "c", "d::", "g", "h::i"]);
    assert_eq!(uses("supercrate::x", "crate::"), [""; 0]);
}
