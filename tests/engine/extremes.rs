//! The largest values that the reference finds, and what lifts a block at the very limit.

use approx::assert_relative_eq;
use topple::scene::{Directions, GRAVITY, Grid, Parameter, Scene};
use topple::stepping::outcome::Class;
use topple::stepping::reference::{Settings, observe, run};

use crate::common::{judge, object, scene, shaken};

/// A block on the ground under a pulse.
fn on_the_ground(half_width: f64, omega: f64, a_h: f64, a_v: f64) -> Scene {
    scene(&format!(
        "[block]\nhalf_width = {half_width}\nheight = 1.0\n[base]\nisolation = \"none\"\n\
         [pulse]\nomega = {omega:?}\na_h = {a_h:?}\na_v = {a_v:?}\n[run]\nt_max = 2.0\n"
    ))
}

/// In full contact on the ground the forces are those of the pulse: N/M falls to g - A_v at three
/// quarters of it, where the ratio is A_h/(g - A_v).
#[test]
fn contact_forces_at_the_crest_of_a_pulse() {
    for omega in [3.0, 7.0, 11.0, 17.0, 39.0] {
        let cell = judge(&on_the_ground(0.5, omega, 1.0, 5.0));
        assert_eq!(cell.class, Class::FullContact);
        assert_relative_eq!(cell.min_contact, GRAVITY - 5.0, max_relative = 1e-8);
        assert_relative_eq!(cell.friction, 1.0 / (GRAVITY - 5.0), max_relative = 1e-8);
    }
}

/// Long steps find what steps of a twentieth of a millisecond sample: forces that change by half
/// of themselves in 10 ms are then sampled 1e-6 of themselves below their crest.
#[test]
fn long_steps_find_the_extremes_of_short_ones() {
    let short = Settings { longest: 5.0e-5, tolerance: 1.0e-12, ..Settings::default() };
    let mut rocking = 0;
    for scene in [
        object(1, 0.2, (1.75, 0.2), 2.0, "9", "6"),
        object(1, 0.1, (1.75, 0.75), 0.5, "7.75", "6.99"),
        object(3, -0.4, (0.8, 0.3), 3.0, "6", "5"),
    ] {
        let mut scene = scene;
        scene.set(Parameter::TMax, 1.5);
        let point = Grid::of(&scene).case(0);
        let (long, short) = (judge(&scene), run(&scene, &point, &short));
        rocking += u32::from(long.uplifts > 0);
        assert_eq!(long.class, short.class);
        assert_eq!(long.impacts, short.impacts);
        for (name, a, b) in [
            ("min_contact", long.min_contact, short.min_contact),
            ("friction", long.friction, short.friction),
            ("max_u", long.max_u, short.max_u),
            ("max_v", long.max_v, short.max_v),
            ("max_phi_left", long.max_phi_left, short.max_phi_left),
            ("max_phi_right", long.max_phi_right, short.max_phi_right),
        ] {
            assert!((a - b).abs() <= 1e-6 * b.abs(), "{name}: {a} for {b}, {long:?}");
        }
    }
    assert_eq!(rocking, 2, "one of them in full contact");
}

/// A push that jumps to a little more than lifts the block and falls: it lifts and lands within one step,
/// which it begins at rest. With the push p - r t and the weight's share w = g b/H, the angle follows
/// I phi'' = H (p - w - r t), whose crest is at t = 2 (p - w)/r.
#[test]
fn a_flight_within_one_step_has_its_crest() {
    let (b, h) = (0.2, 1.0);
    let limit = GRAVITY * b / h;
    let (over, fall) = (0.001, 0.4);
    let dt = 0.02;
    let samples: Vec<f64> = (0..3).map(|k| limit + over - fall * dt * f64::from(k)).collect();
    let block = scene(
        "[block]\nhalf_width = 0.2\nheight = 1.0\n[base]\nisolation = \"none\"\n\
         [pulse]\nomega = 1\na_h = 1\n",
    );
    let inertia = 4.0 / 3.0 * (b * b + h * h);
    let cell = judge(&shaken(block, dt, samples));
    let t = 2.0 * over / fall;
    let crest = h / inertia * (over * t * t / 2.0 - fall * t.powi(3) / 6.0);
    assert_eq!(cell.uplifts, 1);
    // The block on its corner adds p^2 t^2 = 2e-4 of the angle to its acceleration.
    assert_relative_eq!(cell.max_phi_left, crest, max_relative = 1e-4);
}

/// A landing just before a sample of the step's cubic, on which it comes just after: the step itself has
/// to say when. 44 impacts, the 28th of which was 0.05 ms late, and the largest angle off by 1e-3.
#[test]
fn impacts_of_long_steps_are_those_of_short_ones() {
    let scene = scene(
        "[block]\nhalf_width = 0.1498\nheight = 0.7196\neccentricity = 0.6374\n\
         [base]\nisolation = \"none\"\n\
         [pulse]\nomega = 33.94333333333333\na_h = -1.3534666666666668\na_v = 7.676\n\
         [run]\nt_max = 0.97\n",
    );
    let times = |longest: f64| {
        let settings = Settings { longest, tolerance: 1.0e-12, ..Settings::default() };
        let mut times = Vec::new();
        observe(&scene, &Grid::of(&scene).case(0), &settings, &mut |instant| {
            times.extend(instant.switch.map(|_| instant.t));
        });
        times
    };
    let (long, short) = (times(0.01), times(1.0e-4));
    assert_eq!(long.len(), short.len());
    assert!(long.len() > 40, "{}", long.len());
    for (a, b) in long.iter().zip(&short) {
        // EVENT_TIME, times what forty impacts make of it.
        assert!((a - b).abs() < 1.0e-9, "{a} {b}");
    }
}

/// Where the ground jumps and the block lifts at that instant there is no full contact under the
/// new push: the forces are those of rocking, (9c) at phi = 0.
#[test]
fn a_jump_of_the_ground_that_lifts_the_block() {
    let push = 4.0;
    let object_1 = object(1, 0.0, (1.0, 1.0), 0.0, "5", "1");
    let block = object_1.clone().isolated(Directions::None);
    let object_1 = object_1.case();
    let cell = judge(&shaken(block, 0.01, vec![push; 200]));
    let (b, h) = (object_1.block.half_width, object_1.block.height);
    let inertia = object_1.block.inertia / object_1.block.mass + b * b + h * h;
    let turning = (h * push - b * GRAVITY) / inertia;
    let friction = (push - h * turning) / (GRAVITY + b * turning);
    assert_eq!((cell.class, cell.t_uplift), (Class::OverturnedLeft, Some(0.0)));
    assert_relative_eq!(cell.friction, friction, max_relative = 1e-12);
    // 0.408 is 4 over g, of a full contact that there is not.
    assert_relative_eq!(cell.friction, 0.238_473_5, max_relative = 1e-6);
}

/// A block lifts at the crest of a pulse that is a ten-millionth too strong, and not below; steps
/// are up to a sixteenth of the pulse.
#[test]
fn an_uplift_at_the_crest_is_not_passed_over() {
    for omega in [10.0, 20.0, 30.0, 39.0] {
        let limit = 0.25 * GRAVITY;
        let above = judge(&on_the_ground(0.25, omega, limit * (1.0 + 1e-7), 0.0));
        let below = judge(&on_the_ground(0.25, omega, limit * (1.0 - 1e-9), 0.0));
        // Both crests of the sine lift it, each about its corner.
        assert_eq!((above.class, above.uplifts), (Class::Rocking, 2), "omega = {omega}");
        assert_eq!((below.class, below.uplifts), (Class::FullContact, 0), "omega = {omega}");
    }
}

/// X = 0: both corners lift at the same instant, when Y falls below zero, and the longer arm has the
/// larger moment. A mirrored block makes the mirrored motion.
#[test]
fn the_longer_arm_lifts_where_both_corners_do() {
    let vertical = |e: f64| {
        scene(&format!(
            "[block]\nobject = 1\neccentricity = {e}\n[base]\nisolation = \"vertical\"\nt_v = 0.75\n\
             [pulse]\nomega = 4.0\na_h = 0.0\na_v = 9.0\n[run]\nt_max = 10.0\n"
        ))
    };
    let dual = |e: f64| object(1, e, (1.75, 0.75), 9.0, "4.461538461538462", "0");
    for (name, one, other) in
        [("vertical", vertical(0.3), vertical(-0.3)), ("dual", dual(0.3), dual(-0.3))]
    {
        let (one, other) = (judge(&one), judge(&other));
        // With e > 0 the left corner is the farther one from the centre of mass.
        assert!(one.uplifts > 0 && one.max_phi_left > 0.0, "{name}: {one:?}");
        assert_eq!((one.impacts, one.uplifts), (other.impacts, other.uplifts), "{name}");
        assert_eq!(one.max_phi_left, other.max_phi_right, "{name}");
        assert_eq!(one.max_phi_right, other.max_phi_left, "{name}");
        assert_eq!((one.t_end, one.t_uplift), (other.t_end, other.t_uplift), "{name}");
        assert_eq!((one.max_u, one.friction), (other.max_u, other.friction), "{name}");
    }
    let cell = judge(&dual(0.3));
    assert_eq!((cell.class, cell.impacts), (Class::OverturnedRight, 1));
    assert_relative_eq!(cell.t_end, 1.781_223, epsilon = 1e-6);
}
