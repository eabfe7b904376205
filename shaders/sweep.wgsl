// One thread a cell: a chunk of its steps, from its state to its state. Twin: src/sweep/cpu.rs.

override workgroup_size: u32 = 64u;

struct Chunk {
    cells: u32,
    // Steps and switches of a cell at most.
    work: u32,
}

struct Progress {
    // Cells that still run after this chunk.
    running: atomic<u32>,
    // Steps that all cells took in it.
    steps: atomic<u32>,
}

@group(0) @binding(1) var<storage, read> cells: array<Cell>;
@group(0) @binding(2) var<storage, read_write> states: array<State>;
@group(0) @binding(3) var<uniform> chunk: Chunk;
@group(0) @binding(4) var<storage, read_write> progress: Progress;

// This thread's cell.
var<private> lane: u32;

@compute @workgroup_size(workgroup_size)
fn sweep(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= chunk.cells {
        return;
    }
    lane = id.x;
    let cell = cells[id.x];
    var state = states[id.x];
    let first = state.step;
    var done = 0u;
    while done < chunk.work && state.status == RUNNING {
        done += 1u + advance(cell, &state);
        if state.status == RUNNING && is_due(cell, state) {
            certify(cell, &state);
        }
    }
    if done > 0u {
        states[id.x] = state;
        atomicAdd(&progress.steps, state.step - first);
    }
    if state.status == RUNNING {
        atomicAdd(&progress.running, 1u);
    }
}
