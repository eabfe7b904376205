//! run.json of each kind as an earlier commit wrote it is read, and written again as it was.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;
use topple_manifest::{Manifest, Run};

use crate::common::command::Command;

fn text(kind: &str) -> String {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/earlier");
    fs::read_to_string(data.join(format!("{kind}.json"))).unwrap()
}

fn read(kind: &str) -> Run {
    Manifest::parse(&text(kind)).unwrap().run
}

/// A scene tells how many samples its record has, not the samples.
fn leave_samples_out(value: &mut Value) {
    match value {
        Value::Object(inner) => {
            inner.remove("excitation");
            inner.values_mut().for_each(leave_samples_out);
        }
        Value::Array(inner) => inner.iter_mut().for_each(leave_samples_out),
        _ => {}
    }
}

/// What is read, and not only written, has the keys and the values of the file.
#[test]
fn each_kind_is_written_as_it_was_read() {
    // Nothing but a person reads these, or they follow from the scene.
    let only_written = ["device", "steps", "timings", "model", "outcome"];
    // Envelopes had none.
    let new = ["replicates"];
    for kind in ["map", "history", "probability", "suite", "envelope", "fragility", "comparison"] {
        let manifest = Manifest::parse(&text(kind)).unwrap();
        assert_eq!(serde_json::to_value(manifest.run.kind()).unwrap(), kind);
        let mut before: Value = serde_json::from_str(&text(kind)).unwrap();
        let mut after = serde_json::to_value(&manifest).unwrap();
        [&mut before, &mut after].into_iter().for_each(leave_samples_out);
        let (before, after) = (before.as_object().unwrap(), after.as_object().unwrap());
        for (key, value) in before.iter().filter(|(key, _)| !only_written.contains(&key.as_str())) {
            assert_eq!(after.get(key), Some(value), "{kind}: {key}");
        }
        let more = after.keys().find(|key| !before.contains_key(*key));
        assert!(more.is_none_or(|key| new.contains(&key.as_str())), "{kind}: {more:?}");
    }
}

#[test]
fn what_repeats_a_run_is_read() {
    let (Run::Map(map), Run::History(history)) = (read("map"), read("history")) else { panic!() };
    assert_eq!(map.refined.unwrap().levels.len(), 1);
    assert!(map.sharpness.is_some() && map.of.method.is_some());
    assert_eq!(history.more_columns, "acc_plate,n");
    let Run::Probability(probability) = read("probability") else { panic!() };
    assert_eq!(probability.uncertainty.unwrap().samples, 4);
    for kind in ["suite", "envelope", "fragility", "comparison"] {
        let run = read(kind);
        assert_eq!(
            run.command().unwrap().arguments[0].0.to_str(),
            Some(match kind {
                "comparison" => "compare",
                kind => kind,
            })
        );
        assert_eq!(run.records().unwrap().len(), 4, "{kind}");
    }
    assert_eq!(read("comparison").inputs().unwrap().len(), 2);
}

/// The command runs a history again of its old file alone.
#[test]
fn an_old_history_runs_again() {
    let place = TempDir::new().unwrap();
    fs::write(place.path().join("run.json"), text("history")).unwrap();
    let out = place.path().join("again");
    Command::topple().arg("run").arg(place.path()).arg("--out").arg(&out).assert().success();
    let table = fs::read_to_string(out.join("history.csv")).unwrap();
    assert!(table.lines().next().unwrap().ends_with("acc_plate,n"), "{table}");
}
