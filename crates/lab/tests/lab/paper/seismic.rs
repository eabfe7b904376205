//! Section 4: under records. The horizontals are real, their verticals synthetic (Rinaldi has both):
//! docs/paper.md says what that leaves open.

use std::path::PathBuf;
use std::sync::LazyLock;

use topple::scene::{Directions, Parameter, Range};
use topple::stepping::outcome::{Class, Outcome};
use topple_lab::figures::shares::Shares;

use crate::common::{record, say, xy};

use super::{Ran, figure, swept};

/// Points of an axis.
const SIDE: u32 = 48;

/// The directory of records, where there is one.
fn records(test: &str) -> Option<PathBuf> {
    let file = record(test, "kobe-1995-takarazuka-000.slammer.txt")?;
    file.parent().map(PathBuf::from)
}

/// Figs. 4, 7, 8 and 9: the panels of Objects 1, 2 and 3; none without records.
static PANELS: LazyLock<Option<[Vec<Ran>; 3]>> = LazyLock::new(|| {
    let records = records("seismic statements")?;
    let ran = |names: &[&str]| {
        let panels =
            names.iter().flat_map(|name| figure(name, Some(SIDE), Some(&records)).0.panels);
        panels.map(Ran::new).collect()
    };
    Some([ran(&["fig04", "fig07"]), ran(&["fig08"]), ran(&["fig09"])])
});

/// The panels, for a test; without records it is skipped, and says so.
fn panels(test: &str) -> Option<&'static [Vec<Ran>; 3]> {
    records(test)?;
    PANELS.as_ref()
}

/// The panel of an object, a motion and an eccentricity.
fn at<'a>(panels: &'a [Vec<Ran>; 3], object: usize, motion: &str, e: f64) -> &'a Ran {
    let found = panels[object - 1].iter().find(|ran| {
        // Behind the name stands what of it is synthetic.
        let named = ran.panel.motion.as_deref().and_then(|name| name.strip_prefix(motion));
        named.is_some_and(|rest| rest.is_empty() || rest.starts_with(" ("))
            && ran.panel.scene.case().block.eccentricity == e
    });
    found.unwrap_or_else(|| panic!("no panel of {object}, {motion}, {e}"))
}

/// Rows of a map, upwards, with their T_v.
fn rows(ran: &Ran) -> impl Iterator<Item = (f64, &[Outcome])> {
    let (columns, _) = ran.grid.shape();
    let cells = ran.outcomes.chunks(columns).enumerate();
    cells.map(move |(j, row)| (xy(&ran.grid, j * columns).1, row))
}

/// The largest T_h of a row that overturns.
fn critical(ran: &Ran, row: &[Outcome]) -> f64 {
    let last = row.iter().rposition(|cell| cell.class.overturned());
    last.map_or(0.0, |i| xy(&ran.grid, i).0)
}

/// The median over T_v >= 0.5 s of the T_h above which the block stands.
fn critical_period(ran: &Ran) -> f64 {
    let mut periods: Vec<f64> =
        rows(ran).filter(|(t_v, _)| *t_v >= 0.5).map(|(_, row)| critical(ran, row)).collect();
    periods.sort_by(f64::total_cmp);
    periods[periods.len() / 2]
}

fn overturned(ran: &Ran) -> f64 {
    1.0 - ran.shares.stable()
}

#[test]
fn kobe_has_a_critical_period_that_grows_with_the_eccentricity() {
    let Some(panels) = panels("kobe_has_a_critical_period_that_grows_with_the_eccentricity") else {
        return;
    };
    let period = |e| critical_period(at(panels, 1, "Kobe", e));
    let [none, plus20, minus20, plus40, minus40] = [0.0, 0.2, -0.2, 0.4, -0.4].map(period);
    say(&format!(
        "Kobe, critical T_h: 0 {none:.2}, +-0.2 {plus20:.2} {minus20:.2}, +-0.4 {plus40:.2} {minus40:.2} s"
    ));
    // Slightly below 1.5 s, nearly 1.5 s, and significantly more; not alike for either sign.
    assert!(none > 1.25 && none < 1.5);
    assert!([plus20, minus20].iter().all(|t| *t >= none && *t < 1.55));
    assert!([plus40, minus40].iter().all(|t| *t > 1.2 * none));
    assert!((plus40 - minus40).abs() > 0.1 * none);
    // The boundary is nearly vertical, the more so where T_v is large.
    let map = at(panels, 1, "Kobe", 0.0);
    let beyond: Vec<f64> =
        rows(map).filter(|(t_v, _)| *t_v >= 1.5).map(|(_, row)| critical(map, row)).collect();
    assert!(beyond.iter().all(|t| (t / none - 1.0).abs() < 0.1), "{beyond:?}");
}

#[test]
fn kobe_rocks_in_the_smallest_region() {
    let Some(panels) = panels("kobe_rocks_in_the_smallest_region") else { return };
    let shares = at(panels, 1, "Kobe", 0.0).shares;
    say(&format!(
        "Kobe: overturned {:.3}, rocking {:.3}, full contact {:.3}",
        1.0 - shares.stable(),
        shares.rocking,
        shares.full_contact
    ));
    assert!(shares.rocking < 1.0 - shares.stable() && shares.rocking < 0.4 * shares.full_contact);
}

/// At some T_v no T_h keeps the block in full contact; with this vertical at 0.2 to 0.25 s, where the
/// paper has 0.5 s.
#[test]
fn kobe_lifts_at_some_t_v_whatever_t_h() {
    let Some(panels) = panels("kobe_lifts_at_some_t_v_whatever_t_h") else { return };
    for e in [0.0, 0.2, 0.4, -0.2, -0.4] {
        let map = at(panels, 1, "Kobe", e);
        let never =
            rows(map).filter(|(_, row)| row.iter().all(|cell| cell.class != Class::FullContact));
        let never: Vec<f64> = never.map(|(t_v, _)| t_v).collect();
        say(&format!("Kobe, {e}: no full contact at T_v = {never:.2?}"));
        assert!(never.iter().any(|t_v| *t_v > 0.2 && *t_v < 0.26));
        assert!(never.len() < SIDE as usize / 2);
    }
}

/// The paper: for very small T_v the block always overturns. It does not.
#[test]
fn kobe_has_no_strip_of_overturning() {
    let Some(records) = records("kobe_has_no_strip_of_overturning") else { return };
    for panel in figure("fig05", Some(24), Some(&records)).0.panels {
        let ran = Ran::new(panel);
        let (t_v, row) = rows(&ran).next().unwrap();
        assert!(t_v <= 0.01 && row.iter().any(|cell| cell.class == Class::FullContact));
        assert!(critical(&ran, row) < 3.0);
    }
}

#[test]
fn point_a_stays_in_full_contact_within_a_centimetre_or_two() {
    let Some(records) = records("point_a_stays_in_full_contact_within_a_centimetre_or_two") else {
        return;
    };
    let (figure, _) = figure("fig05", Some(2), Some(&records));
    let panel = figure.panels.iter().find(|panel| !panel.points.is_empty()).unwrap();
    let mut scene = panel.scene.clone();
    scene.set(Parameter::TH, panel.points[0].x);
    scene.set(Parameter::TV, panel.points[0].y);
    let cell = swept(&scene)[0];
    say(&format!(
        "point A: {}, max|v| = {:.4} m, max|u| = {:.3} m",
        cell.class.name(),
        cell.max_v,
        cell.max_u
    ));
    assert_eq!(cell.class, Class::FullContact);
    assert!(cell.max_v > 0.005 && cell.max_v < 0.02);
}

#[test]
fn displacements_of_the_base() {
    let Some(panels) = panels("displacements_of_the_base") else { return };
    let none = at(panels, 1, "Kobe", 0.0);
    for e in [0.4, -0.4] {
        let other = at(panels, 1, "Kobe", e);
        let both = none.outcomes.iter().zip(&other.outcomes);
        let standing = both.filter(|(a, b)| !a.class.overturned() && !b.class.overturned());
        let apart = |f: fn(&Outcome) -> f64| {
            let mut all: Vec<f64> =
                standing.clone().map(|(a, b)| (f(b) / f(a) - 1.0).abs()).collect();
            all.sort_by(f64::total_cmp);
            (all[all.len() / 2], all[all.len() * 95 / 100])
        };
        let (u, v) = (apart(|cell| cell.max_u), apart(|cell| cell.max_v));
        say(&format!(
            "displacements at {e} against 0: median and 95th percentile, u {u:.4?}, v {v:.4?}"
        ));
        assert!(u.1 < 0.1 && v.1 < 0.1);
    }
    let standing = || none.outcomes.iter().enumerate().filter(|(_, cell)| !cell.class.overturned());
    let most = standing().map(|(_, cell)| cell.max_u).fold(0.0, f64::max);
    say(&format!("max|u| = {most:.3} m"));
    assert!(most > 0.3 && most < 0.4);
    // v is mostly the static deflection, (T_v / 2 pi)^2 g: more than a metre at 2 s.
    for (k, cell) in standing() {
        let (_, t_v) = xy(&none.grid, k);
        let deflection = 9.81 * (t_v / std::f64::consts::TAU).powi(2);
        if t_v > 1.0 {
            assert!(
                cell.max_v > deflection && cell.max_v < 1.5 * deflection,
                "{t_v} {}",
                cell.max_v
            );
        }
        if t_v == 2.0 {
            assert!(cell.max_v > 1.0);
        }
    }
}

/// Contours of u are vertical where the block stands still at long T_h, and bend at the T_v at which
/// it rocks whatever T_h.
#[test]
fn contours_of_u_bend_where_the_block_rocks() {
    let Some(panels) = panels("contours_of_u_bend_where_the_block_rocks") else { return };
    let map = at(panels, 1, "Kobe", 0.4);
    let column = |t_h: f64| {
        let place = |k: &usize| (xy(&map.grid, *k).0 - t_h).abs();
        let (columns, _) = map.grid.shape();
        (0..columns).min_by(|a, b| place(a).total_cmp(&place(b))).unwrap()
    };
    let i = column(3.0);
    let spread = |low: f64, high: f64| {
        let within = rows(map)
            .filter(|(t_v, row)| *t_v >= low && *t_v <= high && !row[i].class.overturned());
        let u: Vec<f64> = within.map(|(_, row)| row[i].max_u).collect();
        let most = u.iter().copied().fold(0.0, f64::max);
        1.0 - u.iter().copied().fold(f64::INFINITY, f64::min) / most
    };
    let (beyond, near) = (spread(0.7, 2.0), spread(0.1, 0.7));
    say(&format!("max|u| at T_h = 3 s: spread {near:.4} below T_v = 0.7 s, {beyond:.5} beyond"));
    assert!(near > 5.0 * beyond && beyond < 0.02);
}

#[test]
fn pacoima_is_worst_and_parkfield_best() {
    let Some(panels) = panels("pacoima_is_worst_and_parkfield_best") else { return };
    for object in [1, 2, 3] {
        for e in [0.0, 0.4, -0.4] {
            let share = |motion| overturned(at(panels, object, motion, e));
            let [pacoima, kobe, parkfield] = ["Pacoima", "Kobe", "Parkfield"].map(share);
            say(&format!(
                "Object {object}, {e}: overturned Pacoima {pacoima:.3}, Kobe {kobe:.3}, Parkfield {parkfield:.3}"
            ));
            assert!(pacoima > kobe);
            // At -0.4 Kobe and Parkfield are within a few hundredths of each other for Object 1.
            assert!(parkfield < kobe + 0.03);
        }
    }
    let map = at(panels, 1, "Pacoima", -0.4);
    assert!(overturned(map) > 0.8, "almost the entire plane");
}

#[test]
fn critical_periods_grow_with_the_eccentricity_and_differ_by_its_sign() {
    let Some(panels) = panels("critical_periods_grow_with_the_eccentricity_and_differ_by_its_sign")
    else {
        return;
    };
    for (object, motions) in [
        (1, &["Pacoima", "Parkfield"][..]),
        (2, &["Kobe", "Pacoima", "Parkfield"]),
        (3, &["Kobe", "Pacoima", "Parkfield"]),
    ] {
        for motion in motions {
            let [none, plus, minus] =
                [0.0, 0.4, -0.4].map(|e| critical_period(at(panels, object, motion, e)));
            say(&format!(
                "Object {object}, {motion}: critical T_h 0 {none:.2}, 0.4 {plus:.2}, -0.4 {minus:.2} s"
            ));
            assert!(plus > none && minus > none);
            let [a, b] = [0.4, -0.4].map(|e| &at(panels, object, motion, e).outcomes);
            let differ = a.iter().zip(b).filter(|(a, b)| a.class != b.class).count();
            assert!(differ as f64 > 0.2 * a.len() as f64, "{differ} cells");
        }
    }
}

/// Object 1, the most slender, fares worst, Object 2, the least, best.
#[test]
fn slender_blocks_fare_worse() {
    let Some(panels) = panels("slender_blocks_fare_worse") else { return };
    for motion in ["Kobe", "Pacoima", "Parkfield", "Rinaldi"] {
        for e in [0.0, 0.4, -0.4] {
            let [one, two, three] =
                [1, 2, 3].map(|object| overturned(at(panels, object, motion, e)));
            assert!(one > three && three > two, "{motion}, {e}: {one} {three} {two}");
        }
    }
    let map = at(panels, 2, "Parkfield", 0.0);
    let near = map.share(|cell| cell.class == Class::Rocking && cell.zeta > 0.5);
    say(&format!(
        "Object 2, Parkfield: overturned {:.4}, zeta above 0.5 in {near:.4}",
        overturned(map)
    ));
    assert!(overturned(map) < 0.02 && near > overturned(map));
}

/// Vertical isolation beside the horizontal one, under the pair that is real in both components: it
/// keeps the block in full contact at more periods T_h, as the paper says, and does not reduce those
/// at which the block overturns, as the paper says too.
#[test]
fn dual_isolation_against_horizontal_alone() {
    let Some(panels) = panels("dual_isolation_against_horizontal_alone") else { return };
    for e in [0.0, 0.4, -0.4] {
        let shares = |vertical: Option<f64>| {
            let mut scene = at(panels, 1, "Rinaldi", e).panel.scene.clone();
            let t_h = scene.numbers.get(Parameter::TH).unwrap().clone();
            scene.set(Parameter::TH, Range::even(t_h.first(), t_h.last(), 120));
            match vertical {
                Some(t_v) => scene.set(Parameter::TV, t_v),
                None => scene = scene.isolated(Directions::Horizontal),
            }
            Shares::of(&swept(&scene))
        };
        let alone = shares(None);
        for t_v in [1.0, 2.0] {
            let dual = shares(Some(t_v));
            say(&format!(
                "Rinaldi, {e}, T_v = {t_v} s: overturned {:.3}, horizontal isolation alone {:.3}; \
                 full contact {:.3}, alone {:.3}",
                1.0 - dual.stable(),
                1.0 - alone.stable(),
                dual.full_contact,
                alone.full_contact
            ));
            assert!(dual.full_contact > alone.full_contact + 0.05);
            assert!(dual.stable() < alone.stable() + 0.01);
        }
    }
}
