// The change of the velocities at an impact. Twin: src/model/impact.rs.

// After the impact the block turns about the other corner, `landing`: (16) with the coefficients (17).
fn change_corner(landing: Corner, y: Motion) -> Motion {
    return Motion(
        y.u,
        y.du - landing.eta_u * y.dphi,
        y.v,
        y.dv - landing.side * landing.eta_v * y.dphi,
        y.z,
        real(0.0),
        landing.eta_phi * y.dphi,
    );
}

// The block comes to rest on both corners: the linear momenta are kept, and the rotation ends.
fn come_to_rest(leaving: Corner, y: Motion) -> Motion {
    return Motion(
        y.u,
        y.du - model.mu_h * model.height * y.dphi,
        y.v,
        y.dv + model.mu_v * leaving.side * leaving.arm * y.dphi,
        y.z,
        real(0.0),
        real(0.0),
    );
}
