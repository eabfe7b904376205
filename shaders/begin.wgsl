// A cell at the start of its integration: its numbers and its first state. One thread for each cell of a tile. Twin:
// src/cells/begin.rs.

@group(0) @binding(1) var<storage, read_write> new_cells: array<Cell>;
// The samples of the record, and the tables of the groups that have only reals.
@group(0) @binding(9) var<storage, read> numbers: array<real>;
@group(0) @binding(10) var<storage, read> clocks: array<Steps>;

fn steps_of(place: Place) -> Steps {
    if tile.clock.more == 1u {
        return clocks[words[tile.clock.first + place.number]];
    }
    return clocks[entry(tile.clock, place)];
}

// Makes a cell; true where the cell is to run.
fn make(place: Place) -> bool {
    let h = entry(tile.horizontal, place);
    let v = entry(tile.vertical, place);
    let drive = entry(tile.drive, place);
    let steps = steps_of(place);
    let body = entry(tile.bodies, place);
    let lever = tile.levers + 3u * body;
    model.height = numbers[lever];
    model.left.arm = numbers[lever + 1u];
    model.right.arm = numbers[lever + 2u];
    model.least_arm = min(model.left.arm, model.right.arm);
    let cell = Cell(
        Horizontal(
            numbers[h],
            numbers[h + 1u],
            numbers[h + 2u],
            numbers[h + 3u],
            numbers[h + 4u],
            numbers[h + 5u],
            numbers[h + 6u],
            numbers[h + 7u],
            numbers[h + 8u],
            numbers[h + 9u],
            numbers[h + 10u],
        ),
        Vertical(
            numbers[v],
            numbers[v + 1u],
            numbers[v + 2u],
            numbers[v + 3u],
            numbers[v + 4u],
            numbers[v + 5u],
        ),
        Drive(
            numbers[drive],
            numbers[drive + 1u],
            numbers[drive + 2u],
            numbers[drive + 3u],
            numbers[drive + 4u],
            numbers[drive + 5u],
            numbers[drive + 6u],
        ),
        steps,
        body,
        0u,
    );
    let finite = cell.horizontal.finite > 0.0 && cell.vertical.finite > 0.0 && cell.drive.finite > 0.0
        && steps.finite > 0u;
    var state = at_rest(finite, cell.drive.tilt);
    if tile.shared_contact == 1u && state.status == RUNNING {
        full_contact(place, cell, &state);
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
    model = uniform_model;
    let place = place_of(id.x);
    var runs = false;
    if place.number < tile.cells {
        runs = make(place);
    }
    lane = tile.first_slot + place.number;
    enlist(local, runs, tile.number, tile.slots);
    if local == 0u {
        atomicAdd(&tally.left[tile.first_slot / (tile.slots / SIDES)], atomicLoad(&group_running));
    }
}
