//! The velocities after an impact: the balance of momenta (15), solved as a linear system; and the energy, which an
//! impact must not raise.
//!
//! Nothing here is shared with [`crate::model`], and the closed form (16)-(18) of the impact is not used.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::system::{DPHI, DU, DV, PHI, Phase, Pole, State, System, U, Z};
use crate::scene::GRAVITY;

impl System {
    /// The state after an impact that ends rocking about `before`: (15) solved for the velocities after it, where the
    /// block then turns about the other corner.
    pub fn impact(&self, before: Pole, y: &State) -> State {
        let after = before.other();
        let total_h = self.mass + self.plate_h + self.plate_v;
        let total_v = self.mass + self.plate_v;
        let (m, h) = (self.mass, self.height);
        // Momenta at phi = 0, where C moves by (u' - H phi', v' +- (B +- e) phi'); the angular
        // one is about the corner after the impact.
        let lever = after.sign() * self.arm(after);
        let momenta = |pole: Pole| {
            let r = pole.sign() * self.arm(pole);
            let angular = self.inertia + m * (lever * r + h * h);
            Matrix3::new(total_h, 0.0, -m * h, 0.0, total_v, m * r, -m * h, m * lever, angular)
        };
        let velocity = Vector3::new(y[DU], y[DV], y[DPHI]);
        let mut right = momenta(before) * velocity;
        let mut matrix = momenta(after);
        for (row, moves) in [(0, self.moves_h), (1, self.moves_v)] {
            if !moves {
                matrix.set_row(row, &nalgebra::RowVector3::zeros());
                matrix[(row, row)] = 1.0;
                right[row] = 0.0;
            }
        }
        if let Some(restitution) = self.restitution {
            matrix.set_row(2, &nalgebra::RowVector3::new(0.0, 0.0, 1.0));
            right[2] = restitution * y[DPHI];
        }
        let solve = |matrix: Matrix3<f64>, right: &Vector3<f64>| {
            matrix.lu().solve(right).unwrap_or_else(|| Vector3::repeat(f64::NAN))
        };
        let mut solved = solve(matrix, &right);
        if self.restitution_factor != 1.0 {
            // The linear momenta are kept; the rotation is given, and takes the place of the balance of the angular
            // momentum.
            matrix.set_row(2, &nalgebra::RowVector3::new(0.0, 0.0, 1.0));
            right[2] = self.restitution_factor * solved[2];
            solved = solve(matrix, &right);
        }
        let mut landed = *y;
        landed[PHI] = 0.0;
        landed.fixed_rows_mut::<3>(DU).copy_from(&solved);
        landed
    }

    /// The state after an impact on both corners at once: (15a) and (15b) without a rotation afterwards.
    pub fn settle(&self, before: Pole, y: &State) -> State {
        let r = before.sign() * self.arm(before);
        let mut settled = *y;
        settled[PHI] = 0.0;
        settled[DPHI] = 0.0;
        if self.moves_h {
            let total = self.mass + self.plate_h + self.plate_v;
            settled[DU] = (total * y[DU] - self.mass * self.height * y[DPHI]) / total;
        }
        if self.moves_v {
            let total = self.mass + self.plate_v;
            settled[DV] = (total * y[DV] + self.mass * r * y[DPHI]) / total;
        }
        settled
    }

    /// The mechanical energy, J: the kinetic energy, that of gravity, and that of the springs; zero on the ground
    /// with springs at their natural length.
    pub fn energy(&self, phase: Phase, y: &State) -> f64 {
        let (m, h) = (self.mass, self.height);
        let mut centre = Vector2::new(y[DU], y[DV]);
        let mut rise = 0.0;
        if let Some(pole) = phase {
            let (sin, cos) = y[PHI].sin_cos();
            let r = Vector2::new(pole.sign() * self.arm(pole), h);
            let turned = Matrix2::new(cos, -sin, sin, cos) * r;
            centre += Vector2::new(-turned[1], turned[0]) * y[DPHI];
            rise = turned[1] - h;
        }
        let kinetic = 0.5 * self.plate_h * y[DU] * y[DU]
            + 0.5 * self.plate_v * (y[DU] * y[DU] + y[DV] * y[DV])
            + 0.5 * m * centre.norm_squared()
            + 0.5 * self.inertia * y[DPHI] * y[DPHI];
        let gravity = GRAVITY * m * rise;
        let stored = 0.5 * self.psi * self.k_h * y[U] * y[U]
            + 0.5 * (1.0 - self.psi) * self.k_h * self.u_y * self.u_y * y[Z] * y[Z]
            + self.stored_v(y)
            + self.stored_stop(y);
        kinetic + gravity + stored
    }
}
