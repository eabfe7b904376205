// One thread for each cell: a number of its turns, from a state to a later state. Twin: src/stepping/lanes.rs.

override workgroup_size: u32 = 64u;

struct Dispatch {
    // The number of slots for cells: those of all tiles.
    slots: u32,
    // The fewest turns of a cell.
    work: u32,
    // The number of the dispatch, which counts from 0 to 3 and begins again.
    number: u32,
    padding: u32,
}

// The number of tiles on the device at once.
const SIDES = 4u;

struct Tally {
    // The numbers of cells to run in each dispatch, a ring: a dispatch reads its own number and adds to the next one.
    running: array<atomic<u32>, 4>,
    // The number of cells of each tile that still run.
    left: array<atomic<u32>, SIDES>,
    // The steps that all cells took so far, modulo 2^32.
    steps: atomic<u32>,
    padding_0: u32,
    padding_1: u32,
    padding_2: u32,
}

@group(0) @binding(1) var<storage, read> cells: array<Cell>;
@group(0) @binding(2) var<storage, read_write> states: array<State>;
@group(0) @binding(3) var<uniform> dispatch: Dispatch;
@group(0) @binding(4) var<storage, read_write> tally: Tally;
// The two lists of running cells: a dispatch reads one and writes the other.
@group(0) @binding(7) var<storage, read_write> running: array<u32>;
// The bodies, by number.
@group(0) @binding(13) var<storage, read> models: array<Model>;

// True where cells differ in their body.
override bodies: bool = false;

// The cell of this thread.
var<private> lane: u32;

// A workgroup counts its cells before one of its threads adds the count to the tally, so that few threads wait for
// each other, and neighbours in one list are neighbours in the next.
var<workgroup> group_running: atomic<u32>;
var<workgroup> group_ended: array<atomic<u32>, SIDES>;
var<workgroup> group_steps: atomic<u32>;
var<workgroup> group_place: u32;

// Puts the running cells of a workgroup in the list of a dispatch. Every thread must call this.
fn enlist(local: u32, runs: bool, number: u32, slots: u32) {
    var place = 0u;
    if runs {
        place = atomicAdd(&group_running, 1u);
    }
    workgroupBarrier();
    if local == 0u {
        group_place = atomicAdd(&tally.running[number % 4u], atomicLoad(&group_running));
    }
    workgroupBarrier();
    if runs {
        running[(number % 2u) * slots + group_place + place] = lane;
    }
}

@compute @workgroup_size(workgroup_size)
fn sweep(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    if id.x == 0u {
        // No thread adds to it before the next dispatch.
        atomicStore(&tally.running[(dispatch.number + 2u) % 4u], 0u);
    }
    var runs = false;
    if id.x < atomicLoad(&tally.running[dispatch.number]) {
        let work = dispatch.work;
        lane = running[(dispatch.number % 2u) * dispatch.slots + id.x];
        let cell = cells[lane];
        if bodies {
            model = models[cell.body];
        } else {
            model = uniform_model;
        }
        var state = states[lane];
        let first = state.step;
        var turns = begin_turns(cell, state);
        var done = 0u;
        // A cell stops at the end of a step, so that no search is kept between dispatches.
        while state.status == RUNNING && (done < work || !at_an_edge(turns)) {
            turn(cell, &state, &turns);
            done += 1u;
        }
        states[lane] = state;
        runs = state.status == RUNNING;
        atomicAdd(&group_steps, state.step - first);
        if !runs {
            atomicAdd(&group_ended[lane / (dispatch.slots / SIDES)], 1u);
        }
    }
    enlist(local, runs, dispatch.number + 1u, dispatch.slots);
    if local == 0u {
        atomicAdd(&tally.steps, atomicLoad(&group_steps));
        for (var side = 0u; side < SIDES; side += 1u) {
            atomicSub(&tally.left[side], atomicLoad(&group_ended[side]));
        }
    }
}
