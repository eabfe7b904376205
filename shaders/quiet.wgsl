// No observer: a cell's switches are not kept; log.wgsl keeps them.

fn switched(state: ptr<function, State>, kind: u32, fraction: real) {
}
