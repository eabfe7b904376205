//! What a user should know of levels is said by every command.

use crate::common::room::Room;

/// What a command warns of: on stderr, and in its run.json, which are the same.
fn warned(room: &Room, line: &str) -> Vec<String> {
    let run = room.run(&format!("{line} --verify none --backend cpu --out ./out"));
    let kept = room.json("out")["warnings"].clone();
    let kept: Vec<String> = serde_json::from_value(kept).unwrap_or_default();
    let said = run.err.lines().filter_map(|line| line.strip_prefix("topple: warning: "));
    assert!(said.eq(&kept) && !run.out.contains("warning"), "{line}: {run:?}");
    room.remove("out");
    kept
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
