//! What a user should know of a device and of levels is said by every command, on stderr and in run.json alike.

use crate::common::room::Room;

/// What a command warns of: on stderr, and in its run.json, which are the same.
pub fn warned(room: &Room, line: &str) -> Vec<String> {
    // A history verifies nothing.
    let verify = if line.starts_with("history") { "" } else { "--verify none --backend cpu" };
    let run = room.run(&format!("{line} {verify} --out ./out"));
    assert!(!run.out.contains("warning"), "{}", run.out);
    let kept: Vec<String> =
        serde_json::from_value(room.json("out")["warnings"].clone()).unwrap_or_default();
    let said: Vec<&str> =
        run.err.lines().filter_map(|line| line.strip_prefix("topple: warning: ")).collect();
    assert_eq!(said, kept, "{line}");
    room.remove("out");
    kept
}

/// The commands that take a device, without it.
const COMMANDS: [&str; 6] = [
    "pulse --omega 2,4 --a-h 1,2",
    "pulse --omega 2,4 --a-h 1,2 --pixel --samples 2",
    "history --omega 4 --a-h 2",
    "seismic --horizontal ./a.txt --dt 0.02 --units m/s2",
    "envelope --suite ./list.csv",
    "fragility --levels 2,4 --suite ./list.csv",
];

const BLOCK: &str = "--object 1 --isolation horizontal";

#[test]
fn a_damper_that_nobody_gave_is_warned_of_by_every_command() {
    let room = Room::suite();
    let damper = "--u-y: 5 % of damping on the initial stiffness acts beside the device";
    for command in COMMANDS {
        let about = |more: &str| {
            let said = warned(&room, &format!("{command} {BLOCK} --t-h 1.5 --u-y 0.01 {more}"));
            said.iter().filter(|one| one.contains(damper)).count()
        };
        assert_eq!(about(""), 1, "{command}");
        assert_eq!(about("--xi-h 0.05000001"), 0, "{command}");
    }
    // Of devices of a list in one sentence, with their names.
    let devices =
        "device,t_h,u_y,xi_h\none,1,0.01,\ntwo,2,0.01,\nthree,3,0.01,0\nfour,3,0.01,0.05\n";
    room.write("devices.csv", devices);
    let said = warned(&room, &format!("compare ./devices.csv {BLOCK} --suite ./list.csv"));
    let named = |one: &&String| one.starts_with("one, two: --u-y: 5 % of damping");
    assert_eq!(said.iter().filter(named).count(), 1, "{said:?}");
}

/// Numbers in other units than N and N/m, under the statue of 895 kg with its two plates of 43.3 kg, 2π√(981.6/60) = 25.4.
#[test]
fn a_device_that_no_isolation_is_is_warned_of_by_every_command() {
    let room = Room::suite();
    // Below the 30 s from which on a period is refused.
    let wrong = [
        (
            "--k1 60 --k2 12 --qd 30",
            "T = 25.4 s before the device yields; no isolation has more than 10 s",
        ),
        ("--k1 60000000 --k2 12000000 --qd 30000", "s after it yields or slides; below 0.06 s"),
        ("--k1 4000 --k2 800 --qd 0.25", "of the weight before it yields"),
        ("--radius 30 --mu 0.06", "while the pendulum slides; no isolation has more than 10 s"),
    ];
    let right = "--k1 4000 --k2 800 --qd 250";
    let said = |said: &[String]| said.iter().filter(|one| one.contains(": give ")).count();
    for command in COMMANDS {
        let run = |more: &str| warned(&room, &format!("{command} {BLOCK} {more}"));
        let wrong = if command == COMMANDS[0] { &wrong[..] } else { &wrong[..1] };
        for (device, wanted) in wrong {
            let told = run(device);
            assert!(told.iter().any(|one| one.contains(wanted)), "{command} {wanted}: {told:?}");
            assert_eq!(said(&told), 1, "{command}: {told:?}");
        }
        assert_eq!(said(&run(right)), 0, "{command}");
    }
    // Flat sliders, rubber without lead and stiff sliders are devices.
    for device in [
        "--k1 100000 --k2 0 --qd 600",
        "--k1 4000 --k2 3900 --qd 0.5",
        "--radius 1.5 --mu 0.12 --u-y 0.0001",
    ] {
        let told = warned(&room, &format!("{} {BLOCK} {device}", COMMANDS[0]));
        assert_eq!(said(&told), 0, "{device}");
    }
    room.write("devices.csv", "device,k1,k2,qd\nwrong,60,12,30\nright,4000,800,250\n");
    let told = warned(&room, &format!("compare ./devices.csv {BLOCK} --suite ./list.csv"));
    assert!(told.iter().any(|one| one.starts_with("wrong: --k1, --k2: T = 25.4 s")), "{told:?}");
    assert_eq!(said(&told), 1, "{told:?}");
}

/// Where the ground accelerates downwards by more than g no block stays on its base: of levels, of factors, of motions as they are.
#[test]
fn levels_at_which_the_ground_falls_away_are_named() {
    let room = Room::suite();
    // The vertical components, by their largest downward acceleration over the horizontal peak.
    let samples = |name: &str| -> Vec<f64> {
        let text = room.read(name);
        text.lines().map(|line| line.parse().unwrap()).collect()
    };
    let ratio = |name: &str| {
        let peak = samples(&format!("{name}.txt")).iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        let down = samples(&format!("{name}_v.txt")).iter().fold(0.0_f64, |m, a| m.max(-a));
        down / peak
    };
    let ratios = ["a", "b", "c", "d"].map(ratio);
    let base = "--object 1 --t-h 1.5 --t-v 0.5 --u-y 0.01 --xi-h 0.1";
    let about = |said: &[String]| -> Vec<String> {
        said.iter().filter(|one| one.contains("downwards by more than g")).cloned().collect()
    };
    let mut sorted = ratios;
    sorted.sort_by(|a, b| b.total_cmp(a));
    // Just above the level at which the first, the second and the third motion falls.
    let [one, two, three] = [0, 1, 2].map(|k| (1.001 * 9.81 / sorted[k] * 100.0).ceil() / 100.0);
    let levels = [2.0, 4.0, one, two, three, 64.0];
    let written = levels.map(|level| level.to_string()).join(",");
    let falls = |level: f64| ratios.iter().filter(|ratio| level * **ratio > 9.81).count();
    let first = *levels.iter().find(|level| falls(**level) > 0).unwrap();
    let count = levels.iter().filter(|level| falls(**level) > 0).count();
    assert!(count > 1 && count < levels.len(), "{count}");
    let wanted =
        format!("at {count} of 6 levels, from PGA = {first} m/s² on, the ground accelerates");
    let fragility = format!("fragility --suite ./list.csv {base} --levels");
    let said = about(&warned(&room, &format!("{fragility} {written}")));
    assert!(said.len() == 1 && said[0].starts_with(&wanted), "{wanted}: {said:?}");
    let half = *levels.iter().find(|level| falls(**level) >= 2).unwrap();
    assert!(half > first, "{half} {first}");
    let by_half = format!(", from PGA = {half} m/s² on under half of them or more: the block");
    assert!(said[0].contains(&by_half), "{by_half}: {said:?}");
    assert!(about(&warned(&room, &format!("{fragility} 2,4"))).is_empty());
    // An envelope, and a comparison with levels and factors.
    let envelope = format!("envelope --suite ./list.csv {base}");
    assert!(about(&warned(&room, &envelope)).is_empty());
    let said = about(&warned(&room, &format!("{envelope} --pga 64")));
    let wanted = format!("under {} of 4 motions the ground accelerates", falls(64.0));
    assert!(said.len() == 1 && said[0].starts_with(&wanted), "{wanted}: {said:?}");
    room.write("devices.csv", "device,isolation\nfloor,none\nother,none\n");
    room.write("site.csv", "PGA [m/s2],rate\n0.5,0.05\n70,1e-5\n");
    let site = format!("--hazard ./site.csv --levels {written} --scales 0.5,100");
    let said = about(&warned(
        &room,
        &format!("compare ./devices.csv --object 1 --suite ./list.csv {site}"),
    ));
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(
        said[0].starts_with(&format!("at {count} of 6 levels, from PGA = {first} m/s² on")),
        "{said:?}"
    );
    assert!(said[1].starts_with("at 1 of 2 factors of --scales, from 100 on"), "{said:?}");
}

/// Units of levels are asked about where levels were given.
#[test]
fn units_of_levels_that_nobody_gave_are_not_asked_about() {
    let room = Room::suite();
    let base = "--object 1 --t-h 3 --t-v 0.5 --u-y 0.01 --xi-h 0.1";
    let of = |more: &str| warned(&room, &format!("fragility --suite ./list.csv {base} {more}"));
    let units =
        |said: &[String]| said.iter().filter(|one| one.contains("if they were meant in g")).count();
    assert_eq!(units(&of("--levels 0.1,0.2")), 1);
    assert_eq!(units(&of("--scale 0.05")), 0);
    // The unit of a hazard curve is asked about in any case.
    room.write("site.csv", "PGA [m/s2],rate\n20,0.05\n40,1e-5\n");
    let said = of("--scale 0.05 --hazard ./site.csv");
    assert_eq!(units(&said), 0);
    assert!(said.iter().any(|one| one.starts_with("all motions as they are, PGA ")), "{said:?}");
    let said = of("--levels 0.1,0.2 --hazard ./site.csv");
    assert!(said.iter().any(|one| one.starts_with("all levels, 0.1 to 0.2 m/s²")), "{said:?}");
}
