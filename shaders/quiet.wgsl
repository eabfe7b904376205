// No one looks at a cell's switches; log.wgsl keeps them.

fn switched(state: ptr<function, State>, kind: u32, fraction: real) {
}
