//! One cell's numbers, and the ground's accelerations. Twin of `shaders/excitation.wgsl`.

use bytemuck::Zeroable;

use super::layout::{nested, pod, reals};

/// The numbers of a cell that come from the horizontal isolation.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Horizontal<R> {
    /// psi omega_h^2, 1/s^2.
    pub post_yield: R,
    /// (1 - psi) omega_h^2 u_y, m/s^2.
    pub hysteretic: R,
    /// 2 xi_h omega_h, 1/s.
    pub damping_h: R,
    /// 1/u_y, 1/m.
    pub inverse_yield: R,
    /// (1 - psi) omega_h^2 u_y^2: twice the energy that z stores, over M_t, m^2/s^2.
    pub yield_energy: R,
    /// omega_h sqrt(1 + 4 xi_h^2/a): the largest |f_h| of (10a) divided by the square root of twice the energy over
    /// M_t, 1/s. a <= 1 is the share of the inertia of u that remains where the block is free to rock.
    pub reach_h: R,
    /// d, the displacement at which the base meets its end stop, m.
    pub stop_gap: R,
    /// omega_s^2 of the stop, 1/s^2.
    pub stop_stiffness: R,
    /// 2 xi_s omega_s, 1/s.
    pub stop_damping: R,
    /// Rate of the fastest motion against the stop, 1/s.
    pub stop_rate: R,
    /// 1 where all these numbers are finite, 0 where the number type does not hold one.
    pub finite: R,
}

/// The numbers of a cell that come from the vertical isolation.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Vertical<R> {
    /// omega_v^2, 1/s^2.
    pub stiffness_v: R,
    /// 2 xi_v omega_v, 1/s.
    pub damping_v: R,
    /// g/omega_v^2, the base's static deflection, m.
    pub deflection: R,
    /// The same for |f_v - g| of (10b), 1/s.
    pub reach_v: R,
    /// omega_v^2/v_c^2 of a vertical spring that hardens, 1/(m s)^2.
    pub hardening_v: R,
    /// 1 where all these numbers are finite, 0 where the number type does not hold one.
    pub finite: R,
}

/// The numbers of a cell that come from the excitation and the initial tilt.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Drive<R> {
    /// A_h of (22a), m/s^2; the factor on a record's samples.
    pub amplitude_h: R,
    /// A_v of (22b), m/s^2; the same factor.
    pub amplitude_v: R,
    /// A_h over the A_h of the shared motions of u, which are proportional to it.
    pub scale: R,
    /// phi at the start, rad.
    pub tilt: R,
    /// 1/gamma of a modulated pulse.
    pub envelope: R,
    /// Where the carrier of a modulated pulse begins, periods.
    pub carrier: R,
    /// 1 where these numbers are finite, 0 where the number type does not hold one.
    pub finite: R,
}

/// A cell's steps.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Steps<R> {
    /// Periods of the pulse, or gaps between samples of the record, in one forced step.
    pub phase_step: R,
    /// Length of a forced step, s.
    pub step_forced: R,
    /// Length of a free step, s.
    pub step_free: R,
    /// |dphi| below which a landing block comes to rest, rad/s.
    pub rest_speed: R,
    /// Number of forced steps.
    pub steps_forced: u32,
    /// Number of steps in all.
    pub steps: u32,
    /// Steps between two samples of a record.
    pub substeps: u32,
    /// 1 where all these numbers are finite, 0 where the number type does not hold one.
    pub finite: u32,
}

pod!(Horizontal, reals: 11, words: 0);
pod!(Vertical, reals: 6, words: 0);
pod!(Drive, reals: 7, words: 0);
pod!(Steps, reals: 4, words: 4);
reals!(
    Horizontal, 10, post_yield hysteretic damping_h inverse_yield yield_energy reach_h stop_gap stop_stiffness
    stop_damping stop_rate | finite
);
reals!(Vertical, 5, stiffness_v damping_v deflection reach_v hardening_v | finite);
reals!(Drive, 4, amplitude_h amplitude_v envelope carrier | scale tilt finite);
reals!(Steps, 4, phase_step step_forced step_free rest_speed; steps_forced steps substeps finite);

/// The numbers of one cell of the grid, in groups by the parameters that each depends on.
///
/// Time is a whole number of steps and a fraction of a step; the lengths of steps are never summed. The forced steps
/// divide the pulse evenly, so that its end is a step boundary; the free steps divide the rest.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Cell<R> {
    /// Those of the horizontal isolation.
    pub horizontal: Horizontal<R>,
    /// Those of the vertical isolation.
    pub vertical: Vertical<R>,
    /// Those of the excitation and the initial tilt.
    pub drive: Drive<R>,
    /// The steps.
    pub steps: Steps<R>,
    /// Number of the cell's body, see [`Model`](super::block::Model).
    pub body: u32,
    /// Padding: the size of the struct is a multiple of 8 bytes.
    pub padding: u32,
}

pod!(Cell, reals: 28, words: 6);
nested!(Cell, horizontal vertical drive steps;; body padding);

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
