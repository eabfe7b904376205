// The cells of a tile: their places in the grid, and the places of their numbers in the tables. Twin:
// src/backend/gpu/tile.rs.

// The layout of the entries of a table.
struct Layout {
    // The place of the entry of a cell at the start of every axis, modulo 2^32: it may lie before the first entry.
    first: u32,
    // The distance between two values of each axis.
    stride_0: u32,
    stride_1: u32,
    stride_2: u32,
    stride_3: u32,
    stride_4: u32,
    stride_5: u32,
    // See the field of Tile.
    more: u32,
}

// The cells of a tile, and the places of their numbers.
struct Tile {
    // The layouts of the tables in `numbers`.
    horizontal: Layout,
    vertical: Layout,
    drive: Layout,
    // The layout of the clocks; more: 1 where each cell has the number of its clock in `words`, from first on.
    clock: Layout,
    // The layout of the bodies, by number.
    bodies: Layout,
    // The layouts of the beginnings of motions in `words`; more: the number of samples of all motions.
    across: Layout,
    up: Layout,
    // The number of values of each axis after the first except the last; 1 for an axis that the grid does not have.
    counts: vec4<u32>,
    // The place in `numbers` of the height and the lever arms of the first body.
    levers: u32,
    // The place of the vertical motions in `motions`.
    up_values: u32,
    // 1 where there are shared motions.
    shared_contact: u32,
    // 1 where the base does not move vertically before the block lifts.
    still: u32,
    // The number of cells of the tile.
    cells: u32,
    // The number of columns of the grid.
    columns: u32,
    // The column and the row of the first cell of the tile; rows are those of all axes after the first together.
    first_column: u32,
    first_row: u32,
    // The order in which threads take cells: IN_ORDER or LISTED.
    order: u32,
    // For LISTED the place in `words` of the places of the first cell.
    listed: u32,
    // The first slot of the tile, and the number of slots of all tiles.
    first_slot: u32,
    slots: u32,
    // The number of the dispatch that first runs the cells.
    number: u32,
    padding_0: u32,
    padding_1: u32,
    padding_2: u32,
}

// The cells of a tile follow one another in the grid, and threads take them in this order.
const IN_ORDER = 0u;
// A list holds the places of each cell along all axes.
const LISTED = 1u;

@group(0) @binding(8) var<uniform> tile: Tile;
// Numbers of clocks, places of motions, and cells of a list.
@group(0) @binding(11) var<storage, read> words: array<u32>;

// The number of a cell in its tile, and its place along each axis. For a thread without a cell the number is not less
// than the number of cells of the tile.
struct Place {
    number: u32,
    at_0: u32,
    at_1: u32,
    at_2: u32,
    at_3: u32,
    at_4: u32,
    at_5: u32,
}

// The place of a cell in a column and a row.
fn along_axes(number: u32, column: u32, row: u32) -> Place {
    let counts = tile.counts;
    let from_2 = row / counts.x;
    let from_3 = from_2 / counts.y;
    let from_4 = from_3 / counts.z;
    let from_5 = from_4 / counts.w;
    return Place(
        number,
        column,
        row % counts.x,
        from_2 % counts.y,
        from_3 % counts.z,
        from_4 % counts.w,
        from_5,
    );
}

fn place_of(thread: u32) -> Place {
    if tile.order == LISTED {
        let at = tile.listed + 6u * min(thread, tile.cells - 1u);
        return Place(
            thread,
            words[at],
            words[at + 1u],
            words[at + 2u],
            words[at + 3u],
            words[at + 4u],
            words[at + 5u],
        );
    }
    let from_row = tile.first_column + thread;
    return along_axes(thread, from_row % tile.columns, tile.first_row + from_row / tile.columns);
}

// The place of the entry of a cell in a table.
fn entry(table: Layout, place: Place) -> u32 {
    return table.first + place.at_0 * table.stride_0 + place.at_1 * table.stride_1
        + place.at_2 * table.stride_2 + place.at_3 * table.stride_3
        + place.at_4 * table.stride_4 + place.at_5 * table.stride_5;
}
