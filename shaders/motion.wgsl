// The state of a cell's motion. Twin: src/model/motion.rs.

struct Motion {
    u: real,
    du: real,
    // The displacement from the static position: v + g/omega_v^2.
    v: real,
    dv: real,
    z: real,
    phi: real,
    dphi: real,
}
