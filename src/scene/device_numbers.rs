//! What a device's catalogue numbers make of the base's law (10a), over all cells of a grid.

use std::f64::consts::TAU;
use std::fmt;

use serde::Serialize;

use super::{Case, Device, Grid, Scene};

/// The numbers of the law, each from its least to its largest value.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DeviceNumbers {
    /// T_h, s.
    pub t_h: [f64; 2],
    /// The period with the stiffness after yielding, s; infinite where that is zero.
    pub t_yielded: [f64; 2],
    /// psi.
    pub psi: [f64; 2],
    /// u_y, m.
    pub u_y: [f64; 2],
    /// The mass on the device, for which its stiffnesses are, kg. Without plates no motion depends on it, and 1 kg is taken where no
    /// mass is given.
    pub carried: [f64; 2],
    /// k_h, N/m.
    pub k_h: [f64; 2],
    /// The stiffness after yielding, psi k_h, N/m.
    pub k_yielded: [f64; 2],
    /// The damper's coefficient, N s/m.
    pub c_h: [f64; 2],
}

impl DeviceNumbers {
    /// Those of a scene whose base is given by a device's numbers; none of others.
    pub fn of(scene: &Scene) -> Option<DeviceNumbers> {
        if !scene.isolation.moves_h() || Device::of(&scene.numbers) == Device::Paper {
            return None;
        }
        let grid = Grid::of(scene);
        let over = |number: fn(&Case) -> Option<f64>| {
            let all = grid.corners().filter_map(|case| number(&case));
            all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        };
        Some(DeviceNumbers {
            t_h: over(|case| Some(case.isolation.horizontal?.t_h)),
            t_yielded: over(|case| {
                let law = case.isolation.horizontal?;
                Some(law.t_h / law.psi.sqrt())
            }),
            psi: over(|case| Some(case.isolation.horizontal?.psi)),
            u_y: over(|case| Some(case.isolation.horizontal?.u_y)),
            carried: over(|case| Some(carried(case))),
            k_h: over(stiffness),
            k_yielded: over(|case| Some(stiffness(case)? * case.isolation.horizontal?.psi)),
            c_h: over(|case| {
                let law = case.isolation.horizontal?;
                Some(2.0 * law.xi_h * stiffness(case)? * law.t_h / TAU)
            }),
        })
    }
}

/// k_h of (19), N/m.
fn stiffness(case: &Case) -> Option<f64> {
    Some(carried(case) * (TAU / case.isolation.horizontal?.t_h).powi(2))
}

/// The block and the plates, kg.
fn carried(case: &Case) -> f64 {
    case.block.mass + case.isolation.plate_h + case.isolation.plate_v
}

impl fmt::Display for DeviceNumbers {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let of = |[low, high]: [f64; 2]| match low == high {
            true => short(low),
            false => format!("{} to {}", short(low), short(high)),
        };
        write!(
            f,
            "T_h = {} s before it yields or slides, {} s after, ψ = {}, u_y = {} m, k_h = {} N/m, ψ k_h = {} N/m, damper {} N s/m for {} kg on the device",
            of(self.t_h),
            of(self.t_yielded),
            of(self.psi),
            of(self.u_y),
            of(self.k_h),
            of(self.k_yielded),
            of(self.c_h),
            of(self.carried)
        )
    }
}

/// Four digits of a number.
fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    rounded.to_string()
}
