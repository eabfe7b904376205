// The block and its two corners. Twin: src/model/block.rs.

const FULL_CONTACT = 0u;
const ROCKING_LEFT = 1u;
const ROCKING_RIGHT = 2u;

struct Corner {
    side: real,
    arm: real,
    inertia: real,
    overturn: real,
    eta_phi: real,
    eta_u: real,
    eta_v: real,
    // Fills the struct to whole 16 bytes, as a uniform buffer asks for.
    padding: real,
}

struct Model {
    left: Corner,
    right: Corner,
    height: real,
    mu_h: real,
    mu_v: real,
    gravity: real,
    inverse_mu_h: real,
    inverse_mu_v: real,
    least_arm: real,
    topple_energy: real,
    impact_gain: real,
    normal_share: real,
    normal_by_shear: real,
    normal_by_turn: real,
    shear_by_normal: real,
    shear_by_turn: real,
    padding_0: real,
    padding_1: real,
}

// The body that all cells have, where they differ in none; otherwise that of the first.
@group(0) @binding(0) var<uniform> uniform_model: Model;

// Every thread reads its cell's once, as it begins: a software driver looks up a uniform number lane by
// lane, each time.
var<private> model: Model;

// The corner that the block turns about in a rocking mode.
fn pivot(mode: u32) -> Corner {
    let right = mode == ROCKING_RIGHT;
    return Corner(
        select(model.left.side, model.right.side, right),
        select(model.left.arm, model.right.arm, right),
        select(model.left.inertia, model.right.inertia, right),
        select(model.left.overturn, model.right.overturn, right),
        select(model.left.eta_phi, model.right.eta_phi, right),
        select(model.left.eta_u, model.right.eta_u, right),
        select(model.left.eta_v, model.right.eta_v, right),
        model.left.padding,
    );
}
