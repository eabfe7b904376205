//! Numbers that are none, at each stage of the way.

use topple::backend::cpu;
use topple::backend::gpu::run::Sweeper;
use topple::backend::gpu::shader::{self, Switches};
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::model::real::Real;
use topple::scene::builder::SceneBuilder;
use topple::scene::{Grid, Parameter, Scene};
use topple::stepping::outcome::{Class, Outcome, Status};
use topple::work::observer::Unwatched;

use crate::common::{gpu, object, say, shaken};

use super::{altered, swept};

const BAD: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

fn rocks() -> Scene {
    object(1, 0.2, (1.75, 0.75), 0.5, "5", "3.4")
}

fn unresolved(what: &str, cell: &Outcome) {
    assert_eq!(
        (cell.class, cell.status),
        (Class::Unresolved, Status::Diverged),
        "{what}: {cell:?}"
    );
}

/// A scene with such a number is refused before anything runs.
#[test]
fn a_scene_with_a_number_that_is_not_finite_is_refused() {
    let text = |key: &str, value: &str| {
        let sections =
            [("block", "half_width"), ("base", "t_h"), ("pulse", "a_h"), ("run", "t_max")];
        let mut toml = String::new();
        for (section, own) in sections {
            toml.push_str(&format!("[{section}]\n"));
            for (name, plain) in [
                ("half_width", "0.2"),
                ("height", "1.0"),
                ("mass", "100.0"),
                ("inertia", "40.0"),
                ("eccentricity", "0.1"),
                ("t_h", "1.5"),
                ("t_v", "0.5"),
                ("psi", "0.3"),
                ("xi_h", "0.1"),
                ("xi_v", "0.1"),
                ("alpha_y", "0.1"),
                ("omega", "5.0"),
                ("a_h", "3.0"),
                ("a_v", "1.0"),
                ("t_max", "3.0"),
                ("tilt", "0.01"),
            ] {
                let at = match name {
                    "half_width" | "height" | "mass" | "inertia" | "eccentricity" => "half_width",
                    "omega" | "a_h" | "a_v" => "a_h",
                    "t_max" | "tilt" => "t_max",
                    _ => "t_h",
                };
                if at == own {
                    toml.push_str(&format!(
                        "{name} = {}\n",
                        if name == key { value } else { plain }
                    ));
                }
            }
        }
        toml
    };
    assert!(SceneBuilder::from_toml(&text("", "")).unwrap().check().is_ok());
    for key in [
        "half_width",
        "height",
        "mass",
        "inertia",
        "eccentricity",
        "t_h",
        "t_v",
        "psi",
        "xi_h",
        "xi_v",
        "alpha_y",
        "omega",
        "a_h",
        "a_v",
        "t_max",
        "tilt",
    ] {
        for value in ["nan", "inf", "-inf"] {
            let refused = SceneBuilder::from_toml(&text(key, value)).is_err_and(|_| true)
                || SceneBuilder::from_toml(&text(key, value)).unwrap().check().is_err();
            assert!(refused, "{key} = {value}");
        }
    }
}

fn in_cells_of<R: Real>() {
    let plan = Plan::new(&rocks(), DEFAULT_STEP).unwrap();
    for bad in BAD {
        for place in 0..12 {
            let cell = altered::<R>(&plan, &mut (), |cell, state| {
                let numbers = [
                    &mut cell.horizontal.post_yield,
                    &mut cell.horizontal.hysteretic,
                    &mut cell.horizontal.damping_h,
                    &mut cell.horizontal.inverse_yield,
                    &mut cell.vertical.stiffness_v,
                    &mut cell.vertical.damping_v,
                    &mut cell.drive.amplitude_h,
                    &mut cell.drive.amplitude_v,
                    &mut cell.steps.phase_step,
                    &mut cell.steps.step_forced,
                    &mut cell.steps.step_free,
                    &mut cell.steps.rest_speed,
                ];
                for (index, number) in numbers.into_iter().enumerate() {
                    if index == place {
                        *number = R::of(bad);
                    }
                }
                topple::stepping::state::check_cell(cell, state);
            });
            unresolved(&format!("number {place} of a cell is {bad}"), &cell);
        }
    }
}

/// The numbers that a cell's equations are made of, one after the other.
#[test]
fn a_cell_with_a_number_that_is_not_finite_is_unresolved() {
    in_cells_of::<f32>();
    in_cells_of::<f64>();
}

/// The motion is on its way, in full contact or rocking.
#[test]
fn a_motion_with_a_number_that_is_not_finite_is_unresolved() {
    for tilt in [0.0, 0.05] {
        let mut scene = rocks();
        scene.set(Parameter::Tilt, tilt);
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
        for bad in BAD {
            for place in 0..7 {
                // phi and its rate are no part of a block in full contact.
                if tilt == 0.0 && place >= 5 {
                    continue;
                }
                let cell = altered::<f64>(&plan, &mut (), |_, state| {
                    let y = &mut state.motion;
                    let numbers = [
                        &mut y.u,
                        &mut y.du,
                        &mut y.v,
                        &mut y.dv,
                        &mut y.z,
                        &mut y.phi,
                        &mut y.dphi,
                    ];
                    for (index, number) in numbers.into_iter().enumerate() {
                        if index == place {
                            *number = bad;
                        }
                    }
                });
                unresolved(&format!("coordinate {place} is {bad} from tilt {tilt}"), &cell);
            }
        }
    }
}

/// A sample past the readers and the pairing, which refuse such files.
#[test]
fn a_record_with_a_sample_that_is_not_finite_is_unresolved() {
    for bad in BAD {
        let mut samples: Vec<f64> = (0..300).map(|k| 3.0 * f64::sin(0.06 * f64::from(k))).collect();
        // The peak, from which the yield displacement follows, is that of the finite samples.
        let mut scene = shaken(rocks(), 0.01, samples.clone());
        samples[150] = bad;
        let topple::scene::Excitation::Record(pair) = &mut scene.excitation else {
            panic!("a scene under a record");
        };
        pair.horizontal = samples.into();
        unresolved(&format!("a sample is {bad}"), &swept::<f32>(&scene));
        unresolved(&format!("a sample is {bad}"), &swept::<f64>(&scene));
    }
}

/// Parameters that a user may give but f32 does not hold: unresolved where they matter, and of no
/// effect where they cannot.
#[test]
fn what_f32_does_not_hold_is_unresolved_or_has_no_effect() {
    let cell = |a_h: &str| swept::<f32>(&object(1, 0.2, (1.75, 0.75), 0.0, "5", a_h));
    unresolved("A_h = 1e39 in f32", &cell("1e39"));
    assert_eq!(cell("1e-41").class, Class::FullContact);
    say(
        "what_f32_does_not_hold_is_unresolved_or_has_no_effect: A_h = 1e39 m/s^2 is unresolved, 1e-41 full contact",
    );
}

/// What is not finite comes of the shader's own arithmetic.
#[test]
fn the_shader_says_so_where_its_numbers_are_not_finite() {
    let Some(gpu) = gpu("non-finite values in the shader", Precision::F32) else { return };
    let scene = object(1, 0.2, (1.75, 0.75), 0.5, "4:8:4", "3:8:4");
    let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
    let source = shader::source(Precision::F32, Switches::Forgotten);
    let run = |source: &str| {
        let sweeper = Sweeper::from_source(&gpu, source, plan.variant(), 0).unwrap();
        sweeper
            .sweep::<f32>(&plan, &grid, &crate::common::all(&grid), &Unwatched)
            .unwrap()
            .block
            .to_outcomes()
    };
    assert!(run(&source).iter().all(|cell| cell.class != Class::Unresolved));
    for (from, to) in [
        ("p * push_h - q * push_v", "p * push_h - q * push_v + sqrt(-1.0 - w)"),
        (
            "var spring = cell.horizontal.post_yield * y.u;",
            "var spring = cell.horizontal.post_yield * y.u * sqrt(-1.0 - y.u * y.u);",
        ),
        ("landing.eta_phi * y.dphi,", "landing.eta_phi * y.dphi * sqrt(-1.0 - y.dphi * y.dphi),"),
    ] {
        assert_eq!(source.matches(from).count(), 1, "{from}");
        let cells = run(&source.replace(from, to));
        let touched = cells.iter().filter(|cell| cell.class == Class::Unresolved).count();
        assert!(touched > 0, "'{to}' touched nothing");
        // What is unresolved says so; what is not has finite numbers.
        for cell in &cells {
            let finite =
                [cell.zeta, cell.max_u, cell.max_v, cell.t_end].iter().all(|x| x.is_finite());
            let right = if cell.class == Class::Unresolved {
                cell.status != Status::Ok
            } else {
                finite && (cell.uplifts == 0 || cell.impacts == 0)
            };
            assert!(right, "'{to}': {cell:?}");
        }
    }
}

/// A grid with one bad cell loses that cell and no other.
#[test]
fn a_cell_that_is_not_finite_leaves_the_others_as_they_are() {
    let scene = object(1, 0.2, (1.75, 0.75), 0.0, "5", "3:1e39:2");
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
    let cells = cpu::sweep(Precision::F32, &plan, &Grid::of(&scene), &[0, 1], &Unwatched);
    assert_ne!(cells[0].class, Class::Unresolved);
    unresolved("the second cell", &cells[1]);
}
