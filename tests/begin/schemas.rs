//! Each report is what the schema of its command says, and nothing else.

use serde_json::Value;

use super::{answer, run};

/// Differences of a value from a schema of the parts of JSON Schema that schemas of reports use. Fields that no part of
/// the schema names are differences too.
fn differences(value: &Value, schema: &Value, root: &Value, at: &str) -> Vec<String> {
    let mut named = Vec::new();
    let mut found = compare(value, schema, root, at, &mut named);
    if let (Value::Object(fields), true) = (value, has_fields(schema, root)) {
        for name in fields.keys().filter(|name| !named.contains(name)) {
            found.push(format!("{at}: the schema has no `{name}`"));
        }
    }
    found
}

fn resolved<'s>(schema: &'s Value, root: &'s Value) -> &'s Value {
    match schema["$ref"].as_str() {
        Some(reference) => {
            let name = reference.strip_prefix("#/$defs/").unwrap();
            let name = name
                .replace("%20", " ")
                .replace("~1", "/")
                .replace("~0", "~");
            resolved(&root["$defs"][name], root)
        }
        None => schema,
    }
}

fn alternatives<'s>(schema: &'s Value, key: &str) -> &'s [Value] {
    schema[key].as_array().map_or(&[], Vec::as_slice)
}

/// True if a schema says which fields there are.
fn has_fields(schema: &Value, root: &Value) -> bool {
    let schema = resolved(schema, root);
    let parts = ["allOf", "anyOf", "oneOf"].map(|key| alternatives(schema, key));
    schema.get("properties").is_some() || parts.concat().iter().any(|part| has_fields(part, root))
}

fn compare<'v>(
    value: &'v Value,
    schema: &Value,
    root: &Value,
    at: &str,
    named: &mut Vec<&'v String>,
) -> Vec<String> {
    let own = match schema.get("$ref") {
        Some(_) => compare(value, resolved(schema, root), root, at, named),
        None => Vec::new(),
    };
    let mut found = own;
    let kinds: Vec<&str> = match &schema["type"] {
        Value::String(kind) => vec![kind],
        Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
        _ => Vec::new(),
    };
    let is = |kind: &&str| match *kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_u64() || value.is_i64(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        other => panic!("the type {other}"),
    };
    if !kinds.is_empty() && !kinds.iter().any(is) {
        found.push(format!("{at}: {value} is none of {kinds:?}"));
    }
    if schema.get("const").is_some_and(|only| only != value) {
        found.push(format!("{at}: {value} is not {}", schema["const"]));
    }
    if let Some(values) = schema["enum"].as_array()
        && !values.contains(value)
    {
        found.push(format!("{at}: {value} is none of {values:?}"));
    }
    if let Value::Object(fields) = value {
        for name in alternatives(schema, "required") {
            if !fields.contains_key(name.as_str().unwrap()) {
                found.push(format!("{at}: {name} is missing"));
            }
        }
        for (name, inner) in fields {
            let at = format!("{at}.{name}");
            if let Some(schema) = schema["properties"].get(name) {
                named.push(name);
                found.extend(differences(inner, schema, root, &at));
            } else if schema["additionalProperties"].is_object() {
                named.push(name);
                found.extend(differences(
                    inner,
                    &schema["additionalProperties"],
                    root,
                    &at,
                ));
            }
        }
    }
    if let Value::Array(items) = value {
        let first = alternatives(schema, "prefixItems");
        for (i, item) in items.iter().enumerate() {
            if let Some(schema) = first.get(i).or(schema.get("items")) {
                found.extend(differences(item, schema, root, &format!("{at}[{i}]")));
            }
        }
        let [least, most] = ["minItems", "maxItems"].map(|key| schema[key].as_u64());
        let count = items.len() as u64;
        if least.is_some_and(|least| count < least) || most.is_some_and(|most| count > most) {
            found.push(format!("{at}: {count} items"));
        }
    }
    for part in alternatives(schema, "allOf") {
        found.extend(compare(value, part, root, at, named));
    }
    for key in ["anyOf", "oneOf"] {
        let parts = alternatives(schema, key).iter().map(|part| {
            let mut own = Vec::new();
            let found = compare(value, part, root, at, &mut own);
            // fields that only another alternative names
            let more = match value {
                Value::Object(fields) => fields.len() - own.len().min(fields.len()),
                _ => 0,
            };
            (found.len(), more, found, own)
        });
        if let Some((_, _, least, own)) = parts.min_by_key(|part| (part.0, part.1)) {
            named.extend(own);
            found.extend(least);
        }
    }
    found
}

/// Questions whose answers together have most fields that reports can have.
const ASKED: [&str; 40] = [
    "assemblies four_bar.ron --all-complex",
    "assemblies four_bar.ron --prove --hold theta1=1",
    "assemblies two_rhombi.ron",
    "check three_rps.ron",
    "check axes/gears.ron",
    "check three_fingered_hand_distances.ron",
    "compare three_rps.ron --samples 5",
    "compare four_bar.ron --samples 5",
    "convert four_bar.ron --cut phi2",
    "convert four_bar.ron --to axes",
    "convert four_bar.ron --cognate left+0.5,0.2=1",
    "design designs/function_generator.ron",
    "equilibrium loads/wishbone.ron",
    "equilibrium loads/toggle_press.ron",
    "formulas four_bar.ron",
    "formulas four_bar.ron --solve",
    "formulas puma560_modified.ron --of arm.3",
    "frames axes/puma560.ron --steps",
    "frames four_bar.ron",
    "mobility bennett.ron",
    "mobility triangle.ron",
    "mobility rssr.ron",
    "simulate loads/four_bar_let_go.ron --time 0.2",
    "simulate loads/trebuchet.ron --time 0.2",
    "singularities three_rps.ron",
    "singularities four_bar.ron --input theta1=0deg..360deg",
    "singularities five_bar_hand.ron --locus hand.x=-0.6..0.8 --locus hand.y=-0.1..0.7 --starts 2",
    "snap four_bar.ron",
    "solve four_bar.ron",
    "solve three_rps.ron --free actuated --hold top.z=0.5",
    "solve four_bar.ron --set l2=0.5",
    "solve parallelogram.ron",
    "statics three_rps.ron --wrench top=0,0,-100",
    "statics four_bar.ron --load phi1=2",
    "sweep four_bar.ron --input theta1=0deg..360deg --steps 4 --of left --report transmission",
    "sweep four_bar.ron --circuits",
    "sweep four_bar.ron --follow",
    "velocity three_rps.ron --rate l1=0.1",
    "velocity four_bar.ron --rate theta1=1 --point left+0.5,0.2",
    "workspace five_bar_hand.ron --map hand.x=-0.6..0.8 --map hand.y=-0.1..0.7 --grid 12",
];

#[test]
fn reports_are_what_the_schemas_say() {
    let mut wrong = Vec::new();
    for asked in ASKED {
        let mut words: Vec<String> = asked.split(' ').map(str::to_owned).collect();
        words[1] = format!("mechanisms/{}", words[1]);
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let output = run(&[&words[..], &["--format", "json"]].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        let value = serde_json::from_slice(&output.stdout);
        let value: Value = value.unwrap_or_else(|_| panic!("{asked}: {said}"));
        let schema: Value = serde_json::from_str(&answer(&[words[0], "--schema"])).unwrap();
        let found = differences(&value, &schema, &schema, "");
        wrong.extend(
            found
                .into_iter()
                .take(5)
                .map(|line| format!("{asked} {line}")),
        );
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Built with the feature `schema`, the program prints the schemas of its types: those that are shipped are the same.
#[cfg(feature = "schema")]
#[test]
fn shipped_schemas_are_those_of_the_types() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/cli/schemas");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let command = path.file_stem().unwrap().to_str().unwrap();
        let generated: Value = serde_json::from_str(&answer(&[command, "--schema"])).unwrap();
        if std::env::var_os("UPDATE_SCHEMAS").is_some() {
            std::fs::write(&path, format!("{generated}\n")).unwrap();
        }
        let shipped: Value =
            serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        assert_eq!(
            shipped, generated,
            "{command}: UPDATE_SCHEMAS=1 writes it anew"
        );
    }
}

/// The comparison finds what is wrong.
#[test]
fn another_report_is_not_what_the_schema_says() {
    let schema: Value = serde_json::from_str(&answer(&["solve", "--schema"])).unwrap();
    let output = run(&["solve", "mechanisms/four_bar.ron", "--format", "json"]);
    let right: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(differences(&right, &schema, &schema, ""), [""; 0]);
    let changed = |name: &str, with: Option<Value>| {
        let mut value = right.clone();
        let fields = value.as_object_mut().unwrap();
        match with {
            Some(with) => drop(fields.insert(name.into(), with)),
            None => drop(fields.remove(name)),
        }
        differences(&value, &schema, &schema, "")
    };
    assert_eq!(changed("residual", None).len(), 1);
    assert_eq!(changed("residual", Some("small".into())).len(), 1);
    assert_eq!(changed("unheard_of", Some(1.into())).len(), 1);
    let mobility = run(&["mobility", "mechanisms/four_bar.ron", "--format", "json"]);
    let other: Value = serde_json::from_slice(&mobility.stdout).unwrap();
    assert!(!differences(&other, &schema, &schema, "").is_empty());
}
