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
    // Padding: the size of the struct is a multiple of 16 bytes, as a uniform buffer requires.
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

// The body of all cells, where they do not differ in it; otherwise the body of the first.
@group(0) @binding(0) var<uniform> uniform_model: Model;

// Every thread reads the body of its cell once, at its begin: a software driver reads a uniform number for each lane,
// each time.
var<private> model: Model;

// The corner about which the block turns in a rocking mode.
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
