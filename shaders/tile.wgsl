// A tile's cells: which of the grid's they are, and where the tables hold their numbers.
// Twin: src/backend/gpu/tile.rs.

// Where a table's entries lie.
struct Layout {
    // Place of the entry of a cell at the start of every axis, modulo 2^32: it may lie before the first.
    first: u32,
    // From a value of each axis to the next.
    stride_0: u32,
    stride_1: u32,
    stride_2: u32,
    stride_3: u32,
    stride_4: u32,
    stride_5: u32,
    // See the field of Tile.
    more: u32,
}

// A tile's cells, and where their numbers lie.
struct Tile {
    // Tables in `numbers`.
    horizontal: Layout,
    vertical: Layout,
    drive: Layout,
    // That of the clocks; more: 1 where each cell has the number of its clock in `words`, from first on.
    clock: Layout,
    // Of the bodies, by number.
    bodies: Layout,
    // Of the motions' beginnings in `words`; more: samples of all motions.
    across: Layout,
    up: Layout,
    // Values of the axes after the first but the last, 1 for those that a grid has not.
    counts: vec4<u32>,
    // Place in `numbers` of the first body's height and lever arms.
    levers: u32,
    // Place of the vertical motions in `motions`.
    up_values: u32,
    // 1 where there are shared motions.
    shared_contact: u32,
    // 1 where the base does not move vertically before the block lifts.
    still: u32,
    // Cells of the tile.
    cells: u32,
    // Columns of the grid.
    columns: u32,
    // Column and row of the tile's first cell; rows are those of all axes after the first together.
    first_column: u32,
    first_row: u32,
    // How threads take cells: IN_ORDER, IN_BLOCKS or LISTED.
    order: u32,
    // Blocks in a row of the grid; for LISTED the place in `words` of the first cell's places.
    blocks: u32,
    // The tile's first slot, and the slots of all tiles.
    first_slot: u32,
    slots: u32,
    // Number of the dispatch that is to run the cells first.
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
// Each cell's places along all axes stand in a list.
const LISTED = 2u;

const BLOCK_WIDTH = 8u;
const BLOCK_HEIGHT = 4u;
const BLOCK_CELLS = 32u;

@group(0) @binding(8) var<uniform> tile: Tile;
// Numbers of clocks, places of motions, and cells of a list.
@group(0) @binding(11) var<storage, read> words: array<u32>;

// A cell's number in its tile, and its place along each axis; the number is no less than the tile's cells
// for a thread that has none.
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
    if tile.order == IN_BLOCKS {
        let block = thread / BLOCK_CELLS;
        let within = thread % BLOCK_CELLS;
        let column = block % tile.blocks * BLOCK_WIDTH + within % BLOCK_WIDTH;
        let rows = block / tile.blocks * BLOCK_HEIGHT + within / BLOCK_WIDTH;
        let from_row = rows * tile.columns + column;
        // Beside the grid, or before the tile's first cell.
        if column >= tile.columns || from_row < tile.first_column {
            return along_axes(tile.cells, 0u, 0u);
        }
        return along_axes(from_row - tile.first_column, column, tile.first_row + rows);
    }
    if tile.order == LISTED {
        let at = tile.blocks + 6u * min(thread, tile.cells - 1u);
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

// Place of a cell's entry in a table.
fn entry(table: Layout, place: Place) -> u32 {
    return table.first + place.at_0 * table.stride_0 + place.at_1 * table.stride_1
        + place.at_2 * table.stride_2 + place.at_3 * table.stride_3
        + place.at_4 * table.stride_4 + place.at_5 * table.stride_5;
}
