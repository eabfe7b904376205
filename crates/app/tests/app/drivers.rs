//! The drivers of this machine: none is passed on in silence, none that fails ends a run that did not
//! ask for it, and each makes the CPU's map.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use crate::common::command::Command;
use serde_json::Value;
use tempfile::TempDir;
use topple::backend::backend_error::BackendError;
use topple::backend::description::AdapterDescription;
use topple::backend::gpu::adapter;
use topple::backend::gpu::check;
use topple::backend::ready::Backend;
use topple::backend::request::{OpenBackends, first_that_opens};
use topple::model::precision::Precision;

use crate::common::{gpu, gpus, own_lines, say};

/// The command, on a small map.
fn pulse(out: &Path, more: &[&str]) -> Command {
    let mut command = Command::topple();
    command
        .args(["pulse", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--t-max", "6"])
        .args(["--omega", "1:12:12", "--a-h", "1:12:11", "--quiet", "--out"])
        .arg(out)
        .args(more);
    command
}

fn adapters() -> Command {
    let mut command = Command::topple();
    command.arg("adapters");
    command
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// The map's columns of outcomes, a line a cell.
fn outcomes(out: &Path) -> Vec<String> {
    let mut table = csv::Reader::from_path(out.join("map.csv")).unwrap();
    table.records().map(|row| row.unwrap()[2].to_string()).collect()
}

fn backend(out: &Path) -> String {
    let text = fs::read_to_string(out.join("run.json")).unwrap();
    serde_json::from_str::<Value>(&text).unwrap()["backend"].as_str().unwrap().into()
}

/// Over ssh and in containers XDG_RUNTIME_DIR is not set, and libwayland says so to whoever connects
/// to a window system. A run does not: without the variable it writes what it writes with it.
#[test]
fn no_run_looks_for_a_window_system() {
    let dir = TempDir::new().unwrap();
    let says = |mut command: Command| {
        command.env_remove("WAYLAND_DISPLAY").env_remove("DISPLAY");
        let with = command.env("XDG_RUNTIME_DIR", dir.path()).output().unwrap();
        let without = command.env_remove("XDG_RUNTIME_DIR").output().unwrap();
        assert_eq!(stderr(&without), stderr(&with));
        assert!(!stderr(&without).contains("XDG_RUNTIME_DIR"), "{}", stderr(&without));
        assert_eq!(without.status.code(), with.status.code());
        without.status.code()
    };
    let any = gpu("no_run_looks_for_a_window_system", Precision::F32).is_some();
    says(adapters());
    let out = dir.path().join("out");
    for choice in ["auto", "gpu"] {
        let status = says(pulse(&out, &["--backend", choice]));
        assert_eq!(status, Some(if any || choice == "auto" { 0 } else { 1 }));
    }
}

/// Mesa's driver for Radeon cards shows one that is not there, as RADV_FORCE_FAMILY says, and opens
/// no device of it.
#[test]
fn a_card_that_gives_no_device_is_passed_over() {
    let test = "a_card_that_gives_no_device_is_passed_over";
    let Some(radeon) = manifest("radeon") else {
        say(&format!("{test}: SKIPPED, Mesa's radeon driver is not installed"));
        return;
    };
    let on_it = |mut command: Command| {
        let command = command.env("RADV_FORCE_FAMILY", "navi21").env("VK_DRIVER_FILES", &radeon);
        command.env("VK_ICD_FILENAMES", &radeon).output().unwrap()
    };
    let listed = String::from_utf8(on_it(adapters()).stdout).unwrap();
    if !listed.contains("discrete") {
        say(&format!("{test}: SKIPPED, Mesa's radeon driver shows no card"));
        return;
    }
    let dir = TempDir::new().unwrap();
    let [auto, cpu, none] = ["auto", "cpu", "none"].map(|name| dir.path().join(name));
    for precision in ["f32", "f64"] {
        let ran = on_it(pulse(&auto, &["--precision", precision]));
        let said = own_lines(&stderr(&ran));
        assert!(ran.status.success(), "{said:?}");
        let [warning] = &said[..] else { panic!("{said:?}") };
        assert!(warning.starts_with("topple: warning: "), "{warning}");
        assert!(warning.ends_with("; computing on the CPU"), "{warning}");
        assert!(warning.contains("gave no device"), "{warning}");
        pulse(&cpu, &["--backend", "cpu", "--precision", precision]).assert().success();
        assert!(fs::read(auto.join("map.csv")).unwrap() == fs::read(cpu.join("map.csv")).unwrap());
        assert_eq!(backend(&auto), "cpu");
    }
    // Who asks for it is told that there is none.
    for asked in [&["--backend", "gpu"][..], &["--backend", "auto", "--adapter", "0"]] {
        let ran = on_it(pulse(&none, asked));
        let said = own_lines(&stderr(&ran));
        assert_eq!(ran.status.code(), Some(1), "{said:?}");
        let [error] = &said[..] else { panic!("{said:?}") };
        assert!(error.contains("gave no device") && !error.contains("warning"), "{error}");
        assert!(!none.join("map.csv").exists());
    }
}

/// A driver that two manifests name shows its device twice, which is one device all the same.
#[test]
fn an_adapter_that_two_manifests_name_counts_once() {
    let test = "an_adapter_that_two_manifests_name_counts_once";
    let Some(software) = manifest("lvp") else {
        say(&format!("{test}: SKIPPED, Mesa's software driver is not installed"));
        return;
    };
    let dir = TempDir::new().unwrap();
    let twin = dir.path().join("twice.json");
    fs::copy(&software, &twin).unwrap();
    let both = std::env::join_paths([&software, &twin]).unwrap();
    let ran = |mut command: Command| {
        command.env("VK_DRIVER_FILES", &both).env("VK_ICD_FILENAMES", &both).output().unwrap()
    };
    let listed = String::from_utf8(ran(adapters()).stdout).unwrap();
    assert_eq!(listed.lines().filter(|line| line.contains("llvmpipe")).count(), 1, "{listed}");
    let second = ran(pulse(&dir.path().join("out"), &["--backend", "gpu", "--adapter", "1"]));
    assert_eq!(second.status.code(), Some(2), "{}", stderr(&second));
}

/// A driver's file in the usual place.
fn manifest(driver: &str) -> Option<PathBuf> {
    let files = fs::read_dir("/usr/share/vulkan/icd.d").ok()?;
    let paths = files.filter_map(|entry| Some(entry.ok()?.path()));
    paths.filter(|path| path.file_name().is_some_and(is_of(driver))).min()
}

fn is_of(driver: &str) -> impl Fn(&std::ffi::OsStr) -> bool {
    move |name| {
        let name = name.to_string_lossy();
        name.starts_with(&format!("{driver}_icd.")) && name.ends_with(".json")
    }
}

/// Of several kinds of GPU the first is taken that has one that opens, with all of its kind that do; what
/// fails is told.
#[test]
fn the_first_kind_that_opens_is_taken() {
    // Stand-ins: true opens.
    let open = |able: bool| {
        if able { Ok(Backend::Reference) } else { Err(BackendError::Lost("unplugged".into())) }
    };
    let taken = |kinds: &[&[bool]]| {
        let kinds = kinds.iter().map(|kind| kind.to_vec()).collect();
        let OpenBackends { backends, passed_over } = first_that_opens(kinds, open);
        assert!(!backends.is_empty());
        let stands_in = backends.iter().all(|backend| matches!(backend, Backend::Reference));
        assert!(stands_in || matches!(backends[..], [Backend::Cpu]));
        (if stands_in { backends.len() } else { 0 }, passed_over.len())
    };
    assert_eq!(taken(&[&[true, true], &[true]]), (2, 0));
    assert_eq!(taken(&[&[false, true, false], &[true]]), (1, 2));
    assert_eq!(taken(&[&[false], &[false, true, true], &[true]]), (2, 2));
    assert_eq!(taken(&[&[false], &[false]]), (0, 2));
    assert_eq!(taken(&[]), (0, 0));
}

/// The check that `--backend auto` makes of a GPU: a device that computes passes, wrong numbers and a
/// shader that the driver refuses do not.
#[test]
fn a_device_is_checked_before_it_is_taken() {
    for precision in [Precision::F32, Precision::F64] {
        for gpu in gpus("a_device_is_checked_before_it_is_taken", precision) {
            gpu.check(precision).unwrap();
            let source = check::source(precision);
            for (from, to) in [("(3.0)", "(3.5)"), ("id.x) *", "id.y) *"), ("numbers", "no shader")]
            {
                let broken = source.replacen(from, to, 1);
                assert_ne!(broken, source);
                let failed = gpu.check_by(&broken).unwrap_err();
                assert!(matches!(failed, BackendError::FailedCheck { .. }), "{failed}");
                assert_eq!(failed.to_string().lines().count(), 1, "{failed}");
            }
            // It fails alone: the device goes on.
            gpu.check(precision).unwrap();
        }
    }
}

/// Every adapter, whichever driver it is of: in f32 it makes the CPU's map, in f64 too, or says that
/// it has none.
#[test]
fn every_adapter_makes_the_map_or_says_why_not() {
    let test = "every_adapter_makes_the_map_or_says_why_not";
    let all = adapter::all();
    if all.is_empty() {
        assert!(gpu(test, Precision::F32).is_none());
        return;
    }
    let dir = TempDir::new().unwrap();
    for precision in ["f32", "f64"] {
        let cpu = dir.path().join("cpu");
        pulse(&cpu, &["--backend", "cpu", "--precision", precision]).assert().success();
        for (number, adapter) in all.iter().enumerate() {
            let AdapterDescription { name, driver, f64, .. } = AdapterDescription::of(adapter);
            let (out, number) = (dir.path().join("gpu"), number.to_string());
            let more = ["--backend", "gpu", "--adapter", &number, "--precision", precision];
            let ran = pulse(&out, &more).output().unwrap();
            let said = own_lines(&stderr(&ran));
            if precision == "f64" && !f64 {
                assert_eq!(ran.status.code(), Some(1), "{said:?}");
                let [error] = &said[..] else { panic!("{said:?}") };
                assert!(error.contains(&name) && error.contains("no double precision"), "{error}");
                say(&format!("{test} (f64): SKIPPED, {name} ({driver}) has no double precision"));
                continue;
            }
            say(&format!("{test} ({precision}): adapter {name} ({driver})"));
            assert!(ran.status.success() && said.is_empty(), "{name}: {said:?}");
            assert_eq!(backend(&out), "gpu");
            let differ = outcomes(&out).iter().zip(&outcomes(&cpu)).filter(|(a, b)| a != b).count();
            assert_eq!(differ, 0, "{name}: outcomes differ from the CPU's");
        }
    }
}

/// Two adapters that are not alike, such as of two drivers, do not share a map.
#[test]
fn unlike_adapters_do_not_share_a_map() {
    let all: Vec<AdapterDescription> = adapter::all().iter().map(AdapterDescription::of).collect();
    let Some(other) = all.iter().position(|other| *other != all[0]) else {
        say("unlike_adapters_do_not_share_a_map: SKIPPED, the adapters are alike");
        return;
    };
    let dir = TempDir::new().unwrap();
    let both = format!("0,{other}");
    let ran = pulse(dir.path(), &["--backend", "gpu", "--adapter", &both]).output().unwrap();
    let said = own_lines(&stderr(&ran));
    assert_eq!(ran.status.code(), Some(2), "{said:?}");
    let [error] = &said[..] else { panic!("{said:?}") };
    assert!(error.contains("--adapter: ") && error.contains("are not alike"), "{error}");
}
