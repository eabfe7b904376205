//! The pictures of the pages: what draws each of them, and that none is older than the program.
//!
//! `TOPPLE_WRITE_PICTURES=1 cargo test --release --test app docs_pictures::` draws all of them anew for which there is what they
//! need, and says which are left; a word in the place of 1 draws those whose place contains it. Without it those that are drawn in seconds are drawn and compared.

use std::collections::BTreeSet;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use tempfile::TempDir;

/// What a picture needs beside the program.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Needs {
    /// Nothing but seconds.
    Seconds,
    /// Nothing but minutes.
    Minutes,
    /// The directory of TOPPLE_RECORDS, with its folder `suite`.
    Records,
    /// The Python package, matplotlib and pandas.
    Python,
    /// The same, and the records.
    PythonAndRecords,
    /// Chromium, Playwright and Pillow.
    Browser,
}

use Needs::{Browser, Minutes, Python, PythonAndRecords, Records, Seconds};

/// Pictures by their places in the repository, each with the file that is drawn; and the lines of a shell that draw them, in an empty folder.
/// ROOT is the repository, RECORDS the directory of the records.
struct Drawn {
    needs: Needs,
    pictures: &'static [(&'static str, &'static str)],
    script: &'static str,
}

const ALL: [Drawn; 18] = [
    Drawn {
        needs: Seconds,
        pictures: &[("docs/default-map.png", "map/map.png")],
        script: "topple run $ROOT/scenes/default.toml --out map",
    },
    Drawn {
        needs: Seconds,
        pictures: &[("docs/axes-eccentricity.png", "eccentricity/map.png")],
        script: "topple pulse --object 1 --eccentricity -0.6:0.6:301 --t-h 0.5:4:300 --t-v 0.75 --omega 4 --a-h 6 --out eccentricity",
    },
    Drawn {
        needs: Seconds,
        pictures: &[("docs/axes-size.png", "size/map.png")],
        script: "topple pulse --half-width 0.05:0.4:300 --height 0.3:1.5:301 --isolation none --omega 5 --a-h 4 --out size",
    },
    Drawn {
        needs: Seconds,
        pictures: &[("docs/pulses-ricker.png", "ricker/map.png")],
        script: "topple pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 --a-v 0.5 --pulse ricker \
                 --omega 0.5:15:400 --a-h 0.1:15:400 --t-max 45 --out ricker",
    },
    Drawn {
        needs: Seconds,
        pictures: &[("docs/pulses-modulated.png", "modulated/map.png")],
        script: "topple pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 --pulse mavroeidis-papageorgiou \
                 --gamma 1:4:300 --phase 0:6.28:300 --omega 4 --a-h 5 --out modulated",
    },
    Drawn {
        needs: Seconds,
        pictures: &[("docs/seismic-map.png", "seismic/map.png")],
        script: "topple seismic --object 1 --eccentricity -0.4 --t-h 0.5:4:200 --t-v 0.02:2:200 --out seismic",
    },
    Drawn {
        needs: Seconds,
        pictures: &[
            ("docs/chart-pulse.png", "chart/pulse.png"),
            ("docs/chart-record.png", "chart/record.png"),
            ("docs/chart-free.png", "chart/free.png"),
            ("docs/chart-maps.png", "chart/maps.png"),
        ],
        script: "topple chart --redraw $ROOT/docs/chart.csv --out chart",
    },
    Drawn {
        needs: Seconds,
        pictures: &[("docs/compare.png", "compared/compare.png")],
        script: "PAGE compare",
    },
    Drawn {
        needs: Minutes,
        pictures: &[("docs/uncertain-pixel.png", "pixel/probability.png")],
        script: "topple seismic --object 1 --t-h 0.5:4:60 --t-v 0.05:0.3:60 --pixel --samples 32 --verify none --out pixel",
    },
    Drawn {
        needs: Minutes,
        pictures: &[("docs/refined.png", "zoom/map.png")],
        script: "topple pulse --object 1 --eccentricity -0.4 --t-h 1.75 --t-v 0.75 --a-v 0.5 --omega 1.3:2.4:257 --a-h 0.78:1.02:257 \
                 --refine 4 --out zoom",
    },
    Drawn {
        needs: Records,
        pictures: &[("docs/suite.png", "suite/suite.png")],
        script: "topple suite $RECORDS/suite --out suite",
    },
    Drawn {
        needs: Records,
        pictures: &[("docs/fragility.png", "fragility/fragility.png")],
        script: "topple fragility --object 1 --eccentricity 0.2 --both-directions --u-y 0.01 --t-h 1.8 --t-v 0.5 --suite $RECORDS/suite \
                 --levels 1:50:20:log --limit-u 0.4 --out fragility",
    },
    Drawn {
        needs: Records,
        pictures: &[
            ("docs/cases-statue.png", "statue/envelope.png"),
            ("docs/cases-rack.png", "rack/envelope.png"),
            ("docs/cases-cabinet.png", "cabinet/envelope.png"),
        ],
        script: "grid='--u-y 0.01 --t-h 0.5:3:26 --t-v 0.1:1:10 --limit-v 0.05'\n\
                 topple envelope --object 1 --eccentricity 0.2 $grid --suite $RECORDS/suite --both-directions --limit-u 0.4 --out statue\n\
                 topple envelope --object 2 $grid --suite $RECORDS/suite --limit-u 0.25 --out rack\n\
                 topple envelope --object 3 $grid --suite $RECORDS/suite --limit-u 0.25 --out cabinet",
    },
    Drawn {
        needs: PythonAndRecords,
        pictures: &[("docs/cases-isolation.png", "isolation.png")],
        script: "for block in 1 2 3; do for e in 0 0.2; do for base in horizontal dual; do\n\
                 of=\"--object $block --eccentricity $e --isolation $base --u-y 0.01 --suite $RECORDS/suite\"\n\
                 t_v=; [ $base = dual ] && t_v='--t-v 0.1,0.3,0.5,1'\n\
                 topple envelope $of --t-h 0.5:5:40 $t_v --out compare/envelope-$block-$e-$base\n\
                 [ $base = dual ] && t_v='--t-v 0.5'\n\
                 topple fragility $of --t-h 1,1.5,2,2.5,3,4 $t_v --levels 2:40:16:log --estimator stripes --out compare/fragility-$block-$e-$base\n\
                 done; done; done\n\
                 python3 $ROOT/docs/cases.py compare isolation.png",
    },
    Drawn {
        needs: Records,
        pictures: &[
            ("docs/paper/boundary.png", "figures/boundary.png"),
            ("docs/paper/fig04.png", "figures/fig04.png"),
            ("docs/paper/fig07.png", "figures/fig07.png"),
            ("docs/paper/fig11.png", "figures/fig11.png"),
            ("docs/paper/fig12.png", "figures/fig12.png"),
            ("docs/paper/fig12-b-path-1.png", "figures/fig12-b-path-1.png"),
            ("docs/paper/fig13.png", "figures/fig13.png"),
            ("docs/paper/fig14.png", "figures/fig14.png"),
            ("docs/paper/fig14-e-path-2.png", "figures/fig14-e-path-2.png"),
            ("docs/paper/motion.gif", "figures/motion-a.gif"),
            ("docs/paper/parity.png", "figures/parity.png"),
            ("docs/paper/shares.png", "figures/shares.png"),
            ("docs/paper/strip.png", "figures/strip.png"),
        ],
        script: "topple figures --records $RECORDS --out figures",
    },
    Drawn {
        needs: Browser,
        pictures: &[
            ("docs/explore.png", "explore.png"),
            ("docs/explore-dark.png", "explore-dark.png"),
            ("docs/explore.gif", "explore.gif"),
            ("crates/explore/src/page/icon.png", "icon.png"),
        ],
        script: "python3 $ROOT/benches/explore/pictures.py .",
    },
    Drawn {
        needs: Python,
        pictures: &[
            ("python/examples/fig11.png", "fig11.png"),
            ("python/examples/fragility.png", "fragility.png"),
        ],
        script: "python3 $ROOT/python/examples/fig11.py\npython3 $ROOT/python/examples/fragility.py",
    },
    Drawn {
        needs: Python,
        pictures: &[("python/examples/isolator.png", "isolator.png")],
        script: "python3 $ROOT/python/examples/isolator.py",
    },
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// The pictures in a folder of the repository, by their places in it.
fn pictures(folder: &Path, found: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let ending = entry.extension().unwrap_or_default().to_string_lossy().into_owned();
        if entry.is_dir() {
            pictures(&entry, found);
        } else if ["png", "gif", "svg", "jpg"].contains(&&*ending) {
            let place = entry.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/");
            found.insert(place);
        }
    }
}

#[test]
fn what_draws_each_picture_is_known() {
    let mut found = BTreeSet::new();
    pictures(&root().join("docs"), &mut found);
    pictures(&root().join("python/examples"), &mut found);
    pictures(&root().join("crates/explore/src/page"), &mut found);
    // What the icon's PNG is made of.
    assert!(found.remove("crates/explore/src/page/icon.svg"));
    let known = ALL.iter().flat_map(|drawn| drawn.pictures).map(|(place, _)| place.to_string());
    assert_eq!(known.collect::<BTreeSet<_>>(), found);
    // The command of a page that is drawn as it stands is the one that draws its picture.
    for (page, picture) in
        [("axes", "axes-size"), ("pulses", "pulses-modulated"), ("fragility", "fragility")]
    {
        let text = fs::read_to_string(root().join(format!("docs/{page}.md"))).unwrap();
        let plain = |text: &str| {
            text.replace(['\\', '\n', '\r'], " ").split_whitespace().collect::<Vec<_>>().join(" ")
        };
        let of = |drawn: &&Drawn| drawn.pictures[0].0 == format!("docs/{picture}.png");
        let script = ALL.iter().find(of).unwrap().script.replace("$RECORDS/suite", "records");
        assert!(plain(&text).contains(&plain(&script)), "{page}: {script}");
    }
}

/// The lines that draw pictures; those of a page as it has them.
fn script(drawn: &Drawn) -> String {
    match drawn.script.strip_prefix("PAGE ") {
        Some(page) => crate::first_hour::commands(&crate::first_hour::page(page)).join("\n"),
        None => drawn.script.into(),
    }
}

/// Draws pictures into a folder; false where the shell does not end well.
fn draw(drawn: &Drawn, folder: &Path, records: Option<&Path>) -> bool {
    let program = crate::common::command::program();
    let others = env::var_os("PATH").unwrap_or_default();
    let folders = std::iter::once(program.parent().unwrap().to_path_buf());
    let path = env::join_paths(folders.chain(env::split_paths(&others))).unwrap();
    let mut shell = Command::new("sh");
    shell.args(["-e", "-c", &script(drawn)]).current_dir(folder).env("PATH", path);
    shell.env("ROOT", root()).env("TOPPLE_COMMAND", program);
    shell.env("RECORDS", records.unwrap_or(Path::new("")));
    let run = shell.output().unwrap();
    if !run.status.success() {
        println!("{}", String::from_utf8_lossy(&run.stderr));
    }
    run.status.success()
}

fn has_shell() -> bool {
    Command::new("sh").args(["-c", "exit 0"]).status().is_ok_and(|status| status.success())
}

/// The pixels of a PNG, and its size.
fn pixels(file: &Path) -> ((u32, u32), Vec<u8>) {
    let mut decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(file).unwrap()));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    ((info.width, info.height), pixels)
}

/// The share of two pictures in which they differ.
fn differing(one: &Path, other: &Path) -> f64 {
    let ((size, one), (other_size, other)) = (pixels(one), pixels(other));
    if size != other_size || one.len() != other.len() {
        return 1.0;
    }
    let differ = one.iter().zip(&other).filter(|(a, b)| a.abs_diff(**b) > 24).count();
    differ as f64 / one.len() as f64
}

/// Cells that differ between machines, and edges of letters.
const DIFFERING: f64 = 0.004;

#[test]
fn no_picture_is_older_than_the_program() {
    if !has_shell() {
        eprintln!("skipped: no shell that runs what draws the pictures");
        return;
    }
    let asked = env::var("TOPPLE_WRITE_PICTURES").ok();
    let writes = asked.is_some();
    let is_asked = |drawn: &Drawn| match asked.as_deref() {
        None | Some("1") => true,
        Some(word) => drawn.pictures.iter().any(|(place, _)| place.contains(word)),
    };
    let records = env::var_os("TOPPLE_RECORDS").map(PathBuf::from);
    let mut compared = 0;
    for drawn in &ALL {
        let needs_records = matches!(drawn.needs, Records | PythonAndRecords);
        let wanted = writes && (records.is_some() || !needs_records) || drawn.needs == Seconds;
        if !wanted || !is_asked(drawn) {
            continue;
        }
        let folder = TempDir::new().unwrap();
        let well = draw(drawn, folder.path(), records.as_deref());
        if !well {
            assert!(drawn.needs != Seconds, "{}", drawn.script);
            eprintln!("not drawn, for what it needs is not here: {}", drawn.pictures[0].0);
            continue;
        }
        for (place, file) in drawn.pictures {
            let (kept, new) = (root().join(place), folder.path().join(file));
            // A picture that is as it was stays as it is.
            let is_old =
                !place.ends_with("png") || !kept.exists() || differing(&kept, &new) >= DIFFERING;
            if writes && is_old {
                fs::copy(&new, &kept).unwrap();
            }
            assert!(writes || !is_old, "{place} is older than the program");
            compared += 1;
        }
    }
    assert!(writes || compared >= 11, "{compared}");
}
