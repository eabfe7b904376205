// A cell as its integration begins: its numbers, its first state, and where the full contact that it
// shares has taken it. One thread a cell of a tile. Twin: src/sweep/begin.rs.

// The numbers of a cell's steps. Twin: src/sweep/groups.rs.
struct Steps {
    phase_step: real,
    step_forced: real,
    step_free: real,
    rest_speed: real,
    steps_forced: u32,
    steps: u32,
    substeps: u32,
    // 1 where all these numbers are finite.
    sound: u32,
}

// A tile's cells, and where their numbers lie. Twin: src/sweep/gpu/tile.rs.
struct Tile {
    // Tables: place of the first entry, and from a column and from a row to the next.
    horizontal: vec4<u32>,
    vertical: vec4<u32>,
    drive: vec4<u32>,
    // The same of the clocks; w: 1 where each cell has the number of its clock in `words`, from x on.
    clock: vec4<u32>,
    // Motions: place in `words` of the first one's first sample, motions from a column and from a row
    // to the next, samples of all motions.
    across: vec4<u32>,
    up: vec4<u32>,
    // Place of the vertical motions in `tracks`.
    up_values: u32,
    // 1 where there are shared motions.
    shared_contact: u32,
    // 1 where the base does not move vertically before the block lifts.
    still: u32,
    // The corner that a tilted block turns about.
    mode: u32,
    // Cells of the tile.
    cells: u32,
    // Columns of the grid.
    columns: u32,
    // Column and row of the tile's first cell.
    first_column: u32,
    first_row: u32,
    // How threads take cells: IN_ORDER, IN_BLOCKS or LISTED.
    order: u32,
    // Blocks in a row of the grid; for LISTED the place in `words` of the first cell's column.
    blocks: u32,
    // The tile's first slot, and the slots of all tiles.
    first_slot: u32,
    slots: u32,
    // Number of the chunk that is to run the cells first.
    number: u32,
    padding_0: u32,
    padding_1: u32,
    padding_2: u32,
}

// A tile's cells follow one another in the grid, and threads take them so.
const IN_ORDER = 0u;
// They follow one another, and threads take them in blocks of 8 by 4, so that those of a warp are
// near neighbours.
const IN_BLOCKS = 1u;
// Each cell's column and row stand in a list.
const LISTED = 2u;

const BLOCK_WIDTH = 8u;
const BLOCK_HEIGHT = 4u;
const BLOCK_CELLS = 32u;

@group(0) @binding(1) var<storage, read_write> new_cells: array<Cell>;
@group(0) @binding(8) var<uniform> tile: Tile;
// The tilt, and the tables of the groups that are reals alone.
@group(0) @binding(9) var<storage, read> numbers: array<real>;
@group(0) @binding(10) var<storage, read> clocks: array<Steps>;
@group(0) @binding(11) var<storage, read> words: array<u32>;
// The shared motions. Twin: src/sweep/tracks.rs.
@group(0) @binding(12) var<storage, read> tracks: array<real>;

const DISPLACEMENT = 0u;
const VELOCITY = 1u;
const ACCELERATION = 2u;
const LEAST = 3u;
const PEAK = 4u;
const LOWEST = 5u;
const HYSTERETIC = 5u;
const MOST = 6u;
const HIGHEST = 7u;
const DEEPEST = 8u;
const STRONGEST = 9u;
const TROUGH = 6u;
const CREST = 10u;
const QUARTERS_V = 7u;
const QUARTERS_H = 11u;

// A cell's number in its tile, its column and its row; the number is no less than the tile's cells
// for a thread that has none.
struct Place {
    number: u32,
    column: u32,
    row: u32,
}

fn place_of(thread: u32) -> Place {
    if tile.order == IN_BLOCKS {
        let block = thread / BLOCK_CELLS;
        let within = thread % BLOCK_CELLS;
        let column = block % tile.blocks * BLOCK_WIDTH + within % BLOCK_WIDTH;
        let rows = block / tile.blocks * BLOCK_HEIGHT + within / BLOCK_WIDTH;
        let from_row = rows * tile.columns + column;
        // Beside the grid, or before the tile's first cell.
        if column >= tile.columns || from_row < tile.first_column {
            return Place(tile.cells, 0u, 0u);
        }
        return Place(from_row - tile.first_column, column, tile.first_row + rows);
    }
    if tile.order == LISTED {
        let at = tile.blocks + 2u * min(thread, tile.cells - 1u);
        return Place(thread, words[at], words[at + 1u]);
    }
    let from_row = tile.first_column + thread;
    return Place(thread, from_row % tile.columns, tile.first_row + from_row / tile.columns);
}

// Place of a cell's entry in a table.
fn entry(table: vec4<u32>, place: Place) -> u32 {
    return table.x + place.column * table.y + place.row * table.z;
}

fn steps_of(place: Place) -> Steps {
    if tile.clock.w == 1u {
        return clocks[words[tile.clock.x + place.number]];
    }
    return clocks[entry(tile.clock, place)];
}

// A state at rest, the base in static equilibrium.
fn at_rest(cell: Cell, sound: bool) -> State {
    var state = State();
    if cell.deflection > 0.0 {
        state.motion.v = -cell.deflection;
    }
    state.motion.phi = numbers[0];
    state.max_v = cell.deflection;
    state.min_contact = model.gravity;
    state.mode = tile.mode;
    if !sound {
        state.status = DIVERGED;
    }
    return state;
}

// True where a cell of this lever, H times its share of u, may lift in a gap between samples: X of
// (14) is between two bounds, and Y above one.
fn lifts(lever: real, most: real, least: real, least_y: real) -> bool {
    // A negative lever turns the bounds about.
    let one = lever * most;
    let other = lever * least;
    return max(one, other) > model.left.arm * least_y
        || max(-one, -other) > model.right.arm * least_y;
}

// The first of some gaps whose bound, which does not fall from gap to gap, times `size` exceeds
// `limit`.
fn first_beyond(bounds: u32, gaps: u32, size: real, limit: real) -> u32 {
    var low = 0u;
    var high = gaps;
    while low < high {
        let middle = (low + high) / 2u;
        if size * tracks[bounds + middle] > limit {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    return low;
}

// Share of the friction asked for by which a gap must exceed it to be looked into.
const OVER = 2.0e-4;

// The friction asked for up to a sample, crests between samples included: in gaps where the largest |X|
// over the least Y exceeds what was seen, it is looked for on parabolas through quarters of them.
fn crests(h: u32, v: u32, last_v: u32, size: real, sample: u32, seen: real) -> real {
    let over: real = 1.0 + OVER;
    let all_h = tile.across.w;
    let all_v = tile.up.w;
    var friction = seen;
    for (var gap = 0u; gap < sample; gap++) {
        let at = h + gap;
        let at_v = v + min(gap, last_v - 1u);
        let most = size * tracks[at + CREST * all_h];
        let trough = tracks[at_v + TROUGH * all_v];
        if !(most > over * friction * trough) {
            continue;
        }
        let x = at + QUARTERS_H * all_h;
        let y = at_v + QUARTERS_V * all_v;
        let end = at + 1u + ACCELERATION * all_h;
        let end_v = at_v + 1u + ACCELERATION * all_v;
        let share0 = size * share(abs(tracks[end - 1u]), tracks[end_v - 1u]);
        let share1 = size * share(abs(tracks[x]), tracks[y]);
        let share2 = size * share(abs(tracks[x + all_h]), tracks[y + all_v]);
        let share3 = size * share(abs(tracks[x + 2u * all_h]), tracks[y + 2u * all_v]);
        let share4 = size * share(abs(tracks[end]), tracks[end_v]);
        let top = max(crest(share0, share1, share2), crest(share2, share3, share4));
        let ends = max(max(max(share0, share1), max(share2, share3)), share4);
        // No more than the bound that the gap was looked into for.
        var largest = ends;
        if trough > 0.0 {
            largest = min(max(top, ends), max(most / trough, ends));
        }
        friction = max(friction, largest);
    }
    return friction;
}

// Takes a cell from its start to the first gap in which it may lift, or to the end of the excitation.
fn full_contact(place: Place, scale: real, cell: Cell, state: ptr<function, State>) {
    let zero: real = 0.0;
    let first_h = entry(tile.across, place);
    let first_v = entry(tile.up, place);
    let h = words[first_h];
    let v = tile.up_values + words[first_v];
    let all_h = tile.across.w;
    let all_v = tile.up.w;
    // u is A_h times what it is for A_h = 1.
    let lever = model.height * scale;
    let size = abs(scale);
    // The last sample ends no gap. A motion of v at rest is as long as it is asked for.
    let last = words[first_h + 1u] - h - 1u;
    let last_v = words[first_v + 1u] - words[first_v] - 1u;
    var sample = 0u;
    var friction = zero;
    if tile.still == 1u {
        // Nothing but u changes from gap to gap: the first that lifts is searched for.
        let y = tracks[v + ACCELERATION * all_v];
        let least_y = tracks[v + LEAST * all_v];
        var rising = model.left.arm;
        var falling = model.right.arm;
        if lever < 0.0 {
            rising = model.right.arm;
            falling = model.left.arm;
        }
        let highest = first_beyond(h + HIGHEST * all_h, last, abs(lever), rising * least_y);
        let deepest = first_beyond(h + DEEPEST * all_h, last, abs(lever), falling * least_y);
        sample = min(highest, deepest);
        if sample > 0u && y > 0.0 {
            friction = size * tracks[h + STRONGEST * all_h + sample - 1u] / y;
        }
    } else {
        while sample < last {
            let gap = min(sample, last_v - 1u);
            let most = tracks[h + MOST * all_h + sample];
            let least = tracks[h + LEAST * all_h + sample];
            if lifts(lever, most, least, tracks[v + LEAST * all_v + gap]) {
                break;
            }
            let y = tracks[v + ACCELERATION * all_v + gap];
            if y > 0.0 {
                let x = abs(tracks[h + ACCELERATION * all_h + sample]);
                friction = max(friction, size * x / y);
            }
            sample += 1u;
        }
        friction = crests(h, v, last_v, size, sample, friction);
    }
    let at = min(sample, last_v);
    var z = tracks[h + HYSTERETIC * all_h + sample];
    if scale < 0.0 {
        z = -z;
    }
    (*state).motion = Motion(
        scale * tracks[h + DISPLACEMENT * all_h + sample],
        scale * tracks[h + VELOCITY * all_h + sample],
        tracks[v + DISPLACEMENT * all_v + at],
        tracks[v + VELOCITY * all_v + at],
        z,
        zero,
        zero,
    );
    (*state).max_u = size * tracks[h + PEAK * all_h + sample];
    (*state).max_v = tracks[v + PEAK * all_v + at];
    let lowest = tracks[v + LOWEST * all_v + at];
    if lowest < (*state).min_contact {
        (*state).min_contact = lowest;
    }
    (*state).friction = friction;
    (*state).step = min(sample * cell.substeps, cell.steps_forced);
    if (*state).step >= cell.steps {
        (*state).status = FINISHED;
    }
}

// Makes a cell; true where it is to run.
fn make(place: Place) -> bool {
    let h = entry(tile.horizontal, place);
    let v = entry(tile.vertical, place);
    let drive = entry(tile.drive, place);
    let steps = steps_of(place);
    let cell = Cell(
        numbers[h],
        numbers[h + 1u],
        numbers[h + 2u],
        numbers[h + 3u],
        numbers[v],
        numbers[v + 1u],
        numbers[drive],
        numbers[drive + 1u],
        steps.phase_step,
        steps.step_forced,
        steps.step_free,
        steps.rest_speed,
        numbers[h + 4u],
        numbers[v + 2u],
        numbers[h + 5u],
        numbers[v + 3u],
        steps.steps_forced,
        steps.steps,
        steps.substeps,
        0u,
    );
    let sound = numbers[h + 6u] > 0.0 && numbers[v + 4u] > 0.0 && numbers[drive + 3u] > 0.0
        && steps.sound > 0u;
    var state = at_rest(cell, sound);
    if tile.shared_contact == 1u && state.status == RUNNING {
        full_contact(place, numbers[drive + 2u], cell, &state);
    }
    let slot = tile.first_slot + place.number;
    new_cells[slot] = cell;
    states[slot] = state;
    return state.status == RUNNING;
}

@compute @workgroup_size(workgroup_size)
fn begin(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let place = place_of(id.x);
    var runs = false;
    if place.number < tile.cells {
        runs = make(place);
    }
    lane = tile.first_slot + place.number;
    enlist(local, runs, tile.number, tile.slots);
    if local == 0u {
        atomicAdd(&tally.left[tile.first_slot / (tile.slots / 2u)], atomicLoad(&group_running));
    }
}
