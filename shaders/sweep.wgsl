// One thread a cell: a chunk of its steps, from its state to its state. Twin: src/sweep/cpu.rs.

override workgroup_size: u32 = 64u;

struct Chunk {
    // Cells of the tile.
    cells: u32,
    // Turns of a cell at least.
    work: u32,
    // Number of the chunk in the tile.
    number: u32,
}

struct Tally {
    // Cells that still run after a chunk.
    running: atomic<u32>,
    // Steps that all cells took in it.
    steps: atomic<u32>,
}

@group(0) @binding(1) var<storage, read> cells: array<Cell>;
@group(0) @binding(2) var<storage, read_write> states: array<State>;
@group(0) @binding(3) var<uniform> chunk: Chunk;
// A ring: a chunk reads the tally of the one before it and writes the next.
@group(0) @binding(4) var<storage, read_write> tallies: array<Tally, 4>;
// The cells that still run, twice: a chunk reads one list and writes the other.
@group(0) @binding(7) var<storage, read_write> running: array<u32>;

// This thread's cell.
var<private> lane: u32;

@compute @workgroup_size(workgroup_size)
fn sweep(@builtin(global_invocation_id) id: vec3<u32>) {
    let here = chunk.number % 4u;
    let next = (chunk.number + 1u) % 4u;
    if id.x >= atomicLoad(&tallies[here].running) {
        return;
    }
    lane = running[(chunk.number % 2u) * chunk.cells + id.x];
    let cell = cells[lane];
    var state = states[lane];
    let first = state.step;
    var turns = begin_turns(cell, state);
    var done = 0u;
    // A cell leaves at a step's edge, so that no search is kept between chunks.
    while state.status == RUNNING && (done < chunk.work || !at_an_edge(turns)) {
        turn(cell, &state, &turns);
        done += 1u;
    }
    states[lane] = state;
    atomicAdd(&tallies[next].steps, state.step - first);
    if state.status == RUNNING {
        let place = atomicAdd(&tallies[next].running, 1u);
        running[(next % 2u) * chunk.cells + place] = lane;
    }
}
