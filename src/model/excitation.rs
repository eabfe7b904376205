//! One cell's numbers, and the ground's accelerations. Twin of `shaders/excitation.wgsl`.

use bytemuck::Zeroable;

use super::layout::{pod, reals};

/// The numbers of one cell of the grid.
///
/// Time is a whole number of steps and a fraction of a step; the lengths of steps are never summed. The forced steps
/// divide the pulse evenly, so that its end is a step boundary; the free steps divide the rest.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Cell<R> {
    /// psi omega_h^2, 1/s^2.
    pub post_yield: R,
    /// (1 - psi) omega_h^2 u_y, m/s^2.
    pub hysteretic: R,
    /// 2 xi_h omega_h, 1/s.
    pub damping_h: R,
    /// 1/u_y, 1/m.
    pub inverse_yield: R,
    /// omega_v^2, 1/s^2.
    pub stiffness_v: R,
    /// 2 xi_v omega_v, 1/s.
    pub damping_v: R,
    /// A_h of (22a), m/s^2; the factor on a record's samples.
    pub amplitude_h: R,
    /// A_v of (22b), m/s^2; the same factor.
    pub amplitude_v: R,
    /// Periods of the pulse, or gaps between samples of the record, in one forced step.
    pub phase_step: R,
    /// Length of a forced step, s.
    pub step_forced: R,
    /// Length of a free step, s.
    pub step_free: R,
    /// |dphi| below which a landing block comes to rest, rad/s.
    pub rest_speed: R,
    /// (1 - psi) omega_h^2 u_y^2: twice the energy that z stores, over M_t, m^2/s^2.
    pub yield_energy: R,
    /// g/omega_v^2, the base's static deflection, m.
    pub deflection: R,
    /// omega_h sqrt(1 + 4 xi_h^2/a): the largest |f_h| of (10a) divided by the square root of twice the energy over
    /// M_t, 1/s. a <= 1 is the share of the inertia of u that remains where the block is free to rock.
    pub reach_h: R,
    /// The same for |f_v - g| of (10b), 1/s.
    pub reach_v: R,
    /// 1/gamma of a modulated pulse.
    pub envelope: R,
    /// Where the carrier of a modulated pulse begins, periods.
    pub carrier: R,
    /// d, the displacement at which the base meets its end stop, m.
    pub stop_gap: R,
    /// omega_s^2 of the stop, 1/s^2.
    pub stop_stiffness: R,
    /// 2 xi_s omega_s, 1/s.
    pub stop_damping: R,
    /// Rate of the fastest motion against the stop, 1/s.
    pub stop_rate: R,
    /// omega_v^2/v_c^2 of a vertical spring that hardens, 1/(m s)^2.
    pub hardening_v: R,
    /// Number of forced steps.
    pub steps_forced: u32,
    /// Number of steps in all.
    pub steps: u32,
    /// Steps between two samples of a record.
    pub substeps: u32,
    /// Number of the cell's body, see [`Model`](super::block::Model).
    pub body: u32,
}

pod!(Cell, reals: 23, words: 4);
reals!(
    Cell, 23, post_yield hysteretic damping_h inverse_yield stiffness_v damping_v amplitude_h
    amplitude_v phase_step step_forced step_free rest_speed yield_energy deflection reach_h reach_v
    envelope carrier stop_gap stop_stiffness stop_damping stop_rate hardening_v;
    steps_forced steps substeps body
);

/// The ground's accelerations, m/s^2; also a sample of a record.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Ground<R> {
    /// Horizontal, second derivative of u_g.
    pub h: R,
    /// Vertical, second derivative of v_g.
    pub v: R,
}

pod!(Ground, reals: 2, words: 0);
reals!(Ground, 2, h v);
