//! The model against closed forms, conservation and symmetry.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use proptest::prelude::*;
use topple::backend::cpu;
use topple::backend::history::by_steps;
use topple::cells::plan::Plan;
use topple::model::CellEquations;
use topple::model::block::ROCKING_LEFT;
use topple::model::impact::{change_corner, come_to_rest};
use topple::model::motion::Motion;
use topple::model::precision::Precision;
use topple::scene::{GRAVITY, Grid, Scene, SceneBuilder};
use topple::stepping::guards::IMPACT;
use topple::stepping::log::Log;
use topple::stepping::outcome::Class;
use topple::stepping::reference::system::{
    DPHI, DU, DV, Drive, PHI, Pole, State as Cell, System, U, V, Z,
};
use topple::stepping::single;
use topple::stepping::state::State;
use topple::work::observer::Unwatched;

use crate::common::{object, scene};

/// A slender rectangle on the ground, its mass in the middle.
fn housner(half_width: f64, height: f64) -> Scene {
    scene(&format!(
        "[block]\nhalf_width = {half_width}\nheight = {height}\n[base]\nisolation = \"none\"\n\
         [pulse]\nomega = 5.0\na_h = 0.0\n[run]\nt_max = 40.0\n"
    ))
}

#[test]
fn restitution_is_housners_on_the_ground() {
    for (b, h) in [(0.1, 1.0), (0.2, 0.6), (0.5, 1.1)] {
        let scene = housner(b, h);
        let model = Plan::new(&scene, 0.004).unwrap().model::<f64>(&scene.case());
        let alpha = f64::atan2(b, h);
        let eta = 1.0 - 1.5 * alpha.sin().powi(2);
        assert_relative_eq!(model.left.eta_phi, eta, max_relative = 1e-14);
        assert_relative_eq!(model.right.eta_phi, eta, max_relative = 1e-14);
    }
}

/// A factor on the law's restitution keeps the linear momenta of (15a) and (15b); the largest keeps the energy, too, and a
/// larger one is refused.
#[test]
fn a_restitution_factor_keeps_linear_momenta() {
    let given = |base: &str, r: f64| {
        let text = format!(
            "[block]\nhalf_width = 0.3\nheight = 0.8\nmass = 500\nplate_h = 90\nplate_v = 60\neccentricity = 0.25\n\
             [base]\n{base}\n[pulse]\nomega = 5\na_h = 3\n[run]\nrestitution_factor = {r:?}\n"
        );
        SceneBuilder::from_toml(&text).unwrap().check()
    };
    for (base, moves) in [
        ("t_h = 1.75\nt_v = 0.75", [1.0, 1.0]),
        ("isolation = \"horizontal\"\nt_h = 1.75", [1.0, 0.0]),
        ("isolation = \"vertical\"\nt_v = 0.75", [0.0, 1.0]),
        ("isolation = \"none\"", [0.0, 0.0]),
    ] {
        let most = given(base, 1.0).unwrap().case().most_restitution_factor();
        assert!(most > 1.0 && most < 3.0, "{base}: {most}");
        let error = given(base, most * 1.000_01).unwrap_err();
        assert_eq!(error.key, "restitution_factor");
        for r in [0.0, 0.4, 0.9, 1.0, 0.5 * (1.0 + most), most] {
            let scene = given(base, r).unwrap();
            let case = scene.case();
            let model = Plan::new(&scene, 0.004).unwrap().model::<f64>(&case);
            let system = System::new(&scene, &case);
            for (leaving, landing, pole) in
                [(&model.left, &model.right, Pole::Left), (&model.right, &model.left, Pole::Right)]
            {
                let before = Motion {
                    u: 0.1,
                    du: 0.7 * moves[0],
                    v: -0.05,
                    dv: -0.4 * moves[1],
                    z: 0.3,
                    phi: 0.0,
                    // Towards the base.
                    dphi: -0.9 * leaving.side,
                };
                let after = change_corner(landing, &before);
                let momenta = |y: &Motion<f64>, side: f64, arm: f64| {
                    [
                        650.0 * y.du - 500.0 * 0.8 * y.dphi,
                        560.0 * y.dv + 500.0 * side * arm * y.dphi,
                    ]
                };
                let [old, new] = [
                    momenta(&before, leaving.side, leaving.arm),
                    momenta(&after, landing.side, landing.arm),
                ];
                for direction in 0..2 {
                    if moves[direction] > 0.0 {
                        assert_relative_eq!(old[direction], new[direction], max_relative = 1e-13);
                    }
                }
                // The other form of the same, of the reference.
                let mut y = Cell::zeros();
                (y[U], y[DU], y[V], y[DV]) = (before.u, before.du, before.v, before.dv);
                (y[Z], y[DPHI]) = (before.z, before.dphi);
                let judged = system.impact(pole, &y);
                for (own, other) in
                    [(after.du, judged[DU]), (after.dv, judged[DV]), (after.dphi, judged[DPHI])]
                {
                    assert_abs_diff_eq!(own, other, epsilon = 1e-13);
                }
                let energy = |pole: Pole, y: &Cell| system.energy(Some(pole), y);
                let lost = energy(pole, &y) - energy(pole.other(), &judged);
                match r == most {
                    true => assert_abs_diff_eq!(lost, 0.0, epsilon = 1e-10),
                    false => assert!(lost > 1e-3, "{base}, r = {r}: {lost}"),
                }
            }
        }
    }
}

#[test]
fn a_light_plate_takes_almost_no_energy() {
    let scene = object(1, 0.0, (1.75, 0.75), 0.0, "5", "3");
    let model = Plan::new(&scene, 0.004).unwrap().model::<f64>(&scene.case());
    assert_abs_diff_eq!(model.left.eta_phi, 0.992_79, epsilon = 5e-6);
}

/// Times and speeds of impacts.
#[derive(Default)]
struct Impacts(Vec<(f64, f64)>, f64);

impl Log<f64> for Impacts {
    fn switched(&mut self, kind: u32, fraction: f64, state: &State<f64>) {
        if kind == IMPACT {
            self.0.push(((f64::from(state.step) + fraction) * self.1, state.motion.dphi));
        }
    }
}

/// Free rocking from the angle `phi0` about the left corner: impacts of the fixed-step method.
fn free_rocking(scene: &Scene, phi0: f64) -> Vec<(f64, f64)> {
    let plan = Plan::new(scene, 1.0 / 512.0).unwrap().full_model();
    let point = Grid::of(scene).case(0);
    let model = plan.model::<f64>(&plan.scene.case());
    let (mut cell, mut state) = plan.cell::<f64>(&point);
    // No excitation: every step is a free one of the same length.
    cell.steps.steps_forced = 0;
    state.mode = ROCKING_LEFT;
    state.motion.phi = phi0;
    let set = CellEquations::of(plan.variant(), &model, &cell, &[]);
    let mut log = Impacts(Vec::new(), cell.steps.step_free);
    single::run(&set, &state, &mut log);
    log.0
}

/// Housner 1963: a block released at phi0 lands after T/4 = acosh(1/(1 - phi0/alpha))/p, and
/// each impact leaves the share eta of its speed. The linear form's error is of order alpha^2.
#[test]
fn free_rocking_has_housners_period_and_decay() {
    let (b, h) = (0.01, 1.0);
    let scene = housner(b, h);
    let alpha = f64::atan2(b, h);
    let p = (3.0 * GRAVITY / (4.0 * (b * b + h * h).sqrt())).sqrt();
    let eta = 1.0 - 1.5 * alpha.sin().powi(2);
    for share in [0.1, 0.5, 0.9] {
        let impacts = free_rocking(&scene, share * alpha);
        let quarter = |share: f64| (1.0 / (1.0 - share)).acosh() / p;
        assert_relative_eq!(impacts[0].0, quarter(share), max_relative = 2.0 * alpha * alpha);
        // Energy: (1 - phi1/alpha)^2 = 1 - eta^2 (1 - (1 - phi0/alpha)^2) from swing to swing.
        let mut amplitude = share;
        for n in 0..5 {
            amplitude = 1.0 - (1.0 - eta * eta * (1.0 - (1.0 - amplitude).powi(2))).sqrt();
            let half_period = impacts[n + 1].0 - impacts[n].0;
            assert_relative_eq!(half_period, 2.0 * quarter(amplitude), max_relative = 2e-4);
        }
        for pair in impacts[..6].windows(2) {
            assert_relative_eq!(pair[1].1 / pair[0].1, -eta, max_relative = 1e-9);
        }
    }
}

fn blocks() -> impl Strategy<Value = (Scene, [f64; 3])> {
    let sides = (0.05..0.6_f64, 0.3..2.0_f64, -0.9..0.9_f64);
    let masses = (10.0..2000.0_f64, 0.2..3.0_f64, 1.0..500.0_f64, 1.0..500.0_f64);
    let velocity = [-2.0..2.0_f64, -2.0..2.0_f64, 0.01..3.0_f64];
    (sides, masses, velocity).prop_map(|((b, h, e), (m, round, m_h, m_v), velocity)| {
        let inertia = round * m * (b * b + h * h) / 3.0;
        let text = format!(
            "[block]\nhalf_width = {b}\nheight = {h}\neccentricity = {e}\nmass = {m}\n\
             inertia = {inertia}\nplate_h = {m_h}\nplate_v = {m_v}\n\
             [base]\nt_h = 1.5\nt_v = 0.5\n[pulse]\nomega = 5.0\na_h = 3.0\n"
        );
        (scene(&text), velocity)
    })
}

/// A state just before an impact that ends rocking about `pole`.
fn before(pole: Pole, [du, dv, dphi]: [f64; 3]) -> Cell {
    let mut y = Cell::zeros();
    (y[U], y[V], y[Z]) = (0.02, -0.06, 0.3);
    (y[DU], y[DV], y[DPHI]) = (du, dv, -pole.sign() * dphi);
    y
}

fn as_motion(y: &Cell) -> Motion<f64> {
    // From the static position, for T_v = 0.5 s.
    let deflection = GRAVITY * (0.5 / std::f64::consts::TAU).powi(2);
    Motion {
        u: y[U],
        du: y[DU],
        v: y[V] + deflection,
        dv: y[DV],
        z: y[Z],
        phi: y[PHI],
        dphi: y[DPHI],
    }
}

proptest! {
    /// The closed form (16)-(18), and that of a block coming to rest, against (15) solved as the
    /// linear system that it is.
    #[test]
    fn the_impact_law_is_the_balance_of_momenta((scene, velocity) in blocks()) {
        let plan = Plan::new(&scene, 0.004).unwrap();
        let model = plan.model::<f64>(&plan.scene.case());
        let point = Grid::of(&scene).case(0);
        let system = System::new(&scene, &point);
        let (cell, _) = plan.cell::<f64>(&point);
        let set = CellEquations::of(plan.variant(), &model, &cell, &[]);
        for (pole, leaving, landing) in
            [(Pole::Left, model.left, model.right), (Pole::Right, model.right, model.left)]
        {
            let y = before(pole, velocity);
            for (solved, closed) in [
                (system.impact(pole, &y), change_corner(&landing, &as_motion(&y))),
                (system.settle(pole, &y), come_to_rest(&set, &leaving, &as_motion(&y))),
            ] {
                for (a, b) in as_motion(&solved).reals().iter().zip(closed.reals()) {
                    assert_abs_diff_eq!(*a, b, epsilon = 1e-10);
                }
            }
        }
    }

    /// No impact adds energy, neither one that goes on nor one that ends all rotation.
    #[test]
    fn an_impact_never_adds_energy((scene, velocity) in blocks()) {
        let system = System::new(&scene, &Grid::of(&scene).case(0));
        for pole in [Pole::Left, Pole::Right] {
            let y = before(pole, velocity);
            let energy = system.energy(Some(pole), &y);
            let after = system.energy(Some(pole.other()), &system.impact(pole, &y));
            let settled = system.energy(None, &system.settle(pole, &y));
            let rounding = 1e-12 * energy.abs().max(1.0);
            prop_assert!(after <= energy + rounding, "{energy} {after}");
            prop_assert!(settled <= energy + rounding, "{energy} {settled}");
        }
    }

    /// Both formulations of the dynamics give the same accelerations and contact forces.
    #[test]
    fn two_formulations_of_the_dynamics_agree((scene, velocity) in blocks(), phi in 0.0..0.5_f64) {
        let plan = Plan::new(&scene, 0.004).unwrap();
        let model = plan.model::<f64>(&plan.scene.case());
        let point = Grid::of(&scene).case(0);
        let system = System::new(&scene, &point);
        let (cell, _) = plan.cell::<f64>(&point);
        let set = CellEquations::of(plan.variant(), &model, &cell, &[]);
        for (pole, corner) in [(Pole::Left, model.left), (Pole::Right, model.right)] {
            let mut y = before(pole, velocity);
            y[PHI] = pole.sign() * phi;
            let fraction = 0.37;
            let t = (5.0 + fraction) * cell.steps.step_forced;
            let ground = topple::stepping::forcing::ground_at(&set, 5, fraction);
            let k = topple::model::dynamics::rates(&set, &corner, true, &as_motion(&y), ground);
            let slow = system.derivative(Some(pole), t, Drive::Pulse, &y);
            let (normal, shear) = system.contact(Some(pole), t, Drive::Pulse, &y);
            let pairs = [
                (k.ddu, slow[DU]), (k.ddv, slow[DV]), (k.ddphi, slow[DPHI]), (k.dz, slow[Z]),
                (k.normal, normal), (k.shear, shear),
            ];
            for (a, b) in pairs {
                prop_assert!((a - b).abs() <= 1e-9 * (1.0 + b.abs()), "{a} {b}");
            }
        }
    }
}

/// Mirror symmetry is exact: e -> -e with the input reversed gives the mirrored motion, bit by
/// bit, in the fixed-step method.
#[test]
fn mirrored_scenes_give_mirrored_motions_exactly() {
    let run = |e: f64, t_v: f64, omega: &str, a_h: f64| {
        let scene = object(1, e, (1.75, t_v), 0.5, omega, &a_h.to_string());
        let plan = Plan::new(&scene, 1.0 / 256.0).unwrap();
        by_steps::<f64>(&plan, &Grid::of(&scene).case(0))
    };
    for (e, t_v, omega, a_h) in
        [(0.1, 0.75, "7.75", 6.99), (0.4, 0.3, "7.56", 7.54), (0.4, 0.3, "13.37", 10.23)]
    {
        let (rows, outcome) = run(e, t_v, omega, a_h);
        let (mirrored, image) = run(-e, t_v, omega, -a_h);
        assert!(outcome.impacts > 0, "the scene should hold impacts");
        assert_eq!(rows.len(), mirrored.len());
        for (a, b) in rows.iter().zip(&mirrored) {
            assert_eq!((a.t, a.u, a.du, a.z), (b.t, -b.u, -b.du, -b.z));
            assert_eq!((a.v, a.dv, a.phi, a.dphi), (b.v, b.dv, -b.phi, -b.dphi));
        }
        assert_eq!(outcome.max_phi_left, image.max_phi_right);
        assert_eq!(outcome.zeta, image.zeta);
    }
}

/// A symmetric block has two equal corners; reversing the input alone mirrors the motion.
#[test]
fn without_eccentricity_the_block_is_symmetric() {
    let scene = object(2, 0.0, (1.75, 0.75), 0.0, "5", "3");
    let model = Plan::new(&scene, 0.004).unwrap().model::<f64>(&scene.case());
    let (left, mut right) = (model.left, model.right);
    right.side = -right.side;
    assert_eq!(left, right);
    let outcome = |a_h: &str| {
        let scene = object(1, 0.0, (1.75, 0.75), 0.0, "5", a_h);
        cpu::sweep(
            Precision::F64,
            &Plan::new(&scene, 0.004).unwrap(),
            &Grid::of(&scene),
            &[0],
            &Unwatched,
        )[0]
    };
    let (one, other) = (outcome("3.5"), outcome("-3.5"));
    assert_eq!((one.class, other.class), (Class::OverturnedRight, Class::OverturnedLeft));
    assert_eq!((one.t_end, one.impacts), (other.t_end, other.impacts));
}

/// After the pulse nothing feeds the motion: the energy of every step is at most that of the one
/// before, through impacts, yielding and rest.
#[test]
fn energy_never_rises_once_the_pulse_is_over() {
    for (e, periods, omega, a_h) in [
        (0.1, (1.75, 0.3), "10.77", "8.74"),
        (0.1, (2.5, 0.75), "7.9", "9.53"),
        (-0.2, (1.2, 0.75), "11.52", "5.16"),
    ] {
        let scene = object(1, e, periods, 0.0, omega, a_h);
        let point = Grid::of(&scene).case(0);
        let system = System::new(&scene, &point);
        // The rest before the last flights end would leave most impacts out.
        let plan = Plan::new(&scene, 1.0 / 512.0).unwrap().full_model();
        let (rows, outcome) = by_steps::<f64>(&plan, &point);
        assert!(outcome.impacts > 50 && outcome.class == Class::Rocking, "{outcome:?}");
        let end = system.pulse_end();
        let mut last = f64::INFINITY;
        let mut first = None;
        for row in rows.iter().filter(|row| row.t > end) {
            let y = Cell::from([row.u, row.v, row.phi, row.du, row.dv, row.dphi, row.z]);
            let phase = match row.mode {
                "rocking_left" => Some(Pole::Left),
                "rocking_right" => Some(Pole::Right),
                _ => None,
            };
            let energy = system.energy(phase, &y);
            let first = *first.get_or_insert(energy);
            let floor = system.energy(None, &system.at_rest());
            // RK4's own error: a step's share of h^4 relative to the energy above rest, and
            // larger, of order h^2, in the step that holds a kink of the Bouc-Wen law.
            let allowance = 2e-6 * (first - floor);
            assert!(energy <= last + allowance, "t = {}: {last} -> {energy}", row.t);
            last = energy;
        }
    }
}
