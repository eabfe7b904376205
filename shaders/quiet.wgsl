// No observer: the switches of a cell are not kept; log.wgsl keeps them.

fn switched(state: ptr<function, State>, kind: u32, fraction: real) {
}
