// Keeps the first switches of a cell. Twin: src/stepping/log.rs. A sweep that does not need its switches has
// quiet.wgsl in the place of this file.

override events_kept: u32 = 16u;

struct Event {
    motion: Motion,
    fraction: real,
    kind: u32,
    step: u32,
    mode: u32,
    padding: u32,
}

@group(0) @binding(6) var<storage, read_write> events: array<Event>;

fn switched(state: ptr<function, State>, kind: u32, fraction: real) {
    if kind == NOTHING || kind == KINK {
        return;
    }
    // Uplifts and impacts are counted as they happen, so that their counts give the number of this switch.
    var number = (*state).impacts + (*state).uplifts;
    if kind != OVERTURN {
        number -= 1u;
    }
    if number < events_kept {
        let place = lane * events_kept + number;
        events[place] = Event((*state).motion, fraction, kind, (*state).step, (*state).mode, 0u);
    }
}
