// One thread a cell: a chunk of its steps, from its state to its state. Twin: src/sweep/cpu.rs.

override workgroup_size: u32 = 64u;

struct Chunk {
    cells: u32,
    steps: u32,
}

@group(0) @binding(1) var<storage, read> cells: array<Cell>;
@group(0) @binding(2) var<storage, read_write> states: array<State>;
@group(0) @binding(3) var<uniform> chunk: Chunk;
// Cells that still run after this chunk.
@group(0) @binding(4) var<storage, read_write> running: atomic<u32>;

@compute @workgroup_size(workgroup_size)
fn sweep(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= chunk.cells {
        return;
    }
    let cell = cells[id.x];
    var state = states[id.x];
    var done = 0u;
    while done < chunk.steps && state.status == RUNNING {
        advance(cell, &state);
        done += 1u;
    }
    if done > 0u {
        states[id.x] = state;
    }
    if state.status == RUNNING {
        atomicAdd(&running, 1u);
    }
}
