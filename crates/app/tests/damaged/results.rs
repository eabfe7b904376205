//! What runs have left: run.json, map.npz, map.zarr, shards of a map, lists of a refined one; and hazard curves.

use std::fs;
use std::io::Cursor;
use std::panic;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use serde_json::{Value, json};
use tempfile::TempDir;
use topple::results::earlier::Earlier;
use topple::results::rounds::Rounds;
use topple::results::{npz, zarr};
use topple::sweep::map::MapSweep;
use topple::sweep::shards::Shards;
use topple::{
    BackendRequest, Column, Job, Outcome, Precision, RunSettings, Saving, Scene, SceneBuilder,
    Unwatched, VerifySettings, sweep,
};
use topple_app::earlier_run;
use topple_manifest::Run;
use topple_studies::fragility::hazard_text;
use topple_studies::{Intensity, Lognormal};

use crate::records::AT2;

use crate::scenes;

/// A folder with a record, which scenes lead to.
static RECORDS: LazyLock<TempDir> = LazyLock::new(|| {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("h.at2"), AT2).unwrap();
    folder
});

fn of_toml(text: &str) -> Scene {
    SceneBuilder::from_toml(text).unwrap().check_in(RECORDS.path()).unwrap()
}

fn under_a_pulse() -> Scene {
    of_toml(
        "[block]\nobject = 1\n[base]\nt_h = 1.75\nt_v = 0.75\n[pulse]\nomega = \"3:6:3\"\na_h = [2, 5]\n\
         [run]\nt_max = 1\n",
    )
}

fn under_a_record() -> Scene {
    of_toml(
        "[block]\nobject = 1\n[base]\nt_h = \"1:2:3\"\nt_v = 0.75\n[record]\nhorizontal = \"h.at2\"\n",
    )
}

/// How maps of this test are computed: on the CPU, saved nowhere, not verified.
fn settings() -> RunSettings {
    let mut settings = RunSettings::default();
    (settings.backend, settings.verify) = (BackendRequest::Cpu, VerifySettings::cells(0));
    settings
}

fn map(scene: &Scene) -> MapSweep {
    sweep(scene, &[], &settings(), &Unwatched).unwrap()
}

/// run.json of a scene, with more than the reader looks at.
fn written(scene: &Scene, more: Value) -> Vec<u8> {
    let mut text = json!({
        "kind": "map", "version": "0.1.0", "tag": 7, "scene": scene, "record": scene.excitation.provenance(),
        "backend": "cpu", "precision": "f32", "largest_step": 0.0078125, "resolve": false, "full_model": false,
        "repair": true, "cells": 6, "files": ["map.csv", "map.npz"],
    });
    text.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    serde_json::to_vec_pretty(&text).unwrap()
}

pub fn manifests() -> Vec<Vec<u8>> {
    let uncertain = json!({
        "kind": "probability", "vary": ["t_h=normal(1.75,0.1)"], "pixel": false, "samples": 64, "seed": 0,
    });
    vec![
        written(&under_a_pulse(), json!({})),
        written(&under_a_pulse(), uncertain),
        written(&under_a_record(), json!({})),
    ]
}

/// What is at a path is run again, or at least planned.
fn run_again(path: &Path) -> Result<(), String> {
    let found = earlier_run::at(path).ok_or("no results")??;
    let run = found.manifest.as_ref().map(|manifest| &manifest.run);
    if let Some(method) = run.and_then(Run::of_scene).and_then(|of| of.method) {
        method.plan(&found.scene).map_err(|error| error.to_string())?;
    }
    if let Some(Run::Probability(of)) = run
        && let Some(uncertainty) = &of.uncertainty
    {
        // A million sweeps may be asked for: that takes its time, and is no fault.
        let few = uncertainty.samples.min(64);
        let uncertainty = topple_studies::Uncertainty { samples: few, ..uncertainty.clone() };
        uncertainty.check(&found.scene, true).map_err(|error| error.to_string())?;
    }
    scenes::plan(&found.scene)
}

pub fn manifest(bytes: &[u8]) -> Result<(), String> {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("run.json"), bytes).unwrap();
    let _ = Earlier::of(folder.path());
    run_again(folder.path())
}

pub fn archives() -> Vec<Vec<u8>> {
    let of = |scene: &Scene| {
        let (map, mut file) = (map(scene), Cursor::new(Vec::new()));
        npz::write(&map.grid, &*map.outcomes, map.source(), &mut file).unwrap();
        file.into_inner()
    };
    vec![of(&under_a_pulse())]
}

pub fn archive(bytes: &[u8]) -> Result<(), String> {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("map.npz");
    fs::write(&path, bytes).unwrap();
    run_again(&path)
}

pub fn groups() -> Vec<Vec<u8>> {
    let map = map(&under_a_pulse());
    let (_, group) = zarr::documents(&map.grid, &map.source()).pop().unwrap();
    vec![group.to_string().into_bytes()]
}

pub fn group(bytes: &[u8]) -> Result<(), String> {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("map.zarr");
    fs::create_dir(&path).unwrap();
    fs::write(path.join(zarr::DOCUMENT), bytes).unwrap();
    run_again(&path)
}

/// The shards of a map, and the paths of their files, those of what was run first.
static SHARDS: LazyLock<(TempDir, Vec<PathBuf>)> = LazyLock::new(|| {
    let folder = TempDir::new().unwrap();
    for shard in ["1/2", "2/2"] {
        let mut settings = settings();
        let shard = Some(shard.parse().unwrap());
        settings.saving = Some(Saving { shard, ..Saving::to(folder.path()) });
        Job::open(&under_a_record(), &[], &settings).unwrap().run(None, &Unwatched).unwrap();
    }
    let (mut open, mut files) = (vec![folder.path().to_path_buf()], Vec::new());
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => open.push(path),
                false => files.push(path.strip_prefix(folder.path()).unwrap().to_path_buf()),
            }
        }
    }
    // What says what was run is damaged as often as all else.
    files
        .sort_by_key(|path| (path.extension().is_none_or(|ending| ending != "json"), path.clone()));
    (folder, files)
});

/// Bytes of a checksum at the end of a chunk's file.
const SUM: usize = 4;

/// A file of a shard is told by its place among all, and a chunk's file whose checksum is made anew by a 1 after it.
pub fn pieces() -> Vec<Vec<u8>> {
    let (folder, files) = &*SHARDS;
    assert!(files.len() < 256, "{}", files.len());
    let numbered = (0_u8..).zip(files);
    let of = |(number, path): (u8, &PathBuf)| {
        let bytes = fs::read(folder.path().join(path)).unwrap();
        [0, 1].map(|again| [&[number, again][..], &bytes].concat())
    };
    numbered.flat_map(of).collect()
}

pub fn shard(bytes: &[u8]) -> Result<(), String> {
    let (folder, files) = &*SHARDS;
    let Some(([number, again], bytes)) = bytes.split_first_chunk::<2>() else { return Ok(()) };
    let (damaged, mut bytes) = (usize::from(*number) % files.len(), bytes.to_vec());
    let is_chunk = files[damaged].extension().is_none();
    if is_chunk && again % 2 == 1 && bytes.len() >= SUM {
        let body = bytes.len() - SUM;
        let sum = crc32c::crc32c(&bytes[..body]).to_le_bytes();
        bytes[body..].copy_from_slice(&sum);
    }
    // Cases run one at a time, and each puts back what was there.
    let place = folder.path().join(&files[damaged]);
    let whole = fs::read(&place).unwrap();
    fs::write(&place, &bytes).unwrap();
    let joined = panic::catch_unwind(|| join(folder.path()));
    fs::write(&place, whole).unwrap();
    joined.unwrap_or_else(|panic| panic::resume_unwind(panic))
}

/// Joins the shards in a folder, and reads some columns.
fn join(folder: &Path) -> Result<(), String> {
    let joined = Shards::join(&[folder.to_path_buf()], &Unwatched);
    let shards = joined.map_err(|error| error.to_string())?;
    let map = MapSweep::of_shards(shards, None).map_err(|error| error.to_string())?;
    for column in [Column::Outcome, Column::Status, Column::Zeta] {
        map.column(column).map_err(|error| error.to_string())?;
    }
    Ok(())
}

/// Cells of the saved list, and the tag of its run.
const LIST: ([usize; 3], u32) = ([3, 70_000, 5], 7);

fn saved_lists(folder: &Path) -> Rounds {
    Rounds::open(folder, LIST.1, Precision::F32).unwrap()
}

pub fn rounds() -> Vec<Vec<u8>> {
    let folder = TempDir::new().unwrap();
    saved_lists(folder.path()).save(&LIST.0, &[Outcome::PENDING; 3]).unwrap();
    vec![fs::read(folder.path().join("round-00000")).unwrap()]
}

pub fn round(bytes: &[u8]) -> Result<(), String> {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("round-00000"), bytes).unwrap();
    let taken = saved_lists(folder.path()).take(&LIST.0);
    taken.map(|outcomes| assert_eq!(outcomes.len(), 3)).ok_or("the cells are run again".into())
}

pub fn curves() -> Vec<Vec<u8>> {
    let curve = "level,rate\n0.1,0.5\n0.2,0.05\n1,1e-3\n4,1e-5\n";
    let site = "#,,\"generated_by='OpenQuake engine 3.15.0', investigation_time=50.0, imt='PGA'\"\n\
        lon,lat,depth,poe-0.05,poe-0.1,poe-0.4\n0.0,0.0,-0.1,1.0,6.1E-01,3.3E-02\n";
    let spread = curve.replace(',', ";").replace('.', ",");
    let marked = format!("\u{feff}{}", curve.replace('\n', "\r\n"));
    let blanks =
        format!("# PGA [g], AFE\n{}", curve.replace(',', "  ").replace("level  rate\n", ""));
    [curve.to_string(), site.to_string(), marked, format!("sep=;\n{spread}"), blanks]
        .map(String::into_bytes)
        .to_vec()
}

pub fn curve(bytes: &[u8]) -> Result<(), String> {
    let curve = hazard_text::of_bytes(bytes, Intensity::Pga, None);
    let curve = curve.map_err(|error| error.to_string())?.curve;
    for (theta, beta) in [(0.5, 0.4), (1.0, 1e-9), (1e-300, 5.0), (1e300, 0.0), (2.0, 300.0)] {
        let rate = curve.rate(Lognormal { theta, beta }).rate;
        assert!(rate >= 0.0, "{theta} {beta}: {rate}");
    }
    Ok(())
}
